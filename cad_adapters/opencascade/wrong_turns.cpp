// SPDX-License-Identifier: BSD-3-Clause
#include "wrong_turns.h"

#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <TopAbs.hxx>
#include <algorithm>
#include <cmath>

#include "wire_order.h"

namespace carreau_occ {
namespace {

// Share of the squared perimeter, which is 4 pi times the area of a circle. The area between two arcs is uncertain by
// 4e-4 of it.
constexpr double min_area = 1e-3;
// Share of the perimeter.
constexpr double largest_gap = 1e-3;

/// Area on the left of a loop; 0 when it does not close, or when the sign is in doubt.
double turned_area_of(const std::vector<EdgeImage>& loop) {
  const LoopArea found = area_of(loop);
  const double perimeter = found.perimeter;
  const bool in_doubt =
      found.gap > largest_gap * perimeter || std::abs(found.area) < min_area * perimeter * perimeter;
  return in_doubt ? 0 : found.area;
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
