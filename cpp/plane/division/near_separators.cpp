// SPDX-License-Identifier: BSD-3-Clause
#include "plane/division/near_separators.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "plane/kernel/star.h"
#include "plane/kernel/thresholds.h"

namespace carreau::plane {

namespace {

/// Numbers without the removed items.
class Left {
 public:
  template <typename All, typename IsRemoved>
  Left(const All& all, std::size_t left, const IsRemoved& is_removed) {
    if (left == all.size()) return;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (is_removed(k)) removed_.push_back(static_cast<std::int32_t>(k));
  }
  void renumber(std::vector<std::int32_t>& numbers) const {
    if (removed_.empty()) return;
    for (std::int32_t& k : numbers)
      k -= static_cast<std::int32_t>(std::lower_bound(removed_.begin(), removed_.end(), k) - removed_.begin());
  }

 private:
  std::vector<std::int32_t> removed_;
};

void sort_once(std::vector<std::int32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Goes from layer to layer by neighbours.
class Layers {
 public:
  Layers(const Piece& piece, const Triangulation& mesh)
      : mesh_(mesh), level_(mesh.vertices.size(), zone_layers), band_(mesh.vertices.size(), Pieces::none) {
    find_pinched(piece);
  }

  NearSeparators run(const Piece& piece, const std::vector<std::int32_t>& separator, Monitor& monitor) {
    NearSeparators near;
    for (std::size_t v = 0; v < piece.whole.size(); ++v) {
      band_[v] = separator[piece.whole[v]];
      if (band_[v] == Pieces::none) continue;
      level_[v] = 0;
      front_.push_back(static_cast<std::int32_t>(v));
    }
    for (std::int32_t now = 0; now < zone_layers && !front_.empty(); ++now) {
      monitor.checkpoint();
      for (const std::int32_t v : front_) {
        near.vertices.push_back(v);
        near.level.push_back(now);
        near.band.push_back(band_[v]);
      }
      find_around();
      near.triangles.insert(near.triangles.end(), around_.begin(), around_.end());
      front_.clear();
      if (now + 1 < zone_layers) spread(now);
    }
    sort_once(near.triangles);
    return near;
  }

 private:
  // Vertices at which the piece touches itself have triangles that no walk from one to the next finds.
  void find_pinched(const Piece& piece) {
    std::vector<std::int32_t> edges(piece.whole.size(), 0);
    for (const PlaneEdge& edge : piece.domain.edges)
      if (edge.kind != PlaneEdgeKind::internal) ++edges[edge.a], ++edges[edge.b];
    if (std::none_of(edges.begin(), edges.end(), [](std::int32_t n) { return n > 2; })) return;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const std::int32_t v : mesh_.triangles[t].v)
        if (v >= 0 && static_cast<std::size_t>(v) < edges.size() && edges[v] > 2)
          pinched_.emplace_back(v, static_cast<std::int32_t>(t));
    std::sort(pinched_.begin(), pinched_.end());
  }

  void find_around() {
    around_.clear();
    for (const std::int32_t v : front_) {
      auto known = std::lower_bound(pinched_.begin(), pinched_.end(), std::pair(v, std::int32_t{0}));
      if (known == pinched_.end() || known->first != v) {
        if (mesh_.vertices[v].triangle >= 0) for_each_around(mesh_, v, [&](int t) { around_.push_back(t); });
        continue;
      }
      for (; known != pinched_.end() && known->first == v; ++known) around_.push_back(known->second);
    }
    sort_once(around_);
  }

  // Spreads to the corners of the triangles around the front. If several bands meet, the first one continues.
  void spread(std::int32_t now) {
    for (const std::int32_t k : around_) {
      const auto& corners = mesh_.triangles[k].v;
      std::int32_t from = -1;
      for (const std::int32_t v : corners)
        if (level_[v] == now && (from < 0 || band_[v] < band_[from])) from = v;
      for (const std::int32_t v : corners)
        if (level_[v] > now + 1) {
          level_[v] = static_cast<std::uint8_t>(now + 1), band_[v] = band_[from];
          front_.push_back(v);
        }
    }
  }

  const Triangulation& mesh_;
  std::vector<std::uint8_t> level_;  // by vertex, as the next one
  std::vector<std::int32_t> band_;
  std::vector<std::pair<std::int32_t, std::int32_t>> pinched_;  // with each of its triangles
  std::vector<std::int32_t> front_, around_;
};

}  // namespace

NearSeparators near_separators(const Piece& piece, const std::vector<std::int32_t>& separator,
                               const Triangulation& mesh, const PlaneMesh& result, Monitor& monitor) {
  NearSeparators near = Layers(piece, mesh).run(piece, separator, monitor);
  const std::size_t imposed = piece.whole.size();
  Left(mesh.triangles, result.triangles.size(), [&](std::size_t t) {
    return mesh.triangles[t].v[0] < 0;
  }).renumber(near.triangles);
  Left(mesh.vertices, result.vertices.size(), [&](std::size_t v) {
    return v >= imposed && mesh.vertices[v].triangle < 0;
  }).renumber(near.vertices);
  return near;
}

}  // namespace carreau::plane
