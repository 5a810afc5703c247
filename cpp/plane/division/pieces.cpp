// SPDX-License-Identifier: BSD-3-Clause
#include "plane/division/pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "plane/kernel/triangulation.h"
#include "plane/thresholds.h"

namespace carreau::plane {

namespace {

using Ends = std::pair<std::int32_t, std::int32_t>;

class PieceMaker {
 public:
  PieceMaker(const PlaneDomain& domain, const CoarseDomain& coarse, const CoarseMesh& mesh, const Partition& partition,
             const ControlSpace& unit)
      : domain_(domain), coarse_(coarse), mesh_(mesh), partition_(partition), unit_(unit) {}

  Pieces run() {
    for (std::size_t e = 0; e < coarse_.domain.edges.size(); ++e) {
      const PlaneEdge& edge = coarse_.domain.edges[e];
      imposed_[{std::min(edge.a, edge.b), std::max(edge.a, edge.b)}] = static_cast<std::int32_t>(e);
    }
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
      const auto found = imposed_.find({std::min(a, b), std::max(a, b)});
      if (found != imposed_.end())
        add_imposed(piece, found->second, a, u < 0 || other != part, u < t || other != part);
      else if (other != part)
        add_separator(piece, a, b, std::minmax(part, other));
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

  void add_separator(Piece& piece, std::int32_t a, std::int32_t b, Ends parts) {
    const std::vector<std::int32_t>& points = cut(std::min(a, b), std::max(a, b));
    const auto next = separators_.size();
    const auto of = static_cast<std::int32_t>(separators_.emplace(parts, next).first->second);
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

  // The vertices from a to b a unit apart.
  const std::vector<std::int32_t>& cut(std::int32_t a, std::int32_t b) {
    std::vector<std::int32_t>& points = cuts_[{a, b}];
    if (!points.empty()) return points;
    constexpr int samples = 8 * separator_length;
    const Vec2 p = mesh_.mesh.vertices[a], q = mesh_.mesh.vertices[b];
    double upto[samples + 1] = {0};
    for (int k = 0; k < samples; ++k)
      upto[k + 1] = upto[k] + length(unit_.at(lerp(p, q, (k + 0.5) / samples)), q - p) / samples;
    const int edges = std::max(1, static_cast<int>(std::lround(upto[samples])));
    points.reserve(static_cast<std::size_t>(edges) + 1);
    points.push_back(number_of(a));
    for (int j = 1, k = 0; j < edges; ++j) {
      const double at = upto[samples] * j / edges;
      while (k + 1 < samples && upto[k + 1] < at) ++k;
      points.push_back(add_vertex(lerp(p, q, (k + (at - upto[k]) / (upto[k + 1] - upto[k])) / samples)));
    }
    points.push_back(number_of(b));
    return points;
  }

  void number_locally(std::size_t p) {
    Piece& piece = result_.pieces[p];
    std::vector<std::int32_t>& whole = piece.whole;
    for (const PlaneEdge& edge : piece.domain.edges) whole.insert(whole.end(), {edge.a, edge.b});
    std::sort(whole.begin(), whole.end());
    whole.erase(std::unique(whole.begin(), whole.end()), whole.end());
    const auto n = static_cast<std::int32_t>(domain_.vertices.size());
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
  std::map<Ends, std::int32_t> imposed_;    // coarse edges, by their ends
  std::map<Ends, std::size_t> separators_;  // by the parts on both sides
  std::map<Ends, std::vector<std::int32_t>> cuts_;
  std::vector<std::int32_t> number_;  // by vertex of the coarse mesh; -1: none yet
  Pieces result_;
};

}  // namespace

Pieces make_pieces(const PlaneDomain& domain, const CoarseDomain& coarse, const CoarseMesh& mesh,
                   const Partition& partition, const ControlSpace& unit) {
  return PieceMaker(domain, coarse, mesh, partition, unit).run();
}

}  // namespace carreau::plane
