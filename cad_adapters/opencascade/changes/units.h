// SPDX-License-Identifier: BSD-3-Clause
// Units of lengths.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <string>

#include "shape_file.h"

namespace carreau_occ {

struct UnknownUnit : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Multiplies the coordinates of a shape in millimetres, or without unit, so that they are in `unit`, and then by
/// `scale`. Units: nm, um, mm, cm, dm, m, km, mil, in, ft, yd; "": as they are. Tolerances follow; so do the parts of
/// labels and doubts. Throws UnknownUnit with a sentence: no such unit, or a file without one. Passes exceptions of
/// OpenCASCADE on.
void change_lengths(ShapeFile& file, const std::string& unit, double scale);

struct LengthUnit {
  const char* sign;
  double millimetres;
  std::array<const char*, 3> names;  // others of it, in lower case
};

// ISO 80000-3; an inch is 25.4 mm.
inline constexpr std::array<LengthUnit, 11> length_units{{{"nm", 1e-6, {"nanometre", "nanometer", ""}},
                                      {"um", 1e-3, {"micrometre", "micron", "micrometer"}},
                                      {"mm", 1, {"millimetre", "millimeter", ""}},
                                      {"cm", 10, {"centimetre", "centimeter", ""}},
                                      {"dm", 100, {"decimetre", "decimeter", ""}},
                                      {"m", 1e3, {"metre", "meter", ""}},
                                      {"km", 1e6, {"kilometre", "kilometer", ""}},
                                      {"mil", 0.0254, {"milliinch", "mils", ""}},
                                      {"in", 25.4, {"inch", "inches", ""}},
                                      {"ft", 304.8, {"foot", "feet", ""}},
                                      {"yd", 914.4, {"yard", "yards", ""}}}};

/// The usual sign of a unit that OpenCASCADE, STEP or IGES name ("metre", "MM", "INCH"); other names stay.
inline std::string unit_sign(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const LengthUnit& unit : length_units)
    if (name == unit.sign || std::find(unit.names.begin(), unit.names.end(), name) != unit.names.end()) return unit.sign;
  return name;
}

}  // namespace carreau_occ
