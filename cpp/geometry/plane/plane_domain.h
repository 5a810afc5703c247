// SPDX-License-Identifier: BSD-3-Clause
// A domain of the plane from arrays or a file: points, curves through them, and sides of curves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "metric/metric2.h"
#include "support/vec.h"

namespace carreau {

/// References are the user's own: any number, 0 for none, equal numbers for several entities. Lines count from 1, 0:
/// from memory. Names are for sentences; empty: the entity is called by its number from 1.
struct PlanePoint {
  Vec2 xy;
  int ref = 0;
  bool imposed = false;                ///< a vertex of the mesh, also when no curve ends here
  bool may_drop = false;               ///< an imposed point outside of the domain is no error
  std::optional<double> size = {};     ///< desired here, > 0
  std::optional<Metric2> metric = {};  ///< desired here, positive definite; in place of a size
  int line = 0;
  std::string name = {};
};

struct PlaneCurve {
  std::vector<int> points;      ///< indices from 0 of its points, two or more; first == last: closed
  bool smooth = false;          ///< a spline; otherwise segments, and each of its points is a vertex
  /// Arcs of circles: a start, a point between, an end, which starts the next arc, a point between, ... Starts and ends
  /// are vertices, points between are not. From a point to itself: the circle of which both have a diameter.
  bool arcs = false;
  int before = -1, after = -1;  ///< smooth: control points beyond its ends; -1: free
  std::optional<Vec2> tangent_start = {}, tangent_end = {};  ///< smooth: in place of `before` and `after`
  int ref = 0;
  int line = 0;
  std::string name = {};
};

/// A subdomain: the region on one side of a curve, bounded by curves.
struct PlaneSide {
  int curve = 0;     ///< index from 0
  bool left = true;  ///< of the curve as it runs
  int ref = 0;
  int line = 0;
};

/// A subdomain, or a hole: the region around a point, bounded by curves.
struct PlaneSeed {
  Vec2 at;
  bool hole = false;
  int ref = 0;
  int line = 0;
};

/// Rule for the domain where neither a side nor a seed decides.
enum class PlaneRest {
  outside,  ///< nothing else: sides decide
  inside,   ///< all that curves enclose but holes (Triangle's rule)
  parity,   ///< regions enclosed by curves; a loop inside of it that nothing joins to it bounds a hole, and so on (HDR
            ///< fig. 3.1)
};

struct PlaneDomainInput {
  std::vector<PlanePoint> points;
  std::vector<PlaneCurve> curves;
  std::vector<PlaneSide> sides;
  std::vector<PlaneSeed> seeds;
  PlaneRest rest = PlaneRest::parity;
  std::string source;    ///< name of the file; empty: from memory
  bool arrange = false;  ///< segments may cross, and points repeat: arrange_segments() comes first
  bool is_mesh = false;  ///< a mesh whose triangles cover the domain: sizes at its points hold inside, too
};

/// "point 3" or "point 'A'".
std::string name_of_point(const PlaneDomainInput& input, int point);
std::string name_of_curve(const PlaneDomainInput& input, int curve);

}  // namespace carreau
