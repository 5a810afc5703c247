// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "geometry/grid/grid_cad.h"
#include "geometry/grid/holes.h"
#include "geometry/grid/interpolation.h"
#include "geometry/grid/orientation.h"
#include "geometry/grid/thresholds.h"
#include "support/error.h"
#include "support/rounding_of.h"
#include "support/shares.h"

namespace carreau::grid {

namespace {

std::string block_name(std::size_t block) { return "block " + std::to_string(block + 1); }

void check(const Grid& grid) {
  if (grid.blocks.empty()) throw InvalidArgument("there is no block of a grid");
  for (std::size_t b = 0; b < grid.blocks.size(); ++b) {
    const Block& block = grid.blocks[b];
    const Where where{.file = grid.source, .line = block.line};
    if (block.columns < 2 || block.rows < 2)
      throw InvalidArgument(where, block_name(b) + " has " + std::to_string(block.columns) + " x " +
                                       std::to_string(block.rows) + " nodes; a surface needs two rows and two columns");
    if (block.nodes.size() != static_cast<std::size_t>(block.columns) * static_cast<std::size_t>(block.rows))
      throw InvalidArgument(where, block_name(b) + " has " + std::to_string(block.nodes.size()) + " nodes and not " +
                                       std::to_string(block.columns) + " x " + std::to_string(block.rows));
    for (std::size_t k = 0; k < block.nodes.size(); ++k)
      for (const double x : block.nodes[k])
        if (std::isinf(x))
          throw InvalidArgument(where, block_name(b) + ", node (" +
                                           std::to_string(k % static_cast<std::size_t>(block.columns) + 1) + ", " +
                                           std::to_string(k / static_cast<std::size_t>(block.columns) + 1) +
                                           ") is not finite");
  }
}

void check(const Options& options) {
  const Smoothing& s = options.smoothing;
  if (s.rounds < 0) throw InvalidArgument("the number of rounds of smoothing is negative");
  if (s.rounds > 0 && !(s.inward >= 0 && s.inward < 1 && s.outward >= 0 && s.outward < 1))
    throw InvalidArgument("the weights of smoothing must lie between 0 and 1");
  if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
    throw InvalidArgument("the tolerance of a grid must be finite and not negative");
  if (!(options.join_angle >= 0)) throw InvalidArgument("the angle of joints must not be negative");
}

/// The tolerance that is meant by 0.
double usual_tolerance(const std::vector<Block>& blocks) {
  Vec3 low = Vec3::Constant(HUGE_VAL), high = Vec3::Constant(-HUGE_VAL);
  for (const Block& block : blocks)
    for (const Vec3& p : block.nodes)
      if (is_finite(p)) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double same = rounding_of::sizes * norm(high - low);
  double shortest = HUGE_VAL;
  const auto look_at = [&](const Vec3& p, const Vec3& q) {
    const double length = norm(q - p);
    if (length > same * rounding_of::sizes) shortest = std::min(shortest, length);
  };
  for (const Block& block : blocks)
    for (int j = 0; j < block.rows; ++j)
      for (int i = 0; i < block.columns; ++i) {
        if (i + 1 < block.columns && block.has(i, j) && block.has(i + 1, j)) look_at(block.node(i, j), block.node(i + 1, j));
        if (j + 1 < block.rows && block.has(i, j) && block.has(i, j + 1)) look_at(block.node(i, j), block.node(i, j + 1));
      }
  return std::min(same, shares::notable * shortest);
}

void warn(const std::vector<Cells>& cells, GridGeometry& made) {
  for (std::size_t b = 0; b < cells.size(); ++b) {
    const Cells& c = cells[b];
    if (c.folded > 0)
      made.warnings.push_back(std::to_string(c.folded) + (c.folded == 1 ? " cell folds: " : " cells fold, the first is ") +
                              Block::place(b, c.folded_i, c.folded_j));
    if (c.flat > 0)
      made.warnings.push_back(std::to_string(c.flat) +
                              (c.flat == 1 ? " cell is a line and left out: " : " cells are lines and left out, the first is ") +
                              Block::place(b, c.flat_i, c.flat_j));
    if (c.missing > 0)
      made.warnings.push_back(std::to_string(c.missing) + (c.missing == 1 ? " cell of " : " cells of ") + block_name(b) +
                              (c.missing == 1 ? " lacks" : " lack") + " a node and " + (c.missing == 1 ? "is" : "are") +
                              " left out");
    if (c.regions.empty()) made.warnings.push_back(block_name(b) + " has no cell with four nodes and is left out");
    if (c.regions.size() > 1)
      made.warnings.push_back("holes cut " + block_name(b) + " into " + std::to_string(c.regions.size()) +
                              " parts; each is a separate face");
  }
}

SideLine line_of(const Chain& chain, const CoonsSurface& surface) {
  const auto place = [&](const BorderEdge::NodeAt& at) -> Vec2 {
    return {surface.u[static_cast<std::size_t>(at.i)], surface.v[static_cast<std::size_t>(at.j)]};
  };
  return {place(chain.edges.front().start()), place(chain.edges.back().end())};
}

void add_faces(const std::vector<Block>& blocks, const Borders& borders, std::vector<CoonsSurface> surfaces,
               BuiltGeometry& built) {
  auto cad = std::make_shared<GridCad>();
  std::vector<std::shared_ptr<const CoonsSurface>> shared;
  for (CoonsSurface& surface : surfaces) shared.push_back(std::make_shared<const CoonsSurface>(std::move(surface)));
  int next = static_cast<int>(blocks.size()) + 1;
  for (std::size_t f = 0; f < borders.faces.size(); ++f) {
    const FaceRegion& at = borders.faces[f];
    const auto b = static_cast<std::size_t>(at.block);
    Face face;
    face.ref = at.region == 0 ? at.block + 1 : next++, face.name = blocks[b].name;
    if (at.region > 0) face.part_of = at.block + 1;
    std::vector<SideLine> sides;
    for (const Chain& chain : borders.chains[f]) {
      face.curves.push_back({.ref = chain.curve, .end1 = chain.start, .end2 = chain.end});
      sides.push_back(line_of(chain, *shared[b]));
    }
    cad->add(face.ref, shared[b], std::move(sides));
    built.model.faces.push_back(std::move(face));
  }
  built.cad = std::move(cad);
}

void fill(Block& block, const Closed& closed, std::size_t b, Monitor& monitor, GridGeometry& made) {
  if (const std::size_t filled = fill_holes(block, closed, monitor); filled > 0)
    made.warnings.push_back(std::to_string(filled) + (filled == 1 ? " missing node of " : " missing nodes of ") +
                            block_name(b) + (filled == 1 ? " was filled" : " were filled"));
}

/// Turns blocks over where normals disagree, and finds their cells and borders again.
void orient(std::vector<Block>& blocks, std::vector<Cells>& cells, Borders& borders, double tolerance) {
  const std::vector<char> turned = blocks_to_turn(blocks, cells, borders);
  if (std::find(turned.begin(), turned.end(), 1) == turned.end()) return;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (turned[b] == 0) continue;
    turn_over(blocks[b]);
    cells[b] = find_cells(blocks[b]);
  }
  borders = find_borders(blocks, cells, tolerance);
}

}  // namespace

