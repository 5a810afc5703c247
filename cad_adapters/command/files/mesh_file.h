// SPDX-License-Identifier: BSD-3-Clause
// A mesh read from a file through the C interface.
#pragma once

#include <carreau.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/failure.h"

namespace command {

using Point = std::array<double, 3>;

/// Vectors of the space of a mesh.
inline Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double triple(const Point& a, const Point& b, const Point& c) { return dot(a, cross(b, c)); }
/// A vector of length 1; (0, 0, 1) for the zero vector.
inline Point unit(const Point& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? Point{a[0] / length, a[1] / length, a[2] / length} : Point{0, 0, 1};
}

struct FreeMesh {
  void operator()(carreau_mesh* mesh) const noexcept { carreau_mesh_free(mesh); }
};
using MeshHandle = std::unique_ptr<carreau_mesh, FreeMesh>;

/// Suffixes of the formats that the library writes, and of the program's own.
inline const std::vector<std::string> mesh_suffixes{".mesh", ".meshb", ".vtu", ".stl", ".msh", ".msh2", ".bl2d",
                                                     ".inp",  ".bdf",   ".unv", ".su2", ".off", ".obj",  ".ply",
                                                     ".vtk",  ".tri",   ".med", ".smesh", ".poly", ".vol", ".geo"};

/// Reads a file of any format that the library reads, or .med. Throws Failure with the library's sentence.
MeshHandle read_mesh(const std::string& path);

/// Writes a file of `mesh_suffixes`. Throws Failure with the library's sentence.
void write_mesh(carreau_mesh* mesh, const std::string& path);

/// Suffix of a table of the groups of a mesh: a line "dimension reference name" for each entity in a group.
inline const std::string group_table_suffix = ".groups";
/// That table. Throws Failure.
std::string group_table(carreau_mesh* mesh);

/// Throws Failure when this program cannot write one of the files for lack of a library.
void require_writers(const std::vector<std::string>& paths);

/// Throws Failure with the sentence of the last call on `mesh` when `status` is an error.
void require(carreau_mesh* mesh, carreau_status status);

/// The status of a face, from the library.
struct FaceResult {
  std::int32_t ref = 0, status = CARREAU_FACE_FAILED;
  std::int64_t triangles = 0;
  std::string name, why;
  std::int32_t rgb = -1;  ///< 0xRRGGBB, or -1: no colour
};

/// "meshed", "mended", "collapsed", "failed".
const char* status_word(std::int32_t status);

/// ": why", without the face, which is named before; "" without a reason.
std::string reason_of(const FaceResult& face);

/// In the order of the mesh. Throws Failure.
std::vector<FaceResult> faces_of(carreau_mesh* mesh);

/// An element that is not a straight triangle (CARREAU_CELL_...).
struct Element {
  std::int32_t kind = 0, ref = 0;
  std::array<std::int32_t, 8> nodes{};  ///< as many as the kind has

  [[nodiscard]] int corners() const { return kind == CARREAU_CELL_QUAD4 || kind == CARREAU_CELL_QUAD8 ? 4 : 3; }
  [[nodiscard]] bool is_curved() const { return kind == CARREAU_CELL_TRIANGLE6 || kind == CARREAU_CELL_QUAD8; }
};

/// Copies of the arrays of a mesh; vertices and triangles count from 0.
struct MeshArrays {
  int dimension = 3;
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> triangle_refs;
  std::vector<std::array<std::int32_t, 2>> edges;  ///< of curves
  std::vector<Element> elements;                   ///< empty: the triangles
  std::vector<FaceResult> faces;
};

/// Throws Failure.
MeshArrays arrays_of(carreau_mesh* mesh);

}  // namespace command
