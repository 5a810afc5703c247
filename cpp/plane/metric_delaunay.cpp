#include "plane/metric_delaunay.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace carreau::plane {

namespace {

constexpr int swaps_between_checks = 4096;
// A swap must gain this much, so that rounding cannot make it worth while in both directions.
constexpr double least_gain = 1 + 1e-9;
// Units: longer than any edge that points a unit apart leave.
constexpr double long_edge = 3;

// The largest cotangent of an angle, that of the smallest one, which lies between the two longest sides.
double sharpness(const Triangulation& mesh, int p, int q, int r) noexcept {
  const Vertex &P = mesh.vertices[p], &Q = mesh.vertices[q], &R = mesh.vertices[r];
  const Metric2 m = P.metric() + Q.metric() + R.metric();
  const Vec2 pq = Q.point() - P.point(), qr = R.point() - Q.point(), rp = P.point() - R.point();
  const double at_p = -dot(m, pq, rp), at_q = -dot(m, qr, pq), at_r = -dot(m, rp, qr);
  return std::max({at_p, at_q, at_r}) / (std::sqrt(std::max(determinant(m), 1e-300)) * cross(pq, -1.0 * rp));
}

bool wants_swap(const Triangulation& mesh, int t, int i) noexcept {
  const Triangle& A = mesh.triangles[t];
  if (A.n[i] == no_edge || mesh.is_imposed(t, i)) return false;
  const int c = A.v[i], a = A.v[next3[i]], b = A.v[prev3[i]], d = mesh.triangles[A.n[i] >> 2].v[A.n[i] & 3];
  if (!mesh.can_swap(t, i)) return false;
  const double now = std::max(sharpness(mesh, c, a, b), sharpness(mesh, d, b, a));
  const double then = std::max(sharpness(mesh, c, a, d), sharpness(mesh, c, d, b));
  return then * least_gain < now;
}

double squared_length(const Triangulation& mesh, int p, int q) noexcept {
  const Vertex &P = mesh.vertices[p], &Q = mesh.vertices[q];
  return dot(0.5 * (P.metric() + Q.metric()), Q.point() - P.point(), Q.point() - P.point());
}

bool wants_shorter(const Triangulation& mesh, int t, int i) noexcept {
  const Triangle& A = mesh.triangles[t];
  if (A.n[i] == no_edge || mesh.is_imposed(t, i)) return false;
  const double now = squared_length(mesh, A.v[next3[i]], A.v[prev3[i]]);
  if (!(now > long_edge * long_edge)) return false;
  const int d = mesh.triangles[A.n[i] >> 2].v[A.n[i] & 3];
  return squared_length(mesh, A.v[i], d) * least_gain < now && mesh.can_swap(t, i);
}

// Swaps until none is wanted; what is wanted must lower something, or there would be no end.
template <typename Wants>
void swap_all(Triangulation& mesh, std::span<const std::int32_t> seeds, const Wants& wants,
              std::vector<std::int32_t>* swapped, Monitor& monitor) {
  std::vector<HalfEdge> open;
  for (const std::int32_t t : seeds)
    for (int i = 0; i < 3; ++i) open.push_back(4 * t + i);
  long swaps = 0;
  while (!open.empty()) {
    const HalfEdge he = open.back();
    open.pop_back();
    const int t = he >> 2, i = he & 3;
    if (!wants(mesh, t, i)) continue;
    if (++swaps % swaps_between_checks == 0) monitor.checkpoint();
    const int u = mesh.triangles[t].n[i] >> 2;
    mesh.swap_edge(t, i);
    if (swapped != nullptr) swapped->insert(swapped->end(), {t, u});
    for (const HalfEdge outer : {4 * t, 4 * t + 2, 4 * u, 4 * u + 1}) open.push_back(outer);
  }
}

}  // namespace

void make_delaunay_in_metric(Triangulation& mesh, std::span<const std::int32_t> seeds, Monitor& monitor) {
  // Metrics of triangles differ by more than one swap gains where hundreds of edges lean the same way: these are
  // shortened first, by a length that belongs to the edge.
  std::vector<std::int32_t> touched(seeds.begin(), seeds.end());
  swap_all(mesh, seeds, wants_shorter, &touched, monitor);
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  swap_all(mesh, touched, wants_swap, nullptr, monitor);
}

}  // namespace carreau::plane
