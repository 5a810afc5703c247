// SPDX-License-Identifier: BSD-3-Clause
// Any triangles are a surface, or InvalidArgument with a sentence; two of them side by side are one.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "fuzz_check.h"
#include "geometry/discrete/refinement.h"
#include "geometry/discrete/side_by_side.h"
#include "support/error.h"

namespace {

using namespace carreau;

/// Four bytes a triangle: corners on a lattice, some places twice, and a reference.
FlatMesh mesh_of(const std::uint8_t* data, std::size_t size, double shift) {
  constexpr int places = 32, wide = 3;
  FlatMesh mesh;
  for (int i = 0; i < places; ++i) {
    const int p = i % (wide * wide * wide);
    mesh.vertices.emplace_back(p % wide + shift, p / wide % wide, p / (wide * wide));
  }
  for (std::size_t k = 0; k + 4 <= size; k += 4) {
    mesh.triangles.push_back({data[k] % places, data[k + 1] % places, data[k + 2] % places});
    mesh.triangle_refs.push_back(data[k + 3] % 4);
    if (data[k + 3] >= 128) mesh.edges.push_back({data[k] % places, data[k + 1] % places});
  }
  return mesh;
}

std::shared_ptr<const discrete::DiscreteSurface> surface_of(const FlatMesh& mesh, unsigned choice) {
  discrete::Triangulation triangulation(mesh, (choice & 1U) != 0);
  const auto& found = triangulation.findings;
  FUZZ_CHECK(found.euler_number == std::int64_t(triangulation.vertices.size()) - std::int64_t(triangulation.edges.size()) +
                                       std::int64_t(triangulation.triangles.size()));
  const discrete::SharpOptions options{.sharp_angle = (choice & 2U) != 0 ? 20.0 : 60.0,
                                       .marked_only = (choice & 4U) != 0,
                                       .references = (choice & 8U) != 0};
  discrete::SharpLines lines = find_sharp_lines(triangulation, options);
  std::int64_t edges = 0;
  for (const discrete::Line& line : lines.lines) edges += std::int64_t(line.edges.size());
  FUZZ_CHECK(edges == lines.edges);
  return std::make_shared<const discrete::DiscreteSurface>(std::move(triangulation), std::move(lines));
}

void check(const discrete::DiscreteSurface& surface) {
  for (std::int32_t t = 0; t < std::int32_t(surface.triangles()); ++t) {
    const SurfaceJet jet = surface.at(t, {0.25, 0.5}, want_position | want_first);
    FUZZ_CHECK(std::isfinite(norm(jet.s)) && std::isfinite(norm(jet.su)) && std::isfinite(norm(jet.sv)));
  }
  FUZZ_CHECK(face_refs(surface).size() == surface.triangles());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 9 || size > 97) return 0;
  const std::size_t half = 1 + (size - 1) / 8 * 4;
  try {
    const auto first = surface_of(mesh_of(data + 1, half - 1, 0), data[0]);
    check(*first);
    const auto second = surface_of(mesh_of(data + half, size - half, (data[0] & 16U) != 0 ? 0 : 2), data[0]);
    const std::vector<std::int32_t> refs = face_refs(*first);
    const std::int32_t behind = 1 + *std::ranges::max_element(refs);
    std::vector<std::string> sentences;
    const auto both = side_by_side(std::vector<discrete::PlacedSurface>{{first, 1}, {second, behind}}, sentences);
    check(*both);
    FUZZ_CHECK(both->triangles() <= first->triangles() + second->triangles());
    FUZZ_CHECK(both->triangles() >= std::max(first->triangles(), second->triangles()));
  } catch (const InvalidArgument& error) {
    FUZZ_CHECK(std::string(error.what()).size() > 10);
  }
  return 0;
}
