// SPDX-License-Identifier: BSD-3-Clause
#include "surface/assembly/cracks.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "model/union_find.h"

namespace carreau {

namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;

/// A corner of a triangle. A vertex of its face may be replaced there.
struct Corner {
  std::size_t face = 0, triangle = 0;
  int rank = 0;
};

class CrackOpener {
 public:
  explicit CrackOpener(CompositeResult& result) : result_(result), mesh_(result.mesh) {}

  void run() {
    for (std::size_t c = 0; c < mesh_.curves.size(); ++c) {
      const CurveMesh& curve = mesh_.curves[c];
      const auto inside = [&](const CurveMeshUse& use) {
        return use.internal && mesh_.faces[use.face].status != FaceStatus::wire;
      };
      if (!std::ranges::any_of(curve.uses, inside)) continue;
      cracks_.push_back(c);
      for (std::size_t k = 0; k + 1 < curve.vertices.size(); ++k)
        crack_.insert(std::minmax(curve.vertices[k], curve.vertices[k + 1]));
    }
    if (crack_.empty()) return;
    collect();
    for (const auto& [vertex, corners] : around_) part(vertex, corners);
    renumber();
    const std::size_t curves = mesh_.curves.size();
    for (std::size_t c = 0; c < curves; ++c) std::ranges::binary_search(cracks_, c) ? divide(c) : follow(mesh_.curves[c]);
  }

 private:
  // Collects the corners at the ends of cracks, and the triangles along all edges that end there.
  void collect() {
    std::set<std::int32_t> wanted;
    for (const Edge& e : crack_) wanted.insert({e.first, e.second});
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const FaceMesh& face = mesh_.faces[f];
      for (std::size_t t = 0; t < face.triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) {
          const std::int32_t v = face.vertex[face.triangles[t][i]], w = face.vertex[face.triangles[t][(i + 1) % 3]];
          if (wanted.contains(v)) around_[v].push_back({f, t, i});
          if (wanted.contains(v) || wanted.contains(w)) left_[{v, w}] = {f, t, i};
        }
    }
  }

  [[nodiscard]] std::int32_t vertex_of(const Corner& c, int turn) const {
    const FaceMesh& face = mesh_.faces[c.face];
    return face.vertex[face.triangles[c.triangle][(c.rank + turn) % 3]];
  }

