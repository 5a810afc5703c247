// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/strategies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/flat_mesh.h"
#include "metric/unit_edge.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "surface/remesh/base/thresholds.h"
#include "surface/remesh/certify/certification.h"
#include "surface/remesh/edits/edge_edits.h"
#include "surface/remesh/edits/remeshing.h"
#include "surface/remesh/edits/worst_first.h"
#include "surface/remesh/replacement.h"

namespace carreau {

namespace {

using namespace thresholds::remesh;

constexpr KeptShapes keep_none = KeptShapes::none, keep_worst = KeptShapes::worst, keep_all = KeptShapes::worst_and_mean;
constexpr std::array<Strategy, 6> between_patches{{{low_price, true, keep_none},
                                                   {low_price, true, keep_worst},
                                                   {low_price, true, keep_all},
                                                   {low_price, true, keep_all},
                                                   {low_price, true, keep_all},
                                                   {0, true, keep_all}}};
constexpr std::array<Strategy, 4> of_passing_triangles{
    {{high_price, false, keep_none}, {high_price, false, keep_none}, {low_price, true, keep_all}, {0, true, keep_all}}};
constexpr std::array<Strategy, 4> of_features{
    {{infinity, false, keep_none}, {infinity, false, keep_none}, {infinity, false, keep_none}, {infinity, false, keep_none}}};
constexpr Strategy of_seams{0, false, keep_none}, of_poor_planes{high_price, false, keep_none};

bool falls(double to, double from) { return to < from - rounding_of::places; }

double share_in_range(const CrossPatchMesh& mesh) {
  std::int64_t inside = 0, count = 0;
  for (const auto& t : mesh.triangles()) {
    if (t[0] < 0) continue;
    for (int i = 0; i < 3; ++i) {
      const double l = mesh.length(t[i], t[(i + 1) % 3]);
      inside += l >= unit_edge::shortest && l <= unit_edge::longest ? 1 : 0;
    }
    count += 3;
  }
  return count > 0 ? static_cast<double>(inside) / static_cast<double>(count) : 1;
}

ShapeBudget budget_of(const Strategy& strategy, const ShapeSummary& before) {
  ShapeBudget budget{.price = strategy.price, .mean = strategy.weighs_moves ? before.mean : good_shape};
  if (strategy.weighs_moves) budget.floor = std::min(before.worst, min_shape);
  if (strategy.kept != keep_none) budget.floor = before.worst;
  if (strategy.kept == keep_all) budget.left = 0;
  return budget;
}

class FrameRemesher {
 public:
  FrameRemesher(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, CompositeResult& result, Monitor& monitor)
      : frame_(frame), cad_(cad), options_(options), monitor_(monitor), replacement_(frame, cad, options, result, monitor) {}

  std::string by_strategies() {
    Candidate candidate = try_all();
    if (candidate.why.empty()) replacement_.accept(std::move(candidate));
    return candidate.why;
  }

  std::string from_planes(double min_mean) {
    std::int64_t first = 0, last = 0;
    bool keeps = false;
    std::optional<StartedMesh> mesh = made_in_planes(min_mean);
    for (int round = 0; mesh; ++round) {
      Candidate candidate = replacement_.judge(*mesh);
      if (!candidate.crosses) {
        if (candidate.why.empty()) replacement_.accept(std::move(candidate));
        return candidate.why;
      }
      if (frame_.elements) mesh->free = std::move(candidate.made.free), mesh->worked = std::move(candidate.made.worked);
      const std::int64_t found = candidate.crossings.count;
      monitor_.message(Level::debug, std::to_string(found) + " pairs of triangles cross");
      const bool stays = round > 0 && found >= last;
      const bool all_found = found == static_cast<std::int64_t>(candidate.crossings.pairs.size());
      if (round == max_untanglings || (stays && keeps) || !all_found) return "triangles would cross";
      if (round == 0) first = found;
      last = found;
      replacement_.guard(candidate);
      if (!stays) {
        untangle(*mesh->free, candidate);
        continue;
      }
      // Edits do not help: the triangles of the atlas stay there.
      keeps = true, last = first;
      keep_around(candidate);
      mesh = made_in_planes(min_mean);
    }
    return "parametric remeshing is not possible";
  }

  void keep_triangles() { replacement_.accept_as_it_is(replacement_.start()); }

