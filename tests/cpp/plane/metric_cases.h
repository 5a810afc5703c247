// SPDX-License-Identifier: BSD-3-Clause
// Plane domains with anisotropic fields in closed form, with unit boundaries, and how well a mesh follows them.
#pragma once

#include <functional>
#include <string>

#include "control_space/control_space.h"
#include "mesh/plane_mesh.h"

namespace carreau::testing {

/// Metric of a plane domain, its loop of unit edges cut in that metric.
struct MetricCase {
  std::string name;
  std::function<Metric2(Vec2)> metric;
  PlaneDomain domain;
};

ControlSpace control_space(const MetricCase& c);

/// All on a square. `h` is the size across, `ratio * h` the largest size along.
MetricCase layer_on_line(double h, double ratio);    ///< thin along an oblique line, isotropic away from it
MetricCase layer_on_circle(double h, double ratio);  ///< same, along a circle
MetricCase layer_on_spiral(double h, double ratio);  ///< same, along the turns of a spiral
MetricCase layer_on_sine(double h, double ratio);    ///< same, along y = sin x
/// Long along all circles about (0.2, 0.3), up to a third of the radius: edges of unit length leave their circle by
/// many sizes h when the ratio is large.
MetricCase rings(double h, double ratio);
MetricCase constant_stretch(double h, double ratio);  ///< the same tensor everywhere, oblique
MetricCase turning_stretch(double h,
                           double ratio);  ///< the ratio is the same everywhere, directions are tangent to circles

struct MetricQuality {
  std::size_t triangles = 0, vertices = 0;
  double mean_length = 0, fitting = 0, shortest = 0, longest = 0;  ///< metric lengths; share in [1/sqrt 2, sqrt 2]
  double mean = 0, p1 = 0, worst = 1;  ///< Q2 (HDR eq. 1.6) with lengths and area measured in the metric
  double degree_six = 0;               ///< share of the vertices that are not imposed
};
/// Lengths by Gauss quadrature in the field itself; area by the tensor at the centroid.
MetricQuality measure(const MetricCase& c, const PlaneMesh& mesh);
std::string to_string(const MetricQuality& q);

}  // namespace carreau::testing
