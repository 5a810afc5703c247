// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/base/charts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>

#include "cad/fundamental_forms.h"
#include "model/triangle_sides.h"
#include "support/incidence.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "surface/remesh/base/thresholds.h"

namespace carreau {

using namespace thresholds::remesh;

Charts::Charts(const SurfaceMesh& mesh, std::span<const MeshEdge> barriers, std::span<const double> size,
               PlaneMetrics metrics, Monitor& monitor)
    : xyz_(mesh.vertices), size_(size.begin(), size.end()), metric_(std::move(metrics)) {
  collect(mesh);
  guarded_.assign(triangles_.size(), 0);
  monitor.checkpoint();
  link(barriers);
  monitor.checkpoint();
  turn();
}

void Charts::collect(const SurfaceMesh& mesh) {
  triangles_.reserve(mesh.triangle_count());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceMesh& face = mesh.faces[f];
    uv_.push_back(face.uv);
    ref_.push_back(face.ref);
    for (const auto& t : face.triangles)
      triangles_.push_back({.face = static_cast<std::int32_t>(f),
                            .local = t,
                            .vertex = {face.vertex[t[0]], face.vertex[t[1]], face.vertex[t[2]]}});
  }
}

void Charts::link(std::span<const MeshEdge> barriers) {
  const auto sides = sides_of_triangles(triangles_.size(), xyz_.size(), [&](std::size_t t, std::size_t i) { return triangles_[t].vertex[i]; });
  for_edges(sides, [&](std::span<const TriangleSide> of_edge) {
    if (of_edge.size() == 2 && !std::ranges::binary_search(barriers, of_edge[0].edge))
      link(of_edge[0].triangle, of_edge[0].rank, of_edge[1].triangle, of_edge[1].rank);
    else
      for (const TriangleSide& side : of_edge) barrier_.push_back({side.edge, {side.triangle, side.rank}});
  });
}

std::vector<Charts::OnEdge> Charts::triangles_on(const MeshEdge& barrier) const {
  std::vector<OnEdge> found;
  const auto last = std::ranges::upper_bound(barrier_, barrier, {}, &BarrierSide::edge);  // Clang 14 takes no equal_range
  for (auto side = std::ranges::lower_bound(barrier_, barrier, {}, &BarrierSide::edge); side != last; ++side)
    found.push_back(side->on);
  return found;
}

void Charts::link(std::int32_t t, int i, std::int32_t u, int j) {
  Triangle &p = triangles_[t], &q = triangles_[u];
  const bool same = p.face == q.face && p.local[i] == q.local[(j + 1) % 3] && p.local[(i + 1) % 3] == q.local[j];
  p.beyond[i] = u, q.beyond[j] = t;
  p.same_chart[i] = q.same_chart[j] = static_cast<char>(same);
}

// Neighbours run along their edge in opposite ways, or in one way if a face is turned the other way round.
void Charts::turn() {
  std::vector<char> known(triangles_.size(), 0);
  std::vector<std::int32_t> todo;
  for (std::size_t first = 0; first < triangles_.size(); ++first) {
    if (known[first] != 0) continue;
    known[first] = 1;
    triangles_[first].side = static_cast<std::int32_t>(first);
    todo.push_back(static_cast<std::int32_t>(first));
    while (!todo.empty()) {
      const std::int32_t t = todo.back();
      todo.pop_back();
      for (int i = 0; i < 3; ++i) {
        const std::int32_t u = triangles_[t].beyond[i];
        if (u < 0) continue;
        const auto& other = triangles_[u].vertex;
        const auto from = std::ranges::find(other, triangles_[t].vertex[i]) - other.begin();
        const bool same_way = other[(from + 1) % 3] == triangles_[t].vertex[(i + 1) % 3];
        const bool turned = triangles_[t].turned != same_way;
        if (known[u] == 0) {
          known[u] = 1;
          triangles_[u].turned = turned;
          triangles_[u].side = static_cast<std::int32_t>(first);
          todo.push_back(u);
        } else if (triangles_[u].turned != turned) {
          twisted_.push_back(mesh_edge(triangles_[t].vertex[i], triangles_[t].vertex[(i + 1) % 3]));
        }
      }
    }
  }
  std::ranges::sort(twisted_);
  twisted_.erase(std::unique(twisted_.begin(), twisted_.end()), twisted_.end());
}

std::array<double, 3> Charts::weights(std::int32_t triangle, const Vec2& p) const {
  const Vec2 a = uv(triangle, 0), b = uv(triangle, 1), c = uv(triangle, 2);
  const double area = cross(b - a, c - a);
  const double wb = cross(p - a, c - a) / area, wc = cross(b - a, p - a) / area;
  return {1 - wb - wc, wb, wc};
}

void Charts::guard(const Vec3& place, double distance) {
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (const std::int32_t v : triangles_[t].vertex)
      if (norm(xyz_[v] - place) <= distance) guarded_[t] = 1;
}

