// SPDX-License-Identifier: BSD-3-Clause
#include "plane/division/partition.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "mesh/shape_levels.h"
#include "model/union_find.h"
#include "plane/division/arrival.h"
#include "plane/division/undivided.h"
#include "plane/kernel/thresholds.h"
#include "plane/kernel/triangulation.h"

namespace carreau::plane {

namespace {

class Division {
 public:
  Division(const CoarseMesh& coarse, const CoarseDomain& domain, Monitor& monitor)
      : monitor_(monitor),
        coarse_(coarse),
        domain_(domain),
        n_(coarse.mesh.triangles.size()),
        clump_(n_),
        part_(n_, 0),
        part_of_clump_(n_, -1) {}

  Partition run(int parts) {
    join_what_stays_together();
    monitor_.checkpoint();
    cut_into_sectors(parts);
    monitor_.checkpoint();
    for (int pass = 0; pass < smoothing_passes; ++pass) smooth();
    return connected();
  }

 private:
  static constexpr int smoothing_passes = 3;

  // Triangles at degenerate sides, and bad ones with their neighbours.
  void join_what_stays_together() {
    const auto& triangles = coarse_.mesh.triangles;
    std::vector<std::int32_t> degenerate(coarse_.mesh.vertices.size(), 0);  // one more than the end of such a side
    for (const PlaneEdge& edge : domain_.domain.edges)
      if (edge.kind == PlaneEdgeKind::degenerate) degenerate[edge.a] = degenerate[edge.b] = edge.a + 1;
    for (int ring = 0; ring < rings_at_degenerate_sides; ++ring) {
      const std::vector<std::int32_t> before = degenerate;
      for (const auto& t : triangles)
        for (const std::int32_t v : t)
          for (const std::int32_t w : t)
            if (before[v] == 0) degenerate[v] = std::max(degenerate[v], before[w]);
    }
    std::vector<std::int32_t> first(coarse_.mesh.vertices.size() + 1, -1);
    for (std::size_t t = 0; t < n_; ++t) {
      const auto self = static_cast<std::int32_t>(t);
      for (const std::int32_t v : triangles[t]) {
        const std::int32_t of = degenerate[v];
        if (of == 0) continue;
        if (first[of] < 0) first[of] = self;
        clump_.merge(first[of], self);
      }
      if (is_bad(t))
        for (const std::int32_t u : coarse_.beyond[t])
          if (u >= 0) clump_.merge(self, u);
    }
  }

  [[nodiscard]] bool is_bad(std::size_t t) const {
    const auto& [a, b, c] = coarse_.mesh.triangles[t];
    const Vec2 p = coarse_.mesh.vertices[a], q = coarse_.mesh.vertices[b], r = coarse_.mesh.vertices[c];
    const Metric2 m = coarse_.metric[t];
    const double pq = squared_length(m, q - p), qr = squared_length(m, r - q), rp = squared_length(m, p - r);
    const double shape = 2 * std::numbers::sqrt3 * cross(q - p, r - p) * std::sqrt(std::max(determinant(m), 0.0));
    return std::min({pq, qr, rp}) < shortest_coarse2 || !(shape > shape_level::bad * (pq + qr + rp));
  }

  // Sectors: targets of the layers that start at a stretch of the border. Separators lie across these layers, or
  // between layers from several sides. Clumps follow their first triangle.
  void cut_into_sectors(int parts) {
    const std::vector<double> place = arrivals(coarse_, domain_);
    monitor_.checkpoint();
    std::vector<std::int32_t> triangles(n_);
    std::iota(triangles.begin(), triangles.end(), 0);
    std::stable_sort(triangles.begin(), triangles.end(),
                     [&](std::int32_t s, std::int32_t t) { return place[s] < place[t]; });
    std::vector<double> upto(n_);  // by triangle: the share of the preceding triangles
    const double whole = std::accumulate(coarse_.weight.begin(), coarse_.weight.end(), 0.0);
    double sum = 0;
    for (const std::int32_t t : triangles) upto[t] = sum / whole * parts, sum += coarse_.weight[t];
    const double from = start_of_sectors(upto, parts);
    for (const std::int32_t t : triangles) {
      std::int32_t& part = part_of_clump_[clump_.find(t)];
      if (part < 0) part = sector(upto[t], from, parts);
      part_[t] = part;
    }
    last_ = parts - 1;
  }

