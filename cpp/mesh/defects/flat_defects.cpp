// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/defects/flat_defects.h"

#include <algorithm>
#include <span>
#include <utility>

#include "mesh/defects/cell_defects.h"
#include "mesh/quality.h"
#include "mesh/simplices/by_smallest.h"

namespace carreau {

namespace {

class FlatDefectFinder {
 public:
  FlatDefectFinder(const FlatMesh& mesh, const DefectOptions& options) : mesh_(mesh), options_(options) {}

  std::vector<std::string> run(const std::vector<std::string>* of_elements) {
    check_lists();
    check_vertices();
    check_indices();
    if (!defects_.empty()) return std::move(defects_);  // the checks below need sound indices
    for (const std::string& sentence : of_elements != nullptr ? *of_elements : find_cell_defects(mesh_)) add(sentence);
    check_triangles();
    check_duplicates();
    check_unused();
    check_edges();
    return std::move(defects_);
  }

 private:
  using Key = std::array<std::int32_t, 2>;
  struct Side {
    int ref;
    bool forward;  // the triangle runs from the smaller index to the larger
    friend auto operator<=>(const Side&, const Side&) = default;
  };
  struct Others {  // corners of a triangle but the smallest
    std::int32_t middle, largest;
    std::uint32_t triangle;
    friend auto operator<=>(const Others&, const Others&) = default;
    [[nodiscard]] bool same(const Others& o) const { return middle == o.middle && largest == o.largest; }
  };

  void add(const std::string& sentence) {
    if (defects_.size() < options_.limit) defects_.push_back(sentence);
  }
  static Key ordered(std::int32_t a, std::int32_t b) { return a < b ? Key{a, b} : Key{b, a}; }
  static std::string name(const Key& key) {
    return "edge " + std::to_string(key[0]) + "-" + std::to_string(key[1]) + ": ";
  }
  static std::string name(std::size_t t) { return "triangle " + std::to_string(t) + ": "; }
  [[nodiscard]] int ref_of(std::size_t t) const { return mesh_.triangle_refs.empty() ? 0 : mesh_.triangle_refs[t]; }

  void check_lists() {
    const auto fits = [](std::size_t refs, std::size_t entities) { return refs == 0 || refs == entities; };
    if (!fits(mesh_.vertex_refs.size(), mesh_.vertices.size())) add("vertices and their references differ in number");
    if (!fits(mesh_.triangle_refs.size(), mesh_.triangles.size()))
      add("triangles and their references differ in number");
    if (!fits(mesh_.edge_refs.size(), mesh_.edges.size())) add("edges and their references differ in number");
  }

  void check_vertices() {
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
      if (!is_finite(mesh_.vertices[v])) add("vertex " + std::to_string(v) + ": a coordinate is not finite");
  }

  void check_indices() {
    const auto missing = [this](std::int32_t v) { return v < 0 || std::size_t(v) >= mesh_.vertices.size(); };
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      if (std::any_of(mesh_.triangles[t].begin(), mesh_.triangles[t].end(), missing))
        add(name(t) + "it names a vertex that does not exist");
    for (const Key& edge : mesh_.edges)
      if (missing(edge[0]) || missing(edge[1])) add(name(edge) + "it names a vertex that does not exist");
  }

  void check_triangles() {
    if (mesh_.triangles.empty() && mesh_.edges.empty()) add("there is no triangle");
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto [a, b, c] = mesh_.triangles[t];
      if (a == b || b == c || c == a)
        add(name(t) + "it repeats a vertex");
      else if (!(quality_q2(mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]) > flat_quality))
        add(name(t) + "no area");
    }
  }

  void check_duplicates() {
    const auto list = [this](const auto& put) {
      for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        auto [a, b, c] = mesh_.triangles[t];
        if (a > b) std::swap(a, b);
        if (b > c) std::swap(b, c);
        if (a > b) std::swap(a, b);
        put(a, Others{b, c, static_cast<std::uint32_t>(t)});
      }
    };
    by_smallest_vertex<Others>(mesh_.vertices.size(), list, [this](std::int32_t, std::span<Others> sorted) {
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i].same(sorted[i - 1]))
          add(name(sorted[i].triangle) + "the same vertices as triangle " + std::to_string(sorted[i - 1].triangle));
    });
  }

  void check_unused() {
    std::vector<bool> used(mesh_.vertices.size());
    for (const auto& triangle : mesh_.triangles)
      for (const std::int32_t v : triangle) used[v] = true;
    for (const Cell& cell : mesh_.cells)
      for (const std::int32_t v : cell.nodes)
        if (v >= 0 && std::size_t(v) < used.size()) used[v] = true;
    for (const Key& edge : mesh_.edges) used[edge[0]] = used[edge[1]] = true;  // curves of space may have no triangle
    for (const std::int32_t v : mesh_.edge_mids)
      if (v >= 0 && std::size_t(v) < used.size()) used[v] = true;
    for (std::size_t v = 0; v < used.size(); ++v)
      if (!used[v]) add("vertex " + std::to_string(v) + ": it belongs to no triangle");
  }

  void check_edges() {
    std::vector<Key> curves;
    for (const Key& edge : mesh_.edges) curves.push_back(ordered(edge[0], edge[1]));
    std::sort(curves.begin(), curves.end());
    auto curve = curves.begin();
    std::vector<Side> sides;
    for_each_edge(mesh_.triangles, mesh_.vertices.size(),
                  [&](std::int32_t low, std::int32_t high, std::span<const SideFrom> all) {
                    const Key key{low, high};
                    while (curve != curves.end() && *curve < key) ++curve;
                    sides.clear();
                    for (const SideFrom& side : all) sides.push_back({ref_of(side.triangle), side.forward()});
                    std::sort(sides.begin(), sides.end());
                    check_edge(key, sides, curve != curves.end() && *curve == key);
                  });
  }

  // `sides` of one edge are sorted by reference.
  void check_edge(const Key& key, const std::vector<Side>& sides, bool on_curve) {
    const std::size_t n = sides.size();
    if (n == 1 && options_.closed) add(name(key) + "it has only one triangle");
    if (on_curve) return;
    for (std::size_t from = 0, to = 0; from < n; from = to) {
      while (to < n && sides[to].ref == sides[from].ref) ++to;
      const bool against = to - from == 2 && n == 2 && sides[from].forward == sides[from + 1].forward;
      if (to - from <= 2 && !against) continue;
      add(name(key) + std::to_string(to - from) + " triangles of reference " + std::to_string(sides[from].ref) +
          " share it" + (against ? " and are turned against each other" : ""));
    }
  }

  const FlatMesh& mesh_;
  const DefectOptions& options_;
  std::vector<std::string> defects_;
};

}  // namespace

std::vector<std::string> find_defects(const FlatMesh& mesh, const DefectOptions& options, const std::vector<std::string>* of_elements) {
  return FlatDefectFinder(mesh, options).run(of_elements);
}

}  // namespace carreau
