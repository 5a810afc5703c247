// What was delivered: lengths, shapes and deviations of a mesh, measured on the real surface.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "cad/cad.h"
#include "mesh/surface_mesh.h"
#include "metric/metric2.h"
#include "size/size_law.h"
#include "support/monitor.h"

namespace carreau {

/// What is prescribed inside faces: not what a control space holds of it.
struct PrescribedMetric {
  /// Want bits that the jets must hold; first derivatives are always there.
  unsigned wants = want_first;
  /// Metric of the parameter plane of a face (index in SurfaceMesh::faces) at each uv, whose jets are given.
  std::function<void(int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<Metric2> metric)>
      at;
};

struct DeliveredOptions {
  /// Points on each edge at which its length is integrated: exact up to degree 2 n - 1 in the speed.
  int gauss_points = 3;
  /// Prescriptions to be checked; infinity: none.
  double edge_angle_limit = std::numeric_limits<double>::infinity();  ///< degrees
  double deviation_limit = std::numeric_limits<double>::infinity();   ///< model length
  /// Prescribed sizes at the vertices of the mesh. On edges of curves, whose sizes are another rule than those of the
  /// faces beside them, the size is the interpolation of its ends' by `law`; empty: that of the first face with it.
  std::span<const double> curve_size = {};
  SizeLaw law = SizeLaw::linear;
};

/// Values counted in classes: class i holds bound[i] <= x < bound[i + 1]; the first bound is -infinity, the last one
/// +infinity.
struct Histogram {
  std::vector<double> bound;
  std::vector<std::int64_t> count;
};

/// Finite values of one kind; all zero when there are none.
struct Spread {
  std::int64_t count = 0;
  double mean = 0, min = 0, p1 = 0, p99 = 0, max = 0;  ///< p1, p99: percentiles
  Histogram histogram;
};

/// Spread of the values that are not NaN. `inner`: the bounds of the histogram between its infinite ones, ascending.
Spread spread_of(std::span<const double> values, std::span<const double> inner);

/// One entry an edge, each edge of the mesh in space once, in the order in which triangles name them.
struct DeliveredEdges {
  std::vector<std::array<std::int32_t, 2>> vertices;  ///< indices in SurfaceMesh::vertices, the smaller one first
  std::vector<char> on_curve;
  /// Length in the prescribed metric of the image of the segment in (u, v), by Gauss quadrature: 1 is as prescribed.
  std::vector<double> length;
  /// Angle between the edge and the tangent planes at its ends, the larger of them over all faces beside; degrees; NaN
  /// where both ends are singular.
  std::vector<double> angle;
  /// max(h1 / h2, h2 / h1)^(1 / length) with the sizes that are prescribed along the edge at its two ends (Borouchaki,
  /// Hecht, Frey: H-shock of an edge); NaN where an end is singular.
  std::vector<double> gradation;
};

/// One entry a triangle, in the order of SurfaceMesh::faces and their triangles.
struct DeliveredTriangles {
  std::vector<double> q1, q2;  ///< shapes in space (HDR eq. 1.5, 1.6)
  /// Q2 in the prescribed metric: 4 sqrt(3) area / sum of squared lengths, all in the metric; at most 1.
  std::vector<double> metric_quality;
  /// A0 (HDR eq. 4.1): largest distance from sample points of the surface above the triangle to the triangle (above its
  /// edges: to the nearer one of the triangles beside); model length.
  std::vector<double> deviation;
  /// A1 (HDR sec. 4.3.2): largest angle between the normal of the triangle and that of the surface at sample points and
  /// at the vertices; degrees, 0 to 180.
  std::vector<double> angle;
};

/// All measures; prescriptions that are not met are counted.
struct Delivered {
  DeliveredEdges edges;
  DeliveredTriangles triangles;
  Spread length, edge_angle, gradation, q1, q2, metric_quality, deviation, angle;
  std::int64_t short_edges = 0, long_edges = 0;  ///< length below 1 / sqrt(2), above sqrt(2)
  double edge_angle_limit = std::numeric_limits<double>::infinity();
  double deviation_limit = std::numeric_limits<double>::infinity();
  std::int64_t edges_over_angle = 0;          ///< angle above edge_angle_limit
  std::int64_t triangles_over_deviation = 0;  ///< deviation above deviation_limit
  std::int64_t folded_triangles = 0;          ///< angle above 90 degrees
  CallCounts calls;                           ///< that the measure took
  double seconds = 0;

  /// Share of the edges with a length in [1 / sqrt(2), sqrt(2)].
  [[nodiscard]] double share_in_range() const noexcept;
};

/// Fills the spreads from the lists.
void summarise(Delivered& delivered);

/// Measures a mesh on the surface that `cad` gives. About 5 evaluations of surf1 a triangle at vertices and on edges, 7
/// of surf0 and surf1 inside. Throws what callbacks throw, and Cancelled.
Delivered measure_delivered(const SurfaceMesh& mesh, Cad& cad, const PrescribedMetric& prescribed,
                            const DeliveredOptions& options, Monitor& monitor);

/// For a person.
struct DeliveredText {
  /// One line a kind: its spread and its histogram; one sentence for each prescription that is not met.
  std::vector<std::string> summary, not_met;
};
DeliveredText describe(const Delivered& delivered);

}  // namespace carreau