  static int sector(double upto, double from, int parts) {
    const auto k = static_cast<int>(upto + from);
    return k < parts ? k : k - parts;
  }

  // Start of the first sector, in sectors. On a single loop sectors may start anywhere; they start at the shortest
  // separators if these are much shorter. On several loops, the first sector starts with the first loop. Two sectors
  // start with the loop, too.
  [[nodiscard]] double start_of_sectors(const std::vector<double>& upto, int parts) const {
    double best = 0;
    if (parts < 4 || !is_one_loop()) return best;
    std::size_t least = 0;
    std::vector<int> sectors(n_);
    for (int k = 0; k < starts_of_sectors; ++k) {
      const double from = static_cast<double>(k) / starts_of_sectors;
      for (std::size_t t = 0; t < n_; ++t) sectors[t] = sector(upto[t], from, parts);
      std::size_t cut = 0;
      for (std::size_t t = 0; t < n_; ++t)
        for (const std::int32_t u : coarse_.beyond[t])
          if (u >= 0 && sectors[t] != sectors[u]) ++cut;
      if (k == 0)
        least = static_cast<std::size_t>(much_shorter * static_cast<double>(cut));
      else if (cut < least)
        least = cut, best = from;
    }
    return best;
  }
  [[nodiscard]] bool is_one_loop() const {
    const auto& edges = domain_.domain.edges;
    std::vector<std::int32_t> next(domain_.domain.vertices.size(), -1);
    for (const PlaneEdge& edge : edges) {
      if (edge.kind == PlaneEdgeKind::internal || next[edge.a] >= 0) return false;
      next[edge.a] = edge.b;
    }
    std::size_t passed = 1;
    for (std::int32_t v = next[edges[0].a]; v >= 0 && v != edges[0].a && passed <= edges.size(); v = next[v]) ++passed;
    return passed == edges.size();
  }

  // A triangle with two neighbours in one other part joins it.
  void smooth() {
    for (std::size_t t = 0; t < n_; ++t) {
      const auto& [a, b, c] = coarse_.beyond[t];
      const auto part_beyond = [&](std::int32_t u) { return u < 0 ? -1 : part_[u]; };
      const std::int32_t pa = part_beyond(a), pb = part_beyond(b), pc = part_beyond(c);
      const std::int32_t most = pa == pb || pa == pc ? pa : pb == pc ? pb : -1;
      if (most < 0 || most == part_[t]) continue;
      if (clump_.find(t) != t || is_clumped(t)) continue;
      part_[t] = most;
    }
  }
  [[nodiscard]] bool is_clumped(std::size_t t) {
    return std::any_of(coarse_.beyond[t].begin(), coarse_.beyond[t].end(),
                       [&](std::int32_t u) { return u >= 0 && clump_.find(u) == clump_.find(t); });
  }

