// SPDX-License-Identifier: BSD-3-Clause
// Chains of columns: which edges follow each other, and how columns stand at corners.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "surface/layers/row_face.h"
#include "support/angles.h"
#include "surface/layers/thresholds.h"

namespace carreau {
namespace {

using namespace thresholds::layers;

constexpr double degree = std::numbers::pi / 180;

/// An edge with the domain on its left. Internal edges have two.
struct HalfEdge {
  int a = -1, b = -1;
  const PlaneEdge* edge = nullptr;
  int next = -1, previous = -1;  ///< around the same part of the domain; -1: none
};

class ChainFinder {
 public:
  explicit ChainFinder(const RowFace& face) : face_(face) {}

  std::vector<RowChain> run() {
    if (!find_half_edges()) return {};
    link();
    std::vector<char> seen(half_.size(), 0);
    const auto follow = [&](int first) {
      std::vector<int> run;
      for (int h = first; has_layers(h) && seen[static_cast<std::size_t>(h)] == 0; h = at(h).next) {
        seen[static_cast<std::size_t>(h)] = 1;
        run.push_back(h);
      }
      return run;
    };
    for (const bool closed : {false, true})
      for (int h = 0; h < static_cast<int>(half_.size()); ++h)
        if (seen[static_cast<std::size_t>(h)] == 0 && has_layers(h) && (closed || !has_layers(at(h).previous)))
          make_chain(follow(h), closed);
    return std::move(chains_);
  }

 private:
  [[nodiscard]] const HalfEdge& at(int h) const { return half_[static_cast<std::size_t>(h)]; }
  [[nodiscard]] bool has_layers(int h) const { return h >= 0 && face_.layers_of(*at(h).edge) >= 0; }
  [[nodiscard]] Vec3 direction(int h) const { return face_.direction(at(h).a, at(h).b); }
  [[nodiscard]] double length(int h) const { return norm(face_.xyz(at(h).b) - face_.xyz(at(h).a)); }

  // Internal edges without layers are none: obstacles end rows there.
  bool find_half_edges() {
    bool any = false;
    for (const PlaneEdge& edge : face_.plane.edges) {
      const bool layers = face_.layers_of(edge) >= 0;
      any = any || layers;
      if (edge.kind == PlaneEdgeKind::internal && !layers) continue;
      half_.push_back({.a = edge.a, .b = edge.b, .edge = &edge});
      if (edge.kind == PlaneEdgeKind::internal) half_.push_back({.a = edge.b, .b = edge.a, .edge = &edge});
    }
    return any;
  }

  // The next half edge is the first one clockwise from the reverse of this one.
  void link() {
    std::vector<std::vector<int>> leaving(face_.plane.vertices.size());
    for (int h = 0; h < static_cast<int>(half_.size()); ++h) leaving[static_cast<std::size_t>(at(h).a)].push_back(h);
    for (int h = 0; h < static_cast<int>(half_.size()); ++h) {
      HalfEdge& half = half_[static_cast<std::size_t>(h)];
      const Vec2 back = face_.uv(half.a) - face_.uv(half.b);
      double least = 7;
      for (const int candidate : leaving[static_cast<std::size_t>(half.b)]) {
        const Vec2 out = face_.uv(at(candidate).b) - face_.uv(half.b);
        double angle = std::atan2(cross(out, back), dot(out, back));
        if (at(candidate).edge == half.edge || !(angle > 0)) angle += 2 * std::numbers::pi;
        if (angle < least) least = angle, half.next = candidate;
      }
    }
    for (int h = 0; h < static_cast<int>(half_.size()); ++h)
      if (at(h).next >= 0) half_[static_cast<std::size_t>(at(h).next)].previous = h;
  }

  void make_chain(const std::vector<int>& run, bool closed) {
    RowChain chain;
    chain.closed = closed && at(run.back()).next == run.front();
    const std::size_t n = run.size();
    if (!chain.closed) add_end(chain, run.front(), true);
    for (std::size_t k = chain.closed ? 0 : 1; k < n; ++k) add_corner(chain, run[k == 0 ? n - 1 : k - 1], run[k]);
    if (!chain.closed) add_end(chain, run.back(), false);
    if (chain.columns.size() < 2) return;
    lean_at_corners(chain);
    chains_.push_back(std::move(chain));
  }

  [[nodiscard]] Column column_at(int v, int h, double longest) const {
    Column column;
    column.base = v;
    column.at = {v};
    column.layers = face_.layers_of(*at(h).edge);
    column.normal = face_.normal_at(v);
    column.heights = face_.layers.heights(column.layers, longest);
    column.stands = norm(column.normal) > 0;
    return column;
  }

  // From one half edge to the next one. Around the free end of an inner curve, the angle is 360 degrees.
  [[nodiscard]] double turn_of(int before, int after, const Vec3& normal) const {
    if (at(before).edge == at(after).edge) return -std::numbers::pi;
    const Vec3 in = direction(before), out = direction(after);
    return std::atan2(dot(cross(in, out), normal), dot(in, out));
  }

