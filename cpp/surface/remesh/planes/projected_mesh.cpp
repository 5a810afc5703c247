// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/planes/projected_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "support/angles.h"
#include "support/error.h"
#include "support/ranks/triangle_packet.h"
#include "support/stepped_tasks.h"
#include "support/work_bounds.h"
#include "support/work_sizes.h"
#include "surface/remesh/division/place_packet.h"
#include "surface/remesh/planes/borders.h"
#include "surface/remesh/planes/chart_mesh.h"
#include "surface/remesh/planes/find_charts.h"
#include "surface/remesh/planes/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::planes;

/// The data of one chart.
struct ChartWork {
  std::vector<std::int32_t> triangles;  // of the atlas
  std::vector<const BorderChain*> chains;
  std::unique_ptr<ChartPlane> plane;
  std::string why;     // reason why its borders are invalid
  bool leans = false;  // it would be seen better in two
  bool kept = false;   // its triangles stay as they are
};

/// The result for a chart.
struct MadeChart {
  std::string why;                   // reason why the mesh is missing
  std::vector<std::int32_t> border;  // vertices of the mesh to come
  std::vector<SurfacePlace> inner;   // places of the vertices that follow
  TriangleList triangles;            // of the chart's own numbers
};

void put(PacketWriter& packet, const MadeChart& chart) {
  packet.put(std::string_view(chart.why));
  packet.put(chart.border);
  put_places(packet, chart.inner);
  put_triangles(packet, chart.triangles);
}

MadeChart get(PacketReader& packet) {
  MadeChart chart;
  chart.why = packet.text();
  chart.border = packet.integers();
  chart.inner = places_of(packet);
  chart.triangles = triangles_of(packet);
  return chart;
}

std::vector<ChartWork> charts_of(const ProjectedCharts& found, const Borders& borders) {
  std::vector<ChartWork> charts(found.axis.size());
  for (std::size_t t = 0; t < found.chart.size(); ++t) {
    charts[found.chart[t]].triangles.push_back(static_cast<std::int32_t>(t));
    charts[found.chart[t]].kept = found.kept[t] != 0;
  }
  for (const BorderChain& chain : borders.chains) {
    if (chain.left >= 0) charts[chain.left].chains.push_back(&chain);
    if (chain.right >= 0 && chain.right != chain.left) charts[chain.right].chains.push_back(&chain);
  }
  return charts;
}

// Places of the vertices on borders; others stay in place.
std::vector<Vec3> places_of(const SurfaceMesh& before, const Borders& borders) {
  std::vector<Vec3> xyz = before.vertices;
  for (std::size_t line = 0; line < borders.lines.size(); ++line)
    for (std::size_t k = 0; k < borders.lines[line].size(); ++k)
      if (const KeptPlaces& places = borders.on_line[line][k]; !places.empty())
        xyz[borders.lines[line][k].vertex] = places.front().xyz;
  for (const SurfacePlace& p : borders.added) xyz.push_back(p.xyz);
  return xyz;
}

double mean_size(const FlatAtlas& atlas, std::span<const std::int32_t> triangles, std::span<const double> size) {
  double sum = 0, weight = 0;
  for (const std::int32_t t : triangles)
    for (const std::int32_t v : atlas.at(t).vertex) sum += atlas.area[t] * size[v], weight += atlas.area[t];
  return weight > 0 ? sum / weight : size[atlas.at(triangles.front()).vertex[0]];
}

struct BorderSource {
  const FlatAtlas& atlas;
  std::span<const SharpLine> lines;
  std::span<const WorkedLine> worked;
  std::span<const double> size;
  SurfaceTolerances tolerance;
  int threads;
  Cad& cad;
  std::span<const std::int32_t> twin;
};

/// Charts with their borders in their planes; charts with invalid borders are wrong.
struct Plan {
  Borders borders;
  std::vector<Vec3> xyz;
  std::vector<ChartWork> charts;
  std::vector<std::int32_t> wrong, leaning;
  [[nodiscard]] std::string why() const {
    return std::to_string(wrong.size()) + " of " + std::to_string(charts.size()) + " charts, " +
           charts[wrong.front()].why;
  }
};

