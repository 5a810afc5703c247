// SPDX-License-Identifier: BSD-3-Clause
// Units of lengths.
#pragma once

#include <stdexcept>
#include <string>

#include "shape_file.h"

namespace carreau_occ {

struct UnknownUnit : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Multiplies the coordinates of a shape that is in millimetres, or in no unit, so that they are in `unit` (nm, um, mm,
/// cm, dm, m, km, mil, in, ft, yd; "": as they are), and then by `scale`. Tolerances follow; so do the parts of labels
/// and doubts. Throws UnknownUnit with a sentence: no such unit, or a file without one. Throws what OpenCASCADE throws.
void change_lengths(ShapeFile& file, const std::string& unit, double scale);

/// The usual sign of a unit that OpenCASCADE, STEP or IGES name ("metre", "MM", "INCH"); other names stay.
std::string unit_sign(std::string name);

}  // namespace carreau_occ
