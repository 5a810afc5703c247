// SPDX-License-Identifier: BSD-3-Clause
#include "surface/crossings/common_points.h"

#include <iterator>

#include "surface/thresholds.h"

namespace carreau {

CommonPoints::CommonPoints(const SurfaceMesh& mesh, int face, int other) {
  const auto sorted = [&](int f) {
    const auto& of = mesh.faces[static_cast<std::size_t>(f)].vertex;
    std::vector<std::int32_t> all(of.begin(), of.end());
    std::sort(all.begin(), all.end());
    return all;
  };
  const std::vector<std::int32_t> a = sorted(face), b = sorted(other);
  std::vector<std::int32_t> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  for (const std::int32_t v : both) shared_.push_back(mesh.vertices[v]);
}

void CommonPoints::look(Cad& cad, const PatchTriangle& s, const PatchTriangle& t, const Vec3& place) {
  using namespace thresholds::crossings;
  const double longest = std::max(s.longest, t.longest);
  const double near = meets_within * longest;
  OnSurface p(cad, s, s.uv_of(place)), q(cad, t, t.uv_of(place));
  for (int step = 0; step < newton_steps; ++step) {
    const Vec3 middle = 0.5 * (p.jet.s + q.jet.s);
    if (norm(p.jet.s - q.jet.s) <= near) {
      const auto beside = [&](const Vec3& v) { return norm(v - middle) <= longest; };
      if (std::any_of(shared_.begin(), shared_.end(), beside)) return;
      points_.push_back(middle);
      sorted_ = false;
      return;
    }
    const Vec3 line = cross(p.normal, q.normal);
    const double c = dot(p.normal, q.normal), det = dot(line, line);
    if (!(det > least_slope * least_slope)) return;
    const double a = dot(p.normal, p.jet.s - middle), b = dot(q.normal, q.jet.s - middle);
    const Vec3 x = middle + ((a - c * b) / det) * p.normal + ((b - c * a) / det) * q.normal;
    const Vec2 on_s = p.towards(x), on_t = q.towards(x);
    if (!s.holds(on_s) || !t.holds(on_t)) return;
    p = {cad, s, on_s}, q = {cad, t, on_t};
  }
}

bool CommonPoints::any_near(const Vec3& place, double distance) {
  if (!sorted_) std::sort(points_.begin(), points_.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
  sorted_ = true;
  const auto first =
      std::partition_point(points_.begin(), points_.end(), [&](const Vec3& p) { return p.x() < place.x() - distance; });
  for (auto p = first; p != points_.end() && p->x() <= place.x() + distance; ++p)
    if (norm(*p - place) <= distance) return true;
  return false;
}

}  // namespace carreau
