// SPDX-License-Identifier: BSD-3-Clause
#include "volume/solid_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "check/crossings.h"
#include "volume/shell_check.h"

namespace command {
namespace {

/// The longest edge at each vertex, or the prescribed size if it is smaller.
std::vector<double> sizes_of(carreau_mesh* mesh, const SolidSurface& surface, const std::vector<std::int32_t>& index, std::size_t nodes) {
  std::vector<double> sizes(surface.vertices.size(), 0), prescribed(nodes);
  for (const auto& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
      const Point &p = surface.vertices[a], &q = surface.vertices[b];
      const double length = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      sizes[a] = std::max(sizes[a], length), sizes[b] = std::max(sizes[b], length);
    }
  if (carreau_mesh_vertex_sizes(mesh, static_cast<std::int64_t>(nodes), prescribed.data()) == CARREAU_OK)
    for (std::size_t v = 0; v < nodes; ++v)
      if (index[v] >= 0 && prescribed[v] > 0) {
        double& size = sizes[static_cast<std::size_t>(index[v])];
        size = std::min(size, prescribed[v]);
      }
  return sizes;
}

void take_mids(const std::vector<Element>& elements, const MeshArrays& arrays, const std::vector<std::int32_t>& index, SolidSurface& surface) {
  for (const Element& element : elements) {
    if (element.corners() == 4)
      throw Failure("Engines fill surfaces of triangles, and this mesh has quadrilaterals: choose --element p1 or p2.");
    if (!element.is_curved()) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = index[static_cast<std::size_t>(element.nodes[k])], b = index[static_cast<std::size_t>(element.nodes[(k + 1) % 3])];
      surface.mids[{std::min(a, b), std::max(a, b)}] = arrays.vertices[static_cast<std::size_t>(element.nodes[k + 3])];
    }
  }
}

constexpr const char* to_imprint = " Solids that touch must share faces: see --imprint.";

bool are_of_different_solids(const std::array<std::int32_t, 2>& faces, const SolidSurface& surface) {
  std::array<std::array<std::int32_t, 2>, 2> solids{};
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const std::size_t k : {0U, 1U})
      if (surface.refs[t] == faces[k]) solids[k] = surface.sides[t];
  for (const std::int32_t a : solids[0])
    for (const std::int32_t b : solids[1])
      if (a == b && a > 0) return false;
  return true;
}

/// Solids that touch without common faces have vertices at one place.
void refuse_equal_places(const std::vector<Point>& vertices) {
  std::vector<Point> places = vertices;
  std::sort(places.begin(), places.end());
  std::size_t count = 0;
  const Point* first = nullptr;
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i] == places[i - 1] && count++ == 0) first = &places[i];
  if (first == nullptr) return;
  char text[300];
  std::snprintf(text, sizeof text, "No engine can fill the mesh: %zu vertices lie at the place of another vertex, the first at (%.9g, %.9g, %.9g).%s", count,
                (*first)[0], (*first)[1], (*first)[2], to_imprint);
  throw Failure(text);
}

}  // namespace

SolidSurface solid_surface_of(carreau_mesh* mesh, int threads) {
  const MeshArrays arrays = arrays_of(mesh);
  SolidSurface surface;
  std::vector<std::int32_t> index(arrays.vertices.size(), -1);
  for (const auto& t : arrays.triangles)
    for (const std::int32_t v : t) index[static_cast<std::size_t>(v)] = 0;
  for (std::size_t v = 0; v < index.size(); ++v)
    if (index[v] == 0) index[v] = static_cast<std::int32_t>(surface.vertices.size()), surface.vertices.push_back(arrays.vertices[v]);
  take_mids(arrays.elements, arrays, index, surface);
  for (const auto& t : arrays.triangles)
    surface.triangles.push_back({index[static_cast<std::size_t>(t[0])], index[static_cast<std::size_t>(t[1])], index[static_cast<std::size_t>(t[2])]});
  surface.refs = arrays.triangle_refs;
  surface.sides.resize(surface.triangles.size());
  if (surface.triangles.empty()) throw Failure("There is no triangle.");
  if (carreau_mesh_triangle_sides(mesh, static_cast<std::int64_t>(surface.sides.size()), surface.sides.front().data()) != CARREAU_OK)
    throw Failure("No engine can fill the mesh: " + std::string(carreau_mesh_last_error(mesh)) + ".");
  const Crossings crossings = crossings_of(mesh, threads);
  if (crossings.pairs > 0)
    throw Failure("No engine can fill the mesh: " + crossings_count(crossings.pairs) + "; " + sentences_of(crossings, 1).front() + "." +
                  (are_of_different_solids(crossings.faces.front().faces, surface) ? to_imprint : ""));
  refuse_equal_places(surface.vertices);
  surface.sizes = sizes_of(mesh, surface, index, arrays.vertices.size());
  Point low = surface.vertices.front(), high = low;
  for (const Point& p : surface.vertices)
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  surface.diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    std::array<Point, 3> c;
    for (std::size_t k = 0; k < 3; ++k) {
      c[k] = surface.vertices[static_cast<std::size_t>(surface.triangles[t][k])];
      for (std::size_t x = 0; x < 3; ++x) c[k][x] -= .5 * (low[x] + high[x]);
    }
    const double volume = (c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1]) + c[0][1] * (c[1][2] * c[2][0] - c[1][0] * c[2][2]) +
                           c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0])) / 6;
    const auto [out_of, into] = surface.sides[t];
    if (out_of > 0) surface.volumes[out_of] += volume;
    if (into > 0) surface.volumes[into] -= volume;
  }
  for (const auto& [solid, volume] : surface.volumes) surface.solids[solid] = carreau_mesh_entity_name(mesh, 3, solid);
  for (const FaceResult& face : arrays.faces) surface.faces[face.ref] = face.name;
  check_shells(surface);
  return surface;
}

}  // namespace command
