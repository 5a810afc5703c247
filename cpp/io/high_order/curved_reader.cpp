// SPDX-License-Identifier: BSD-3-Clause
#include "io/high_order/curved_reader.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>

#include "io/curved_rows.h"
#include "io/files.h"
#include "io/mesh_files.h"
#include "io/text.h"
#include "io/words.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

using Key = std::array<std::int32_t, 2>;

/// Calls use(nodes, corners) for each row.
template <typename Mesh, typename Use>
void for_rows(Mesh& mesh, const Use& use) {
  const auto p = static_cast<std::size_t>(mesh.order);
  const auto each = [&](auto& rows, std::size_t width, int corners) {
    for (std::size_t row = 0; row < rows.size(); row += width) use(std::span(rows).subspan(row, width), corners);
  };
  each(mesh.triangles, (p + 1) * (p + 2) / 2, 3), each(mesh.quads, (p + 1) * (p + 1), 4), each(mesh.edges, p + 1, 2);
}

// Corners come first, in the order of the file; nodes without an element leave.
void number_corners_first(HighOrderMesh& mesh, const FlatMesh& nodes) {
  std::vector<char> kind(nodes.vertices.size(), 0);
  for_rows(mesh, [&](std::span<std::int32_t> row, int corners) {
    for (std::size_t i = 0; i < row.size(); ++i) kind[row[i]] = std::max(kind[row[i]], i < static_cast<std::size_t>(corners) ? char{2} : char{1});
  });
  std::vector<std::int32_t> number(kind.size(), -1);
  for (const char wanted : {char{2}, char{1}}) {
    for (std::size_t v = 0; v < kind.size(); ++v) {
      if (kind[v] != wanted) continue;
      number[v] = static_cast<std::int32_t>(mesh.nodes.size());
      mesh.nodes.push_back(nodes.vertices[v]);
      if (wanted == 2) mesh.corner_refs.push_back(v < nodes.vertex_refs.size() ? nodes.vertex_refs[v] : 0);
    }
    if (wanted == 2) mesh.corners = static_cast<std::int32_t>(mesh.nodes.size());
  }
  for_rows(mesh, [&](std::span<std::int32_t> row, int) {
    for (std::int32_t& node : row) node = number[node];
  });
}

/// The elements of order 2 through the middles of edges.
class Lowerer {
 public:
  explicit Lowerer(const HighOrderMesh& mesh) : mesh_(mesh), p_(static_cast<std::size_t>(mesh.order)) {
    const std::vector<double> at = places_on_edge(mesh.order, mesh.places);
    for (std::size_t k = 0; k <= p_; ++k) {
      double weight = 1;
      for (std::size_t m = 0; m <= p_; ++m)
        if (m != k) weight *= (0.5 - at[m]) / (at[k] - at[m]);
      weights_.push_back(weight);
    }
    flat_.vertices.assign(mesh.nodes.begin(), mesh.nodes.begin() + mesh.corners);
    flat_.vertex_refs = mesh.corner_refs;
  }

  FlatMesh run() {
    std::size_t element = 0;
    for_rows(mesh_, [&](std::span<const std::int32_t> row, int corners) {
      if (corners == 2) return;
      const bool quad = corners == 4;
      const std::size_t index = quad ? element - mesh_.triangle_refs.size() : element;
      Cell cell{quad ? CellKind::quad8 : CellKind::triangle6};
      const auto n = static_cast<std::size_t>(corners);
      for (std::size_t i = 0; i < n; ++i) {
        cell.nodes[i] = row[i];
        cell.nodes[n + i] = middle(row[i], row[(i + 1) % n], row.subspan(n + i * (p_ - 1), p_ - 1));
      }
      add_cell(flat_, cell, (quad ? mesh_.quad_refs : mesh_.triangle_refs)[index]);
      ++element;
    });
    for (std::size_t e = 0; e < mesh_.edge_refs.size(); ++e) {
      const std::span<const std::int32_t> row = std::span(mesh_.edges).subspan(e * (p_ + 1), p_ + 1);
      flat_.edges.push_back({row[0], row[1]}), flat_.edge_refs.push_back(mesh_.edge_refs[e]);
      flat_.edge_mids.push_back(middle(row[0], row[1], row.subspan(2)));
    }
    flat_.vertex_refs.resize(flat_.vertices.size(), 0);
    for (const auto& [ref, name] : mesh_.face_names) flat_.faces.push_back({.ref = ref, .status = FaceStatus::meshed, .name = name});
    return std::move(flat_);
  }

 private:
  std::int32_t middle(std::int32_t a, std::int32_t b, std::span<const std::int32_t> between) {
    const auto [known, is_new] = middles_.try_emplace(std::min(between.front(), between.back()), static_cast<std::int32_t>(flat_.vertices.size()));
    if (is_new) {
      Vec3 sum = weights_.front() * mesh_.nodes[a] + weights_.back() * mesh_.nodes[b];
      for (std::size_t k = 0; k < between.size(); ++k) sum += weights_[k + 1] * mesh_.nodes[between[k]];
      flat_.vertices.push_back(sum);
    }
    return known->second;
  }

