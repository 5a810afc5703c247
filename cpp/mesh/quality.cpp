#include "mesh/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "support/infinity.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

double double_area(const Vec3& a, const Vec3& b, const Vec3& c) noexcept { return norm(cross(b - a, c - a)); }

double angle_between(const Vec3& p, const Vec3& q) noexcept { return std::atan2(norm(cross(p, q)), dot(p, q)); }

// Of this many triangles: sums do not depend on the number of threads.
constexpr std::size_t part_size = 4096;

/// Sum of areas, and extreme angles, of some triangles.
struct Part {
  struct Corner {
    Vec3 p, q;             // the sides
    double cotangent = 0;  // of the angle between them: falls from 0 to 180 degrees, and costs less than the angle
  };
  double area = 0;
  Corner sharpest{.p = {}, .q = {}, .cotangent = -infinity};
  Corner bluntest{.p = {}, .q = {}, .cotangent = infinity};

  void measure(const FlatMesh& mesh, std::size_t triangle, double& q1, double& q2) {
    const auto& t = mesh.triangles[triangle];
    const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    q1 = quality_q1(a, b, c);
    q2 = quality_q2(a, b, c);
    area += 0.5 * double_area(a, b, c);
    see({b - a, c - a, 0});
    see({c - b, a - b, 0});
    see({a - c, b - c, 0});
  }
  void see(Corner corner) {
    const double sine = norm(cross(corner.p, corner.q)), cosine = dot(corner.p, corner.q);
    // Sides of a flat triangle: 0 or 180 degrees; as atan2 has it, 0 where a side has no length.
    corner.cotangent = sine > 0 ? cosine / sine : std::copysign(std::numeric_limits<double>::max(), cosine);
    keep(corner);
  }
  void keep(const Corner& corner) {
    if (corner.cotangent > sharpest.cotangent) sharpest = corner;
    if (corner.cotangent < bluntest.cotangent) bluntest = corner;
  }
  void add(const Part& other) {
    area += other.area;
    keep(other.sharpest);
    keep(other.bluntest);
  }
};

void measure_edges(const FlatMesh& mesh, QualitySummary& summary) {
  std::vector<std::uint64_t> keys;
  keys.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const auto a = static_cast<std::uint32_t>(t[i]), b = static_cast<std::uint32_t>(t[(i + 1) % 3]);
      keys.push_back(static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b));
    }
  std::sort(keys.begin(), keys.end());
  std::vector<int> degree(mesh.vertices.size(), 0);
  std::vector<char> border(mesh.vertices.size(), 0);
  double sum = 0, low = infinity, high = 0;
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t j = i;
    while (j < keys.size() && keys[j] == keys[i]) ++j;
    const auto a = static_cast<std::size_t>(keys[i] >> 32), b = static_cast<std::size_t>(keys[i] & 0xffffffffU);
    const double l = norm(mesh.vertices[b] - mesh.vertices[a]);
    sum += l;
    low = std::min(low, l);
    high = std::max(high, l);
    ++summary.edges;
    ++degree[a];
    ++degree[b];
    if (j - i == 1) ++summary.open_edges;
    if (j - i != 2) border[a] = border[b] = 1;
    i = j;
  }
  if (summary.edges == 0) return;
  summary.edge_min = low;
  summary.edge_max = high;
  summary.edge_mean = sum / static_cast<double>(summary.edges);
  std::size_t inside = 0, six = 0;
  for (std::size_t v = 0; v < degree.size(); ++v) {
    if (border[v] != 0 || degree[v] == 0) continue;
    ++inside;
    if (degree[v] == 6) ++six;
  }
  summary.degree6 = inside == 0 ? 0 : static_cast<double>(six) / static_cast<double>(inside);
}

}  // namespace

Distribution distribution_of(std::vector<double>& values) {
  Distribution d;
  if (values.empty()) return d;
  double sum = 0;
  for (const double v : values) sum += v;
  d.mean = sum / static_cast<double>(values.size());
  const auto first_percent = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 100);
  std::nth_element(values.begin(), first_percent, values.end());
  d.p1 = *first_percent;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  d.min = *low;
  d.max = *high;
  return d;
}

double quality_q1(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const double ab = norm(b - a), bc = norm(c - b), ca = norm(a - c);
  const double longest = std::max({ab, bc, ca});
  if (!(longest > 0)) return 0;
  // inradius = 2 area / perimeter; HDR eq. 1.5
  return 2 * std::numbers::sqrt3 * (double_area(a, b, c) / (ab + bc + ca)) / longest;
}

double quality_q2(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double squares = dot(ab, ab) + dot(bc, bc) + dot(ca, ca);
  // HDR eq. 1.6
  return squares > 0 ? 2 * std::numbers::sqrt3 * double_area(a, b, c) / squares : 0;
}

QualitySummary summarise_shapes(const FlatMesh& mesh, int threads) {
  QualitySummary summary;
  summary.vertices = mesh.vertices.size();
  summary.triangles = mesh.triangles.size();
  std::vector<double> q1(mesh.triangles.size()), q2(mesh.triangles.size());
  std::vector<Part> parts((mesh.triangles.size() + part_size - 1) / part_size);
  Monitor silent;
  run_each(
      parts.size(), false, threads,
      [&](std::size_t i, Monitor&) {
        const std::size_t begin = i * part_size, end = std::min(begin + part_size, mesh.triangles.size());
        for (std::size_t t = begin; t < end; ++t) parts[i].measure(mesh, t, q1[t], q2[t]);
      },
      silent);
  Part all;
  for (const Part& part : parts) all.add(part);
  summary.area = all.area;
  if (!mesh.triangles.empty()) {
    summary.angle_min_deg = angle_between(all.sharpest.p, all.sharpest.q) * 180 / std::numbers::pi;
    summary.angle_max_deg = angle_between(all.bluntest.p, all.bluntest.q) * 180 / std::numbers::pi;
  }
  run_each(
      2, false, threads,
      [&](std::size_t i, Monitor&) { (i == 0 ? summary.q1 : summary.q2) = distribution_of(i == 0 ? q1 : q2); }, silent);
  return summary;
}

QualitySummary summarise_quality(const FlatMesh& mesh) {
  QualitySummary summary = summarise_shapes(mesh, 1);
  measure_edges(mesh, summary);
  return summary;
}

}  // namespace carreau
