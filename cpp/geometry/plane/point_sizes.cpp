// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/point_sizes.h"

#include <algorithm>
#include <cmath>

namespace carreau {

namespace {

/// Chords of each piece: they give the lengths of curves.
constexpr int steps = 32;

/// Lengths from the start of an arc, at t = 0, 1 / steps, ...
std::vector<double> lengths_of(const PlaneArc& arc) {
  std::vector<double> lengths{0};
  Vec2 before = arc.polyline.front();
  for (const PlanePiece& piece : arc.pieces)
    for (int i = 1; i <= steps; ++i) {
      const Vec2 here = piece.at(static_cast<double>(i) / steps);
      lengths.push_back(lengths.back() + norm(Vec2(here - before)));
      before = here;
    }
  return lengths;
}

}  // namespace

PointSizes::PointSizes(const PlaneDomainInput& input, std::shared_ptr<const PlaneCad> cad, std::map<int, int> points)
    : cad_(std::move(cad)), points_(std::move(points)) {
  for (const PlanePoint& point : input.points) {
    std::optional<Value>& value = value_.emplace_back();
    if (point.metric)
      value = Value{*point.metric, false};
    else if (point.size)
      value = Value{{1 / (*point.size * *point.size), 0, 1 / (*point.size * *point.size)}, true};
  }
  const std::vector<PlaneArc>& arcs = cad_->arcs();
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    lengths_.push_back(lengths_of(arcs[a]));
    Known& known = known_.emplace_back();
    for (std::size_t i = 0; i <= arcs[a].pieces.size(); ++i) {
      const std::optional<Value>& value = value_[arcs[a].passed[i]];
      if (!value) continue;
      known.parameter.push_back(static_cast<double>(i));
      known.length.push_back(length_at(static_cast<int>(a), known.parameter.back()));
      known.value.push_back(*value);
    }
  }
}

double PointSizes::length_at(int arc, double t) const {
  const std::vector<double>& lengths = lengths_[arc];
  const auto last = static_cast<double>(lengths.size() - 1);
  const double at = std::clamp(t * steps, 0.0, last), k = std::min(std::floor(at), last - 1);
  // Adds the chord from the previous step: exact where the curve is straight, whatever its speed.
  const PlaneArc& curve = cad_->arcs()[static_cast<std::size_t>(arc)];
  return lengths[static_cast<std::size_t>(k)] + norm(Vec2(curve.at(at / steps) - curve.at(k / steps)));
}

Prescription PointSizes::answer(const Value& value) {
  return value.is_size ? Prescription::of_size(1 / std::sqrt(value.metric.a))
                       : Prescription::of_parameter(value.metric);
}

std::vector<double> PointSizes::kinks_on_curve(int face, int ic) const {
  return known_[static_cast<std::size_t>(cad_->arc_of(face, ic))].parameter;
}

Prescription PointSizes::on_surface(int /*face*/, Vec2 /*uv*/, Vec3 /*xyz*/) { return {}; }

Prescription PointSizes::on_curve(int face, int ic, double t, Vec2 /*uv*/, Vec3 /*xyz*/) {
  const int index = cad_->arc_of(face, ic);
  const Known& known = known_[index];
  if (known.value.empty()) return {};
  const double length = length_at(index, t);
  const auto above = std::upper_bound(known.length.begin(), known.length.end(), length);
  if (above == known.length.begin()) return answer(known.value.front());
  if (above == known.length.end()) return answer(known.value.back());
  const auto k = static_cast<std::size_t>(above - known.length.begin());
  const Value &p = known.value[k - 1], &q = known.value[k];
  const double share = (length - known.length[k - 1]) / (known.length[k] - known.length[k - 1]);
  return answer({interpolate(p.metric, q.metric, share, law_), p.is_size && q.is_size});
}

Prescription PointSizes::at_point(int point, Vec3 /*xyz*/) {
  const auto found = points_.find(point);
  if (found == points_.end() || !value_[found->second]) return {};
  const Value& value = *value_[found->second];
  if (value.is_size) return answer(value);
  // A point has no parameter plane: the metric is in the plane z = 0 of space.
  const Metric2& m = value.metric;
  return Prescription::of_space({m.a, m.b, 0, m.c, 0, (m.a + m.c) / 2});
}

}  // namespace carreau
