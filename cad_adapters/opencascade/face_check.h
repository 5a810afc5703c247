// Whether the numbers of a face are such that anything can be computed from them.
#pragma once

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>

namespace carreau_occ {

/// Coordinates beyond this are no geometry: nine digits would be left of a metre in them, and OpenCASCADE's own
/// tolerance of 1e-7 is then below the rounding of any number.
constexpr double largest_coordinate = 1e15;

/// Not for a number that is not finite either.
bool usable(double x) noexcept;

/// Throws std::runtime_error when a vertex, a pole, or a place of the boundary of the face is not finite or too far
/// away, and Standard_Failure when OpenCASCADE does.
void refuse_unusable(const TopoDS_Face& face);

/// Diagonal of the box of the faces of a shape that OpenCASCADE can evaluate; 0: there is none.
double diagonal_of(const TopoDS_Shape& shape);

}  // namespace carreau_occ
