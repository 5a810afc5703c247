// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/lines/line_remeshing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "curve/unit_discretisation.h"
#include "support/infinity.h"
#include "surface/remesh/base/thresholds.h"
#include "surface/remesh/edits/judgement.h"

namespace carreau {

namespace {

using namespace thresholds::remesh;

class LineRemesher {
 public:
  LineRemesher(CrossPatchMesh& mesh, WorkedLine& line, Monitor& monitor)
      : mesh_(mesh),
        places_(*line.places),
        left_(line.left),
        closed_(line.closed),
        monitor_(monitor) {}

  std::vector<std::int32_t> run() {
    if (is_fixed()) return {};
    const int wanted = std::max(unit_edge_count(length()), closed_ ? 3 : 1);
    std::set<std::int32_t> refused;
    while (static_cast<int>(left_.size()) - 1 > wanted && collapse_shortest(refused)) monitor_.checkpoint();
    even_out();
    return changed_;
  }

 private:
  using Node = LineNode;

  // All vertices stay: triangles beside the line do.
  [[nodiscard]] bool is_fixed() const {
    return left_.size() > 2 && std::all_of(left_.begin() + 1, left_.end() - 1, [this](const Node& node) { return mesh_.mesh().is_corner(node.vertex); });
  }

  void even_out() {
    failed_.assign(left_.size(), {});
    for (std::size_t k = 0; k < left_.size(); ++k) rank_.emplace_back(left_[k].vertex, k);
    std::ranges::sort(rank_);
    for (int sweep = 0; sweep < line_sweeps; ++sweep) {
      bool any = false;
      for (std::size_t k = 1; k + 1 < left_.size(); ++k) {
        if (failed_[k] && mesh_.budget.left <= *failed_[k]) continue;
        monitor_.checkpoint();
        failed_[k] = mesh_.budget.left;
        if (!move(k)) continue;
        any = true;
        has_moved(left_[k].vertex);
      }
      if (!any) break;
    }
  }
  // Allows failed moves again around a vertex that has moved. They are also repeated if the budget has grown.
  void has_moved(std::int32_t v) {
    for (const CrossPatchMesh::Place p : mesh_.mesh().fan(v))
      for (const std::int32_t w : mesh_.mesh().at(p))
        for (auto at = std::ranges::lower_bound(rank_, std::pair{w, std::size_t{0}}); at != rank_.end() && at->first == w; ++at)
          failed_[at->second].reset();
  }

  [[nodiscard]] double length() const {
    double sum = 0;
    for (std::size_t k = 1; k < left_.size(); ++k) sum += mesh_.length(left_[k - 1].vertex, left_[k].vertex);
    return sum;
  }

  // The edge of a line leaves its curve no farther than the tolerance, or than one of the old edges.
  [[nodiscard]] double distance(const Node& p, const Node& q) const {
    return places_.distance(p.arc, q.arc, mesh_.position(p.vertex), mesh_.position(q.vertex));
  }
  [[nodiscard]] double tolerated(std::int32_t v, std::int32_t next) const {
    return mesh_.tolerances().deviation_at(mesh_.size_along(v, next));
  }

  /// A vertex inside the line that may be left out: beside the shortest edges, the shorter ones first.
  bool collapse_shortest(std::set<std::int32_t>& refused) {
    std::size_t best = 0;
    double shortest_pair = infinity;
    for (std::size_t k = 1; k + 1 < left_.size(); ++k) {
      if (refused.contains(left_[k].vertex)) continue;
      const double before = mesh_.length(left_[k - 1].vertex, left_[k].vertex),
                   after = mesh_.length(left_[k].vertex, left_[k + 1].vertex);
      const double worth = std::min(before, after) + 1e-3 * std::max(before, after);
      if (worth < shortest_pair) shortest_pair = worth, best = k;
    }
    if (best == 0) return false;
    if (!collapse(best)) refused.insert(left_[best].vertex);
    return true;
  }

  bool collapse(std::size_t k) {
    const Node &previous = left_[k - 1], &here = left_[k], &next = left_[k + 1];
    if (mesh_.length(previous.vertex, next.vertex) > never_longer) return false;
    const double allowed =
        std::max({tolerated(here.vertex, next.vertex), distance(previous, here), distance(here, next)});
    if (distance(previous, next) > allowed) return false;
    const bool back = mesh_.length(previous.vertex, here.vertex) <= mesh_.length(here.vertex, next.vertex);
    for (const Node& kept : {back ? previous : next, back ? next : previous})
      if (const auto cost = cost_of(here.vertex, kept.vertex); cost && mesh_.collapse(here.vertex, kept.vertex)) {
        mesh_.budget.pay(*cost);
        changed_.push_back(kept.vertex);
        left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(k));
        return true;
      }
    return false;
  }

