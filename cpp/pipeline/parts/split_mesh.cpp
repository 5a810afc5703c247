// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/parts/split_mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace carreau {

namespace {

class Splitter {
 public:
  Splitter(const FlatMesh& whole, int rank, int processes) : whole_(whole), rank_(rank), processes_(processes) {
    part_.rank = rank, part_.processes = processes;
    part_.vertices = std::ssize(whole.vertices), part_.triangles = std::ssize(whole.triangles);
    part_.curve_edges = std::ssize(whole.edges);
    part_.mesh.dimension = whole.dimension, part_.mesh.names = whole.names;
    list_elements();
    find_owners();
    find_owners_of_edges();
  }

  PartMesh make() {
    place_vertices();
    add_elements(true);
    part_.own_triangles = std::ssize(part_.mesh.triangles);
    add_elements(false);
    add_edges();
    return std::move(part_);
  }

 private:
  [[nodiscard]] std::size_t elements() const { return first_triangle_.size() - 1; }

  void list_elements() {
    const bool cells = !whole_.cells.empty();
    const std::size_t n = cells ? whole_.cells.size() : whole_.triangles.size();
    std::int64_t t = 0;
    for (std::size_t e = 0; e < n; ++e) {
      first_triangle_.push_back(t);
      t += cells && corner_count(whole_.cells[e].kind) == 4 ? 2 : 1;
    }
    first_triangle_.push_back(t);
  }

  [[nodiscard]] int rank_of(std::size_t element) const {
    return static_cast<int>(element * static_cast<std::size_t>(processes_) / elements());
  }

  /// The nodes of an element; the first ones are its corners.
  [[nodiscard]] std::span<const std::int32_t> nodes(std::size_t element) const {
    if (whole_.cells.empty()) return whole_.triangles[element];
    const Cell& cell = whole_.cells[element];
    return {cell.nodes.data(), static_cast<std::size_t>(node_count(cell.kind))};
  }

  void find_owners() {
    constexpr int nobody = -1;
    owner_.assign(whole_.vertices.size(), nobody);
    touched_.assign(whole_.vertices.size(), false);
    for (std::size_t e = 0; e < elements(); ++e)
      for (const std::int32_t v : nodes(e)) {
        int& owner = owner_[static_cast<std::size_t>(v)];
        if (owner == nobody) owner = rank_of(e);  // ranks ascend
        if (rank_of(e) == rank_) touched_[static_cast<std::size_t>(v)] = true;
      }
    std::replace(owner_.begin(), owner_.end(), nobody, 0);
  }

  void find_owners_of_edges() {
    using Ends = std::pair<std::int32_t, std::int32_t>;
    constexpr int nobody = -1;
    std::vector<std::pair<Ends, std::size_t>> sides;
    for (std::size_t i = 0; i < whole_.edges.size(); ++i) {
      const auto [a, b] = std::minmax(whole_.edges[i][0], whole_.edges[i][1]);
      sides.push_back({{a, b}, i});
    }
    std::sort(sides.begin(), sides.end());
    owner_of_edge_.assign(whole_.edges.size(), nobody);
    for (std::size_t e = 0; e < elements(); ++e) {
      const std::size_t n = whole_.cells.empty() ? 3 : static_cast<std::size_t>(corner_count(whole_.cells[e].kind));
      const auto corner = nodes(e);
      for (std::size_t k = 0; k < n; ++k) {
        const auto [a, b] = std::minmax(corner[k], corner[(k + 1) % n]);
        const Ends side{a, b};
        for (auto at = std::lower_bound(sides.begin(), sides.end(), std::pair(side, std::size_t{0})); at != sides.end() && at->first == side; ++at)
          if (owner_of_edge_[at->second] == nobody) owner_of_edge_[at->second] = rank_of(e);
      }
    }
    std::replace(owner_of_edge_.begin(), owner_of_edge_.end(), nobody, 0);
  }

  [[nodiscard]] bool touches(std::size_t element) const {
    const auto all = nodes(element);
    return std::any_of(all.begin(), all.end(), [&](std::int32_t v) { return touched_[static_cast<std::size_t>(v)]; });
  }