 private:
  /// A mesh made by a strategy.
  struct Try {
    StartedMesh mesh;
    KeptShapes is_worse_in = KeptShapes::none;  ///< compared with the input mesh
    double in_range = 0;                        ///< share of the sides of triangles
    const Strategy* ended = nullptr;            ///< given up after the first round, since shapes had become worse; null: it is done
  };

  Candidate try_all() {
    // Coarse triangles cannot keep a geometric rule; after crossings the strategy starts without them.
    bool coarsely = !geometric_limits(options_.size).any();
    KeptShapes least = keep_none;  // the shapes that must be kept
    std::optional<Try> spare;      // the first one whose shapes are worse
    Candidate candidate;
    for (const Strategy& strategy : strategies(frame_.everywhere || frame_.elements, options_.sharp_angle)) {
      if (strategy.kept < least) continue;
      monitor_.checkpoint();
      Try tried = make(strategy, coarsely);
      coarsely = false;
      if (strategy.price < infinity && tried.is_worse_in > strategy.kept) {
        least = tried.is_worse_in;
        if (!spare) spare = std::move(tried);
        continue;
      }
      // Sizes take precedence over shapes.
      if (spare && tried.in_range < spare->in_range - max_range_for_shapes) {
        std::swap(tried, *spare);
        if (tried.ended != nullptr) remesh_between_lines(tried.mesh, *tried.ended, false, false, 1, 0);
      }
      candidate = certified(tried.mesh);
      if (candidate.why.empty()) return candidate;
      if (candidate.crosses) replacement_.guard(candidate);
    }
    return spare && (frame_.everywhere || frame_.elements) ? replacement_.judge(spare->mesh) : std::move(candidate);
  }

  Try make(const Strategy& strategy, bool coarsely) {
    StartedMesh start = replacement_.start();
    CrossPatchMesh& free = *start.free;
    const ShapeSummary before = summarise_shapes(free, options_.executor.threads, monitor_);
    free.budget = budget_of(strategy, before);
    // A larger loss of the mean is not recovered.
    const bool may_end = !frame_.everywhere && !frame_.elements && strategy.price < infinity && strategy.kept != keep_all;
    const bool coarse = coarsely && frame_.everywhere;
    if (!remesh_between_lines(start, strategy, coarse, coarse, 0, may_end ? before.mean - 2 * max_regained : 0)) {
      const double in_range = share_in_range(free);
      return {std::move(start), keep_all, in_range, &strategy};
    }
    raise_worst(free, before.worst + above_worst, monitor_);
    const ShapeSummary after = recover_mean(free, may_end ? before.mean : 0);
    const bool worst_falls = !frame_.everywhere && !frame_.elements && falls(after.worst, before.worst);
    const KeptShapes worse_in = falls(after.mean, before.mean) ? keep_all : worst_falls ? keep_worst : keep_none;
    const double in_range = share_in_range(free);
    return {std::move(start), worse_in, in_range};
  }

  // Returns false if the strategy is given up after the first round, since the mean has fallen below `least`.
  bool remesh_between_lines(StartedMesh& start, const Strategy& strategy, bool coarsely, bool thorough, int first, double least) {
    CrossPatchMesh& free = *start.free;
    RemeshingReport report;
    bool done = true;
    for (int round = first; round < max_line_rounds && done; ++round) {
      const std::vector<std::int32_t> changed = remesh_lines(free, start.worked, monitor_);
      if (round > 0 && changed.empty() && strategy.kept != keep_all) break;
      if (round == 0 && coarsely) report += remesh_coarsely(free);
      // Patches are done after the first round, but for the edges of lines.
      const std::span<const std::int32_t> around(changed.data(), round > 0 && frame_.everywhere ? changed.size() : 0);
      report += remesh_divided(free, frame_.workers, monitor_, frame_.everywhere, thorough, around);
      if (strategy.kept == keep_all) free.budget.price *= price_growth;
      done = round > first || !(least > 0) || summarise_shapes(free, options_.executor.threads, monitor_).mean >= least;
    }
    monitor_.message(Level::detail, "across borders: " + std::to_string(report.collapses) + " edges collapsed, " +
                                        std::to_string(report.splits) + " split, " + std::to_string(report.swaps) +
                                        " swapped, " + std::to_string(report.moves) + " moves of vertices, " +
                                        std::to_string(report.rounds) + " rounds");
    return done;
  }

