// SPDX-License-Identifier: BSD-3-Clause
// STEP files of AP242 whose shape is triangles alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace command {

/// Triangles of the tessellated faces of a file, in millimetres; each face has a reference, from 1.
struct Tessellation {
  std::vector<double> vertices;         ///< x y z
  std::vector<std::int32_t> triangles;  ///< three vertices each, from 0
  std::vector<std::int32_t> refs;       ///< of triangles
};

/// True if a file is STEP, and has tessellated faces and no others (ISO 10303-42, tessellated geometry): OpenCASCADE
/// 7.6 does not read these.
bool is_tessellated_step(const std::string& path);

/// Reads the faces of all TESSELLATED_SHELL and TESSELLATED_SOLID, or the faces outside of them when the file has
/// neither: TRIANGULATED_FACE and COMPLEX_TRIANGULATED_FACE. A component of an assembly is read once for each of its
/// places (tessellated_assembly.h). Throws Failure with the file and the entity.
Tessellation read_tessellation(const std::string& path);

}  // namespace command
