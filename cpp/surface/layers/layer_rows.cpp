// SPDX-License-Identifier: BSD-3-Clause
#include "surface/layers/layer_rows.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "predicates/polygon_locator.h"
#include "predicates/predicates.h"
#include "support/angles.h"
#include "surface/domain/domain_check.h"
#include "surface/layers/row_face.h"
#include "surface/layers/row_obstacles.h"
#include "surface/layers/surface_step.h"
#include "surface/layers/thresholds.h"

namespace carreau {
namespace {

using namespace thresholds::layers;

class RowMaker {
 public:
  RowMaker(const PatchInput& input, const LayerCurves& layers, Cad& cad, bool halved, std::span<const RowLimit> limits)
      : face_(input, layers, cad, halved), limits_(limits) {}

  std::optional<LayerRows> run() {
    chains_ = find_chains(face_);
    if (chains_.empty()) return {};
    for (RowChain& chain : chains_)
      for (Column& column : chain.columns) raise(column);
    const RowObstacles obstacles(face_);
    for (RowChain& chain : chains_)
      for (Column& column : chain.columns) obstacles.end(column), limit(column);
    int highest = 0;
    for (;;) {
      settle_levels();
      make_cells();
      if (face_.rows.cells.empty()) return {};
      make_rest();
      if (!find_a_crossing(face_.rows.rest.plane)) break;
      highest = highest_level() * 3 / 4;
      if (highest == 0) return {};
      for (RowChain& chain : chains_)
        for (Column& column : chain.columns) column.levels = std::min(column.levels, highest);
    }
    drop_unused_vertices();
    return std::move(face_.rows);
  }

 private:
  // Columns are geodesics: on developable faces rows are as high as in the plane.
  void raise(Column& column) {
    if (column.on_side || !column.stands) return;
    if (!inside_) {
      const SampledDomain sampled = sampled_domain(face_.plane);
      inside_.emplace(sampled.vertices, sampled.edges);
    }
    Vec2 at = face_.uv(column.base);
    Vec3 p = face_.xyz(column.base), towards = column.up;
    for (const double h : column.heights) {
      const double step = h * column.stretch;
      SurfaceJet jet = surface_at(face_.cad, face_.input.ref, want_position | want_first, at);
      const Vec3 normal = RowFace::unit(cross(jet.su, jet.sv));
      towards = RowFace::unit(towards - dot(towards, normal) * normal);
      const ColumnPlane plane{p, cross(normal, towards)};
      Vec2 next = at + in_parameters(jet, step * towards);
      if (!find_step(face_.cad, face_.input.ref, plane, p, step, [this](const Vec2& q) { return inside_->contains(q); }, next, jet))
        break;
      column.at.push_back(add_vertex(next, jet, column));
      // The chord of a geodesic turns half as much as its tangent.
      const Vec3 chord = RowFace::unit(jet.s - p);
      towards = 2 * dot(chord, towards) * chord - towards;
      p = jet.s, at = next;
    }
    column.levels = static_cast<int>(column.at.size()) - 1;
  }

  void limit(Column& column) const {
    const Vec3& base = face_.xyz(column.base);
    for (const RowLimit& limit : limits_)
      if (norm(base - limit.place) <= limit.reach) column.levels = std::min(column.levels, limit.rows);
  }

  int add_vertex(const Vec2& at, const SurfaceJet& jet, const Column& column) {
    face_.rows.uv.push_back(at);
    face_.rows.xyz.push_back(jet.s);
    face_.rows.normal.push_back(RowFace::unit(cross(jet.su, jet.sv)));
    face_.rows.size.push_back(face_.domain.size[static_cast<std::size_t>(column.base)]);
    return static_cast<int>(face_.plane.vertices.size() + face_.rows.uv.size()) - 1;
  }

  // ---- cells ----

  [[nodiscard]] int highest_level() const {
    int highest = 0;
    for (const RowChain& chain : chains_)
      for (const Column& column : chain.columns) highest = std::max(highest, column.levels);
    return highest;
  }

