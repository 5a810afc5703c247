// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/cross_patch/line_middles.h"

#include <algorithm>
#include <utility>

#include "surface/elements/base/curve_middles.h"

namespace carreau {

LineMiddles::LineMiddles(const AtlasSurface& surface, PlacedVertices& vertices, std::vector<SharpLine> left,
                         std::span<WorkedLine> worked, Monitor& monitor)
    : surface_(surface), vertices_(vertices), lines_(std::move(left)), worked_(worked), monitor_(monitor) {
  list_edges();
}

void LineMiddles::list_edges() {
  middle_.clear();
  for (std::size_t l = 0; l < lines_.size(); ++l)
    for (std::size_t k = 0; k + 1 < lines_[l].vertices.size(); ++k)
      middle_.try_emplace(mesh_edge(lines_[l].vertices[k], lines_[l].vertices[k + 1]), Edge{l, k, -1});
}

bool LineMiddles::has_arcs(std::size_t line) const {
  return std::ranges::equal(worked_[line].left, lines_[line].vertices, {}, &LineNode::vertex);
}

double LineMiddles::share(std::int32_t v, std::int32_t w) const {
  const double at_v = vertices_.size_along(v, w), at_w = vertices_.size_along(w, v);
  return metric_middle(1 / at_v, 2 / (at_v + at_w), 1 / at_w);
}

std::int32_t LineMiddles::middle_of(const MeshEdge& edge) {
  Edge& known = middle_.at(edge);
  if (known.middle >= 0) return known.middle;
  monitor_.checkpoint();
  KeptPlaces places = places_at(known);
  const WantedSize wanted = surface_.wanted_at(places);
  return known.middle = vertices_.add_kept(std::move(places), wanted);
}

KeptPlaces LineMiddles::places_at(const Edge& edge) {
  const std::vector<std::int32_t>& chain = lines_[edge.line].vertices;
  const std::int32_t v = chain[edge.rank], w = chain[edge.rank + 1];
  if (has_arcs(edge.line)) {
    const double from = worked_[edge.line].left[edge.rank].arc, to = worked_[edge.line].left[edge.rank + 1].arc;
    KeptPlaces places = worked_[edge.line].places->at(from + share(v, w) * (to - from));
    if (!places.empty()) return places;
  }
  ++unknown_;
  return places_beside(v, w);
}

// Finds the place on each side, from the vertices towards the middle of the chord.
KeptPlaces LineMiddles::places_beside(std::int32_t v, std::int32_t w) const {
  const Vec3 middle = lerp(vertices_.position(v), vertices_.position(w), share(v, w));
  KeptPlaces places;
  for (const std::int32_t from : {v, w}) {
    if (!places.empty()) break;
    for (const SurfacePlace& p : vertices_.places(from))
      if (const auto found = surface_.beside(p, middle)) places.push_back(*found);
  }
  if (places.empty()) places.push_back(vertices_.places(v).front()), places.front().xyz = middle;
  for (SurfacePlace& p : places) p.xyz = places.front().xyz;
  return places;
}

void LineMiddles::halve() {
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    SharpLine& line = lines_[l];
    const bool arcs = has_arcs(l);
    SharpLine finer;
    std::vector<LineNode> left;
    for (std::size_t k = 0; k + 1 < line.vertices.size(); ++k) {
      const std::int32_t v = line.vertices[k], w = line.vertices[k + 1], m = middle_of(mesh_edge(v, w));
      finer.vertices.insert(finer.vertices.end(), {v, m});
      finer.curve.insert(finer.curve.end(), 2, line.curve[k]);
      if (!arcs) continue;
      const LineNode &from = worked_[l].left[k], &to = worked_[l].left[k + 1];
      left.insert(left.end(), {from, {m, from.arc + share(v, w) * (to.arc - from.arc)}});
    }
    if (line.vertices.empty()) continue;
    finer.vertices.push_back(line.vertices.back());
    if (arcs) left.push_back(worked_[l].left.back()), worked_[l].left = std::move(left);
    line = std::move(finer);
  }
  list_edges();
}

}  // namespace carreau
