// SPDX-License-Identifier: BSD-3-Clause
#include "surface/independent/tries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "mesh/crossings/changed_triangles.h"
#include "mesh/crossings/shared_search.h"
#include "mesh/flat_mesh.h"
#include "model/bucket_sort.h"
#include "support/infinity.h"
#include "support/stepped_tasks.h"
#include "surface/independent/base/thresholds.h"
#include "surface/independent/certify/certification.h"
#include "surface/independent/edits/remeshing.h"
#include "surface/independent/edits/worst_first.h"

namespace carreau {

namespace {

using namespace thresholds::independent;

constexpr KeptShapes keep_none = KeptShapes::none, keep_worst = KeptShapes::worst, keep_all = KeptShapes::worst_and_mean;
constexpr std::array<Weighing, 6> between_patches{{{low_price, true, keep_none},
                                                   {low_price, true, keep_worst},
                                                   {low_price, true, keep_all},
                                                   {low_price, true, keep_all},
                                                   {low_price, true, keep_all},
                                                   {0, true, keep_all}}};
constexpr std::array<Weighing, 4> of_passing_triangles{
    {{high_price, false, keep_none}, {high_price, false, keep_none}, {low_price, true, keep_all}, {0, true, keep_all}}};
constexpr std::array<Weighing, 4> of_features{
    {{infinity, false, keep_none}, {infinity, false, keep_none}, {infinity, false, keep_none}, {infinity, false, keep_none}}};

/// Vertices - edges + triangles.
std::int64_t euler(const SurfaceMesh& mesh) {
  std::vector<MeshEdge> edges;
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles)
      for (int i = 0; i < 3; ++i) {
        edges.push_back(mesh_edge(face.vertex[t[i]], face.vertex[t[(i + 1) % 3]]));
        used[face.vertex[t[i]]] = 1;
      }
  bucket_sort(edges, mesh.vertices.size(), [](const MeshEdge& e) { return e[0]; });
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return std::ranges::count(used, 1) - static_cast<std::int64_t>(edges.size()) +
         static_cast<std::int64_t>(mesh.triangle_count());
}

// Makes a mesh of few triangles, with sizes that grow from the lines, and then halves it. Vertices that halve an edge have six neighbours,
// so that only the coarse mesh has irregular vertices.
RemeshingReport remesh_coarsely(FreeMesh& free, const SurfaceMesh& mesh, RemeshingFrame& frame, Monitor& monitor) {
  RemeshingReport report;
  for (int level = halvings; level > 0; --level) {
    const double times = std::exp2(level);
    std::vector<double> factor(mesh.vertices.size(), times);
    for (const MeshEdge& e : frame.sharp) factor[e[0]] = factor[e[1]] = 1;
    for (const std::int32_t v : frame.corners) factor[v] = 1;
    frame.charts->enlarge(frame.charts->graded_factors(std::move(factor), growth_of_coarse));
    free.update_sizes();
    free.tighten(times);
    report += level == halvings ? RemeshingReport{} : halve(free, monitor);
    report += remesh_divided(free, frame.workers, monitor, true, true);
  }
  frame.charts->enlarge({});
  free.update_sizes();
  free.tighten(1);
  return report += halve(free, monitor);
}

bool falls(double to, double from) { return to < from - rounding_of_mean; }

// If the mean quality dropped slightly, smoothing recovers it.
ShapeSummary regained(FreeMesh& mesh, double mean, int threads, Monitor& monitor) {
  ShapeSummary now = summarise_shapes(mesh, threads, monitor);
  for (const double below : regained_below) {
    if (!falls(now.mean, mean) || now.mean < mean - most_regained) break;
    polish(mesh, below, monitor);
    now = summarise_shapes(mesh, threads, monitor);
  }
  return now;
}

double share_in_range(const FreeMesh& mesh) {
  std::int64_t inside = 0, count = 0;
  for (const auto& t : mesh.triangles()) {
    if (t[0] < 0) continue;
    for (int i = 0; i < 3; ++i) {
      const double l = mesh.length(t[i], t[(i + 1) % 3]);
      inside += l >= shortest && l <= longest ? 1 : 0;
    }
    count += 3;
  }
  return count > 0 ? static_cast<double>(inside) / static_cast<double>(count) : 1;
}

}  // namespace

Intersections find_crossings(const SurfaceMesh& mesh, const CompositeOptions& options, Monitor& monitor) {
  const FlatMesh flat = flatten(mesh, false);
  return find_intersections(flat.vertices, flat.triangles, IntersectionOptions{}.limit, {options.team, options.threads}, monitor);
}

Intersections find_crossings(const SurfaceMesh& mesh, const CompositeResult& before, const CompositeOptions& options,
                            Monitor& monitor) {
  const auto known = static_cast<std::int64_t>(before.crossings.size());
  if (before.report.crossings != known) return find_crossings(mesh, options, monitor);
  std::vector<std::array<std::int32_t, 3>> triangles;  // as their numbers in the pairs are
  triangles.reserve(before.mesh.triangle_count());
  for (const FaceMesh& face : before.mesh.faces)
    for (const auto& [a, b, c] : face.triangles) triangles.push_back({face.vertex[a], face.vertex[b], face.vertex[c]});
  const FlatMesh flat = flatten(mesh, false);
  return find_intersections_again({before.mesh.vertices, triangles, before.crossings}, flat.vertices, flat.triangles,
                                  IntersectionOptions{}.limit, {options.team, options.threads}, monitor);
}