  // Makes few triangles, with sizes that grow from the lines, and halves them: vertices that halve an edge have six neighbours, so
  // irregular vertices are as few as in the coarse mesh.
  RemeshingReport remesh_coarsely(CrossPatchMesh& free) {
    RemeshingReport report;
    for (int level = halvings; level > 0; --level) {
      const double times = std::exp2(level);
      std::vector<double> factor(replacement_.before().mesh.vertices.size(), times);
      for (const MeshEdge& e : frame_.sharp) factor[e[0]] = factor[e[1]] = 1;
      for (const std::int32_t v : frame_.corners) factor[v] = 1;
      frame_.charts->enlarge(frame_.charts->graded_factors(std::move(factor), 1));
      free.update_sizes();
      free.tighten(times);
      report += level == halvings ? RemeshingReport{} : halve(free, monitor_);
      report += remesh_divided(free, frame_.workers, monitor_, true, true);
    }
    frame_.charts->enlarge({});
    free.update_sizes();
    free.tighten(1);
    return report += halve(free, monitor_);
  }

  // If the mean has dropped slightly, smoothing recovers it.
  ShapeSummary recover_mean(CrossPatchMesh& mesh, double mean) {
    ShapeSummary now = summarise_shapes(mesh, options_.executor.threads, monitor_);
    for (const double below : regained_below) {
      if (!falls(now.mean, mean) || now.mean < mean - max_regained) break;
      polish(mesh, below, monitor_);
      now = summarise_shapes(mesh, options_.executor.threads, monitor_);
    }
    return now;
  }

  // Keeps the edits of the certification, or undoes all of them and guards the places where triangles would cross. The certified mesh is
  // judged first, since mostly it is accepted.
  Candidate certified(StartedMesh& mesh) {
    if (frame_.everywhere || frame_.elements || options_.certified == Certified::none) return replacement_.judge(mesh);
    Certifier certifier(*mesh.free, options_.certified == Certified::all, frame_.workers, monitor_);
    std::optional<Candidate> plain;  // without its edits
    for (int round = 0; round < max_certifications; ++round) {
      const Certification done = certifier.run();
      monitor_.message(Level::detail, "bounds of A0 and A1: " + std::to_string(done.beyond_before) + " triangles beyond, " +
                                          std::to_string(done.beyond) + " after " + std::to_string(done.swaps) + " swaps, " +
                                          std::to_string(done.moves) + " moves and " + std::to_string(done.splits) + " splits");
      if (!done.has_edits()) break;
      Candidate better = replacement_.judge(mesh);
      if (better.why.empty() && better.crossings.count == 0) {
        certifier.accept();
        return better;
      }
      certifier.undo();
      if (!plain) plain = replacement_.judge(mesh);
      if (!plain->why.empty()) break;
      const bool crosses = better.crossings.count > plain->crossings.count;
      if (better.why.empty() && !crosses) return better;
      if (!crosses) break;
      replacement_.guard(better);
    }
    return plain ? std::move(*plain) : replacement_.judge(mesh);
  }

  // The mesh of charts; its seams are remeshed, and its bad triangles.
  std::optional<StartedMesh> made_in_planes(double min_mean) {
    StartedMesh start{nullptr, replacement_.lines()};
    std::optional<PlacedMesh> placed = frame_.made(start.worked, replacement_.tolerances());
    if (!placed) return {};
    std::vector<MeshEdge> sharp;
    for (const std::vector<LineNode>& line : placed->lines)
      for (std::size_t k = 1; k < line.size(); ++k) sharp.push_back(mesh_edge(line[k - 1].vertex, line[k].vertex));
    std::ranges::sort(sharp);
    const CompositeResult& before = replacement_.before();
    start.free = std::make_unique<CrossPatchMesh>(before.mesh, frame_.jets, before.vertex_size, sharp, frame_.corners,
                                            replacement_.tolerances(), *frame_.charts, cad_, placed->added, std::move(placed->triangles));
    CrossPatchMesh& free = *start.free;
    for (std::size_t line = 0; line < start.worked.size(); ++line) {
      start.worked[line].left = std::move(placed->lines[line]);
      for (std::size_t k = 0; k < start.worked[line].left.size(); ++k)
        if (const KeptPlaces& at = placed->on_line[line][k]; !at.empty())
          free.put_kept(start.worked[line].left[k].vertex, at, free.wanted_at(at));
    }
    free.budget = budget_of(placed->kept.empty() ? of_seams : of_poor_planes, {});
    std::vector<std::int32_t> around = remesh_lines(free, start.worked, monitor_);
    around.insert(around.end(), placed->seams.begin(), placed->seams.end());
    around.insert(around.end(), placed->kept.begin(), placed->kept.end());
    if (!around.empty()) remesh(free, monitor_, true, false, around);
    if (summarise_shapes(free, options_.executor.threads, monitor_).mean < min_mean) {
      free.budget = budget_of(of_poor_planes, {});
      remesh_between_lines(start, of_poor_planes, false, true, 0, 0);
    }
    raise_worst(free, good_worst, monitor_);
    return start;
  }

