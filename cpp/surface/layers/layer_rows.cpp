// SPDX-License-Identifier: BSD-3-Clause
#include "surface/layers/layer_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "predicates/polygon_locator.h"
#include "predicates/predicates.h"
#include "support/box_tree.h"
#include "surface/domain/domain_check.h"
#include "surface/layers/thresholds.h"

namespace carreau {
namespace {

using namespace thresholds::layers;

constexpr double degree = std::numbers::pi / 180;

/// A column of vertices that rises from a vertex of a curve.
struct Column {
  int base = -1;    ///< vertex of the domain
  int layers = -1;  ///< index of the layers
  bool on_side = false;  ///< its vertices lie on a curve that ends at the base
  bool stands = true;    ///< false: the corner has no column
  bool is_turned = false;  ///< it belongs to a fan or to a corner
  Vec3 normal{0, 0, 0};  ///< of the surface
  Vec3 up{0, 0, 0};      ///< unit tangent vector across the curve
  Vec3 along{0, 0, 0};   ///< unit tangent vector along the curve
  double stretch = 1;    ///< length along `up` for each height
  double lean = 0;       ///< of the column along the curve, for each height
  std::vector<double> heights;
  std::vector<int> at;  ///< vertices of the whole, the base first
  int levels = 0;       ///< rows that reach this column
};

/// Columns along a run of edges of curves with layers, in the direction of the boundary.
struct Chain {
  std::vector<Column> columns;
  bool closed = false;
  [[nodiscard]] std::size_t gaps() const { return closed ? columns.size() : columns.size() - 1; }
  [[nodiscard]] std::size_t after(std::size_t c) const { return c + 1 == columns.size() ? 0 : c + 1; }
};

/// A boundary edge, or an imposed point, that rows must not reach.
struct Obstacle {
  Vec3 a, b;
  Vec3 up{0, 0, 0};  ///< across the curve into the face, if it has layers
  double total = 0;  ///< height of all of its rows; 0: none
};

Vec3 nearest_on(const Obstacle& edge, const Vec3& p) {
  const Vec3 along = edge.b - edge.a;
  const double length2 = dot(along, along);
  const double share = length2 > 0 ? std::clamp(dot(p - edge.a, along) / length2, 0.0, 1.0) : 0;
  return edge.a + share * along;
}

Vec3 unit(const Vec3& v) {
  const double length = norm(v);
  return length > 0 ? Vec3((1 / length) * v) : Vec3(0, 0, 0);
}

class RowMaker {
 public:
  RowMaker(const PatchInput& input, const LayerCurves& layers, Cad& cad)
      : input_(input),
        layers_(layers),
        domain_(*input.domain),
        plane_(domain_.plane),
        cad_(cad),
        on_curves_(input.curve_xyz.size()) {}

  std::optional<LayerRows> run() {
    if (!find_chains()) return {};
    find_obstacles();
    for (Chain& chain : chains_)
      for (Column& column : chain.columns) raise(column);
    for (Chain& chain : chains_)
      for (Column& column : chain.columns) end_before_obstacles(column);
    int highest = 0;
    for (;;) {
      settle_levels();
      make_cells();
      if (rows_.cells.empty()) return {};
      make_rest();
      if (!find_a_crossing(rows_.rest.plane)) break;
      highest = highest_level() * 3 / 4;
      if (highest == 0) return {};
      for (Chain& chain : chains_)
        for (Column& column : chain.columns) column.levels = std::min(column.levels, highest);
    }
    drop_unused_vertices();
    return std::move(rows_);
  }

 private:
  [[nodiscard]] int layers_of(const PlaneEdge& edge) const {
    return edge.kind == PlaneEdgeKind::boundary && is_on_curve(edge.a) && is_on_curve(edge.b) ? layers_.of_curve(edge.curve)
                                                                                               : -1;
  }
  [[nodiscard]] bool is_on_curve(int v) const { return static_cast<std::size_t>(v) < on_curves_; }
  [[nodiscard]] const Vec3& xyz(int v) const {
    const auto k = static_cast<std::size_t>(v);
    return k < on_curves_ ? input_.curve_xyz[k] : rows_.xyz[k - plane_.vertices.size()];
  }
  [[nodiscard]] const Vec2& uv(int v) const {
    const auto k = static_cast<std::size_t>(v);
    return k < plane_.vertices.size() ? plane_.vertices[k] : rows_.uv[k - plane_.vertices.size()];
  }

