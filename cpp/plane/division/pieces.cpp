// SPDX-License-Identifier: BSD-3-Clause
#include "plane/division/pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "plane/kernel/thresholds.h"
#include "plane/kernel/triangulation.h"
#include "predicates/clamped_int.h"

namespace carreau::plane {

namespace {

// Samples of the metric along separators, whose points are a unit apart.
constexpr double samples_a_unit = 8;

using Ends = std::pair<std::int32_t, std::int32_t>;
using Known = std::pair<Ends, std::int32_t>;

class PieceMaker {
 public:
  PieceMaker(const PlaneDomain& domain, const CoarseDomain& coarse, const CoarseMesh& mesh, const Partition& partition,
             const ControlSpace& unit, double edge)
      : domain_(domain),
        coarse_(coarse),
        mesh_(mesh),
        partition_(partition),
        unit_(unit),
        upto_(static_cast<std::size_t>(std::ceil(samples_a_unit * edge)) + 1, 0) {}

  Pieces run() {
    imposed_.reserve(coarse_.domain.edges.size());
    for (std::size_t e = 0; e < coarse_.domain.edges.size(); ++e) {
      const PlaneEdge& edge = coarse_.domain.edges[e];
      imposed_.push_back({std::minmax(edge.a, edge.b), static_cast<std::int32_t>(e)});
    }
    std::sort(imposed_.begin(), imposed_.end());
    cut_.assign(3 * mesh_.mesh.triangles.size(), no_cut);
    result_.pieces.resize(static_cast<std::size_t>(partition_.parts));
    result_.separator.assign(domain_.vertices.size(), Pieces::none);
    number_.assign(mesh_.mesh.vertices.size(), -1);
    for (std::size_t v = 0; v < coarse_.fine.size(); ++v) number_[v] = coarse_.fine[v];
    for (std::size_t t = 0; t < mesh_.mesh.triangles.size(); ++t) add_triangle(static_cast<std::int32_t>(t));
    for (std::size_t p = 0; p < result_.pieces.size(); ++p) number_locally(p);
    return std::move(result_);
  }

 private:
  void add_triangle(std::int32_t t) {
    const std::int32_t part = partition_.part[t];
    Piece& piece = result_.pieces[part];
    piece.triangles += mesh_.weight[t];
    for (const std::int32_t v : mesh_.mesh.triangles[t])  // imposed points that lie on no edge, too
      if (static_cast<std::size_t>(v) < coarse_.fine.size()) piece.whole.push_back(coarse_.fine[v]);
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = mesh_.mesh.triangles[t][next3[i]], b = mesh_.mesh.triangles[t][prev3[i]];
      const std::int32_t u = mesh_.beyond[t][i], other = u < 0 ? -1 : partition_.part[u];
      if (const std::int32_t edge = find(imposed_, std::minmax(a, b)); edge >= 0)
        add_imposed(piece, edge, a, u < 0 || other != part, u < t || other != part);
      else if (other != part)
        add_separator(piece, t, i);
    }
  }

  // The side a - ... of a triangle of this piece.
  void add_imposed(Piece& piece, std::int32_t coarse, std::int32_t a, bool border, bool first) {
    if (!first) return;
    const auto edges = coarse_.edges_of(static_cast<std::size_t>(coarse));
    const bool forwards = coarse_.domain.edges[coarse].a == a;
    std::int32_t v = coarse_.fine[coarse_.domain.edges[coarse].a];
    for (const int e : edges) {
      PlaneEdge edge = domain_.edges[e];
      const std::int32_t w = edge.a == v ? edge.b : edge.a;
      if (border && edge.kind == PlaneEdgeKind::internal) {
        edge.kind = PlaneEdgeKind::boundary;
        edge.a = forwards ? v : w, edge.b = forwards ? w : v;
      }
      piece.domain.edges.push_back(edge);
      v = w;
    }
  }

  // Side i of t.
  void add_separator(Piece& piece, std::int32_t t, int i) {
    const std::int32_t a = mesh_.mesh.triangles[t][next3[i]], b = mesh_.mesh.triangles[t][prev3[i]];
    const std::span<const std::int32_t> points = points_on(t, i);
    const std::int32_t of = separator_between(std::minmax(partition_.part[t], partition_.part[mesh_.beyond[t][i]]));
    for (const std::int32_t v : points) {
      std::int32_t& known = result_.separator[v];
      known = known == Pieces::none || known == of ? of : Pieces::several;
    }
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      PlaneEdge edge{.a = points[k], .b = points[k + 1]};
      if (a > b) std::swap(edge.a, edge.b);
      piece.domain.edges.push_back(edge);
    }
  }

  std::int32_t add_vertex(Vec2 p) {
    result_.separators.push_back(p);
    result_.separator.push_back(Pieces::none);
    return static_cast<std::int32_t>(result_.separator.size()) - 1;
  }
  std::int32_t number_of(std::int32_t v) {
    if (number_[v] < 0) number_[v] = add_vertex(mesh_.mesh.vertices[v]);
    return number_[v];
  }