std::string Block::place(std::size_t block, int i, int j) {
  return block_name(block) + ", cell (" + std::to_string(i + 1) + ", " + std::to_string(j + 1) + ")";
}

GridGeometry build_grid_geometry(const Grid& grid, const Options& options, Monitor& monitor) {
  check(grid), check(options);
  std::vector<Block> blocks = grid.blocks;
  const double tolerance = options.tolerance > 0 ? options.tolerance : usual_tolerance(blocks);
  GridGeometry made;
  std::vector<Closed> closed;
  for (Block& block : blocks) {
    closed.push_back(closed_directions(block, tolerance));
    if (options.fill) fill(block, closed.back(), closed.size() - 1, monitor, made);
    smooth_block(block, closed.back(), options.smoothing, monitor);
  }
  std::vector<Cells> cells;
  for (const Block& block : blocks) cells.push_back(find_cells(block));
  warn(cells, made);
  if (std::all_of(cells.begin(), cells.end(), [](const Cells& c) { return c.count == 0; }))
    throw InvalidModel(Where{.file = grid.source}, "the grid has no cell with four nodes");
  monitor.checkpoint();
  Borders borders = find_borders(blocks, cells, tolerance);
  if (options.orient) orient(blocks, cells, borders, tolerance);
  const std::vector<Knots> knots = find_knots(blocks, borders, options.lengths);
  std::size_t joined = 0;
  std::vector<CoonsSurface> surfaces = interpolate(blocks, borders, knots, closed, options, &joined);
  monitor.message(Level::detail, std::to_string(blocks.size()) + " blocks, " + std::to_string(borders.faces.size()) +
                                     " faces, " + std::to_string(joined) + " common borders made smooth");
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (cells[b].count < (blocks[b].nodes.size() - static_cast<std::size_t>(blocks[b].columns + blocks[b].rows - 1)))
      surfaces[b].cells = cells[b].there;
  add_faces(blocks, borders, std::move(surfaces), made.built);
  return made;
}

}  // namespace carreau::grid