  // ---- chains ----

  bool find_chains() {
    const std::size_t n = plane_.vertices.size(), edges = plane_.edges.size();
    constexpr int none = -1, several = -2;
    std::vector<int> leaving(n, none), arriving(n, none);
    const auto note = [](int& at, std::size_t e) { at = at == none ? static_cast<int>(e) : several; };
    bool any = false;
    for (std::size_t e = 0; e < edges; ++e) {
      const PlaneEdge& edge = plane_.edges[e];
      any = any || layers_of(edge) >= 0;
      if (edge.kind == PlaneEdgeKind::internal) continue;
      note(leaving[static_cast<std::size_t>(edge.a)], e), note(arriving[static_cast<std::size_t>(edge.b)], e);
    }
    if (!any) return false;
    const auto edge_at = [&](const std::vector<int>& at, int v) -> const PlaneEdge* {
      const int e = at[static_cast<std::size_t>(v)];
      return e >= 0 ? &plane_.edges[static_cast<std::size_t>(e)] : nullptr;
    };
    const auto with_layers = [&](const PlaneEdge* edge) { return edge != nullptr && layers_of(*edge) >= 0; };
    std::vector<char> seen(edges, 0);
    const auto follow = [&](std::size_t first) {
      std::vector<const PlaneEdge*> run;
      for (const PlaneEdge* edge = &plane_.edges[first]; with_layers(edge);) {
        const auto e = static_cast<std::size_t>(edge - plane_.edges.data());
        if (seen[e] != 0) break;
        seen[e] = 1;
        run.push_back(edge);
        edge = edge_at(leaving, edge->b);
        if (edge != nullptr && edge_at(arriving, edge->a) == nullptr) break;
      }
      return run;
    };
    for (const bool closed : {false, true})
      for (std::size_t e = 0; e < edges; ++e) {
        const PlaneEdge& edge = plane_.edges[e];
        if (seen[e] != 0 || layers_of(edge) < 0) continue;
        if (!closed && with_layers(edge_at(arriving, edge.a)) && edge_at(leaving, edge.a) != nullptr) continue;
        make_chain(follow(e), closed, edge_at(arriving, edge.a), leaving, arriving);
      }
    return true;
  }

  void make_chain(const std::vector<const PlaneEdge*>& run, bool closed, const PlaneEdge* before,
                  const std::vector<int>& leaving, const std::vector<int>& arriving) {
    Chain chain;
    chain.closed = closed && run.back()->b == run.front()->a;
    const std::size_t n = run.size();
    if (!chain.closed) add_end(chain, *run.front(), before, true, arriving);
    for (std::size_t k = chain.closed ? 0 : 1; k < n; ++k) add_corner(chain, *run[k == 0 ? n - 1 : k - 1], *run[k]);
    if (!chain.closed) {
      const int e = leaving[static_cast<std::size_t>(run.back()->b)];
      add_end(chain, *run.back(), e >= 0 ? &plane_.edges[static_cast<std::size_t>(e)] : nullptr, false, leaving);
    }
    if (chain.columns.size() < 2) return;
    lean_at_corners(chain);
    chains_.push_back(std::move(chain));
  }

  // The normal of the surface; zero where the parametrisation is degenerate.
  [[nodiscard]] Vec3 normal_at(int v) const {
    const SurfaceJet jet = surface_at(cad_, input_.ref, want_position | want_first, uv(v));
    return unit(cross(jet.su, jet.sv));
  }
  [[nodiscard]] Vec3 direction(const PlaneEdge& edge) const { return unit(xyz(edge.b) - xyz(edge.a)); }
  [[nodiscard]] double length(const PlaneEdge& edge) const { return norm(xyz(edge.b) - xyz(edge.a)); }

  [[nodiscard]] Column column_at(int v, const PlaneEdge& edge, double longest) const {
    Column column;
    column.base = v;
    column.at = {v};
    column.layers = layers_of(edge);
    column.normal = normal_at(v);
    column.heights = layers_.heights(column.layers, longest);
    column.stands = norm(column.normal) > 0;
    return column;
  }