  // The largest connected piece of each part stays; other pieces join the part beyond most of their sides.
  Partition connected() {
    std::vector<std::int32_t> piece(n_, -1), part_of;
    std::vector<double> weight;
    const auto flood = [&] {
      std::fill(piece.begin(), piece.end(), -1);
      part_of.clear(), weight.clear();
      for (std::size_t t = 0; t < n_; ++t) {
        if (piece[t] >= 0) continue;
        const auto id = static_cast<std::int32_t>(part_of.size());
        part_of.push_back(part_[t]);
        weight.push_back(0);
        queue_.assign(1, static_cast<std::int32_t>(t));
        piece[t] = id;
        for (std::size_t k = 0; k < queue_.size(); ++k) {
          weight[id] += coarse_.weight[queue_[k]];
          for (const std::int32_t u : coarse_.beyond[queue_[k]])
            if (u >= 0 && piece[u] < 0 && part_[u] == part_[t]) piece[u] = id, queue_.push_back(u);
        }
      }
    };
    for (int round = 0; round < 4; ++round) {
      monitor_.checkpoint();
      flood();
      std::vector<std::int32_t> largest(static_cast<std::size_t>(last_) + 1, -1);
      for (std::size_t id = 0; id < part_of.size(); ++id) {
        std::int32_t& best = largest[part_of[id]];
        if (best < 0 || weight[id] > weight[best]) best = static_cast<std::int32_t>(id);
      }
      std::vector<std::vector<std::int32_t>> sides(part_of.size());
      for (std::size_t t = 0; t < n_; ++t)
        for (const std::int32_t u : coarse_.beyond[t])
          if (u >= 0 && part_[u] != part_[t] && largest[part_[t]] != piece[t]) sides[piece[t]].push_back(part_[u]);
      std::vector<std::int32_t> to(part_of.size(), -1);
      bool any = false;
      for (std::size_t id = 0; id < sides.size(); ++id) {
        std::sort(sides[id].begin(), sides[id].end());
        std::ptrdiff_t most = 0;
        for (auto it = sides[id].begin(); it != sides[id].end();) {
          const auto end = std::upper_bound(it, sides[id].end(), *it);
          if (end - it > most) most = end - it, to[id] = *it, any = true;
          it = end;
        }
      }
      if (!any) break;
      for (std::size_t t = 0; t < n_; ++t)
        if (to[piece[t]] >= 0) part_[t] = to[piece[t]];
    }
    return numbered();
  }

  Partition numbered() {
    Partition result{.part = std::move(part_)};
    std::vector<std::int32_t> rank(static_cast<std::size_t>(last_) + 1, -1);
    for (std::int32_t& p : result.part) {
      if (rank[p] < 0) rank[p] = result.parts++;
      p = rank[p];
    }
    return result;
  }

  Monitor& monitor_;
  const CoarseMesh& coarse_;
  const CoarseDomain& domain_;
  std::size_t n_;
  UnionFind clump_;
  std::vector<std::int32_t> part_, part_of_clump_, queue_;
  std::int32_t last_ = 0;
};

}  // namespace

CoarseMesh make_coarse_mesh(const CoarseDomain& domain, const ControlSpace& metric, double length, Field::Known known,
                            const PlaneMesherOptions& options, Monitor& monitor) {
  UndividedWork work = work_undivided(domain.domain, metric, known, options, Improve::yes, monitor);
  Triangulation& triangulation = work.framed.mesh;
  triangulation.drop_removed();  // so that triangles keep their numbers
  CoarseMesh coarse{
      .mesh = to_mesh(domain.domain, triangulation, work.framed.frame), .beyond = {}, .metric = {}, .weight = {}};
  const std::size_t n = triangulation.triangles.size();
  coarse.beyond.reserve(n), coarse.metric.reserve(n), coarse.weight.reserve(n);
  for (std::size_t t = 0; t < n; ++t) {
    const auto& sides = triangulation.triangles[t].n;
    const auto beyond = [&](int i) { return sides[i] == no_edge ? -1 : sides[i] >> 2; };
    coarse.beyond.push_back({beyond(0), beyond(1), beyond(2)});
    const auto& [a, b, c] = coarse.mesh.triangles[t];
    const Vec2 p = coarse.mesh.vertices[a], q = coarse.mesh.vertices[b], r = coarse.mesh.vertices[c];
    const Metric2 m = metric.at((1.0 / 3) * (p + q + r));
    coarse.metric.push_back(m);
    coarse.weight.push_back(length * length * 2 / std::numbers::sqrt3 * cross(q - p, r - p) *
                            std::sqrt(std::max(determinant(m), 0.0)));
  }
  return coarse;
}

Partition divide(const CoarseMesh& coarse, const CoarseDomain& domain, int parts, Monitor& monitor) {
  return Division(coarse, domain, monitor).run(parts);
}

}  // namespace carreau::plane
