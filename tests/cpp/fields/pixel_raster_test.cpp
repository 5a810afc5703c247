// SPDX-License-Identifier: BSD-3-Clause
#include "fields/pixel_raster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "fields/false_colours.h"

namespace carreau {
namespace {

PlaneSegments polygon(const std::vector<Vec2>& points) {
  PlaneSegments loop{points, {}};
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i) loop.segments.emplace_back(i, (i + 1) % n);
  return loop;
}

PlaneSegments circle(Vec2 centre, double radius, int corners) {
  std::vector<Vec2> points;
  for (int i = 0; i < corners; ++i) {
    const double a = 2 * std::numbers::pi * i / corners;
    points.push_back(centre + radius * Vec2{std::cos(a), std::sin(a)});
  }
  return polygon(points);
}

double area_of_mask(const PlaneSegments& loops, const PixelGrid& grid) {
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(grid.width * grid.height));
  DomainRaster(loops, grid).mask(0, grid.height, mask);
  return std::accumulate(mask.begin(), mask.end(), 0.0) * grid.pixel().x() * grid.pixel().y();
}

// A ring: the area of an outer polygon without the area of a hole; the error of counting pixels falls with their size.
TEST(DomainRaster, MaskHasTheAreaOfTheDomain) {
  const int corners = 400;
  PlaneSegments ring = circle({0.1, 0.2}, 1, corners);
  const PlaneSegments hole = circle({0, 0}, 0.5, corners);
  for (const Vec2& p : hole.vertices) ring.vertices.push_back(p);
  for (const auto& [a, b] : hole.segments) ring.segments.emplace_back(b + corners, a + corners);
  const double exact =
      (1 - 0.25) * corners / 2.0 * std::sin(2 * std::numbers::pi / corners);  // of the polygons, not of the circles
  for (const int side : {16, 64, 256, 1024}) {
    const PixelGrid grid{{-0.9, -0.8}, {1.1, 1.2}, side, side + 3};
    EXPECT_NEAR(area_of_mask(ring, grid), exact, 1.5 / side) << side;
  }
}

TEST(DomainRaster, RowsInPiecesAreTheSame) {
  const PixelGrid grid{{-1, -1}, {1, 1}, 77, 101};
  const DomainRaster raster(circle({0, 0}, 1, 33), grid);
  std::vector<std::uint8_t> whole(77 * 101), piece(77);
  raster.mask(0, 101, whole);
  for (int row = 0; row < 101; ++row) {
    raster.mask(row, 1, piece);
    EXPECT_TRUE(std::equal(piece.begin(), piece.end(), whole.begin() + 77 * row)) << row;
  }
}

// Rows count from the largest v, columns from the smallest u; a rectangle that is the whole box leaves nothing out.
TEST(DomainRaster, RowZeroIsAtTheLargestV) {
  const PixelGrid grid{{0, 0}, {4, 2}, 8, 4};
  EXPECT_EQ(grid.centre(0, 0), (Vec2{0.25, 1.75}));
  EXPECT_EQ(grid.centre(7, 3), (Vec2{3.75, 0.25}));
  std::vector<std::uint8_t> mask(32);
  DomainRaster(polygon({{0, 1}, {2, 1}, {2, 2}, {0, 2}}), grid).mask(0, 4, mask);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 8; ++column)
      EXPECT_EQ(mask[static_cast<std::size_t>(8 * row + column)], row < 2 && column < 4 ? 1 : 0);
  EXPECT_EQ(area_of_mask(polygon({{0, 0}, {4, 0}, {4, 2}, {0, 2}}), grid), 8);
  EXPECT_EQ(area_of_mask(polygon({{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}), grid), 8);  // larger than the image
  EXPECT_EQ(area_of_mask(polygon({{5, 5}, {9, 5}, {9, 9}}), grid), 0);
  EXPECT_EQ(area_of_mask({}, grid), 0);
}

// Centres on edges and vertices of a grid of triangles: each pixel has exactly one triangle, and one that holds it.
TEST(TriangleRaster, EachPixelHasOneTriangle) {
  std::mt19937 random(7);
  for (const bool exact : {true, false}) {
    const int n = 16;
    std::vector<Vec2> vertices;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const bool inner = !exact && i > 0 && j > 0 && i < n && j < n;
        const auto shift = [&] { return inner ? 0.3 * (std::uniform_real_distribution(-1.0, 1.0)(random)) : 0.0; };
        const double x = i + shift(), y = j + shift();
        vertices.push_back({x, y});
      }
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
      }
    // 32 pixels: centres at quarters; 16 and odd counts: on diagonals, and anywhere.
    for (const int side : {16, 32, 47, 301}) {
      SCOPED_TRACE(side);
      const PixelGrid grid{{0, 0}, {double(n), double(n)}, side, side};
      std::vector<std::uint32_t> found(static_cast<std::size_t>(side * side));
      TriangleRaster(vertices, triangles, grid).triangles(0, side, found);
      std::vector<std::uint8_t> mask(found.size());
      DomainRaster(polygon({{0, 0}, {double(n), 0}, {double(n), double(n)}, {0, double(n)}}), grid).mask(0, side, mask);
      std::size_t k = 0;
      for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column, ++k) {
          EXPECT_EQ(mask[k], 1);
          ASSERT_NE(found[k], TriangleRaster::none);
          const Vec2 p = grid.centre(column, row);
          const auto& t = triangles[found[k]];
          for (int i = 0; i < 3; ++i)
            EXPECT_GE(cross(vertices[t[(i + 1) % 3]] - vertices[t[i]], p - vertices[t[i]]), -1e-13);
        }
    }
  }
}

TEST(LineRaster, CoverageIsLengthTimesWidth) {
  const PixelGrid grid{{0, 0}, {10, 10}, 200, 200};
  std::mt19937 random(3);
  std::uniform_real_distribution at(2.0, 8.0);
  for (const double width : {1.2, 2.6}) {
    for (int i = 0; i < 20; ++i) {
      const Vec2 a{at(random), at(random)}, b{at(random), at(random)};
      std::vector<float> ink(200 * 200);
      LineRaster({{a, b}, {{0, 1}}}, width, grid).coverage(0, 200, ink);
      const double length = norm(grid.in_pixels(b) - grid.in_pixels(a));
      const double sum = std::accumulate(ink.begin(), ink.end(), 0.0);
      const double cap = std::numbers::pi / 4 * width * width;  // round ends
      EXPECT_NEAR(sum, length * width + cap, 0.03 * length * width + 0.4 * (1 + width)) << length;
    }
  }
}

TEST(FalseColours, GoFromRedToBlueAndAreLightEnoughForLines) {
  for (int i = 0; i <= 100; ++i) {
    const auto [r, g, b] = false_colour(i / 100.0);
    EXPECT_GT(0.2126 * r + 0.7152 * g + 0.0722 * b, 0.12) << i;  // relative luminance
    for (const float x : {r, g, b}) EXPECT_TRUE(x >= 0 && x <= 1);
  }
  EXPECT_GT(false_colour(-1)[0], 3 * false_colour(0)[2]);
  EXPECT_GT(false_colour(2)[2], 3 * false_colour(1)[0]);
  EXPECT_EQ(place_of_size(1, 1, 100), 0);
  EXPECT_NEAR(place_of_size(10, 1, 100), 0.5, 1e-15);
  EXPECT_EQ(place_of_size(500, 1, 100), 1);
  EXPECT_EQ(place_of_size(3, 3, 3), 0.5);
}

}  // namespace
}  // namespace carreau
