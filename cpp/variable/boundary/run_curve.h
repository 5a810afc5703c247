// SPDX-License-Identifier: BSD-3-Clause
// The geometry of a run: a spline, a polygon, or a tool (HDR sec. 3.4.2).
#pragma once

#include <optional>
#include <vector>

#include "variable/boundary/boundary_runs.h"
#include "variable/boundary/cubic_spline.h"

namespace carreau::variable {

/// The kinds of joints of free runs.
enum class Smoothness {
  natural,  ///< C2 splines without curvature at ends of runs
  tangent,  ///< C2 splines with tangents by four nodes
  polygon,  ///< straight
};

/// Refers to the loop and the tools.
class RunCurve {
 public:
  /// A spline that leaves one of its chords by more than .15 of it becomes a polygon.
  /// `keep_nodes`: it is straight between its nodes, and cutting leaves these as they are; curvatures are a spline's.
  RunCurve(const BoundaryLoop& loop, const BoundaryRun& run, const Tools& tools, Smoothness smoothness,
           bool keep_nodes);

  [[nodiscard]] std::size_t edges() const noexcept { return run_->count; }
  /// At fraction t in [0, 1] of an edge of the run.
  [[nodiscard]] Vec2 at(std::size_t edge, double t) const noexcept;
  /// Curvature of a spline at a node of the run, from 0 to edges(); 0 otherwise.
  [[nodiscard]] double curvature_at_node(std::size_t node) const noexcept;
  [[nodiscard]] bool keeps_nodes() const noexcept { return keep_nodes_; }
  [[nodiscard]] bool is_spline() const noexcept { return spline_.has_value(); }
  [[nodiscard]] std::size_t node(std::size_t rank) const noexcept { return (run_->first + rank) % loop_->size(); }
  [[nodiscard]] const BoundaryRun& run() const noexcept { return *run_; }
  [[nodiscard]] const BoundaryLoop& loop() const noexcept { return *loop_; }

 private:
  void fit(Smoothness smoothness);
  [[nodiscard]] bool bulges() const noexcept;

  const BoundaryLoop* loop_;
  const BoundaryRun* run_;
  const Tools* tools_;
  bool keep_nodes_;
  std::optional<CubicSpline> spline_;
};

}  // namespace carreau::variable