  void place_vertices() {
    std::vector<bool> here(whole_.vertices.size(), false);
    for (std::size_t e = 0; e < elements(); ++e)
      if (rank_of(e) == rank_ || touches(e))
        for (const std::int32_t v : nodes(e)) here[static_cast<std::size_t>(v)] = true;
    for (std::size_t i = 0; i < whole_.edges.size(); ++i)
      if (owner_of_edge_[i] == rank_)
        for (const std::int32_t v : whole_.edges[i]) here[static_cast<std::size_t>(v)] = true;
    std::vector<std::int64_t> next(static_cast<std::size_t>(processes_) + 1, 0);
    for (const int owner : owner_) ++next[static_cast<std::size_t>(owner) + 1];
    for (std::size_t r = 1; r < next.size(); ++r) next[r] += next[r - 1];
    std::vector<std::int64_t> row(owner_.size());
    for (std::size_t v = 0; v < owner_.size(); ++v) row[v] = next[static_cast<std::size_t>(owner_[v])]++;
    here_.assign(owner_.size(), -1);
    for (const bool own : {true, false}) {
      for (std::size_t v = 0; v < owner_.size(); ++v)
        if ((owner_[v] == rank_) == own && (own || here[v])) add_vertex(v, row[v]);
      if (own) part_.own_vertices = std::ssize(part_.mesh.vertices);
    }
  }

  void add_vertex(std::size_t v, std::int64_t row) {
    here_[v] = static_cast<std::int32_t>(part_.mesh.vertices.size());
    part_.mesh.vertices.push_back(whole_.vertices[v]), part_.mesh.vertex_refs.push_back(whole_.vertex_refs[v]);
    part_.vertex_number.push_back(static_cast<std::int64_t>(v)), part_.vertex_owner.push_back(owner_[v]);
    part_.vertex_row.push_back(row);
  }

  /// Own elements, or ghosts.
  void add_elements(bool own) {
    for (std::size_t e = 0; e < elements(); ++e) {
      if ((rank_of(e) == rank_) != own || (!own && !touches(e))) continue;
      for (std::int64_t t = first_triangle_[e]; t < first_triangle_[e + 1]; ++t) {
        std::array<std::int32_t, 3> corners = whole_.triangles[static_cast<std::size_t>(t)];
        for (std::int32_t& v : corners) v = here_[static_cast<std::size_t>(v)];
        part_.mesh.triangles.push_back(corners);
        part_.mesh.triangle_refs.push_back(whole_.triangle_refs[static_cast<std::size_t>(t)]);
        part_.triangle_number.push_back(t), part_.triangle_owner.push_back(rank_of(e));
      }
      if (whole_.cells.empty()) continue;
      Cell cell = whole_.cells[e];
      for (std::int32_t& v : cell.nodes)
        if (v >= 0) v = here_[static_cast<std::size_t>(v)];
      part_.mesh.cells.push_back(cell);
    }
  }

  void add_edges() {
    for (std::size_t i = 0; i < owner_of_edge_.size(); ++i)
      if (owner_of_edge_[i] == rank_) add_edge(i);
  }

  void add_edge(std::size_t i) {
    std::array<std::int32_t, 2> ends{};
    for (std::size_t k = 0; k < 2; ++k) ends[k] = here_[static_cast<std::size_t>(whole_.edges[i][k])];
    part_.mesh.edges.push_back(ends), part_.mesh.edge_refs.push_back(whole_.edge_refs[i]);
    if (!whole_.edge_mids.empty()) part_.mesh.edge_mids.push_back(here_[static_cast<std::size_t>(whole_.edge_mids[i])]);
  }

  const FlatMesh& whole_;
  int rank_, processes_;
  std::vector<std::int64_t> first_triangle_;  // by element, and the end
  std::vector<int> owner_, owner_of_edge_;    // by vertex, by edge
  std::vector<bool> touched_;                 // by vertex: of an own element
  std::vector<std::int32_t> here_;            // by vertex: its number in the part; -1: none
  PartMesh part_;
};

}  // namespace

PartMesh split_mesh(const FlatMesh& whole, int rank, int processes) { return Splitter(whole, rank, processes).make(); }

}  // namespace carreau