  const HighOrderMesh& mesh_;
  std::size_t p_;
  std::vector<double> weights_;
  FlatMesh flat_;
  std::map<std::int32_t, std::int32_t> middles_;  // by the least node of an edge, which no other edge has
};

MeshOfFile with_order_2(HighOrderMesh mesh, const FlatMesh& nodes) {
  number_corners_first(mesh, nodes);
  for (const FlatFace& face : nodes.faces)
    if (!face.name.empty()) mesh.face_names.emplace_back(face.ref, face.name);
  FlatMesh flat = Lowerer(mesh).run();
  return {std::move(flat), std::make_shared<const HighOrderMesh>(std::move(mesh))};
}

/// MFEM's text: words, and comments from # on.
class MfemReader {
 public:
  MfemReader(std::string_view content, const std::string& name) : in_(content, name, '#') {}

  HighOrderMesh read() {
    for (const char* word : {"MFEM", "mesh", "v1.0", "dimension"}) expect(word);
    const char* at = in_.position();
    if (in_.integer("the dimension") != 2) in_.fail(at, "surfaces have dimension 2");
    expect("elements");
    const std::size_t count = in_.count("elements", 5);
    std::vector<std::array<std::int32_t, 4>> elements;
    std::vector<std::int32_t> refs;
    for (std::size_t e = 0; e < count; ++e) {
      refs.push_back(in_.integer("an attribute"));
      const int corners = geometry();
      if (corners < 3) in_.fail(in_.position(), "element " + std::to_string(e) + " (from 0) is no triangle and no quadrilateral");
      std::array<std::int32_t, 4>& own = elements.emplace_back();
      own = {-1, -1, -1, -1};
      for (int i = 0; i < corners; ++i) own[i] = in_.integer("a vertex");
    }
    expect("boundary");
    const std::size_t sides = in_.count("boundary elements", 4);
    std::vector<std::array<std::int32_t, 3>> boundary;
    for (std::size_t e = 0; e < sides; ++e) {
      const std::int32_t ref = in_.integer("an attribute");
      if (geometry() != 2) in_.fail(in_.position(), "boundary element " + std::to_string(e) + " (from 0) is no segment");
      const std::int32_t a = in_.integer("a vertex"), b = in_.integer("a vertex");
      boundary.push_back({a, b, ref});
    }
    expect("vertices");
    const std::int32_t vertices = in_.integer("the number of vertices");
    if (vertices < 0 || static_cast<std::size_t>(vertices) > 4 * elements.size())
      in_.fail(in_.position(), std::to_string(vertices) + " vertices are announced; " + std::to_string(elements.size()) + " elements have other numbers of corners");
    const auto check = [&](std::int32_t v) {
      if (v < 0 || v >= vertices)
        in_.fail(in_.position(), "an element names vertex " + std::to_string(v) + " of " + std::to_string(vertices));
    };
    for (const auto& own : elements)
      for (std::size_t i = 0; i < (own[3] < 0 ? 3U : 4U); ++i) check(own[i]);
    for (const auto& [a, b, ref] : boundary) check(a), check(b);
    for (const char* word : {"nodes", "FiniteElementSpace", "FiniteElementCollection:"}) expect(word);
    collection();
    expect("VDim:"), expect("3"), expect("Ordering:"), expect("1");
    mesh_.nodes.assign(static_cast<std::size_t>(vertices), Vec3(0, 0, 0)), mesh_.corner_refs.assign(mesh_.nodes.size(), 0), mesh_.corners = vertices;
    for (std::size_t e = 0; e < elements.size(); ++e) add_element(elements[e], refs[e]);
    for (const auto& [a, b, ref] : boundary) add_side(a, b, ref);
    // A file that ends inside a line may have lost a part of its last number.
    if (const char last = in_.end()[-1]; last != '\n' && last != '\r' && last != ' ') in_.fail(in_.end(), "the last line does not end: the file may be truncated");
    return std::move(mesh_);
  }

 private:
  void expect(std::string_view word) {
    const std::string_view found = in_.word();
    if (found != word) in_.fail(found.empty() ? in_.end() : found.data(), "'" + std::string(word) + "' was expected, not " + shown(found));
  }

  int geometry() {
    constexpr int segment = 1, triangle = 2, square = 3;
    const std::int32_t type = in_.integer("a type of geometry");
    return type == segment || type == triangle || type == square ? type + 1 : 0;
  }

