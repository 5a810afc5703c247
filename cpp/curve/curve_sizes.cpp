// SPDX-License-Identifier: BSD-3-Clause
#include "curve/curve_sizes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "curve/unit_discretisation.h"
#include "support/error.h"
#include "support/format.h"
#include "support/segment.h"

namespace carreau {
namespace {

constexpr double longest_interval = 4;      ///< times lss
constexpr double shortest_interval = 0.5;   ///< times lss
constexpr double steepest_interval = 1.15;  ///< ratio of the sizes at its ends
/// Limits if the field is known exactly along the curve: edges of RR-2818 sec. 6.2 are then equal within .2 %.
constexpr double shortest_exact = 0.005, steepest_exact = 1.003;
constexpr int initial_intervals = 4;
constexpr std::size_t most_samples = 20'000;
constexpr double narrowest = 1e-7;  ///< of the curve's length
/// Share of its extent within which steep places of a source are sampled on the curve; and their spacing.
constexpr double beside_curve = 0.01, steep_spacing = 0.002;

/// Two samples of sizes from curvature may lie on two inflections. An interval is halved if the curve turns by more
/// than this between them, down to a share of the curve at kinks. It is also halved if its mean radius requires so many
/// times the edges of the samples.
constexpr double max_turning = 90 * std::numbers::pi / 180;
constexpr double max_missed = 2;
constexpr double min_bent = 1. / 256;

struct Sample {
  double r = 0;
  double h = 0, physical = 0;
  bool answered = false;
};

double interpolate(const SizeSamples& samples, const std::vector<double>& values, double at) noexcept {
  const auto above = std::upper_bound(samples.r.begin() + 1, samples.r.end() - 1, at);
  const auto i = static_cast<std::size_t>(above - samples.r.begin()) - 1;
  if (!std::isfinite(values[i]) || !std::isfinite(values[i + 1])) return std::min(values[i], values[i + 1]);
  const double x = std::clamp((at - samples.r[i]) / (samples.r[i + 1] - samples.r[i]), 0., 1.);
  return interpolate_size(samples.law, values[i], values[i + 1], x);
}

Sample ask(const CurveModel& model, int curve, SizeRules& rules, double r) {
  const CurveSizes sizes = rules.ask_on_curve(curve, parameters_at(model, curve, r), r);
  Sample sample;
  sample.r = r;
  sample.answered = sizes.answered;
  sample.physical = sizes.physical;
  sample.h = sizes.h;
  return sample;
}

bool too_coarse(const Sample& left, const Sample& right, SizeLaw law, double length, double lss, bool exact) {
  if (right.r - left.r < narrowest) return false;
  const double shortest = exact ? shortest_exact : shortest_interval;
  const double steepest = exact ? steepest_exact : steepest_interval;
  const double edges = normalised_length(law, left.h, right.h, (right.r - left.r) * length);
  if (edges > longest_interval * lss) return true;
  return edges > shortest * lss && std::max(left.h, right.h) > steepest * std::min(left.h, right.h);
}

/// Fraction of the curve's length at the nearest point of a use's support to a place. The support is given in the
/// parameter plane or in space. Returns -1 when the point is farther away than `reach`.
template <typename V>
double fraction_near(const CurveSupport& support, const std::vector<V>& points, V place, double reach) noexcept {
  double best = reach * reach, fraction = -1;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double w = fraction_on_segment(place, points[i], points[i + 1]);
    const V away = place - lerp(points[i], points[i + 1], w);
    if (dot(away, away) > best) continue;
    best = dot(away, away);
    fraction = ((1 - w) * support.arc[i] + w * support.arc[i + 1]) / support.length();
  }
  return fraction;
}

/// Fractions at which a source's field is steep: it would be missed between samples that are far apart.
std::vector<double> steep_fractions(const CurveModel& model, int curve, const SizeRules& rules) {
  std::vector<double> fractions;
  const auto add = [&](double r) {
    if (r > narrowest && r < 1 - narrowest) fractions.push_back(r);
  };
  const CurveUse& first = model.curve(curve).uses.front();
  const CurveSupport& in_space = model.support(first);
  if (in_space.length() > 0)
    for (const SteepPlace& place : rules.steep_in_space()) {
      if (norm(place.at - in_space.xyz.front()) > in_space.length() + place.reach) continue;
      const double fraction = fraction_near(in_space, in_space.xyz, place.at, place.reach);
      if (fraction >= 0) add(first.reversed ? 1 - fraction : fraction);
    }
  for (const CurveUse& use : model.curve(curve).uses) {
    const CurveSupport& support = model.support(use);
    const std::vector<Vec2> places = rules.steep_places(use.face);
    if (places.empty() || !(support.length() > 0)) continue;
    double extent = 0;
    for (const Vec2& p : support.uv) extent = std::max(extent, norm(p - support.uv.front()));
    for (const Vec2& place : places) {
      const double fraction = fraction_near(support, support.uv, place, beside_curve * extent);
      if (fraction >= 0) add(use.reversed ? 1 - fraction : fraction);
    }
  }
  std::sort(fractions.begin(), fractions.end());
  std::vector<double> apart;
  for (const double r : fractions)
    if (apart.empty() || r - apart.back() > steep_spacing) apart.push_back(r);
  return apart;
}

/// Fractions at which sources report kinks of their fields along the curve.
std::vector<double> kink_fractions(const CurveModel& model, int curve, const SizeRules& rules) {
  std::vector<double> fractions;
  for (const CurveUse& use : model.curve(curve).uses) {
    const CurveSupport& support = model.support(use);
    if (!(support.length() > 0)) continue;
    for (const double t : rules.kinks_on_curve(use)) {
      const double r = support.arc_at_t(t) / support.length();
      fractions.push_back(use.reversed ? 1 - r : r);
    }
  }
  std::sort(fractions.begin(), fractions.end());
  const auto same = [](double r, double s) { return s - r <= narrowest; };  // of two uses of the curve
  fractions.erase(std::unique(fractions.begin(), fractions.end(), same), fractions.end());
  return fractions;
}

/// The turning of a curve, by the support of its first use.
class Turning {
 public:
  /// If `known` is false, the curve is not evaluated.
  Turning(const CurveModel& model, int curve, bool known) : known_(known) {
    if (!known) return;
    const CurveUse& use = model.curve(curve).uses.front();
    const CurveSupport& support = model.support(use);
    r_ = {0};
    angle_ = {0};
    for (std::size_t i = 1; i + 1 < support.xyz.size(); ++i) {
      const Vec3 p = support.xyz[i] - support.xyz[i - 1], q = support.xyz[i + 1] - support.xyz[i];
      const double fraction = support.arc[i] / support.length();
      r_.push_back(fraction);
      angle_.push_back(angle_.back() + std::atan2(norm(cross(p, q)), dot(p, q)));
    }
    r_.push_back(1);
    angle_.push_back(angle_.back());
    if (!use.reversed) return;
    std::reverse(r_.begin(), r_.end());
    std::reverse(angle_.begin(), angle_.end());
    for (double& r : r_) r = 1 - r;
    const double whole = angle_.front();
    for (double& a : angle_) a = whole - a;
    std::copy(angle_.begin() + 1, angle_.end(), angle_.begin());  // with the corner that begins a segment, as before
  }
  [[nodiscard]] bool too_bent(const Sample& left, const Sample& right) const {
    return known_ && right.r - left.r > min_bent && up_to(right.r) - up_to(left.r) > max_turning;
  }
  /// `d`: the length between both.
  [[nodiscard]] bool misses_bend(const Sample& left, const Sample& right, double d, const SizeRules& rules,
                                 double lss) const {
    if (!known_ || right.r - left.r <= min_bent) return false;
    const double turned = direction_at(right.r) - direction_at(left.r);
    if (!(turned > 0)) return false;
    const double asked = d / rules.clamped_geometric(d / turned);
    return asked > shortest_interval * lss && asked > max_missed * normalised_length(rules.law(), left.h, right.h, d);
  }

