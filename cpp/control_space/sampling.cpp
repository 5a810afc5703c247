// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "control_space/thresholds.h"
#include "metric/metric2_algebra.h"
#include "support/error.h"
#include "support/infinity.h"
#include "support/pieces.h"
#include "support/rounding_of.h"
#include "support/shares.h"
#include "support/work_sizes.h"

namespace carreau::detail {

namespace {

using namespace thresholds::control_space;

// Samples that a split takes at most: 4 middles, 4 centres, 8 boundary vertices.
constexpr double costliest_split = 16;

// Numbers of cells are computed from metrics, which must be finite.
void require_finite(Metric2 m, const Vec2& uv) {
  if (!std::isfinite(m.a) || !std::isfinite(m.b) || !std::isfinite(m.c))
    throw DomainError({.uv = uv}, "the metric of the parameter domain is not finite");
}

}  // namespace

ControlSpaceSampling::ControlSpaceSampling(const SampledDomain& domain, const SurfaceSampler& sampler, bool on_surface,
                                           const ControlSpaceOptions& options, Monitor& monitor)
    : domain_(domain),
      locator_(domain.vertices, domain.edges),
      sampler_(sampler),
      on_surface_(on_surface),
      options_(options),
      monitor_(monitor),
      vertex_sampled_(domain.vertices.size(), 0) {
  // Fewer samples do not follow any field. [Limits.NoiseAndJumpsCostAtMostTheSamplesAllowed]
  options_.max_samples = std::max<std::size_t>(options_.max_samples, 1000);
}

void ControlSpaceSampling::run() {
  const Survey s = survey(
      domain_, locator_, [this](std::span<const Vec2> uv) { return ask(uv); }, on_surface_);
  choose_grid(s);
  for (std::size_t k = 0; k < s.vertices.size(); ++k) {
    border_->add(lattice_->position(domain_.vertices[s.vertices[k]]), root_of_boxed(s.metrics[k]));
    const Metric2 m = s.metrics[k];
    keep_border(s.vertices[k], {m.a / (box_.x() * box_.x()), m.b / (box_.x() * box_.y()), m.c / (box_.y() * box_.y())},
                k);
    vertex_sampled_[s.vertices[k]] = 1;
  }
  sample_roots();
  std::vector<std::int32_t> active;
  for (std::int32_t c = 0; c < tree_->size(); ++c)
    if ((*tree_)[c].relevant) active.push_back(c);
  balance_cells(std::move(active));
  look_at_probe_points();
}

// Tests leaves and splits them until all pass.
void ControlSpaceSampling::balance_cells(std::vector<std::int32_t> active) {
  while (!active.empty()) {
    test(active);
    estimate_vertices();
    active = refine(affordable(std::move(active), 0));
  }
}

// The metric of a probe point counts too: the samples that the leaf has may all lie around the hidden detail.
void ControlSpaceSampling::look_at_probe_points() {
  std::vector<Vec2> uv;
  for (const Vec2& p : options_.probe_points)
    if (locator_.contains(p)) uv.push_back(p);
  if (samples_left() < static_cast<double>(uv.size())) return;
  std::vector<Metric2> roots = ask(uv);
  for (Metric2& root : roots) root = root_of(root);
  for (int round = 0; round < rounding_of::halvings && !uv.empty(); ++round) {
    std::vector<std::int32_t> cells;
    for (std::size_t k = 0; k < uv.size(); ++k) {
      const std::int32_t leaf = tree_->leaf_at(lattice_->unit_cell(uv[k]));
      if (leaf < 0 || !(*tree_)[leaf].relevant || !tree_->can_split(leaf)) continue;
      const double vertices = std::max((*tree_)[leaf].vertices, vertices_of((*tree_)[leaf], roots[k]));
      // Cells at probe points are split while they are wider than half an edge. [surface: SteepPlaces]
      if (std::sqrt(vertices * area_per_vertex) > 0.5) cells.push_back(leaf);
    }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    if (cells.empty() || samples_left() < costliest_split * static_cast<double>(cells.size())) return;
    balance_cells(refine(cells));
  }
}

void ControlSpaceSampling::choose_grid(const Survey& s) {
  vertices_ = std::max(s.vertices_in_box * s.share, 1.0);
  double cells = std::min(vertices_, std::sqrt(vertices_ * many_vertices)) / usual_vertices_per_cell;
  cells = std::max(cells, static_cast<double>(options_.min_samples) / samples_per_cell);
  cells = std::min(cells, static_cast<double>(options_.max_samples) / (2 * samples_per_cell));
  vertices_per_cell_ = vertices_ / cells;
  // Powers of four are left to the tree, so that large cells remain possible where the mesh is coarse.
  double coarsest = std::max(cells / s.share, min_cells);
  const auto shorter_side = [&](double count) { return std::sqrt(count * std::min(s.aspect, 1 / s.aspect)); };
  while (coarsest >= 4 * min_cells && shorter_side(coarsest / 4) >= min_side) coarsest /= 4;
  const auto side = [](double count) {
    return static_cast<int>(std::clamp(std::round(count), double{min_side}, 1024.));
  };
  // The side that is rounded most comes first, so that the product remains.
  int columns, rows;
  if (s.aspect >= 1) {
    rows = side(std::sqrt(coarsest / s.aspect));
    columns = side(coarsest / rows);
  } else {
    columns = side(std::sqrt(coarsest * s.aspect));
    rows = side(coarsest / columns);
  }
  std::int32_t step = 1 << 20;
  // Units of the finest grid: places are whole numbers, and cells have at most 2^20 of them.
  while (step > (1 << 29) / std::max(columns, rows)) step /= 2;
  lattice_.emplace(s.low, s.high, columns, rows, step, locator_);
  border_.emplace(*lattice_);
  tree_.emplace(domain_, locator_, *lattice_);
  predictor_.emplace(*lattice_, *tree_);
  floor_ = s.floor;
  box_ = s.high - s.low;
}

std::vector<Metric2> ControlSpaceSampling::ask(std::span<const Vec2> uv) {
  std::vector<Metric2> metric(uv.size());
  if (on_surface_) last_tangents_.resize(uv.size());
  for_pieces(uv.size(), work_sizes::searches, [&](std::size_t start, std::size_t n) {
    monitor_.checkpoint();
    sampler_(uv.subspan(start, n), std::span(metric).subspan(start, n),
             on_surface_ ? std::span(last_tangents_).subspan(start, n) : std::span<SurfaceTangents>{});
    for (std::size_t k = start; k < start + n; ++k) require_finite(metric[k], uv[k]);
    samples_ += n;
  });
  return metric;
}

// Root in units of the coarsest cells, from a metric in units of the box.
Metric2 ControlSpaceSampling::root_of_boxed(Metric2 m) const noexcept {
  return root_in_cells(clamp_eigenvalues(m, floor_, std::numeric_limits<double>::max()));
}

Metric2 ControlSpaceSampling::root_in_cells(Metric2 boxed) const noexcept {
  const double columns = tree_->columns(), rows = tree_->rows();
  return square_root({boxed.a / (columns * columns), boxed.b / (columns * rows), boxed.c / (rows * rows)});
}

Metric2 ControlSpaceSampling::root_of(Metric2 m) const noexcept { return root_of_boxed(boxed(m)); }

// Model lengths, not edges: the least metric is no bound here, because it would matter in small models.
Metric2 ControlSpaceSampling::root_of_form(Metric2 form) const noexcept { return root_in_cells(boxed(form)); }

void ControlSpaceSampling::sample_roots() {
  std::vector<char> wanted(static_cast<std::size_t>(lattice_->size()), 1);
  std::vector<std::int32_t> nodes;
  std::vector<Vec2> uv;
  for (std::int32_t c = 0; c < tree_->size(); ++c) {
    if (!(*tree_)[c].relevant) continue;
    for (const int k : corners_of_cell) {
      const std::int32_t n = (*tree_)[c].node[k];
      if (wanted[n] == 0) continue;
      wanted[n] = 0;
      if (!lattice_->inside(n)) continue;
      nodes.push_back(n);
      uv.push_back(lattice_->sampling_point(n));
    }
  }
  const std::vector<Metric2> metric = ask(uv);
  for (std::size_t k = 0; k < nodes.size(); ++k) set_sample(nodes[k], metric[k], k);
}

// The squared trace over the determinant is r + 2 + 1 / r.
bool ControlSpaceSampling::is_much_stretched(Metric2 root) noexcept {
  constexpr double most = much_stretched + 2 + 1 / much_stretched;
  return (root.a + root.c) * (root.a + root.c) > most * determinant(root);
}

// Value expected at node `k` of a cell from the present samples.
Metric2 ControlSpaceSampling::expected_at(const TreeCell& cell, int k) {
  const Prediction guess = predictor_->predict(cell, k);
  if (guess.order >= 3) return guess.root;
  const GridPoint p = lattice_->point(cell.node[k]);
  return border_->fit({static_cast<double>(p.i), static_cast<double>(p.j)}, cell.size);
}

// Number of corners and centres inside.
int ControlSpaceSampling::nodes_inside(const TreeCell& cell) const noexcept {
  if (cell.edges_begin == cell.edges_end) return cell.relevant ? 5 : 0;
  int count = lattice_->inside(cell.centre()) ? 1 : 0;
  for (const int k : corners_of_cell) count += lattice_->inside(cell.node[k]) ? 1 : 0;
  return count;
}

std::vector<ControlSpaceSampling::CentreProbe> ControlSpaceSampling::centres_of(std::span<const std::int32_t> cells) {
  std::vector<CentreProbe> probes;
  for (const std::int32_t c : cells) {
    const TreeCell& cell = (*tree_)[c];
    const std::int32_t n = cell.centre();
    if (!lattice_->inside(n)) continue;
    probes.push_back({.node = n, .cell = c});
    Metric2& expected = probes.back().expected;
    if (!predictor_->predict_centre(cell, expected)) expected = expected_at(cell, 4);
  }
  return probes;
}

// Vertices of the boundary in each cell that is partly outside.
std::vector<ControlSpaceSampling::BorderPoint> ControlSpaceSampling::border_points_of(
    std::span<const std::int32_t> cells) {
  std::vector<BorderPoint> points;
  std::vector<int> found;
  for (const std::int32_t c : cells) {
    const TreeCell& cell = (*tree_)[c];
    if (nodes_inside(cell) == 5) continue;
    tree_->vertices_in(cell, found);
    std::erase_if(found, [this](int v) { return vertex_sampled_[v] != 0; });
    if (found.empty()) continue;
    // One vertex in the middle, or two at the quarters.
    const std::size_t n = found.size();
    const std::size_t picks[2] = {n >= 4 ? n / 4 : n / 2, n >= 4 ? 3 * n / 4 : n / 2};
    for (std::size_t k = 0; k < (n >= 4 ? 2 : 1); ++k) {
      const int v = found[picks[k]];
      vertex_sampled_[v] = 1;
      points.push_back({v, c, border_->fit(lattice_->position(domain_.vertices[v]), cell.size)});
    }
  }
  return points;
}

// Samples the nodes that decide whether cells need splitting, and finds the cells' errors and numbers of vertices.
void ControlSpaceSampling::test(std::span<const std::int32_t> cells) {
  lattice_->forget();
  const std::vector<CentreProbe> centres = centres_of(cells);
  const std::vector<BorderPoint> points = border_points_of(cells);
  std::vector<Vec2> uv;
  for (const CentreProbe& p : centres) uv.push_back(lattice_->sampling_point(p.node));
  for (const BorderPoint& p : points) uv.push_back(domain_.vertices[p.vertex]);
  const std::vector<Metric2> metric = ask(uv);
  std::vector<double> before;
  for (const std::int32_t c : cells) {
    before.push_back((*tree_)[c].error);
    (*tree_)[c].error = 0;
    (*tree_)[c].tested = true;
  }
  // The centre, if the cell has one, gives the last estimate of the number of vertices.
  for (std::size_t k = 0; k < points.size(); ++k) {
    TreeCell& cell = (*tree_)[points[k].cell];
    const Metric2 truth = root_of(metric[centres.size() + k]);
    border_->add(lattice_->position(domain_.vertices[points[k].vertex]), truth);
    keep_border(points[k].vertex, metric[centres.size() + k], centres.size() + k);
    cell.error = std::max(cell.error, shares::reserve * error_between(points[k].expected, truth, cell));
    cell.vertices = vertices_of(cell, truth);
  }
  for (std::size_t k = 0; k < centres.size(); ++k) {
    TreeCell& cell = (*tree_)[centres[k].cell];
    set_sample(centres[k].node, metric[k], k);
    const Metric2 truth = lattice_->value(centres[k].node);
    options_.thorough = options_.thorough || is_much_stretched(truth);
    cell.error = std::max(cell.error, error_between(centres[k].expected, truth, cell));
    cell.vertices = vertices_of(cell, truth);
  }
  for (std::size_t k = 0; k < cells.size(); ++k) {
    TreeCell& cell = (*tree_)[cells[k]];
    cell.decay = 0.5;
    if (before[k] > 0) cell.decay = std::clamp(2 * cell.error / before[k], 1.0 / 16, 0.5);
  }
}

// Returns whether samples on its sides suffice for a cell to be split. Errors fall from a cell to its parts by a
// factor: sixteen if the field is smooth, two at a kink. The factor comes from the errors of the cell and of its
// parent. Cells split for their number of vertices are explored, cells at the border extrapolated.
bool ControlSpaceSampling::can_be_filled(const TreeCell& cell) const noexcept {
  if (cell.filled || cell.edges_begin != cell.edges_end || cell.vertices > crowded * vertices_per_cell_) return false;
  const double expected = cell.decay * cell.error, parts = 0.25 * cell.vertices;
  if (expected <= shares::reserve * allowed_error(parts)) return true;
  return !options_.thorough && static_cast<double>(samples_) > samples_for_smooth_fields() &&
         is_beyond_tolerance(cell) && expected <= tolerated_error(parts);
}

void ControlSpaceSampling::estimate_vertices() {
  double sum = 0;
  for (std::int32_t c = 0; c < tree_->size(); ++c) {
    const TreeCell& cell = (*tree_)[c];
    if (cell.child >= 0 || !cell.relevant) continue;
    sum += cell.vertices * nodes_inside(cell) / 5;
  }
  // Exploration is planned for the first estimate; it grows if that was too low.
  if (sum > vertices_) vertices_per_cell_ *= std::sqrt(sum / vertices_);
  vertices_ = std::max(sum, 1.0);
}

double ControlSpaceSampling::vertices_of(const TreeCell& cell, Metric2 root) const noexcept {
  const double share = static_cast<double>(cell.size) / lattice_->step();
  return std::max(accurate_determinant(root), 0.0) * share * share / area_per_vertex;
}

double ControlSpaceSampling::error_between(Metric2 root, Metric2 truth, const TreeCell& cell) const noexcept {
  const double share = static_cast<double>(cell.size) / lattice_->step();
  constexpr double floor = negligible_length * negligible_length;
  const auto lifted = [&](Metric2 r) {
    const Metric2 m = share * share * square(r);
    return Metric2{m.a + floor, m.b, m.c + floor};
  };
  return length_error(lifted(root), lifted(truth));
}

double ControlSpaceSampling::allowed_error(double vertices) const noexcept {
  const double width = std::sqrt(vertices * area_per_vertex);
  if (width <= min_width) return infinity;
  return options_.tolerance * (width > 1 ? shares::reserve : width > 0.5 ? allowed_edge : 1.0);
}

double ControlSpaceSampling::tolerated_error(double vertices) const noexcept {
  const double width2 = vertices * area_per_vertex;
  if (width2 <= min_width * min_width) return infinity;
  return options_.tolerance * std::max(1.0, plain_width * plain_width / width2);
}

// Samples on the sides stand for the parts of the cell.
bool ControlSpaceSampling::is_beyond_tolerance(const TreeCell& cell) const noexcept {
  if (options_.thorough) return cell.error > std::max(allowed_error(cell.vertices), options_.tolerance);
  return cell.filled ? cell.decay * cell.error > tolerated_error(0.25 * cell.vertices)
                     : 0.5 * cell.error > tolerated_error(cell.vertices);
}

double ControlSpaceSampling::samples_for_smooth_fields() const noexcept {
  const double others = options_.thorough ? 0 : std::max(vertices_ - vertices_that_count, 0.0);
  // A twelfth of the vertices beyond the first ones counts. [surface: Calls.AreAtMostFiveAVertexWhenGeometric]
  return spare_samples + options_.samples_per_vertex * (vertices_ - (1 - 1.0 / 12) * others);
}

// Cells to split, in their order. Crowded cells are split as far as max_samples allows, cells beyond the tolerance
// within some samples a vertex. The others are split as far as samples_for_smooth_fields() allows. The worst first.
// `untested`: cells that will cost samples anyway.
std::vector<std::int32_t> ControlSpaceSampling::affordable(std::vector<std::int32_t> cells,
                                                           std::size_t untested) const {
  std::vector<std::int32_t> crowd, must, may;
  for (const std::int32_t c : cells) {
    const TreeCell& cell = (*tree_)[c];
    if (!tree_->can_split(c)) continue;
    const double allowed = allowed_error(cell.vertices);
    if (cell.vertices > crowded * vertices_per_cell_)
      crowd.push_back(c);
    else if (is_beyond_tolerance(cell))
      must.push_back(c);
    else if (cell.error > allowed)
      may.push_back(c);
  }
  // Keeps the worst cells that the samples pay for; among equal ones the first.
  const auto cut = [this](std::vector<std::int32_t>& list, double samples, double cost) {
    if (samples / cost >= static_cast<double>(list.size())) return;
    const auto count = static_cast<std::size_t>(std::max(samples / cost, 0.0));
    const auto error = [this](std::int32_t c) { return (*tree_)[c].error; };
    std::nth_element(
        list.begin(), list.begin() + static_cast<std::ptrdiff_t>(count), list.end(),
        [&](std::int32_t p, std::int32_t q) { return error(p) > error(q) || (error(p) == error(q) && p < q); });
    list.resize(count);
  };
  double spent = static_cast<double>(samples_) + usual_cost * static_cast<double>(crowd.size());
  const double most = on_surface_ ? max_graded_samples_per_vertex : max_samples_per_vertex;
  cut(must, max_spare_samples + most * vertices_ - spent, usual_cost);
  spent += usual_cost * static_cast<double>(must.size());
  cut(may, samples_for_smooth_fields() - spent, usual_cost);
  crowd.insert(crowd.end(), must.begin(), must.end());
  crowd.insert(crowd.end(), may.begin(), may.end());
  cut(crowd, samples_left() - 3 * static_cast<double>(untested), costliest_split);  // a test costs 3
  std::sort(crowd.begin(), crowd.end());
  return crowd;
}

// Fills or splits cells, and neighbours with errors as large; returns the new leaves that have points of the domain.
std::vector<std::int32_t> ControlSpaceSampling::refine(std::span<const std::int32_t> cells) {
  std::vector<std::int32_t> now(cells.begin(), cells.end()), fresh;
  while (!now.empty()) {
    for (const std::int32_t c : now) {
      if (can_be_filled((*tree_)[c])) {
        (*tree_)[c].filled = true;
        (*tree_)[c].error *= (*tree_)[c].decay;
        continue;
      }
      tree_->split(c);
      for (std::int32_t k = (*tree_)[c].child; k < (*tree_)[c].child + 4; ++k)
        if ((*tree_)[k].relevant) fresh.push_back(k);
    }
    now = affordable(sample_middles(now), fresh.size());
  }
  return fresh;
}

// The middles of the sides of cells that can be sampled, each once, by increasing node.
std::vector<ControlSpaceSampling::SideProbe> ControlSpaceSampling::middles_of(std::span<const std::int32_t> cells) {
  std::vector<std::uint64_t> found;  // node, then its place among the sides of all cells
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t side = 0; side < 4; ++side) {
      const std::int32_t n = (*tree_)[cells[c]].node[middles_of_sides[side]];
      if (!lattice_->inside(n) || lattice_->sampled(n)) continue;
      found.push_back(static_cast<std::uint64_t>(n) << 32 | (4 * c + side));
    }
  std::sort(found.begin(), found.end());
  std::vector<SideProbe> probes;
  for (const std::uint64_t f : found) {
    const auto node = static_cast<std::int32_t>(f >> 32);
    if (!probes.empty() && probes.back().node == node) continue;
    const auto place = static_cast<std::uint32_t>(f);
    probes.push_back({.node = node, .cell = cells[place / 4], .side = static_cast<int>(place % 4)});
  }
  return probes;
}

