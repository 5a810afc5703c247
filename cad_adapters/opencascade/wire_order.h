// SPDX-License-Identifier: BSD-3-Clause
// The order of a wire's edges, and their places on periodic surfaces.
#pragma once

#include <Geom_Surface.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Vec2d.hxx>
#include <vector>

#include "wire_periods.h"

namespace carreau_occ {

struct Periods {
  double u = 0, v = 0;  // 0: none
};
Periods periods_of(Handle(Geom_Surface) surface);

inline bool bounds(const EdgeImage& image) {
  return image.edge.Orientation() == TopAbs_FORWARD || image.edge.Orientation() == TopAbs_REVERSED;
}
inline bool is_forward(const EdgeImage& image) { return image.edge.Orientation() == TopAbs_FORWARD; }
inline gp_Pnt2d start_of(const EdgeImage& image) {
  return image.curve->Value(is_forward(image) ? image.first : image.last);
}
inline gp_Pnt2d end_of(const EdgeImage& image) {
  return image.curve->Value(is_forward(image) ? image.last : image.first);
}

/// Orders edges one after the other (Hierholzer's circuit through all of them); empty when there is no such order.
std::vector<EdgeImage> in_order(const std::vector<EdgeImage>& loop);
/// The area that a loop encloses in the parameter plane, by chords, and its box. The order of its edges does not matter.
struct LoopArea {
  double area = 0;            ///< negative when it is clockwise
  double perimeter = 0;
  double gap = 0;             ///< length of the sum of all chords
  double width = 0, height = 0;
};
LoopArea area_of(const std::vector<EdgeImage>& loop);
/// Returns the whole periods in a distance.
double whole_periods(double distance, double period);
/// Moves the curve of an image, which becomes a copy.
void move(EdgeImage& image, gp_Vec2d by);
/// Moves each edge but the first one by whole periods to where the previous one ends.
void chain(std::vector<EdgeImage>& loop, Periods periods);
/// Each curve ends where one starts, whatever their order.
bool closes(const std::vector<EdgeImage>& loop, Periods periods);

}  // namespace carreau_occ
