// SPDX-License-Identifier: BSD-3-Clause
// Triangles that cross, by the parts of the input that they belong to.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "check/crossings.h"
#include "inputs/base/cad_input.h"

namespace command {

/// Two parts, or faces of an input without parts, whose triangles cross; twice the same: it crosses itself.
struct PartCrossing {
  std::array<CadInput::Part, 2> parts{};
  bool are_faces = false;  ///< numbers are references of faces
  std::int64_t pairs = 0;  ///< of triangles
  Point place{};           ///< of the first pair
};

/// Most pairs of triangles first.
std::vector<PartCrossing> part_crossings_of(const Crossings& crossings, const CadInput& input);

/// "412 pairs of triangles (310 triangles) cross: 2 pairs of solids touch or overlap", a line for each pair of parts,
/// and a line with a remedy. Empty when nothing crosses.
std::vector<std::string> crossing_lines(const Crossings& crossings, const CadInput& input);

nlohmann::ordered_json part_crossings_json(const Crossings& crossings, const CadInput& input);

}  // namespace command