double Charts::size(const Foot& f) const {
  std::array<double, 3> w = weights(f.triangle, f.uv);
  double sum = 0, size = 0;
  for (int i = 0; i < 3; ++i) {
    w[i] = std::max(w[i], 0.0);
    sum += w[i];
    const std::int32_t v = triangles_[f.triangle].vertex[i];
    size += w[i] * (factor_.empty() ? size_[v] : factor_[v] * size_[v]);
  }
  return size / sum;
}

PlaneMetric Charts::metric(const Foot& f, const Vec3& normal) const {
  const Triangle& t = triangles_[f.triangle];
  std::array<double, 3> w = weights(f.triangle, f.uv);
  double sum = 0;
  for (double& each : w) sum += each = std::max(each, 0.0);
  std::array<const PlaneMetric*, 3> corners{};
  int nearest = 0;
  for (int i = 0; i < 3; ++i) {
    corners[i] = &metric_[t.face][t.local[i]];
    if (w[i] > w[nearest]) nearest = i;
    w[i] /= sum;
  }
  PlaneMetric wanted = dot(normal, normal) > 0 ? interpolate(corners, w, normal) : *corners[nearest];
  if (!factor_.empty()) {
    double factor = 0;
    for (int i = 0; i < 3; ++i) factor += w[i] * factor_[t.vertex[i]];
    const double k = 1 / (factor * factor);
    for (double* m : {&wanted.metric.xx, &wanted.metric.xy, &wanted.metric.xz, &wanted.metric.yy, &wanted.metric.yz,
                      &wanted.metric.zz})
      *m *= k;
  }
  return wanted;
}

WantedSize Charts::wanted(std::span<const SurfacePlace> places) const {
  if (!by_direction()) return {size(places.front().foot), {}};
  std::vector<PlaneMetric> planes;
  for (const SurfacePlace& p : places) planes.push_back(metric(p.foot, p.normal));
  WantedSize wanted{infinity, where_planes_meet(planes)};
  for (const PlaneMetric& m : planes) wanted.h = std::min(wanted.h, mean_size(m));
  return wanted;
}

// The shortest way over edges, in sizes.
std::vector<double> Charts::graded_factors(std::vector<double> factor, double growth) const {
  std::vector<std::array<std::int32_t, 3>> sets;
  sets.reserve(triangles_.size());
  for (const Triangle& t : triangles_) sets.push_back(t.vertex);
  const Incidence around(xyz_.size(), sets);
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const double most = factor.empty() ? 0 : *std::ranges::max_element(factor);
  for (std::size_t v = 0; v < factor.size(); ++v)
    if (factor[v] < most) queue.emplace(factor[v], static_cast<std::int32_t>(v));
  while (!queue.empty()) {
    const auto [known, v] = queue.top();
    queue.pop();
    if (known > factor[v]) continue;
    for (const std::int32_t t : around.of(v))
      for (const std::int32_t w : sets[t]) {
        const double way = norm(xyz_[w] - xyz_[v]) / (0.5 * (size_[v] + size_[w]));
        if (const double grown = known + growth * way; grown < factor[w]) queue.emplace(factor[w] = grown, w);
      }
  }
  return factor;
}

SurfacePlace Charts::place(const Foot& f, const SurfaceJet& jet) const {
  SurfacePlace place{.foot = f, .xyz = jet.s, .su = jet.su, .sv = jet.sv, .normal = {}, .regular = false};
  if (const auto normal = unit_normal(jet)) {
    place.normal = (triangles_[f.triangle].turned ? -1.0 : 1.0) * *normal;
    place.regular = true;
  }
  return place;
}

SurfacePlace Charts::evaluate(Cad& cad, const Foot& f) const {
  return place(f, surface_at(cad, ref_[triangles_[f.triangle].face], want_position | want_first, f.uv));
}

// Returns the point of the edge in the chart on its other side.
Foot Charts::over(std::int32_t t, int side, const Vec2& at) const {
  const Triangle& here = triangles_[t];
  const std::int32_t next = here.beyond[side];
  const Vec2 p = uv(t, side), along = uv(t, (side + 1) % 3) - p;
  const double s = std::clamp(dot(at - p, along) / dot(along, along), 0.0, 1.0);
  Vec2 from, to;
  for (int k = 0; k < 3; ++k) {
    if (triangles_[next].vertex[k] == here.vertex[side]) from = uv(next, k);
    if (triangles_[next].vertex[k] == here.vertex[(side + 1) % 3]) to = uv(next, k);
  }
  return {next, lerp(from, to, s)};
}

