// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/parts/part_quality.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "support/infinity.h"
#include "support/ranks/packet.h"

namespace carreau {

namespace {

using Edge = std::array<std::int32_t, 2>;

/// Combines the numbers of all processes, element by element, by add(number, another).
template <typename Add>
std::vector<double> combined(Team& team, std::string_view step, const std::vector<double>& mine, std::vector<double> all, const Add& add) {
  PacketWriter packet;
  packet.put(mine);
  for (const std::string& of_rank : team.exchange(step, packet.bytes())) {
    const std::vector<double> theirs = PacketReader(of_rank).reals();
    for (std::size_t i = 0; i < std::min(all.size(), theirs.size()); ++i) all[i] = add(all[i], theirs[i]);
  }
  return all;
}
std::vector<double> sums(Team& team, std::string_view step, const std::vector<double>& mine) {
  return combined(team, step, mine, std::vector<double>(mine.size(), 0), [](double a, double b) { return a + b; });
}
std::vector<double> least(Team& team, std::string_view step, const std::vector<double>& mine) {
  return combined(team, step, mine, mine, [](double a, double b) { return std::min(a, b); });
}

/// Bits of numbers from 0 on ascend as they do.
std::uint64_t bits_of(double value) noexcept { return std::bit_cast<std::uint64_t>(value + 0.0); }

/// The number of rank `rank` among the values, none below 0, of all processes: eight bits after another are found.
double selected(Team& team, const std::vector<double>& values, double rank) {
  std::uint64_t known = 0;
  for (int shift = 56; shift >= 0; shift -= 8) {
    const std::uint64_t mask = shift == 56 ? 0 : ~std::uint64_t{0} << (shift + 8);
    std::vector<double> counts(256, 0);
    for (const double value : values)
      if (const std::uint64_t bits = bits_of(value); (bits & mask) == known) counts[bits >> shift & 255] += 1;
    counts = sums(team, "percentiles", counts);
    std::uint64_t digit = 0;
    while (digit < 255 && rank >= counts[digit]) rank -= counts[digit++];
    known |= digit << shift;
  }
  return std::bit_cast<double>(known);
}

struct Shapes {
  std::vector<double> q1, q2;
};

Shapes shapes_of(const SurfaceMesh& mesh) {
  Shapes shapes;
  shapes.q1.reserve(mesh.triangle_count()), shapes.q2.reserve(mesh.triangle_count());
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles) {
      const auto at = [&](std::size_t k) -> const Vec3& { return mesh.vertices[face.vertex[t[k]]]; };
      shapes.q1.push_back(quality_q1(at(0), at(1), at(2))), shapes.q2.push_back(quality_q2(at(0), at(1), at(2)));
    }
  return shapes;
}

Distribution distribution_of_all(Team& team, const std::vector<double>& values, std::int64_t triangles, double sum) {
  Distribution d;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const bool any = low != values.end();
  const std::vector<double> extremes = least(team, "extremes", {any ? *low : infinity, any ? -*high : infinity});
  d.min = extremes[0], d.max = -extremes[1];
  d.mean = sum / static_cast<double>(triangles);
  d.p1 = selected(team, values, static_cast<double>(triangles / 100));
  return d;
}

/// Edges with at least one vertex inside a face are of one process. Edges between vertices of curves, and these vertices, are
/// summed over the processes.
class Edges {
 public:
  Edges(const SurfaceMesh& mesh, const MeshShares& shares)
      : mesh_(mesh), on_curves_(static_cast<std::int32_t>(shares.on_curves)), degree_(mesh.vertices.size(), 0), border_(mesh.vertices.size(), 0) {
    for (const FaceMesh& face : mesh.faces) measure(face);
  }

  void add_up(Team& team, QualitySummary& summary) {
    add_curves(team);
    std::vector<double> counted{sum_, double(count_), double(open_), 0, 0};
    for (std::size_t v = static_cast<std::size_t>(on_curves_); v < degree_.size(); ++v) count_vertex(v, counted);
    if (team.rank() == 0)
      for (std::size_t v = 0; v < static_cast<std::size_t>(on_curves_); ++v) count_vertex(v, counted);
    const std::vector<double> all = sums(team, "edges", counted), extremes = least(team, "lengths", {low_, -high_});
    summary.edges = static_cast<std::size_t>(all[1]), summary.open_edges = static_cast<std::size_t>(all[2]);
    if (summary.edges == 0) return;
    summary.edge_mean = all[0] / all[1];
    summary.edge_min = extremes[0], summary.edge_max = -extremes[1];
    summary.degree6 = all[3] > 0 ? all[4] / all[3] : 0;
  }

 private:
  void count_vertex(std::size_t v, std::vector<double>& counted) const {
    if (border_[v] != 0 || degree_[v] == 0) return;
    counted[3] += 1;
    if (degree_[v] == 6) counted[4] += 1;
  }

