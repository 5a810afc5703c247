// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "io/mesh_writers.h"
#include "io/text.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

struct Facet {
  Vec3 normal;  ///< unit, or 0 when the triangle has no area
  std::array<Vec3, 3> corners;
};

Facet facet_of(const FlatMesh& mesh, std::size_t i) {
  Facet facet;
  for (std::size_t k = 0; k < 3; ++k) {
    facet.corners[k] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[i][k])];
    if (mesh.dimension == 2) facet.corners[k].z() = 0;
  }
  const Vec3 n = cross(facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0]);
  const double length = norm(n);
  if (std::isfinite(length) && length > 0) facet.normal = (1 / length) * n;
  if (!is_finite(facet.normal)) facet.normal = {};
  return facet;
}

/// The format is little-endian whatever the machine.
void append_little(std::string& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((value >> shift) & 0xFFu);
}

void append_single(std::string& bytes, double value) {
  append_little(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

void check_single_precision(const FlatMesh& mesh) {
  constexpr double largest = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& p = mesh.vertices[i];
    if (std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())}) > largest)
      throw InvalidArgument("vertex " + std::to_string(i) +
                            " (from 0) has a coordinate too large for the single precision of binary STL");
  }
}

void append_point(std::string& text, const char* before, Vec3 p) {
  text += before;
  for (const double x : {p.x(), p.y(), p.z()}) {
    text += ' ';
    append_number(text, x);
  }
  text += '\n';
}

void append_solid(std::string& text, const FlatMesh& mesh, std::int32_t ref, const std::vector<std::size_t>& order,
                  std::size_t begin, std::size_t end) {
  const std::string name = name_of_face(mesh, ref, "surface_");
  text += "solid " + name + "\n";
  for (std::size_t i = begin; i < end; ++i) {
    const Facet facet = facet_of(mesh, order[i]);
    append_point(text, "facet normal", facet.normal);
    text += "outer loop\n";
    for (const Vec3& corner : facet.corners) append_point(text, "vertex", corner);
    text += "endloop\nendfacet\n";
  }
  text += "endsolid " + name + "\n";
}

}  // namespace

std::string stl_bytes(const FlatMesh& mesh) {
  constexpr std::size_t header_size = 80, facet_size = 50;
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    throw InvalidArgument("the mesh has more triangles than binary STL can count");
  check_single_precision(mesh);
  std::string bytes = "binary STL";  // must not start with "solid": readers take that for the text form
  bytes.reserve(header_size + 4 + facet_size * mesh.triangles.size());
  bytes.resize(header_size, ' ');
  append_little(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Facet facet = facet_of(mesh, i);
    for (const Vec3& p : {facet.normal, facet.corners[0], facet.corners[1], facet.corners[2]}) {
      append_single(bytes, p.x());
      append_single(bytes, p.y());
      append_single(bytes, p.z());
    }
    bytes.append(2, '\0');  // attribute byte count, unused
  }
  return bytes;
}

std::string name_of_face(const FlatMesh& mesh, std::int32_t ref, const std::string& prefix) {
  std::string name;
  for (const FlatFace& face : mesh.faces)
    if (face.ref == ref) name = plain_name(face.name);
  return name.empty() ? prefix + std::to_string(ref) : name;
}

std::string plain_name(const std::string& name) {
  std::string plain = without_controls(name);
  std::replace(plain.begin(), plain.end(), '"', '_');
  return plain;
}

std::string stl_text(const FlatMesh& mesh) {
  std::vector<std::size_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto ref = [&mesh](std::size_t i) { return ref_of(mesh.triangle_refs, i); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return ref(i) < ref(j); });
  std::string text;
  text.reserve(300 * order.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && ref(order[end]) == ref(order[begin])) ++end;
    append_solid(text, mesh, ref(order[begin]), order, begin, end);
    begin = end;
  }
  if (order.empty()) text = "solid empty\nendsolid empty\n";
  return text;
}

}  // namespace carreau
