// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/quality.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "support/infinity.h"
#include "support/stepped_tasks.h"
#include "support/unfilled.h"

namespace carreau {

namespace {

double double_area(const Vec3& a, const Vec3& b, const Vec3& c) noexcept { return norm(cross(b - a, c - a)); }

// HDR eq. 1.5; inradius = 2 area / perimeter
double q1_of(const Vec3& a, const Vec3& b, const Vec3& c, double twice_area) noexcept {
  const double ab = norm(b - a), bc = norm(c - b), ca = norm(a - c);
  const double longest = std::max({ab, bc, ca});
  return longest > 0 ? 2 * std::numbers::sqrt3 * (twice_area / (ab + bc + ca)) / longest : 0;
}

double angle_between(const Vec3& p, const Vec3& q) noexcept { return std::atan2(norm(cross(p, q)), dot(p, q)); }

// Triangles of a part: sums do not depend on the number of threads.
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

  void measure(std::span<const Vec3> vertices, const std::array<std::int32_t, 3>& t, double& q1, double& q2) {
    const Vec3 a = vertices[t[0]], b = vertices[t[1]], c = vertices[t[2]];
    const double twice_area = double_area(a, b, c);
    q1 = q1_of(a, b, c, twice_area);
    q2 = quality_q2(a, b, c, twice_area);
    area += 0.5 * twice_area;
    if (q2 > shapely && is_ordinary(a, b, c, twice_area)) return;
    see({b - a, c - a, 0});
    see({c - b, a - b, 0});
    see({a - c, b - c, 0});
  }
  // For triangles with good shapes, cotangents over one area differ from the cotangents of see() by far less than the
  // margin. Nearly all triangles are then known to have no extreme angle.
  static constexpr double shapely = 1e-3, margin = 1e-9;
  [[nodiscard]] bool is_ordinary(const Vec3& a, const Vec3& b, const Vec3& c, double twice_area) const {
    const Vec3 ab = b - a, bc = c - b, ca = a - c;
    const double at_a = -dot(ab, ca), at_b = -dot(ab, bc), at_c = -dot(bc, ca);
    const double high = sharpest.cotangent - margin * (1 + std::abs(sharpest.cotangent));
    const double low = bluntest.cotangent + margin * (1 + std::abs(bluntest.cotangent));
    return std::max({at_a, at_b, at_c}) < high * twice_area && std::min({at_a, at_b, at_c}) > low * twice_area;
  }
  void see(Corner corner) {
    const double sine = norm(cross(corner.p, corner.q)), cosine = dot(corner.p, corner.q);
    // Sides of a flat triangle: 0 or 180 degrees; as atan2 has it, 0 for a side without length.
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

/// The edges of all triangles, each once for each triangle, by their smaller vertex; edges of one vertex in any order.
struct EdgesByVertex {
  std::vector<std::size_t> start;   ///< vertex v has others[start[v] .. start[v + 1] - 1]
  UnfilledVector<std::int32_t> others; ///< their larger vertices

  EdgesByVertex(const TriangleLists& mesh, int threads) : start(mesh.nodes() + 1, 0), others(3 * mesh.size()) {
    // Atomic sums are slow even with only one thread.
    const auto raise = [&](std::int32_t v, std::size_t by) {
      std::size_t& x = start[static_cast<std::size_t>(v)];
      return threads > 1 ? std::atomic_ref(x).fetch_add(by, std::memory_order_relaxed) : std::exchange(x, x + by);
    };
    for_each_side(mesh, threads, [&](std::int32_t low, std::int32_t) { raise(low, 1); });
    std::partial_sum(start.begin(), start.end(), start.begin());
    // Counts down from the ends: the results are the starts of the vertices.
    constexpr std::size_t one_less = static_cast<std::size_t>(-1);
    for_each_side(mesh, threads,
                  [&](std::int32_t low, std::int32_t high) { others[raise(low, one_less) - 1] = high; });
  }

  template <typename Use>
  static void for_each_side(const TriangleLists& mesh, int threads, const Use& use) {
    const auto use_sides = [&](std::size_t, const std::array<std::int32_t, 3>& t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
        use(low, high);
      }
    };
    Monitor silent;
    run_each(
        (mesh.size() + part_size - 1) / part_size, false, threads,
        [&](std::size_t part, Monitor&) {
          mesh.for_each(part * part_size, std::min((part + 1) * part_size, mesh.size()), use_sides);
        },
        silent);
  }
};

/// Lengths of the edges of some vertices.
struct EdgeLengths {
  double sum = 0, low = infinity, high = 0;
  std::size_t count = 0, open = 0;

  void add(const EdgeLengths& other) {
    sum += other.sum, low = std::min(low, other.low), high = std::max(high, other.high);
    count += other.count, open += other.open;
  }
};

/// Counts of threads at vertices that several threads meet.
struct Degrees {
  std::vector<std::int32_t> degree;
  std::vector<std::int32_t> border; ///< 1: on an edge that has not two triangles

