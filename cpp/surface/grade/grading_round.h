// One graph of the gradation of a model: a mesh of its own whose vertices know what is prescribed. Private to
// size_grading.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "gradation/metric_grading.h"
#include "surface/grade/size_grading.h"
#include "surface/refine/boundary_refinement.h"
#include "surface/sample/face_sampling.h"

namespace carreau::detail {

// Prescribed sizes are smooth where they are what linear interpolation in the graph promises, up to this share.
inline constexpr double roughness = 0.01;
// The graph is too coarse where an edge is longer than this, in unit edges of the graded sizes.
inline constexpr double too_long = 3.2;
inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline Vec3 unit(const Vec3& v) noexcept {
  const double l = norm(v);
  return l > 0 ? (1 / l) * v : Vec3{};
}

/// Curves, domains and plane meshes of all faces; used once. Keeps references to all but the options.
class GradingRound {
 public:
  GradingRound(const CurveModel& model, SizeRules& rules, const CompositeOptions& options, double diag,
               Monitor& monitor);
  /// `raw`: prescribed sizes of the curves; `before`: what the graph is made with.
  GradedModel run(const std::vector<SizeSamples>& raw, const GradedModel& before);
  /// Edges of the graph that are too long for the graded sizes.
  [[nodiscard]] std::size_t long_edges() const noexcept { return long_edges_; }

 private:
  /// What the host has said at a place of a face.
  struct Sample {
    Vec2 uv;
    Vec3 xyz;
    double h = 0;
    TangentMetric sizes{};  // instead of h where sizes differ by direction
    std::int32_t triangle = 0;
    std::array<double, 3> promised{};  // weights of its corners
  };

  [[nodiscard]] SizeSamples coarsened(SizeSamples samples) const;
  void number_vertices(const std::vector<SizeSamples>& raw);
  void lower_by_samples(std::size_t c, const SizeSamples& raw, const std::vector<int>& nodes);
  void add_face(std::size_t f, const SizeLimits& limits);
  void locate_samples(std::size_t f);
  void find_rough(std::size_t f);
  static void widen_rough(GradedFace& face);
  PlaneMesh mesh_face(const PatchInput& input);
  ControlSpace sample(const PatchInput& input, std::span<const Vec2> probe_points);
  void keep_sample(Vec2 uv, const SurfaceJet& jet, Metric2 metric, std::vector<Sample>& samples) const;
  void evaluate(const PatchInput& input, GradedFace& face, std::size_t first);
  static void mend_normals(GradedFace& face, std::size_t);
  void add_triangles(const FaceDomain& domain, GradedFace& face, std::size_t first);
  static void find_size_minima(GradedFace& face);
  GradedModel grade(const std::vector<SizeSamples>& raw);
  void bound_narrow_zones();
  void bound_facing_faces();
  [[nodiscard]] double smallest_size() const;
  [[nodiscard]] int face_of(int place) const;
  GradedModel grade_by_direction(const std::vector<SizeSamples>& raw);
  void collect_places();
  [[nodiscard]] Vec3 tangent(std::size_t c, std::size_t node, int place) const;
  [[nodiscard]] std::vector<int> places_on(std::size_t c, std::size_t node) const;
  void bound_by_curve(std::size_t c, const SizeSamples& raw);
  void bound_by_points(const std::vector<SizeSamples>& raw);
  static void find_rough_metrics(GradedFace& face, const TangentMetric* prescribed, const std::vector<Sample>& samples);
  [[nodiscard]] SizeSamples bounded_along(std::size_t c, const SizeSamples& raw) const;
  [[nodiscard]] SizeSamples bounded(std::size_t c, const SizeSamples& raw, const std::vector<double>& h,
                                    const GradedField& field) const;
  static std::vector<double> between(double from, double to, const std::vector<double>& known);

  const CurveModel& model_;
  SizeRules& rules_;
  CompositeOptions options_;
  Monitor& monitor_;
  bool metrics_;  // sizes may differ by direction
  double largest_;
  std::vector<DiscreteCurve> curves_;
  RefinedDomains domains_;
  GradationGraph graph_;
  std::vector<double> h_;                  // prescribed at the vertices of the graph
  std::vector<double> prescribed_h_;       // before narrow zones
  std::vector<std::vector<int>> node_of_;  // [curve][node]: vertex of the graph
  std::vector<GradedFace> faces_;
  std::vector<std::size_t> place_of_;  // first place of a face
  std::vector<std::vector<Sample>> samples_;
  std::vector<std::vector<Vec2>> missed_;  // as GradedModel
  std::vector<GradationSource> sources_;
  std::vector<TangentMetric> metric_;      // of places, where sizes differ by direction
  std::vector<TangentMetric> prescribed_;  // before any bound
  std::vector<MetricSource> metric_sources_;
  std::vector<std::uint8_t> sides_;          // of the graph's triangles: those on curves
  std::vector<std::vector<int>> places_of_;  // of vertices
  std::size_t long_edges_ = 0;
};

}  // namespace carreau::detail
