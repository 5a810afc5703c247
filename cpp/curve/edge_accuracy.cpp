// SPDX-License-Identifier: BSD-3-Clause
#include "curve/edge_accuracy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace carreau {

namespace {

// If the curve has a kink at a vertex, the tangent belongs to the arc beside it.
constexpr double beside = 1e-6;
constexpr std::array<double, 9> shares{beside, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1 - beside};

/// A straight edge, or the parabola through its three nodes.
struct EdgeMap {
  std::span<const Vec3> nodes;

  [[nodiscard]] Vec3 bow() const { return nodes.size() == 3 ? Vec3(4 * nodes[2] - 2 * (nodes[0] + nodes[1])) : Vec3(0, 0, 0); }
  [[nodiscard]] Vec3 at(double s) const { return lerp(nodes[0], nodes[1], s) + s * (1 - s) * bow(); }
  [[nodiscard]] Vec3 slope(double s) const { return nodes[1] - nodes[0] + (1 - 2 * s) * bow(); }
  /// The place nearest to a point: Gauss-Newton steps from `s`, one of which is exact on a straight edge.
  [[nodiscard]] double nearest(const Vec3& point, double s) const {
    for (int step = 0; step < (nodes.size() == 3 ? 4 : 1); ++step) {
      const Vec3 along = slope(s);
      if (!(dot(along, along) > 0)) break;
      s = std::clamp(s + dot(point - at(s), along) / dot(along, along), 0.0, 1.0);
    }
    return s;
  }
};

}  // namespace

EdgeAccuracy edge_accuracy(Cad& cad, int face, int ic, double t0, double t1, std::span<const Vec3> nodes) {
  std::array<Vec2, shares.size()> uv;
  std::array<Vec2, shares.size()> tangent;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const CurveJet jet = cad.curve(face, ic, want_position | want_first, std::lerp(t0, t1, shares[k]));
    uv[k] = jet.c, tangent[k] = t1 < t0 ? Vec2(-jet.ct) : jet.ct;
  }
  std::array<SurfaceJet, shares.size()> jets;
  cad.surface(face, want_position | want_first, uv, jets);
  const EdgeMap edge{nodes};
  EdgeAccuracy accuracy;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double s = edge.nearest(jets[k].s, shares[k]);
    if (k > 0 && k + 1 < shares.size())
      accuracy.deviation = std::max(accuracy.deviation, norm(jets[k].s - edge.at(s)));
    const Vec3 along = tangent[k].x() * jets[k].su + tangent[k].y() * jets[k].sv, own = edge.slope(s);
    if (!(dot(along, along) > 0)) continue;  // singular
    const double angle = std::atan2(norm(cross(along, own)), dot(along, own)) * 180 / std::numbers::pi;
    accuracy.angle_deg = std::max(accuracy.angle_deg, angle);
  }
  return accuracy;
}

}  // namespace carreau
