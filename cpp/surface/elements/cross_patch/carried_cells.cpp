// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/cross_patch/carried_cells.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "model/traces.h"
#include "periodic/closest.h"
#include "periodic/root_maps.h"
#include "predicates/predicates.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "surface/assembly/whole_mesh.h"
#include "surface/carry/carry_faces.h"
#include "surface/carry/carry_patch.h"
#include "surface/elements/cross_patch/invalid_elements.h"

namespace carreau {

namespace {

/// A vertex or a node of the mesh.
struct MeshNode {
  std::int32_t index = -1;
  bool is_mid = false;
  friend auto operator<=>(const MeshNode&, const MeshNode&) = default;
};

/// The nodes of a curve, in the order of its chains.
struct CurveNodeList {
  std::vector<MeshNode> vertices, mids;
};

class CellCarrier {
 public:
  CellCarrier(const CurveModel& model, const PeriodicModel& periodic, const SurfaceMesh& before, const Charts& charts, CrossPatchResult& made)
      : model_(model), periodic_(periodic), before_(before), made_(made), mesh_(made.mesh), exact_(rounding_of::places * periodic.gap) {
    first_.assign(before.faces.size() + 1, 0);
    for (const Charts::Triangle& t : charts.triangles()) ++first_[static_cast<std::size_t>(t.face) + 1];
    for (std::size_t f = 1; f < first_.size(); ++f) first_[f] += first_[f - 1];
  }

  std::string run() {
    list_curves();
    for (const CurveClass& all : periodic_.curves) share_places(all);
    put_moved();
    for (const FacePair& pair : periodic_.pairs) {
      if (why_.empty() && !mesh_.faces[pair.master].triangles.empty()) carry(pair);
    }
    if (why_.empty()) (void)drop_unused(made_);  // former vertices of slaves
    return why_;
  }

 private:
  // ---- curves ----

  void list_curves() {
    nodes_.resize(model_.topology.curves.size());
    std::map<int, std::size_t> by_ref;
    for (std::size_t c = 0; c < nodes_.size(); ++c) by_ref.emplace(mesh_.curves[c].ref, c);
    for (std::size_t k = 0; k < mesh_.curves.size(); ++k) {
      const CurveMesh& curve = mesh_.curves[k];
      const auto c = k < nodes_.size() ? k : by_ref.at(curve.ref);
      for (const std::int32_t v : curve.vertices) nodes_[c].vertices.push_back({v, false}), on_curve_.push_back({v, false});
      for (const std::int32_t v : curve.mid) nodes_[c].mids.push_back({v, true}), on_curve_.push_back({v, true});
    }
    std::sort(on_curve_.begin(), on_curve_.end());
  }

  [[nodiscard]] Vec3& at(const MeshNode& node) const { return node.is_mid ? mesh_.mid_vertices[node.index] : mesh_.vertices[node.index]; }

  void share_places(const CurveClass& all) {
    const int root = all.members.front().image.curve;
    if (model_.curve(root).degenerate) return;
    for (const bool mids : {false, true}) {
      const std::vector<MeshNode>& from = mids ? nodes_[root].mids : nodes_[root].vertices;
      repeat(root, maps_of_root(all), from);
      for (const MeshNode& node : from) put(root, node, on_planes(at(node), all.mirrors, periodic_.gap));
      for (const CurveMember& member : all.members) {
        const int c = member.image.curve;
        if (c == root) continue;
        const std::vector<MeshNode>& to = mids ? nodes_[c].mids : nodes_[c].vertices;
        std::size_t hint = 0;
        for (const MeshNode& node : from) {
          const Vec3 target = member.map(at(node));
          hint = nearest(to, target, hint);
          if (hint < to.size()) put(c, to[hint], target);
        }
      }
    }
  }