  // The part of a turn that the chords of smooth curves have: all of it inside a curve. Between two curves each has half of the
  // turn at its next vertex.
  [[nodiscard]] double smooth_part(int before, int after, double turn, const Vec3& normal) const {
    const auto same = [&](int h, int g) { return h >= 0 && g >= 0 && at(h).edge->curve == at(g).edge->curve && at(h).edge != at(g).edge; };
    if (same(before, after) && at(before).previous >= 0 && at(after).next >= 0) {
      // Chords of half the length turn by (t - d / 16) / 2, where d is the second difference of turns: the curvature of three
      // turns by a parabola.
      const double d = turn_of(at(before).previous, before, normal) - 2 * turn + turn_of(after, at(after).next, normal);
      return turn + std::clamp(d / 16, -0.25 * std::abs(turn), 0.25 * std::abs(turn));
    }
    double sum = 0;
    if (same(at(before).previous, before)) sum += 0.5 * turn_of(at(before).previous, before, normal);
    if (same(after, at(after).next)) sum += 0.5 * turn_of(after, at(after).next, normal);
    return turn > 0 ? std::clamp(sum, 0.0, turn) : std::clamp(sum, turn, 0.0);
  }

  // Between two edges with layers.
  void add_corner(RowChain& chain, int before, int after) {
    Column column = column_at(at(after).a, after, 0.5 * (length(before) + length(after)));
    const Vec3 in = direction(before), out = direction(after);
    const Vec3 up_in = RowFace::unit(cross(column.normal, in)), up_out = RowFace::unit(cross(column.normal, out));
    const double whole = turn_of(before, after, column.normal);
    double turn = whole;
    if (face_.halved) turn -= 0.5 * smooth_part(before, after, whole, column.normal);
    const double inside = 180 - turn / degree;
    column.along = RowFace::unit(in + out);
    if (inside > min_fan_angle) {
      const int steps = static_cast<int>(std::ceil(std::abs(turn) / (fan_step * degree)));
      for (int k = 0; k <= steps; ++k) {
        const double angle = 0.5 * (whole - turn) + turn * k / steps;
        Column ray = column;
        ray.is_turned = true;
        ray.up = RowFace::unit(std::cos(angle) * up_in + std::sin(angle) * cross(column.normal, up_in));
        ray.along = cross(ray.up, column.normal);
        chain.columns.push_back(std::move(ray));
      }
      return;
    }
    column.stands = column.stands && inside >= min_column_angle;
    column.up = RowFace::unit(up_in + up_out);
    column.along = cross(column.up, column.normal);
    column.stretch = 1 / std::max(std::cos(0.5 * turn), 0.1);
    if (turn > min_lean_angle * degree) {
      column.is_turned = true;
      column.lean = std::tan(0.5 * turn);  // read by lean_at_corners() alone
    }
    chain.columns.push_back(std::move(column));
  }

  // The first or last vertex, beside an edge without layers.
  void add_end(RowChain& chain, int h, bool first) const {
    const int v = first ? at(h).a : at(h).b;
    Column column = column_at(v, h, length(h));
    column.along = direction(h);
    column.up = RowFace::unit(cross(column.normal, column.along));
    column.along = cross(column.up, column.normal);
    const int other = first ? at(h).previous : at(h).next;
    if (other < 0 || !face_.is_on_curve(at(other).a) || !face_.is_on_curve(at(other).b) || !(length(other) > 0)) {
      column.stands = false;
      chain.columns.push_back(std::move(column));
      return;
    }
    const Vec3 side = RowFace::unit(face_.xyz(first ? at(other).a : at(other).b) - face_.xyz(v));
    const Vec3 inward = first ? column.along : Vec3(-column.along);
    const double sine = dot(side, column.up), cosine = dot(side, inward);
    if (sine > angles::cosine_of_45) {  // else cells are skewed
      column.on_side = column.is_turned = true;
      column.lean = cosine / sine;  // towards the layers if positive
      follow_side(column, other, sine, first);
    } else if (cosine > 0) {
      column.stands = false;
    }
    chain.columns.push_back(std::move(column));
  }

  // Vertices of the side are vertices of rows as long as they lie near their heights.
  void follow_side(Column& column, int h, double sine, bool first) const {
    const int curve = at(h).edge->curve;
    for (const double height : column.heights) {
      const double there = length(h) * sine;
      if (!(there > 0.6 * height && there < 1.6 * height)) break;
      column.at.push_back(first ? at(h).a : at(h).b);
      h = first ? at(h).previous : at(h).next;
      if (h < 0 || at(h).edge->curve != curve || at(h).edge->kind != PlaneEdgeKind::boundary) break;
    }
    column.levels = static_cast<int>(column.at.size()) - 1;
  }

  // Columns beside a corner lean as its column does, less and less.
  void lean_at_corners(RowChain& chain) const {
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
        x += norm(face_.xyz(all[next].base) - face_.xyz(all[c].base));
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
      all[c].up = RowFace::unit(direction);
    }
  }

  const RowFace& face_;
  std::vector<HalfEdge> half_;
  std::vector<RowChain> chains_;
};

}  // namespace

std::vector<RowChain> find_chains(const RowFace& face) { return ChainFinder(face).run(); }

}  // namespace carreau
