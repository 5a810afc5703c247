// SPDX-License-Identifier: BSD-3-Clause
// Mesh files. Writers make the whole file under a temporary name and rename it, so that an older file survives a
// failure.
#pragma once

#include <string>
#include <string_view>

#include "mesh/flat_mesh.h"

namespace carreau {

struct MeshAssociation;

/// Medit ASCII (`.mesh`, version 2), its binary form (`.meshb`, GMF version 2; 3 when the file would exceed 2 GiB). VTK
/// XML (`.vtu`, with references and fields as point and cell data), STL (`.stl`, triangles only). Gmsh ASCII (`.msh`,
/// version 4.1; `.msh2`, version 2.2; both with physical names). BL2D (`.bl2d`, meshes of the plane z = 0). Solvers:
/// Abaqus and CalculiX (`.inp`), Nastran (`.bdf`), I-DEAS (`.unv`), SU2 (`.su2`), with named sets. Polygons: OFF
/// (`.off`), Wavefront (`.obj`, a group a face), PLY (`.ply`, binary). VTK's legacy format (`.vtk`), Cart3D (`.tri`).
/// Surfaces for programs that fill solids, written only: TetGen (`.smesh`, `.poly`), Netgen (`.vol`), a script for Gmsh
/// (`.geo`) beside a `.msh` file of the same name.
enum class MeshFormat { mesh, meshb, vtu, stl, msh, msh2, bl2d, inp, bdf, unv, su2, off, obj, ply, vtk, tri, smesh, poly, vol, geo };

struct MeshFileOptions {
  /// STL as text, one solid for each triangle reference, in ascending order ("surface_3"); `.vtk` as text; otherwise
  /// both are binary.
  bool ascii_stl = false;
  /// Gmsh's formats: edges of curves and corners are elements, each curve and corner a physical group; otherwise there
  /// are triangles only.
  bool curve_groups = true;
  /// Gmsh, Medit and .vtu: the places of nodes on the geometry, written too; nullptr: none.
  const MeshAssociation* association = nullptr;
  std::string surface = "surface.msh";  ///< `.geo`: the file that has the surface; write_mesh() takes the name of its own file
};

/// Format by the suffix of `path`, in any case. Throws InvalidArgument for another suffix, listing the known ones.
MeshFormat mesh_format_of(const std::string& path);

/// The content of the file. Lists of references may be empty (all 0). A mesh of dimension 2 is written with z = 0 in
/// vtu and stl. Throws InvalidArgument for a mesh that no reader would accept: a list or field of the wrong length, an
/// index out of range, a coordinate that is not finite. Binary STL also excludes coordinates too large for single
/// precision.
std::string mesh_bytes(const FlatMesh& mesh, MeshFormat format, const MeshFileOptions& options = {});

/// Throws the exceptions of mesh_bytes, and FileError. The older file does not change then.
void write_mesh(const FlatMesh& mesh, const std::string& path, MeshFormat format, const MeshFileOptions& options = {});

/// Reads a file by its suffix, see mesh_format_of(). Throws InvalidArgument for another suffix, FileError with file and
/// line, or file and byte. Reads vertices, edges and triangles, their references, names of faces and, from .vtu, fields,
/// if the format holds them. Only Medit's files and BL2D's give meshes of dimension 2.
FlatMesh read_mesh(const std::string& path);
/// Medit ASCII (versions 0 to 4) or binary (GMF versions 1 to 4, either byte order); read_mesh() distinguishes them by
/// the content. Reads quadrilaterals and elements of second order (nine nodes: without the centre), and the outer faces
/// of solids. Mixed orders, a word that is no section of the format (ASCII), and a repeated section are errors. End may
/// be missing from text that is whole. Other sections are skipped.
FlatMesh read_mesh_text(std::string_view text, const std::string& name);
FlatMesh read_mesh_binary(std::string_view bytes, const std::string& name);
/// Gmsh, versions 4.1 and 2.2, ASCII and binary (either byte order). References are the numbers of entities (or of physical groups, if an
/// element has no entity), names the names of physical groups. Vertices have the order of their numbers. Solids without a surface are
/// replaced by their outer faces. Elements of surfaces are triangles and quadrilaterals of order 1 or 2 (types 2, 3, 9, 16); other elements
/// and mixed orders are errors.
FlatMesh read_mesh_msh(std::string_view content, const std::string& name);
/// STL, text or binary: corners of equal coordinates become one vertex. Solids of the text form are faces.
FlatMesh read_mesh_stl(std::string_view content, const std::string& name);
/// OFF (text), Wavefront OBJ, PLY (text, both binary forms): vertices, and polygons cut into triangles. In OBJ, groups
/// and objects are faces, polylines edges; PLY needs the list vertex_indices. Colours, normals and textures are skipped.
FlatMesh read_mesh_off(std::string_view content, const std::string& name);
FlatMesh read_mesh_obj(std::string_view content, const std::string& name);
FlatMesh read_mesh_ply(std::string_view content, const std::string& name);
/// Abaqus and CalculiX: *NODE, *ELEMENT of shells, membranes and plane elements, *ELSET; solids, beams and other keywords are
/// skipped. Sets are faces ("face_7" has reference 7), edges are not in the format.
FlatMesh read_mesh_inp(std::string_view text, const std::string& name);
/// Nastran: GRID in any system, CTRIA3, CTRIA6, CQUAD4, CQUAD8, PLOTEL, CBAR, CBEAM, CROD; properties are references.
FlatMesh read_mesh_bdf(std::string_view text, const std::string& name);
/// I-DEAS: datasets 2411 and 781 (nodes), 2412 (shells, plane elements, beams as edges), 2467 and its sisters (groups). Groups
/// of shells are faces ("face_7" has reference 7), groups of beams curves; without groups properties are the references.
FlatMesh read_mesh_unv(std::string_view text, const std::string& name);
/// SU2: of the plane elements and, as curves, markers; of space the markers, as faces.
FlatMesh read_mesh_su2(std::string_view text, const std::string& name);
/// BL2D: vertices, edges and triangles of the plane, with references.
FlatMesh read_mesh_bl2d(std::string_view text, const std::string& name);
/// VTK's legacy format, ASCII or binary: POLYDATA and UNSTRUCTURED_GRID, with the cells of VTK XML.
FlatMesh read_mesh_vtk(std::string_view content, const std::string& name);
/// Cart3D's triangulations, ASCII: numbers of vertices and triangles, both, components of triangles as references.
FlatMesh read_mesh_tri(std::string_view text, const std::string& name);
/// VTK XML: arrays as text, base64 or raw bytes, also compressed by zlib. Pieces share the vertices that lie at one place. Cells are triangles and quadrilaterals of
/// order 1 or 2 (vtk_cells.h), lines and solids; points are skipped, others and mixed orders are errors.
FlatMesh read_mesh_vtu(std::string_view content, const std::string& name);

}  // namespace carreau