  // Between two edges with layers.
  void add_corner(Chain& chain, const PlaneEdge& before, const PlaneEdge& after) {
    Column column = column_at(after.a, after, 0.5 * (length(before) + length(after)));
    const Vec3 in = direction(before), out = direction(after);
    const Vec3 up_in = unit(cross(column.normal, in)), up_out = unit(cross(column.normal, out));
    const double turn = std::atan2(dot(cross(in, out), column.normal), dot(in, out));
    const double inside = 180 - turn / degree;
    column.along = unit(in + out);
    if (inside > min_fan_angle) {
      const int steps = static_cast<int>(std::ceil(std::abs(turn) / (fan_step * degree)));
      for (int k = 0; k <= steps; ++k) {
        const double angle = turn * k / steps;
        Column ray = column;
        ray.is_turned = true;
        ray.up = unit(std::cos(angle) * up_in + std::sin(angle) * cross(column.normal, up_in));
        ray.along = cross(ray.up, column.normal);
        chain.columns.push_back(std::move(ray));
      }
      return;
    }
    column.stands = column.stands && inside >= min_column_angle;
    column.up = unit(up_in + up_out);
    column.along = cross(column.up, column.normal);
    column.stretch = 1 / std::max(std::cos(0.5 * turn), 0.1);
    if (turn > min_lean_angle * degree) {
      column.is_turned = true;
      column.lean = std::tan(0.5 * turn);  // read by lean_at_corners() alone
    }
    chain.columns.push_back(std::move(column));
  }

  // The first or last vertex; `other`: the edge beside it, which has no layers.
  void add_end(Chain& chain, const PlaneEdge& edge, const PlaneEdge* other, bool first, const std::vector<int>& next_edge) {
    const int v = first ? edge.a : edge.b;
    Column column = column_at(v, edge, length(edge));
    column.along = direction(edge);
    column.up = unit(cross(column.normal, column.along));
    column.along = cross(column.up, column.normal);
    if (other == nullptr || !is_on_curve(other->a) || !is_on_curve(other->b) || !(length(*other) > 0)) {
      column.stands = false;
      chain.columns.push_back(std::move(column));
      return;
    }
    const Vec3 side = unit(xyz(first ? other->a : other->b) - xyz(v));
    const Vec3 inward = first ? column.along : Vec3(-column.along);
    const double sine = dot(side, column.up), cosine = dot(side, inward);
    if (sine > min_sine_of_side) {
      column.on_side = column.is_turned = true;
      column.lean = cosine / sine;  // towards the layers if positive
      follow_side(column, other, sine, first, next_edge);
    } else if (cosine > 0) {
      column.stands = false;
    }
    chain.columns.push_back(std::move(column));
  }

  // Vertices of the side are vertices of rows as long as they lie near their heights.
  void follow_side(Column& column, const PlaneEdge* edge, double sine, bool first, const std::vector<int>& next_edge) const {
    const int curve = edge->curve;
    for (const double h : column.heights) {
      const double there = length(*edge) * sine;
      if (!(there > 0.6 * h && there < 1.6 * h)) break;
      const int next = first ? edge->a : edge->b;
      column.at.push_back(next);
      const int e = next_edge[static_cast<std::size_t>(next)];
      if (e < 0) break;
      edge = &plane_.edges[static_cast<std::size_t>(e)];
      if (edge->curve != curve || edge->kind != PlaneEdgeKind::boundary) break;
    }
    column.levels = static_cast<int>(column.at.size()) - 1;
  }

  // Columns beside a corner lean as its column does, less and less.
  void lean_at_corners(Chain& chain) {
    std::vector<Column>& all = chain.columns;
    std::vector<double> lean(all.size(), 0);
    const auto spread = [&](std::size_t from, bool forward, double tangent) {
      double total = 0;
      for (const double h : all[from].heights) total += h;
      const double reach = lean_reach * total * std::abs(tangent);
      double x = 0;
      for (std::size_t c = from, steps = 0; steps + 1 < all.size(); ++steps) {
        if (!chain.closed && (forward ? c + 1 == all.size() : c == 0)) break;
        const std::size_t next = forward ? chain.after(c) : c == 0 ? all.size() - 1 : c - 1;
        x += norm(xyz(all[next].base) - xyz(all[c].base));
        c = next;
        if (all[c].is_turned || !all[c].stands || !(x < reach)) break;
        lean[c] += (forward ? 1 : -1) * tangent * (1 - x / reach);
      }
    };
    for (std::size_t c = 0; c < all.size(); ++c) {
      if (!all[c].stands || all[c].lean == 0) continue;
      if (!all[c].on_side || c == 0) spread(c, true, all[c].lean);
      if (!all[c].on_side || c > 0) spread(c, false, all[c].lean);
    }
    for (std::size_t c = 0; c < all.size(); ++c) {
      all[c].lean = lean[c];
      if (lean[c] == 0) continue;
      const Vec3 direction = all[c].up + lean[c] * all[c].along;
      all[c].stretch *= norm(direction);
      all[c].up = unit(direction);
    }
  }

