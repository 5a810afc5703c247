// SPDX-License-Identifier: BSD-3-Clause
// Measures of a mesh: lengths, shapes and deviations, on the exact surface.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cad/cad.h"
#include "control_space/control_space.h"
#include "curve/edge_accuracy.h"
#include "measure/base/mesh_edges.h"
#include "measure/base/spread_samples.h"
#include "mesh/surface_mesh.h"
#include "metric/metric2.h"
#include "size/size_law.h"
#include "support/infinity.h"
#include "support/monitor.h"

namespace carreau {

/// The prescribed metric inside faces: evaluated, not read from a control space.
struct PrescribedMetric {
  /// Want bits that the jets must hold; first derivatives are always there.
  unsigned wants = want_first;
  /// Metric of the parameter plane of a face (index in SurfaceMesh::faces) at each uv, whose jets are given.
  std::function<void(int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<Metric2> metric)>
      at;
};

/// The kinds of measures. Values are part of the C ABI.
enum class EvaluationKind : int {
  /// An edge's length in the prescribed metric of the image of its segment of (u, v), by Gauss quadrature; 1 is as
  /// prescribed.
  length = 1,
  /// An edge's largest angle with the tangent planes at its ends, over all faces beside; degrees. NaN if both ends are
  /// singular.
  edge_angle = 2,
  /// An edge's max(h1 / h2, h2 / h1)^(1 / length) with the sizes that are prescribed along its chord at its two ends
  /// (Borouchaki, Hecht, Frey: H-shock of an edge). Inside a face, sizes and length are from EvaluationOptions::spaces
  /// if there are any. Edges shorter than a tenth of a unit are judged by the ratio of sizes alone, as if they were
  /// that long. NaN if an end is singular.
  gradation = 3,
  /// A vertex's longest over shortest edge, lengths in space. If the metric has directions, each length is divided by
  /// the size along it over the mean size, to make them comparable. NaN without triangles.
  length_ratio = 4,
  /// A triangle's shapes in space (HDR eq. 1.5, 1.6).
  q1 = 5,
  q2 = 6,
  /// A triangle's Q2 in the prescribed metric, 4 sqrt(3) area / sum of squared lengths, all in the metric; at most 1.
  metric_quality = 7,
  /// A triangle's A0 (HDR eq. 4.1): largest distance of sample points of the surface that its triangle of (u, v)
  /// covers. The distance is to it, or to nearer triangles of the face around; model length.
  deviation = 8,
  /// A triangle's A1 (HDR sec. 4.3.4): largest angle between its normal and the normals of the surface at sample points
  /// and at its vertices; degrees, 0 to 180.
  angle = 9,
  /// A curve edge's A0, largest distance of its arc to it (HDR eq. 2.26), model length; and its A1, largest angle with
  /// the tangents of its arc (HDR eq. 2.28), degrees. NaN inside faces.
  curve_deviation = 10,
  curve_angle = 11,
  /// A straight triangle's largest angle between its normal and the normals of the surface at its vertices (limited by
  /// angle_mesh, RT-0232 sec. 3.3); degrees, 0 to 180. NaN of other elements.
  vertex_angle = 12,
  /// A straight triangle's upper bounds of A0 and A1 over all of it (measure/bounds), and the larger one of their shares of the
  /// tolerances. NaN if not requested, for other elements, and if unknown.
  deviation_bound = 13,
  angle_bound = 14,
  bound_share = 15,
  /// A straight triangle's upper bound of the distance to the input triangles (mesh/distance); model length. NaN if not requested,
  /// and for other geometries.
  input_bound = 16,
};
inline constexpr std::size_t evaluation_kinds = 16;

/// The kind of entity that a value measures. Values are part of the C ABI.
enum class EvaluationEntity : int { edge = 1, vertex = 2, triangle = 3 };

/// A row of the table of kinds.
struct EvaluatedMeasure {
  EvaluationKind kind;
  EvaluationEntity entity;
  const char* name;   ///< as in files: "metric_length"
  const char* title;  ///< for a person, with the unit
};
/// All kinds, in the order of their values.
std::span<const EvaluatedMeasure> delivered_measures();

struct EvaluationOptions {
  /// Points on each edge at which its length is integrated: exact up to degree 2 n - 1 in the speed.
  int gauss_points = 3;
  /// Prescriptions to be checked; infinity: none.
  double edge_angle_limit = infinity;    ///< degrees; of edges, edges of curves and triangles at their vertices
  double gradation_limit = infinity;     ///< ratio
  double length_ratio_limit = infinity;  ///< ratio
  double deviation_limit = infinity;     ///< model length; of triangles and edges of curves
  /// Edges up to this length in space are as short as the smallest size permits, whatever angle they exceed: at an
  /// apex, which has no tangent plane, all edges exceed it.
  double shortest_for_angle = 0;
  /// [curve of SurfaceMesh::curves][its vertex]: prescribed sizes along curves, which differ from the sizes of the
  /// faces beside them; between two vertices they are interpolated by `law`. Edges of a curve without entries have the
  /// sizes of their first face; so have all edges if there are no entries.
  std::span<const std::vector<double>> curve_size = {};
  SizeLaw law = SizeLaw::linear;
  /// [curve of SurfaceMesh::curves]: the places of its vertices; edges without places are not compared with their
  /// curve.
  std::span<const CurveParameters> curve_parameters = {};
  /// [face]: the fields that governed the mesh, on which a gradation is to hold; may be empty.
  std::span<const std::optional<ControlSpace>> spaces = {};
  /// For a cross-patch mesh. Triangles whose corners are of several charts are sampled over their places in space;
  /// gradations of their edges are not measured.
  SpreadAtlas atlas = {};
  /// True to bound A0 and A1, with about 16 evaluations a vertex. bound_share is a share of the tolerances. The tolerance of A0 is the
  /// model length, or if that is infinite a share of the mean size at the corners of a triangle; the tolerance of A1 is in degrees.
  bool bounds = false;
  double deviation_tolerance = infinity, deviation_share = 0.3, angle_tolerance = 52;
  std::span<const double> vertex_size = {};  ///< by vertex; may be empty: bound_share is then NaN for tolerances that need it
  double bound_share_limit = infinity;
};

/// Values counted in classes: class i holds bound[i] <= x < bound[i + 1]; the first bound is -infinity, the last one
/// +infinity.
struct Histogram {
  std::vector<double> bound;
  std::vector<std::int64_t> count;
};

/// Values of one kind; all zero when there are none.
struct Spread {
  std::int64_t count = 0;
  double mean = 0, min = 0, p1 = 0, p99 = 0, max = 0;  ///< p1, p99: percentiles
  Histogram histogram;
};

/// Spread of the values that are not NaN. `inner`: the bounds of the histogram between its infinite ones, ascending.
Spread spread_of(std::span<const double> values, std::span<const double> inner);

/// One kind. Edges are in the order of MeshEdges; triangles in the order of SurfaceMesh::faces and their triangles.
struct Delivery {
  std::vector<double> values;
  Spread spread;
  double limit = infinity;  ///< the requested limit; infinity: none
  /// Values above the limit: by more than 2 % for the gradation, by more than rounding for the others.
  std::int64_t beyond = 0;
  double tolerance = 0;  ///< share of the limit that may be exceeded
  /// Number of violations that are forced: angles of edges no longer than `shortest` and of triangles with such edges alone, gradations of
  /// inner edges between vertices of curves.
  std::int64_t forced = 0;
  double shortest = 0;  ///< edges of this length are as short as the smallest size permits; model length

