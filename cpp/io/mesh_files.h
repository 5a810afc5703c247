// Mesh files. Writers make the whole file under a temporary name and rename it, so that an older file survives a
// failure.
#pragma once

#include <string>

#include "mesh/flat_mesh.h"

namespace carreau {

/// Medit ASCII (`.mesh`, version 2), binary (`.meshb`, version 2 of GMF), VTK XML (`.vtu`), STL (`.stl`, binary, one
/// solid; `.stla` is not a suffix: see options).
enum class MeshFormat { mesh, meshb, vtu, stl };

/// Format by the suffix of `path` (case does not matter). Throws InvalidArgument for another suffix, listing those
/// known.
MeshFormat mesh_format_of(const std::string& path);

/// Throws FileError. A 3-D format (stl) of a mesh of dimension 2 is written with z = 0.
void write_mesh(const FlatMesh& mesh, const std::string& path, MeshFormat format);

/// Reads `.mesh` (ASCII, versions 0 to 3) or `.meshb`. Unknown sections are skipped when that is safe. Throws FileError
/// with file and line.
FlatMesh read_mesh(const std::string& path);
FlatMesh read_mesh_text(std::string_view text, const std::string& name);
FlatMesh read_mesh_binary(std::string_view bytes, const std::string& name);

/// The parts without a file, for tests and for callers that have their own storage.
std::string mesh_bytes(const FlatMesh& mesh, MeshFormat format);

}  // namespace carreau