  void add(const Edge& edge, std::int64_t triangles) {
    const double length = norm(mesh_.vertices[edge[1]] - mesh_.vertices[edge[0]]);
    sum_ += length, low_ = std::min(low_, length), high_ = std::max(high_, length);
    ++count_;
    if (triangles == 1) ++open_;
    for (const std::int32_t v : edge) {
      ++degree_[v];
      if (triangles != 2) border_[v] = 1;
    }
  }

  template <typename Use>
  void for_sides(const FaceMesh& face, const Use& use) const {
    for (const auto& t : face.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(face.vertex[t[k]], face.vertex[t[(k + 1) % 3]]);
        use(a, b);
      }
  }

  // Sides are listed by their greater vertex, which is one inside the face, but of sides between vertices of curves.
  void measure(const FaceMesh& face) {
    std::int32_t first = std::numeric_limits<std::int32_t>::max(), behind = 0;
    for (const std::int32_t v : face.vertex)
      if (v >= on_curves_) first = std::min(first, v), behind = std::max(behind, v + 1);
    const auto n = static_cast<std::size_t>(std::max(behind - first, 0));
    std::vector<std::size_t> next(n + 1, 0);
    for_sides(face, [&](std::int32_t a, std::int32_t b) {
      if (b >= on_curves_)
        ++next[static_cast<std::size_t>(b - first) + 1];
      else
        ++of_curves_[{a, b}];
    });
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<std::int32_t> others(next.back());
    for_sides(face, [&](std::int32_t a, std::int32_t b) {
      if (b >= on_curves_) others[next[static_cast<std::size_t>(b - first)]++] = a;
    });
    auto begin = others.begin();  // each list starts at the end of the previous one
    for (std::size_t v = 0; v < n; ++v) {
      const auto end = others.begin() + static_cast<std::ptrdiff_t>(next[v]);
      std::sort(begin, end);
      for (auto other = begin; other != end;) {
        const auto same = std::upper_bound(other, end, *other);
        add({*other, first + static_cast<std::int32_t>(v)}, same - other);
        other = same;
      }
      begin = end;
    }
  }

  // Rank 0 counts the edges between vertices of curves, and all vertices of curves.
  void add_curves(Team& team) {
    PacketWriter packet;
    for (const auto& [edge, triangles] : of_curves_) packet.put(std::int64_t{edge[0]}), packet.put(std::int64_t{edge[1]}), packet.put(triangles);
    std::map<Edge, std::int64_t> all;
    for (const std::string& of_rank : team.exchange("edges of curves", packet.bytes()))
      for (PacketReader reader(of_rank); !reader.at_end();) {
        const auto a = static_cast<std::int32_t>(reader.integer()), b = static_cast<std::int32_t>(reader.integer());
        all[{a, b}] += reader.integer();
      }
    PacketWriter around;
    for (std::size_t v = 0; v < static_cast<std::size_t>(on_curves_); ++v)
      if (degree_[v] != 0)
        around.put(static_cast<std::int64_t>(v)), around.put(std::int64_t{degree_[v]}), around.put(std::int64_t{border_[v]});
    std::fill_n(degree_.begin(), on_curves_, 0);
    for (const std::string& of_rank : team.exchange("vertices of curves", around.bytes()))
      for (PacketReader reader(of_rank); !reader.at_end();) {
        const auto v = static_cast<std::size_t>(reader.integer());
        degree_.at(v) += static_cast<std::int32_t>(reader.integer());
        if (reader.integer() != 0) border_[v] = 1;
      }
    if (team.rank() == 0)
      for (const auto& [edge, triangles] : all) add(edge, triangles);
  }

  const SurfaceMesh& mesh_;
  std::int32_t on_curves_;
  std::vector<std::int32_t> degree_;
  std::vector<char> border_;
  std::map<Edge, std::int64_t> of_curves_;  // triangles here
  double sum_ = 0, low_ = infinity, high_ = 0;
  std::int64_t count_ = 0, open_ = 0;
};

}  // namespace

QualitySummary summarise_parts(Team& team, const SurfaceMesh& mesh, const MeshShares& shares, int threads) {
  QualitySummary all;
  const QualitySummary here = summarise_shapes(TriangleLists(mesh), threads);
  const auto triangles = static_cast<double>(here.triangles);
  const std::vector<double> sum = sums(team, "shapes", {here.area, here.q1.mean * triangles, here.q2.mean * triangles});
  all.vertices = static_cast<std::size_t>(shares.vertices), all.triangles = static_cast<std::size_t>(shares.triangles);
  all.area = sum[0];
  if (shares.triangles > 0) {
    const bool any = here.triangles > 0;
    const std::vector<double> angles =
        least(team, "angles", {any ? here.angle_min_deg : infinity, any ? -here.angle_max_deg : infinity});
    all.angle_min_deg = angles[0], all.angle_max_deg = -angles[1];
    const Shapes shapes = shapes_of(mesh);
    all.q1 = distribution_of_all(team, shapes.q1, shares.triangles, sum[1]);
    all.q2 = distribution_of_all(team, shapes.q2, shares.triangles, sum[2]);
  }
  Edges(mesh, shares).add_up(team, all);
  return all;
}

}  // namespace carreau
