// SPDX-License-Identifier: BSD-3-Clause
// One graph of the gradation of a model: a separate mesh with prescribed sizes at its vertices. Private to this room.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gradation/metric_grading.h"
#include "support/ranks/packet.h"
#include "surface/grade/size_grading.h"
#include "surface/refine/boundary_refinement.h"
#include "surface/sample/face_sampling.h"

namespace carreau::detail {

inline Vec3 unit(const Vec3& v) noexcept {
  const double l = norm(v);
  return l > 0 ? (1 / l) * v : Vec3{};
}

class GraphSizes;

/// Data of the passes below, in their order: curves, domains and plane meshes of all faces. Used once.
struct GradingWork {
  /// A prescribed size at a place of a face.
  struct Sample {
    Vec2 uv;
    Vec3 xyz;
    double h = 0;
    TangentMetric sizes{};  // in place of h if sizes differ by direction
    std::int32_t triangle = 0;
    std::array<double, 3> promised{};  // weights of its corners
  };

  GradingWork(const CurveModel& curve_model, SizeRules& size_rules, const CompositeOptions& composite_options,
              double diag, Monitor& run_monitor, const PeriodicModel& periodic_model);
  ~GradingWork();

  const CurveModel& model;
  const PeriodicModel& periodic;
  SizeRules& rules;
  CompositeOptions options;
  Monitor& monitor;
  double largest;                     // edge of the graph
  std::unique_ptr<GraphSizes> sizes;  // one number at each vertex, or a metric at each place

  // make_graph()
  std::vector<DiscreteCurve> curves;
  RefinedDomains domains;
  GradationGraph graph;
  std::vector<std::uint8_t> sides;        // sides on curves of the graph's triangles
  std::vector<std::vector<int>> node_of;  // [curve][node]: vertex of the graph
  std::vector<GradedFace> faces;
  std::vector<std::size_t> place_of;  // first place of a face
  std::vector<std::vector<Sample>> samples;
  std::vector<std::vector<Vec2>> missed;  // as GradedModel
  std::vector<double> h;                  // prescribed at the vertices of the graph
};

/// The part of one face in the graph; one process makes it, and all have the same.
struct FaceInGraph {
  PlaneMesh mesh;  ///< empty where it cannot be made
  std::vector<GradingWork::Sample> samples;
  std::vector<Vec2> missed;  ///< as GradingWork, with the places missed before
  // Positions and normals of the surface, and prescribed sizes, by direction or not (0: unknown). Index: vertex of
  // `mesh`.
  std::vector<Vec3> xyz, normal;
  std::vector<double> h;
  std::vector<TangentMetric> metric;

  /// Converts to bytes for another process, and back.
  void put(PacketWriter& packet) const;
  static FaceInGraph from(PacketReader& packet);
};

/// `raw`: prescribed sizes of the curves; `before`: the graded model that the graph uses.
void make_graph(GradingWork& work, const std::vector<SizeSamples>& raw, const GradedModel& before);
/// Makes the plane mesh of a face in the graph's control space, and keeps the samples of the host in between and at its
/// vertices. Several threads may make faces at a time.
FaceInGraph face_in_graph(const GradingWork& work, const PatchInput& input, Monitor& monitor);

/// Bounds sizes to options.proximity layers between two boundaries of a face, and between faces that face each other.
void bound_narrow_zones(GradingWork& work);
void bound_facing_faces(GradingWork& work);

/// Returns the face of a place of the graph.
int face_of(const GradingWork& work, int place);
/// Marks the neighbours of rough places as rough too, since samples are few.
void widen_rough(GradedFace& face);

}  // namespace carreau::detail
