// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/second_order/quadratic.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "cad/batches.h"
#include "periodic/thresholds.h"
#include "support/rounding_of.h"
#include "surface/carry/carry_faces.h"
#include "surface/elements/base/curve_middles.h"
#include "surface/elements/base/poles.h"
#include "surface/elements/base/thresholds.h"
#include "surface/layers/middle_columns.h"

namespace carreau {

namespace {

using Key = std::array<std::int32_t, 2>;
Key ordered(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// A side of a triangle, by its other local vertex, which is the greater one.
struct Side {
  std::int32_t other, triangle, rank;
  friend auto operator<=>(const Side&, const Side&) = default;
};

/// The sides of a face's triangles by their lesser local vertices, and the sides of each vertex by the greater ones. Diagonals of
/// quadrilaterals are left out: side 2 of the first half, side 0 of the second.
class SideLists {
 public:
  explicit SideLists(const FaceMesh& face) : first_(face.uv.size() + 1, 0) {
    for_sides(face, [&](std::int32_t low, const Side&) { ++first_[low + 1]; });
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    sides_.resize(static_cast<std::size_t>(first_.back()));
    std::vector<std::int32_t> next = first_;
    for_sides(face, [&](std::int32_t low, const Side& side) { sides_[next[low]++] = side; });
    for (std::size_t v = 1; v < first_.size(); ++v) std::sort(sides_.begin() + first_[v - 1], sides_.begin() + first_[v]);
  }
  [[nodiscard]] std::span<const Side> of(std::int32_t low) const {
    return std::span(sides_).subspan(first_[low], first_[low + 1] - first_[low]);
  }
  [[nodiscard]] std::size_t size() const noexcept { return sides_.size(); }

 private:
  template <typename Use>
  static void for_sides(const FaceMesh& face, const Use& use) {
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(face.triangles.size()); ++t)
      for (std::int32_t i = 0; i < 3; ++i) {
        if (t < 2 * face.quads && i == (t % 2 == 0 ? 2 : 0)) continue;
        const auto& v = face.triangles[t];
        const Key key = ordered(v[i], v[(i + 1) % 3]);
        use(key[0], Side{key[1], t, i});
      }
  }
  std::vector<std::int32_t> first_;
  std::vector<Side> sides_;
};

/// Nodes of edges that lie on curves, by the vertices of the edge.
class CurveNodes {
 public:
  CurveNodes(const ElementWork& work, const std::vector<CuspEnd>& cusps) : mesh_(work.result.mesh) {
    const auto is_cusp = [&](std::size_t c, std::size_t k, bool first) {
      const CuspEnd end{static_cast<std::int32_t>(c), static_cast<std::int32_t>(k), first};
      return std::binary_search(cusps.begin(), cusps.end(), end);
    };
    EdgeMiddles middles(work);
    middles_.resize(mesh_.curves.size());
    for (std::size_t c = 0; c < mesh_.curves.size(); ++c) {
      CurveMesh& curve = mesh_.curves[c];
      curve.mid.clear();
      for (std::size_t k = 0; k + 1 < curve.vertices.size(); ++k) {
        const int shifts = (is_cusp(c, k, true) ? 1 : 0) - (is_cusp(c, k, false) ? 1 : 0);
        middles_[c].push_back(middles.at(c, k, shifts * thresholds::elements::shift_at_cusp));
        std::int32_t& node = node_of(ordered(curve.vertices[k], curve.vertices[k + 1]));
        if (node < 0 && middles_[c].back()) node = add(middles_[c].back()->xyz);
      }
    }
  }

  /// -1: the first face that holds the edge computes the node.
  std::int32_t& node_of(const Key& key) { return nodes_.try_emplace(key, -1).first->second; }
  [[nodiscard]] std::optional<Vec2> uv(const CurveSide& side) const {
    const std::optional<CurveMiddle>& middle = middles_[side.curve][side.segment];
    if (!middle || side.use < 0) return std::nullopt;
    return middle->uv_of_use[static_cast<std::size_t>(side.use)];
  }
  std::int32_t add(const Vec3& p) {
    mesh_.mid_vertices.push_back(p);
    return static_cast<std::int32_t>(mesh_.mid_vertices.size()) - 1;
  }
  /// When all faces are done.
  void tell_curves() {
    for (CurveMesh& curve : mesh_.curves)
      for (std::size_t k = 0; k + 1 < curve.vertices.size(); ++k) {
        const std::int32_t a = curve.vertices[k], b = curve.vertices[k + 1];
        std::int32_t& node = node_of(ordered(a, b));
        if (node < 0) node = add(0.5 * (mesh_.vertices[a] + mesh_.vertices[b]));
        curve.mid.push_back(node);
      }
  }

