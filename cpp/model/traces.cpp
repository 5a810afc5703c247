// SPDX-License-Identifier: BSD-3-Clause
#include "model/traces.h"

#include <algorithm>

#include "model/places.h"
#include "support/box_tree.h"
#include "support/infinity.h"
#include "support/segment.h"

namespace carreau {

namespace {
// Segments on either side of a point's nearest segment; the search for the next point starts with them.
constexpr std::size_t beside = 2;

/// Boxes around runs of segments of a trace. Skips runs that cannot be near, which does not change any distance.
class Runs {
 public:
  explicit Runs(std::span<const Vec3> trace) {
    for (std::size_t first = 1; first < trace.size(); first += length) {
      BoxTree::Box& box = boxes_.emplace_back();
      for (std::size_t i = first - 1; i < std::min(first + length, trace.size()); ++i) box.add(trace[i]);
    }
    double largest = 0;
    for (const BoxTree::Box& box : boxes_)
      largest = std::max({largest, box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()});
    rounding2_ = rounding * largest * (rounding * largest);
  }

  /// Calls look(first, last) for the ends of segments that may be nearer to p than the root of best.
  template <typename Look>
  void each_near(const Vec3& p, std::size_t points, const double& best, const Look& look) const {
    for (std::size_t k = 0; k < boxes_.size(); ++k)
      if (boxes_[k].squared_distance(p) <= (1 + wider) * best + rounding2_)
        look(1 + k * length, std::min(1 + (k + 1) * length, points));
  }

 private:
  static constexpr std::size_t length = 16;
  // Far above the rounding of squared distances, and of coordinates.
  static constexpr double wider = 1e-5, rounding = 1e-11;
  std::vector<BoxTree::Box> boxes_;
  double rounding2_ = 0;
};
}  // namespace

void check_traces(const Model& model, const CurveTraces& traces) {
  if (traces.size() != model.faces.size())
    throw InvalidArgument("the model has " + std::to_string(model.faces.size()) + " faces, its traces " +
                          std::to_string(traces.size()));
  for (std::size_t f = 0; f < traces.size(); ++f) {
    if (traces[f].size() != model.faces[f].curves.size())
      throw InvalidArgument(Where{.face = model.faces[f].ref},
                            "the face has " + std::to_string(model.faces[f].curves.size()) + " curves, its traces " +
                                std::to_string(traces[f].size()));
    for (std::size_t c = 0; c < traces[f].size(); ++c)
      if (traces[f][c].size() < 2) throw InvalidArgument(place_of(model, f, c), "the trace has less than two points");
  }
}

double trace_length(std::span<const Vec3> trace) {
  double length = 0;
  for (std::size_t i = 1; i < trace.size(); ++i) length += norm(trace[i] - trace[i - 1]);
  return length;
}

Vec3 trace_point(std::span<const Vec3> trace, double fraction) {
  const double target = fraction * trace_length(trace);
  double before = 0;
  for (std::size_t i = 1; i < trace.size(); ++i) {
    const double step = norm(trace[i] - trace[i - 1]);
    if (step > 0 && before + step >= target)
      return lerp(trace[i - 1], trace[i], std::clamp((target - before) / step, 0.0, 1.0));
    before += step;
  }
  return trace.back();
}

TracePlace nearest_on_trace(std::span<const Vec3> trace, const Vec3& p) {
  TracePlace nearest;
  double before = 0;
  for (std::size_t i = 1; i < trace.size(); ++i) {
    const double length = norm(trace[i] - trace[i - 1]);
    const double w = fraction_on_segment(p, trace[i - 1], trace[i]);
    const double distance = norm(p - lerp(trace[i - 1], trace[i], w));
    if (distance < nearest.distance) nearest = {before + w * length, distance, i - 1, w};
    before += length;
  }
  return nearest;
}

double one_sided_distance(std::span<const Vec3> from, std::span<const Vec3> to, double enough, double negligible) {
  double worst = negligible;
  std::size_t nearest = 1;  // segment that ends there: near the next point too, as a rule
  const Runs runs(to);
  for (const Vec3& p : from) {
    double best = infinity;
    // A point that is no farther than an earlier point is irrelevant.
    const auto look = [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last && best > worst * worst; ++i) {
        const double distance = squared_distance_to_segment(p, to[i - 1], to[i]);
        if (distance < best) best = distance, nearest = i;
      }
    };
    // Traces of one curve have their points in nearly equal places: tries the previous segment, or the next one.
    const std::size_t at = nearest;
    look(at, std::min(at + 2, to.size()));
    if (at > 1) look(at - 1, at);
    look(std::max(at, beside + 1) - beside, std::min(at + beside, to.size()));
    if (best > worst * worst) runs.each_near(p, to.size(), best, look);
    worst = std::max(worst, std::sqrt(best));
    if (worst > enough) return worst;
  }
  return worst;
}

double hausdorff_distance(std::span<const Vec3> p, std::span<const Vec3> q, double enough, double negligible) {
  const double first = one_sided_distance(p, q, enough, negligible);
  return first > enough ? first : std::max(first, one_sided_distance(q, p, enough, negligible));
}

double trace_deviation(std::span<const Vec3> trace) {
  double worst = 0;
  for (std::size_t i = 2; i < trace.size(); ++i)
    worst = std::max(worst, squared_distance_to_segment(trace[i - 1], trace[i - 2], trace[i]));
  return std::sqrt(worst);
}

double trace_extent(std::span<const Vec3> trace) {
  double extent = 0;
  for (const Vec3& p : trace) extent = std::max(extent, norm(p - trace.front()));
  return extent;
}

double traces_diagonal(const CurveTraces& traces) {
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const auto& of_face : traces)
    for (const auto& trace : of_face)
      for (const Vec3& p : trace) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
  return low.x() > high.x() ? 0 : norm(high - low);
}

}  // namespace carreau
