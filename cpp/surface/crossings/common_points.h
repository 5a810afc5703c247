// SPDX-License-Identifier: BSD-3-Clause
// Where two faces cross in the geometry itself, seen from triangles of them that cross. Private to surface/.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cad/cad.h"
#include "cad/fundamental_forms.h"
#include "mesh/surface_mesh.h"
#include "support/vec.h"

namespace carreau {

/// A triangle with its place in the parameter plane.
struct PatchTriangle {
  PatchTriangle(const SurfaceMesh& mesh, int face, int local) {
    const FaceMesh& of = mesh.faces[static_cast<std::size_t>(face)];
    const std::array<std::int32_t, 3>& t = of.triangles[static_cast<std::size_t>(local)];
    ref = of.ref;
    for (std::size_t k = 0; k < 3; ++k) xyz[k] = mesh.vertices[of.vertex[t[k]]], uv[k] = of.uv[t[k]];
    const Vec3 ab = xyz[1] - xyz[0], ac = xyz[2] - xyz[0];
    longest = std::max({norm(ab), norm(ac), norm(ac - ab)});
  }
  [[nodiscard]] Vec2 uv_of(const Vec3& place) const {
    const Vec3 ab = xyz[1] - xyz[0], ac = xyz[2] - xyz[0], n = cross(ab, ac), ap = place - xyz[0];
    const double n2 = dot(n, n), s = dot(cross(ap, ac), n) / n2, t = dot(cross(ab, ap), n) / n2;
    return (1 - s - t) * uv[0] + s * uv[1] + t * uv[2];
  }
  /// Of the plane triangle.
  [[nodiscard]] bool holds(const Vec2& p) const {
    const double all = cross(uv[1] - uv[0], uv[2] - uv[0]);
    for (std::size_t k = 0; k < 3; ++k)
      if (!(cross(uv[(k + 1) % 3] - uv[k], p - uv[k]) * all >= 0)) return false;
    return true;
  }

  int ref = 0;
  std::array<Vec3, 3> xyz;
  std::array<Vec2, 3> uv;
  double longest = 0;  ///< edge
};

/// A place of a surface.
struct OnSurface {
  OnSurface(Cad& cad, const PatchTriangle& triangle, const Vec2& at)
      : uv(at), jet(surface_at(cad, triangle.ref, want_position | want_first, at)) {
    normal = unit_normal(jet).value_or(Vec3{});
  }
  /// Parameters of the point of the tangent plane that is nearest to x.
  [[nodiscard]] Vec2 towards(const Vec3& x) const {
    const FirstForm form = first_form(jet);
    const double a = dot(x - jet.s, jet.su), b = dot(x - jet.s, jet.sv), det = form.e * form.g - form.f * form.f;
    return uv + Vec2{(form.g * a - form.f * b) / det, (form.e * b - form.f * a) / det};
  }

  Vec2 uv;
  SurfaceJet jet;
  Vec3 normal;  ///< unit; zero at singular points
};

/// Points of two faces, which are not the same. Throws what the host throws.
class CommonPoints {
 public:
  CommonPoints(const SurfaceMesh& mesh, int face, int other);
  /// Keeps the point that the surfaces have in common over both triangles, which cross at `place`, if they have one:
  /// from tangent planes to the nearest point of the line that both have, and again (Newton's method). They are asked
  /// over the triangles only. None is kept within an edge of a vertex of both faces: along a curve they meet without
  /// crossing.
  void look(Cad& cad, const PatchTriangle& s, const PatchTriangle& t, const Vec3& place);
  /// Whether a point was found so near; after the last look().
  [[nodiscard]] bool any_near(const Vec3& place, double distance);

 private:
  std::vector<Vec3> points_;  // by x when sorted_
  bool sorted_ = false;
  std::vector<Vec3> shared_;  // vertices of both faces
};

}  // namespace carreau
