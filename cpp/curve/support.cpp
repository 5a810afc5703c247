// SPDX-License-Identifier: BSD-3-Clause
#include "curve/support.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>

#include "curve/arc_length.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {
namespace {

/// Deviations below these fractions of the curve's length do not matter. They end the refinement at a kink (across the
/// edge), and where the speed of the parametrisation vanishes or is infinite (along the edge).
constexpr double across_floor = 1e-6;
constexpr double along_floor = 2e-6;
/// Deviations below this fraction of the coordinates are rounding errors.
constexpr double rounding_floor = 1e-12;
constexpr int initial_edges = 8;
/// Into how many parts one pass may cut an edge. The first pass only learns the curve, and the second goes straight to
/// the number that a smooth curve needs. Edges that still need cutting then are not smooth, and are cut with care.
constexpr int max_parts = 32;
int max_parts_in(int pass) noexcept { return pass == 1 ? max_parts : 4; }
/// Parts are planned a little too short, the more so the more there are, because long chords underrate a curvature. One
/// part too many costs one sample, a second cut doubles them all.
double with_margin(double parts) noexcept { return parts * (1.08 + 0.01 * parts); }
constexpr int max_passes = 60;
/// Edges are never narrower than this fraction of [a, b].
constexpr double narrowest_edge = 1e-13;

/// Deterministic noise in [-1, 1] (splitmix64).
double noise(std::uint64_t seed) noexcept {
  seed += 0x9e3779b97f4a7c15ULL;
  seed = (seed ^ (seed >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  seed = (seed ^ (seed >> 27U)) * 0x94d049bb133111ebULL;
  seed ^= seed >> 31U;
  return static_cast<double>(seed >> 11U) * 0x1p-52 - 1;
}

/// Limits for the deviation of one edge in one of the two spaces.
struct Tolerance {
  double relative = 0;           ///< times the chord
  double across = 0, along = 0;  ///< absolute, from below
};

struct Excess {
  double ratio = 0;  ///< deviation over tolerance
  int parts = 1;     ///< into how many parts the edge has to be cut
};

/// Compares a deviation v from the chord e with its tolerance, across and along the chord.
template <typename V>
Excess excess_of(V v, V chord, const Tolerance& tolerance) noexcept {
  const double c = norm(chord);
  const double along = c > 0 ? std::abs(dot(v, chord)) / c : 0;
  const double across = c > 0 ? norm(v - (dot(v, chord) / (c * c)) * chord) : norm(v);
  Excess worst;
  const auto judge = [&](double deviation, double least) {
    const double allowed = std::max(tolerance.relative * c, least);
    const double ratio = allowed > 0 ? deviation / allowed : (deviation > 0 ? max_parts : 0.);
    if (ratio > worst.ratio) worst.ratio = ratio;
    if (!(ratio > 1)) return;
    // deviation / chord is proportional to the width of the edge, the deviation alone to its square
    const double parts = std::ceil(with_margin(least < tolerance.relative * c ? ratio : std::sqrt(ratio)));
    worst.parts = std::max(worst.parts, std::max(2, static_cast<int>(std::min(parts, double{max_parts}))));
  };
  judge(across, tolerance.across);
  judge(along, tolerance.along);
  return worst;
}

/// Returns whether all components of v are within the tolerance, beyond any doubt of rounding. Nearly all edges of the last pass are, and
/// the test needs no roots.
template <typename V>
bool surely_within(const V& v, const V& chord, const Tolerance& tolerance) noexcept {
  constexpr double sure = 1 - 1e-9;
  const double least = std::min(tolerance.across, tolerance.along);
  return dot(v, v) < sure * std::max(tolerance.relative * tolerance.relative * dot(chord, chord), least * least);
}

Excess worse(Excess p, Excess q) noexcept { return {std::max(p.ratio, q.ratio), std::max(p.parts, q.parts)}; }

/// Refines the samples of one curve until (PL) holds.
class Builder {
 public:
  Builder(Cad& cad, int face, int ic, const SupportOptions& options) : cad_(cad), face_(face), ic_(ic) {
    if (!(options.angle_deg > 0 && options.angle_deg < 90)) {
      throw InvalidArgument("the angle of a curve's support must lie between 0 and 90 degrees; it is " +
                            format_number(options.angle_deg));
    }
    // An arc of circle of chord c makes the angle theta with its chord at both ends, and leaves it by (c / 2) tan(theta
    // / 2). This is the deviation that angle_smo allows (RT-0232 sec. 3.3). The bound along the chord keeps t -> arc
    // length close to linear, which (PL) requires beyond (PG) (HDR sec. 2.5).
    const double theta = options.angle_deg * std::numbers::pi / 180;
    relative_ = std::tan(theta / 2) / 2;
    max_samples_ = static_cast<std::size_t>(std::max(options.max_samples, initial_edges + 1));
  }

  CurveSupport run() {
    const Interval interval = checked_interval();
    start(interval);
    bool limited = true;  // or all deviations are known to be small enough
    for (int pass = 0; pass < max_passes; ++pass) {
      const std::vector<double> added = wanted(pass, limited);
      if (added.empty()) break;
      insert(added);
    }
    if (limited) note_limits();
    fill_arc(support_);
    return std::move(support_);
  }

 private:
  [[nodiscard]] Interval checked_interval() const {
    const Interval i = cad_.curve_interval(face_, ic_);
    if (!std::isfinite(i.a) || !std::isfinite(i.b) || !std::isfinite(i.b - i.a) || !(i.a < i.b)) {
      throw CallbackError(Where{.face = face_, .curve_index = ic_}, "curv_int returned the interval [" +
                                                                        format_number(i.a) + ", " + format_number(i.b) +
                                                                        "]; its ends must be finite numbers a < b");
    }
    return i;
  }

  /// Ends and middles are uniform, the samples between them pseudo-random (HDR fig. 2.2), so that a periodic curve is
  /// not mistaken for a straight one.
  void start(Interval interval) {
    std::vector<double> t;
    for (int i = 0; i <= initial_edges; ++i) {
      const double shift = i % 2 == 0 ? 0 : 0.25 * noise(static_cast<std::uint64_t>(i));
      t.push_back(lerp_t(interval.a, interval.b, (i + shift) / initial_edges));
    }
    t.front() = interval.a;
    t.back() = interval.b;
    t.erase(std::unique(t.begin(), t.end()), t.end());  // an interval of a few floating-point numbers
    insert(t);
  }

  static double lerp_t(double a, double b, double w) noexcept { return std::clamp((1 - w) * a + w * b, a, b); }

  /// Evaluates the parameters (ascending, all new) in one batch and merges them with the samples.
  void insert(const std::vector<double>& added) {
    std::vector<Vec2> uv(added.size());
    std::vector<SurfaceJet> jets(added.size());
    for (std::size_t i = 0; i < added.size(); ++i) {
      uv[i] = cad_.curve(face_, ic_, want_position, added[i]).c;
      if (!is_finite(uv[i])) throw not_finite("curv0", added[i]);
    }
    cad_.surface(face_, want_position, uv, jets);
    for (std::size_t i = 0; i < added.size(); ++i) {
      if (!is_finite(jets[i].s)) throw not_finite("surf0", added[i]);
    }
    CurveSupport merged;
    const std::size_t count = support_.t.size() + added.size();
    merged.t.reserve(count), merged.uv.reserve(count), merged.xyz.reserve(count);
    std::size_t old = 0;
    for (std::size_t i = 0; i <= added.size(); ++i) {
      for (; old < support_.t.size() && (i == added.size() || support_.t[old] < added[i]); ++old) {
        merged.t.push_back(support_.t[old]);
        merged.uv.push_back(support_.uv[old]);
        merged.xyz.push_back(support_.xyz[old]);
      }
      if (i == added.size()) break;
      merged.t.push_back(added[i]);
      merged.uv.push_back(uv[i]);
      merged.xyz.push_back(jets[i].s);
    }
    support_ = std::move(merged);
  }

  [[nodiscard]] CallbackError not_finite(const char* routine, double t) const {
    return {Where{.face = face_, .curve_index = ic_, .t = t},
            std::string(routine) + " returned a value that is not a finite number"};
  }

  template <typename V>
  Tolerance tolerance_of(const std::vector<V>& points) const noexcept {
    double length = 0;
    double largest = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0) length += norm(points[i] - points[i - 1]);
      largest = std::max(largest, norm(points[i]));
    }
    const double rounding = rounding_floor * largest;
    return {relative_, std::max(across_floor * length, rounding), std::max(along_floor * length, rounding)};
  }

  /// Deviation that the bends at both ends of edge i let expect, in one space. `bend`: the bend at its start, then at its end. If no
  /// deviation is too large the ratio may be missing.
  template <typename V>
  Excess edge_excess(const std::vector<V>& points, std::size_t i, const Tolerance& tolerance, V& bend) const noexcept {
    const V chord = points[i + 1] - points[i];
    const std::size_t last = points.size() - 1;
    const double w = support_.t[i + 1] - support_.t[i];
    const V at_start = i > 0 ? V(0.125 * w * w * bend) : V::Zero();
    if (i + 1 < last) bend = bend_at(support_.t, points, i + 1);
    const V at_end = i + 1 < last ? V(0.125 * w * w * bend) : V::Zero();
    if (surely_within(at_start, chord, tolerance) && surely_within(at_end, chord, tolerance)) return {};
    Excess left, right;
    if (i > 0) left = excess_of<V>(at_start, chord, tolerance);
    if (i + 1 < last) right = excess_of<V>(at_end, chord, tolerance);
    Excess both = worse(left, right);
    // The two ends disagree: the arc is not smooth, and only halving can be trusted.
    if (i > 0 && i + 1 < last && 2 * std::min(left.ratio, right.ratio) < both.ratio) {
      both.parts = std::min(both.parts, 2);
    }
    return both;
  }

  /// At the start of an edge, in both spaces.
  struct Bends {
    Vec2 plane{0, 0};
    Vec3 space{0, 0, 0};
  };
  /// The larger excess of both spaces; edges must be evaluated in order, from the first one on.
  Excess edge_excess(std::size_t i, const Tolerance& plane, const Tolerance& space, Bends& bends) const noexcept {
    const Excess in_plane = edge_excess(support_.uv, i, plane, bends.plane);
    return worse(in_plane, edge_excess(support_.xyz, i, space, bends.space));
  }

  [[nodiscard]] bool divisible(std::size_t i, int parts) const noexcept {
    const double span = support_.t.back() - support_.t.front();
    const double width = (support_.t[i + 1] - support_.t[i]) / parts;
    const double magnitude = std::max(std::abs(support_.t[i]), std::abs(support_.t[i + 1]));
    return width > narrowest_edge * span && width > 8 * std::numeric_limits<double>::epsilon() * magnitude;
  }

  /// New parameters for this pass, ascending. `limited`: set if a deviation is too large.
  [[nodiscard]] std::vector<double> wanted(int pass, bool& limited) const {
    std::vector<double> added;
    limited = false;
    if (support_.t.size() < 3) return added;
    const Tolerance plane = tolerance_of(support_.uv);
    const Tolerance space = tolerance_of(support_.xyz);
    Bends bends;
    for (std::size_t i = 0; i + 1 < support_.t.size(); ++i) {
      const Excess excess = edge_excess(i, plane, space, bends);
      const int parts = std::min(excess.parts, max_parts_in(pass));
      limited = limited || excess.ratio > 1;
      if (excess.ratio <= 1 || !divisible(i, parts)) continue;
      for (int k = 1; k < parts; ++k) {
        const auto seed = (static_cast<std::uint64_t>(pass) << 40U) + (static_cast<std::uint64_t>(i) << 8U) +
                          static_cast<std::uint64_t>(k);
        const double shift = pass % 2 == 0 ? 0 : 0.1 * noise(seed);
        added.push_back(lerp_t(support_.t[i], support_.t[i + 1], (k + shift) / parts));
      }
      if (support_.t.size() + added.size() > max_samples_) break;
    }
    if (support_.t.size() + added.size() > max_samples_) added.resize(max_samples_ - support_.t.size());
    return added;
  }

  void note_limits() {
    if (support_.t.size() < 3) return;
    const Tolerance plane = tolerance_of(support_.uv);
    const Tolerance space = tolerance_of(support_.xyz);
    double worst = 1;
    Bends bends;
    for (std::size_t i = 0; i + 1 < support_.t.size(); ++i) {
      const double ratio = edge_excess(i, plane, space, bends).ratio;
      if (ratio > worst) {
        worst = ratio;
        support_.limited = true;
        support_.limited_t = (support_.t[i] + support_.t[i + 1]) / 2;
      }
    }
  }

  Cad& cad_;
  int face_, ic_;
  double relative_ = 0;
  std::size_t max_samples_ = 0;
  CurveSupport support_;
};

}  // namespace