  // ---- columns ----

  void raise(Column& column) {
    if (column.on_side || !column.stands) return;
    if (!inside_) {
      const SampledDomain sampled = sampled_domain(plane_);
      inside_.emplace(sampled.vertices, sampled.edges);
    }
    const Vec3 across = unit(cross(column.normal, column.up)), base = xyz(column.base);
    Vec2 at = uv(column.base);
    Vec3 p = base, towards = column.up;
    for (const double h : column.heights) {
      const double step = h * column.stretch;
      SurfaceJet jet = surface_at(cad_, input_.ref, want_position | want_first, at);
      Vec2 next = at + solved(jet, step * towards);
      if (!find(base, across, p, step, next, jet)) break;
      column.at.push_back(add_vertex(next, jet, column));
      towards = unit(jet.s - p);
      p = jet.s, at = next;
    }
    column.levels = static_cast<int>(column.at.size()) - 1;
  }

  // (u, v) of a vector, which is projected onto the tangent plane.
  static Vec2 solved(const SurfaceJet& jet, const Vec3& v) {
    const double e = dot(jet.su, jet.su), f = dot(jet.su, jet.sv), g = dot(jet.sv, jet.sv), det = e * g - f * f;
    const double a = dot(jet.su, v), b = dot(jet.sv, v);
    if (!(det > 0)) return {0, 0};
    return {(g * a - f * b) / det, (e * b - f * a) / det};
  }

  // Newton's method for the place at this distance from p in the plane through `base` that `across` is normal to.
  bool find(const Vec3& base, const Vec3& across, const Vec3& p, double step, Vec2& at, SurfaceJet& jet) {
    double best = infinity;
    const double noise = 4e-16 * (norm(p) + step);
    for (int k = 0; k < max_newton_steps; ++k) {
      if (!is_finite(at) || !inside_->contains(at)) return false;
      jet = surface_at(cad_, input_.ref, want_position | want_first, at);
      const Vec3 from = jet.s - p;
      const double length = norm(from);
      if (!(length > 0)) return false;
      const double off = dot(jet.s - base, across), error = length - step;
      const double worst = std::max(std::abs(off), std::abs(error));
      if (worst <= std::max(1e-12 * step, noise) || (worst >= best && best <= 1e-9 * step)) return true;
      best = std::min(best, worst);
      const Vec3 radial = (1 / length) * from;
      const double a = dot(jet.su, across), b = dot(jet.sv, across), c = dot(jet.su, radial), d = dot(jet.sv, radial);
      const double det = a * d - b * c;
      if (!(std::abs(det) > 0)) return false;
      at = at - Vec2((d * off - b * error) / det, (a * error - c * off) / det);
    }
    const double off = std::abs(dot(jet.s - base, across)), error = std::abs(norm(jet.s - p) - step);
    return off <= max_side_error * step && error <= max_height_error * step;
  }

  int add_vertex(const Vec2& at, const SurfaceJet& jet, const Column& column) {
    rows_.uv.push_back(at);
    rows_.xyz.push_back(jet.s);
    rows_.normal.push_back(unit(cross(jet.su, jet.sv)));
    rows_.size.push_back(domain_.size[static_cast<std::size_t>(column.base)]);
    return static_cast<int>(plane_.vertices.size() + rows_.uv.size()) - 1;
  }

  // ---- obstacles ----