  // Maps that carry the root onto itself: the first node of each orbit has its place.
  void repeat(int root, const std::vector<CurveMember>& maps, const std::vector<MeshNode>& nodes) {
    std::vector<char> placed(maps.empty() ? 0 : nodes.size(), 0);
    for (std::size_t k = 0; k < placed.size(); ++k) {
      if (placed[k] != 0) continue;
      placed[k] = 1;
      for (const CurveMember& each : maps) {
        const Vec3 image = each.map(at(nodes[k]));
        const std::size_t other = nearest(nodes, image, nodes.size());
        if (other >= nodes.size()) continue;
        if (nodes[other] == nodes[k]) put(root, nodes[k], 0.5 * (at(nodes[k]) + image));
        if (placed[other] != 0) continue;
        placed[other] = 1;
        put(root, nodes[other], image);
      }
    }
  }

  // Images mostly follow each other, in one direction or the other.
  [[nodiscard]] std::size_t nearest(const std::vector<MeshNode>& nodes, const Vec3& target, std::size_t hint) const {
    const std::size_t n = nodes.size();
    for (const std::size_t k : {hint, hint + 1, hint + n - 1})
      if (n > 0 && hint < n && norm(at(nodes[k % n]) - target) <= periodic_.gap) return k % n;
    std::size_t best = n;
    double least = infinity;
    for (std::size_t k = 0; k < n; ++k)
      if (const double d = norm(at(nodes[k]) - target); d < least) least = d, best = k;
    return best;
  }

  // The places of the root's nodes and of their images differ by the tables of arc lengths.
  void put(int curve, const MeshNode& node, const Vec3& target) {
    if (norm(at(node) - target) <= exact_) return;
    if (!node.is_mid && mesh_.vertex_ref[node.index] != 0) return;
    const Curve& shape = model_.curve(curve);
    const CurveUse& use = shape.uses.front();
    const CurveSupport& support = model_.support(use);
    const TracePlace near = nearest_on_trace(support.xyz, at(node));
    const double t = support.t[near.segment] + near.share * (support.t[near.segment + 1] - support.t[near.segment]);
    const CurvePoint point = find_closest(model_, use, t, support.t.front(), support.t.back(), target);
    at(node) = point.distance <= exact_ ? target : point.xyz;
    moved_.emplace(node, at(node));
  }

  // Parameters follow the nodes.
  void put_moved() {
    for (FaceMesh& face : mesh_.faces) {
      std::vector<Vec3> targets;
      std::vector<ClosestPoint> points;
      std::vector<Vec2*> uv;
      const auto list = [&](const MeshNode& node, Vec2& p) {
        if (const auto found = moved_.find(node); found != moved_.end())
          targets.push_back(found->second), points.push_back({p, {}, 0}), uv.push_back(&p);
      };
      if (!moved_.empty()) {
        for (std::size_t v = 0; v < face.vertex.size(); ++v) list({face.vertex[v], false}, face.uv[v]);
        for (std::size_t v = 0; v < face.mid_vertex.size(); ++v) list({face.mid_vertex[v], true}, face.mid_uv[v]);
      }
      find_closest(model_.cad, face.ref, targets, points);
      for (std::size_t k = 0; k < uv.size(); ++k) *uv[k] = points[k].uv;
    }
    for (std::size_t c = 0; c < made_.curve_parameters.size(); ++c) {
      CurveParameters& on = made_.curve_parameters[c];
      for (std::size_t k = 0; k < on.t.size(); ++k)
        if (const auto found = moved_.find({mesh_.curves[c].vertices[k], false}); found != moved_.end()) on.t[k] = parameter(c, on, on.t[k], found->second);
    }
  }

  [[nodiscard]] double parameter(std::size_t c, const CurveParameters& on, double t, const Vec3& target) const {
    for (const CurveUse& use : model_.curve(static_cast<int>(std::min(c, nodes_.size() - 1))).uses)
      if (model_.face_ref(use) == on.face && use.curve + 1 == on.ic) {
        const CurveSupport& support = model_.support(use);
        return find_closest(model_, use, t, support.t.front(), support.t.back(), target).t;
      }
    return t;
  }

  // ---- faces ----

  [[nodiscard]] bool is_kept(const MeshNode& node) const {
    return (!node.is_mid && mesh_.vertex_ref[node.index] != 0) || std::binary_search(on_curve_.begin(), on_curve_.end(), node);
  }

