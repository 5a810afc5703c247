// The part of a round that is about sizes that differ by direction.
#include <algorithm>
#include <cmath>

#include "curve/unit_discretisation.h"
#include "surface/grade/grading_round.h"

namespace carreau::detail {

namespace {

// What samples of sizes may be above those that corners promise.
constexpr double rough_metric = 0.1;
// Of sizes along curves, which are interpolated between samples.
constexpr double interpolation_error = 0.02;

}  // namespace

GradedModel GradingRound::grade_by_direction(const std::vector<SizeSamples>& raw) {
  const double slope = slope_of_gradation(options_.gradation);
  collect_places();
  const std::vector<TangentMetric>& prescribed = prescribed_;
  for (std::size_t c = 0; c < raw.size(); ++c) bound_by_curve(c, raw[c]);
  bound_by_points(raw);
  metric_ = grade_metrics(graph_, std::move(metric_), metric_sources_, slope, monitor_);
  for (const auto& t : graph_.triangles)
    for (int i = 0; i < 3; ++i) {
      const Vec3 e = graph_.xyz[graph_.places[t[(i + 1) % 3]].vertex] - graph_.xyz[graph_.places[t[i]].vertex];
      const TangentMetric &p = metric_[t[i]], &q = metric_[t[(i + 1) % 3]];
      long_edges_ += normalised_length(SizeLaw::linear, p.along(unit(e)), q.along(unit(e)), norm(e)) > too_long;
    }
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const auto first = metric_.begin() + static_cast<std::ptrdiff_t>(place_of_[f]);
    faces_[f].metric.assign(first, first + static_cast<std::ptrdiff_t>(faces_[f].uv.size()));
    find_rough_metrics(faces_[f], prescribed.data() + place_of_[f], samples_[f]);
  }
  GradedModel result;
  result.triangles = graph_.triangles.size();
  result.field = std::make_shared<GradedField>(slope, std::move(faces_));
  for (std::size_t c = 0; c < raw.size(); ++c) result.curves.push_back(bounded_along(c, raw[c]));
  return result;
}

void GradingRound::collect_places() {
  if (!places_of_.empty()) return;
  places_of_.resize(graph_.xyz.size());
  for (std::size_t p = 0; p < graph_.places.size(); ++p)
    places_of_[graph_.places[p].vertex].push_back(static_cast<int>(p));
}

// The unit tangent of a curve at a vertex, in the tangent plane of a place.
Vec3 GradingRound::tangent(std::size_t c, std::size_t node, int place) const {
  const std::vector<Vec3>& xyz = curves_[c].xyz;
  const std::size_t last = xyz.size() - 1;
  const Vec3 chord = xyz[std::min(node + 1, last)] - xyz[node > 0 ? node - 1 : 0], n = graph_.places[place].normal;
  return unit(chord - dot(chord, n) * n);
}

// In faces that the curve bounds or crosses: from others at its ends it may point anywhere.
std::vector<int> GradingRound::places_on(std::size_t c, std::size_t node) const {
  const std::vector<CurveUse>& uses = model_.topology.curves[c].uses;
  std::vector<int> places;
  for (const int p : places_of_[node_of_[c][node]])
    if (std::any_of(uses.begin(), uses.end(), [f = face_of(p)](const CurveUse& use) { return use.face == f; }))
      places.push_back(p);
  return places;
}

// Sizes of curves are sizes along them.
void GradingRound::bound_by_curve(std::size_t c, const SizeSamples& raw) {
  if (curves_[c].indivisible) return;
  for (std::size_t k = 0; k < curves_[c].r.size(); ++k) {
    const double h = raw.size_at(curves_[c].r[k]);
    for (const int p : places_on(c, k)) {
      const Vec3 t = tangent(c, k, p);
      // What is interpolated between samples differs a little from what holds at vertices.
      if (metric_[p].along(t) > (1 + interpolation_error) * h) metric_[p].bound_along(t, h);
    }
  }
}

// A point that is smaller than its curves has a size of its own.
void GradingRound::bound_by_points(const std::vector<SizeSamples>& raw) {
  std::vector<double> of_curves(model_.topology.points.size(), infinity);
  for (std::size_t c = 0; c < raw.size(); ++c) {
    if (curves_[c].indivisible) continue;
    const Curve& curve = model_.topology.curves[c];
    of_curves[curve.end1] = std::min(of_curves[curve.end1], raw[c].h.front());
    of_curves[curve.end2] = std::min(of_curves[curve.end2], raw[c].h.back());
  }
  for (std::size_t v = 0; v < of_curves.size(); ++v) {
    const double h = rules_.at_point(static_cast<int>(v));
    if (h > (1 - interpolation_error) * of_curves[v]) continue;
    for (const int p : places_of_[v]) {
      metric_[p].h1 = std::min(metric_[p].h1, h);
      metric_[p].h2 = std::min(metric_[p].h2, h);
    }
  }
}

// As find_rough().
void GradingRound::find_rough_metrics(GradedFace& face, const TangentMetric* prescribed,
                                      const std::vector<Sample>& samples) {
  const auto less = [](double p, double q) { return p < (1 - roughness) * q; };
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    for (const std::int32_t v : face.triangles[t])
      if (less(face.metric[v].h1, prescribed[v].h1) || less(face.metric[v].h2, prescribed[v].h2)) face.smooth[t] = 0;
  for (const Sample& s : samples) {
    double h1 = 0, h2 = 0;
    for (int i = 0; i < 3; ++i) {
      const TangentMetric& corner = face.metric[face.triangles[s.triangle][i]];
      h1 += s.promised[i] * corner.matched(s.sizes.d1);
      h2 += s.promised[i] * corner.matched(s.sizes.d2);
    }
    if (less(s.sizes.h1, (1 - rough_metric) * h1) || less(s.sizes.h2, (1 - rough_metric) * h2))
      face.smooth[s.triangle] = 0;
  }
  widen_rough(face);
}

SizeSamples GradingRound::bounded_along(std::size_t c, const SizeSamples& raw) const {
  const DiscreteCurve& d = curves_[c];
  SizeSamples result;
  std::vector<double> h;
  for (std::size_t k = 0; k < d.r.size(); ++k) {
    h.push_back(raw.size_at(d.r[k]));
    if (d.indivisible) continue;
    for (const int p : places_on(c, k)) h.back() = std::min(h.back(), metric_[p].along(tangent(c, k, p)));
  }
  const auto add = [&](double r, double size) {
    result.r.push_back(r);
    result.h.push_back(std::min(size, raw.size_at(r)));
    result.physical.push_back(raw.physical_at(r));
  };
  for (std::size_t k = 0; k + 1 < d.r.size(); ++k) {
    add(d.r[k], h[k]);
    if (d.indivisible) continue;
    for (const double r : between(d.r[k], d.r[k + 1], raw.r))
      add(r, std::lerp(h[k], h[k + 1], (r - d.r[k]) / (d.r[k + 1] - d.r[k])));
  }
  add(d.r.back(), h.back());
  return result;
}

}  // namespace carreau::detail
