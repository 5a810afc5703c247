// Swaps and moves that make triangles equilateral in the metric, and degrees six.
#pragma once

#include "plane/kernel/plane_work.h"

namespace carreau::plane {

/// Leaves removed triangles without vertices (-1) and removed vertices without a triangle.
void optimise(PlaneWork& work);

/// After place_squares(): only triangles that are bad or flat are mended.
void mend_squares(PlaneWork& work);

}  // namespace carreau::plane
