// SPDX-License-Identifier: BSD-3-Clause
// Files that several processes write: the bytes of parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "io/medit/gmf.h"
#include "io/medit/part_files.h"
#include "support/error.h"

namespace {

using namespace carreau;

/// A strip of triangles over numbered vertices.
FlatMesh strip(int triangles, int dimension) {
  FlatMesh mesh;
  mesh.dimension = dimension;
  for (int v = 0; v < triangles + 2; ++v) {
    mesh.vertices.push_back({0.5 * v, double(v % 2), dimension == 3 ? 0.1 * v * v : 0});
    mesh.vertex_refs.push_back(v % 5);
  }
  for (std::int32_t t = 0; t < triangles; ++t) mesh.triangles.push_back({t, t + 1, t + 2}), mesh.triangle_refs.push_back(t % 3 + 1);
  return mesh;
}

/// The triangles and vertices of every `ranks`-th number, with ghost vertices behind own ones.
struct Part {
  PartMesh numbers;
  FlatMesh mesh;
};
Part part_of(const FlatMesh& whole, int rank, int ranks) {
  Part part;
  part.numbers.rank = rank, part.numbers.processes = ranks;
  part.numbers.vertices = std::ssize(whole.vertices), part.numbers.triangles = std::ssize(whole.triangles);
  part.numbers.file_edges = std::ssize(whole.edges);
  if (rank == 0) part.numbers.file_edge_vertices = whole.edges, part.numbers.file_edge_refs = whole.edge_refs;
  part.mesh.dimension = whole.dimension;
  std::map<std::int32_t, std::int32_t> here;
  const auto add = [&](std::int32_t v) {
    if (!here.emplace(v, std::int32_t(here.size())).second) return;
    part.numbers.vertex_number.push_back(v);
    part.mesh.vertices.push_back(whole.vertices[std::size_t(v)]), part.mesh.vertex_refs.push_back(whole.vertex_refs[std::size_t(v)]);
  };
  for (std::int32_t v = rank; v < std::ssize(whole.vertices); v += ranks) add(v);
  part.numbers.own_vertices = std::ssize(part.mesh.vertices);
  for (std::int32_t t = rank; t < std::ssize(whole.triangles); t += ranks) {
    for (const std::int32_t v : whole.triangles[std::size_t(t)]) add(v);
    const auto [a, b, c] = whole.triangles[std::size_t(t)];
    part.mesh.triangles.push_back({here[a], here[b], here[c]}), part.mesh.triangle_refs.push_back(whole.triangle_refs[std::size_t(t)]);
    part.numbers.triangle_number.push_back(t);
  }
  part.numbers.own_triangles = std::ssize(part.mesh.triangles);
  return part;
}

TEST(GmfParts, AreTogetherTheFileOfOneProcess) {
  for (const int dimension : {2, 3})
    for (const int ranks : {1, 2, 5}) {
      FlatMesh whole = strip(40, dimension);
      if (ranks == 2) whole.edges = {{0, 2}, {2, 4}}, whole.edge_refs = {7, 8};
      const std::string expected = mesh_bytes(whole, MeshFormat::meshb);
      std::string all(expected.size(), '\0');
      std::vector<int> times(expected.size(), 0);
      for (int rank = 0; rank < ranks; ++rank) {
        const Part part = part_of(whole, rank, ranks);
        std::uint64_t reached = 0;
        write_part(part.numbers, part.mesh, MeshFormat::meshb, [&](std::uint64_t position, std::string_view bytes) {
          ASSERT_LE(position + bytes.size(), all.size());
          EXPECT_GE(position, reached);
          reached = position + bytes.size();
          std::copy(bytes.begin(), bytes.end(), all.begin() + std::ptrdiff_t(position));
          for (std::size_t k = 0; k < bytes.size(); ++k) ++times[position + k];
        });
      }
      EXPECT_EQ(all, expected);
      EXPECT_TRUE(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
    }
}

// Beyond 2^31 - 1 triangles references and indices have 64 bits, and positions are beyond 2^32.
TEST(GmfParts, NumberBeyond32Bits) {
  Part part = part_of(strip(1, 3), 0, 1);
  part.numbers.rank = 1;
  constexpr std::int64_t vertices = 5'000'000'000, triangles = 10'000'000'000;
  part.numbers.vertices = vertices, part.numbers.triangles = triangles;
  part.numbers.vertex_number = {vertices - 3, vertices - 2, vertices - 1}, part.numbers.triangle_number = {triangles - 1};
  std::map<std::uint64_t, std::string> written;
  write_part(part.numbers, part.mesh, MeshFormat::meshb, [&](std::uint64_t position, std::string_view bytes) { written.emplace(position, bytes); });
  ASSERT_EQ(written.size(), 2u);
  constexpr std::uint64_t header = 4 + 8 + 8, first = 8 + 4 + 8 + 4;  // of a section in version 4; of the file with its dimension
  constexpr std::uint64_t vertex = 3 * 8 + 8, triangle = 4 * 8;
  const std::uint64_t of_vertices = first + header + (vertices - 3) * vertex, end_of_vertices = first + header + vertices * vertex;
  ASSERT_TRUE(written.contains(of_vertices));
  EXPECT_EQ(written[of_vertices].size(), 3 * vertex);
  const std::uint64_t of_triangles = end_of_vertices + header + (triangles - 1) * triangle;
  ASSERT_TRUE(written.contains(of_triangles));
  std::int64_t corners[4];
  ASSERT_EQ(written[of_triangles].size(), sizeof corners);
  std::memcpy(corners, written[of_triangles].data(), sizeof corners);
  EXPECT_EQ(corners[0], vertices - 2);
  EXPECT_EQ(corners[2], vertices);
  EXPECT_EQ(corners[3], 1);
}

TEST(GmfParts, RejectOtherFormatsAndCoordinates) {
  Part part = part_of(strip(3, 3), 0, 1);
  const PositionedSink nowhere = [](std::uint64_t, std::string_view) {};
  EXPECT_THROW(write_part(part.numbers, part.mesh, MeshFormat::mesh, nowhere), InvalidArgument);
  part.mesh.vertices[1] = {0, std::nan(""), 0};
  EXPECT_THROW(write_part(part.numbers, part.mesh, MeshFormat::meshb, nowhere), InvalidArgument);
}

}  // namespace
