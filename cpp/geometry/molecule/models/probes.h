// SPDX-License-Identifier: BSD-3-Clause
// Probes that touch three balls: concave triangles, and where they cross (HDR sec. 4.6.2).
#pragma once

#include <optional>

#include "geometry/molecule/models/torus_patch.h"

namespace carreau::molecule {

/// A piece of the border of a probe's part: run from point `start` to point `end`, the part on its left seen from the
/// probe.
struct ProbeArc {
  int curve = 0, start = 0, end = 0;  ///< references
  SpaceArc arc;
};
using ProbeLoop = std::vector<ProbeArc>;

/// A connected part of a probe's sphere that is on the surface.
struct ProbePart {
  int vertex = 0;
  std::vector<ProbeLoop> loops;
};

/// A probe at a vertex of the arrangement of grown balls: the part of its sphere within the directions of its balls.
class ProbeTriangle {
 public:
  ProbeTriangle(const Arrangement& arrangement, int vertex, double probe);
  [[nodiscard]] bool holds(const Vec3& p) const;
  [[nodiscard]] const Ball& ball() const { return ball_; }

 private:
  Ball ball_;
  std::array<Vec3, 3> inward_;  // normals of the planes through the centre
};

/// Counters for references of points and curves.
struct NextReferences {
  int point = 1, curve = 1;
};

/// An arc in which the spheres of probes v < w cross, forward for v.
struct ProbeCrossing {
  int v = 0, w = 0;
  ProbeArc arc;
};

/// `tips`: [circle], the two points of a spindle on the axis, towards balls i and j; empty for other circles. Points
/// that the crossings end in are tips, or get new references.
struct Tips {
  int low = 0, high = 0;  ///< references; 0: none
  Vec3 at_low, at_high;
};
std::vector<ProbeCrossing> find_crossings(const Arrangement& arrangement, std::span<const ProbeTriangle> probes,
                                          std::span<const Tips> tips, NextReferences& next);

/// The parts of one probe's sphere: `sides` are pieces of the triangle's border. Empty when pieces do not close.
std::optional<std::vector<ProbePart>> parts_of_probe(int vertex, const ProbeTriangle& triangle,
                                                     std::vector<ProbeArc> pieces,
                                                     const std::function<bool(const Vec3&)>& bare);

}  // namespace carreau::molecule