  void collection() {
    const std::string_view name = in_.word(), known = "L2_T1_2D_P";
    int order = 0;
    if (!name.starts_with(known) || !parse_number(name.substr(known.size()), order) || order < 2 || order > 4)
      in_.fail(name.empty() ? in_.end() : name.data(), "the collection is " + shown(name) + "; L2_T1_2D_P2, P3 and P4 are read only");
    mesh_.order = order, mesh_.places = NodePlaces::gauss_lobatto;
    for (const bool quad : {false, true}) rank_[quad ? 1 : 0] = mfem_ranks(quad, order);
  }

  Vec3 point() {
    Vec3 p;
    for (int i = 0; i < 3; ++i) p[i] = in_.real("a coordinate");
    return p;
  }

  void add_element(const std::array<std::int32_t, 4>& corner, std::int32_t ref) {
    const bool quad = corner[3] >= 0;
    const std::vector<std::size_t>& rank = rank_[quad ? 1 : 0];
    const std::size_t corners = quad ? 4 : 3, p = static_cast<std::size_t>(mesh_.order);
    std::vector<Vec3> x(rank.size());
    for (const std::size_t place : rank) x[place] = point();
    std::vector<std::int32_t> nodes;
    for (std::size_t i = 0; i < corners; ++i) nodes.push_back(corner[i]), mesh_.nodes[corner[i]] = x[i];
    for (std::size_t i = 0; i < corners; ++i) {
      const std::int32_t a = corner[i], b = corner[(i + 1) % corners];
      const std::span<const Vec3> own = std::span(x).subspan(corners + i * (p - 1), p - 1);
      const std::int32_t first = nodes_of_edge(a, b, own, norm(x[(i + 1) % corners] - x[i]));
      for (std::size_t m = 0; m + 1 < p; ++m) nodes.push_back(first + static_cast<std::int32_t>(a < b ? m : p - 2 - m));
    }
    for (std::size_t i = nodes.size(); i < x.size(); ++i) nodes.push_back(static_cast<std::int32_t>(mesh_.nodes.size())), mesh_.nodes.push_back(x[i]);
    add_curved(mesh_, mesh_.order, static_cast<int>(corners), nodes, ref);
  }

  // First node, from the lesser vertex. Two edges may join the same vertices.
  std::int32_t nodes_of_edge(std::int32_t a, std::int32_t b, std::span<const Vec3> x, double chord) {
    constexpr double same = 1e-9;  // of the chord
    std::vector<Vec3> ordered(x.begin(), x.end());
    if (a > b) std::reverse(ordered.begin(), ordered.end());
    std::vector<std::int32_t>& known = edges_[{std::min(a, b), std::max(a, b)}];
    for (const std::int32_t first : known)
      if (norm(mesh_.nodes[first] - ordered.front()) <= same * chord) return first;
    known.push_back(static_cast<std::int32_t>(mesh_.nodes.size()));
    mesh_.nodes.insert(mesh_.nodes.end(), ordered.begin(), ordered.end());
    return known.back();
  }

  void add_side(std::int32_t a, std::int32_t b, std::int32_t ref) {
    const auto edge = edges_.find({std::min(a, b), std::max(a, b)});
    if (edge == edges_.end()) in_.fail(in_.position(), "the boundary between vertices " + std::to_string(a) + " and " + std::to_string(b) + " is no edge");
    std::vector<std::int32_t> nodes{a, b};
    for (int m = 0; m + 1 < mesh_.order; ++m) nodes.push_back(edge->second.front() + (a < b ? m : mesh_.order - 2 - m));
    add_curved(mesh_, mesh_.order, 2, nodes, ref);
  }

  Words in_;
  HighOrderMesh mesh_;
  std::vector<std::size_t> rank_[2];
  std::map<Key, std::vector<std::int32_t>> edges_;
};

}  // namespace

HighOrderMesh read_curved_mfem(std::string_view content, const std::string& name) { return MfemReader(content, name).read(); }

MeshOfFile read_mesh_of_any_order(const std::string& path) {
  const std::string suffix = suffix_of(path);
  const bool gmsh = suffix == ".msh" || suffix == ".msh2";
  if (!gmsh && suffix != ".vtu" && suffix != ".mesh") return {read_mesh(path)};
  const std::string content = read_file(path);
  HighOrderMesh curved;
  curved.places = NodePlaces::equidistant;
  if (suffix == ".mesh") {
    if (!content.starts_with("MFEM mesh")) return {starts_as_gmf(content) ? read_mesh_binary(content, path) : read_mesh_text(content, path)};
    curved = read_curved_mfem(content, path);
    FlatMesh nodes;
    nodes.vertices = std::move(curved.nodes), nodes.vertex_refs = std::move(curved.corner_refs);
    curved.nodes.clear(), curved.corner_refs.clear();
    return with_order_2(std::move(curved), nodes);
  }
  FlatMesh flat = gmsh ? read_mesh_msh(content, path, curved) : read_mesh_vtu(content, path, curved);
  if (curved.triangle_refs.empty() && curved.quad_refs.empty()) return {std::move(flat)};
  return with_order_2(std::move(curved), flat);
}

}  // namespace carreau