 private:
  /// Angle of the tangent to the first tangent: each segment's direction holds in its middle, and the angle is linear
  /// between.
  [[nodiscard]] double direction_at(double r) const {
    const auto after = std::upper_bound(r_.begin() + 1, r_.end() - 1, r);
    const auto i = static_cast<std::size_t>(after - r_.begin());  // r_[i - 1] <= r < r_[i]
    const double middle = 0.5 * (r_[i - 1] + r_[i]);
    const std::size_t j = r < middle ? i - 1 : i;  // the nearer end
    if (j == 0 || j + 1 == r_.size()) return angle_[i - 1];
    const double first = 0.5 * (r_[j - 1] + r_[j]), last = 0.5 * (r_[j] + r_[j + 1]);
    const double share = last > first ? (r - first) / (last - first) : 1;
    return angle_[j - 1] + share * (angle_[j] - angle_[j - 1]);
  }
  [[nodiscard]] double up_to(double r) const {
    const auto after = std::upper_bound(r_.begin(), r_.end(), r);
    return angle_[static_cast<std::size_t>(after - r_.begin()) - 1];
  }

  bool known_;
  std::vector<double> r_, angle_;  // angle_[i]: of all corners up to r_[i]
};

std::vector<Sample> refine(const CurveModel& model, int curve, SizeRules& rules, double lss) {
  const double length = model.length(curve);
  std::vector<double> starts = steep_fractions(model, curve, rules);
  const std::vector<double> kinks = kink_fractions(model, curve, rules);
  for (const double r : kinks)
    if (r > narrowest && r < 1 - narrowest) starts.push_back(r);
  for (int i = 0; i <= initial_intervals; ++i) starts.push_back(static_cast<double>(i) / initial_intervals);
  std::sort(starts.begin(), starts.end());
  starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
  std::vector<Sample> samples;
  for (const double r : starts) samples.push_back(ask(model, curve, rules, r));
  const Turning turning(model, curve, rules.uses_curvature());
  for (bool again = true; again;) {
    again = false;
    std::vector<Sample> finer{samples.front()};
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
      const bool room = samples.size() + finer.size() < most_samples + i;
      const Sample &left = samples[i], &right = samples[i + 1];
      const double d = (right.r - left.r) * length;
      const bool bent = turning.too_bent(left, right) || turning.misses_bend(left, right, d, rules, lss);
      if (room && (bent || too_coarse(left, right, rules.law(), length, lss, !kinks.empty()))) {
        finer.push_back(ask(model, curve, rules, (left.r + right.r) / 2));
        again = true;
      }
      finer.push_back(right);
    }
    samples = std::move(finer);
  }
  return samples;
}

}  // namespace