void guard_around(const Intersections& found, const FreedMesh& made, Charts& charts) {
  const FlatMesh flat = flatten(made.mesh, false);
  for (const TriangleIntersection& pair : found.pairs)
    charts.guard(pair.place, guarded_sizes * made.vertex_size[flat.triangles[pair.triangles[0]][0]]);
}

std::string why_worse(const SurfaceMesh& made, const SurfaceMesh& before, int threads, Monitor& monitor) {
  std::vector<std::string> defects;
  std::array<std::int64_t, 2> numbers{};
  const std::array<std::function<void()>, 3> work{[&] { defects = find_defects(made, {.closed = false, .limit = 1}); },
                                                  [&] { numbers[0] = euler(made); }, [&] { numbers[1] = euler(before); }};
  run_each(work.size(), false, threads, [&](std::size_t k, Monitor&) { work[k](); }, monitor);
  if (!defects.empty() && find_defects(before, {.closed = false, .limit = 1}).empty()) return defects.front();
  return numbers[0] != numbers[1] ? "its Euler number would differ" : "";
}

std::span<const Weighing> weighings(bool triangles_pass, double sharp_angle) noexcept {
  if (sharp_angle > most_angle_of_price) return of_features;
  if (triangles_pass) return of_passing_triangles;
  return between_patches;
}

StartedMesh start_free_mesh(Cad& cad, const SurfaceTolerances& tolerances, const CompositeResult& result, RemeshingFrame& frame) {
  StartedMesh start{std::make_unique<FreeMesh>(result.mesh, frame.jets, result.vertex_size, frame.sharp, frame.corners, tolerances,
                                               *frame.charts, cad),
                    {}};
  for (const SharpLine& line : frame.lines) start.worked.emplace_back(line, frame.geometry(line));
  return start;
}

FreedMesh reassembled(const SurfaceMesh& before, StartedMesh&& start, const RemeshingFrame& frame, Monitor& monitor) {
  CellsInSpace cells{*start.free, *frame.charts, start.free->cad(), {}, {}};
  for (const auto& t : start.free->triangles())
    if (t[0] >= 0) cells.cells.push_back({t[0], t[1], t[2], -1});
  FreedMesh made{reassemble(before, cells, frame.lines, start.worked, frame.corners, frame.workers, monitor)};
  if (frame.elements) made.free = std::move(start.free), made.worked = std::move(start.worked);
  return made;
}

Tries::Tries(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, const CompositeResult& result, Monitor& monitor)
    : frame_(frame),
      cad_(cad),
      options_(options),
      before_(result),
      monitor_(monitor),
      tolerances_(surface_tolerances(options, frame.charts->by_direction(), frame.angle_slack)),
      crossings_before_(result.report.crossings) {}

std::int64_t Tries::crossings_before() {
  if (crossings_before_ < 0) crossings_before_ = find_crossings(before_.mesh, options_, monitor_).count;
  return crossings_before_;
}

// Remeshes lines and the mesh between them, from round `first` on. False: it ended after the first round, since the
// mean fell below `least`.
bool Tries::remesh_between_lines(StartedMesh& start, const Weighing& weighing, bool coarsely, int first, double least) {
  FreeMesh& free = *start.free;
  const LineTolerance of_lines{tolerances_.deviation, tolerances_.share_of_size};
  RemeshingReport report;
  bool done = true;
  for (int round = first; round < most_line_rounds && done; ++round) {
    const std::vector<std::int32_t> changed = remesh_lines(free, start.worked, of_lines, monitor_);
    if (round > 0 && changed.empty() && weighing.kept != keep_all) break;
    if (round == 0 && coarsely && frame_.everywhere) report += remesh_coarsely(free, before_.mesh, frame_, monitor_);
    // Elsewhere the work is done after the first round.
    const std::span<const std::int32_t> around(changed.data(), round > 0 && frame_.everywhere ? changed.size() : 0);
    report += remesh_divided(free, frame_.workers, monitor_, frame_.everywhere, frame_.everywhere && coarsely, around);
    if (weighing.kept == keep_all) free.budget.price *= price_growth;
    done = round > first || !(least > 0) || summarise_shapes(free, options_.threads, monitor_).mean >= least;
  }
  monitor_.message(Level::detail, "across borders: " + std::to_string(report.collapses) + " edges collapsed, " +
                                      std::to_string(report.splits) + " split, " + std::to_string(report.swaps) +
                                      " swapped, " + std::to_string(report.moves) + " moves of vertices, " +
                                      std::to_string(report.rounds) + " rounds");
  return done;
}

