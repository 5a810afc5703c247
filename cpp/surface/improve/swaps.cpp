// SPDX-License-Identifier: BSD-3-Clause
#include "surface/improve/swaps.h"

#include <algorithm>
#include <optional>

#include "mesh/editable_mesh.h"
#include "mesh/local_search.h"
#include "mesh/shape_levels.h"
#include "support/angles.h"
#include "support/rounding_of.h"
#include "surface/improve/thresholds.h"

namespace carreau {

namespace {


class Swapper {
 public:
  Swapper(const BadRegion& region, EditableMesh& mesh, const std::vector<Vec3>& xyz, std::size_t triangles)
      : region_(region), mesh_(mesh), xyz_(xyz), touched_(triangles, 0) {}

  bool run(Monitor& monitor) {
    const auto list = [this] {
      for (const std::int32_t t : region_.triangles()) touched_[t] = 0;
      return region_.below(shape_level::poor);
    };
    constexpr int max_passes = 100;  // a fan of n triangles in a narrow wedge is undone in n; most patches need three
    return improve_in_passes(max_passes, monitor, list, [this](std::int32_t t) { return improve(t); });
  }

 private:
  using Triangle = EditableMesh::Triangle;
  using Quad = EditableMesh::Quad;

  [[nodiscard]] double quality(const Triangle& t) const { return quality_in_space(t, xyz_); }
  [[nodiscard]] double length(int a, int b) const { return norm(xyz_[a] - xyz_[b]); }

  // Triangles without area agree with all.
  [[nodiscard]] bool leaves(const Triangle& t, const Quad& q) const {
    const auto [first, second] = q.places();
    const Vec3 n = unit_normal_in_space(t, xyz_), p = unit_normal_in_space(mesh_.at(first), xyz_),
               r = unit_normal_in_space(mesh_.at(second), xyz_);
    if (p == Vec3{0, 0, 0} || r == Vec3{0, 0, 0}) return false;
    return std::max(dot(n, p), dot(n, r)) < angles::cosine_of_45;
  }
  // In a narrow strip that winds, far vertices make triangles of a better shape that leave the surface.
  [[nodiscard]] bool is_longest(const Quad& q) const {
    return length(q.c, q.d) >
           std::max({length(q.a, q.b), length(q.b, q.c), length(q.c, q.a), length(q.a, q.d), length(q.d, q.b)});
  }

  // The gain of the worse of the two shapes; 0 if the other diagonal is not allowed.
  [[nodiscard]] double gain(const Quad& q) const {
    if (xyz_[q.c] == xyz_[q.d] || !mesh_.can_swap(q) || is_longest(q)) return 0;
    const auto [first, second] = EditableMesh::swapped(q);
    if (leaves(first, q) || leaves(second, q)) return 0;
    const auto [t, u] = q.places();
    return std::min(quality(first), quality(second)) - std::min(quality(mesh_.at(t)), quality(mesh_.at(u)));
  }

  // Swaps the best of the triangle's three edges. The next pass looks again at triangles that a pass has changed.
  bool improve(std::int32_t t) {
    if (touched_[t] != 0) return false;
    double best = rounding_of::sizes;
    std::optional<Quad> found;
    for (int i = 0; i < 3; ++i) {
      const auto q = mesh_.quad({0, t}, i);
      if (!q || touched_[q->u] != 0) continue;
      if (const double g = gain(*q); g > best) best = g, found = q;
    }
    if (!found || !mesh_.swap(*found)) return false;
    touched_[found->t] = touched_[found->u] = 1;
    return true;
  }

  const BadRegion& region_;
  EditableMesh& mesh_;
  const std::vector<Vec3>& xyz_;
  std::vector<char> touched_;  // by triangle, in this pass
};

}  // namespace

bool swap_in_space(const BadRegion& region, const PlaneDomain& domain, PlaneMesh& mesh, std::vector<Vec3>& xyz,
                   Monitor& monitor) {
  if (region.below(shape_level::poor).empty()) return false;
  EditableMesh editable(domain, mesh, xyz, region.triangles());
  return Swapper(region, editable, xyz, mesh.triangles.size()).run(monitor);
}

}  // namespace carreau
