// SPDX-License-Identifier: BSD-3-Clause
#include <carreau_atlas.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace {

using Squares = std::array<double, 8>;
constexpr Squares small = {-1, -1, 1, -1, 1, 1, -1, 1}, large = {-2, -2, 2, -2, 2, 2, -2, 2};

/// Twenty triangles, divided, on the unit sphere.
struct Sphere {
  std::vector<double> xyz;
  std::vector<std::int32_t> triangles;

  explicit Sphere(int level) {
    const double g = std::numbers::phi;
    xyz = {-1, g,  0,  1, g, 0,  -1, -g, 0,  1, -g, 0, 0,  -1, g,  0,  1, g,
           0,  -1, -g, 0, 1, -g, g,  0,  -1, g, 0,  1, -g, 0,  -1, -g, 0, 1};
    triangles = {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4,  11, 10, 2,  10, 7, 6, 7, 1, 8,
                 3, 9,  4, 3, 4, 2, 3, 2, 6, 3, 6, 8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6,  2,  10, 8,  6, 7, 9, 8, 1};
    for (int k = 0; k < level; ++k) divide();
    for (std::size_t v = 0; v < xyz.size(); v += 3) {
      const double r = std::hypot(xyz[v], xyz[v + 1], xyz[v + 2]);
      for (std::size_t c = 0; c < 3; ++c) xyz[v + c] /= r;
    }
  }
  [[nodiscard]] std::int64_t vertices() const { return static_cast<std::int64_t>(xyz.size() / 3); }
  [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(triangles.size() / 3); }

 private:
  std::int32_t middle(std::int32_t a, std::int32_t b) {
    std::array<double, 3> p{};
    for (std::size_t c = 0; c < 3; ++c)
      p[c] = (xyz[3 * static_cast<std::size_t>(a) + c] + xyz[3 * static_cast<std::size_t>(b) + c]) / 2;
    for (std::size_t v = 0; v < xyz.size(); v += 3)
      if (std::hypot(xyz[v] - p[0], xyz[v + 1] - p[1], xyz[v + 2] - p[2]) < 1e-9)
        return static_cast<std::int32_t>(v / 3);
    xyz.insert(xyz.end(), p.begin(), p.end());
    return static_cast<std::int32_t>(xyz.size() / 3 - 1);
  }
  void divide() {
    std::vector<std::int32_t> fine;
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
      const std::int32_t a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
      const std::int32_t x = middle(a, b), y = middle(b, c), z = middle(c, a);
      fine.insert(fine.end(), {a, x, z, x, b, y, z, y, c, x, y, z});
    }
    triangles = fine;
  }
};

TEST(CAtlas, LoopThereAndBack) {
  carreau_loop* loop = nullptr;
  ASSERT_EQ(carreau_loop_create(&loop), CARREAU_OK);
  double xy[2], derivative[2], phi = 1;
  EXPECT_EQ(carreau_loop_points(loop, 1, &phi, xy, derivative), CARREAU_ERR_SEQUENCE);
  ASSERT_EQ(carreau_loop_build(loop, 4, small.data(), CARREAU_LOOP_SMOOTH), CARREAU_OK);
  ASSERT_EQ(carreau_loop_points(loop, 1, &phi, xy, derivative), CARREAU_OK);
  EXPECT_NEAR(std::max(std::abs(xy[0]), std::abs(xy[1])), 1, 1e-14);
  double back = 0;
  ASSERT_EQ(carreau_loop_invert(loop, 1, xy, 1e-9, &back), CARREAU_OK);
  EXPECT_NEAR(back, phi, 1e-12);
  const double off[2] = {.2, .1};
  EXPECT_EQ(carreau_loop_invert(loop, 1, off, 1e-9, &back), CARREAU_ERR_ARGUMENT);
  std::int64_t pivots = 0;
  ASSERT_EQ(carreau_loop_pivots(loop, 0, nullptr, &pivots), CARREAU_OK);
  EXPECT_EQ(pivots, 4);
  const double crossed[8] = {0, 0, 2, 2, 2, 0, 0, 2};
  EXPECT_EQ(carreau_loop_build(loop, 4, crossed, CARREAU_LOOP_SMOOTH), CARREAU_ERR_DOMAIN);
  EXPECT_NE(std::string(carreau_loop_last_error(loop)).find("vertex 1"), std::string::npos);
  EXPECT_EQ(carreau_loop_points(loop, 1, &phi, xy, nullptr), CARREAU_OK);  // the loop is as before
  carreau_loop_free(loop);
  EXPECT_EQ(carreau_loop_build(nullptr, 4, small.data(), 0), CARREAU_ERR_ARGUMENT);
}

