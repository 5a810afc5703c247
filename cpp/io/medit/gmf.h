// SPDX-License-Identifier: BSD-3-Clause
// Facts of the GMF binary format (`.meshb`; libMeshb has the public description). A file is the number 1 in the
// writer's byte order, a version, then sections: code, position of the next section, content. `End` is the last.
//
//            reals      references, indices   positions   counts
// version 1  32 bits    32 bits               32 bits     32 bits
// version 2  64         32                    32          32
// version 3  64         32                    64          32
// version 4  64         64                    64          64
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace carreau {

enum class GmfCode : std::int32_t {
  dimension = 3,
  vertices = 4,
  edges = 5,
  triangles = 6,
  quadrilaterals = 7,
  tetrahedra = 8,
  prisms = 9,
  hexahedra = 10,
  triangles_of_order_2 = 24,
  edges_of_order_2 = 25,
  quadrilaterals_of_order_2 = 27,
  tetrahedra_of_order_2 = 30,
  vertices_on_points = 40,  // VerticesOnGeometricVertices, ...Edges, ...Triangles
  vertices_on_curves = 41,
  vertices_on_faces = 42,
  edges_on_curves = 44,
  pyramids = 49,
  end = 54,
  sol_at_vertices = 62
};

struct GmfSizes {
  std::size_t real, index, position, count;
};

constexpr GmfSizes gmf_sizes(int version) noexcept {
  return {version == 1 ? 4u : 8u, version == 4 ? 8u : 4u, version >= 3 ? 8u : 4u, version == 4 ? 8u : 4u};
}

/// The start of the next section if a section starts at `at` and holds `count` records of `record` bytes.
constexpr std::uint64_t gmf_next(std::uint64_t at, int version, std::uint64_t count, std::uint64_t record) noexcept {
  const GmfSizes sizes = gmf_sizes(version);
  return at + 4 + sizes.position + sizes.count + count * record;
}

/// The numbers of entities in a file.
struct GmfCounts {
  int dimension = 3;
  std::uint64_t vertices = 0, triangles = 0, edges = 0;
  std::uint64_t cells = 0;  ///< elements, if they are not the triangles
};

/// Bytes of a file of version 3, at most.
constexpr std::uint64_t gmf_most_bytes(const GmfCounts& of) noexcept {
  const std::uint64_t vertex = 8 * static_cast<std::uint64_t>(of.dimension) + 4;
  // An element of second order takes at most 40 bytes, and a vertex if it is a quadrilateral.
  return 300 + vertex * (of.vertices + of.cells) + 16 * of.triangles + 40 * of.cells + 16 * of.edges;
}
/// True if positions may need version 3. `more`: bytes of further sections.
constexpr bool gmf_needs_64_bits(const GmfCounts& of, std::uint64_t more = 0) noexcept {
  return gmf_most_bytes(of) + more > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max());
}

}  // namespace carreau
