// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/quads/halving.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "curve/discrete_curve.h"
#include "periodic/shared_curves.h"
#include "support/infinity.h"
#include "surface/elements/base/curve_middles.h"
#include "surface/elements/quads/passes.h"
#include "surface/layers/middle_columns.h"

namespace carreau {

namespace {

using Middles = std::vector<std::vector<std::int32_t>>;

/// The share of length below the new vertex, for edges of curves that rows end at.
using RowShares = std::map<std::array<std::int32_t, 2>, double>;

RowShares row_shares(const ElementWork& work, const std::vector<FaceQuads>& faces) {
  RowShares shares;
  for (const FaceQuads& quads : faces) {
    if (!work.has_layers(quads.face)) continue;
    const std::span<const LayerCell> cells((*work.layers)[quads.face]);
    for (const auto& [first, end] : piles_of(cells)) {
      const PileSides sides(cells.subspan(first, end - first));
      const double lower = work.layer_curves->lower_half(cells[first].layers);
      for (const std::vector<std::int32_t>& column : {sides.left, sides.right})
        for (std::size_t k = 0; k + 1 < column.size(); ++k)
          if (const CurveSide* side = quads.side_between(column[k], column[k + 1]); side != nullptr) {
            const bool up = work.result.mesh.curves[side->curve].vertices[side->segment] == quads.vertex[column[k]];
            shares[{side->curve, side->segment}] = up ? lower : 1 - lower;
          }
    }
  }
  return shares;
}

/// Doubles the number of edges of a curve; returns false, with an unchanged curve, if an edge cannot be cut.
bool halve(const ElementWork& work, std::size_t c, const RowShares& shares) {
  if (c >= work.curves.size()) return false;
  DiscreteCurve curve = work.curves[c];
  if (curve.indivisible || work.result.mesh.curves[c].vertices.size() != curve.xyz.size()) return false;
  for (int k = curve.segments() - 1; k >= 0; --k) {
    work.monitor.checkpoint();
    const auto row = shares.find({static_cast<std::int32_t>(c), k});
    const double share = row != shares.end() ? row->second : middle_share(work.curves[c], static_cast<std::size_t>(k));
    if (!split_segment(curve, k, work.model, share)) return false;
  }
  work.curves[c] = std::move(curve);
  return true;
}

std::int32_t add_vertex(const ElementWork& work, const Vec3& xyz, double size) {
  work.result.mesh.vertices.push_back(xyz);
  work.result.mesh.vertex_ref.push_back(0);
  work.result.vertex_size.push_back(size);
  return static_cast<std::int32_t>(work.result.mesh.vertices.size()) - 1;
}

// Sides of curves that could not be cut: the middle of the first face that has them.
void add_middles_of_faces(const ElementWork& work, const std::vector<FaceQuads>& faces, Middles& middles) {
  for (const FaceQuads& quads : faces)
    for (const CurveSide& side : quads.sides) {
      std::int32_t& middle = middles[side.curve][side.segment];
      if (middle >= 0) continue;
      const Vec2 uv = 0.5 * (quads.patch.uv[side.a] + quads.patch.uv[side.b]);
      const Vec3 xyz = surface_at(work.cad(), work.result.mesh.faces[quads.face].ref, want_position, uv).s;
      const auto size = [&](std::int32_t v) { return work.result.vertex_size[quads.vertex[v]]; };
      middle = add_vertex(work, xyz, 0.5 * (size(side.a) + size(side.b)));
    }
}

void interleave(CurveMesh& curve, std::vector<double>& sizes, const std::vector<std::int32_t>& middles,
                const CompositeResult& result) {
  if (middles.empty() || std::count(middles.begin(), middles.end(), -1) != 0) return;
  std::vector<std::int32_t> vertices;
  std::vector<double> size;
  const bool known = sizes.size() == curve.vertices.size();
  for (std::size_t k = 0; k < curve.vertices.size(); ++k) {
    vertices.push_back(curve.vertices[k]);
    if (known) size.push_back(sizes[k]);
    if (k == middles.size()) break;
    vertices.push_back(middles[k]);
    if (known) size.push_back(result.vertex_size[middles[k]]);
  }
  curve.vertices = std::move(vertices);
  sizes = std::move(size);
}

class Halving {
 public:
  Halving(const ElementWork& work, const Middles& middles, FaceQuads& quads)
      : work_(work), middles_(middles), quads_(quads) {}

  void run() {
    quads_.middles.assign(quads_.sides.size(), -1);
    join_flattened();
    halve_rows();
    number_edges();
    quads_.patch.cells = halved_cells(
        quads_.patch.cells, [&](std::int32_t a, std::int32_t b) { return middle_of(a, b); },
        [&](const MixedCell& cell) {
          const int n = corners_of(cell);
          Vec2 sum{0, 0};
          for (int k = 0; k < n; ++k) sum += quads_.patch.uv[cell[k]];
          return add((1.0 / n) * sum, -1, 0);
        });
  }