  /// A local vertex or node of a master, and its place on the slave.
  struct Carried {
    Vec2 guess;
    Vec3 target;
    std::int32_t index = -1, foot = -1, face = -1;  ///< node of the mesh; triangle of the atlas, and its face
  };

  // A place of the master by the triangle of the atlas that has it, and the corresponding place of the slave.
  void guess(const FacePair& pair, const Vec2& uv, std::int32_t foot, Carried& place) const {
    const std::int32_t t = foot - first_[pair.master];
    const FaceMesh &from = before_.faces[pair.master], &to = before_.faces[pair.slave];
    if (t < 0 || t >= std::ssize(from.triangles)) return;
    const auto corner = [&](int i) { return from.uv[from.triangles[t][i]]; };
    const auto image = [&](int i) { return to.uv[to.triangles[t][pair.flipped ? (3 - i) % 3 : i]]; };
    const Vec2 a = corner(0), b = corner(1), c = corner(2);
    const double area = cross(b - a, c - a);
    const double wb = cross(uv - a, c - a) / area, wc = cross(b - a, uv - a) / area;
    place.guess = (1 - wb - wc) * image(0) + wb * image(1) + wc * image(2);
    place.foot = first_[pair.slave] + t, place.face = pair.slave;
  }

  // A node of a border whose place is known beyond the border alone: takes the place that the slave has there.
  bool place_beyond(const FacePair& pair, bool mids, Carried& node) const {
    const FaceMesh& to = mesh_.faces[pair.slave];
    const std::vector<std::int32_t>& known = mids ? to.mid_vertex : to.vertex;
    const auto found = std::find(known.begin(), known.end(), node.index);
    if (found == known.end()) return false;
    const auto v = static_cast<std::size_t>(found - known.begin());
    node.guess = mids ? to.mid_uv[v] : to.uv[v];
    node.foot = (mids ? made_.mid_feet : made_.feet)[pair.slave][v];
    node.face = face_of(node.foot);
    return true;
  }
  [[nodiscard]] std::int32_t face_of(std::int32_t foot) const {
    return static_cast<std::int32_t>(std::upper_bound(first_.begin(), first_.end(), foot) - first_.begin()) - 1;
  }

  void carry(const FacePair& pair) {
    const FaceMesh& from = mesh_.faces[pair.master];
    FaceMesh& to = mesh_.faces[pair.slave];
    const auto fail = [&](const std::string& what) {
      why_ = "the elements of face " + std::to_string(from.ref) + " have no image on face " + std::to_string(to.ref) + ": " + what;
    };
    std::vector<Carried> vertices(from.uv.size()), mids(from.mid_uv.size());
    if (before_.faces[pair.master].triangles.size() != before_.faces[pair.slave].triangles.size()) return fail("their triangles differ");
    for (std::size_t v = 0; v < vertices.size(); ++v) guess(pair, from.uv[v], made_.feet[pair.master][v], vertices[v]);
    for (std::size_t v = 0; v < mids.size(); ++v) guess(pair, from.mid_uv[v], made_.mid_feet[pair.master][v], mids[v]);
    FaceMesh image = to;
    image.status = before_.faces[pair.slave].status, image.why = before_.faces[pair.slave].why;
    if (!place_all(pair, from.vertex, false, vertices) || !place_all(pair, from.mid_vertex, true, mids)) return fail("their borders differ");
    std::vector<std::int32_t> local(vertices.size());
    image.uv.clear(), image.vertex.clear(), image.uv_face.clear(), image.spread = from.spread;
    image.mid.clear(), image.mid_uv.clear(), image.mid_vertex.clear();
    made_.feet[pair.slave].clear(), made_.mid_feet[pair.slave].clear();
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      local[v] = static_cast<std::int32_t>(v);
      image.uv.push_back(vertices[v].guess), image.vertex.push_back(vertices[v].index), image.uv_face.push_back(vertices[v].face);
      made_.feet[pair.slave].push_back(vertices[v].foot);
    }
    for (const Carried& mid : mids) {
      image.mid_uv.push_back(mid.guess), image.mid_vertex.push_back(mid.index);
      made_.mid_feet[pair.slave].push_back(mid.foot);
    }
    image.triangles.clear();
    carry_elements(from, local, pair.flipped, image);
    carry_mids(from, pair.flipped, image);
    for (std::size_t t = 0; t < from.triangles.size(); ++t) {
      const auto is_turned = [](const FaceMesh& face, const std::array<std::int32_t, 3>& of) {
        return !(orientation(face.uv[of[0]], face.uv[of[1]], face.uv[of[2]]) > 0);
      };
      if (is_turned(image, image.triangles[image_triangle(from, t, pair.flipped)]) && !is_turned(from, from.triangles[t]))
        return fail("a triangle is turned over in (u, v)");
    }
    to = std::move(image);
    tell_invalid(mesh_, to);
  }

