// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/quads/passes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/work_sizes.h"
#include "surface/elements/quads/matching.h"
#include "surface/elements/quads/quad_shape.h"
#include "surface/elements/quads/space_quads.h"
#include "surface/elements/quads/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::quads;

/// Quality of a quadrilateral; 0 if it is not allowed.
template <typename Quality>
class Pairing {
 public:
  Pairing(std::vector<MixedCell>& cells, std::size_t vertices, const Quality& quality, const PairRules& rules,
          Monitor& monitor)
      : cells_(cells), vertices_(vertices), quality_(quality), rules_(rules), monitor_(monitor) {}

  void run() {
    collect();
    const std::vector<std::int32_t> chosen = match(cells_.size(), pairs_, monitor_);
    std::vector<char> gone(cells_.size(), 0);
    for (const std::int32_t e : chosen) {
      const auto [t, u] = pairs_[e].triangles;
      cells_[t] = quads_[e];
      gone[u] = 1;
    }
    std::size_t kept = 0;
    for (std::size_t c = 0; c < gone.size(); ++c)
      if (gone[c] == 0) cells_[kept++] = cells_[c];
    cells_.resize(kept);
  }

 private:
  using Key = std::array<std::int32_t, 3>;  // ends of an edge, ascending, and a triangle

  void collect() {
    const Incidence around = cells_around(vertices_, cells_);
    int n = 0;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(cells_.size()); ++t) {
      if (++n % work_sizes::searches == 0) monitor_.checkpoint();
      for (int k = 0; k < 3; ++k) {
        const std::int32_t a = cells_[t][k], b = cells_[t][(k + 1) % 3];
        if (a < b) continue;
        for (const std::int32_t u : around.of(a))
          if (u != t && add_if_good(t, k, u)) break;
      }
    }
  }

  // Adds the pair if it is good enough. Returns whether u lies beyond side k of t.
  bool add_if_good(std::int32_t t, int k, std::int32_t u) {
    const MixedCell &T = cells_[t], &U = cells_[u];
    const std::int32_t a = T[k], b = T[(k + 1) % 3], c = T[(k + 2) % 3];
    for (int j = 0; j < 3; ++j) {
      if (U[j] != b || U[(j + 1) % 3] != a) continue;
      if (!rules_.is_imposed(a, b)) add(t, u, {a, U[(j + 2) % 3], b, c});
      return true;
    }
    return false;
  }

  void add(std::int32_t t, std::int32_t u, const MixedCell& quad) {
    const double quality = quality_(quad);
    if (quality < min_pair) return;
    const std::array<Vec3, 4> p{rules_.position(quad[0]), rules_.position(quad[1]), rules_.position(quad[2]),
                                rules_.position(quad[3])};
    if (turns_too_much(p) || !(scaled_jacobian(p) > rules_.least_jacobian)) return;
    pairs_.push_back({{t, u}, pair_bonus + quality});
    quads_.push_back(quad);
  }

  // Measures the angle between the normals of the triangles on both sides of the diagonal from p[0] to p[2].
  [[nodiscard]] bool turns_too_much(const std::array<Vec3, 4>& p) const {
    const Vec3 diagonal = p[2] - p[0];
    const Vec3 right = cross(p[1] - p[0], diagonal), left = cross(diagonal, p[3] - p[0]);
    const double along = dot(right, left), across = norm(cross(right, left));
    if (along > 0 && across < 0.99 * std::min(rules_.max_turn, 1.) * along) return false;  // an arc is shorter than its tangent
    return !(std::atan2(across, along) <= rules_.max_turn);
  }

  std::vector<MixedCell>& cells_;
  std::size_t vertices_;
  const Quality& quality_;
  const PairRules& rules_;
  Monitor& monitor_;
  std::vector<WeightedPair> pairs_;
  std::vector<MixedCell> quads_;  // of the pairs
};

// The corner whose sides go on smoothly into each other; -1: none.
template <typename Quads>
int flat_corner(const Quads& quads, const MixedCell& t) {
  if (!quads.is_fixed(t[0]) || !quads.is_fixed(t[1]) || !quads.is_fixed(t[2])) return -1;  // corners on curves are
  for (int k = 0; k < 3; ++k)
    if (std::ranges::binary_search(quads.flat(), std::array{t[k], t[(k + 1) % 3], t[(k + 2) % 3]})) return k;
  return -1;
}

// The vertex of a triangle beyond its side from a to b; -1: it has no such side.
std::int32_t apex(const MixedCell& t, std::int32_t a, std::int32_t b) {
  for (int k = 0; k < 3; ++k)
    if (t[k] == a && t[(k + 1) % 3] == b) return t[(k + 2) % 3];
  return -1;
}

template <typename Quads>
bool turn_ear(Quads& quads, const ImposedEdges& is_imposed, MixedCell& ear, int corner) {
  const std::int32_t v = ear[corner], a = ear[(corner + 1) % 3], b = ear[(corner + 2) % 3];
  if (is_imposed(a, b)) return false;
  for (MixedCell& other : quads.cells()) {
    const std::int32_t c = apex(other, b, a);
    if (c < 0) continue;
    const MixedCell left{v, a, c, -1}, right{v, c, b, -1};
    if (!quads.is_convex(left) || !quads.is_convex(right)) return false;
    ear = left, other = right;
    return true;
  }
  return false;
}

}  // namespace

PairRules pair_rules(const CompositeOptions& options, bool isotropic, ImposedEdges is_imposed, std::function<Vec3(std::int32_t)> position) {
  const double turn = turns_per_edge * options.size.angle_mesh * std::numbers::pi / 180;
  return {std::move(is_imposed), std::move(position), turn * (has_quads_only(options.element) ? 2 : 1), isotropic ? least_jacobian : 0};
}

template <typename Quads>
void pair_triangles(Quads& quads, const PairRules& rules, Monitor& monitor) {
  const auto quality = [&](const MixedCell& quad) -> double {
    if (!quads.is_convex(quad) || quads.has_flat_corner(quad)) return 0;
    if (quads.has_metric()) return quads.quality(quad);
    return quad_quality(std::array<Vec3, 4>{rules.position(quad[0]), rules.position(quad[1]), rules.position(quad[2]),
                                            rules.position(quad[3])});
  };
  Pairing(quads.cells(), quads.vertices(), quality, rules, monitor).run();
}
template void pair_triangles<PlaneQuads>(PlaneQuads&, const PairRules&, Monitor&);
template void pair_triangles<SpaceQuads>(SpaceQuads&, const PairRules&, Monitor&);

template <typename Quads>
std::size_t turn_ears(Quads& quads, const ImposedEdges& is_imposed) {
  std::size_t count = 0;
  if (quads.flat().empty()) return count;
  for (MixedCell& cell : quads.cells())
    if (const int k = flat_corner(quads, cell); k >= 0 && turn_ear(quads, is_imposed, cell, k)) ++count;
  return count;
}
template std::size_t turn_ears<PlaneQuads>(PlaneQuads&, const ImposedEdges&);
template std::size_t turn_ears<SpaceQuads>(SpaceQuads&, const ImposedEdges&);

}  // namespace carreau