  // Halves the longest edges of triangles that cross: their parts are nearer to the surface. Then the mesh around follows.
  void untangle(CrossPatchMesh& mesh, const Candidate& candidate) {
    mesh.update_guards();
    std::map<std::array<double, 3>, std::int32_t> at;
    const auto key = [](const Vec3& p) { return std::array{p[0], p[1], p[2]}; };
    for (const EditableMesh::Triangle& t : mesh.triangles())
      if (t[0] >= 0)
        for (const std::int32_t v : t) at.emplace(key(mesh.position(v)), v);
    const FlatMesh flat = flatten(candidate.made.mesh, false);
    std::vector<std::int32_t> around;
    for (const TriangleIntersection& pair : candidate.crossings.pairs)
      for (const std::int32_t t : pair.triangles) {
        std::array<std::pair<double, MeshEdge>, 3> edges;
        for (std::size_t i = 0; i < 3; ++i) {
          const std::int32_t v = at.at(key(flat.vertices[flat.triangles[t][i]])),
                             w = at.at(key(flat.vertices[flat.triangles[t][(i + 1) % 3]]));
          edges[i] = {-mesh.length(v, w), {v, w}};
          around.push_back(v);
        }
        std::ranges::sort(edges);
        for (const auto& [length, edge] : edges) {
          const auto quad = mesh.mesh().quad_between({0, edge[0]}, edge[1]);
          if (!quad) continue;
          const auto middle = halve_edge(mesh, *quad);
          if (!middle) continue;
          around.push_back(*middle);
          break;
        }
      }
    remesh(mesh, monitor_, true, false, around);
  }

  // Marks the triangles of the atlas that have a corner near a place where triangles cross.
  void keep_around(const Candidate& candidate) {
    const FlatMesh flat = flatten(candidate.made.mesh, false);
    const auto& triangles = frame_.charts->triangles();
    frame_.kept.assign(triangles.size(), 0);
    for (const TriangleIntersection& pair : candidate.crossings.pairs) {
      const double far = guarded_sizes * candidate.made.vertex_size[flat.triangles[pair.triangles[0]][0]];
      for (std::size_t t = 0; t < triangles.size(); ++t)
        if (std::ranges::any_of(triangles[t].vertex, [&](std::int32_t v) {
              return norm(replacement_.before().mesh.vertices[v] - pair.place) <= far;
            }))
          frame_.kept[t] = 1;
    }
  }

  RemeshingFrame& frame_;
  Cad& cad_;
  const CompositeOptions& options_;
  Monitor& monitor_;
  Replacement replacement_;
};

}  // namespace

std::span<const Strategy> strategies(bool triangles_pass, double sharp_angle) noexcept {
  if (sharp_angle > max_angle_of_price) return of_features;
  if (triangles_pass) return of_passing_triangles;
  return between_patches;
}

std::string remesh_by_strategies(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, CompositeResult& result,
                                 Monitor& monitor) {
  return FrameRemesher(frame, cad, options, result, monitor).by_strategies();
}

std::string remesh_from_planes(RemeshingFrame& frame, double min_mean, Cad& cad, const CompositeOptions& options,
                               CompositeResult& result, Monitor& monitor) {
  return FrameRemesher(frame, cad, options, result, monitor).from_planes(min_mean);
}

void make_elements_of_frame(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, CompositeResult& result,
                            Monitor& monitor) {
  FrameRemesher(frame, cad, options, result, monitor).keep_triangles();
}

}  // namespace carreau
