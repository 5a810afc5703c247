// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>

#include "io/files.h"
#include "io/medit/gmf.h"
#include "io/mesh_files.h"
#include "io/mesh_writers.h"
#include "io_test_support.h"

namespace carreau {
namespace {

/// Three vertices, one triangle of reference 9 and a section that surface meshes do without, in any version.
std::string triangle_file(int version, bool big_endian) {
  Bytes b(big_endian);
  const std::int64_t position = version >= 3 ? 8 : 4, index = version == 4 ? 8 : 4, real = version == 1 ? 4 : 8;
  const auto integer = [&](std::int64_t value) { index == 8 ? b.i64(value) : b.i32(value); };
  const auto number = [&](double value) { real == 4 ? b.f32(static_cast<float>(value)) : b.f64(value); };
  const auto section = [&](std::int64_t code, std::int64_t content) {
    const std::int64_t next = code == 54 ? 0 : b.size() + 4 + position + content;
    b.i32(code);
    position == 8 ? b.i64(next) : b.i32(next);
  };
  b.i32(1).i32(version);
  section(3, 4);
  b.i32(3);
  section(13, index + 2 * index);  // Corners
  for (const int value : {2, 1, 2}) integer(value);
  section(4, index + 3 * (3 * real + index));
  integer(3);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) number(i * 0.5 - k);
    integer(-i);
  }
  section(6, index + 4 * index);
  for (const int value : {1, 1, 2, 3, 9}) integer(value);
  section(8, index + 5 * index);  // flat, but a tetrahedron
  for (const int value : {1, 3, 2, 1, 3, 7}) integer(value);
  section(54, 0);
  return b.text();
}

std::string error_of(std::string_view bytes) {
  return sentence_of<FileError>([&] { read_mesh_binary(bytes, "x.meshb"); });
}

TEST(Gmf, ReadsVersions1To4InBothByteOrders) {
  for (int version = 1; version <= 4; ++version)
    for (const bool big_endian : {false, true}) {
      const FlatMesh mesh = read_mesh_binary(triangle_file(version, big_endian), "x.meshb");
      ASSERT_EQ(mesh.vertices.size(), 3u);
      EXPECT_EQ(mesh.vertices[2], (Vec3{1, 0, -1}));
      EXPECT_EQ(mesh.vertex_refs, (std::vector<std::int32_t>{0, -1, -2}));
      ASSERT_EQ(mesh.triangles.size(), 1u);
      EXPECT_EQ(mesh.triangles[0], (std::array<std::int32_t, 3>{0, 1, 2}));
      EXPECT_EQ(mesh.triangle_refs[0], 9);
      EXPECT_EQ(mesh.tetrahedra, (std::vector<std::array<std::int32_t, 4>>{{2, 1, 0, 2}}));
    }
}

TEST(Gmf, WritesVersion2ByteForByte) {
  FlatMesh mesh = square();
  mesh.dimension = 2;
  mesh.edges.clear();
  mesh.edge_refs.clear();
  Bytes b(std::endian::native == std::endian::big);
  b.i32(1).i32(2).i32(3).i32(20).i32(2);
  b.i32(4).i32(20 + 12 + 4 * 20).i32(4);
  for (const auto& [x, y, ref] : {std::tuple{0, 0, 1}, {1, 0, 2}, {1, 1, 0}, {0, 1, 4}}) b.f64(x).f64(y).i32(ref);
  b.i32(6).i32(112 + 12 + 2 * 16).i32(2);
  b.i32(1).i32(2).i32(3).i32(7).i32(1).i32(3).i32(4).i32(-2);
  b.i32(54).i32(0);
  EXPECT_EQ(mesh_bytes(mesh, MeshFormat::meshb), b.text());
}

TEST(Gmf, Version3HasTheSameMeshWithPositionsOf64Bits) {
  const FlatMesh mesh = square();
  const std::string v2 = gmf_bytes(mesh, 2), v3 = gmf_bytes(mesh, 3);
  EXPECT_EQ(v3.size(), v2.size() + 5 * 4);  // five sections
  expect_same_geometry(read_mesh_binary(v3, "x"), read_mesh_binary(v2, "x"));
  EXPECT_FALSE(gmf_needs_64_bits(mesh));
}