TEST(CAtlas, AnnulusThereAndBack) {
  carreau_annulus* annulus = nullptr;
  ASSERT_EQ(carreau_annulus_create(&annulus), CARREAU_OK);
  EXPECT_EQ(carreau_annulus_build(annulus, 4, small.data(), 4, small.data(), CARREAU_BORDER_SPLINE, 0),
            CARREAU_ERR_DOMAIN);
  EXPECT_NE(std::string(carreau_annulus_last_error(annulus)).find("no width"), std::string::npos);
  ASSERT_EQ(carreau_annulus_build(annulus, 4, small.data(), 4, large.data(), CARREAU_BORDER_SPLINE, 0), CARREAU_OK);
  for (int k = 0; k < 100; ++k) {
    const double place[2] = {.01 * k, .0628 * k};
    double xy[2], derivatives[4], back[2];
    std::int32_t zone = -1;
    ASSERT_EQ(carreau_annulus_points(annulus, 1, place, xy, derivatives), CARREAU_OK);
    EXPECT_GT(derivatives[0] * derivatives[3] - derivatives[1] * derivatives[2], 0);
    ASSERT_EQ(carreau_annulus_invert(annulus, 1, xy, back, &zone), CARREAU_OK);
    EXPECT_EQ(zone, CARREAU_ZONE_ANNULUS);
    EXPECT_NEAR(back[0], place[0], 1e-12);
    EXPECT_NEAR(std::remainder(back[1] - place[1], 2 * std::numbers::pi), 0, 1e-12);
  }
  const double points[4] = {0, 0, 5, 5};
  std::int32_t zones[2];
  ASSERT_EQ(carreau_annulus_invert(annulus, 2, points, nullptr, zones), CARREAU_OK);
  EXPECT_EQ(zones[0], CARREAU_ZONE_INSIDE);
  EXPECT_EQ(zones[1], CARREAU_ZONE_OUTSIDE);
  std::int64_t edges = 0;
  double skeleton[4 * 2];
  ASSERT_EQ(carreau_annulus_skeleton(annulus, 2, skeleton, &edges), CARREAU_OK);
  EXPECT_EQ(edges, 2);  // two ears, each joined with the middle of the diagonal
  std::int64_t corners = 0;
  ASSERT_EQ(carreau_annulus_outer_border(annulus, 0, nullptr, &corners), CARREAU_OK);
  std::vector<double> border(2 * std::size_t(corners));
  ASSERT_EQ(carreau_annulus_outer_border(annulus, corners, border.data(), &corners), CARREAU_OK);
  for (std::size_t i = 0; i < border.size(); i += 2) {  // inside of the given outer border, around the inner border
    EXPECT_LE(std::max(std::abs(border[i]), std::abs(border[i + 1])), 2 + 1e-12);
    EXPECT_GE(std::max(std::abs(border[i]), std::abs(border[i + 1])), 1);
  }
  carreau_annulus_free(annulus);
}