  // -1: not there.
  static std::int32_t find(const std::vector<Known>& sorted, Ends ends) {
    const auto found = std::lower_bound(sorted.begin(), sorted.end(), Known{ends, -1});
    return found != sorted.end() && found->first == ends ? found->second : -1;
  }
  std::int32_t separator_between(Ends parts) {
    if (const std::int32_t known = find(separators_, parts); known >= 0) return known;
    const Known fresh{parts, static_cast<std::int32_t>(separators_.size())};
    separators_.insert(std::lower_bound(separators_.begin(), separators_.end(), fresh), fresh);
    return fresh.second;
  }

  // The vertices on side i of t, from the end with the lower number. The triangle beyond has the same ones.
  std::span<const std::int32_t> points_on(std::int32_t t, int i) {
    const std::int32_t u = mesh_.beyond[t][i];
    const auto& sides = mesh_.beyond[u];
    const auto j = static_cast<std::int32_t>(std::find(sides.begin(), sides.end(), t) - sides.begin());
    std::int32_t& start = cut_[3 * t + i];
    if (start == no_cut) {
      start = cut_[3 * u + j] = static_cast<std::int32_t>(points_.size());
      const auto [a, b] = std::minmax(mesh_.mesh.triangles[t][next3[i]], mesh_.mesh.triangles[t][prev3[i]]);
      points_.push_back(0);
      cut(a, b);
      points_[start] = static_cast<std::int32_t>(points_.size()) - start - 1;
    }
    return std::span<const std::int32_t>(points_).subspan(static_cast<std::size_t>(start) + 1,
                                                          static_cast<std::size_t>(points_[start]));
  }
  // Adds the vertices from a to b, a unit apart, to the points.
  void cut(std::int32_t a, std::int32_t b) {
    const Vec2 p = mesh_.mesh.vertices[a], q = mesh_.mesh.vertices[b];
    const auto samples = static_cast<int>(upto_.size()) - 1;
    for (int k = 0; k < samples; ++k)
      upto_[k + 1] = upto_[k] + length(unit_.at(lerp(p, q, (k + 0.5) / samples)), q - p) / samples;
    const double whole = upto_.back();
    const int edges = clamped_int(std::round(whole), 1, std::numeric_limits<int>::max());
    points_.push_back(number_of(a));
    for (int j = 1, k = 0; j < edges; ++j) {
      const double at = whole * j / edges;
      while (k + 1 < samples && upto_[k + 1] < at) ++k;
      points_.push_back(add_vertex(lerp(p, q, (k + (at - upto_[k]) / (upto_[k + 1] - upto_[k])) / samples)));
    }
    points_.push_back(number_of(b));
  }

  void number_locally(std::size_t p) {
    Piece& piece = result_.pieces[p];
    std::vector<std::int32_t>& whole = piece.whole;
    whole.reserve(whole.size() + 2 * piece.domain.edges.size());
    for (const PlaneEdge& edge : piece.domain.edges) whole.insert(whole.end(), {edge.a, edge.b});
    std::sort(whole.begin(), whole.end());
    whole.erase(std::unique(whole.begin(), whole.end()), whole.end());
    const auto n = static_cast<std::int32_t>(domain_.vertices.size());
    piece.domain.vertices.reserve(whole.size()), piece.on_separator.reserve(whole.size());
    for (const std::int32_t v : whole) {
      piece.domain.vertices.push_back(v < n ? domain_.vertices[v] : result_.separators[v - n]);
      piece.on_separator.push_back(v < n ? 0 : 1);
    }
    const auto local = [&](int v) {
      return static_cast<int>(std::lower_bound(whole.begin(), whole.end(), v) - whole.begin());
    };
    for (PlaneEdge& edge : piece.domain.edges) edge.a = local(edge.a), edge.b = local(edge.b);
  }

  const PlaneDomain& domain_;
  const CoarseDomain& coarse_;
  const CoarseMesh& mesh_;
  const Partition& partition_;
  const ControlSpace& unit_;
  static constexpr std::int32_t no_cut = -1;
  std::vector<Known> imposed_;        // coarse edges, by their ends
  std::vector<Known> separators_;     // by the parts on both sides
  std::vector<std::int32_t> points_;  // of each cut their number, then themselves
  std::vector<std::int32_t> cut_;     // their starts, by triangle and side
  std::vector<std::int32_t> number_;  // by vertex of the coarse mesh; -1: none yet
  std::vector<double> upto_;          // the length of an edge up to each of its samples
  Pieces result_;
};

}  // namespace

Pieces make_pieces(const PlaneDomain& domain, const CoarseDomain& coarse, const CoarseMesh& mesh,
                   const Partition& partition, const ControlSpace& unit, double edge) {
  return PieceMaker(domain, coarse, mesh, partition, unit, edge).run();
}

}  // namespace carreau::plane
