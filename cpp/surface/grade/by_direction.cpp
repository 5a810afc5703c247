// SPDX-License-Identifier: BSD-3-Clause
// A metric at each place (Hc-correction).
#include <algorithm>
#include <cmath>

#include "gradation/place_fans.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "support/shares.h"
#include "surface/grade/graph_sizes.h"
#include "surface/grade/thresholds.h"

namespace carreau::detail {

namespace {

using namespace thresholds::grade;

/// Returns the unit tangent of a curve at a vertex, in the tangent plane of a place.
Vec3 tangent(const GradingWork& work, std::size_t c, std::size_t node, int place) {
  const std::vector<Vec3>& xyz = work.curves[c].xyz;
  const std::size_t last = xyz.size() - 1;
  const Vec3 chord = xyz[std::min(node + 1, last)] - xyz[node > 0 ? node - 1 : 0], n = work.graph.places[place].normal;
  return unit(chord - dot(chord, n) * n);
}

/// Marks the triangles with a size below the prescribed one, or with a sample below the interpolation between the corners.
void find_rough(GradedFace& face, const TangentMetric* prescribed, const std::vector<GradingWork::Sample>& samples) {
  const auto less = [](double p, double q) { return p < (1 - shares::small) * q; };
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    for (const std::int32_t v : face.triangles[t])
      if (less(face.metric[v].h1, prescribed[v].h1) || less(face.metric[v].h2, prescribed[v].h2)) face.smooth[t] = 0;
  for (const GradingWork::Sample& s : samples) {
    double h1 = 0, h2 = 0;
    for (int i = 0; i < 3; ++i) {
      const TangentMetric& corner = face.metric[face.triangles[s.triangle][i]];
      h1 += s.promised[i] * corner.matched(s.sizes.d1);
      h2 += s.promised[i] * corner.matched(s.sizes.d2);
    }
    if (less(s.sizes.h1, (1 - shares::notable) * h1) || less(s.sizes.h2, (1 - shares::notable) * h2))
      face.smooth[s.triangle] = 0;
  }
  widen_rough(face);
}

class DirectionalSizes final : public GraphSizes {
 public:
  using GraphSizes::GraphSizes;

  [[nodiscard]] bool isotropic() const noexcept override { return false; }

  void keep_sample(Vec2 uv, const SurfaceJet& jet, Metric2 metric,
                   std::vector<GradingWork::Sample>& samples) const override {
    if (const auto sizes = tangent_metric(jet, metric)) samples.push_back({uv, jet.s, 0, *sizes});
  }
  void keep_vertex(FaceMetric& prescribed, Vec2 uv, const SurfaceJet& jet, Metric2 metric,
                   FaceInGraph& face) const override {
    auto sizes = tangent_metric(jet, metric);
    if (!sizes) sizes = prescribed.limit(uv, jet);
    face.metric.push_back(sizes ? *sizes : TangentMetric{});
  }
  void add_face(const FaceInGraph& made, std::size_t /*first*/) override {
    metric_.insert(metric_.end(), made.metric.begin(), made.metric.end());
  }
  void orient(std::size_t place) override {
    TangentMetric& m = metric_[place];
    const Vec3 n = work_.graph.places[place].normal;
    if (!std::isfinite(m.h1)) {  // a pole does not define directions
      m.d1 = unit(cross(n, std::abs(n.x()) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})), m.d2 = cross(n, m.d1);
      return;
    }
    // The directions of a limit lie in the tangent plane of a meridian. A bound along the normal of that plane would make
    // all sizes vanish.
    const Vec3 of_limit = cross(m.d1, m.d2), near = dot(of_limit, n) < 0 ? -1 * of_limit : of_limit;
    if (dot(near, n) < (1 - rounding_of::places)) m.d1 = roll(m.d1, near, n), m.d2 = roll(m.d2, near, n);
  }
  void add_source(int place, const GradingWork::Sample& sample, const Vec3& way) override {
    sources_.push_back({place, sample.sizes, way});
  }
  void complete() override {
    prescribed_ = metric_;
    places_of_.resize(work_.graph.xyz.size());
    for (std::size_t p = 0; p < work_.graph.places.size(); ++p)
      places_of_[work_.graph.places[p].vertex].push_back(static_cast<int>(p));
  }