 private:
  SurfaceMesh& mesh_;
  std::vector<std::vector<std::optional<CurveMiddle>>> middles_;  // [curve][edge]
  std::map<Key, std::int32_t> nodes_;
};

/// The nodes of one face.
class FaceNodes {
 public:
  FaceNodes(const ElementWork& work, std::size_t f, CurveNodes& of_curves)
      : work_(work), of_curves_(of_curves), f_(f), face_(work.result.mesh.faces[f]), poles_(face_) {}

  void run() {
    face_.mid.assign(face_.triangles.size(), {-1, -1, -1});
    face_.mid_uv.clear(), face_.mid_vertex.clear();
    number_sides();
    place_in_plane();
    place_on_curves();
    place_in_rows();
    join_at_poles();
    place_inside();
  }
  /// Returns whether a node is fixed; index as in mid_uv.
  [[nodiscard]] std::vector<char> fixed_mids() const { return fixed_; }
  /// `uses`: the number of faces of each vertex in space.
  [[nodiscard]] std::vector<char> fixed_vertices(const std::vector<std::int32_t>& uses) const {
    std::vector<char> fixed(face_.uv.size(), 0);
    for (const CurveSide& side : sides_) fixed[side.a] = fixed[side.b] = 1;
    for (const auto& t : face_.flattened)
      for (const std::int32_t v : t) fixed[v] = 1;
    for (std::size_t v = 0; v < fixed.size(); ++v)
      if (work_.result.mesh.vertex_ref[face_.vertex[v]] != 0 || uses[face_.vertex[v]] > 1) fixed[v] = 1;
    if (work_.has_layers(f_))
      for (const LayerCell& cell : (*work_.layers)[f_])
        for (const std::int32_t v : cell.corners)
          if (v >= 0) fixed[v] = 1;
    return fixed;
  }

 private:
  static constexpr char follows = 2;  // in fixed_: the node follows the node of a second edge

  void number_sides() {
    const SideLists lists(face_);
    edges_.reserve(lists.size() / 2 + face_.uv.size());
    for (std::int32_t low = 0; low < static_cast<std::int32_t>(face_.uv.size()); ++low)
      for (const Side& side : lists.of(low)) {
        const Key key{low, side.other};
        if (edges_.empty() || edges_.back() != key) edges_.push_back(key);
        face_.mid[side.triangle][side.rank] = static_cast<std::int32_t>(edges_.size()) - 1;
      }
    face_.mid_vertex.assign(edges_.size(), -1);
    fixed_.assign(edges_.size(), 0);
  }

  void place_in_plane() {
    face_.mid_uv.resize(edges_.size());
    const std::optional<ControlSpace>& space = work_.result.spaces[f_];
    if (space) {
      metrics_.reserve(face_.uv.size());
      for (const Vec2& p : face_.uv) metrics_.push_back(space->at(p));
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) face_.mid_uv[e] = middle_uv(edges_[e]);
  }

  [[nodiscard]] Vec2 middle_uv(const Key& edge) const {
    const Vec2 p = poles_.arrival(edge[0], edge[1]), q = poles_.arrival(edge[1], edge[0]), d = q - p;
    const std::optional<ControlSpace>& space = work_.result.spaces[f_];
    if (!space) return 0.5 * (p + q);
    const auto at_end = [&](std::int32_t v, const Vec2& at) {
      return length(at == face_.uv[v] ? metrics_[v] : space->at(at), d);
    };
    return lerp(p, q, metric_middle(at_end(edge[0], p), length(space->at(0.5 * (p + q)), d), at_end(edge[1], q)));
  }

  [[nodiscard]] Key in_space(std::size_t edge) const {
    return ordered(face_.vertex[edges_[edge][0]], face_.vertex[edges_[edge][1]]);
  }

  void place_on_curves() {
    sides_ = curve_sides(work_, f_);
    for (const CurveSide& side : sides_) {
      const auto found = std::lower_bound(edges_.begin(), edges_.end(), Key{side.a, side.b});
      if (found == edges_.end() || *found != Key{side.a, side.b}) continue;
      const auto e = static_cast<std::size_t>(found - edges_.begin());
      fixed_[e] = 1;
      face_.mid_vertex[e] = of_curves_.node_of(in_space(e));
      if (const std::optional<Vec2> uv = of_curves_.uv(side)) face_.mid_uv[e] = *uv;
    }
  }