TEST(CAtlas, SphereIsCoveredBlendedAndMeshed) {
  const Sphere sphere(2);
  carreau_atlas* atlas = nullptr;
  ASSERT_EQ(carreau_atlas_create(&atlas), CARREAU_OK);
  ASSERT_EQ(carreau_atlas_build(atlas, nullptr, sphere.vertices(), sphere.xyz.data(), sphere.count(),
                                sphere.triangles.data(), nullptr),
            CARREAU_OK)
      << carreau_atlas_last_error(atlas);
  carreau_atlas_counts counts{};
  counts.struct_size = sizeof counts;
  ASSERT_EQ(carreau_atlas_count(atlas, &counts), CARREAU_OK);
  EXPECT_EQ(2 * counts.charts - counts.triples, 4);  // Euler's number of the dual triangulation, twice
  carreau_atlas_chart chart{};
  chart.struct_size = sizeof chart;
  ASSERT_EQ(carreau_atlas_chart_info(atlas, 0, &chart), CARREAU_OK);
  for (int i = 0; i < 3; ++i)  // u, v and the normal are a frame
    EXPECT_NEAR(chart.u[(i + 1) % 3] * chart.v[(i + 2) % 3] - chart.u[(i + 2) % 3] * chart.v[(i + 1) % 3],
                chart.normal[i], 1e-12);
  EXPECT_EQ(carreau_atlas_chart_info(atlas, counts.charts, &chart), CARREAU_ERR_ARGUMENT);
  for (std::int64_t i = 0; i < counts.charts; ++i)
    for (int k = 0; k < 10; ++k) {
      const double place[2] = {.05 + .09 * k, .6 * k};
      double xy[2], xyz[3], weight = 0;
      ASSERT_EQ(carreau_atlas_annulus_points(atlas, i, 1, place, xy), CARREAU_OK);
      ASSERT_EQ(carreau_atlas_points(atlas, i, 1, xy, xyz, nullptr), CARREAU_OK);
      EXPECT_NEAR(std::hypot(xyz[0], xyz[1], xyz[2]), 1, .01);
      ASSERT_EQ(carreau_atlas_zones(atlas, i, 1, xy, nullptr, &weight), CARREAU_OK);
      for (std::int64_t j = 0; j < counts.charts; ++j) {
        if (j == i) continue;
        double there[2], same[3], other = 0;
        std::int32_t found = 0;
        ASSERT_EQ(carreau_atlas_transition(atlas, i, j, 1, xy, there, &found), CARREAU_OK);
        if (found == 0) continue;
        ASSERT_EQ(carreau_atlas_points(atlas, j, 1, there, same, nullptr), CARREAU_OK);
        ASSERT_EQ(carreau_atlas_zones(atlas, j, 1, there, nullptr, &other), CARREAU_OK);
        weight += other;
        EXPECT_NEAR(std::hypot(xyz[0] - same[0], xyz[1] - same[1], xyz[2] - same[2]), 0, 1e-12);
      }
      EXPECT_NEAR(weight, 1, 1e-12);
    }
  carreau_session* session = nullptr;
  ASSERT_EQ(carreau_session_create(&session), CARREAU_OK);
  ASSERT_EQ(carreau_add_atlas(session, atlas), CARREAU_OK) << carreau_last_error(session);
  carreau_atlas_free(atlas);  // the session has its own
  carreau_set_real(session, "hphydef", .2);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << carreau_last_error(session);
  carreau_mesh* mesh = nullptr;
  ASSERT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
  std::int64_t vertices = 0, triangles = 0, edges = 0, faces = 0;
  ASSERT_EQ(carreau_mesh_count(mesh, &vertices, &triangles, &edges, &faces), CARREAU_OK);
  EXPECT_EQ(2 * vertices - triangles, 4);  // closed, of Euler number 2
  std::vector<double> xyz(3 * static_cast<std::size_t>(vertices));
  ASSERT_EQ(carreau_mesh_vertices(mesh, vertices, xyz.data()), CARREAU_OK);
  for (std::size_t v = 0; v < xyz.size(); v += 3) EXPECT_NEAR(std::hypot(xyz[v], xyz[v + 1], xyz[v + 2]), 1, .01);
  carreau_session_free(session);
}

TEST(CAtlas, BadTriangulationsAreReportedWithTheVertex) {
  Sphere sphere(2);
  carreau_atlas* atlas = nullptr;
  ASSERT_EQ(carreau_atlas_create(&atlas), CARREAU_OK);
  const auto build = [&](const std::int32_t* clusters) {
    return carreau_atlas_build(atlas, nullptr, sphere.vertices(), sphere.xyz.data(), sphere.count(),
                               sphere.triangles.data(), clusters);
  };
  const auto says = [&](const char* words) {
    return std::string(carreau_atlas_last_error(atlas)).find(words) != std::string::npos;
  };
  const Sphere whole = sphere;
  sphere.triangles.resize(sphere.triangles.size() - 3);
  EXPECT_EQ(build(nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_TRUE(says("border at the edge of vertices")) << carreau_atlas_last_error(atlas);
  sphere = whole;
  std::swap(sphere.triangles[0], sphere.triangles[1]);
  EXPECT_EQ(build(nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_TRUE(says("turned differently")) << carreau_atlas_last_error(atlas);
  sphere = whole;
  sphere.triangles[5] = 4000;
  EXPECT_EQ(build(nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_TRUE(says("vertex 4001")) << carreau_atlas_last_error(atlas);
  sphere = whole;
  sphere.xyz[7] = NAN;
  EXPECT_EQ(build(nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_TRUE(says("vertex 3")) << carreau_atlas_last_error(atlas);
  sphere = whole;
  std::vector<std::int32_t> clusters(static_cast<std::size_t>(sphere.vertices()), 0);
  EXPECT_EQ(build(clusters.data()), CARREAU_ERR_DOMAIN);
  EXPECT_TRUE(says("whole surface")) << carreau_atlas_last_error(atlas);
  clusters[5] = 1;
  EXPECT_EQ(build(clusters.data()), CARREAU_ERR_DOMAIN);
  EXPECT_TRUE(says("vertex")) << carreau_atlas_last_error(atlas);
  clusters[5] = 3;
  EXPECT_EQ(build(clusters.data()), CARREAU_ERR_ARGUMENT);
  EXPECT_TRUE(says("without gaps")) << carreau_atlas_last_error(atlas);
  // A tetrahedron is divided until clusters have planes, or the sentence names a vertex, or the place of a fold.
  const double corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::int32_t faces[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  const carreau_status status = carreau_atlas_build(atlas, nullptr, 4, corners, 4, faces, nullptr);
  EXPECT_TRUE(status == CARREAU_OK || (status == CARREAU_ERR_DOMAIN && (says("vertex") || says("turned over near ("))))
      << carreau_atlas_last_error(atlas);
  carreau_atlas_free(atlas);
}

}  // namespace
