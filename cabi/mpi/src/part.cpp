// SPDX-License-Identifier: BSD-3-Clause
#include "part.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "calls.h"

namespace carreau_mpi {

namespace {

constexpr std::int32_t not_here = -1;

/// The least rank with a triangle at each vertex; `size`, no rank, for a vertex without triangles.
std::vector<std::int32_t> owners_of_vertices(const WholeMesh& mesh, const std::vector<std::int32_t>& rank_of, int size) {
  std::vector<std::int32_t> owner(mesh.vertices.size(), size);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::int32_t v : mesh.triangles[t]) owner[static_cast<std::size_t>(v)] = std::min(owner[static_cast<std::size_t>(v)], rank_of[t]);
  // Nodes between corners, which straight triangles do not have: rank 0's, so that each vertex has an owner.
  std::replace(owner.begin(), owner.end(), static_cast<std::int32_t>(size), 0);
  return owner;
}

/// Layer of each triangle: 0 of the part itself, not_here beyond the last one.
std::vector<std::int32_t> layers_of(const WholeMesh& mesh, const std::vector<std::int32_t>& rank_of, int rank, int layers) {
  std::vector<std::int32_t> layer(mesh.triangles.size(), not_here);
  std::vector<char> reached(mesh.vertices.size(), 0);
  for (std::int32_t l = 0; l <= layers; ++l) {
    std::vector<std::size_t> added;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& corners = mesh.triangles[t];
      const bool in = l == 0 ? rank_of[t] == rank
                             : layer[t] == not_here && std::any_of(corners.begin(), corners.end(), [&](std::int32_t v) {
                                 return reached[static_cast<std::size_t>(v)] != 0;
                               });
      if (in) added.push_back(t);
    }
    for (const std::size_t t : added) {
      layer[t] = l;
      for (const std::int32_t v : mesh.triangles[t]) reached[static_cast<std::size_t>(v)] = 1;
    }
  }
  return layer;
}

/// Consecutive by rank, in each rank ascending.
std::vector<std::int64_t> rows_of(const std::vector<std::int32_t>& owner, int size) {
  std::vector<std::int64_t> next(static_cast<std::size_t>(size) + 1, 0), row(owner.size());
  for (const std::int32_t rank : owner) ++next[static_cast<std::size_t>(rank) + 1];
  for (std::size_t r = 1; r < next.size(); ++r) next[r] += next[r - 1];
  for (std::size_t v = 0; v < owner.size(); ++v) row[v] = next[static_cast<std::size_t>(owner[v])]++;
  return row;
}

/// Numbers 0 ... n - 1 for which take(i) is true first, then those for which ghost(i) is.
template <typename Own, typename Ghost>
std::vector<std::int64_t> own_first(std::size_t n, Own&& own, Ghost&& ghost, std::int64_t& own_count) {
  std::vector<std::int64_t> numbers;
  for (std::size_t i = 0; i < n; ++i)
    if (own(i)) numbers.push_back(static_cast<std::int64_t>(i));
  own_count = static_cast<std::int64_t>(numbers.size());
  for (std::size_t i = 0; i < n; ++i)
    if (!own(i) && ghost(i)) numbers.push_back(static_cast<std::int64_t>(i));
  return numbers;
}

}  // namespace

void require(carreau_mesh* mesh, carreau_status status) {
  if (status != CARREAU_OK) throw Failure(status, carreau_mesh_last_error(mesh));
}

namespace {

// Elements come by kind. The first triangle of an element has its first three corners.
void list_elements(carreau_mesh* mesh, ListedPart& all) {
  constexpr std::array<std::pair<std::int32_t, std::size_t>, 4> kinds{
      {{CARREAU_CELL_TRIANGLE3, 3}, {CARREAU_CELL_TRIANGLE6, 6}, {CARREAU_CELL_QUAD4, 4}, {CARREAU_CELL_QUAD8, 8}}};
  std::map<std::array<std::int32_t, 3>, std::size_t> triangles;
  bool other = false;
  for (const auto& [kind, size] : kinds) {
    std::int64_t n = 0;
    require(mesh, carreau_mesh_cell_count(mesh, kind, &n));
    other = other || (n > 0 && kind != CARREAU_CELL_TRIANGLE3);
  }
  if (!other) return;
  for (std::size_t t = 0; t < all.part.corners.size(); ++t) triangles[all.part.corners[t]] = t;
  for (const auto& [kind, size] : kinds) {
    std::int64_t n = 0;
    require(mesh, carreau_mesh_cell_count(mesh, kind, &n));
    std::vector<std::int32_t> nodes(static_cast<std::size_t>(n) * size);
    if (n > 0) require(mesh, carreau_mesh_cells(mesh, kind, n, nodes.data(), nullptr));
    for (auto at = nodes.begin(); at != nodes.end(); at += static_cast<std::ptrdiff_t>(size))
      all.elements.push_back({kind, {at, at + static_cast<std::ptrdiff_t>(size)}, triangles.at({at[0], at[1], at[2]})});
  }
}

}  // namespace

