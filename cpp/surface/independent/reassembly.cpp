// SPDX-License-Identifier: BSD-3-Clause
#include "surface/independent/reassembly.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "predicates/predicates.h"
#include "support/error.h"
#include "support/infinity.h"
#include "surface/independent/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::independent;

/// A corner of a triangle: a vertex, and which of its places.
struct Corner {
  std::int32_t vertex, place;
  friend auto operator<=>(const Corner&, const Corner&) = default;
};

struct PlacedTriangle {
  std::int32_t face = -1;
  std::array<Corner, 3> corners{};  ///< as the face turns
  bool spread = false;
};

/// Which face a triangle belongs to, and where in (u, v) its corners are.
class TrianglePlacer {
 public:
  explicit TrianglePlacer(FreeMesh& mesh) : mesh_(mesh) {}

  PlacedTriangle operator()(const EditableMesh::Triangle& t) {
    vertex_ = t;
    const Vec3 a = mesh_.position(t[0]);
    normal_ = cross(mesh_.position(t[1]) - a, mesh_.position(t[2]) - a);
    for (const std::int32_t face : common_faces())
      if (auto placed = in_one_chart(face)) return *placed;
    return over_several();
  }

 private:
  [[nodiscard]] std::int32_t face_of(const SurfacePlace& p) const { return mesh_.charts().face(p.foot); }
  [[nodiscard]] bool is_turned(const SurfacePlace& p) const {
    return mesh_.charts().triangles()[p.foot.triangle].turned;
  }

  // Those in which each corner has a place, on the side of the triangle; ascending.
  [[nodiscard]] std::vector<std::int32_t> common_faces() const {
    std::vector<std::int32_t> common;
    for (int i = 0; i < 3; ++i) {
      std::vector<std::int32_t> faces;
      for (const SurfacePlace& p : mesh_.places(vertex_[i]))
        if (!p.regular || dot(p.normal, normal_) > 0) faces.push_back(face_of(p));
      std::ranges::sort(faces);
      faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
      if (i == 0) {
        common = std::move(faces);
      } else {
        std::erase_if(common, [&](std::int32_t f) { return !std::ranges::binary_search(faces, f); });
      }
    }
    return common;
  }

  // Among the places of the corners in a face, those that are as far apart in (u, v) as in space.
  [[nodiscard]] std::optional<PlacedTriangle> in_one_chart(std::int32_t face) const {
    std::array<std::vector<std::int32_t>, 3> choice;
    for (int i = 0; i < 3; ++i) {
      const auto places = mesh_.places(vertex_[i]);
      for (std::size_t k = 0; k < places.size(); ++k)
        if (face_of(places[k]) == face) choice[i].push_back(static_cast<std::int32_t>(k));
    }
    for (const std::int32_t a : choice[0])
      for (const std::int32_t b : choice[1])
        for (const std::int32_t c : choice[2])
          if (fits({a, b, c})) return turned(face, {a, b, c}, false);
    return {};
  }

  [[nodiscard]] bool fits(const std::array<std::int32_t, 3>& k) const {
    std::array<const SurfacePlace*, 3> p{};
    for (int i = 0; i < 3; ++i) p[i] = &mesh_.places(vertex_[i])[k[i]];
    const double sign = is_turned(*p[0]) ? -1 : 1;
    if (!(sign * orientation(p[0]->foot.uv, p[1]->foot.uv, p[2]->foot.uv) > 0)) return false;
    for (int i = 0; i < 3; ++i) {
      if (!p[i]->regular) continue;
      for (const int j : {(i + 1) % 3, (i + 2) % 3}) {
        const Vec2 step = p[j]->foot.uv - p[i]->foot.uv;
        const Vec3 chord = p[j]->xyz - p[i]->xyz;
        if (!(norm(step.x() * p[i]->su + step.y() * p[i]->sv - chord) <= most_distortion * norm(chord))) return false;
      }
    }
    return true;
  }

  [[nodiscard]] PlacedTriangle turned(std::int32_t face, const std::array<std::int32_t, 3>& k, bool spread) const {
    PlacedTriangle placed{face, {}, spread};
    for (int i = 0; i < 3; ++i) placed.corners[i] = {vertex_[i], k[i]};
    if (is_turned(mesh_.places(vertex_[0])[k[0]])) std::swap(placed.corners[1], placed.corners[2]);
    return placed;
  }