  void find_obstacles() {
    for (const PlaneEdge& edge : plane_.edges) {
      if (!is_on_curve(edge.a) || !is_on_curve(edge.b)) continue;
      Obstacle obstacle{.a = xyz(edge.a), .b = xyz(edge.b)};
      if (const int layers = layers_of(edge); layers >= 0) {
        obstacle.up = unit(cross(normal_at(edge.a), direction(edge)));
        for (const double h : layers_.heights(layers, length(edge))) obstacle.total += h;
      }
      obstacles_.push_back(obstacle);
    }
    for (std::size_t v = on_curves_; v < plane_.vertices.size(); ++v) {
      const Vec3 p = surface_at(cad_, input_.ref, want_position, plane_.vertices[v]).s;
      obstacles_.push_back({.a = p, .b = p});
    }
    std::vector<BoxTree::Box> boxes;
    std::vector<Vec3> centres;
    for (const Obstacle& obstacle : obstacles_) {
      boxes.emplace_back().add(obstacle.a), boxes.back().add(obstacle.b);
      centres.push_back(0.5 * (obstacle.a + obstacle.b));
    }
    tree_ = BoxTree(boxes, centres);
  }

  void end_before_obstacles(Column& column) {
    if (column.on_side || !column.stands) return;
    double total = 0;
    for (const double h : column.heights) total += h;
    const Vec3 base = xyz(column.base);
    const double reach = (2 * total + column.heights.back()) * std::max(1.0, column.stretch) + total;
    std::vector<const Obstacle*> near;
    tree_.all_that_meet([&](const BoxTree::Box& box) { return box.squared_distance(base) <= reach * reach; },
                        [&](const BoxTree::Node& leaf) {
                          for (const std::int32_t k : tree_.things(leaf)) near.push_back(&obstacles_[static_cast<std::size_t>(k)]);
                        });
    double height = 0;
    for (int k = 0; k < column.levels; ++k) {
      const double h = column.heights[static_cast<std::size_t>(k)];
      height += h;
      const Vec3& p = xyz(column.at[static_cast<std::size_t>(k) + 1]);
      const bool free = std::all_of(near.begin(), near.end(), [&](const Obstacle* o) { return is_clear(column, *o, p, height, h); });
      if (!free) {
        column.levels = k;
        return;
      }
    }
  }

  [[nodiscard]] bool is_clear(const Column& column, const Obstacle& obstacle, const Vec3& p, double height, double row) const {
    const Vec3 nearest = nearest_on(obstacle, p);
    const double distance = norm(nearest - p);
    if (!(obstacle.total > 0)) {
      if (nearest == xyz(column.base)) return true;
      return distance >= wall_clearance * row;
    }
    const Vec3 plain_up = unit(column.up - dot(column.up, column.along) * column.along);
    const bool faces = dot(obstacle.up, plain_up) < facing_cosine && dot(nearest - xyz(column.base), plain_up) > min_ahead * height;
    return distance >= (faces ? std::min(height, obstacle.total) + row : min_clearance * height);
  }

  // ---- cells ----

  [[nodiscard]] int highest_level() const {
    int highest = 0;
    for (const Chain& chain : chains_)
      for (const Column& column : chain.columns) highest = std::max(highest, column.levels);
    return highest;
  }

