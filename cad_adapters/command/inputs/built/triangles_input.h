// SPDX-License-Identifier: BSD-3-Clause
// Surfaces given as triangles as geometry.
#pragma once

#include <carreau_geometry.h>

#include <cstdint>
#include <memory>
#include <string>

#include "files/mesh_file.h"
#include "inputs/base/input_choice.h"

namespace command {

class CadInput;
struct Place;

inline constexpr const char* triangles_suffixes[] = {".stl", ".off",  ".obj", ".ply", ".mesh", ".meshb", ".vtu", ".vtk",
                                                     ".msh", ".msh2", ".inp", ".bdf", ".unv",  ".su2",   ".tri", ".med"};
/// True if the suffix belongs to files of triangles, or a STEP file has no other faces.
bool is_triangles(const std::string& path);

/// Findings in the triangles of a session. Throws Failure.
carreau_triangles_report triangles_report(carreau_session* session);
/// The place of (u, v) of a face of a session whose surface is given as triangles. False if the evaluation fails.
bool locate_by(carreau_session* session, std::int32_t face, double u, double v, Place& place) noexcept;
/// Describes the distance between the mesh of a session and its triangles; `deviation`: of the smooth surface. Throws
/// Failure.
std::string distances_line(carreau_session* session, double deviation);

/// Throws Failure.
std::unique_ptr<CadInput> open_triangles(const std::string& path, const TrianglesChoice& choice);

/// The repaired triangles of a file, with their lines; refined if an angle (degrees) is above 0. Warnings go to the
/// error output unless `quiet`. Throws Failure.
MeshHandle refined_triangles(const std::string& path, const TrianglesChoice& choice, double angle, int depth,
                             bool quiet);

/// The output of `carreau info` for a file of triangles. Throws Failure.
void print_triangles_info(const std::string& path, const TrianglesChoice& choice, bool json);

}  // namespace command