 private:
  using Key = std::array<std::int32_t, 2>;
  static Key key(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

  std::int32_t add(const Vec2& uv, std::int32_t in_mesh, char fixed) {
    quads_.patch.uv.push_back(uv);
    quads_.patch.fixed.push_back(fixed);
    quads_.vertex.push_back(in_mesh);
    return static_cast<std::int32_t>(quads_.patch.uv.size()) - 1;
  }

  std::int32_t add_on_curve(const CurveSide& side) {
    const std::int32_t in_mesh = middles_[side.curve][side.segment];
    Vec2 place = 0.5 * (quads_.patch.uv[side.a] + quads_.patch.uv[side.b]);
    if (side.use >= 0) {
      const std::vector<Vec2>& uv = work_.curves[side.curve].uv_of_use[side.use];
      if (uv.size() == 2 * middles_[side.curve].size() + 1) place = uv[2 * side.segment + 1];
    }
    const std::int32_t local = add(place, in_mesh, 1);
    quads_.middles[static_cast<std::size_t>(&side - quads_.sides.data())] = local;
    return local;
  }

  // The two sides that a flattened triangle has beside its apex are one in space: they share one middle.
  void join_flattened() {
    for (auto& t : quads_.flattened) {
      for (int k = 0; k < 3; ++k) {
        const std::int32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
        if (quads_.vertex[a] != quads_.vertex[b]) continue;
        const CurveSide* side = quads_.side_between(b, c);
        if (side == nullptr) side = quads_.side_between(c, a);
        const Vec2 apex = 0.5 * (quads_.patch.uv[a] + quads_.patch.uv[b]);
        const std::int32_t middle =
            side != nullptr ? add_on_curve(*side) : add(0.5 * (apex + quads_.patch.uv[c]), -1, 1);
        joined_[key(b, c)] = joined_[key(c, a)] = middle;
        t[(k + 2) % 3] = middle;
        break;
      }
    }
  }

  // The middle of an edge, once; on curves their own.
  std::int32_t shared_middle(std::int32_t a, std::int32_t b, const Vec2& inside) {
    const auto [joined, is_new] = joined_.try_emplace(key(a, b), -1);
    if (!is_new) return joined->second;
    const CurveSide* side = quads_.side_between(a, b);
    return joined->second = side != nullptr ? add_on_curve(*side) : add(inside, -1, 1);
  }

  [[nodiscard]] ColumnPlace place(std::int32_t v) const {
    const Vec2& uv = quads_.patch.uv[v];
    return {uv, surface_at(work_.cad(), work_.result.mesh.faces[quads_.face].ref, want_position, uv).s};
  }

  // Cells of layers are cut so that rows grow evenly. A column rises from the middle of the curve's edge.
  void halve_rows() {
    if (!work_.has_layers(quads_.face)) return;
    std::vector<LayerCell>& cells = (*work_.layers)[quads_.face];
    std::vector<LayerCell> halves;
    quads_.rows.clear();
    for (const auto& [first, end] : piles_of(cells)) halve_pile(std::span(cells).subspan(first, end - first), halves);
    cells = std::move(halves);
    for (const LayerCell& cell : cells) quads_.rows.push_back(cell.corners);
    quads_.rows.insert(quads_.rows.end(), tips_.begin(), tips_.end());
  }

  void halve_pile(std::span<const LayerCell> pile, std::vector<LayerCell>& halves) {
    const int ref = work_.result.mesh.faces[quads_.face].ref;
    const double lower = work_.layer_curves->lower_half(pile.front().layers);
    const PileSides sides(pile);
    std::vector<ColumnPlace> left, right;
    for (const std::int32_t v : sides.left) left.push_back(place(v));
    for (const std::int32_t v : sides.right) right.push_back(place(v));
    const auto with_halves = [&](const std::vector<std::int32_t>& side, const std::vector<ColumnPlace>& places) {
      std::vector<std::int32_t> column{side[0]};
      for (std::size_t k = 1; k < side.size(); ++k) {
        const Vec2 inside = dividing_place(work_.cad(), ref, places[k - 1], places[k], lower).uv;
        column.push_back(shared_middle(side[k - 1], side[k], inside)), column.push_back(side[k]);
      }
      return column;
    };
    const std::int32_t low = sides.left[0] == sides.right[0]
                                 ? sides.left[0]
                                 : shared_middle(sides.left[0], sides.right[0], 0.5 * (left[0].uv + right[0].uv));
    const std::vector<ColumnPlace> above = middle_column(work_.cad(), ref, place(low), left, right, work_.layer_curves->heights(pile.front().layers, infinity));
    std::vector<std::int32_t> middle{low};
    for (std::size_t k = 1; k < above.size(); ++k) {
      middle.push_back(add(dividing_place(work_.cad(), ref, above[k - 1], above[k], lower).uv, -1, 1));
      middle.push_back(shared_middle(sides.left[k], sides.right[k], above[k].uv));
    }
    const std::array<std::vector<std::int32_t>, 3> columns{with_halves(sides.left, left), middle, with_halves(sides.right, right)};
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t k = 0; k + 1 < middle.size(); ++k) {
        const std::vector<std::int32_t>&a = columns[side], &b = columns[side + 1];
        if (a[k] == b[k]) continue;
        halves.push_back({.corners = {a[k], b[k], b[k + 1], a[k + 1]},
                          .layers = pile.front().layers,
                          .row = 2 * pile.front().row + static_cast<std::int32_t>(k)});
      }
    // One quadrilateral takes both lowest triangles of a fan.
    if (sides.left[0] == sides.right[0]) tips_.push_back({low, columns[2][1], middle[1], columns[0][1]});
  }

