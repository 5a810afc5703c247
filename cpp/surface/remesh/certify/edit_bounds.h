// SPDX-License-Identifier: BSD-3-Clause
// Upper bounds of A0 and A1 of single triangles of a cross-patch mesh, and of triangles that edits would make.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "cad/cad.h"
#include "support/infinity.h"
#include "surface/remesh/base/cross_patch_mesh.h"
#include "surface/remesh/bounds/triangle_bound.h"
#include "surface/remesh/cells/cell_placer.h"

namespace carreau {

/// The surface of another Cad, with a count of evaluated places.
class CountedSurface final : public Cad {
 public:
  explicit CountedSurface(Cad& cad) : cad_(cad) {}
  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    places_ += static_cast<std::int64_t>(uv.size());
    cad_.surface(face, want, uv, out);
  }
  Interval curve_interval(int face, int ic) override { return cad_.curve_interval(face, ic); }
  CurveJet curve(int face, int ic, unsigned want, double t) override { return cad_.curve(face, ic, want, t); }
  [[nodiscard]] std::int64_t places() const noexcept { return places_; }

 private:
  Cad& cad_;
  std::int64_t places_ = 0;
};

/// Bounds as measures compute them (measure/bounds): for a triangle of (u, v) over its image, for a triangle with corners in several charts
/// over itself. Keeps a reference to `mesh`.
class EditBounds {
 public:
  explicit EditBounds(const CrossPatchMesh& mesh, Cad& cad) : mesh_(mesh), cad_(cad), placer_(mesh, mesh.charts(), cad_) {}

  /// The larger bound over its tolerance, or a little less than that (thresholds.h, `within`). A triangle without area, or turned over, has
  /// the share of half a turn. About twelve evaluations, and more where it is near 1.
  [[nodiscard]] double share(const EditableMesh::Triangle& t) { return share(t, false, infinity); }
  /// The share of a triangle that an edit would make, with fewer evaluations: it may be larger. If normals at corners show a share above
  /// `most`, that share is returned, without an evaluation.
  [[nodiscard]] double share_roughly(const EditableMesh::Triangle& t, double most) { return share(t, true, most); }
  /// Number of evaluated places of the surface.
  [[nodiscard]] std::int64_t evaluations() const noexcept { return others_ + cad_.places(); }
  /// Adds evaluations of others.
  void count(std::int64_t evaluations) noexcept { others_ += evaluations; }

 private:
  struct Corners {
    std::array<SurfacePlace, 3> place;
    std::array<std::int32_t, 3> vertex;
  };
  [[nodiscard]] double share(const EditableMesh::Triangle& t, bool roughly, double most);
  [[nodiscard]] BoundedTriangle flat(const Corners& corners) const;
  [[nodiscard]] double deviation_tolerance(const Corners& corners) const;
  [[nodiscard]] TriangleBound bound_in_chart(const Corners& corners, std::int32_t face, const BoundedTriangle& flat);
  [[nodiscard]] TriangleBound bound_over_several(const Corners& corners, const BoundedTriangle& flat);

  const CrossPatchMesh& mesh_;
  CountedSurface cad_;
  CellPlacer placer_;
  std::int64_t others_ = 0;
};

}  // namespace carreau