  [[nodiscard]] std::optional<std::size_t> edge_between(std::int32_t a, std::int32_t b) const {
    const Key key = ordered(a, b);
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), key);
    if (found == edges_.end() || *found != key) return {};
    return static_cast<std::size_t>(found - edges_.begin());
  }

  // Nodes of rows lie above the node of the curve, and nodes of diagonals halfway between two of them.
  void place_in_rows() {
    if (!work_.has_layers(f_)) return;
    const std::span<const LayerCell> cells((*work_.layers)[f_]);
    std::vector<Key> above;  // a vertex, and the vertex above it
    for (const LayerCell& cell : cells) {
      above.push_back({cell.corners[0], cell.corners[cell.is_triangle() ? 2 : 3]});
      above.push_back({cell.corners[cell.is_triangle() ? 0 : 1], cell.corners[cell.is_triangle() ? 1 : 2]});
    }
    std::sort(above.begin(), above.end());
    above.erase(std::unique(above.begin(), above.end()), above.end());
    // If the next column is higher, an edge rises over a bent edge by one row. It bends like the edge.
    const auto bend_step = [&](std::int32_t a, std::int32_t b, const Vec2& middle) {
      for (const auto& [low, high] : {Key{a, b}, Key{b, a}})
        for (auto up = std::lower_bound(above.begin(), above.end(), Key{high, 0}); up != above.end() && (*up)[0] == high; ++up)
          if (const auto edge = edge_between(low, (*up)[1]); edge && fixed_[*edge] == 0)
            face_.mid_uv[*edge] = middle + 0.5 * (face_.uv[(*up)[1]] - face_.uv[high]);
    };
    for (const CurveSide& side : sides_)
      if (const auto edge = edge_between(side.a, side.b)) bend_step(side.a, side.b, face_.mid_uv[*edge]);
    const auto place = [&](std::int32_t v) { return ColumnPlace{face_.uv[v], work_.result.mesh.vertices[face_.vertex[v]]}; };
    for (const auto& [first, end] : piles_of(cells)) {
      const PileSides sides(cells.subspan(first, end - first));
      ColumnPlace base = place(sides.left.front());
      if (sides.left.front() != sides.right.front()) {
        const std::optional<std::size_t> edge = edge_between(sides.left.front(), sides.right.front());
        if (!edge || face_.mid_vertex[*edge] < 0) continue;
        base = {face_.mid_uv[*edge], work_.result.mesh.mid_vertices[face_.mid_vertex[*edge]]};
      }
      std::vector<ColumnPlace> left, right;
      for (const std::int32_t v : sides.left) left.push_back(place(v));
      for (const std::int32_t v : sides.right) right.push_back(place(v));
      const std::vector<ColumnPlace> column = middle_column(work_.cad(), face_.ref, base, left, right);
      for (std::size_t k = 1; k < column.size(); ++k) {
        if (const auto edge = edge_between(sides.left[k], sides.right[k])) face_.mid_uv[*edge] = column[k].uv;
        const Vec2 centre = 0.5 * (column[k - 1].uv + column[k].uv);
        if (sides.left[k - 1] == sides.right[k - 1]) continue;
        for (const auto& [a, b] : {std::pair{sides.left[k - 1], sides.right[k]}, std::pair{sides.right[k - 1], sides.left[k]}})
          if (const auto edge = edge_between(a, b)) face_.mid_uv[*edge] = centre;
      }
      bend_step(sides.left.back(), sides.right.back(), column.back().uv);
    }
  }