  [[nodiscard]] bool exceeds(double value) const noexcept { return value > limit * (1 + tolerance); }
};

/// Largest distances between a mesh and the triangles that it represents, model length: each lies between both figures. NaN: not measured.
struct InputDistances {
  double distance = std::numeric_limits<double>::quiet_NaN(), bound = distance;            ///< from the mesh to the triangles
  double back_distance = std::numeric_limits<double>::quiet_NaN(), back_bound = back_distance;
};

/// Triangles of a face whose bound of A0 or A1 is beyond its tolerance.
struct BeyondInFace {
  int ref = 0;  ///< the reference in results
  std::int64_t triangles = 0;
  double worst = 0;  ///< the largest bound over its tolerance
};

/// All measures; prescriptions that are not met are counted.
struct MeshEvaluation {
  MeshEdges edges;
  std::array<Delivery, evaluation_kinds> of_kind;
  std::int64_t short_edges = 0, long_edges = 0;  ///< length below 1 / sqrt(2), above sqrt(2)
  std::int64_t folded_triangles = 0;             ///< angle above 90 degrees
  InputDistances input;
  CallCounts calls;  ///< that the measure took
  double seconds = 0;

  [[nodiscard]] const Delivery& operator[](EvaluationKind kind) const { return of_kind[static_cast<int>(kind) - 1]; }
  [[nodiscard]] Delivery& operator[](EvaluationKind kind) { return of_kind[static_cast<int>(kind) - 1]; }

  /// Share of the edges with a length in [1 / sqrt(2), sqrt(2)].
  [[nodiscard]] double share_in_range() const noexcept;
};

/// Fills the spreads and counts from the values and limits.
void summarise(MeshEvaluation& delivered);

/// Measures a mesh on the surface that `cad` gives. About 24 evaluations a vertex: 1 of surf1 there, 9 of surf0 and
/// surf1 on edges, 14 inside triangles; and 9 an edge of a curve. Throws the exceptions of callbacks, and Cancelled.
MeshEvaluation evaluate_mesh(const SurfaceMesh& mesh, Cad& cad, const PrescribedMetric& prescribed,
                             const EvaluationOptions& options, Monitor& monitor);

/// Faces that exceed the limit of EvaluationKind::bound_share, worst face first.
std::vector<BeyondInFace> beyond_in_faces(const SurfaceMesh& mesh, const MeshEvaluation& delivered);
/// A sentence about them; empty if there are none.
std::string describe(const std::vector<BeyondInFace>& beyond);

/// For a person.
struct DeliveredText {
  /// One line a kind: its spread and its histogram; one sentence for each prescription that is not met.
  std::vector<std::string> summary, not_met;
};
DeliveredText describe(const MeshEvaluation& delivered);

}  // namespace carreau
