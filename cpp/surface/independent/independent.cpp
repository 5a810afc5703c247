// SPDX-License-Identifier: BSD-3-Clause
#include "surface/independent/independent.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "mesh/flat_mesh.h"
#include "mesh/intersections.h"
#include "model/bucket_sort.h"
#include "support/infinity.h"
#include "surface/independent/line_remeshing.h"
#include "surface/independent/placed_mesh.h"
#include "surface/independent/reassembly.h"
#include "surface/independent/remeshing.h"
#include "surface/independent/thresholds.h"
#include "surface/independent/worst_first.h"

namespace carreau {

namespace {

using namespace thresholds::independent;

Intersections crossings(const SurfaceMesh& mesh, int threads, Monitor& monitor) {
  const FlatMesh flat = flatten(mesh, false);
  return find_intersections(flat.vertices, flat.triangles, {.threads = threads}, monitor);
}

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

// What the patches were meshed with, at their vertices; none where it is of no direction.
PlaneMetrics metrics_of(const CompositeResult& result, const VertexJets& jets) {
  PlaneMetrics metrics(result.mesh.faces.size());
  double most = 1;
  for (std::size_t f = 0; f < metrics.size(); ++f) {
    const FaceMesh& face = result.mesh.faces[f];
    for (std::size_t k = 0; k < face.uv.size() && k < jets[f].size(); ++k) {
      const double h = result.vertex_size[face.vertex[k]];
      metrics[f].push_back(result.spaces[f] ? plane_metric(jets[f][k], result.spaces[f]->at(face.uv[k]), h)
                                            : plane_metric(jets[f][k], induced_metric(jets[f][k].su, jets[f][k].sv, h), h));
      most = std::max(most, anisotropy(metrics[f].back()));
    }
  }
  return most > least_anisotropy ? metrics : PlaneMetrics{};
}

RemeshingFrame frame_of(const CurveModel& model, const CompositeOptions& options, bool by_direction,
                        const CompositeResult& result, Monitor& monitor) {
  const SurfaceMesh& mesh = result.mesh;
  RemeshingFrame frame{.jets = evaluate_vertices(mesh, model.cad, monitor), .sharp = {}, .charts = {}, .corners = {}, .lines = {}, .geometry = {}};
  const double angle = options.sharp_angle;
  frame.sharp = find_sharp_edges(mesh, frame.jets, angle);
  const PlaneMetrics metrics = by_direction ? metrics_of(result, frame.jets) : PlaneMetrics{};
  const auto link = [&] {
    frame.charts = std::make_shared<Charts>(mesh, frame.sharp, result.vertex_size, metrics, monitor);
  };
  link();
  if (const std::vector<MeshEdge> twisted = frame.charts->twisted(); !twisted.empty()) {
    frame.sharp.insert(frame.sharp.end(), twisted.begin(), twisted.end());
    std::ranges::sort(frame.sharp);
    link();
  }
  const Topology* known = mesh.curves.size() == model.topology.curves.size() ? &model.topology : nullptr;
  frame.corners = find_corners(mesh, frame.jets, *frame.charts, frame.sharp, known, model.supports, angle);
  frame.lines = find_lines(mesh, frame.sharp, frame.corners);
  return frame;
}

void give_makers(const CurveModel& model, std::span<const DiscreteCurve> curves, const ElementMaker& elements, const CompositeResult& result,
                 RemeshingFrame& frame) {
  if (elements) frame.elements = [&](const SurfaceMesh& before, FreedMesh& made) { elements(before, frame, made); };
  frame.geometry = [&, curves](const SharpLine& line) {
    return std::make_unique<LinePlaces>(line, result.mesh, model, curves, *frame.charts, model.cad);
  };
}

// Of few triangles, with sizes that grow from the lines, which are then halved: vertices that halve an edge have six neighbours,
// and irregular ones are as few as there are of the coarse mesh.
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

struct Start {
  std::unique_ptr<FreeMesh> free;
  std::vector<WorkedLine> worked;
};

Start free_mesh_of(Cad& cad, const SurfaceTolerances& tolerances, const CompositeResult& result, RemeshingFrame& frame) {
  Start start{std::make_unique<FreeMesh>(result.mesh, frame.jets, result.vertex_size, frame.sharp, frame.corners, tolerances,
                                         *frame.charts, cad),
              {}};
  for (const SharpLine& line : frame.lines) start.worked.emplace_back(line, frame.geometry(line));
  return start;
}

// Of the triangles that are left.
FreedMesh reassembled(const SurfaceMesh& before, Start&& start, const RemeshingFrame& frame, Monitor& monitor) {
  CellsInSpace cells{*start.free, *frame.charts, start.free->cad(), {}, {}};
  for (const auto& t : start.free->triangles())
    if (t[0] >= 0) cells.cells.push_back({t[0], t[1], t[2], -1});
  FreedMesh made{reassemble(before, cells, frame.lines, start.worked, frame.corners, monitor)};
  if (frame.elements) made.free = std::move(start.free), made.worked = std::move(start.worked);
  return made;
}

// Sizes beside edges of lines that could not be as long as wanted: theirs, growing from there.
void grade_beside_short_edges(FreeMesh& free, std::span<const WorkedLine> lines, double growth, std::size_t vertices, Charts& charts) {
  std::vector<double> factor(vertices, 1);
  for (const WorkedLine& line : lines)
    for (std::size_t k = 1; k < line.left.size(); ++k) {
      const std::int32_t v = line.left[k - 1].vertex, w = line.left[k].vertex;
      const double l = free.length(v, w);
      for (const std::int32_t end : {v, w}) factor[end] = std::min(factor[end], l);
    }
  charts.enlarge(charts.graded_factors(std::move(factor), growth));
  free.update_sizes();
}

/// How lengths and shapes are weighed where they are at odds.
struct Compromise {
  double price;                ///< SurfaceTolerances::price_of_length
  double growth = infinity;    ///< of sizes beside what stays short, which are smaller there
  [[nodiscard]] bool graded() const noexcept { return growth < infinity; }
};

FreedMesh freed(Cad& cad, SurfaceTolerances tolerances, const Compromise& compromise, bool coarsely,
                const CompositeResult& result, RemeshingFrame& frame, Monitor& monitor) {
  tolerances.price_of_length = compromise.price;
  auto [mesh, worked] = free_mesh_of(cad, tolerances, result, frame);
  FreeMesh& free = *mesh;
  const LineTolerance of_lines{tolerances.deviation, tolerances.share_of_size};
  RemeshingReport report;
  const ShapeSummary before = summarise_shapes(free);
  for (int round = 0; round < most_line_rounds; ++round) {
    const std::vector<std::int32_t> changed = remesh_lines(free, worked, of_lines, monitor);
    if (round > 0 && changed.empty()) break;
    if (round == 0 && compromise.graded())
      grade_beside_short_edges(free, worked, compromise.growth, result.mesh.vertices.size(), *frame.charts);
    else if (round == 0 && frame.everywhere && coarsely) report += remesh_coarsely(free, result.mesh, frame, monitor);
    // Elsewhere nothing is left to do after the first round.
    const std::span<const std::int32_t> around(changed.data(), round > 0 && frame.everywhere ? changed.size() : 0);
    report += remesh_divided(free, frame.workers, monitor, frame.everywhere, frame.everywhere && coarsely, around);
  }
  raise_worst(free, before.worst + above_worst, monitor);
  monitor.message(Level::detail, "across borders: " + std::to_string(report.collapses) + " edges collapsed, " +
                                     std::to_string(report.splits) + " split, " + std::to_string(report.swaps) +
                                     " swapped, " + std::to_string(report.moves) + " moves of vertices, " +
                                     std::to_string(report.rounds) + " rounds");
  if (compromise.graded()) {
    frame.charts->enlarge({});
    free.update_sizes();
  }
  const bool worse_shaped = summarise_shapes(free).mean < before.mean;
  FreedMesh made = reassembled(result.mesh, {std::move(mesh), std::move(worked)}, frame, monitor);
  made.worse_shaped = worse_shaped;
  return made;
}

// The mesh that was made elsewhere: its seams are mended, and what is bad.
std::optional<FreedMesh> mended(Cad& cad, const SurfaceTolerances& tolerances, double least_mean, const CompositeResult& result,
                                RemeshingFrame& frame, Monitor& monitor) {
  std::vector<WorkedLine> worked;
  for (const SharpLine& line : frame.lines) worked.emplace_back(line, frame.geometry(line));
  std::optional<PlacedMesh> placed = frame.made(worked, tolerances);
  if (!placed) return {};
  std::vector<MeshEdge> sharp;
  for (const std::vector<LineNode>& line : placed->lines)
    for (std::size_t k = 1; k < line.size(); ++k) sharp.push_back(mesh_edge(line[k - 1].vertex, line[k].vertex));
  std::ranges::sort(sharp);
  auto mesh = std::make_unique<FreeMesh>(result.mesh, frame.jets, result.vertex_size, sharp, frame.corners, tolerances, *frame.charts,
                                         cad, placed->added, std::move(placed->triangles));
  for (std::size_t line = 0; line < worked.size(); ++line) {
    worked[line].left = std::move(placed->lines[line]);
    for (std::size_t k = 0; k < worked[line].left.size(); ++k)
      if (const KeptPlaces& at = placed->on_line[line][k]; !at.empty())
        mesh->put_kept(worked[line].left[k].vertex, at, mesh->wanted_at(at));
  }
  std::vector<std::int32_t> around = remesh_lines(*mesh, worked, {tolerances.deviation, tolerances.share_of_size}, monitor);
  around.insert(around.end(), placed->seams.begin(), placed->seams.end());
  if (!around.empty()) remesh(*mesh, monitor, true, false, around);
  raise_worst(*mesh, good_worst, monitor);
  const bool poor = summarise_shapes(*mesh).mean < least_mean;
  FreedMesh made = reassembled(result.mesh, {std::move(mesh), std::move(worked)}, frame, monitor);
  made.worse_shaped = poor;
  return made;
}

// Around triangles that cross.
void guard(const Intersections& found, const FreedMesh& made, Charts& charts) {
  const FlatMesh flat = flatten(made.mesh, false);
  for (const TriangleIntersection& pair : found.pairs)
    charts.guard(pair.place, guarded_sizes * made.vertex_size[flat.triangles[pair.triangles[0]][0]]);
}

// Why a mesh is worse than the one that it is to replace; empty: it is not. Triangles that cross are told from others.
std::string worse(const SurfaceMesh& made, const SurfaceMesh& before) {
  const std::vector<std::string> defects = find_defects(made, {.closed = false, .limit = 1});
  if (!defects.empty() && find_defects(before, {.closed = false, .limit = 1}).empty()) return defects.front();
  return euler(made) != euler(before) ? "its Euler number would differ" : "";
}

void take(FreedMesh&& made, RemeshingFrame& frame, CompositeResult& result, Monitor& monitor) {
  for (std::size_t f = 0; f < made.mesh.faces.size(); ++f)
    if (made.mesh.faces[f].status != result.mesh.faces[f].status)
      monitor.message(Level::warning, made.mesh.faces[f].why);
  static_cast<SizedMesh&>(result) = std::move(made);
  result.atlas = std::move(frame.charts);
}

}  // namespace

SurfaceTolerances surface_tolerances(const CompositeOptions& options, bool by_direction, double angle_slack) {
  const GeometricLimits limits = geometric_limits(options.size);
  // What is folded by less than the sharp angle may be flattened.
  const double folded = std::min(usual_angle / 2 + options.sharp_angle, most_angle);
  SurfaceTolerances tolerances{.angle_deg = std::max(usual_angle, folded), .deviation = 0, .share_of_size = usual_deviation};
  if (std::isfinite(limits.edge_angle_deg)) tolerances.angle_deg = limits.edge_angle_deg * angle_slack;
  if (std::isfinite(limits.deviation)) tolerances.deviation = limits.deviation;
  if (by_direction && !options.size.geo_guarantee) tolerances.angle_deg = std::max(tolerances.angle_deg, leaning_angle);
  return tolerances;
}

void make_elements_of_frame(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, CompositeResult& result,
                            Monitor& monitor) {
  const SurfaceTolerances tolerances = surface_tolerances(options, frame.charts->by_direction(), frame.angle_slack);
  FreedMesh made = reassembled(result.mesh, free_mesh_of(cad, tolerances, result, frame), frame, monitor);
  if (frame.elements) frame.elements(result.mesh, made);
  take(std::move(made), frame, result, monitor);
}

std::string mend_in_frame(RemeshingFrame& frame, double least_mean, Cad& cad, const CompositeOptions& options,
                          CompositeResult& result, Monitor& monitor) {
  const SurfaceTolerances tolerances = surface_tolerances(options, frame.charts->by_direction(), frame.angle_slack);
  std::optional<FreedMesh> made = mended(cad, tolerances, least_mean, result, frame, monitor);
  if (!made) return "it is not made in planes";
  const Intersections found = crossings(made->mesh, options.threads, monitor);
  if (found.count > 0 && found.count > crossings(result.mesh, options.threads, monitor).count) return "triangles would cross";
  if (made->worse_shaped) return "shapes would be poor";
  std::string why = worse(made->mesh, result.mesh);
  if (!why.empty()) return why;
  if (result.report.crossings >= 0) result.report.crossings = found.count, result.crossings = found.pairs;
  take(std::move(*made), frame, result, monitor);
  return "";
}

std::string remesh_in_frame(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, CompositeResult& result,
                            Monitor& monitor) {
  SurfaceTolerances tolerances = surface_tolerances(options, frame.charts->by_direction(), frame.angle_slack);
  frame.workers = {options, cad};
  // Those of the mesh before, when somebody has to know.
  auto known = [&, count = result.report.crossings]() mutable {
    return count >= 0 ? count : count = crossings(result.mesh, options.threads, monitor).count;
  };
  std::vector<Compromise> compromises =
      options.sharp_angle > most_angle_of_price
          ? std::vector<Compromise>{{infinity}}
          : std::vector<Compromise>{{high_price}, {low_price}, {low_price, fast_growth}, {low_price, slow_growth}};
  std::size_t compromise = 0;
  FreedMesh made;
  std::string why = "more triangles would cross";
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    monitor.checkpoint();
    // Coarse triangles cannot keep a geometric rule, and where some crossed others none are made.
    const bool ruled = geometric_limits(options.size).any();
    if (attempt + 1 == most_attempts && compromises.size() > 1)  // the mesh that changes least is the likeliest not to cross
      compromises = {{low_price, slow_growth}}, compromise = 0;
    for (;; ++compromise) {
      FreedMesh tried = freed(cad, tolerances, compromises[compromise], attempt == 0 && !ruled, result, frame, monitor);
      if (compromise > 0 && tried.worse_shaped && compromises[compromise].growth == slow_growth) {  // it costs lengths, and is of no use then
        compromises.resize(compromise);
        --compromise;
        break;
      }
      made = std::move(tried);
      if (!made.worse_shaped || compromise + 1 == compromises.size()) break;
    }
    const Intersections found = crossings(made.mesh, options.threads, monitor);
    const bool crosses = found.count > 0 && found.count > known();
    if (!crosses) why = worse(made.mesh, result.mesh);
    if (compromise > 0 && compromises[compromise].graded() && (crosses || !why.empty())) {  // as if it had not been tried
      compromises.resize(compromise);
      --compromise, --attempt;
      continue;
    }
    if (!crosses) {
      if (why.empty() && result.report.crossings >= 0)
        result.report.crossings = found.count, result.crossings = found.pairs;
      break;
    }
    guard(found, made, *frame.charts);
  }
  if (!why.empty()) return why;
  if (frame.elements) {
    frame.elements(result.mesh, made);
    result.report.crossings = -1;  // those of straight triangles say nothing of these
    result.crossings.clear();
  }
  take(std::move(made), frame, result, monitor);
  return "";
}

bool free_from_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                       bool by_direction, const ElementMaker& elements, CompositeResult& result, Monitor& monitor) {
  RemeshingFrame frame = frame_of(model, options, by_direction, result, monitor);
  give_makers(model, curves, elements, result, frame);
  const std::string why = remesh_in_frame(frame, model.cad, options, result, monitor);
  if (!why.empty()) monitor.message(Level::warning, "the mesh stays as its patches made it: " + why);
  return why.empty();
}

void free_elements_from_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                                bool by_direction, const ElementMaker& elements, CompositeResult& result, Monitor& monitor) {
  RemeshingFrame frame = frame_of(model, options, by_direction, result, monitor);
  give_makers(model, curves, elements, result, frame);
  make_elements_of_frame(frame, model.cad, options, result, monitor);
}

}  // namespace carreau
