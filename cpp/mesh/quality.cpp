// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/quality.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "mesh/vertex_hash.h"
#include "support/infinity.h"
#include "support/memory/unfilled.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

// HDR eq. 1.5 by lengths of sides; inradius = 2 area / perimeter
double q1_of(double ab, double bc, double ca, double twice_area) noexcept {
  const double longest = std::max({ab, bc, ca});
  return longest > 0 ? 2 * std::numbers::sqrt3 * (twice_area / (ab + bc + ca)) / longest : 0;
}

double angle_between(const Vec3& p, const Vec3& q) noexcept { return std::atan2(norm(cross(p, q)), dot(p, q)); }

// Triangles of a part: sums do not depend on the number of threads.
constexpr std::size_t part_size = 4096;

/// Values of a measure over some triangles: all that a distribution needs, with a few of the lowest values.
struct Values {
  double sum = 0, low = infinity, high = -infinity;
  std::vector<double> lowest;  ///< values of at most the bound

  void add(double value, double bound) {
    sum += value, low = std::min(low, value), high = std::max(high, value);
    if (value <= bound) lowest.push_back(value);
  }
  void add(const Values& other) {
    sum += other.sum, low = std::min(low, other.low), high = std::max(high, other.high);
    lowest.insert(lowest.end(), other.lowest.begin(), other.lowest.end());
  }
  /// Returns the distribution of n values, or none if the first percentile is not among the lowest.
  [[nodiscard]] std::optional<Distribution> distribution(std::size_t n) {
    if (n == 0) return Distribution{};
    if (lowest.size() <= n / 100) return {};
    const auto first_percent = lowest.begin() + static_cast<std::ptrdiff_t>(n / 100);
    std::nth_element(lowest.begin(), first_percent, lowest.end());
    return Distribution{sum / static_cast<double>(n), low, *first_percent, high};
  }
};

/// Sums of areas and of lengths, and extreme angles, of some triangles.
struct Part {
  struct Corner {
    Vec3 p, q;             // the sides
    double cotangent = 0;  // of the angle between them: falls from 0 to 180 degrees, and costs less than the angle
  };
  double area = 0;
  Corner sharpest{.p = {}, .q = {}, .cotangent = -infinity};
  Corner bluntest{.p = {}, .q = {}, .cotangent = infinity};

  double sides = 0, shortest = infinity, longest = 0;
  Values q1_values, q2_values;