std::optional<Plan> planned(const BorderSource& source, const ProjectedCharts& found, Monitor& monitor) {
  std::vector<char> exact(found.axis.size(), 0), kept(source.atlas.mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < found.chart.size(); ++t) {
    exact[found.chart[t]] = std::max(exact[found.chart[t]], found.exact[t]);
    if (found.kept[t] != 0)
      for (const std::int32_t v : source.atlas.at(static_cast<std::int32_t>(t)).vertex) kept[v] = 1;
  }
  auto borders = cut_borders(
      {source.atlas, found, source.lines, source.worked, source.size, exact, kept, source.tolerance, source.cad,
       source.twin},
      monitor);
  if (!borders) return {};
  Plan plan{std::move(*borders), {}, {}, {}, {}};
  plan.charts = charts_of(found, plan.borders);
  plan.xyz = places_of(source.atlas.mesh, plan.borders);
  const auto work = [&](std::size_t c, Monitor& own) {
    ChartWork& chart = plan.charts[c];
    if (chart.kept) return;
    chart.plane = std::make_unique<ChartPlane>(
        source.atlas, found.axis[c], chart.triangles, mean_size(source.atlas, chart.triangles, source.size),
        std::ranges::any_of(chart.chains, [](const BorderChain* chain) { return chain->left == chain->right; }));
    try {
      check_borders({source.atlas, *chart.plane, chart.chains, chart.triangles, source.size,
                     static_cast<std::int32_t>(c), plan.xyz},
                    own);
      // A chart that was cut in two may now lie along its axis.
      if (exact[c] != 0 && chart.triangles.size() > 1 && chart.plane->min_cosine() < min_cosine) chart.leans = true;
    } catch (const DomainError& error) {
      chart.why = error.what();
    }
  };
  run_each(plan.charts.size(), false, source.threads, work, monitor);
  for (std::size_t c = 0; c < plan.charts.size(); ++c)
    if (plan.charts[c].leans) {
      plan.leaning.push_back(static_cast<std::int32_t>(c));
    } else if (!plan.charts[c].why.empty()) {
      plan.wrong.push_back(static_cast<std::int32_t>(c));
      monitor.message(Level::debug, "chart " + std::to_string(c) + " of " +
                                        std::to_string(plan.charts[c].triangles.size()) +
                                        " triangles: " + plan.charts[c].why);
    }
  return plan;
}

// Joins wrong charts to others. Charts that cannot be joined get exact borders. Charts that stay wrong are cut in two,
// and the triangles of small ones are kept. Returns false if no change is left.
bool mend(const FlatAtlas& atlas, const std::vector<std::int32_t>& wrong, ProjectedCharts& found, Monitor& monitor) {
  std::vector<char> is_wrong(found.axis.size(), 0);
  for (const std::int32_t c : wrong) is_wrong[c] = 1;
  std::vector<char> join = is_wrong;
  std::vector<std::int32_t> triangles;
  for (std::size_t t = 0; t < found.chart.size(); ++t)
    if (const std::int32_t c = found.chart[t]; is_wrong[c] != 0) {
      triangles.push_back(static_cast<std::int32_t>(t));
      if (found.exact[t] != 0) join[c] = 0;
    }
  const std::size_t before = found.axis.size();
  merge_charts(atlas, angles::cosine_of_78, join, found, monitor);
  bool changed = found.axis.size() < before;
  if (changed) return true;
  std::vector<std::size_t> members(found.axis.size(), 0);
  for (const std::int32_t t : triangles) ++members[found.chart[t]];
  std::vector<char> apart(found.axis.size(), 0), keep(found.chart.size(), 0);
  for (const std::int32_t t : triangles) {
    const std::int32_t c = found.chart[t];
    if (found.exact[t] == 0)
      found.exact[t] = 1, changed = true;
    else if (members[c] > small_piece)
      apart[c] = 1;
    else
      keep[t] = 1;
  }
  changed = split_charts(atlas, apart, found, monitor) || changed;
  return keep_triangles(atlas, keep, found) || changed;
}