  [[nodiscard]] std::int32_t nearest_place(std::int32_t v, std::int32_t face) const {
    const auto places = mesh_.places(v);
    std::int32_t best = 0;
    std::pair<bool, double> most{false, -infinity};
    for (std::size_t k = 0; k < places.size(); ++k) {
      const std::pair here{face_of(places[k]) == face && dot(places[k].normal, normal_) > 0,
                           dot(places[k].normal, normal_)};
      if (here > most) most = here, best = static_cast<std::int32_t>(k);
    }
    return best;
  }

  /// The surface over a place of the triangle, from the nearest corner that has a normal.
  [[nodiscard]] std::optional<SurfacePlace> below(const std::array<double, 3>& weight,
                                                  const std::array<std::int32_t, 3>& k) {
    const Vec3 target = weight[0] * mesh_.position(vertex_[0]) + weight[1] * mesh_.position(vertex_[1]) +
                        weight[2] * mesh_.position(vertex_[2]);
    std::array<int, 3> order{0, 1, 2};
    std::ranges::stable_sort(order, std::greater<>(), [&](int i) { return weight[i]; });
    for (const int i : order) {
      const SurfacePlace& from = mesh_.places(vertex_[i])[k[i]];
      if (!from.regular) continue;
      if (auto place = mesh_.charts().towards(mesh_.cad(), from, target)) return place;
    }
    return {};
  }

  // The face that holds most of some places, where the corners are of three; else that of the centroid.
  [[nodiscard]] std::optional<SurfacePlace> most_of(const std::array<std::int32_t, 3>& k) {
    constexpr double third = 1. / 3, most = 2. / 3, rest = 1. / 6;
    auto found = below({third, third, third}, k);
    const auto corner = [&](int i) { return face_of(mesh_.places(vertex_[i])[k[i]]); };
    if (corner(0) == corner(1) || corner(1) == corner(2) || corner(2) == corner(0)) return found;
    std::map<std::int32_t, int> votes;
    std::vector<SurfacePlace> places;
    if (found) places.push_back(*found);
    for (const auto& weight : {std::array{most, rest, rest}, {rest, most, rest}, {rest, rest, most},
                               {0.5, 0.5, 0.}, {0., 0.5, 0.5}, {0.5, 0., 0.5}})
      if (auto place = below(weight, k)) places.push_back(*place);
    for (const SurfacePlace& p : places) ++votes[face_of(p)];
    for (const SurfacePlace& p : places)
      if (!found || votes[face_of(p)] > votes[face_of(*found)]) found = p;
    return found;
  }

  // Where all places of the corners are in one face.
  [[nodiscard]] std::optional<std::int32_t> only_face() const {
    const std::int32_t face = face_of(mesh_.places(vertex_[0]).front());
    for (const std::int32_t v : vertex_)
      for (const SurfacePlace& p : mesh_.places(v))
        if (face_of(p) != face) return {};
    return face;
  }

  PlacedTriangle over_several() {
    std::array<std::int32_t, 3> k{};
    if (const auto face = only_face()) {
      for (int i = 0; i < 3; ++i) k[i] = nearest_place(vertex_[i], *face);
      return turned(*face, k, true);
    }
    for (int i = 0; i < 3; ++i) k[i] = nearest_place(vertex_[i], -1);
    const std::optional<SurfacePlace> foot = most_of(k);
    const SurfacePlace middle = foot ? *foot : mesh_.places(vertex_[0])[k[0]];
    const std::int32_t face = face_of(middle);
    PlacedTriangle placed{face, {}, true};
    for (int i = 0; i < 3; ++i) placed.corners[i] = {vertex_[i], nearest_place(vertex_[i], face)};
    if (is_turned(middle)) std::swap(placed.corners[1], placed.corners[2]);
    return placed;
  }

  FreeMesh& mesh_;
  EditableMesh::Triangle vertex_{};
  Vec3 normal_;
};

class Reassembler {
 public:
  Reassembler(const SurfaceMesh& before, FreeMesh& free, Monitor& monitor)
      : before_(before), free_(free), monitor_(monitor) {
    result_.mesh.independent = true;
  }

  FreedMesh run(const std::vector<SharpLine>& lines, std::span<const WorkedLine> worked,
                const std::vector<std::int32_t>& corners) {
    number_vertices(corners);
    place_triangles();
    result_.feet.resize(before_.faces.size());
    for (std::size_t f = 0; f < before_.faces.size(); ++f) add_face(f);
    add_curves(lines);
    place_on_curves(worked);
    return std::move(result_);
  }

