// SPDX-License-Identifier: BSD-3-Clause
// Poles of a face: sides of (u, v) that are one point of space.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>

#include "mesh/surface_mesh.h"

namespace carreau {

/// Keeps a reference to the face.
class Poles {
 public:
  explicit Poles(const FaceMesh& face) : face_(face) {
    for (const auto& t : face.flattened)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t a = t[i], b = t[(i + 1) % 3];
        if (face.vertex[a] != face.vertex[b]) continue;
        const Box box{face.uv[a].cwiseMin(face.uv[b]), face.uv[a].cwiseMax(face.uv[b])};
        const auto [pole, is_new] = of_vertex_.try_emplace(face.vertex[a], box);
        if (!is_new) pole->second = {pole->second.low.cwiseMin(box.low), pole->second.high.cwiseMax(box.high)};
      }
  }

  /// The place in (u, v) where the way from `other` reaches a local vertex. At a pole whose side is a line of one parameter, the way keeps
  /// the other parameter, as the shortest way in space does.
  [[nodiscard]] Vec2 arrival(std::int32_t v, const Vec2& other) const {
    Vec2 p = face_.uv[v];
    const auto pole = of_vertex_.find(face_.vertex[v]);
    if (pole == of_vertex_.end()) return p;
    const auto& [low, high] = pole->second;
    if (low.y() == high.y()) p.x() = std::clamp(other.x(), low.x(), high.x());
    if (low.x() == high.x()) p.y() = std::clamp(other.y(), low.y(), high.y());
    return p;
  }
  /// The way from a second local vertex; between two poles it ends at the place of v.
  [[nodiscard]] Vec2 arrival(std::int32_t v, std::int32_t other) const {
    return of_vertex_.contains(face_.vertex[other]) ? face_.uv[v] : arrival(v, face_.uv[other]);
  }

  [[nodiscard]] bool empty() const noexcept { return of_vertex_.empty(); }
  /// `vertex`: of space.
  [[nodiscard]] bool contains(std::int32_t vertex) const { return of_vertex_.contains(vertex); }
  [[nodiscard]] const FaceMesh& face() const noexcept { return face_; }

 private:
  struct Box {
    Vec2 low, high;
  };
  const FaceMesh& face_;
  std::map<std::int32_t, Box> of_vertex_;  // of space
};

}  // namespace carreau
