// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "arguments.h"
#include "carreau_geometry.h"
#include "geometry/grid/grid.h"
#include "guard.h"
#include "io/files.h"
#include "io/grid/grid_files.h"

using carreau::GridFormat;
using carreau::InvalidArgument;
using carreau::Level;
using namespace carreau::abi;

namespace {

/// The options that the caller set in carreau_grid_options; without them, the values of carreau_grid_options_init.
struct Asked {
  carreau::grid::Options options;
  std::int32_t measured = CARREAU_MEASURED_POINTS;
  double step = 0;
};

Asked asked_of(const carreau_grid_options* given) {
  Asked asked;
  if (given == nullptr) return asked;
  const carreau_grid_options known = read_struct(given, "carreau_grid_options");
  asked.measured = known.measured, asked.step = known.step;
  carreau::grid::Options& options = asked.options;
  options.smoothing.rounds = known.smoothing_rounds;
  if (known.smoothing_inward != 0 || known.smoothing_outward != 0)
    options.smoothing.inward = known.smoothing_inward, options.smoothing.outward = known.smoothing_outward;
  options.lengths = known.lengths != 0, options.orient = known.orient != 0;
  options.fill = known.fill != 0;
  constexpr double half_turn = 180;
  if (!(known.join_angle >= 0 && known.join_angle <= half_turn))
    throw InvalidArgument("the join_angle of a grid must lie between 0 and 180 degrees");
  options.join_angle = known.join_angle * std::numbers::pi / half_turn;
  options.tolerance = known.tolerance;
  if (known.continuity < 0 || known.continuity > 2)
    throw InvalidArgument("the continuity of a grid is " + std::to_string(known.continuity) + "; it must be 0, 1 or 2");
  options.splines = known.continuity == 2;
  options.smoothing.by_distance = known.smoothing_by_distance != 0;
  return asked;
}

void add(carreau_session& session, const carreau::grid::Grid& grid, const carreau::grid::Options& options) {
  session.monitor.begin_run();
  carreau::grid::GridGeometry made = build_grid_geometry(grid, options, session.monitor);
  for (const std::string& warning : made.warnings)
    session.monitor.message(Level::warning, (grid.source.empty() ? "" : grid.source + ": ") + warning);
  session.add_geometry(CARREAU_GEOMETRY_GRID, std::move(made.built.cad), std::move(made.built.model));
}

/// Longitude and latitude in degrees beside heights in metres: the surface would be a wall of needles.
bool may_be_in_degrees(const carreau::grid::Grid& grid) {
  carreau::Vec3 low = carreau::Vec3::Constant(HUGE_VAL), high = -low;
  for (const carreau::grid::Block& block : grid.blocks)
    for (const carreau::Vec3& node : block.nodes)
      if (carreau::is_finite(node)) low = low.cwiseMin(node), high = high.cwiseMax(node);
  constexpr double half_turn = 180, quarter = 90, steep = 10;
  const double extent = std::max(high.x() - low.x(), high.y() - low.y());
  return low.x() >= -half_turn && high.x() <= 2 * half_turn && low.y() >= -quarter && high.y() <= quarter &&
         high.z() - low.z() > steep * extent && extent > 0;
}

carreau::grid::Measured measured_of(std::int32_t given) {
  switch (given) {
    case CARREAU_MEASURED_POINTS:
      return carreau::grid::Measured::points;
    case CARREAU_MEASURED_HEIGHTS:
      return carreau::grid::Measured::heights;
    case CARREAU_MEASURED_RADII:
      return carreau::grid::Measured::radii;
    default:
      throw InvalidArgument("the kind of measured values of a grid is " + std::to_string(given) + "; it must be 0, 1 or 2");
  }
}

GridFormat format_of(std::int32_t given) {
  switch (given) {
    case CARREAU_GRID_BY_SUFFIX:
      return GridFormat::by_suffix;
    case CARREAU_GRID_PLOT3D:
      return GridFormat::plot3d;
    case CARREAU_GRID_HEIGHTS:
      return GridFormat::heights;
    case CARREAU_GRID_SCAN:
      return GridFormat::scan;
    case CARREAU_GRID_NODES:
      return GridFormat::nodes;
    default:
      throw InvalidArgument("the format of a grid is " + std::to_string(given) + "; it must lie between 0 and 4");
  }
}

}  // namespace

carreau_status carreau_add_grid(carreau_session* session, const carreau_grid_options* options, int64_t n,
                                const int32_t counts[], const double nodes[]) {
  return guarded(session, [&] {
    const Asked asked = asked_of(options);
    session->refuse_begun();
    if (n < 1) throw InvalidArgument("there is no block: n is " + std::to_string(n));
    required(counts, "counts"), required(nodes, "nodes");
    carreau::grid::Grid grid;
    const double* next = nodes;
    for (std::int64_t b = 0; b < n; ++b) {
      carreau::grid::Block block;
      block.columns = counts[2 * b], block.rows = counts[2 * b + 1];
      block.measured = measured_of(asked.measured);
      if (block.columns < 1 || block.rows < 1 || block.columns > std::numeric_limits<std::int32_t>::max() / block.rows)
        throw InvalidArgument("block " + std::to_string(b + 1) + " has " + std::to_string(block.columns) + " x " +
                              std::to_string(block.rows) + " nodes");
      const auto count = static_cast<std::size_t>(block.columns) * static_cast<std::size_t>(block.rows);
      for (std::size_t k = 0; k < count; ++k, next += 3) block.nodes.emplace_back(next[0], next[1], next[2]);
      grid.blocks.push_back(std::move(block));
    }
    add(*session, grid, asked.options);
  });
}

carreau_status carreau_load_grid(carreau_session* session, const carreau_grid_options* options, const char* path,
                                 int32_t format) {
  return guarded(session, [&] {
    const Asked asked = asked_of(options);
    session->refuse_begun();
    const double step = asked.step;
    if (!(step >= 0) || !std::isfinite(step)) throw InvalidArgument("the step of a grid must be finite and not negative");
    const carreau::grid::Grid grid = carreau::read_grid(required(path, "path"), format_of(format), step > 0 ? step : 1);
    if (carreau::suffix_of(path) == ".asc" && may_be_in_degrees(grid))
      session->monitor.message(Level::warning, std::string(path) + ": its nodes lie where degrees of longitude and latitude do, and heights vary by "
                                                                   "more than ten times their extent: project the grid to metres first");
    add(*session, grid, asked.options);
  });
}
