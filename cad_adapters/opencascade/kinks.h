// SPDX-License-Identifier: BSD-3-Clause
// Creases inside faces: surfaces whose normal jumps where B-splines have knots of full multiplicity.
#pragma once

#include <TopoDS_Face.hxx>
#include <vector>

namespace carreau_occ {

/// A line of constant parameter inside a face's box of parameters along which the normal jumps.
struct Kink {
  bool of_u = true;   ///< u is constant, else v
  double at = 0;      ///< the parameter, as the file has it
  double angle = 0;   ///< the largest that was found between the normals on both sides, degrees
  bool torn = false;  ///< the surface itself jumps: an offset of one that bends
};

/// Finds kinks above 2 degrees, by u and then v. Curvatures on both sides do not show them, and sizes by an angle or a
/// chord cut across. Passes exceptions of OpenCASCADE on.
std::vector<Kink> kinks_of(const TopoDS_Face& face);

/// A face that goes once around a periodic surface, from a kink to itself: where its box begins and ends.
struct ClosingKink {
  bool of_u = false, of_v = false;  ///< there is one
  double low_u = 0, high_u = 0, low_v = 0, high_v = 0;
};
/// Passes exceptions of OpenCASCADE on.
ClosingKink closing_kink_of(const TopoDS_Face& face);

}  // namespace carreau_occ
