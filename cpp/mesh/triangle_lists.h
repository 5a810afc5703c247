// SPDX-License-Identifier: BSD-3-Clause
// A view of the triangles of a mesh, without copies.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/flat_mesh.h"
#include "mesh/surface_mesh.h"
#include "support/vec.h"

namespace carreau {

/// Triangles of a surface mesh are numbered face after face, in the order of flatten(). The mesh outlives the lists.
class TriangleLists {
 public:
  explicit TriangleLists(const FlatMesh& mesh) : vertices_(mesh.vertices), nodes_(mesh.vertices.size()), on_curves_(mesh.vertices.size()) {
    add(mesh.triangles, nullptr);
  }
  explicit TriangleLists(const SurfaceMesh& mesh)
      : vertices_(mesh.vertices), nodes_(mesh.vertices.size() + mesh.mid_vertices.size()) {
    for (const FaceMesh& face : mesh.faces) add(face.triangles, face.vertex.data());
    for (const CurveMesh& curve : mesh.curves)
      for (const std::int32_t v : curve.vertices) on_curves_ = std::max(on_curves_, static_cast<std::size_t>(v) + 1);
  }

  /// Corners; nodes on edges follow them.
  [[nodiscard]] std::span<const Vec3> vertices() const noexcept { return vertices_; }
  [[nodiscard]] std::size_t nodes() const noexcept { return nodes_; }
  /// Vertices from this number on lie on no curve; the number of vertices if curves are not known.
  [[nodiscard]] std::size_t on_curves() const noexcept { return on_curves_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// use(t, corners) for each triangle t, begin <= t < end, in order.
  template <typename Use>
  void for_each(std::size_t begin, std::size_t end, const Use& use) const {
    if (begin >= end) return;
    auto list = std::upper_bound(lists_.begin(), lists_.end(), begin,
                                 [](std::size_t t, const List& each) { return t < each.first; }) -
                1;
    for (std::size_t t = begin; t < end; ++list)
      for (std::size_t i = t - list->first; i < list->triangles.size() && t < end; ++i, ++t) {
        const std::array<std::int32_t, 3>& own = list->triangles[i];
        if (list->vertex == nullptr)
          use(t, own);
        else
          use(t, std::array{list->vertex[own[0]], list->vertex[own[1]], list->vertex[own[2]]});
      }
  }

 private:
  struct List {
    std::size_t first;
    std::span<const std::array<std::int32_t, 3>> triangles;
    const std::int32_t* vertex;  // local -> whole; null: equal
  };

  void add(std::span<const std::array<std::int32_t, 3>> triangles, const std::int32_t* vertex) {
    if (triangles.empty()) return;
    lists_.push_back({size_, triangles, vertex});
    size_ += triangles.size();
  }

  std::span<const Vec3> vertices_;
  std::size_t nodes_, size_ = 0, on_curves_ = 0;
  std::vector<List> lists_;  // none is empty
};

}  // namespace carreau