// Walks along the straight line, out of each triangle by the first side that it meets.
Charts::Walk Charts::walk(const Foot& from, const Vec2& to, bool slides) const {
  std::int32_t t = from.triangle;
  for (int step = 0; step < max_steps; ++step) {
    const std::array<double, 3> start = weights(t, from.uv), end = weights(t, to);
    int side = -1;
    double way = infinity;
    for (int i = 0; i < 3; ++i) {
      const int opposite = (i + 2) % 3;
      if (!(end[opposite] < -rounding_of::places)) continue;
      const double p = std::max(start[opposite], 0.0), share = p / (p - end[opposite]);
      if (share < way) way = share, side = i;
    }
    if (side < 0) return {Walk::End::there, {t, to}};
    if (triangles_[t].beyond[side] < 0) {
      if (!slides) return {};
      const Vec2 p = uv(t, side), along = uv(t, (side + 1) % 3) - p;
      return {Walk::End::there, {t, p + std::clamp(dot(to - p, along) / dot(along, along), 0.0, 1.0) * along}};
    }
    if (triangles_[t].same_chart[side] == 0) return {Walk::End::border, over(t, side, lerp(from.uv, to, way))};
    t = triangles_[t].beyond[side];
  }
  return {};
}

// Walks through the flat triangles in space, without an evaluation; empty if a barrier is in the way.
std::optional<Foot> Charts::flat_foot(std::int32_t from, const Vec3& target) const {
  std::int32_t t = from, before = -1;
  for (int step = 0; step < max_steps; ++step) {
    const Triangle& here = triangles_[t];
    const Vec3& a = xyz_[here.vertex[0]];
    const Vec3 p = xyz_[here.vertex[1]] - a, q = xyz_[here.vertex[2]] - a, d = target - a;
    const double pp = dot(p, p), pq = dot(p, q), qq = dot(q, q), dp = dot(d, p), dq = dot(d, q);
    const double det = pp * qq - pq * pq;
    if (!(det > 0)) return {};
    std::array<double, 3> w{0, (qq * dp - pq * dq) / det, (pp * dq - pq * dp) / det};
    w[0] = 1 - w[1] - w[2];
    const int least = w[0] <= w[1] && w[0] <= w[2] ? 0 : w[1] <= w[2] ? 1 : 2;
    const std::int32_t next = here.beyond[(least + 1) % 3];
    if (w[least] >= -rounding_of::places || (next == before && next >= 0)) {  // a fold whose two sides both end before it: on the edge
      double sum = 0;
      for (double& each : w) sum += each = std::max(each, 0.0);
      const auto& uv = uv_[here.face];
      return Foot{t, (w[0] / sum) * uv[here.local[0]] + (w[1] / sum) * uv[here.local[1]] + (w[2] / sum) * uv[here.local[2]]};
    }
    if (next < 0) return {};
    before = t, t = next;
  }
  return {};
}

// Newton's method on first derivatives: where the surface bends within its distance from the target, each step leaves a
// share of the way along the surface. Relaxation by Aitken removes that share, by the two last ways that were left.
std::optional<SurfacePlace> Charts::towards(Cad& cad, const SurfacePlace& from, const Vec3& target,
                                            bool slides, double near) const {
  SurfacePlace at = from;
  const double enough = near * norm(target - from.xyz);
  const auto left_along = [&] {
    const Vec3 left = target - at.xyz;
    return Vec3(left - dot(left, at.normal) * at.normal);
  };
  if (const auto foot = flat_foot(from.foot.triangle, target)) {
    at = evaluate(cad, *foot);
    if (at.regular && norm(left_along()) <= enough) return at;
    if (!at.regular) at = from;
  }
  Vec3 before = Vec3::Zero();
  double relaxation = 1;
  bool relaxes = false;
  for (int step = 0; step < max_newton_steps; ++step) {
    if (!at.regular) return {};
    const Vec3 d = target - at.xyz, left = left_along();
    if (relaxes) {
      const Vec3 gone = before - left;
      const double next = relaxation * dot(before, gone) / dot(gone, gone);
      relaxation = next > 1 ? std::min(next, max_relaxation) : 1;
    }
    const double e = dot(at.su, at.su), f = dot(at.su, at.sv), g = dot(at.sv, at.sv), det = e * g - f * f;
    const double p = dot(at.su, d), q = dot(at.sv, d);
    const Vec2 way{relaxation * (g * p - f * q) / det, relaxation * (e * q - f * p) / det};
    if (!is_finite(way)) return {};
    const Walk walked = walk(at.foot, at.foot.uv + way, slides);
    if (walked.end == Walk::End::blocked) return {};
    const Vec3 old = at.xyz;
    at = evaluate(cad, walked.foot);
    if (walked.end == Walk::End::border) {
      relaxes = false, relaxation = 1;
      continue;
    }
    // A place that slides along a barrier stops beside the target.
    if (norm(left_along()) <= enough || norm(at.xyz - old) <= enough) break;
    before = left, relaxes = true;
  }
  return at.regular ? std::optional(at) : std::nullopt;
}

}  // namespace carreau
