// SPDX-License-Identifier: BSD-3-Clause
// Insertion of points into triangles that are too large.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plane/kernel/plane_work.h"
#include "plane/kernel/thresholds.h"
#include "support/work_sizes.h"

namespace carreau::plane {

/// An edge of the domain that is one point in space.
struct DegenerateSide {
  std::int32_t a, b;
  int min_fan, wide_fan;  ///< triangles required around the point of space
  bool surrounded = false;  ///< by a fan that is frozen
};

/// Common data of the passes that place points.
struct Placement {
  /// Caches the metric at the vertices.
  Placement(PlaneWork& work, std::int64_t triangle_limit);

  /// To be called often.
  void tick() {
    if (++ticks % work_sizes::searches == 0) monitor.checkpoint();
  }

  void touch(std::int32_t t) {
    if (mesh.triangles[t].mark != 0) return;
    mesh.triangles[t].mark = 1;
    touched.push_back(t);
  }
  void forget_touched() {
    for (const std::int32_t t : touched) mesh.triangles[t].mark = 0;
    touched.clear();
  }

  Triangulation& mesh;
  const Field& field;
  const Shapes& shapes;
  Monitor& monitor;
  std::int64_t max_triangles;
  std::vector<DegenerateSide> degenerate;
  std::vector<std::int32_t> degenerate_ends;  ///< keep no distance to new points (the edge does, as a whole)
  std::span<const std::uint8_t> resting;      ///< PlaneMesherOptions::resting
  std::vector<std::int32_t> touched;          ///< triangles made since a pass has cleared this, each once: marked
  long ticks = 0;
};

/// A point to be inserted.
struct Candidate {
  Vec2 p;
  Metric2 metric;  ///< near p
  HalfEdge edge;   ///< the edge that it was placed on
  std::int32_t a;  ///< start of that edge
};

/// Tells which triangles are small enough, by their circumradius.
void judge(Placement& placement, int t);
void judge_all(Placement& placement);

/// Inserts p, which lies in triangle `start`. Requires its metric distance to all vertices of its cavity to be at least
/// `distance`, and its height over imposed edges to suffice. Judges the new triangles.
bool try_insert(Placement& placement, Vec2 p, int start, double distance);
/// The search for the triangle starts at the candidate's edge.
bool try_insert(Placement& placement, const Candidate& candidate, double distance);

/// Fills the cavity that was dug for p, and judges the new triangles.
void fill_cavity(Placement& placement, Vec2 p, Metric2 metric, Bend bend);

}  // namespace carreau::plane
