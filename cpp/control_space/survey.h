// SPDX-License-Identifier: BSD-3-Clause
// A first survey of a domain and of the field over it, before the grid is made. Private to control_space/.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "control_space/control_space.h"
#include "predicates/polygon_locator.h"

namespace carreau::detail {

/// Summary of a few dozen samples.
struct Survey {
  Vec2 low, high;                ///< the domain's box
  double share = 1;              ///< of the box that belongs to the domain, about; never 0
  double vertices_in_box = 1;    ///< that a mesh of the whole box would have
  double aspect = 1;             ///< desired number of columns of cells over number of rows
  double floor = 0;              ///< smallest eigenvalue that a metric in units of the box may have
  std::vector<int> vertices;     ///< boundary vertices that were sampled
  std::vector<Metric2> metrics;  ///< there, in units of the box, as the sampler gave them
};

/// Area of the part of a unit mesh that belongs to a vertex, two equilateral triangles: sqrt(3) / 2.
extern const double area_per_vertex;

/// The box of the boundary. Throws DomainError when the domain has no boundary or its box has no area.
struct Box2 {
  Vec2 low, high;
};
Box2 box_of(const SampledDomain& domain);

/// The smallest eigenvalue allowed in units of the box, from smallest and largest lengths of the box at samples.
double floor_from(std::vector<double> shortest, double longest);

/// A metric in units of a box with these sides.
Metric2 in_box(Metric2 m, const Vec2& w) noexcept;

/// `ask` evaluates the sampler. `square`: cells should be as square in the metric as possible. Throws as
/// box_of().
Survey survey(const SampledDomain& domain, const PolygonLocator& locator,
              const std::function<std::vector<Metric2>(std::span<const Vec2>)>& ask, bool square);

}  // namespace carreau::detail
