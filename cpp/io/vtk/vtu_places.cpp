// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtk/vtu_places.h"

#include <algorithm>

#include "support/infinity.h"

namespace carreau {

void add_node_places(VtuFile& file, const MeshAssociation& association) {
  std::vector<std::int32_t> dimensions, refs;
  std::vector<double> t, uv;
  for (std::size_t v = 0; v < association.entities.size(); ++v) {
    const auto [dimension, ref] = association.entities[v];
    dimensions.push_back(dimension), refs.push_back(ref);
    const std::span<const double> known = association.parameters(dimension, static_cast<std::int32_t>(v), ref);
    t.push_back(dimension == 1 && !known.empty() ? known[0] : nan);
    for (const std::size_t i : {0U, 1U}) uv.push_back(dimension == 2 && !known.empty() ? known[i] : nan);
  }
  file.array("entity_dimension", 1, dimensions);
  file.array("entity_reference", 1, refs);
  file.array("curve_t", 1, t);
  file.array("face_uv", 2, uv);
}

void add_cell_places(VtuFile& file, std::span<const std::size_t> counts, std::size_t cells, const MeshAssociation& association) {
  const std::size_t width = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  if (width == 0) return;
  std::vector<double> uv(2 * width * cells, nan);
  std::vector<std::int32_t> faces(association.cell_faces.empty() ? 0 : width * cells, 0);
  std::size_t k = 0;
  for (std::size_t c = 0; c < counts.size(); ++c)
    for (std::size_t i = 0; i < counts[c]; ++i, ++k) {
      std::copy_n(association.cell_uv[k].data(), 2, uv.data() + 2 * (width * c + i));
      if (!faces.empty()) faces[width * c + i] = association.cell_faces[k];
    }
  file.array("corner_uv", static_cast<int>(2 * width), uv);
  if (!faces.empty()) file.array("corner_face", static_cast<int>(width), faces);
}

}  // namespace carreau
