// SPDX-License-Identifier: BSD-3-Clause
// The previous mesh as an atlas of the surface: from a place of one face to a place of a second.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cad/cad.h"
#include "mesh/surface_mesh.h"
#include "support/monitor.h"
#include "surface/remesh/base/tangent_metrics.h"
#include "surface/remesh/base/thresholds.h"
#include "surface/surface_place.h"

namespace carreau {

/// An edge of the mesh in space: the smaller vertex first.
using MeshEdge = std::array<std::int32_t, 2>;
inline MeshEdge mesh_edge(std::int32_t v, std::int32_t w) noexcept { return v < w ? MeshEdge{v, w} : MeshEdge{w, v}; }

/// Triangles of all faces with their (u, v), linked over the edges that may be crossed. Copies its input; safe from
/// several threads.
class Charts {
 public:
  struct Triangle {
    std::int32_t face = 0;
    std::array<std::int32_t, 3> local{}, vertex{};    ///< of the face, and of the mesh
    std::array<std::int32_t, 3> beyond{-1, -1, -1};   ///< triangle over the side from corner i to the next one; -1: none
    std::array<char, 3> same_chart{};                 ///< it goes on with the same (u, v)
    bool turned = false;                              ///< runs against its face, so that neighbours agree
    std::int32_t side = 0;                            ///< first triangle that is connected to it without a barrier between
  };

  /// `barriers`: edges that nothing crosses, ascending. Edges without exactly two triangles are barriers, too. So are edges that prevent a
  /// consistent side of the surface (a Moebius strip); these become `twisted`. `size`: by vertex; `metrics`: sizes by direction, or none.
  Charts(const SurfaceMesh& mesh, std::span<const MeshEdge> barriers, std::span<const double> size,
         PlaneMetrics metrics, Monitor& monitor);

  [[nodiscard]] const std::vector<Triangle>& triangles() const noexcept { return triangles_; }
  [[nodiscard]] const std::vector<MeshEdge>& twisted() const noexcept { return twisted_; }
  /// Triangles on a barrier, with the side that it is.
  struct OnEdge {
    std::int32_t triangle;
    int side;
  };
  [[nodiscard]] std::vector<OnEdge> triangles_on(const MeshEdge& barrier) const;
  [[nodiscard]] std::int32_t face(const Foot& f) const { return triangles_[f.triangle].face; }
  [[nodiscard]] int reference(std::int32_t face) const { return ref_[face]; }
  [[nodiscard]] const Vec3& xyz(std::int32_t vertex) const { return xyz_[vertex]; }
  [[nodiscard]] Vec2 uv(std::int32_t triangle, int corner) const {
    const Triangle& t = triangles_[triangle];
    return uv_[t.face][t.local[corner]];
  }

  /// Guards triangles with a vertex near a place: edits there must not increase distances from the surface.
  void guard(const Vec3& place, double distance);
  [[nodiscard]] bool is_guarded(const Foot& f) const { return guarded_[f.triangle] != 0; }

  /// The size at a place, linear between the sizes of the vertices.
  [[nodiscard]] double size(const Foot& f) const;
  /// Multiplies sizes by factors, by vertex of the previous mesh, in all directions; empty: sizes as prescribed.
  void enlarge(std::vector<double> factor) { factor_ = std::move(factor); }
  /// Returns the largest factors of sizes, by vertex of the previous mesh, that do not exceed `factor` and grow over edges by `growth`
  /// sizes a size.
  [[nodiscard]] std::vector<double> graded_factors(std::vector<double> factor, double growth) const;
  /// Returns whether sizes differ by direction.
  [[nodiscard]] bool by_direction() const noexcept { return !metric_.empty(); }
  /// The metric in the tangent plane there, if they do; `normal`: of the surface, unit, or zero if it has none.
  [[nodiscard]] PlaneMetric metric(const Foot& f, const Vec3& normal) const;
  /// The size at a vertex with several places: the first one's, or by direction the combination of all their planes.
  [[nodiscard]] WantedSize wanted(std::span<const SurfacePlace> places) const;
  /// The surface at a place, by one evaluation.
  [[nodiscard]] SurfacePlace evaluate(Cad& cad, const Foot& f) const;
  /// Barycentric coordinates of a place of its chart, by corner.
  [[nodiscard]] std::array<double, 3> weights(std::int32_t triangle, const Vec2& p) const;
  /// The closest point of `target` on the flat triangles in space, sought from the triangle `from`; empty if a barrier is in the way.
  [[nodiscard]] std::optional<Foot> flat_foot(std::int32_t from, const Vec3& target) const;
  /// A place with derivatives that are known from elsewhere.
  [[nodiscard]] SurfacePlace place(const Foot& f, const SurfaceJet& jet) const;
  /// Returns a place of the surface near `target`. It starts below the closest point on the flat triangles, or from `from`, which is
  /// regular, and takes Gauss-Newton steps. Empty where a barrier or a singular place is in the way; `slides`: on the barrier then, beside
  /// the target. `near`: share of the way that may be left along the surface.
  [[nodiscard]] std::optional<SurfacePlace> towards(Cad& cad, const SurfacePlace& from, const Vec3& target,
                                                    bool slides = false, double near = thresholds::remesh::near_enough) const;

 private:
  struct Walk {
    enum class End { there, border, blocked } end = End::blocked;
    Foot foot;
  };
  /// A side of a triangle on a barrier.
  struct BarrierSide {
    MeshEdge edge;
    OnEdge on;
  };
  void collect(const SurfaceMesh& mesh);
  void link(std::span<const MeshEdge> barriers);
  void link(std::int32_t t, int i, std::int32_t u, int j);
  void turn();
  [[nodiscard]] Walk walk(const Foot& from, const Vec2& to, bool slides) const;
  [[nodiscard]] Foot over(std::int32_t t, int side, const Vec2& at) const;

  std::vector<Triangle> triangles_;
  std::vector<std::vector<Vec2>> uv_;  // by face and local vertex
  std::vector<Vec3> xyz_;              // by vertex of the mesh
  std::vector<double> size_;           // by vertex of the mesh
  PlaneMetrics metric_;                // by face and local vertex; may be empty
  std::vector<double> factor_;         // of sizes, by vertex; may be empty
  std::vector<int> ref_;               // by face
  std::vector<MeshEdge> twisted_;
  std::vector<BarrierSide> barrier_;  // by edge, ascending
  std::vector<char> guarded_;         // by triangle
};

}  // namespace carreau