  // Neighbours differ by one row at most, and no cell is turned over.
  void settle_levels() {
    for (RowChain& chain : chains_) {
      std::vector<Column>& all = chain.columns;
      for (bool changed = true; changed;) {
        changed = false;
        const auto lower = [&](Column& column, int most) {
          if (column.levels <= most) return;
          column.levels = most;
          changed = true;
        };
        for (Column& column : all)
          if (!column.stands) lower(column, 0);
        for (int direction = 0; direction < 2; ++direction)
          for (std::size_t i = 0; i < chain.gaps(); ++i) {
            const std::size_t c = direction == 0 ? i : chain.gaps() - 1 - i, d = chain.after(c);
            lower(all[d], all[c].levels + 1), lower(all[c], all[d].levels + 1);
          }
        for (std::size_t c = 0; c < chain.gaps(); ++c) {
          Column &left = all[c], &right = all[chain.after(c)];
          const int most = std::min(left.levels, right.levels);
          for (int k = 0; k < most; ++k) {
            if (is_sound(cell_of(left, right, k), left.base == right.base)) continue;
            lower(left, k), lower(right, k);
            break;
          }
        }
      }
    }
  }

  static LayerCell cell_of(const Column& left, const Column& right, int row) {
    const auto k = static_cast<std::size_t>(row);
    LayerCell cell{.corners = {left.at[k], right.at[k], right.at[k + 1], left.at[k + 1]}, .layers = left.layers, .row = row};
    if (left.at[k] == right.at[k]) cell.corners = {left.at[k], right.at[k + 1], left.at[k + 1], -1};
    return cell;
  }

  [[nodiscard]] bool turns_left(int a, int b, int c) const { return orientation(face_.uv(a), face_.uv(b), face_.uv(c)) > 0; }

  // In (u, v), and in space about the normal of the surface at the upper edge.
  [[nodiscard]] bool turns_left(int a, int b, int c, const Vec3& normal) const {
    const Vec3 area = cross(face_.xyz(b) - face_.xyz(a), face_.xyz(c) - face_.xyz(a));
    return turns_left(a, b, c) && dot(area, normal) > angles::cosine_of_85 * norm(area);
  }
  [[nodiscard]] Vec3 normal_of(int v) const {
    const std::size_t n = face_.plane.vertices.size(), k = static_cast<std::size_t>(v);
    return k >= n ? face_.rows.normal[k - n] : face_.normal_at(v);
  }

  [[nodiscard]] bool is_sound(const LayerCell& cell, bool in_fan) const {
    const auto& [a, b, c, d] = cell.corners;
    if (cell.is_triangle()) return turns_left(a, b, c, RowFace::unit(normal_of(b) + normal_of(c)));
    const Vec3 up = RowFace::unit(normal_of(c) + normal_of(d));
    if (!(turns_left(a, b, c, up) && turns_left(b, c, d, up) && turns_left(c, d, a, up) && turns_left(d, a, b, up))) return false;
    return in_fan || norm(face_.xyz(c) - face_.xyz(d)) >= min_narrowing * norm(face_.xyz(b) - face_.xyz(a));
  }

  void make_cells() {
    face_.rows.cells.clear();
    for (const RowChain& chain : chains_)
      for (std::size_t c = 0; c < chain.gaps(); ++c) {
        const Column &left = chain.columns[c], &right = chain.columns[chain.after(c)];
        for (int k = 0; k < std::min(left.levels, right.levels); ++k) face_.rows.cells.push_back(cell_of(left, right, k));
      }
  }

