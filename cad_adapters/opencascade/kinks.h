// Creases inside faces: surfaces whose normal jumps where B-splines have knots of full multiplicity.
#pragma once

#include <TopoDS_Face.hxx>
#include <vector>

namespace carreau_occ {

/// A line of constant parameter inside a face's box of parameters along which the normal jumps.
struct Kink {
  bool of_u = true;  ///< u is constant, else v
  double at = 0;     ///< the parameter, as the file has it
  double angle = 0;  ///< the largest that was found between the normals on both sides, degrees
};

/// Those above 2 degrees, by u and then v. Curvatures on both sides say nothing of them: sizes by an angle or a chord
/// cut across. Throws what OpenCASCADE throws.
std::vector<Kink> kinks_of(const TopoDS_Face& face);

}  // namespace carreau_occ