  /// Returns Q1 and Q2.
  std::pair<double, double> measure(std::span<const Vec3> vertices, const std::array<std::int32_t, 3>& t) {
    const Vec3 &a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
    const Vec3 ab = b - a, bc = c - b, ca = a - c, ac = c - a;
    const double ab2 = dot(ab, ab), bc2 = dot(bc, bc), ca2 = dot(ca, ca), twice_area = norm(cross(ab, ac));
    const double squares = ab2 + bc2 + ca2, l = std::sqrt(ab2), m = std::sqrt(bc2), n = std::sqrt(ca2);
    const double q1 = q1_of(l, m, n, twice_area);
    const double q2 = squares > 0 ? 2 * std::numbers::sqrt3 * twice_area / squares : 0;
    sides += l + m + n, shortest = std::min({shortest, l, m, n}), longest = std::max({longest, l, m, n});
    area += 0.5 * twice_area;
    if (q2 > shapely && is_ordinary(ab, bc, ca, twice_area)) return {q1, q2};
    see({ab, ac, 0});
    see({bc, a - b, 0});
    see({ca, b - c, 0});
    return {q1, q2};
  }
  // For triangles with good shapes, cotangents over one area differ from the cotangents of see() by far less than the
  // margin. Nearly all triangles are then known to have no extreme angle.
  static constexpr double shapely = 1e-3, margin = 1e-9;
  [[nodiscard]] bool is_ordinary(const Vec3& ab, const Vec3& bc, const Vec3& ca, double twice_area) const {
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
    q1_values.add(other.q1_values), q2_values.add(other.q2_values);
    sides += other.sides, shortest = std::min(shortest, other.shortest), longest = std::max(longest, other.longest);
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

/// An edge that has not two triangles.
struct OddEdge {
  std::int32_t low, high;  ///< its vertices
  std::size_t uses;        ///< its triangles
};

/// Figures of edges that do not depend on places.
struct Connections {
  std::vector<OddEdge> odd;  ///< ascending
  double degree6 = 0;        ///< QualitySummary::degree6
};

/// The share of vertices with `degree` 6 among vertices with a degree that are not ends of odd edges.
template <typename Degree>
double share_of_six(std::size_t n, const std::vector<OddEdge>& odd, const Degree& degree) {
  std::vector<char> border(n, 0);
  for (const OddEdge& edge : odd) border[static_cast<std::size_t>(edge.low)] = border[static_cast<std::size_t>(edge.high)] = 1;
  std::size_t inside = 0, six = 0;
  for (std::size_t v = 0; v < n; ++v) {
    if (border[v] != 0 || degree(v) == 0) continue;
    ++inside;
    if (degree(v) == 6) ++six;
  }
  return inside == 0 ? 0 : static_cast<double>(six) / static_cast<double>(inside);
}

/// Calls use(part) for parts of `n` things.
template <typename Use>
void each_part(std::size_t n, int threads, const Use& use) {
  Monitor silent;
  run_each((n + part_size - 1) / part_size, false, threads, [&](std::size_t part, Monitor&) { use(part); }, silent);
}

template <typename T>
std::vector<T> joined(const std::vector<std::vector<T>>& parts) {
  std::vector<T> all;
  for (const std::vector<T>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// Lists the edges of each vertex.
Connections connections_of_any(const TriangleLists& mesh, int threads) {
  const std::size_t n = mesh.vertices().size();
  EdgesByVertex edges(mesh, threads);
  std::vector<std::int32_t> degree(n, 0);
  const auto count = [&](std::size_t v) {
    // Atomic sums are slow even with only one thread.
    if (threads <= 1)
      ++degree[v];
    else
      std::atomic_ref(degree[v]).fetch_add(1, std::memory_order_relaxed);
  };
  std::vector<std::vector<OddEdge>> odd((n + part_size - 1) / part_size);
  each_part(n, threads, [&](std::size_t part) {
    for (std::size_t v = part * part_size; v < std::min((part + 1) * part_size, n); ++v) {
      const std::span others(edges.others.data() + edges.start[v], edges.start[v + 1] - edges.start[v]);
      std::sort(others.begin(), others.end());
      for (std::size_t i = 0, j = 0; i < others.size(); i = j) {
        while (j < others.size() && others[j] == others[i]) ++j;
        count(v), count(static_cast<std::size_t>(others[i]));
        if (j - i != 2) odd[part].push_back({static_cast<std::int32_t>(v), others[i], j - i});
      }
    }
  });
  Connections all{joined(odd), 0};
  all.degree6 = share_of_six(n, all.odd, [&](std::size_t v) { return degree[v]; });
  return all;
}

// Sums have a count in their low bits, and 48 bits of hashes above it.
constexpr int count_bits = 16;
constexpr std::uint64_t count_mask = (std::uint64_t{1} << count_bits) - 1;
std::uint64_t above_count(std::int32_t v) noexcept { return vertex_hash(v) << count_bits; }

// Edges between vertices on curves alone, if the triangles round every other vertex close: then these have as many edges as triangles.
// In low bits a sum counts the triangles of a vertex, in high bits it adds the next vertices round it and subtracts the ones before.
std::optional<Connections> connections_at_curves(const TriangleLists& mesh, int threads) {
  const std::size_t n = mesh.vertices().size(), on_curves = mesh.on_curves();
  if (2 * on_curves > n) return {};
  std::vector<std::uint64_t> sums(n, 0);
  const auto add = [&](std::int32_t v, std::uint64_t x) {
    std::uint64_t& sum = sums[static_cast<std::size_t>(v)];
    if (threads <= 1)
      sum += x;
    else
      std::atomic_ref(sum).fetch_add(x, std::memory_order_relaxed);
  };
  using Ends = std::pair<std::int32_t, std::int32_t>;
  std::vector<std::vector<Ends>> of_part((mesh.size() + part_size - 1) / part_size);
  each_part(mesh.size(), threads, [&](std::size_t part) {
    mesh.for_each(part * part_size, std::min((part + 1) * part_size, mesh.size()), [&](std::size_t, const std::array<std::int32_t, 3>& t) {
      const std::uint64_t a = above_count(t[0]), b = above_count(t[1]), c = above_count(t[2]);
      add(t[0], b - c + 1), add(t[1], c - a + 1), add(t[2], a - b + 1);
      const auto on = [&](std::int32_t v) { return static_cast<std::size_t>(v) < on_curves; };
      if (on(t[0]) + on(t[1]) + on(t[2]) < 2) return;
      for (std::size_t i = 0; i < 3; ++i)
        if (const auto ends = std::minmax(t[i], t[(i + 1) % 3]); on(ends.second)) of_part[part].emplace_back(ends);
    });
  });
  for (std::size_t v = on_curves; v < n; ++v)
    if ((sums[v] & ~count_mask) != 0) return {};
  std::vector<Ends> sides = joined(of_part);
  std::sort(sides.begin(), sides.end());
  Connections all;
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    while (j < sides.size() && sides[j] == sides[i]) ++j;
    if (j - i != 2) all.odd.push_back({sides[i].first, sides[i].second, j - i});
  }
  all.degree6 = share_of_six(n, all.odd, [&](std::size_t v) { return sums[v] & count_mask; });
  return all;
}

}  // namespace

void summarise_edges(const TriangleLists& mesh, int threads, QualitySummary& summary) {
  const std::optional<Connections> some = connections_at_curves(mesh, threads);
  const Connections connections = some ? *some : connections_of_any(mesh, threads);
  std::size_t uses = 0;
  double sum = summary.side_sum;  // an edge with two triangles is in it twice
  summary.open_edges = 0;
  for (const OddEdge& edge : connections.odd) {
    const Vec3 along = mesh.vertices()[static_cast<std::size_t>(edge.high)] - mesh.vertices()[static_cast<std::size_t>(edge.low)];
    sum += (2 - static_cast<double>(edge.uses)) * norm(along);
    uses += edge.uses;
    if (edge.uses == 1) ++summary.open_edges;
  }
  summary.edges = (3 * mesh.size() - uses) / 2 + connections.odd.size();
  if (summary.edges > 0) summary.edge_mean = sum / 2 / static_cast<double>(summary.edges);
  summary.degree6 = connections.degree6;
}

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
  const Vec3 ab = b - a, bc = c - b, ca = a - c, ac = c - a;
  return q1_of(norm(ab), norm(bc), norm(ca), norm(cross(ab, ac)));
}

namespace {

// Triangles that show where the lowest values lie; the share of their values that bounds these, four times the percentile; triangles
// of a mesh whose values are all kept. [time and memory only]
constexpr std::size_t shown = 2048, few_triangles_in_all = 16384;
constexpr double lowest_share = 0.04;

/// Bounds of Q1 and Q2 below which more than the first percentile lies, most likely.
std::pair<double, double> bounds_of_lowest(const TriangleLists& mesh) {
  if (mesh.size() < few_triangles_in_all) return {infinity, infinity};
  std::vector<double> q1, q2;
  Part unused;
  for (std::size_t k = 0; k < shown; ++k) {
    const std::size_t t = k * (mesh.size() / shown);
    mesh.for_each(t, t + 1, [&](std::size_t, const std::array<std::int32_t, 3>& corners) {
      const auto [first, second] = unused.measure(mesh.vertices(), corners);
      q1.push_back(first), q2.push_back(second);
    });
  }
  const auto bound = [](std::vector<double>& values) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(lowest_share * shown);
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  return {bound(q1), bound(q2)};
}

Part measured(const TriangleLists& mesh, int threads, std::pair<double, double> bounds) {
  std::vector<Part> parts((mesh.size() + part_size - 1) / part_size);
  each_part(mesh.size(), threads, [&](std::size_t i) {
    Part& part = parts[i];
    for (Values* values : {&part.q1_values, &part.q2_values}) values->lowest.reserve(part_size / 8);
    mesh.for_each(i * part_size, std::min((i + 1) * part_size, mesh.size()), [&](std::size_t, const std::array<std::int32_t, 3>& corners) {
      const auto [q1, q2] = part.measure(mesh.vertices(), corners);
      part.q1_values.add(q1, bounds.first), part.q2_values.add(q2, bounds.second);
    });
  });
  Part all;
  for (const Part& part : parts) all.add(part);
  return all;
}

}  // namespace

QualitySummary summarise_shapes(const TriangleLists& mesh, int threads) {
  QualitySummary summary;
  summary.vertices = mesh.nodes();
  summary.triangles = mesh.size();
  Part all = measured(mesh, threads, bounds_of_lowest(mesh));
  std::optional<Distribution> q1 = all.q1_values.distribution(mesh.size()), q2 = all.q2_values.distribution(mesh.size());
  if (!q1 || !q2) {
    all = measured(mesh, threads, {infinity, infinity});
    q1 = all.q1_values.distribution(mesh.size()), q2 = all.q2_values.distribution(mesh.size());
  }
  summary.q1 = q1.value_or(Distribution{}), summary.q2 = q2.value_or(Distribution{});
  summary.area = all.area;
  summary.side_sum = all.sides;
  if (mesh.size() > 0) {
    summary.edge_min = all.shortest, summary.edge_max = all.longest;
    summary.angle_min_deg = angle_between(all.sharpest.p, all.sharpest.q) * 180 / std::numbers::pi;
    summary.angle_max_deg = angle_between(all.bluntest.p, all.bluntest.q) * 180 / std::numbers::pi;
  }
  return summary;
}

QualitySummary summarise_quality(const TriangleLists& mesh, int threads) {
  QualitySummary summary = summarise_shapes(mesh, threads);
  summarise_edges(mesh, threads, summary);
  return summary;
}

QualitySummary summarise_quality(const FlatMesh& mesh, int threads) {
  return summarise_quality(TriangleLists(mesh), threads);
}

}  // namespace carreau