  // Returns nothing if the collapse is not allowed. Shapes reject most collapses, so agreement is judged last.
  [[nodiscard]] std::optional<double> cost_of(std::int32_t gone, std::int32_t kept) const {
    Change change;
    judge_collapse(mesh_, gone, kept, &CrossPatchMesh::judge_shape, change);
    if (!change.keeps_shapes(min_shape())) return {};
    const std::optional<double> cost = cost_of_collapse(mesh_, gone, kept, change);
    if (!cost) return {};
    judge_collapse(mesh_, gone, kept, &CrossPatchMesh::judge_agreement, change);
    return change.keeps_surface() ? cost : std::nullopt;
  }

  [[nodiscard]] double min_shape() const { return std::max(thresholds::remesh::min_shape, mesh_.budget.floor); }

  // Returns whether the previous shapes are kept.
  [[nodiscard]] bool weighs_moves() const { return mesh_.budget.floor > 0 || mesh_.budget.is_limited(); }

  // Moves the vertex to the place where both edges have one length in the metric.
  bool move(std::size_t k) {
    const Node &previous = left_[k - 1], &next = left_[k + 1];
    Node& here = left_[k];
    const double p = mesh_.length(previous.vertex, here.vertex), q = mesh_.length(here.vertex, next.vertex);
    const double mean = (p + q) / 2;
    if (std::abs(p - q) < min_move * mean) return false;
    const double to = p > mean ? previous.arc + mean / p * (here.arc - previous.arc)
                               : next.arc - mean / q * (next.arc - here.arc);
    const double arc = here.arc;
    const TriangleShapes before = mesh_.judge_shapes_around(here.vertex), agreed = mesh_.judge_agreement_around(here.vertex);
    const int out = out_of_range(mesh_, here.vertex);
    for (const double share : {1.0, 0.5}) {
      here.arc = arc + share * (to - arc);
      const KeptPlaces places = places_.at(here.arc);
      if (places.empty()) break;
      Trial trial(mesh_);
      mesh_.put_kept(here.vertex, places, mesh_.wanted_at(places));
      const Change change{before, mesh_.judge_shapes_around(here.vertex)};
      const double cost = before.sum - change.after.sum;
      if (!is_worth(cost, out - out_of_range(mesh_, here.vertex)) || !change.keeps_shapes(min_shape()) ||
          !Change{agreed, mesh_.judge_agreement_around(here.vertex)}.keeps_surface())
        continue;
      trial.accept();
      mesh_.budget.pay(cost);
      changed_.push_back(here.vertex);
      return true;
    }
    here.arc = arc;
    return false;
  }

  // Compares the loss of shapes with the number of edges that come into range.
  [[nodiscard]] bool is_worth(double cost, int gain) const {
    return !weighs_moves() || (cost <= mesh_.budget.price * gain && mesh_.budget.affords(cost));
  }

  CrossPatchMesh& mesh_;
  LineGeometry& places_;
  std::vector<LineNode>& left_;
  bool closed_;
  Monitor& monitor_;
  std::vector<std::int32_t> changed_;
  std::vector<std::optional<double>> failed_;               // by rank in left_: the budget when a move failed
  std::vector<std::pair<std::int32_t, std::size_t>> rank_;  // of vertices in left_, ascending
};

}  // namespace

WorkedLine::WorkedLine(const SharpLine& line, std::unique_ptr<LineGeometry> geometry)
    : places(std::move(geometry)), closed(line.closed()) {
  if (places->is_known())
    for (std::size_t k = 0; k < line.vertices.size(); ++k) left.push_back({line.vertices[k], places->arcs()[k]});
}

std::vector<std::int32_t> remesh_lines(CrossPatchMesh& mesh, std::span<WorkedLine> lines, Monitor& monitor) {
  std::vector<std::int32_t> changed;
  for (WorkedLine& line : lines) {
    if (line.fixed || line.left.size() < 3) continue;
    const auto more = LineRemesher(mesh, line, monitor).run();
    changed.insert(changed.end(), more.begin(), more.end());
  }
  return changed;
}

}  // namespace carreau