// Files too large to be made here: only their counts are tested.
TEST(Gmf, PositionsGoBeyond32Bits) {
  constexpr std::uint64_t many = (std::uint64_t{1} << 31) - 1, start = 20;
  const std::uint64_t triangles = gmf_next(start, 3, many, 28);
  EXPECT_EQ(triangles, 20 + 16 + 60129542116U);
  EXPECT_EQ(gmf_next(triangles, 3, many, 16), triangles + 16 + 34359738352U);
  EXPECT_EQ(gmf_next(start, 2, 4, 20), 20U + 12 + 80);
  constexpr GmfCounts large{.vertices = many, .triangles = many};
  EXPECT_EQ(gmf_most_bytes(large), 300 + 44 * many);
  EXPECT_TRUE(gmf_needs_64_bits(large));
  // 60 bytes a vertex, with its two triangles.
  constexpr std::uint64_t most = (many - 300) / 60;
  EXPECT_FALSE(gmf_needs_64_bits(GmfCounts{.vertices = most, .triangles = 2 * most}));
  EXPECT_TRUE(gmf_needs_64_bits(GmfCounts{.vertices = most + 1, .triangles = 2 * most + 2}));
}

// A triangle behind a section of three gigabytes, which is a hole in the file and never read.
TEST(Gmf, ReadsBeyond32Bits) {
  constexpr std::int64_t far = std::int64_t{3} << 30, vertices_end = far + 16 + 3 * 28, triangles_end = vertices_end + 32;
  const bool big_endian = std::endian::native == std::endian::big;
  Bytes head(big_endian), tail(big_endian);
  head.i32(1).i32(3).i32(3).i64(24).i32(3).i32(13).i64(far).i32(12345);
  tail.i32(4).i64(vertices_end).i32(3);
  for (int i = 0; i < 3; ++i) tail.f64(i == 1).f64(i == 2).f64(0.5).i32(i);
  tail.i32(5 + 1).i64(triangles_end).i32(1).i32(1).i32(2).i32(3).i32(9).i32(54).i64(0);
  const TemporaryFolder folder;
  NewFile file(folder.file("far.meshb"));
  file.write_at(0, head.text());
  file.write_at(far, tail.text());
  file.commit();
  const std::size_t size = std::filesystem::file_size(folder.file("far.meshb"));
  ASSERT_EQ(size, static_cast<std::size_t>(far) + tail.text().size());
  const int opened = open(folder.file("far.meshb").c_str(), O_RDONLY);
  void* const mapped = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, opened, 0);
  close(opened);
  ASSERT_NE(mapped, MAP_FAILED);
  const std::string_view bytes(static_cast<const char*>(mapped), size);
  const FlatMesh mesh = read_mesh_binary(bytes, "far.meshb");
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0.5}, {1, 0, 0.5}, {0, 1, 0.5}}));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}}));
  EXPECT_EQ(mesh.triangle_refs, std::vector<std::int32_t>{9});
  const std::string cut = error_of(bytes.substr(0, static_cast<std::size_t>(vertices_end)));
  EXPECT_EQ(cut, "x.meshb: byte 3221225572: the file ends before the section End");
  munmap(mapped, size);
}

TEST(Gmf, ComesInBlocks) {
  FlatMesh mesh;
  for (int k = 0; k < 100'000; ++k) {
    mesh.vertices.push_back({0.5 * k, 1.0 * k * k, 1. / (k + 1)});
    mesh.triangles.push_back({k, (k + 1) % 100'000, (k + 7) % 100'000});
  }
  for (const int version : {2, 3}) {
    std::string all;
    std::size_t largest = 0, blocks = 0;
    write_gmf(mesh, version, nullptr, [&](std::string_view block) {
      all += block;
      largest = std::max(largest, block.size());
      ++blocks;
    });
    EXPECT_EQ(all, gmf_bytes(mesh, version));
    EXPECT_LE(largest, std::size_t{1} << 20);
    EXPECT_EQ(blocks, 5U);  // 4 400 000 bytes
    const FlatMesh back = read_mesh_binary(all, "x");
    EXPECT_EQ(back.vertices, mesh.vertices);
    EXPECT_EQ(back.triangles, mesh.triangles);
  }
}