  // Corners of one part are linked over edges that are not cracks.
  void part(std::int32_t vertex, const std::vector<Corner>& corners) {
    UnionFind parts(corners.size());
    std::map<std::int32_t, std::size_t> first;  // by the other end of an edge
    for (std::size_t k = 0; k < corners.size(); ++k)
      for (const int turn : {1, 2}) {
        const std::int32_t other = vertex_of(corners[k], turn);
        if (crack_.contains(std::minmax(vertex, other))) continue;
        const auto [known, fresh] = first.try_emplace(other, k);
        if (!fresh) parts.merge(known->second, k);
      }
    std::map<std::size_t, std::int32_t> number{{parts.find(0), vertex}};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto [known, fresh] = number.try_emplace(parts.find(k), static_cast<std::int32_t>(mesh_.vertices.size()));
      if (fresh) {
        mesh_.vertices.push_back(Vec3(mesh_.vertices[vertex]));
        mesh_.vertex_ref.push_back(mesh_.vertex_ref[vertex]);
        if (!result_.vertex_size.empty()) result_.vertex_size.push_back(result_.vertex_size[vertex]);
      }
      if (known->second != vertex) moved_.emplace_back(corners[k], known->second);
    }
  }

  // New local vertices, once all parts are known: one for each place in (u, v) and vertex.
  void renumber() {
    std::map<std::array<std::int32_t, 3>, std::int32_t> local;  // face, local vertex, vertex
    for (const auto& [corner, vertex] : moved_) {
      FaceMesh& face = mesh_.faces[corner.face];
      const std::int32_t old = face.triangles[corner.triangle][corner.rank];
      const auto [known, fresh] = local.try_emplace({static_cast<std::int32_t>(corner.face), old, vertex},
                                                    static_cast<std::int32_t>(face.uv.size()));
      if (fresh) {
        face.uv.push_back(Vec2(face.uv[old]));
        face.vertex.push_back(vertex);
        if (!face.uv_face.empty()) face.uv_face.push_back(face.uv_face[old]);
        if (corner.face < result_.feet.size() && !result_.feet[corner.face].empty())
          result_.feet[corner.face].push_back(result_.feet[corner.face][old]);
      }
      face.triangles[corner.triangle][corner.rank] = known->second;
    }
  }

  // Follows a curve that ends at the end of a crack, on one side of the crack.
  void follow(CurveMesh& curve) {
    std::vector<std::int32_t>& chain = curve.vertices;
    if (chain.size() < 2) return;
    const std::array<Edge, 2> ends{Edge{chain[0], chain[1]}, Edge{chain[chain.size() - 2], chain.back()}};
    for (std::size_t k = 0; k < 2; ++k) {
      const auto [v, w] = ends[k];
      const auto along = left_.find({v, w}), against = left_.find({w, v});
      if (along == left_.end() && against == left_.end()) continue;
      const bool forward = along != left_.end();
      const Corner& at = forward ? along->second : against->second;
      (k == 0 ? chain.front() : chain.back()) = vertex_of(at, (k == 0) == forward ? 0 : 1);
    }
  }

  // Divides a curve into its left side and its right side. The first use of the curve defines its left.
  void divide(std::size_t c) {
    const CurveMesh old = mesh_.curves[c];
    for (const bool forward : {true, false}) {
      CurveMesh side{.ref = old.ref, .vertices = {}, .uses = {}, .mid = {}, .part_of = old.part_of};
      std::vector<std::size_t> ranks;
      for (std::size_t k = 0; k + 1 < old.vertices.size(); ++k) {
        const std::int32_t v = old.vertices[k], w = old.vertices[k + 1];
        const auto beside = left_.find(forward ? Edge{v, w} : Edge{w, v});
        if (beside == left_.end()) continue;
        const Corner& at = beside->second;
        std::int32_t from = vertex_of(at, 0), to = vertex_of(at, 1);
        if (!forward) std::swap(from, to);
        if (!side.vertices.empty() && side.vertices.back() != from) give(c, std::exchange(side.vertices, {}), side, ranks);
        if (side.vertices.empty()) side.vertices = {from}, ranks = {k}, side.mid = {}, side.uses = {{static_cast<std::int32_t>(at.face), false}};
        side.vertices.push_back(to), ranks.push_back(k + 1);
        if (!old.mid.empty()) side.mid.push_back(forward ? old.mid[k] : other_middle(at, old.mid[k]));
      }
      if (side.vertices.size() > 1) give(c, std::exchange(side.vertices, {}), side, ranks);
    }
  }

  // Puts the first part in the place of the curve.
  void give(std::size_t c, std::vector<std::int32_t> vertices, CurveMesh side, const std::vector<std::size_t>& ranks) {
    side.vertices = std::move(vertices);
    const auto pick = [&ranks](const std::vector<double>& all) {
      std::vector<double> some;
      for (const std::size_t k : ranks)
        if (k < all.size()) some.push_back(all[k]);
      return some;
    };
    const std::vector<double> size = c < result_.curve_size.size() ? whole_size(c) : std::vector<double>{};
    const CurveParameters at = c < result_.curve_parameters.size() ? whole_parameters(c) : CurveParameters{};
    const std::size_t place = given_.insert(c).second ? c : mesh_.curves.size();
    if (place == mesh_.curves.size()) mesh_.curves.emplace_back();
    mesh_.curves[place] = std::move(side);
    if (result_.curve_size.size() <= place) result_.curve_size.resize(place + 1);
    result_.curve_size[place] = pick(size);
    if (result_.curve_parameters.size() <= place) result_.curve_parameters.resize(place + 1);
    result_.curve_parameters[place] = {at.face, at.ic, pick(at.t)};
  }
  // Sizes of the curve before its division.
  const std::vector<double>& whole_size(std::size_t c) { return sizes_.try_emplace(c, result_.curve_size[c]).first->second; }
  const CurveParameters& whole_parameters(std::size_t c) {
    return parameters_.try_emplace(c, result_.curve_parameters[c]).first->second;
  }

  /// The node on the other side of an edge of second order.
  std::int32_t other_middle(const Corner& at, std::int32_t middle) {
    const auto fresh = static_cast<std::int32_t>(mesh_.mid_vertices.size());
    mesh_.mid_vertices.push_back(Vec3(mesh_.mid_vertices[middle]));
    FaceMesh& face = mesh_.faces[at.face];
    std::int32_t& local = face.mid[at.triangle][at.rank];
    face.mid_uv.push_back(Vec2(face.mid_uv[local]));
    face.mid_vertex.push_back(fresh);
    local = static_cast<std::int32_t>(face.mid_uv.size()) - 1;
    return fresh;
  }

  CompositeResult& result_;
  SurfaceMesh& mesh_;
  std::vector<std::size_t> cracks_;  // curves
  std::set<Edge> crack_;
  std::map<std::int32_t, std::vector<Corner>> around_;
  std::map<Edge, Corner> left_;  // by the original vertices: the triangle that runs along the edge
  std::vector<std::pair<Corner, std::int32_t>> moved_;
  std::set<std::size_t> given_;
  std::map<std::size_t, std::vector<double>> sizes_;
  std::map<std::size_t, CurveParameters> parameters_;
};

}  // namespace

void open_cracks(CompositeResult& result) { CrackOpener(result).run(); }

}  // namespace carreau