 private:
  void number_vertices(const std::vector<std::int32_t>& corners) {
    number_.assign(free_.vertices(), -1);
    for (const auto& t : free_.triangles())
      if (t[0] >= 0)
        for (const std::int32_t v : t) number_[v] = 0;
    for (std::size_t v = 0; v < number_.size(); ++v) {
      if (number_[v] < 0) continue;
      const auto old = static_cast<std::int32_t>(v);
      number_[v] = static_cast<std::int32_t>(result_.mesh.vertices.size());
      result_.mesh.vertices.push_back(free_.position(old));
      result_.mesh.vertex_ref.push_back(std::ranges::binary_search(corners, old) ? before_.vertex_ref[v] : 0);
      result_.vertex_size.push_back(free_.size(old));
      old_vertex_.push_back(old);
    }
  }

  void place_triangles() {
    TrianglePlacer place(free_);
    std::size_t count = 0;
    of_face_.resize(before_.faces.size());
    for (const auto& t : free_.triangles()) {
      if (t[0] < 0) continue;
      if (count++ % 256 == 0) monitor_.checkpoint();
      PlacedTriangle placed = place(t);
      for (int i = 0; i < 3; ++i) {
        const std::int32_t v = t[i], w = t[(i + 1) % 3];
        if (!free_.is_free(v) && !free_.is_free(w)) beside_[mesh_edge(v, w)].push_back(placed.face);
      }
      of_face_[placed.face].push_back(placed);
    }
  }

  void add_face(std::size_t f) {
    const FaceMesh& old = before_.faces[f];
    FaceMesh& face = result_.mesh.faces.emplace_back();
    face.ref = old.ref, face.name = old.name, face.rgb = old.rgb, face.part_of = old.part_of;
    face.status = old.status, face.why = old.why;
    if (of_face_[f].empty()) {
      if (old.triangles.empty()) return;
      face.status = FaceStatus::collapsed;
      face.why = Where{.face = old.ref}.prefix() +
                 "no triangle is left of the face: its neighbours' cover it within the tolerances";
      return;
    }
    std::vector<std::int32_t>& feet = result_.feet[f];
    std::vector<Corner> locals;
    for (const PlacedTriangle& t : of_face_[f]) locals.insert(locals.end(), t.corners.begin(), t.corners.end());
    std::ranges::sort(locals);
    locals.erase(std::unique(locals.begin(), locals.end()), locals.end());
    for (const Corner& c : locals) {
      const SurfacePlace& p = free_.places(c.vertex)[c.place];
      face.uv.push_back(p.foot.uv);
      face.vertex.push_back(number_[c.vertex]);
      face.uv_face.push_back(free_.charts().face(p.foot));
      feet.push_back(p.foot.triangle);
    }
    for (const PlacedTriangle& t : of_face_[f]) {
      std::array<std::int32_t, 3> corners{};
      for (int i = 0; i < 3; ++i)
        corners[i] = static_cast<std::int32_t>(std::ranges::lower_bound(locals, t.corners[i]) - locals.begin());
      face.triangles.push_back(corners);
      face.spread.push_back(static_cast<char>(t.spread));
    }
  }

  /// Edges of a line that are left, with their curve and the faces beside.
  struct Run {
    std::int32_t curve = -1;
    std::vector<std::int32_t> faces;
    std::vector<std::int32_t> vertices;
  };

  void add_curves(const std::vector<SharpLine>& lines) {
    std::vector<Run> runs;
    for (const SharpLine& line : lines) add_runs(line, runs);
    SurfaceMesh& mesh = result_.mesh;
    for (const CurveMesh& old : before_.curves)
      mesh.curves.push_back({.ref = old.ref, .vertices = {}, .uses = old.uses, .part_of = old.part_of});
    for (std::size_t c = 0; c < mesh.curves.size(); ++c) old_curve_.push_back(static_cast<std::int32_t>(c));
    for (Run& run : runs) {
      CurveMesh curve = mesh.curves[run.curve];
      curve.uses = uses_of(run);
      curve.vertices.clear();
      for (const std::int32_t v : run.vertices) curve.vertices.push_back(number_[v]);
      if (mesh.curves[run.curve].vertices.empty())
        mesh.curves[run.curve] = std::move(curve);
      else
        more_.push_back(std::move(curve)), old_curve_.push_back(run.curve);
    }
    for (CurveMesh& curve : more_) mesh.curves.push_back(std::move(curve));
    for (const CurveMesh& curve : mesh.curves) result_.curve_size.push_back(sizes_along(curve.vertices));
  }

  // Where sizes differ by direction those of the edges before and behind, in the mean.
  [[nodiscard]] std::vector<double> sizes_along(const std::vector<std::int32_t>& chain) const {
    std::vector<double> sizes;
    for (std::size_t k = 0; k < chain.size(); ++k) {
      if (!free_.by_direction()) {
        sizes.push_back(result_.vertex_size[chain[k]]);
        continue;
      }
      const std::int32_t v = old_vertex_[chain[k]];
      double sum = 0;
      int count = 0;
      if (k > 0) sum += free_.size_along(v, old_vertex_[chain[k - 1]]), ++count;
      if (k + 1 < chain.size()) sum += free_.size_along(v, old_vertex_[chain[k + 1]]), ++count;
      sizes.push_back(sum / count);
    }
    return sizes;
  }

