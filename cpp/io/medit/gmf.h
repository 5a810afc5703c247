// SPDX-License-Identifier: BSD-3-Clause
// Facts of the GMF binary format (`.meshb`; the public description is that of libMeshb): a file is the number 1 in the
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

namespace carreau {

enum class GmfCode : std::int32_t {
  dimension = 3,
  vertices = 4,
  edges = 5,
  triangles = 6,
  quadrilaterals = 7,
  tetrahedra = 8,
  triangles_of_order_2 = 24,
  edges_of_order_2 = 25,
  quadrilaterals_of_order_2 = 27,
  end = 54,
  sol_at_vertices = 62
};

struct GmfSizes {
  std::size_t real, index, position, count;
};

constexpr GmfSizes gmf_sizes(int version) noexcept {
  return {version == 1 ? 4u : 8u, version == 4 ? 8u : 4u, version >= 3 ? 8u : 4u, version == 4 ? 8u : 4u};
}

}  // namespace carreau
