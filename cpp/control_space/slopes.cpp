// SPDX-License-Identifier: BSD-3-Clause
// The part of sampling for gradation.
#include <algorithm>
#include <cmath>

#include "control_space/sampling.h"
#include "support/infinity.h"

namespace carreau::detail {

namespace {

// The nodes of a cell except its centre, counterclockwise.
constexpr int around[8] = {0, 1, 2, 5, 8, 7, 6, 3};

}  // namespace

double ControlSpaceSampling::size_of(const OnSurface& s) noexcept {
  return std::sqrt((s.form.a + s.form.c) / (s.metric.a + s.metric.c));
}

// `rank`: index of the point in the last call.
ControlSpaceSampling::OnSurface ControlSpaceSampling::told(Metric2 metric, std::size_t rank) const noexcept {
  const SurfaceTangents& t = last_tangents_[rank];
  return {metric, induced_metric(t.su, t.sv, 1), t};
}

void ControlSpaceSampling::set_sample(std::int32_t node, Metric2 metric, std::size_t rank) {
  lattice_->set_sample(node, root_of(metric));
  if (!on_surface_) return;
  at_node_.resize(static_cast<std::size_t>(lattice_->size()));
  at_node_[node] = told(metric, rank);
}

void ControlSpaceSampling::keep_border(int vertex, Metric2 metric, std::size_t rank) {
  if (on_surface_) at_border_.push_back({vertex, told(metric, rank)});
}

// Along the boundary the middles of sides are predicted from one side only, which is inexact where a field has kinks.
void ControlSpaceSampling::sample_along_border() {
  std::vector<std::int32_t> nodes;
  std::vector<Vec2> uv;
  for (std::int32_t c = 0; c < tree_->size(); ++c) {
    const TreeCell& cell = (*tree_)[c];
    if (cell.child >= 0 || cell.edges_begin == cell.edges_end) continue;
    for (int side = 0; side < 4; ++side) {
      const std::int32_t n = cell.node[middles_of_sides[side]];
      if (cell.beside[side] < 0 && lattice_->inside(n) && !lattice_->sampled(n)) nodes.push_back(n);
    }
  }
  for (const std::int32_t n : nodes) uv.push_back(lattice_->sampling_point(n));
  const std::vector<Metric2> metric = ask(uv);
  for (std::size_t k = 0; k < nodes.size(); ++k) set_sample(nodes[k], metric[k], k);
}

// Polynomials between bounded samples exceed the slope by the tolerance, at kinks.
void ControlSpaceSampling::bound_slopes(double slope, bool directed) {
  slope_ = (1 - options_.tolerance) * slope;
  directed_ = directed;
  sample_along_border();
  SampledField field;
  std::vector<std::int32_t> node, rank(static_cast<std::size_t>(lattice_->size()), -1);
  for (std::int32_t n = 0; n < lattice_->size(); ++n) {
    if (!lattice_->sampled(n)) continue;
    rank[n] = static_cast<std::int32_t>(node.size());
    node.push_back(n);
    field.samples.push_back({lattice_->sampling_point(n), at_node_[n].metric, at_node_[n].form, at_node_[n].tangents});
  }
  for (std::int32_t c = 0; c < tree_->size(); ++c)
    if ((*tree_)[c].child < 0 && (*tree_)[c].relevant) join_leaf((*tree_)[c], rank, field);
  for (const OnBorder& b : at_border_) {
    const auto here = static_cast<std::int32_t>(field.samples.size());
    field.samples.push_back({domain_.vertices[b.vertex], b.told.metric, b.told.form, b.told.tangents});
    const std::int32_t leaf = tree_->leaf_at(lattice_->unit_cell(domain_.vertices[b.vertex]));
    for (const std::int32_t n : (*tree_)[leaf].node)
      if (rank[n] >= 0) field.links.push_back({here, rank[n]});
  }
  const auto bound = directed ? carreau::bound_slopes_by_direction : carreau::bound_slopes;
  for (const std::int32_t s : bound(field, slope_, monitor_)) {
    const Metric2 root = root_of(field.samples[s].metric);
    if (static_cast<std::size_t>(s) < node.size()) {
      at_node_[node[s]].metric = field.samples[s].metric;
      lattice_->set_sample(node[s], root);
    } else
      border_->set(static_cast<std::size_t>(s) - node.size(), root);
  }
  lattice_->forget();
}

// Sizes may have kinks, which polynomials overshoot; the root of J^T J is smooth. If both are needed on a side of a
// leaf no longer than an edge of the mesh, the root of J^T J is the mean of both ends.
Metric2 ControlSpaceSampling::within_slopes(std::int32_t node, const TreeCell& leaf, Metric2 root) const {
  if (slope_ == 0 || directed_ || leaf.vertices * area_per_vertex > 1) return root;
  const auto side = std::find_if(std::begin(middles_of_sides), std::end(middles_of_sides),
                                 [&](int k) { return leaf.node[k] == node; });
  if (side == std::end(middles_of_sides)) return root;
  const auto& ends = ends_of_sides[side - std::begin(middles_of_sides)];
  const std::int32_t first = leaf.node[ends[0]], last = leaf.node[ends[1]];
  if (!lattice_->sampled(first) || !lattice_->sampled(last)) return root;
  const Metric2 on_surface = 0.5 * (root_of_form(at_node_[first].form) + root_of_form(at_node_[last].form));
  const double h = (on_surface.a + on_surface.c) / (root.a + root.c);
  double low = 0, high = infinity;
  const Vec2 uv = lattice_->sampling_point(node);
  for (const std::int32_t n : {first, last, leaf.centre()}) {
    if (!lattice_->sampled(n)) continue;
    const OnSurface& there = at_node_[n];
    const Vec2 d = lattice_->sampling_point(n) - uv;
    const double reach = slope_ * length(0.5 * (at_node_[first].form + at_node_[last].form), d);
    low = std::max(low, size_of(there) - reach);
    high = std::min(high, size_of(there) + reach);
  }
  if (low > high) low = high = 0.5 * (low + high);  // by rounding, along a straight front
  return h > 0 ? (h / std::clamp(h, low, high)) * root : root;
}

// Triangles around the centre if it is known. Links if too few nodes are known.
void ControlSpaceSampling::join_leaf(const TreeCell& cell, std::span<const std::int32_t> rank,
                                     SampledField& field) const {
  int known[8], count = 0;
  for (int k = 0; k < 8; ++k)
    if (rank[cell.node[around[k]]] >= 0) known[count++] = k;
  const auto at = [&](int k) { return rank[cell.node[around[known[k % count]]]]; };
  const std::int32_t centre = rank[cell.centre()];
  if (centre < 0) {
    for (int k = 1; k + 1 < count; ++k) field.triangles.push_back({at(0), at(k), at(k + 1)});
    if (count == 2) field.links.push_back({at(0), at(1)});
    return;
  }
  for (int k = 0; k < count; ++k) {
    const int gap = (known[(k + 1) % count] - known[k] + 8) % 8;
    if (gap > 0 && gap < 4)
      field.triangles.push_back({centre, at(k), at(k + 1)});
    else
      field.links.insert(field.links.end(), {{centre, at(k)}, {centre, at(k + 1)}});
  }
}

}  // namespace carreau::detail