  // A vertex where a closed curve begins is at both of its ends.
  void place_on_curves(std::span<const WorkedLine> worked) {
    std::multimap<std::pair<std::int32_t, std::int32_t>, OnCurve> known;  // by curve of before and vertex
    for (const WorkedLine& line : worked)
      for (const LineNode& node : line.left)
        for (const OnCurve& place : line.places->on_curves(node.arc))
          if (number_[node.vertex] >= 0) known.emplace(std::pair{place.curve, number_[node.vertex]}, place);
    for (std::size_t c = 0; c < result_.mesh.curves.size(); ++c) {
      CurveParameters& on = result_.curve_parameters.emplace_back();
      const std::vector<std::int32_t>& chain = result_.mesh.curves[c].vertices;
      if (chain.size() < 2) continue;
      on.t.assign(chain.size(), std::numeric_limits<double>::quiet_NaN());
      for (std::size_t k = 0; k < chain.size(); ++k)
        if (const auto place = known.find({old_curve_[c], chain[k]}); place != known.end())
          on.face = place->second.face, on.ic = place->second.ic, on.t[k] = place->second.t;
      for (const auto& [end, beside] : {std::pair{std::size_t{0}, std::size_t{1}}, {chain.size() - 1, chain.size() - 2}}) {
        const auto [first, last] = known.equal_range({old_curve_[c], chain[end]});
        for (auto each = first; each != last; ++each)
          if (const double t = each->second.t; std::abs(t - on.t[beside]) < std::abs(on.t[end] - on.t[beside]))
            on.t[end] = t;
      }
    }
  }

  void add_runs(const SharpLine& line, std::vector<Run>& runs) {
    bool fresh = true;
    std::size_t first = 0;
    while (first < line.vertices.size() && number_[line.vertices[first]] < 0) ++first;
    std::vector<std::int32_t> left, curve;  // vertices that are there, and the curve of each edge
    const std::size_t n = line.curve.size();
    if (first > n) return;
    left.push_back(line.vertices[first]);
    std::size_t from = first;
    for (std::size_t k = first + 1; k <= (line.closed() ? first + n : n); ++k) {
      const std::int32_t v = line.vertices[k <= n ? k : k - n];
      if (number_[v] < 0) continue;
      left.push_back(v);
      curve.push_back(line.curve[((from + k - 1) / 2) % n]);
      from = k;
    }
    for (std::size_t k = 0; k < curve.size(); ++k) {
      std::vector<std::int32_t> faces = beside_[mesh_edge(left[k], left[k + 1])];
      std::ranges::sort(faces);
      if (fresh || runs.back().curve != curve[k] || runs.back().faces != faces)
        runs.push_back({curve[k], std::move(faces), {left[k]}});
      runs.back().vertices.push_back(left[k + 1]);
      fresh = false;
    }
  }

  // A curve inside one face is so still.
  [[nodiscard]] std::vector<CurveMeshUse> uses_of(const Run& run) const {
    const auto& old = before_.curves[run.curve].uses;
    const bool internal = std::ranges::any_of(old, [](const CurveMeshUse& u) { return u.internal; });
    if (internal && run.faces.size() == 2 && run.faces[0] == run.faces[1]) return {{run.faces[0], true}};
    std::vector<CurveMeshUse> uses;
    for (const std::int32_t f : run.faces) uses.push_back({f, false});
    return uses;
  }

  const SurfaceMesh& before_;
  FreeMesh& free_;
  Monitor& monitor_;
  FreedMesh result_;
  std::vector<std::int32_t> number_, old_vertex_;  // of vertices that are there, one way and the other
  std::vector<std::vector<PlacedTriangle>> of_face_;
  std::map<MeshEdge, std::vector<std::int32_t>> beside_;  // faces of the triangles on edges between kept vertices
  std::vector<CurveMesh> more_;
  std::vector<std::int32_t> old_curve_;  // by curve: that of before
};

}  // namespace

FreedMesh reassemble(const SurfaceMesh& before, FreeMesh& free, const std::vector<SharpLine>& lines,
                     std::span<const WorkedLine> worked,
                     const std::vector<std::int32_t>& corners, Monitor& monitor) {
  return Reassembler(before, free, monitor).run(lines, worked, corners);
}

}  // namespace carreau
