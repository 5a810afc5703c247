// SPDX-License-Identifier: BSD-3-Clause
// The loop of RR-2928 sec. 2.2 and HDR sec. 1.2: mesh, estimate, a new field on the mesh's vertices, mesh again.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "adapt/estimators.h"
#include "adapt/transfer.h"
#include "session/parameters.h"
#include "session/session.h"
#include "size/background.h"
#include "support/ranks/executor.h"

namespace carreau {

/// Smallest and largest size, largest ratio of the two in the tangent plane.
struct SizeRange {
  double low = HUGE_VAL, high = 0, stretch = 1;
};

SizeRange range_of(const VertexPrescriptions& prescriptions);

/// While this object lives, the prescriptions supply the bounds that the user has not set.
class OpenBounds {
 public:
  OpenBounds(Parameters& parameters, SizeRange range);
  ~OpenBounds();
  OpenBounds(const OpenBounds&) = delete;
  OpenBounds& operator=(const OpenBounds&) = delete;

 private:
  void open(const char* name, double value);
  Parameters& parameters_;
  std::vector<const char*> opened_;
};

/// Takes the background mesh away in the end.
class NoBackgroundAfterwards {
 public:
  explicit NoBackgroundAfterwards(Session& session) : session_(session) {}
  ~NoBackgroundAfterwards() { session_.set_background(nullptr); }
  NoBackgroundAfterwards(const NoBackgroundAfterwards&) = delete;
  NoBackgroundAfterwards& operator=(const NoBackgroundAfterwards&) = delete;

 private:
  Session& session_;
};

/// The session's mesh with sizes or metrics at its vertices, for the next mesh. Elements of second order have values at all
/// nodes (node_count), or at their corners alone.
std::shared_ptr<BackgroundField> background_of(const Session& session, VertexValues values);

/// With a team: throws InvalidModel, which names the first rank that has other values or options than rank 0.
void require_same_values(const Executor& executor, std::span<const double> values, const EstimatorOptions& options);

/// Sizes or metrics from values at the vertices of the session's mesh, by all processes of its team together. Elements of second order have
/// values at all nodes, or at their corners alone; the sizes are for straight elements in either case. Bounds of 0 are replaced by hphymin
/// and hphymax.
VertexPrescriptions estimate_on_mesh(Session& session, std::span<const double> values, EstimatorOptions options);
/// Estimates from the field, at all nodes: see estimate_function().
VertexPrescriptions estimate_on_mesh(Session& session, const FieldFunction& field, EstimatorOptions options);

struct AdaptationOptions {
  EstimatorOptions estimator;  ///< bounds of 0 are replaced by hphymin and hphymax
  /// Derivatives of the field by differences (meshes of the plane z = 0), in place of derivatives recovered from its
  /// values at the vertices.
  bool differences = false;
  int iterations = 5;  ///< at most; > 0. The first mesh whose estimated error is within the tolerance ends the loop (HDR sec. 1.2)
  /// Ends when the number of triangles changes by less than this share; 0: never.
  double convergence = 0.01;
};

/// A mesh of the loop.
struct AdaptationStep {
  std::int64_t vertices = 0, triangles = 0;
  InterpolationError error;     ///< of the field on that mesh
  /// Estimate in the unit of the tolerance. Hessian: the largest interpolation error, or its share of the field; other sources:
  /// estimated_error().
  double estimate = 0;
  double smallest_size = 0;     ///< prescribed for that mesh; 0 for the first one
  double largest_stretch = 1;   ///< of prescribed metrics, in the tangent plane
  BackgroundReport background;  ///< of that run
};

struct AdaptationReport {
  std::vector<AdaptationStep> steps;  ///< the first step describes the mesh that the loop started with
  std::size_t best = 0;     ///< the session's mesh: the step with the smallest estimate, not the first step
  bool converged = false;  ///< the number of triangles no longer changed
  [[nodiscard]] bool within(double tolerance) const { return steps[best].estimate <= tolerance; }
};

/// Adapts the session's mesh to a field, by all processes of its team together. If there is no mesh, makes one first, by the parameters
/// alone. The session then has the mesh with the smallest estimated error, or the last mesh when this throws, and no background mesh. If hphymin or
/// hphymax is not set, the runs take the bounds of the estimator's prescriptions. Throws InvalidArgument (options; hphy_flag = 0: sizes
/// would be ignored), and the exceptions of make_mesh() and of `field`.
AdaptationReport adapt(Session& session, const FieldFunction& field, const AdaptationOptions& options,
                       Monitor& monitor);

}  // namespace carreau