  // Makes rows of edges by their lower ends; each row has each of its edges once.
  void number_edges() {
    first_.assign(quads_.patch.uv.size() + 1, 0);
    const auto for_sides = [&](const auto& use) {
      for (const MixedCell& cell : quads_.patch.cells)
        for (int k = 0, n = corners_of(cell); k < n; ++k) use(key(cell[k], cell[(k + 1) % n]));
    };
    for_sides([&](const Key& edge) { ++first_[edge[0] + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    other_.assign(static_cast<std::size_t>(first_.back()), -1);
    middle_.assign(other_.size(), -1);
    for_sides([&](const Key& edge) {
      auto k = static_cast<std::size_t>(first_[edge[0]]);
      while (other_[k] >= 0 && other_[k] != edge[1]) ++k;
      other_[k] = edge[1];
    });
  }

  std::int32_t middle_of(std::int32_t a, std::int32_t b) {
    const Key edge = key(a, b);
    auto k = static_cast<std::size_t>(first_[edge[0]]);
    while (other_[k] != edge[1]) ++k;
    std::int32_t& middle = middle_[k];
    if (middle >= 0) return middle;
    if (const auto joined = joined_.find(key(a, b)); joined != joined_.end())
      middle = joined->second;
    else if (const CurveSide* side = quads_.side_between(a, b); side != nullptr)
      middle = add_on_curve(*side);
    else
      middle = add(0.5 * (quads_.patch.uv[a] + quads_.patch.uv[b]), -1, 0);
    return middle;
  }

  const ElementWork& work_;
  const Middles& middles_;
  FaceQuads& quads_;
  std::vector<std::int32_t> first_;           // by vertex: of its row
  std::vector<std::int32_t> other_, middle_;  // by edge: its upper end, and the vertex in its middle
  std::map<Key, std::int32_t> joined_;
  std::vector<MixedCell> tips_;  // of fans
};

}  // namespace

Middles halve_curves(const ElementWork& work, const std::vector<FaceQuads>& faces) {
  SurfaceMesh& mesh = work.result.mesh;
  Middles middles(mesh.curves.size());
  std::vector<char> halved(mesh.curves.size(), 0);
  const RowShares shares = row_shares(work, faces);
  for (std::size_t c = 0; c < mesh.curves.size(); ++c)
    if (mesh.curves[c].vertices.size() >= 2) halved[c] = halve(work, c, shares) ? 1 : 0;
  if (work.periodic != nullptr) carry_vertices(*work.periodic, work.model, work.curves);
  for (std::size_t c = 0; c < mesh.curves.size(); ++c) {
    if (mesh.curves[c].vertices.size() < 2) continue;
    middles[c].assign(mesh.curves[c].vertices.size() - 1, -1);
    if (halved[c] == 0) continue;
    for (std::size_t k = 0; work.periodic != nullptr && k <= middles[c].size(); ++k) work.curves[c].xyz[2 * k] = mesh.vertices[mesh.curves[c].vertices[k]];  // old ones stay
    for (std::size_t k = 0; k < middles[c].size(); ++k)
      middles[c][k] = add_vertex(work, work.curves[c].xyz[2 * k + 1], work.curves[c].size[2 * k + 1]);
  }
  add_middles_of_faces(work, faces, middles);
  for (std::size_t c = 0; c < mesh.curves.size(); ++c)
    interleave(mesh.curves[c], work.result.curve_size[c], middles[c], work.result);
  return middles;
}

void halve_cells(const ElementWork& work, const Middles& middles, FaceQuads& quads) {
  Halving(work, middles, quads).run();
}

}  // namespace carreau
