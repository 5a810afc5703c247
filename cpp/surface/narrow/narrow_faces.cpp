// SPDX-License-Identifier: BSD-3-Clause
#include "surface/narrow/narrow_faces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "metric/metric3_algebra.h"
#include "model/traces.h"
#include "model/union_find.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "support/shares.h"
#include "surface/narrow/side_ruler.h"
#include "surface/narrow/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::narrow;

// Boundary curves end to end in the parameter plane, where loops have no ambiguity.
std::vector<Side> find_loops(const std::vector<CurveSupport>& supports) {
  std::vector<char> used(supports.size(), 0);
  std::vector<Side> loops;
  for (std::size_t first = 0; first < supports.size(); ++first) {
    if (used[first] != 0) continue;
    used[first] = 1;
    Side loop{{static_cast<int>(first), false}};
    const Vec2 start = supports[first].uv.front();
    Vec2 at = supports[first].uv.back();
    for (;;) {
      double nearest = norm(at - start);
      std::optional<SidePart> next;
      for (std::size_t c = 0; c < supports.size(); ++c) {
        if (used[c] != 0) continue;
        for (const bool back : {false, true}) {
          const double d = norm(at - (back ? supports[c].uv.back() : supports[c].uv.front()));
          if (d < nearest) nearest = d, next = SidePart{static_cast<int>(c), back};
        }
      }
      if (!next) break;
      used[next->curve] = 1;
      loop.push_back(*next);
      at = next->back ? supports[next->curve].uv.front() : supports[next->curve].uv.back();
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

class Finder {
 public:
  Finder(const CurveModel& model, const std::vector<DiscreteCurve>& curves, double ratio)
      : model_(model), curves_(curves), ratio_(ratio) {}

  std::vector<NarrowFace> run() {
    std::vector<NarrowFace> found;
    for (int f = 0; f < static_cast<int>(model_.model.faces.size()); ++f)
      if (auto narrow = look_at(f)) found.push_back(std::move(*narrow));
    return found;
  }

 private:
  [[nodiscard]] const CurveSupport& support(const SidePart& part) const { return model_.supports[face_][part.curve]; }
  [[nodiscard]] double length(const Side& side, std::size_t from, std::size_t count) const {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += support(side[(from + i) % side.size()]).length();
    return sum;
  }
  [[nodiscard]] std::vector<Vec3> trace(const Side& side) const { return SideRuler(model_, face_, side).points(); }

  std::optional<NarrowFace> look_at(int f) {
    face_ = f;
    const Face& face = model_.model.faces[f];
    // The search for sides tests all pairs of ends: a face with more curves is skipped. [time only]
    if (!face.points.empty() || face.curves.empty() || face.curves.size() > 60) return {};
    for (const FaceCurve& curve : face.curves)
      if (curve.type == CurveType::internal) return {};
    NarrowFace narrow{.face = f, .size = smallest_size()};
    reach_ = ratio_ * narrow.size;
    if (!(reach_ > 0)) return {};
    const std::vector<Side> loops = find_loops(model_.supports[f]);
    bool is_found = false;
    if (is_near_a_point(narrow)) {
      narrow.point = is_found = true;
    } else if (loops.size() == 1) {
      is_found = may_be_narrow() && cut_loop(loops.front(), narrow);
    } else if (loops.size() == 2) {
      is_found = make_ring(loops, narrow);
    }
    return is_found ? std::optional(std::move(narrow)) : std::nullopt;
  }

  [[nodiscard]] double smallest_size() const {
    double smallest = infinity;
    for (const int c : model_.topology.curve_of[face_])
      for (const double h : curves_[c].size) smallest = std::min(smallest, h);
    return smallest;
  }

  // A face that is larger than its boundary shows, for example a sphere around a small hole, is not near its boundary.
  // Surfaces are not evaluated here: the check of areas at the collapse handles small loops whose derivatives show a
  // large face.
  bool is_near_a_point(NarrowFace& narrow) const {
    const Vec3 start = model_.supports[face_].front().xyz.front();
    for (const CurveSupport& s : model_.supports[face_])
      for (const Vec3& p : s.xyz) narrow.width = std::max(narrow.width, norm(p - start));
    return narrow.width <= reach_;
  }

  // Returns whether the middle of the longest curve is near a second curve; cheap, and enough to pass over most faces.
  [[nodiscard]] bool may_be_narrow() const {
    const auto& supports = model_.supports[face_];
    std::size_t longest = 0;
    for (std::size_t c = 1; c < supports.size(); ++c)
      if (supports[c].length() > supports[longest].length()) longest = c;
    const Vec3 middle = supports[longest].point_at_arc(supports[longest].length() / 2);
    for (std::size_t c = 0; c < supports.size(); ++c)
      if (c != longest && nearest_on_trace(supports[c].xyz, middle).distance <= reach_) return true;
    return false;
  }

  struct EndCap {
    std::size_t from, count;  // curves of the loop
  };

  // All pairs of end caps, a corner or a few short curves each; the nearest sides win.
  bool cut_loop(const Side& loop, NarrowFace& narrow) const {
    const std::size_t n = loop.size();
    std::vector<EndCap> end_caps;
    for (std::size_t from = 0; from < n; ++from)
      for (std::size_t count = 0; count + 2 <= n && length(loop, from, count) <= longest_end_cap * reach_; ++count)
        end_caps.push_back({from, count});
    double best = infinity;
    std::size_t max_in_end_caps = 0;
    for (std::size_t i = 0; i < end_caps.size(); ++i)
      for (std::size_t j = i + 1; j < end_caps.size(); ++j) {
        const EndCap p = end_caps[i], q = end_caps[j];
        if (q.from < p.from + p.count || q.from + q.count > p.from + n) continue;  // they overlap
        const std::size_t to_q = q.from - p.from - p.count, to_p = n - p.count - q.count - to_q;
        if (to_q == 0 || to_p == 0) continue;
        const Side one = part_of(loop, p.from + p.count, to_q), other = reversed(part_of(loop, q.from + q.count, to_p));
        const double width = hausdorff_distance(trace(one), trace(other), reach_);
        if (width > reach_ || width > best * (1 + shares::negligible)) continue;
        if (width > best * (1 - shares::negligible) && p.count + q.count <= max_in_end_caps) continue;
        best = width;
        max_in_end_caps = p.count + q.count;
        narrow.width = width;
        narrow.side = {one, other};
        narrow.end_cap = {reversed(part_of(loop, p.from, p.count)), part_of(loop, q.from, q.count)};
      }
    // Sides that are one curve already (a seam) need no matching.
    return best <= reach_ && !share_a_curve(narrow);
  }

  [[nodiscard]] bool share_a_curve(const NarrowFace& narrow) const {
    const std::vector<int>& curve_of = model_.topology.curve_of[face_];
    for (const SidePart& p : narrow.side[0])
      for (const SidePart& q : narrow.side[1])
        if (curve_of[p.curve] == curve_of[q.curve]) return true;
    return false;
  }

  static Side part_of(const Side& loop, std::size_t from, std::size_t count) {
    Side part;
    for (std::size_t i = 0; i < count; ++i) part.push_back(loop[(from + i) % loop.size()]);
    return part;
  }
  static Side reversed(Side side) {
    std::reverse(side.begin(), side.end());
    for (SidePart& part : side) part.back = !part.back;
    return side;
  }

  bool make_ring(const std::vector<Side>& loops, NarrowFace& narrow) const {
    narrow.width = hausdorff_distance(trace(loops[0]), trace(loops[1]), reach_);
    narrow.ring = true;
    narrow.side = {loops[0], loops[1]};
    if (narrow.width > reach_ || share_a_curve(narrow)) return false;
    // Both run the same way when places on one follow each other on the other one.
    const SideRuler one(model_, face_, loops[0]), other(model_, face_, loops[1]);
    int along = 0;
    for (int i = 0; i < probes; ++i) {
      const double here = other.place_of(one.point_at(one.length() * i / probes)).s;
      const double next = other.place_of(one.point_at(one.length() * (i + 1) / probes)).s;
      along += std::remainder(next - here, other.length()) > 0 ? 1 : -1;
    }
    if (along < 0) narrow.side[1] = reversed(narrow.side[1]);
    return true;
  }

  const CurveModel& model_;
  const std::vector<DiscreteCurve>& curves_;
  double ratio_;
  int face_ = 0;
  double reach_ = 0;  // of the face that is looked at
};

/// Curves that vanish with one face.
std::vector<int> vanishing_of(const CurveModel& model, const NarrowFace& narrow) {
  const std::vector<int>& curve_of = model.topology.curve_of[narrow.face];
  if (narrow.point) return curve_of;
  std::vector<int> curves;
  for (const Side& end_cap : narrow.end_cap)
    for (const SidePart& part : end_cap) curves.push_back(curve_of[part.curve]);
  return curves;
}

/// Returns a loop of a face that stays, all of whose curves would vanish; empty if no such loop exists.
std::vector<int> vanishing_loop(const CurveModel& model, const std::vector<char>& gone, const NarrowModel& narrow) {
  std::vector<char> collapses(model.model.faces.size(), 0);
  for (const auto* list : {&narrow.strips, &narrow.points})
    for (const NarrowFace& face : *list) collapses[face.face] = 1;
  for (std::size_t f = 0; f < collapses.size(); ++f) {
    const std::vector<int>& curve_of = model.topology.curve_of[f];
    if (collapses[f] != 0 || std::none_of(curve_of.begin(), curve_of.end(), [&](int c) { return gone[c] != 0; }))
      continue;
    for (const Side& loop : find_loops(model.supports[f])) {
      std::vector<int> curves;
      for (const SidePart& part : loop) curves.push_back(curve_of[part.curve]);
      if (std::all_of(curves.begin(), curves.end(), [&](int c) { return gone[c] != 0; })) return curves;
    }
  }
  return {};
}

/// Returns whether the face has no width between its two uses of one curve.
bool is_folded_along(const CurveModel& model, const DiscreteCurve& curve, int face, std::array<CurveUse, 2> uses) {
  const int ref = model.model.faces[face].ref;
  const double near = std::max(folded_gap * curve.gap, rounding_of::places * model.length(curve.curve));
  for (const double r : {0.25, 0.5, 0.75}) {
    std::array<Vec2, 2> uv;
    std::array<Vec3, 2> p;
    for (int i = 0; i < 2; ++i) {
      uv[i] =
          model.cad.curve(model.face_ref(uses[i]), uses[i].curve + 1, want_position, parameter_at(model, uses[i], r)).c;
      p[i] = surface_at(model.cad, ref, want_position, uv[i]).s;
    }
    const SurfaceJet between = surface_at(model.cad, ref, want_position | want_first, 0.5 * (uv[0] + uv[1]));
    if (!TangentFrame::of(between.su, between.sv)) return false;  // no width because the surface has none
    if (!(norm(between.s - p[0]) <= near) || !(norm(between.s - p[1]) <= near)) return false;
  }
  return true;
}

/// Returns whether the face is one point of space: each side is, and its middle is at most as far from them as they
/// extend. A closed surface whose whole border is one point does not count.
bool is_point_of_space(const CurveModel& model, int face) {
  Vec2 middle{0, 0};
  std::vector<Vec3> border;
  const std::vector<int>& curve_of = model.topology.curve_of[face];
  for (std::size_t c = 0; c < curve_of.size(); ++c) {
    if (!model.curve(curve_of[c]).degenerate) return false;
    const CurveUse use{face, static_cast<int>(c), false};
    for (const double r : {0.0, 0.5, 1.0}) {
      const Vec2 uv = model.cad.curve(model.face_ref(use), use.curve + 1, want_position, parameter_at(model, use, r)).c;
      middle += uv / (3 * static_cast<double>(curve_of.size()));
      border.push_back(surface_at(model.cad, model.face_ref(use), want_position, uv).s);
    }
  }
  if (border.empty()) return false;
  const Vec3 p = surface_at(model.cad, model.model.faces[face].ref, want_position, middle).s;
  double extent = rounding_of::places * norm(p);
  for (const Vec3& q : border) extent = std::max(extent, norm(q - border.front()));
  return norm(p - border.front()) <= extent;
}

}  // namespace

std::vector<int> find_folded_faces(const CurveModel& model, const std::vector<DiscreteCurve>& curves) {
  std::vector<int> folded;
  for (int f = 0; f < static_cast<int>(model.model.faces.size()); ++f) {
    const std::vector<int>& curve_of = model.topology.curve_of[f];
    if (!model.model.faces[f].left_out.empty() || model.model.faces[f].is_wire()) continue;
    bool is_folded = false;
    for (const int c : curve_of) {
      const Curve& curve = model.curve(c);
      if (curve.degenerate) continue;
      std::vector<CurveUse> here;
      for (const CurveUse& use : curve.uses)
        if (use.face == f) here.push_back(use);
      is_folded = here.size() == 2 && is_folded_along(model, curves[c], f, {here[0], here[1]});
      if (!is_folded) break;
    }
    if (is_folded || is_point_of_space(model, f)) folded.push_back(f);
  }
  return folded;
}

void let_end_caps_vanish(const CurveModel& model, NarrowModel& narrow) {
  std::vector<char>& gone = narrow.vanishing.curve;
  for (;;) {
    gone.assign(model.topology.curves.size(), 0);
    for (const auto* list : {&narrow.strips, &narrow.points})
      for (const NarrowFace& face : *list)
        for (const int c : vanishing_of(model, face)) gone[c] = 1;
    const std::vector<int> loop = vanishing_loop(model, gone, narrow);
    if (loop.empty()) break;
    for (auto* list : {&narrow.strips, &narrow.points})
      std::erase_if(*list, [&](const NarrowFace& face) {
        const std::vector<int> curves = vanishing_of(model, face);
        return std::find_first_of(curves.begin(), curves.end(), loop.begin(), loop.end()) != curves.end();
      });
  }
  UnionFind corners(model.topology.points.size());
  for (std::size_t c = 0; c < gone.size(); ++c)
    if (gone[c] != 0) corners.merge(model.topology.curves[c].end1, model.topology.curves[c].end2);
  narrow.vanishing.corner.clear();
  for (std::size_t p = 0; p < model.topology.points.size(); ++p)
    narrow.vanishing.corner.push_back(static_cast<int>(corners.find(p)));
}

std::vector<NarrowFace> find_narrow_faces(const CurveModel& model, const std::vector<DiscreteCurve>& curves,
                                          double ratio) {
  return Finder(model, curves, ratio).run();
}

}  // namespace carreau