  void bound_across(int vertex, const Vec3& across, double h) override {
    for (const int p : places_of_[vertex]) {
      const Vec3 normal = work_.graph.places[p].normal;
      metric_[p].bound_along(unit(across - dot(across, normal) * normal), h);
    }
  }
  [[nodiscard]] double largest_at(int place) const override { return std::max(metric_[place].h1, metric_[place].h2); }
  void bound_facing(const FacingPlace& facing, double h) override { bound(facing.place, h); }

  void grade(const std::vector<SizeSamples>& raw, double slope) override {
    for (std::size_t c = 0; c < raw.size(); ++c) bound_by_curve(c, raw[c]);
    bound_by_points(raw);
    metric_ = grade_metrics(work_.graph, std::move(metric_), sources_, slope, work_.monitor);
  }
  [[nodiscard]] double along(int place, const Vec3& direction) const noexcept override {
    return metric_[place].along(direction);
  }
  void give_to_face(std::size_t f) override {
    GradedFace& face = work_.faces[f];
    const auto first = metric_.begin() + static_cast<std::ptrdiff_t>(work_.place_of[f]);
    face.metric.assign(first, first + static_cast<std::ptrdiff_t>(face.uv.size()));
    find_rough(face, prescribed_.data() + work_.place_of[f], work_.samples[f]);
  }
  [[nodiscard]] double at_node(std::size_t c, std::size_t node, const SizeSamples& raw) const override {
    double h = raw.size_at(work_.curves[c].r[node]);
    if (work_.curves[c].indivisible) return h;
    for (const int p : places_on(c, node)) h = std::min(h, metric_[p].along(tangent(work_, c, node, p)));
    return h;
  }
  [[nodiscard]] double between_nodes(std::size_t /*curve*/, std::size_t /*node*/, double /*w*/, double h, double known,
                                     const GradedField& /*field*/) const override {
    return std::min(h, known);
  }

 private:
  void bound(int place, double h) {
    metric_[place].h1 = std::min(metric_[place].h1, h);
    metric_[place].h2 = std::min(metric_[place].h2, h);
  }

  // Returns the places in faces that the curve bounds or crosses; in other faces at its ends it may point anywhere.
  [[nodiscard]] std::vector<int> places_on(std::size_t c, std::size_t node) const {
    const std::vector<CurveUse>& uses = work_.model.topology.curves[c].uses;
    std::vector<int> places;
    for (const int p : places_of_[work_.node_of[c][node]])
      if (std::any_of(uses.begin(), uses.end(), [f = face_of(work_, p)](const CurveUse& use) { return use.face == f; }))
        places.push_back(p);
    return places;
  }
  // Sizes of curves are sizes along them.
  void bound_by_curve(std::size_t c, const SizeSamples& raw) {
    if (work_.curves[c].indivisible) return;
    for (std::size_t k = 0; k < work_.curves[c].r.size(); ++k) {
      const double h = raw.size_at(work_.curves[c].r[k]);
      for (const int p : places_on(c, k)) {
        const Vec3 t = tangent(work_, c, k, p);
        // Interpolated sizes differ a little from the sizes at vertices.
        if (metric_[p].along(t) > (1 + shares::of_polylines) * h) metric_[p].bound_along(t, h);
      }
    }
  }

  // If a point has a smaller size than its curves, it bounds the sizes there.
  void bound_by_points(const std::vector<SizeSamples>& raw) {
    const Topology& topology = work_.model.topology;
    std::vector<double> of_curves(topology.points.size(), infinity);
    for (std::size_t c = 0; c < raw.size(); ++c) {
      if (work_.curves[c].indivisible) continue;
      const Curve& curve = topology.curves[c];
      of_curves[curve.end1] = std::min(of_curves[curve.end1], raw[c].h.front());
      of_curves[curve.end2] = std::min(of_curves[curve.end2], raw[c].h.back());
    }
    for (std::size_t v = 0; v < of_curves.size(); ++v) {
      const double h = work_.rules.at_point(static_cast<int>(v));
      if (h > (1 - shares::of_polylines) * of_curves[v]) continue;
      for (const int p : places_of_[v]) bound(p, h);
    }
  }

  std::vector<TangentMetric> metric_;  // of places
  std::vector<MetricSource> sources_;
  std::vector<TangentMetric> prescribed_;    // before any bound
  std::vector<std::vector<int>> places_of_;  // of vertices
};

}  // namespace

std::unique_ptr<GraphSizes> directional_graph_sizes(GradingWork& work) {
  return std::make_unique<DirectionalSizes>(work);
}

}  // namespace carreau::detail
