// SPDX-License-Identifier: BSD-3-Clause
#include "wrong_turns.h"

#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <TopAbs.hxx>
#include <algorithm>
#include <cmath>

namespace carreau_occ {
namespace {

// Of each edge: the polygon of a circle that is one edge has its area within 3 %.
constexpr int pieces = 16;
// Share of the squared perimeter, which is 4 pi times the area of a circle. The area between two arcs is uncertain by
// 4e-4 of it.
constexpr double least_area = 1e-3;
// Share of the perimeter.
constexpr double largest_gap = 1e-3;

/// Area on the left of a loop, whatever the order of its edges; 0 when it does not close, or when the sign is in doubt.
double turned_area_of(const std::vector<EdgeImage>& loop) {
  double twice_area = 0, perimeter = 0;
  gp_Vec2d gap(0, 0);
  gp_Pnt2d origin;
  bool any = false;
  for (const EdgeImage& image : loop) {
    const TopAbs_Orientation orientation = image.edge.Orientation();
    if (orientation != TopAbs_FORWARD && orientation != TopAbs_REVERSED) continue;
    const double sign = orientation == TopAbs_FORWARD ? 1 : -1;
    gp_Pnt2d from = image.curve->Value(image.first);
    if (!any) origin = from;
    any = true;
    for (int i = 1; i <= pieces; ++i) {
      const gp_Pnt2d to = image.curve->Value(image.first + (image.last - image.first) * i / pieces);
      const gp_Vec2d step(from, to);
      twice_area += sign * gp_Vec2d(origin, from).Crossed(step);
      perimeter += step.Magnitude();
      gap += sign * step;
      from = to;
    }
  }
  const bool in_doubt =
      gap.Magnitude() > largest_gap * perimeter || std::abs(twice_area) / 2 < least_area * perimeter * perimeter;
  return in_doubt ? 0 : twice_area / 2;
}

bool is_open(const Handle(Geom_Surface) & surface) {
  return !surface->IsUClosed() && !surface->IsVClosed() && !surface->IsUPeriodic() && !surface->IsVPeriodic();
}

}  // namespace

void turn_wrong_loops(std::vector<std::vector<EdgeImage>>& loops, const TopoDS_Face& face) {
  std::vector<double> areas;
  for (const std::vector<EdgeImage>& loop : loops) areas.push_back(turned_area_of(loop));
  const auto outer =
      std::max_element(areas.begin(), areas.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  if (outer == areas.end() || *outer >= 0 || !is_open(BRep_Tool::Surface(face))) return;
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (areas[i] > 0 || areas.begin() + static_cast<std::ptrdiff_t>(i) == outer)
      for (EdgeImage& image : loops[i]) image.edge.Orientation(TopAbs::Reverse(image.edge.Orientation()));
}

}  // namespace carreau_occ
