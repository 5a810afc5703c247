// SPDX-License-Identifier: BSD-3-Clause
// The piece of a face over one triangle of its mesh. Private to pipeline/.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "cad/cad.h"
#include "curve/discrete_curve.h"
#include "mesh/surface_mesh.h"
#include "support/vec.h"

namespace carreau {

/// A segment of a discretised curve.
struct SegmentOfCurve {
  int curve = 0, segment = 0;
};

/// The edges of a mesh that lie on curves, by their two vertices.
class CurveEdges {
 public:
  /// Leaves out curves whose vertices have changed since `curves` were cut.
  CurveEdges(const SurfaceMesh& mesh, const std::vector<DiscreteCurve>& curves);
  /// Null: the edge lies on no curve.
  [[nodiscard]] const SegmentOfCurve* find(std::int32_t v, std::int32_t w) const;

 private:
  std::unordered_map<std::uint64_t, SegmentOfCurve> segments_;
};

/// A point of a face over a triangle.
struct OnFace {
  Vec2 at;  ///< in the plane of the triangle, model length
  SurfaceJet jet;
  Vec3 normal;  ///< unit; zero at singular points
};

/// A triangle and the piece of the face over it. Sides on curves follow their curves, because a chord may leave the
/// face: across a hole, a triangle has no face over it. Positions in the plane of the triangle are orthonormal, in
/// model length.
class FaceTriangle {
 public:
  /// Evaluates the curves of its sides at a few points, and the face at one. Throws the host's exceptions.
  FaceTriangle(const SurfaceMesh& mesh, int face, int local, const CurveEdges& edges,
               const std::vector<DiscreteCurve>& curves, const CurveModel& model);

  /// False for triangles without area in space or in (u, v): they have no piece.
  [[nodiscard]] bool is_sound() const noexcept { return sound_; }
  [[nodiscard]] double longest_edge() const noexcept { return longest_; }
  /// Distance between the centroid and the face there.
  [[nodiscard]] double sagitta() const noexcept { return sagitta_; }
  /// The position of the piece's point nearest to a position.
  [[nodiscard]] Vec2 nearest(const Vec2& at) const;
  [[nodiscard]] Vec2 position_of(const Vec3& point) const {
    return {dot(point - origin_, e1_), dot(point - origin_, e2_)};
  }
  /// The face's point at a position. Throws the host's exceptions.
  [[nodiscard]] OnFace evaluate(Cad& cad, const Vec2& at) const;
  /// The position of the point of p's tangent plane that is nearest to x.
  [[nodiscard]] Vec2 project(const OnFace& p, const Vec3& x) const;

 private:
  [[nodiscard]] bool holds(const Vec2& at) const noexcept;
  void add_side(const SurfaceMesh& mesh, int face, std::size_t side, const SegmentOfCurve& segment,
                const std::vector<DiscreteCurve>& curves, const CurveModel& model);

  int ref_ = 0;
  bool sound_ = false;
  double longest_ = 0, sagitta_ = 0;
  Vec3 origin_, e1_, e2_;
  std::array<Vec2, 3> uv_, corner_;  // in (u, v) and in the plane
  std::vector<Vec2> outline_;        // of the piece, in the plane
};

}  // namespace carreau
