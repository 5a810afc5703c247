// The conforming mesh of a composite surface.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// Status of a face. Values are part of the C ABI.
enum class FaceStatus : int { not_meshed = 0, meshed = 1, mended = 2, failed = 3 };

/// The part of the mesh that lies on one face. Local vertices carry (u, v): a vertex of space on a seam or at a pole
/// has several.
struct FaceMesh {
  int ref = 0;
  FaceStatus status = FaceStatus::not_meshed;
  std::string why;                                     ///< sentence for `mended` and `failed`
  std::vector<Vec2> uv;                                ///< of local vertices
  std::vector<std::int32_t> vertex;                    ///< local -> index in SurfaceMesh::vertices
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< local indices; counterclockwise in (u, v)
};

/// A discretised curve: vertices[i], vertices[i+1] are its edges.
struct CurveMesh {
  int ref = 0;
  std::vector<std::int32_t> vertices;  ///< indices in SurfaceMesh::vertices; one entry for a degenerate curve
};

struct SurfaceMesh {
  std::vector<Vec3> vertices;
  std::vector<std::int32_t> vertex_ref;  ///< reference of the corner or imposed point; 0: made by the mesher
  std::vector<FaceMesh> faces;           ///< as in the model
  std::vector<CurveMesh> curves;         ///< as in the topology

  [[nodiscard]] std::size_t triangle_count() const noexcept;
  [[nodiscard]] std::size_t edge_count() const noexcept;
};

/// One sentence a defect, e.g. "triangle 17 of face 3: no area"; empty when the mesh is sound. Checks index ranges,
/// finite coordinates, repeated vertices, zero area in (u, v) and in space, orientation inside each face, duplicated
/// triangles, unused vertices, curve edges present in every face that holds the curve, and edges of more than two
/// triangles away from curves. At most `limit` sentences.
struct DefectOptions {
  bool closed = false;  ///< an edge with one triangle is a defect
  std::size_t limit = 20;
};
std::vector<std::string> find_defects(const SurfaceMesh& mesh, const DefectOptions& options = {});

}  // namespace carreau