ListedPart listed(const carreau_part& part) {
  carreau_mesh* const mesh = part.mesh.get();
  ListedPart all;
  std::int64_t n = 0, m = 0;
  require(mesh, carreau_mesh_count(mesh, &n, &m, nullptr, nullptr));
  const auto vertices = static_cast<std::size_t>(n), triangles = static_cast<std::size_t>(m);
  all.xyz.resize(3 * vertices), all.refs.resize(triangles);
  carreau_part& lists = all.part;
  lists.own_triangles = part.own_triangles, lists.own_vertices = part.own_vertices;
  lists.triangle.resize(triangles), lists.triangle_owner.resize(triangles), lists.corners.resize(triangles);
  lists.vertex.resize(vertices), lists.vertex_owner.resize(vertices);
  require(mesh, carreau_mesh_part_vertices(mesh, n, lists.vertex.data(), lists.vertex_owner.data(), nullptr));
  require(mesh, carreau_mesh_part_triangles(mesh, m, lists.triangle.data(), lists.triangle_owner.data()));
  if (n > 0) require(mesh, carreau_mesh_vertices(mesh, n, all.xyz.data()));
  if (m == 0) return all;
  require(mesh, carreau_mesh_triangles(mesh, m, lists.corners.front().data()));
  require(mesh, carreau_mesh_triangle_refs(mesh, m, all.refs.data()));
  list_elements(mesh, all);
  return all;
}

WholeMesh whole_mesh(carreau_mesh* mesh) {
  std::int64_t n = 0, m = 0;
  require(mesh, carreau_mesh_count(mesh, &n, &m, nullptr, nullptr));
  WholeMesh whole;
  whole.vertices.resize(static_cast<std::size_t>(n));
  whole.triangles.resize(static_cast<std::size_t>(m));
  if (n > 0) require(mesh, carreau_mesh_vertices(mesh, n, whole.vertices.front().data()));
  if (m > 0) require(mesh, carreau_mesh_triangles(mesh, m, whole.triangles.front().data()));
  return whole;
}

carreau_part part_of(const WholeMesh& mesh, int rank, int size, int layers) {
  const std::vector<std::int32_t> rank_of = bisect(mesh, size), owner = owners_of_vertices(mesh, rank_of, size),
                                  layer = layers_of(mesh, rank_of, rank, layers);
  const std::vector<std::int64_t> row = rows_of(owner, size);
  carreau_part part;
  part.triangle = own_first(
      mesh.triangles.size(), [&](std::size_t t) { return layer[t] == 0; },
      [&](std::size_t t) { return layer[t] != not_here; }, part.own_triangles);
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const std::int64_t t : part.triangle)
    for (const std::int32_t v : mesh.triangles[static_cast<std::size_t>(t)]) used[static_cast<std::size_t>(v)] = 1;
  part.vertex = own_first(
      mesh.vertices.size(), [&](std::size_t v) { return owner[v] == rank; },
      [&](std::size_t v) { return used[v] != 0; }, part.own_vertices);
  std::vector<std::int32_t> local(mesh.vertices.size(), not_here);
  for (std::size_t i = 0; i < part.vertex.size(); ++i) {
    const auto v = static_cast<std::size_t>(part.vertex[i]);
    local[v] = static_cast<std::int32_t>(i);
    part.vertex_owner.push_back(owner[v]);
    part.row.push_back(row[v]);
  }
  for (const std::int64_t number : part.triangle) {
    const auto t = static_cast<std::size_t>(number);
    part.triangle_owner.push_back(rank_of[t]);
    part.triangle_layer.push_back(layer[t]);
    auto& corners = part.corners.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) corners[i] = local[static_cast<std::size_t>(mesh.triangles[t][i])];
  }
  return part;
}

}  // namespace carreau_mpi

