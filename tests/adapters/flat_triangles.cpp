// SPDX-License-Identifier: BSD-3-Clause
#include "flat_triangles.h"

#include <algorithm>
#include <cmath>

namespace adapters {
namespace {

using Point = std::array<double, 3>;
using Triangle = std::array<std::int32_t, 3>;

// Features below this share of the size spoil a triangle whatever the mesher does: Q2 of a triangle with sides 1, 1 and
// 1/3 is 0.54, and falls with the share.
constexpr double small_feature = 1.0 / 3;

Point minus(const Point& p, const Point& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
double dot(const Point& p, const Point& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

class Explainer {
 public:
  explicit Explainer(const MeshOnCurves& mesh) : mesh_(mesh), on_some_curve_(mesh.vertices.size(), 0) {
    for (const auto& [a, b] : mesh.sorted_edges)
      on_some_curve_[static_cast<std::size_t>(a)] = on_some_curve_[static_cast<std::size_t>(b)] = 1;
  }

  std::vector<FlatTriangle> run(double limit) {
    std::vector<FlatTriangle> flat;
    for (std::size_t k = 0; k < mesh_.triangles.size(); ++k) {
      const Triangle& t = mesh_.triangles[k];
      const double q2 = q2_of(at(t[0]), at(t[1]), at(t[2]));
      if (q2 < limit) flat.push_back({k, q2, cause_of(t)});
    }
    spread_along_wedges(flat);
    return flat;
  }

 private:
  [[nodiscard]] const Point& at(std::int32_t v) const { return mesh_.vertices[static_cast<std::size_t>(v)]; }
  [[nodiscard]] bool is_corner(std::int32_t v) const { return mesh_.vertex_refs[static_cast<std::size_t>(v)] > 0; }
  [[nodiscard]] bool on_curve(std::int32_t a, std::int32_t b) const {
    return std::binary_search(mesh_.sorted_edges.begin(), mesh_.sorted_edges.end(),
                              std::array{std::min(a, b), std::max(a, b)});
  }
  [[nodiscard]] double length(std::int32_t a, std::int32_t b) const {
    const Point d = minus(at(a), at(b));
    return std::sqrt(dot(d, d));
  }

  [[nodiscard]] FlatCause cause_of(const Triangle& t) const {
    std::array<double, 3> side{};  // opposite to corner i
    for (std::size_t i = 0; i < 3; ++i) side[i] = length(t[(i + 1) % 3], t[(i + 2) % 3]);
    const auto i = static_cast<std::size_t>(std::min_element(side.begin(), side.end()) - side.begin());
    const std::int32_t a = t[(i + 1) % 3], b = t[(i + 2) % 3];
    // The smallest angle lies opposite to the shortest side.
    if (is_corner(t[i]) && on_curve(t[i], a) && on_curve(t[i], b)) return FlatCause::corner_angle;
    if (is_corner(a) && is_corner(b) && on_curve(a, b) && side[i] < small_feature * mesh_.size)
      return FlatCause::short_curve;
    for (std::size_t k = 0; k < 3; ++k)
      if (bridges(t[k], t[(k + 1) % 3], t[(k + 2) % 3])) return FlatCause::narrow_face;
    return FlatCause::none;
  }

  // The apex on one curve, edge (a, b) on another: an ear of one curve, whose edges meet at the apex, is no strip.
  [[nodiscard]] bool bridges(std::int32_t apex, std::int32_t a, std::int32_t b) const {
    if (on_some_curve_[static_cast<std::size_t>(apex)] == 0 || !on_curve(a, b)) return false;
    if (on_curve(apex, a) && on_curve(apex, b)) return false;
    const Point u = minus(at(b), at(a)), w = minus(at(apex), at(a));
    const double squared = dot(u, u), along = std::clamp(dot(u, w) / squared, 0.0, 1.0);
    const Point away{w[0] - along * u[0], w[1] - along * u[1], w[2] - along * u[2]};
    return std::sqrt(dot(away, away)) < small_feature * mesh_.size;
  }

  // A shape forced at a corner is forced farther on between these two curves.
  void spread_along_wedges(std::vector<FlatTriangle>& flat) const {
    for (bool changed = true; changed;) {
      changed = false;
      for (FlatTriangle& f : flat) {
        const Triangle& t = mesh_.triangles[f.triangle];
        if (f.cause != FlatCause::none || !(on_curve(t[0], t[1]) || on_curve(t[1], t[2]) || on_curve(t[2], t[0])))
          continue;
        for (const FlatTriangle& g : flat)
          if (g.cause == FlatCause::corner_angle && share_a_side(t, mesh_.triangles[g.triangle])) {
            f.cause = FlatCause::corner_angle;
            changed = true;
            break;
          }
      }
    }
  }

  static bool share_a_side(const Triangle& p, const Triangle& q) {
    return std::count_if(p.begin(), p.end(),
                         [&](std::int32_t v) { return std::find(q.begin(), q.end(), v) != q.end(); }) == 2;
  }

  const MeshOnCurves& mesh_;
  std::vector<char> on_some_curve_;
};

}  // namespace

double q2_of(const Point& a, const Point& b, const Point& c) {
  const Point u = minus(b, a), v = minus(c, a), w = minus(c, b);
  const double area = std::sqrt(std::max(0.0, dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v))) / 2;
  return 4 * std::sqrt(3.0) * area / (dot(u, u) + dot(v, v) + dot(w, w));
}

std::vector<FlatTriangle> explain_flat_triangles(const MeshOnCurves& mesh, double limit) {
  return Explainer(mesh).run(limit);
}

}  // namespace adapters