TEST(Gmf, EveryTruncationIsAnError) {
  for (int version = 1; version <= 4; ++version) {
    const std::string whole = triangle_file(version, false);
    for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_NE(error_of(std::string_view(whole).substr(0, n)), "") << n;
  }
}

TEST(Gmf, NamesTheByteOfEveryViolation) {
  const std::string header = Bytes().i32(1).i32(2).i32(3).i32(20).i32(3).text();
  const auto after_header = [&](const Bytes& b) { return error_of(header + b.text()); };
  EXPECT_EQ(error_of(""), "x.meshb: byte 0: the file ends inside the header");
  EXPECT_EQ(error_of("garbage!garbage!"), "x.meshb: byte 0: the file does not start with the mark of a binary mesh");
  EXPECT_EQ(error_of(Bytes().i32(1).i32(5).text()), "x.meshb: byte 4: version 5 is not one of 1, 2, 3, 4");
  EXPECT_EQ(after_header(Bytes()), "x.meshb: byte 20: the file ends before the section End");
  EXPECT_EQ(after_header(Bytes().i32(54).i32(0)), "x.meshb: byte 28: the file has no vertices");
  EXPECT_EQ(error_of(Bytes().i32(1).i32(2).i32(4).i32(20).i32(0).text()),
            "x.meshb: byte 16: vertices come before the dimension");
  EXPECT_EQ(error_of(Bytes().i32(1).i32(2).i32(3).i32(20).i32(7).text()),
            "x.meshb: byte 16: the dimension is 7 instead of 2 or 3");
  // A section that sends the reader backwards would be a loop.
  EXPECT_EQ(after_header(Bytes().i32(13).i32(8).i32(0)),
            "x.meshb: byte 20: section 13 ends at 8, which is outside of the file");
  EXPECT_EQ(after_header(Bytes().i32(13).i32(1000).i32(0)),
            "x.meshb: byte 20: section 13 ends at 1000, which is outside of the file");
  for (const std::int64_t count : {std::int64_t{2000000000}, std::int64_t{-1}, std::int64_t{2}})
    EXPECT_EQ(after_header(Bytes().i32(4).i32(60).i32(count).f64(0).f64(0).f64(0).i32(0)),
              "x.meshb: byte 28: " + std::to_string(count) + " vertices are announced, but there is room for 1");
  const auto one_vertex = [] { return Bytes().i32(4).i32(60).i32(1).f64(0).f64(0).f64(0).i32(0); };
  EXPECT_EQ(after_header(Bytes().i32(4).i32(60).i32(1).f64(0).f64(std::nan("")).f64(0).i32(0)),
            "x.meshb: byte 40: a coordinate is not finite");
  EXPECT_EQ(after_header(one_vertex().i32(5).i32(84).i32(1).i32(1).i32(2).i32(0).i32(54).i32(0)),
            "x.meshb: byte 72: edge 1 names a vertex that does not exist (there are 1)");
  EXPECT_EQ(after_header(one_vertex().i32(7).i32(84).i32(1).i32(1).i32(1).i32(1).i32(54).i32(0)),
            "x.meshb: byte 68: 1 quadrilaterals are announced, but there is room for 0");
  EXPECT_EQ(after_header(one_vertex().i32(24).i32(72).i32(0).i32(54).i32(0)), "");
  EXPECT_EQ(after_header(one_vertex().i32(4).i32(72).i32(0)), "x.meshb: byte 68: vertices are given twice");
  EXPECT_EQ(error_of(Bytes().i32(1).i32(4).i32(3).i64(24).i32(3).i32(4).i64(44).i64(std::int64_t{1} << 40).text() +
                     std::string(100, '\0')),
            "x.meshb: byte 36: 1099511627776 vertices are announced, but there is room for 0");
}

TEST(Gmf, IndicesOf64BitsThatDoNotFitAreRejected) {
  const auto b =
      Bytes().i32(1).i32(4).i32(3).i64(24).i32(2).i32(4).i64(68).i64(1).f64(0).f64(0).i64(std::int64_t{1} << 33);
  EXPECT_EQ(error_of(b.text()), "x.meshb: byte 60: the number 8589934592 does not fit in 32 bits");
}

}  // namespace
}  // namespace carreau
