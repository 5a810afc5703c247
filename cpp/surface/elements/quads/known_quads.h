// SPDX-License-Identifier: BSD-3-Clause
// Quadrilaterals of an earlier round: a face with an equal patch between equal curves has equal cells.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "surface/elements/quads/face_quads.h"

namespace carreau {

/// The cells of faces with their input, before the cells were put into the mesh.
class KnownQuads {
 public:
  /// Begins a round. `is_known`: by face, whether its patch and its control space are equal to the last round's.
  void begin(std::vector<char> is_known) {
    is_known_ = std::move(is_known);
    faces_.resize(is_known_.size());
  }
  /// Gives a face its known cells. Otherwise keeps its input and returns false. `middles`: by curve and edge the vertex that
  /// cuts the edge; empty if cells are not cut. Threads may call it for different faces.
  bool find(const ElementWork& work, const std::vector<std::vector<std::int32_t>>& middles, FaceQuads& quads);
  /// Keeps the cells of a face.
  void keep(const ElementWork& work, const FaceQuads& quads);

 private:
  struct Face {
    std::vector<Vec2> uv;
    std::vector<Vec3> xyz;
    std::vector<std::array<std::int32_t, 3>> triangles;
    std::vector<LayerCell> rows;
    std::optional<FaceQuads> made = {};
    std::vector<LayerCell> made_rows = {};
  };
  std::vector<Face> faces_;
  std::vector<char> is_known_;
};

}  // namespace carreau