namespace {

template <typename Row, typename Out>
void copy(const std::vector<Row>& rows, Out* out) {
  if (out != nullptr) std::copy(rows.begin(), rows.end(), out);
}

bool has_room(std::int64_t capacity, std::size_t rows) {
  return capacity >= 0 && static_cast<std::uint64_t>(capacity) >= rows;
}

/// Copies the triangles of a part that owns its mesh.
carreau_status copy_triangles(const carreau_part& part, std::int64_t capacity, std::int64_t* numbers, std::int32_t* owners, std::int32_t* layers,
                              std::int32_t* vertices) {
  carreau_mesh* const mesh = part.mesh.get();
  std::int64_t m = 0;
  carreau_status status = carreau_mesh_count(mesh, nullptr, &m, nullptr, nullptr);
  if (status == CARREAU_OK) status = carreau_mesh_part_triangles(mesh, capacity, numbers, owners);
  if (status == CARREAU_OK && vertices != nullptr) status = carreau_mesh_triangles(mesh, capacity, vertices);
  for (std::int64_t t = 0; status == CARREAU_OK && layers != nullptr && t < m; ++t) layers[t] = t < part.own_triangles ? 0 : 1;
  return status;
}

}  // namespace

carreau_status carreau_part_create(carreau_mesh* mesh, int32_t rank, int32_t size, int32_t layers,
                                   carreau_part** out_part) {
  if (mesh == nullptr || out_part == nullptr || size < 1 || rank < 0 || rank >= size || layers < 0)
    return CARREAU_ERR_ARGUMENT;
  try {
    auto part = std::make_unique<carreau_part>(carreau_mpi::part_of(carreau_mpi::whole_mesh(mesh), rank, size, layers));
    *out_part = part.release();
    return CARREAU_OK;
  } catch (const carreau_mpi::Failure& failure) {
    return failure.status;
  } catch (const std::bad_alloc&) {
    return CARREAU_ERR_MEMORY;
  } catch (...) {
    return CARREAU_ERR_INTERNAL;
  }
}

carreau_status carreau_part_mesh(const carreau_part* part, carreau_mesh** out_mesh) {
  if (part == nullptr || out_mesh == nullptr) return CARREAU_ERR_ARGUMENT;
  if (!part->mesh) return CARREAU_ERR_SEQUENCE;
  *out_mesh = part->mesh.get();
  return CARREAU_OK;
}

void carreau_part_free(carreau_part* part) { delete part; }

carreau_status carreau_part_count(const carreau_part* part, int64_t* out_own_triangles, int64_t* out_triangles,
                                  int64_t* out_own_vertices, int64_t* out_vertices) {
  if (part == nullptr) return CARREAU_ERR_ARGUMENT;
  auto vertices = static_cast<std::int64_t>(part->vertex.size()), triangles = static_cast<std::int64_t>(part->triangle.size());
  if (part->mesh)
    if (const carreau_status status = carreau_mesh_count(part->mesh.get(), &vertices, &triangles, nullptr, nullptr); status != CARREAU_OK)
      return status;
  if (out_own_triangles != nullptr) *out_own_triangles = part->own_triangles;
  if (out_triangles != nullptr) *out_triangles = triangles;
  if (out_own_vertices != nullptr) *out_own_vertices = part->own_vertices;
  if (out_vertices != nullptr) *out_vertices = vertices;
  return CARREAU_OK;
}

carreau_status carreau_part_triangles(const carreau_part* part, int64_t capacity, int64_t out_numbers[],
                                      int32_t out_owners[], int32_t out_layers[], int32_t out_vertices[]) {
  if (part == nullptr || !has_room(capacity, part->triangle.size())) return CARREAU_ERR_ARGUMENT;
  if (part->mesh) return copy_triangles(*part, capacity, out_numbers, out_owners, out_layers, out_vertices);
  copy(part->triangle, out_numbers);
  copy(part->triangle_owner, out_owners);
  copy(part->triangle_layer, out_layers);
  if (out_vertices != nullptr)
    for (const auto& corners : part->corners) out_vertices = std::copy(corners.begin(), corners.end(), out_vertices);
  return CARREAU_OK;
}

carreau_status carreau_part_vertices(const carreau_part* part, int64_t capacity, int64_t out_numbers[],
                                     int32_t out_owners[], int64_t out_rows[]) {
  if (part == nullptr || !has_room(capacity, part->vertex.size())) return CARREAU_ERR_ARGUMENT;
  if (part->mesh) return carreau_mesh_part_vertices(part->mesh.get(), capacity, out_numbers, out_owners, out_rows);
  copy(part->vertex, out_numbers);
  copy(part->vertex_owner, out_owners);
  copy(part->row, out_rows);
  return CARREAU_OK;
}