bool keep_charts(const FlatAtlas& atlas, const std::vector<std::int32_t>& wrong, ProjectedCharts& found) {
  std::vector<char> is_wrong(found.axis.size(), 0), keep(found.chart.size(), 0);
  for (const std::int32_t c : wrong) is_wrong[c] = 1;
  for (std::size_t t = 0; t < keep.size(); ++t) keep[t] = is_wrong[found.chart[t]];
  return keep_triangles(atlas, keep, found);
}

// On the surface where the plane has it: patches swing out beside their triangles.
SurfacePlace lifted(const FlatAtlas& atlas, const ChartPlane& plane, const Foot& foot, const Vec2& wanted, Cad& cad) {
  const SurfacePlace first = atlas.charts.evaluate(cad, foot);
  const Vec2 miss = wanted - plane.project(first.xyz);
  if (!(norm(miss) > max_miss * atlas.charts.size(foot))) return first;
  const auto better = plane.find(wanted + miss);
  if (!better) return first;
  const SurfacePlace second = atlas.charts.evaluate(cad, *better);
  return norm(wanted - plane.project(second.xyz)) < norm(miss) ? second : first;
}

MadeChart kept_of(const FlatAtlas& atlas, const std::vector<std::int32_t>& number,
                  const std::vector<std::int32_t>& triangles) {
  MadeChart made;
  for (const std::int32_t t : triangles) {
    const auto first = static_cast<std::int32_t>(made.border.size());
    for (const std::int32_t v : atlas.at(t).vertex) made.border.push_back(number[v] >= 0 ? number[v] : v);
    made.triangles.push_back({first, first + 1, first + 2});
  }
  return made;
}

MadeChart made_of(const ChartInput& input, Cad& cad, Monitor& monitor) {
  MadeChart made;
  try {
    std::optional<ChartMesh> mesh = mesh_chart(input, monitor);
    if (!mesh) return {"it is folded", {}, {}, {}};
    for (std::size_t k = 0; k < mesh->inner.size(); ++k) {
      if (k % work_sizes::evaluations == 0) monitor.checkpoint();
      made.inner.push_back(lifted(input.atlas, input.plane, mesh->feet[k], mesh->inner[k], cad));
    }
    made.border = std::move(mesh->border), made.triangles = std::move(mesh->triangles);
  } catch (const DomainError& error) {
    made.why = error.what();
  }
  return made;
}

void append(const FlatAtlas& atlas, const MadeChart& chart, PlacedMesh& placed) {
  std::vector<std::int32_t> number = chart.border;
  for (const SurfacePlace& place : chart.inner) {
    number.push_back(static_cast<std::int32_t>(atlas.mesh.vertices.size() + placed.added.size()));
    placed.added.push_back(place);
  }
  for (const auto& t : chart.triangles) placed.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
}

// Charts that have no mesh, or triangles that run along an edge of their border the same way as a triangle of another
// chart.
std::vector<std::int32_t> without_mesh(const std::vector<MadeChart>& charts) {
  std::vector<std::array<std::int32_t, 3>> sides;  // start, end, chart
  std::vector<std::int32_t> wrong;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    if (!charts[c].why.empty()) wrong.push_back(static_cast<std::int32_t>(c));
    const auto border = static_cast<std::int32_t>(charts[c].border.size());
    for (const auto& t : charts[c].triangles)
      for (int i = 0; i < 3; ++i)
        if (const std::int32_t a = t[i], b = t[(i + 1) % 3]; a < border && b < border)
          sides.push_back({charts[c].border[a], charts[c].border[b], static_cast<std::int32_t>(c)});
  }
  std::ranges::sort(sides);
  for (std::size_t k = 1; k < sides.size(); ++k)
    if (sides[k][0] == sides[k - 1][0] && sides[k][1] == sides[k - 1][1])
      for (const std::size_t j : {k - 1, k}) wrong.push_back(sides[j][2]);
  std::ranges::sort(wrong);
  wrong.erase(std::unique(wrong.begin(), wrong.end()), wrong.end());
  return wrong;
}