  // Neighbours differ by one row at most, and no cell is turned over.
  void settle_levels() {
    for (Chain& chain : chains_) {
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

  [[nodiscard]] bool turns_left(int a, int b, int c) const { return orientation(uv(a), uv(b), uv(c)) > 0; }

  [[nodiscard]] bool is_sound(const LayerCell& cell, bool in_fan) const {
    const auto& [a, b, c, d] = cell.corners;
    if (cell.is_triangle()) return turns_left(a, b, c);
    if (!(turns_left(a, b, c) && turns_left(b, c, d) && turns_left(c, d, a) && turns_left(d, a, b))) return false;
    return in_fan || norm(xyz(c) - xyz(d)) >= min_narrowing * norm(xyz(b) - xyz(a));
  }

  void make_cells() {
    rows_.cells.clear();
    for (const Chain& chain : chains_)
      for (std::size_t c = 0; c < chain.gaps(); ++c) {
        const Column &left = chain.columns[c], &right = chain.columns[chain.after(c)];
        for (int k = 0; k < std::min(left.levels, right.levels); ++k) rows_.cells.push_back(cell_of(left, right, k));
      }
  }

  // ---- the rest of the domain ----

  // The boundary of the rest is the boundary of the domain without the boundaries of the cells.
  void make_rest() {
    std::map<std::array<int, 2>, PlaneEdge> boundary;
    std::vector<PlaneEdge> others;
    for (const PlaneEdge& edge : plane_.edges) {
      if (edge.kind == PlaneEdgeKind::boundary)
        boundary.emplace(std::array{edge.a, edge.b}, edge);
      else
        others.push_back(edge);
    }
    for (const LayerCell& cell : rows_.cells) {
      const std::size_t n = cell.is_triangle() ? 3 : 4;
      for (std::size_t k = 0; k < n; ++k) {
        const int a = cell.corners[k], b = cell.corners[(k + 1) % n];
        if (boundary.erase({a, b}) > 0) continue;
        PlaneEdge edge;
        edge.a = b, edge.b = a;
        boundary.emplace(std::array{b, a}, edge);
      }
    }
    FaceDomain& rest = rows_.rest;
    rest = {};
    rows_.rest_xyz.clear(), rows_.of_rest.clear();
    const std::size_t n = plane_.vertices.size();
    std::vector<int> number(n + rows_.uv.size(), -1);
    for (const auto& [ends, edge] : boundary) number[static_cast<std::size_t>(ends[0])] = number[static_cast<std::size_t>(ends[1])] = 0;
    for (const PlaneEdge& edge : others) number[static_cast<std::size_t>(edge.a)] = number[static_cast<std::size_t>(edge.b)] = 0;
    const auto take = [&](std::size_t v) {
      number[v] = static_cast<int>(rest.plane.vertices.size());
      rest.plane.vertices.push_back(uv(static_cast<int>(v)));
      rows_.of_rest.push_back(static_cast<std::int32_t>(v));
      const bool given = v < n;
      rest.origin.push_back(given ? domain_.origin[v] : DomainVertexOrigin{});
      rest.size.push_back(given ? domain_.size[v] : rows_.size[v - n]);
      rest.physical.push_back(given ? domain_.physical[v] : rows_.size[v - n]);
    };
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] < 0 || (v >= on_curves_ && v < n)) continue;
      take(v);
      rows_.rest_xyz.push_back(xyz(static_cast<int>(v)));
    }
    for (std::size_t v = on_curves_; v < n; ++v) take(v);
    const auto add = [&](PlaneEdge edge) {
      edge.a = number[static_cast<std::size_t>(edge.a)], edge.b = number[static_cast<std::size_t>(edge.b)];
      rest.plane.edges.push_back(edge);
    };
    for (const PlaneEdge& edge : plane_.edges)
      if (edge.kind != PlaneEdgeKind::boundary || boundary.erase({edge.a, edge.b}) > 0) add(edge);
    for (const auto& [ends, edge] : boundary) add(edge);
  }

  void drop_unused_vertices() {
    const std::size_t n = plane_.vertices.size();
    std::vector<std::int32_t> now(rows_.uv.size(), -1);
    const auto for_corners = [&](const auto& use) {
      for (LayerCell& cell : rows_.cells)
        for (std::int32_t& v : cell.corners)
          if (v >= static_cast<std::int32_t>(n)) use(v);
    };
    for_corners([&](std::int32_t v) { now[static_cast<std::size_t>(v) - n] = 0; });
    std::size_t count = 0;
    for (std::size_t k = 0; k < now.size(); ++k) {
      if (now[k] < 0) continue;
      rows_.uv[count] = rows_.uv[k], rows_.xyz[count] = rows_.xyz[k];
      rows_.normal[count] = rows_.normal[k], rows_.size[count] = rows_.size[k];
      now[k] = static_cast<std::int32_t>(n + count++);
    }
    rows_.uv.resize(count), rows_.xyz.resize(count), rows_.normal.resize(count), rows_.size.resize(count);
    const auto renumber = [&](std::int32_t& v) { v = now[static_cast<std::size_t>(v) - n]; };
    for_corners(renumber);
    for (std::int32_t& v : rows_.of_rest)
      if (v >= static_cast<std::int32_t>(n)) renumber(v);
  }

  const PatchInput& input_;
  const LayerCurves& layers_;
  const FaceDomain& domain_;
  const PlaneDomain& plane_;
  Cad& cad_;
  std::size_t on_curves_;  // vertices of the domain that lie on curves
  std::vector<Chain> chains_;
  std::vector<Obstacle> obstacles_;
  BoxTree tree_;
  std::optional<PolygonLocator> inside_;
  LayerRows rows_;
};

}  // namespace

std::optional<LayerRows> make_layer_rows(const PatchInput& input, const LayerCurves& layers, Cad& cad) {
  return RowMaker(input, layers, cad).run();
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
