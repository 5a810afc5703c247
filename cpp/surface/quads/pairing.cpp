// SPDX-License-Identifier: BSD-3-Clause
#include "surface/quads/pairing.h"

#include <algorithm>
#include <cmath>

#include "support/incidence.h"
#include "surface/quads/matching.h"
#include "surface/quads/quad_shape.h"
#include "surface/quads/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::quads;

class Pairing {
 public:
  Pairing(QuadPatch& patch, const FaceCharts* charts, const PairRules& rules, Monitor& monitor)
      : patch_(patch), charts_(charts), rules_(rules), monitor_(monitor) {}

  void run() {
    collect();
    const std::vector<std::int32_t> chosen = match(patch_.cells.size(), pairs_, monitor_);
    std::vector<char> gone(patch_.cells.size(), 0);
    for (const std::int32_t e : chosen) {
      const auto [t, u] = pairs_[e].triangles;
      patch_.cells[t] = quads_[e];
      gone[u] = 1;
    }
    std::size_t kept = 0;
    for (std::size_t c = 0; c < gone.size(); ++c)
      if (gone[c] == 0) patch_.cells[kept++] = patch_.cells[c];
    patch_.cells.resize(kept);
  }

 private:
  using Key = std::array<std::int32_t, 3>;  // ends of an edge, ascending, and a triangle

  void collect() {
    std::vector<std::array<std::int32_t, 4>> with_first(patch_.cells);
    for (auto& cell : with_first) cell[3] = cell[0];
    const Incidence around(patch_.uv.size(), with_first);
    int n = 0;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(patch_.cells.size()); ++t) {
      if (++n % searches_between_checks == 0) monitor_.checkpoint();
      for (int k = 0; k < 3; ++k) {
        const std::int32_t a = patch_.cells[t][k], b = patch_.cells[t][(k + 1) % 3];
        if (a < b) continue;
        for (const std::int32_t u : around.of(a))
          if (u != t && add_if_good(t, k, u)) break;
      }
    }
  }

  // Whether u lies beyond side k of t.
  bool add_if_good(std::int32_t t, int k, std::int32_t u) {
    const MixedCell &T = patch_.cells[t], &U = patch_.cells[u];
    const std::int32_t a = T[k], b = T[(k + 1) % 3], c = T[(k + 2) % 3];
    for (int j = 0; j < 3; ++j) {
      if (U[j] != b || U[(j + 1) % 3] != a) continue;
      if (!rules_.is_imposed(a, b)) add(t, u, {a, U[(j + 2) % 3], b, c});
      return true;
    }
    return false;
  }

  void add(std::int32_t t, std::int32_t u, const MixedCell& quad) {
    if (!is_convex(patch_, quad) || has_flat_corner(patch_, quad)) return;
    const std::array<Vec3, 4> p{rules_.position(quad[0]), rules_.position(quad[1]), rules_.position(quad[2]),
                                rules_.position(quad[3])};
    if (!(turn(p) <= rules_.most_turn) || !(scaled_jacobian(p) > rules_.least_jacobian)) return;
    const double quality = charts_ != nullptr ? cell_quality(patch_, *charts_, quad) : quad_quality(p);
    if (quality < least_pair) return;
    pairs_.push_back({{t, u}, pair_bonus + quality});
    quads_.push_back(quad);
  }

  // Angle between the normals of the triangles on both sides of the diagonal from p[0] to p[2].
  static double turn(const std::array<Vec3, 4>& p) {
    const Vec3 diagonal = p[2] - p[0];
    const Vec3 right = cross(p[1] - p[0], diagonal), left = cross(diagonal, p[3] - p[0]);
    return std::atan2(norm(cross(right, left)), dot(right, left));
  }

  QuadPatch& patch_;
  const FaceCharts* charts_;
  const PairRules& rules_;
  Monitor& monitor_;
  std::vector<WeightedPair> pairs_;
  std::vector<MixedCell> quads_;  // of the pairs
};

}  // namespace

void pair_triangles(QuadPatch& patch, const FaceCharts* charts, const PairRules& rules, Monitor& monitor) {
  Pairing(patch, charts, rules, monitor).run();
}

}  // namespace carreau