  // The boundary of the rest is the boundary of the domain, and both sides of internal edges with layers, without the
  // boundaries of the cells.
  void make_rest() {
    std::map<std::array<int, 2>, PlaneEdge> boundary;
    std::vector<PlaneEdge> others;
    for (PlaneEdge edge : face_.plane.edges) {
      const bool internal = edge.kind == PlaneEdgeKind::internal;
      if (edge.kind == PlaneEdgeKind::degenerate || (internal && face_.layers_of(edge) < 0)) {
        others.push_back(edge);
        continue;
      }
      edge.kind = PlaneEdgeKind::boundary;
      boundary.emplace(std::array{edge.a, edge.b}, edge);
      if (!internal) continue;
      std::swap(edge.a, edge.b);
      boundary.emplace(std::array{edge.a, edge.b}, edge);
    }
    for (const LayerCell& cell : face_.rows.cells) {
      const std::size_t n = cell.is_triangle() ? 3 : 4;
      for (std::size_t k = 0; k < n; ++k) {
        const int a = cell.corners[k], b = cell.corners[(k + 1) % n];
        if (boundary.erase({a, b}) > 0) continue;
        PlaneEdge edge;
        edge.a = b, edge.b = a;
        boundary.emplace(std::array{b, a}, edge);
      }
    }
    FaceDomain& rest = face_.rows.rest;
    rest = {};
    face_.rows.rest_xyz.clear(), face_.rows.of_rest.clear();
    const std::size_t n = face_.plane.vertices.size();
    std::vector<int> number(n + face_.rows.uv.size(), -1);
    for (const auto& [ends, edge] : boundary) number[static_cast<std::size_t>(ends[0])] = number[static_cast<std::size_t>(ends[1])] = 0;
    for (const PlaneEdge& edge : others) number[static_cast<std::size_t>(edge.a)] = number[static_cast<std::size_t>(edge.b)] = 0;
    const auto take = [&](std::size_t v) {
      number[v] = static_cast<int>(rest.plane.vertices.size());
      rest.plane.vertices.push_back(face_.uv(static_cast<int>(v)));
      face_.rows.of_rest.push_back(static_cast<std::int32_t>(v));
      const bool given = v < n;
      rest.origin.push_back(given ? face_.domain.origin[v] : DomainVertexOrigin{});
      rest.size.push_back(given ? face_.domain.size[v] : face_.rows.size[v - n]);
      rest.physical.push_back(given ? face_.domain.physical[v] : face_.rows.size[v - n]);
    };
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] < 0 || (v >= face_.on_curves && v < n)) continue;
      take(v);
      face_.rows.rest_xyz.push_back(face_.xyz(static_cast<int>(v)));
    }
    for (std::size_t v = face_.on_curves; v < n; ++v) take(v);
    const auto add = [&](PlaneEdge edge) {
      edge.a = number[static_cast<std::size_t>(edge.a)], edge.b = number[static_cast<std::size_t>(edge.b)];
      rest.plane.edges.push_back(edge);
    };
    for (const PlaneEdge& edge : face_.plane.edges) {
      const bool internal = edge.kind == PlaneEdgeKind::internal, layers = face_.layers_of(edge) >= 0;
      if (internal && layers && boundary.count({edge.a, edge.b}) + boundary.count({edge.b, edge.a}) == 2) {
        boundary.erase({edge.a, edge.b}), boundary.erase({edge.b, edge.a});
        add(edge);
      } else if (edge.kind == PlaneEdgeKind::boundary ? boundary.erase({edge.a, edge.b}) > 0 : !(internal && layers)) {
        add(edge);
      }
    }
    for (const auto& [ends, edge] : boundary) add(edge);
  }

  void drop_unused_vertices() {
    const std::size_t n = face_.plane.vertices.size();
    std::vector<std::int32_t> now(face_.rows.uv.size(), -1);
    const auto for_corners = [&](const auto& use) {
      for (LayerCell& cell : face_.rows.cells)
        for (std::int32_t& v : cell.corners)
          if (v >= static_cast<std::int32_t>(n)) use(v);
    };
    for_corners([&](std::int32_t v) { now[static_cast<std::size_t>(v) - n] = 0; });
    std::size_t count = 0;
    for (std::size_t k = 0; k < now.size(); ++k) {
      if (now[k] < 0) continue;
      face_.rows.uv[count] = face_.rows.uv[k], face_.rows.xyz[count] = face_.rows.xyz[k];
      face_.rows.normal[count] = face_.rows.normal[k], face_.rows.size[count] = face_.rows.size[k];
      now[k] = static_cast<std::int32_t>(n + count++);
    }
    face_.rows.uv.resize(count), face_.rows.xyz.resize(count), face_.rows.normal.resize(count), face_.rows.size.resize(count);
    const auto renumber = [&](std::int32_t& v) { v = now[static_cast<std::size_t>(v) - n]; };
    for_corners(renumber);
    for (std::int32_t& v : face_.rows.of_rest)
      if (v >= static_cast<std::int32_t>(n)) renumber(v);
  }

  RowFace face_;
  std::span<const RowLimit> limits_;
  std::vector<RowChain> chains_;
  std::optional<PolygonLocator> inside_;
};

}  // namespace