// The tested leaves on both sides of a side, or -1: new leaves will be tested by their own centres.
std::array<std::int32_t, 2> ControlSpaceSampling::tested_beside(const SideProbe& probe) const noexcept {
  const TreeCell& own = (*tree_)[probe.cell];
  std::array<std::int32_t, 2> leaves{probe.cell, own.beside[probe.side]};
  if (leaves[1] >= 0) {
    const GridPoint p = lattice_->point(probe.node);
    leaves[1] = tree_->leaf_below(leaves[1], {probe.side == 2 ? p.i - 1 : p.i, probe.side == 0 ? p.j - 1 : p.j});
  }
  for (std::int32_t& leaf : leaves)
    if (leaf >= 0 && !((*tree_)[leaf].child < 0 && (*tree_)[leaf].relevant && (*tree_)[leaf].tested)) leaf = -1;
  return leaves;
}

// Samples the middles of the sides of cells; returns the leaves beside wrong predictions.
std::vector<std::int32_t> ControlSpaceSampling::sample_middles(std::span<const std::int32_t> cells) {
  lattice_->forget();
  std::vector<SideProbe> probes = middles_of(cells);
  std::vector<Vec2> uv;
  for (SideProbe& p : probes) {
    p.beside = tested_beside(p);
    // A node whose prediction is not verified has no expected value.
    if (p.beside[0] >= 0 || p.beside[1] >= 0) p.expected = expected_at((*tree_)[p.cell], middles_of_sides[p.side]);
    uv.push_back(lattice_->sampling_point(p.node));
  }
  const std::vector<Metric2> metric = ask(uv);
  std::vector<std::int32_t> wrong;
  for (std::size_t k = 0; k < probes.size(); ++k) {
    set_sample(probes[k].node, metric[k], k);
    for (const std::int32_t leaf : probes[k].beside) {
      if (leaf < 0) continue;
      TreeCell& cell = (*tree_)[leaf];
      const double error = error_between(probes[k].expected, lattice_->value(probes[k].node), cell);
      if (cell.filled ? cell.decay * error <= allowed_error(0.25 * cell.vertices)
                      : error <= allowed_error(cell.vertices))
        continue;
      cell.error = std::max(cell.error, error);
      wrong.push_back(leaf);
    }
  }
  std::sort(wrong.begin(), wrong.end());
  wrong.erase(std::unique(wrong.begin(), wrong.end()), wrong.end());
  return wrong;
}

}  // namespace carreau::detail