  // Nodes on curves have their places; others go to the closest points of the surface.
  bool place_all(const FacePair& pair, const std::vector<std::int32_t>& from, bool mids, std::vector<Carried>& all) {
    const FaceMesh& to = mesh_.faces[pair.slave];
    std::vector<MeshNode> border;
    for (const std::int32_t v : mids ? to.mid_vertex : to.vertex)
      if (is_kept({v, mids})) border.push_back({v, mids});
    std::sort(border.begin(), border.end());
    border.erase(std::unique(border.begin(), border.end()), border.end());
    std::vector<Vec3> targets;
    std::vector<ClosestPoint> points;
    std::size_t found = 0;
    for (std::size_t v = 0; v < all.size(); ++v) {
      const MeshNode node{from[v], mids};
      Vec3 target = pair.map(at(node));
      if (is_kept(node)) {
        found = nearest(border, target, found);
        if (found == border.size() || norm(at(border[found]) - target) > periodic_.gap) return false;
        all[v].index = border[found].index;
        target = at(border[found]);
      }
      if (all[v].face < 0 && !place_beyond(pair, mids, all[v])) return false;
      targets.push_back(target), points.push_back({all[v].guess, {}, 0});
    }
    find_closest(model_.cad, to.ref, targets, points);
    std::map<std::int32_t, std::int32_t> added;  // by node of the master
    for (std::size_t v = 0; v < all.size(); ++v) {
      if (all[v].face != pair.slave) continue;
      if (points[v].distance > periodic_.gap) return false;
      all[v].guess = points[v].uv;
      if (all[v].index >= 0) continue;
      const auto [known, is_new] = added.try_emplace(from[v], -1);
      if (is_new) known->second = add(points[v].distance <= exact_ ? targets[v] : points[v].xyz, from[v], mids);
      all[v].index = known->second;
    }
    return true;
  }

  std::int32_t add(const Vec3& xyz, std::int32_t like, bool mid) {
    if (mid) {
      mesh_.mid_vertices.push_back(xyz);
      return static_cast<std::int32_t>(mesh_.mid_vertices.size()) - 1;
    }
    mesh_.vertices.push_back(xyz);
    mesh_.vertex_ref.push_back(0);
    made_.vertex_size.push_back(made_.vertex_size[like]);
    return static_cast<std::int32_t>(mesh_.vertices.size()) - 1;
  }

  const CurveModel& model_;
  const PeriodicModel& periodic_;
  const SurfaceMesh& before_;
  CrossPatchResult& made_;
  SurfaceMesh& mesh_;
  double exact_;
  std::vector<std::int32_t> first_;  // triangle of the atlas, by face
  std::vector<CurveNodeList> nodes_;  // by curve of the topology
  std::vector<MeshNode> on_curve_;        // of any curve, ascending
  std::map<MeshNode, Vec3> moved_;
  std::string why_;
};

}  // namespace

std::string carry_cells(const CurveModel& model, const PeriodicModel& periodic, const SurfaceMesh& before, const Charts& charts,
                        CrossPatchResult& made) {
  return CellCarrier(model, periodic, before, charts, made).run();
}

}  // namespace carreau