Tries::Try Tries::make(const Weighing& weighing, bool coarsely) {
  StartedMesh start = start_free_mesh(cad_, tolerances_, before_, frame_);
  FreeMesh& free = *start.free;
  const ShapeSummary before = summarise_shapes(free, options_.threads, monitor_);
  free.budget = {.price = weighing.price, .mean = weighing.weighs_moves ? before.mean : good_shape};
  if (weighing.weighs_moves) free.budget.floor = std::min(before.worst, least_line_shape);
  if (weighing.kept != keep_none) free.budget.floor = before.worst;
  if (weighing.kept == keep_all) free.budget.left = 0;
  // A larger drop of the mean is not recovered.
  const bool may_end = !frame_.everywhere && !frame_.elements && weighing.price < infinity && weighing.kept != keep_all;
  if (!remesh_between_lines(start, weighing, coarsely, 0, may_end ? before.mean - most_lost_at_first : 0)) {
    const double in_range = share_in_range(free);
    return {std::move(start), keep_all, in_range, &weighing};
  }
  raise_worst(free, before.worst + above_worst, monitor_);
  const ShapeSummary after = regained(free, may_end ? before.mean : 0, options_.threads, monitor_);
  // Ignores the worst quality of input that no mesher made, and of triangles that other elements are made of.
  const bool worst_falls = !frame_.everywhere && !frame_.elements && falls(after.worst, before.worst);
  const KeptShapes worse_in = falls(after.mean, before.mean) ? keep_all : worst_falls ? keep_worst : keep_none;
  const double in_range = share_in_range(free);
  return {std::move(start), worse_in, in_range};
}

// Reassembles the mesh, with the reason if it must not replace the previous mesh.
Tries::Outcome Tries::put_together(StartedMesh& mesh) {
  Outcome outcome{reassembled(before_.mesh, std::move(mesh), frame_, monitor_), {}, "", false};
  outcome.crossings = find_crossings(outcome.made.mesh, before_, options_, monitor_);
  outcome.crosses = outcome.crossings.count > 0 && outcome.crossings.count > crossings_before();
  outcome.why = outcome.crosses ? "more triangles would cross" : why_worse(outcome.made.mesh, before_.mesh, options_.threads, monitor_);
  return outcome;
}

// Keeps all edits of the certification or none. If they would make triangles cross, their surroundings are not edited. The edited mesh is
// reassembled first, since it is mostly the result.
Tries::Outcome Tries::certified(StartedMesh& mesh) {
  if (frame_.everywhere || frame_.elements || options_.certified == Certified::none) return put_together(mesh);
  Certifier certifier(*mesh.free, options_.certified == Certified::all, frame_.workers, monitor_);
  std::optional<Outcome> plain;  // without its edits
  for (int round = 0; round < most_certifications; ++round) {
    const Certification done = certifier.run();
    monitor_.message(Level::detail, "bounds of A0 and A1: " + std::to_string(done.beyond_before) + " triangles beyond, " +
                                        std::to_string(done.beyond) + " after " + std::to_string(done.swaps) + " swaps, " +
                                        std::to_string(done.moves) + " moves and " + std::to_string(done.splits) + " splits");
    if (!done.has_edits()) break;
    Outcome better = put_together(mesh);
    if (better.why.empty() && better.crossings.count == 0) return better;
    certifier.undo();
    if (!plain) plain = put_together(mesh);
    if (!plain->why.empty()) break;
    const bool crosses = better.crossings.count > plain->crossings.count;
    if (better.why.empty() && !crosses) return better;
    if (!crosses) break;
    guard_around(better.crossings, better.made, *frame_.charts);
  }
  return plain ? std::move(*plain) : put_together(mesh);
}

Tries::Outcome Tries::run() {
  // Coarse triangles cannot keep a geometric rule; after crossings the strategy starts without them.
  bool coarsely = !geometric_limits(options_.size).any();
  KeptShapes least = keep_none;   // the shapes that must be kept
  std::optional<Try> spare;  // the first mesh whose shapes are worse than the previous shapes
  Outcome outcome;
  for (const Weighing& weighing : weighings(frame_.everywhere || frame_.elements, options_.sharp_angle)) {
    if (weighing.kept < least) continue;
    monitor_.checkpoint();
    Try tried = make(weighing, coarsely);
    coarsely = false;
    if (weighing.price < infinity && tried.is_worse_in > weighing.kept) {
      least = tried.is_worse_in;
      if (!spare) spare = std::move(tried);
      continue;
    }
    // Sizes take precedence over shapes.
    if (spare && tried.in_range < spare->in_range - most_range_for_shapes) {
      std::swap(tried, *spare);
      if (tried.ended != nullptr) remesh_between_lines(tried.mesh, *tried.ended, false, 1, 0);
    }
    outcome = certified(tried.mesh);
    if (outcome.why.empty()) return outcome;
    if (outcome.crosses) guard_around(outcome.crossings, outcome.made, *frame_.charts);
  }
  return spare && (frame_.everywhere || frame_.elements) ? put_together(spare->mesh) : std::move(outcome);
}

}  // namespace carreau