  bool alone = false;                ///< one thread: atomic sums take their time

  void count(std::size_t v, bool on_border) {
    if (alone)
      ++degree[v];
    else
      std::atomic_ref(degree[v]).fetch_add(1, std::memory_order_relaxed);
    if (on_border) std::atomic_ref(border[v]).store(1, std::memory_order_relaxed);
  }
  [[nodiscard]] double share_of_six() const {
    std::size_t inside = 0, six = 0;
    for (std::size_t v = 0; v < degree.size(); ++v) {
      if (border[v] != 0 || degree[v] == 0) continue;
      ++inside;
      if (degree[v] == 6) ++six;
    }
    return inside == 0 ? 0 : static_cast<double>(six) / static_cast<double>(inside);
  }
};

/// The edges whose smaller vertex is v.
void measure_edges_of(std::span<const Vec3> vertices, EdgesByVertex& edges, std::size_t v, EdgeLengths& lengths,
                      Degrees& degrees) {
  const std::span others(edges.others.data() + edges.start[v], edges.start[v + 1] - edges.start[v]);
  std::sort(others.begin(), others.end());
  for (std::size_t i = 0, j = 0; i < others.size(); i = j) {
    while (j < others.size() && others[j] == others[i]) ++j;
    const auto w = static_cast<std::size_t>(others[i]);
    const double length = norm(vertices[w] - vertices[v]);
    lengths.add({length, length, length, 1, j - i == 1 ? std::size_t{1} : 0});
    degrees.count(v, j - i != 2);
    degrees.count(w, j - i != 2);
  }
}

void measure_edges(const TriangleLists& mesh, int threads, QualitySummary& summary) {
  const std::size_t n = mesh.vertices().size();
  EdgesByVertex edges(mesh, threads);
  Degrees degrees{std::vector<std::int32_t>(n, 0), std::vector<std::int32_t>(n, 0), threads == 1};
  std::vector<EdgeLengths> parts((n + part_size - 1) / part_size);
  Monitor silent;
  run_each(
      parts.size(), false, threads,
      [&](std::size_t i, Monitor&) {
        const std::size_t end = std::min((i + 1) * part_size, n);
        for (std::size_t v = i * part_size; v < end; ++v) measure_edges_of(mesh.vertices(), edges, v, parts[i], degrees);
      },
      silent);
  EdgeLengths all;
  for (const EdgeLengths& part : parts) all.add(part);
  summary.edges = all.count;
  summary.open_edges = all.open;
  if (all.count == 0) return;
  summary.edge_min = all.low;
  summary.edge_max = all.high;
  summary.edge_mean = all.sum / static_cast<double>(all.count);
  summary.degree6 = degrees.share_of_six();
}

}  // namespace

Distribution distribution_of(std::span<double> values) {
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
  return q1_of(a, b, c, double_area(a, b, c));
}

QualitySummary summarise_shapes(const TriangleLists& mesh, int threads) {
  QualitySummary summary;
  summary.vertices = mesh.nodes();
  summary.triangles = mesh.size();
  UnfilledVector<double> q1(mesh.size()), q2(mesh.size());
  std::vector<Part> parts((mesh.size() + part_size - 1) / part_size);
  Monitor silent;
  run_each(
      parts.size(), false, threads,
      [&](std::size_t i, Monitor&) {
        mesh.for_each(i * part_size, std::min((i + 1) * part_size, mesh.size()),
                      [&](std::size_t t, const std::array<std::int32_t, 3>& corners) {
                        parts[i].measure(mesh.vertices(), corners, q1[t], q2[t]);
                      });
      },
      silent);
  Part all;
  for (const Part& part : parts) all.add(part);
  summary.area = all.area;
  if (mesh.size() > 0) {
    summary.angle_min_deg = angle_between(all.sharpest.p, all.sharpest.q) * 180 / std::numbers::pi;
    summary.angle_max_deg = angle_between(all.bluntest.p, all.bluntest.q) * 180 / std::numbers::pi;
  }
  run_each(
      2, false, threads,
      [&](std::size_t i, Monitor&) { (i == 0 ? summary.q1 : summary.q2) = distribution_of(i == 0 ? q1 : q2); }, silent);
  return summary;
}

void summarise_edges(const TriangleLists& mesh, int threads, QualitySummary& summary) {
  measure_edges(mesh, threads, summary);
}

QualitySummary summarise_quality(const TriangleLists& mesh, int threads) {
  QualitySummary summary = summarise_shapes(mesh, threads);
  measure_edges(mesh, threads, summary);
  return summary;
}

QualitySummary summarise_quality(const FlatMesh& mesh, int threads) {
  return summarise_quality(TriangleLists(mesh), threads);
}

}  // namespace carreau