CurveSupport build_support(Cad& cad, int face, int ic, const SupportOptions& options) {
  return Builder(cad, face, ic, options).run();
}

CurvePoint refine_t(Cad& cad, int face, int ic, const CurveSupport& support, double t, double t_low, double t_high,
                    Vec3 target) {
  const auto evaluate = [&](double at) {
    CurvePoint p;
    p.t = at;
    p.uv = cad.curve(face, ic, want_position, at).c;
    p.xyz = surface_at(cad, face, want_position, p.uv).s;
    p.distance = norm(p.xyz - target);
    return p;
  };
  CurvePoint best = evaluate(std::clamp(t, t_low, t_high));
  for (int step = 0; step < 2; ++step) {
    const auto above = std::upper_bound(support.t.begin() + 1, support.t.end() - 1, best.t);
    const auto i = static_cast<std::size_t>(above - support.t.begin()) - 1;
    const Vec3 chord = support.xyz[i + 1] - support.xyz[i];
    const double squared = dot(chord, chord);
    if (!(squared > 0)) break;
    const double share = dot(target - best.xyz, chord) / squared;
    const double next = std::clamp(best.t + share * (support.t[i + 1] - support.t[i]), t_low, t_high);
    // A further evaluation is worth its cost only when the step is a good part of the remaining distance.
    if (next == best.t || std::abs(share) * std::sqrt(squared) < 0.1 * best.distance) break;
    const CurvePoint candidate = evaluate(next);
    if (!(candidate.distance < best.distance)) break;
    best = candidate;
  }
  return best;
}

}  // namespace carreau