  // Edges to a pole that are one in space, though a flattened triangle lies between them in (u, v).
  void join_at_poles() {
    if (face_.flattened.empty()) return;
    std::map<Key, std::size_t> first;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (fixed_[e] != 0) continue;
      const auto [found, is_new] = first.try_emplace(in_space(e), e);
      if (is_new) continue;
      joined_.emplace_back(found->second, e);
      fixed_[found->second] = 1, fixed_[e] = follows;
      face_.mid_uv[found->second] = face_.mid_uv[e] = 0.5 * (face_.mid_uv[found->second] + face_.mid_uv[e]);
    }
  }

  void place_inside() {
    std::vector<std::size_t> asked;
    std::vector<Vec2> uv;
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (face_.mid_vertex[e] < 0 && fixed_[e] != follows) asked.push_back(e), uv.push_back(face_.mid_uv[e]);
    for_batches(work_.cad(), face_.ref, want_position, uv, work_.monitor,
                [&](std::size_t begin, std::span<const Vec2> here, std::span<const SurfaceJet> jets) {
                  for (std::size_t k = 0; k < here.size(); ++k) {
                    const std::size_t e = asked[begin + k];
                    if (fixed_[e] == 0 || is_joined(e)) {
                      face_.mid_vertex[e] = of_curves_.add(jets[k].s);
                    } else {
                      std::int32_t& node = of_curves_.node_of(in_space(e));
                      if (node < 0) node = of_curves_.add(jets[k].s);
                      face_.mid_vertex[e] = node;
                    }
                  }
                });
    for (const auto& [from, to] : joined_) face_.mid_vertex[to] = face_.mid_vertex[from];
  }

  [[nodiscard]] bool is_joined(std::size_t e) const {
    return std::any_of(joined_.begin(), joined_.end(), [&](const auto& pair) { return pair.first == e; });
  }

  const ElementWork& work_;
  CurveNodes& of_curves_;
  std::size_t f_;
  FaceMesh& face_;
  Poles poles_;
  std::vector<Key> edges_;             // by index in mid_uv
  std::vector<Metric2> metrics_;       // by local vertex; empty: without a control space
  std::vector<char> fixed_;
  std::vector<CurveSide> sides_;
  std::vector<std::pair<std::size_t, std::size_t>> joined_;
};

bool is_slave(const ElementWork& work, std::size_t face) {
  return work.periodic != nullptr && work.periodic->pair_of_slave[face] >= 0;
}

// Nodes and vertices of slaves go where their masters' are.
void follow_masters(const ElementWork& work, const std::vector<std::vector<char>>& fixed_vertices,
                    const std::vector<std::vector<char>>& fixed_mids, QuadraticReport& report) {
  for (const FacePair& pair : work.periodic->pairs) {
    const auto slave = static_cast<std::size_t>(pair.slave);
    if (fixed_vertices[slave].empty()) continue;
    follow_master(work.cad(), pair, fixed_vertices[slave], fixed_mids[slave], rounding_of::places * work.periodic->gap,
                  work.result.mesh);
    find_invalid(work, slave, report);
  }
}

template <typename Element>
void sort_uniquely(std::vector<Element>& all) {
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

}  // namespace

void part_quads(FaceMesh& face, const std::vector<std::int32_t>& quads) {
  std::vector<std::array<std::int32_t, 3>> halves;
  for (auto quad = quads.rbegin(); quad != quads.rend(); ++quad) {
    const auto first = face.triangles.begin() + 2 * static_cast<std::ptrdiff_t>(*quad);
    halves.insert(halves.end(), first, first + 2);
    face.triangles.erase(first, first + 2);
    --face.quads;
  }
  face.triangles.insert(face.triangles.end(), halves.begin(), halves.end());
  face.mid.clear(), face.mid_uv.clear(), face.mid_vertex.clear();
}

QuadraticReport make_quadratic(const ElementWork& work, const std::vector<CuspEnd>& cusps) {
  QuadraticReport report;
  SurfaceMesh& mesh = work.result.mesh;
  mesh.mid_vertices.clear();
  report.quads.resize(mesh.faces.size());
  CurveNodes of_curves(work, cusps);
  std::vector<std::int32_t> uses(mesh.vertices.size(), 0);
  for (const FaceMesh& face : mesh.faces)
    for (const std::int32_t v : face.vertex) ++uses[v];
  std::vector<std::size_t> doubtful;
  std::vector<std::vector<char>> fixed_vertices(mesh.faces.size()), fixed_mids(mesh.faces.size());  // of slaves
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.faces[f].triangles.empty()) continue;
    FaceNodes nodes(work, f, of_curves);
    nodes.run();
    if (is_slave(work, f)) {
      fixed_vertices[f] = nodes.fixed_vertices(uses), fixed_mids[f] = nodes.fixed_mids();
      continue;
    }
    if (!mend_face(work, f, nodes.fixed_mids(), nodes.fixed_vertices(uses), report)) doubtful.push_back(f);
  }
  for (const std::size_t f : doubtful) find_invalid(work, f, report);
  if (work.periodic != nullptr) follow_masters(work, fixed_vertices, fixed_mids, report);
  of_curves.tell_curves();
  sort_uniquely(report.cusps);
  return report;
}

}  // namespace carreau
