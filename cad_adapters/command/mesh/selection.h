// SPDX-License-Identifier: BSD-3-Clause
// Faces, edges, vertices and solids that a person names.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "inputs/base/cad_input.h"

namespace command {

/// Entities of one dimension: vertices (0), edges (1), faces (2) or solids (3).
struct Selection {
  int dimension = 2;
  std::vector<std::int32_t> refs;  ///< ascending
};

/// Finds "face:12-19,21", "edge:3", "vertex:7", "solid:2", "color:#ff0000" and "layer:walls" (faces), or a word, which may
/// hold * and ?: faces of that name or number, else solids, edges or vertices of that name. A word behind "face:",
/// "solid:", "edge:" or "vertex:" may be a name, too. Throws Failure, which begins with `option`, when nothing fits; it
/// suggests near names.
Selection select(const CadInput& input, const std::string& text, const std::string& option);

}  // namespace command
