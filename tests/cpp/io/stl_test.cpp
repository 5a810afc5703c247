// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "io/mesh_files.h"
#include "io_test_support.h"

namespace carreau {
namespace {

std::uint32_t integer_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + k])) << 8 * k;
  return value;
}
float number_at(const std::string& bytes, std::size_t at) { return std::bit_cast<float>(integer_at(bytes, at)); }

TEST(Stl, BinaryHoldsEveryTriangleWithItsNormal) {
  const FlatMesh mesh = square();
  const std::string bytes = mesh_bytes(mesh, MeshFormat::stl);
  ASSERT_EQ(bytes.size(), 84u + 2 * 50);
  EXPECT_NE(bytes.substr(0, 5), "solid");
  EXPECT_EQ(integer_at(bytes, 80), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    // The square is inclined by atan(1/2): its normal is (0, -1, 2) / sqrt(5).
    EXPECT_FLOAT_EQ(number_at(bytes, 84 + 50 * i), 0);
    EXPECT_FLOAT_EQ(number_at(bytes, 88 + 50 * i), static_cast<float>(-1 / std::sqrt(5.0)));
    EXPECT_FLOAT_EQ(number_at(bytes, 92 + 50 * i), static_cast<float>(2 / std::sqrt(5.0)));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.vertices[static_cast<std::size_t>(mesh.triangles[i][k])];
      EXPECT_EQ(number_at(bytes, 96 + 50 * i + 12 * k), static_cast<float>(p.x()));
      EXPECT_EQ(number_at(bytes, 100 + 50 * i + 12 * k), static_cast<float>(p.y()));
      EXPECT_EQ(number_at(bytes, 104 + 50 * i + 12 * k), static_cast<float>(p.z()));
    }
    EXPECT_EQ(bytes.substr(84 + 50 * i + 48, 2), std::string(2, '\0'));
  }
}

TEST(Stl, AFileOfAllThatItCanCountIsTooShort) {
  std::string bytes(84, ' ');
  std::fill(bytes.begin() + 80, bytes.end(), '\xff');
  EXPECT_EQ(sentence_of<FileError>([&] { read_mesh_stl(bytes, "x.stl"); }),
            "x.stl: the file does not start with solid, as STL text does, and binary STL of 4294967295 triangles has "
            "214748364834 bytes instead of 84");
}

TEST(Stl, TextHasOneSolidForEachReference) {
  FlatMesh mesh = square();
  mesh.dimension = 2;  // z counts for nothing
  EXPECT_EQ(mesh_bytes(mesh, MeshFormat::stl, {.ascii_stl = true}),
            "solid surface_-2\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\n"
            "endfacet\nendsolid surface_-2\n"
            "solid surface_7\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\n"
            "endfacet\nendsolid surface_7\n");
}

TEST(Stl, ATriangleWithoutAreaHasAZeroNormal) {
  FlatMesh mesh = square();
  mesh.vertices[2] = {0.5, 0, 0};
  const std::string bytes = mesh_bytes(mesh, MeshFormat::stl);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(number_at(bytes, 84 + 4 * k), 0);
}

TEST(Stl, CoordinatesBeyondSinglePrecisionAreRejectedInBinary) {
  FlatMesh mesh = square();
  mesh.vertices[1].x() = 1e39;
  EXPECT_EQ(sentence_of<InvalidArgument>([&] { mesh_bytes(mesh, MeshFormat::stl); }),
            "vertex 1 (from 0) has a coordinate too large for the single precision of binary STL");
  EXPECT_NE(mesh_bytes(mesh, MeshFormat::stl, {.ascii_stl = true}).find("vertex 1e+39 0 0"), std::string::npos);
}

}  // namespace
}  // namespace carreau
