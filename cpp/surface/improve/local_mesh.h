// Parts of an assembled mesh that may still change.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/surface_mesh.h"

namespace carreau {

/// A vertex that may move is tried in six directions at these distances in the metric.
inline constexpr std::array<double, 5> placement_distances{0.24, 0.12, 0.06, 0.03, 0.015};

/// Triangles around some vertices of a mesh, over all its faces, kept up to date while edges are swapped or divided.
/// Vertices and edges of curves, imposed points and triangles that are flat in space (FaceMesh::flattened) stay.
/// Vertices are indices in SurfaceMesh::vertices unless they are said to be local.
class LocalMesh {
 public:
  using Triangle = std::array<std::int32_t, 3>;
  struct Place {
    std::int32_t face, triangle;
    friend bool operator==(const Place&, const Place&) = default;
  };
  struct Vertex {
    std::int32_t face, local;
    friend auto operator<=>(const Vertex&, const Vertex&) = default;
  };
  /// Two triangles of a face on the edge from a to b: c on its left, d on its right. Local vertices.
  struct Quad {
    std::int32_t face, t, u, a, b, c, d;
    Triangle first, second;  ///< as they were

    [[nodiscard]] std::array<Place, 2> places() const noexcept { return {Place{face, t}, Place{face, u}}; }
  };

  /// Knows the triangles around `centres` and around their neighbours, `rings` times. Keeps a reference to the mesh.
  LocalMesh(SurfaceMesh& mesh, std::span<const std::int32_t> centres, int rings);

  [[nodiscard]] const Triangle& at(Place p) const { return mesh_.faces[p.face].triangles[p.triangle]; }
  [[nodiscard]] std::int32_t global(std::int32_t face, std::int32_t local) const {
    return mesh_.faces[face].vertex[local];
  }
  [[nodiscard]] std::int32_t global(Vertex v) const { return global(v.face, v.local); }
  [[nodiscard]] Vec3 position(std::int32_t face, std::int32_t local) const {
    return mesh_.vertices[global(face, local)];
  }

  /// Whether all triangles around v are known.
  [[nodiscard]] bool is_known(std::int32_t v) const { return rank_[v] >= 0; }
  [[nodiscard]] const std::vector<Place>& fan(std::int32_t v) const { return fans_[rank_[v]]; }
  /// Vertices around v, each once, in increasing order.
  [[nodiscard]] std::vector<std::int32_t> ring(std::int32_t v) const;
  /// The vertex of a face that v is, if it is inside and all around its neighbours is known.
  [[nodiscard]] std::optional<Vertex> inside(std::int32_t v) const;
  /// On side `side` of a triangle, if that is no edge of a curve and all is known around the four vertices.
  [[nodiscard]] std::optional<Quad> quad(Place p, int side) const;
  [[nodiscard]] std::array<std::int32_t, 4> corners(const Quad& q) const;

  /// Not of unit length.
  [[nodiscard]] Vec3 normal(Place p) const;
  /// Of unit length, unless it is zero: weighted by areas.
  [[nodiscard]] Vec3 mean_normal(std::span<const Place> places) const;
  /// Counterclockwise in (u, v), exactly.
  [[nodiscard]] bool are_positive(std::span<const Place> places) const;

  /// False where a triangle would not be counterclockwise, or the new edge exists elsewhere; then nothing is changed.
  bool swap(const Quad& q);
  /// After a swap: all as it was.
  void restore(const Quad& q);
  /// A new vertex amid the edge in (u, v); its position in space is to be set. None where a triangle would not be
  /// counterclockwise; then nothing is changed.
  std::optional<Vertex> divide(const Quad& q);
  /// The vertex made last, of `q`, goes.
  void unite(const Quad& q);

 private:
  [[nodiscard]] std::vector<Place>& fan_of(std::int32_t v) { return fans_[rank_[v]]; }
  [[nodiscard]] bool is_positive(std::int32_t face, const Triangle& t) const;
  template <typename Use>
  void for_triangles(const Use& use) const;
  void mark_curves();
  void collect(std::span<const std::int32_t> centres, int rings);
  void put(Place p, const Triangle& t);

  SurfaceMesh& mesh_;
  std::vector<char> fixed_;
  std::vector<std::array<std::int32_t, 2>> imposed_;  // edges on curves, the smaller vertex first; sorted
  std::vector<std::int32_t> rank_;                    // by vertex: index in fans_, -1: not known
  std::vector<std::vector<Place>> fans_;
};

}  // namespace carreau