std::optional<LayerRows> make_layer_rows(const PatchInput& input, const LayerCurves& layers, Cad& cad, bool halved,
                                         std::span<const RowLimit> limits) {
  return RowMaker(input, layers, cad, halved, limits).run();
}

PatchMesh with_rows(const LayerRows& rows, const FaceDomain& domain, const std::vector<Vec3>& curve_xyz, PatchMesh rest) {
  PatchMesh whole;
  const std::size_t given = domain.plane.vertices.size(), first = given + rows.uv.size(), known = rows.of_rest.size();
  const std::size_t n = first + rest.plane.vertices.size() - known;
  whole.plane.vertices = domain.plane.vertices;
  whole.plane.vertices.insert(whole.plane.vertices.end(), rows.uv.begin(), rows.uv.end());
  whole.plane.vertices.resize(n);
  whole.xyz = curve_xyz;
  whole.xyz.resize(given);
  whole.xyz.insert(whole.xyz.end(), rows.xyz.begin(), rows.xyz.end());
  whole.xyz.resize(n);
  whole.size = domain.size;
  whole.size.insert(whole.size.end(), rows.size.begin(), rows.size.end());
  whole.size.resize(n);
  const bool has_normals = !rest.normal.empty();
  if (has_normals) {
    whole.normal.assign(n, Vec3(0, 0, 0));
    std::copy(rows.normal.begin(), rows.normal.end(), whole.normal.begin() + static_cast<std::ptrdiff_t>(given));
  }
  const auto now = [&](std::int32_t v) {
    const auto k = static_cast<std::size_t>(v);
    return k < known ? rows.of_rest[k] : static_cast<std::int32_t>(first + k - known);
  };
  for (std::size_t v = 0; v < rest.plane.vertices.size(); ++v) {
    const auto k = static_cast<std::size_t>(now(static_cast<std::int32_t>(v)));
    whole.plane.vertices[k] = rest.plane.vertices[v];
    whole.xyz[k] = rest.xyz[v];
    if (v < rest.size.size()) whole.size[k] = rest.size[v];
    if (has_normals && v >= known) whole.normal[k] = rest.normal[v];
  }
  whole.plane.triangles = std::move(rest.plane.triangles);
  for (auto& triangle : whole.plane.triangles)
    for (std::int32_t& v : triangle) v = now(v);
  for (const LayerCell& cell : rows.cells) {
    const auto& [a, b, c, d] = cell.corners;
    whole.plane.triangles.push_back({a, b, c});
    if (cell.is_triangle()) continue;
    const auto at = [&](std::int32_t v) -> const Vec3& { return whole.xyz[static_cast<std::size_t>(v)]; };
    if (norm(at(c) - at(a)) <= norm(at(d) - at(b))) {
      whole.plane.triangles.push_back({a, c, d});
    } else {
      whole.plane.triangles.back() = {a, b, d};
      whole.plane.triangles.push_back({b, c, d});
    }
  }
  whole.excesses = std::move(rest.excesses);
  return whole;
}

}  // namespace carreau