double parameter_at(const CurveModel& model, const CurveUse& use, double r) {
  const CurveSupport& support = model.support(use);
  const double fraction = use.reversed ? 1 - r : r;
  // A use without length (one point of space) can only use its parameter.
  if (!(support.length() > 0)) return (1 - fraction) * support.t.front() + fraction * support.t.back();
  return support.t_at_arc(fraction * support.length());
}

std::vector<double> parameters_at(const CurveModel& model, int curve, double r) {
  std::vector<double> t;
  for (const CurveUse& use : model.curve(curve).uses) t.push_back(parameter_at(model, use, r));
  return t;
}

double SizeSamples::size_at(double at) const noexcept { return interpolate(*this, h, at); }
double SizeSamples::physical_at(double at) const noexcept { return interpolate(*this, physical, at); }

SizeSamples sample_sizes(const CurveModel& model, int curve, SizeRules& rules, const CurveOptions& options) {
  if (!(options.lss > 0)) throw InvalidArgument("LSS must be positive; it is " + format_number(options.lss));
  SizeSamples result;
  result.law = rules.law();
  const Curve& c = model.curve(curve);
  const auto at_ends_only = [&](double h1, double h2, double p1, double p2) {
    result.r = {0, 1};
    result.h = {h1, h2};
    result.physical = {p1, p2};
  };
  if (const auto h = rules.constant()) {
    at_ends_only(*h, *h, *h, *h);
    return result;
  }
  const auto at_points = [&] {
    at_ends_only(rules.at_point(c.end1), rules.at_point(c.end2), rules.physical_at_point(c.end1),
                 rules.physical_at_point(c.end2));
  };
  if (c.degenerate || !(model.length(curve) > 0)) {
    at_points();
    return result;
  }
  const std::vector<Sample> samples = refine(model, curve, rules, options.lss);
  const bool silent = std::none_of(samples.begin(), samples.end(), [](const Sample& s) { return s.answered; });
  if (silent && !rules.uses_curvature()) {
    at_points();
    return result;
  }
  for (const Sample& sample : samples) {
    result.r.push_back(sample.r);
    result.h.push_back(sample.h);
    result.physical.push_back(sample.physical);
  }
  if (options.ends == EndSizes::of_point) {
    result.h.front() = rules.at_point(c.end1);
    result.h.back() = rules.at_point(c.end2);
    result.physical.front() = rules.physical_at_point(c.end1);
    result.physical.back() = rules.physical_at_point(c.end2);
  }
  return result;
}

}  // namespace carreau