// Charts fit together only where all processes cut the same surface by the same sizes.
void require_same_surface(const Executor& executor, const SurfaceMesh& mesh, std::span<const double> size) {
  const auto sum_of_surface = [&] {
    LongChecksum sum;
    sum.add(mesh.vertices);
    for (const double h : size) sum.add(std::bit_cast<std::uint64_t>(h));
    return sum.text();
  };
  executor.require_same<InvalidModel>("surface of charts", sum_of_surface, [](int rank) {
    return "the surface, or its sizes, differ on rank " + std::to_string(rank) +
           " from rank 0: its callbacks or parameters differ";
  });
}

}  // namespace

std::optional<PlacedMesh> make_projected_mesh(const RemeshingFrame& frame, const SurfaceMesh& before,
                                              std::span<const double> size, std::span<const WorkedLine> worked,
                                              const SurfaceTolerances& tolerances, const ProjectedOptions& options,
                                              Cad& cad, Monitor& monitor) {
  const auto refuse = [&](const std::string& why) -> std::optional<PlacedMesh> {
    monitor.message(Level::detail, "no parametric remeshing: " + why);
    return {};
  };
  require_same_surface(options.executor, before, size);
  const Charts& atlas = *frame.charts;
  if (std::ranges::any_of(atlas.triangles(), [](const Charts::Triangle& t) { return t.turned; }))
    return refuse("a face is turned");
  const FlatAtlas flat(atlas, before, frame.jets);
  const BorderSource source{
      flat, frame.lines, worked, size, tolerances, options.executor.threads, cad, frame.twin};
  ProjectedCharts found = find_charts(flat, monitor);
  if (!frame.kept.empty()) keep_triangles(flat, frame.kept, found);
  std::optional<Plan> plan;
  std::vector<MadeChart> charts;
  for (int round = 0;;) {
    plan = planned(source, found, monitor);
    if (!plan) return refuse("borders of charts are not divided");
    if (static_cast<double>(std::ranges::count(found.kept, 1)) > max_kept * flat.triangles())
      return refuse("charts do not project to planes");
    std::vector<std::int32_t> worse = plan->wrong;
    worse.insert(worse.end(), plan->leaning.begin(), plan->leaning.end());
    if (!worse.empty() && round++ < work_bounds::passes && mend(flat, worse, found, monitor)) continue;
    std::vector<std::int32_t>& wrong = plan->wrong;
    if (wrong.empty()) {
      const auto work = [&](std::size_t c, Monitor& own) {
        const ChartWork& chart = plan->charts[c];
        if (chart.kept) return kept_of(flat, plan->borders.number, chart.triangles);
        return made_of({flat, *chart.plane, chart.chains, chart.triangles, size, static_cast<std::int32_t>(c),
                        plan->xyz, options.max_triangles},
                       cad, own);
      };
      charts = shared_work<MadeChart>(options.executor, "charts", plan->charts.size(), !cad.reentrant(), work, put, get,
                                      monitor);
      wrong = without_mesh(charts);
      if (wrong.empty()) break;
    }
    if (!keep_charts(flat, wrong, found)) return refuse(plan->why());
  }
  PlacedMesh placed;
  placed.added = std::move(plan->borders.added);
  for (std::size_t k = 0; k < placed.added.size(); ++k)
    placed.seams.push_back(static_cast<std::int32_t>(before.vertices.size() + k));
  for (std::size_t c = 0; c < charts.size(); ++c) {
    monitor.checkpoint();
    append(flat, charts[c], placed);
    if (plan->charts[c].kept) placed.kept.insert(placed.kept.end(), charts[c].border.begin(), charts[c].border.end());
  }
  placed.lines = std::move(plan->borders.lines), placed.on_line = std::move(plan->borders.on_line);
  monitor.message(Level::detail, "parametric remeshing: " + std::to_string(plan->charts.size()) + " charts, " +
                                     std::to_string(placed.kept.size() / 3) + " triangles kept, " +
                                     std::to_string(placed.seams.size()) + " vertices of cuts, " +
                                     std::to_string(placed.triangles.size()) + " triangles");
  return placed;
}

}  // namespace carreau
