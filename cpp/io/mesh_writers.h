// SPDX-License-Identifier: BSD-3-Clause
// One function a format; the mesh has passed the checks of mesh_bytes. For mesh_files.cpp and the tests.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "mesh/flat_mesh.h"
#include "projection/mesh_association.h"

namespace carreau {

/// Takes the bytes of a file one after the other.
using ByteSink = std::function<void(std::string_view)>;

/// With `association` (nullptr: none) the places of nodes on the geometry.
std::string medit_text(const FlatMesh& mesh, const MeshAssociation* association = nullptr);
/// Version 2 (32-bit positions) or 3 (64-bit positions).
std::string gmf_bytes(const FlatMesh& mesh, int version, const MeshAssociation* association = nullptr);
void write_gmf(const FlatMesh& mesh, int version, const MeshAssociation* association, const ByteSink& sink);
/// True when positions of the file need version 3.
bool gmf_needs_64_bits(const FlatMesh& mesh, const MeshAssociation* association = nullptr) noexcept;
std::string vtu_bytes(const FlatMesh& mesh, const MeshAssociation* association = nullptr);
/// VTK's legacy format, as text or in binary form.
std::string vtk_text(const FlatMesh& mesh, bool ascii);
void write_vtu(const FlatMesh& mesh, const MeshAssociation* association, const ByteSink& sink);
std::string stl_bytes(const FlatMesh& mesh);
std::string stl_text(const FlatMesh& mesh);
/// Version 4.1 or 2.2 of Gmsh's format, with or without curves and corners as elements of groups of their own.
std::string msh_text(const FlatMesh& mesh, bool version_2, bool curve_groups, const MeshAssociation* association = nullptr);
/// A mesh of straight triangles of the plane z = 0, else InvalidArgument.
std::string bl2d_text(const FlatMesh& mesh);
/// Abaqus and CalculiX, Nastran, I-DEAS, SU2: elements in named sets (solver/element_sets.h). SU2 has no elements of
/// order two: InvalidArgument.
std::string inp_text(const FlatMesh& mesh);
std::string bdf_text(const FlatMesh& mesh);
std::string unv_text(const FlatMesh& mesh);
std::string su2_text(const FlatMesh& mesh);
/// Polygons: no elements of order two either.
std::string off_text(const FlatMesh& mesh);
std::string obj_text(const FlatMesh& mesh);
std::string ply_bytes(const FlatMesh& mesh);
/// Cart3D: straight triangles alone.
std::string tri_text(const FlatMesh& mesh);
/// For programs that fill solids (mesh/regions.h): TetGen's .smesh or .poly, Netgen's .vol, and a script of Gmsh for the
/// surface in the file `surface`. InvalidArgument when the surface is open.
std::string tetgen_text(const FlatMesh& mesh, bool poly);
std::string netgen_text(const FlatMesh& mesh);
std::string geo_text(const FlatMesh& mesh, const std::string& surface);
/// A name whose control characters and quotation marks are '_'.
std::string plain_name(const std::string& name);
/// Plain name of a face: its own, or `prefix` and its reference.
std::string name_of_face(const FlatMesh& mesh, std::int32_t ref, const std::string& prefix);

/// Reference of entity i; an empty list means that all are 0.
inline std::int32_t ref_of(const std::vector<std::int32_t>& refs, std::size_t i) noexcept {
  return refs.empty() ? 0 : refs[i];
}

}  // namespace carreau
