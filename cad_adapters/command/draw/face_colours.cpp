// SPDX-License-Identifier: BSD-3-Clause
#include "draw/face_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <unordered_map>

namespace command {
namespace {

float linear_of_srgb(int byte) {
  const double s = byte / 255.0;
  return static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
}

constexpr std::size_t palette_size = 12;

/// Soft colours, far apart for neighbours in the list.
Colour face_colour(std::size_t rank) {
  static constexpr int palette[palette_size] = {0x8fb8de, 0xf2c078, 0x9fd0a4, 0xe39b94, 0xb9a7d6, 0xe8dc8c,
                                                0x86cbc7, 0xe9aec8, 0xb7c48a, 0xa9b7c9, 0xd9b99b, 0x9bb0e6};
  return srgb(palette[rank % palette_size]);
}

}  // namespace

Colour srgb(int hex) {
  return {linear_of_srgb(hex >> 16 & 255), linear_of_srgb(hex >> 8 & 255), linear_of_srgb(hex & 255)};
}

std::uint64_t side_key(std::int32_t a, std::int32_t b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
}

std::unordered_set<std::uint64_t> sides_on_curves(const MeshArrays& mesh) {
  std::unordered_set<std::uint64_t> curves;
  for (const auto& [a, b] : mesh.edges) curves.insert(side_key(a, b));
  if (!mesh.edges.empty()) return curves;
  std::unordered_map<std::uint64_t, std::int32_t> first;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t side = side_key(mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]);
      const auto [at, fresh] = first.emplace(side, mesh.triangle_refs[i]);
      if (!fresh && at->second != mesh.triangle_refs[i]) curves.insert(side);
    }
  return curves;
}

std::map<std::int32_t, Colour> colours_of_references(const MeshArrays& mesh) {
  std::vector<std::int32_t> order;
  std::map<std::int32_t, std::set<std::int32_t>> beside;
  std::unordered_map<std::uint64_t, std::int32_t> first;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::int32_t ref = mesh.triangle_refs[i];
    if (beside.try_emplace(ref).second) order.push_back(ref);
    for (int k = 0; k < 3; ++k) {
      const auto [at, fresh] = first.emplace(side_key(mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]), ref);
      if (!fresh && at->second != ref) beside[ref].insert(at->second), beside[at->second].insert(ref);
    }
  }
  std::map<std::int32_t, std::size_t> place;
  std::map<std::int32_t, Colour> colours;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    std::array<bool, palette_size> taken{};
    for (const std::int32_t ref : beside[order[rank]])
      if (const auto found = place.find(ref); found != place.end()) taken[found->second] = true;
    // Beginning at the rank, so that few faces far from each other share a colour.
    std::size_t k = rank % palette_size, tried = 0;
    while (taken[k] && ++tried < palette_size) k = (k + 1) % palette_size;
    place[order[rank]] = k, colours[order[rank]] = face_colour(k);
  }
  return colours;
}

std::map<std::int32_t, Colour> colours_of_faces(const MeshArrays& mesh) {
  const bool own = std::any_of(mesh.faces.begin(), mesh.faces.end(), [](const FaceResult& f) { return f.rgb >= 0; });
  if (!own) return colours_of_references(mesh);
  std::map<std::int32_t, Colour> colours;
  for (const std::int32_t ref : mesh.triangle_refs) colours.try_emplace(ref, srgb(grey));
  for (const FaceResult& face : mesh.faces)
    if (face.rgb >= 0) colours[face.ref] = srgb(face.rgb);
  return colours;
}

}  // namespace command
