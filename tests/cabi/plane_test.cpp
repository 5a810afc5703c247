// SPDX-License-Identifier: BSD-3-Clause
// Plane domains of the C interface: arrays in, arrays out.
#include <carreau_geometry.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace {

class PlaneDomain : public ::testing::Test {
 protected:
  PlaneDomain() {
    carreau_session_create(&session);
    domain.struct_size = sizeof domain;
    domain.point_count = 8, domain.curve_count = 2;
    domain.points = points, domain.curve_starts = starts, domain.curve_points = passed;
  }
  ~PlaneDomain() override { carreau_session_free(session); }

  std::string error() const { return carreau_last_error(session); }
  void expect(carreau_status status) const { EXPECT_EQ(status, CARREAU_OK) << error(); }

  carreau_mesh* mesh(double size) {
    carreau_mesh* made = nullptr;
    expect(carreau_set_real(session, "hphydef", size));
    expect(carreau_set_real(session, "hphymin", 1e-4));
    expect(carreau_mesh_generate(session));
    expect(carreau_session_mesh(session, &made));
    return made;
  }

  double area(carreau_mesh* of) const {
    carreau_quality quality{};
    quality.struct_size = sizeof quality;
    expect(carreau_mesh_quality(of, &quality));
    return quality.area;
  }

  carreau_session* session = nullptr;
  // Two squares, of sides 4 and 2, around one point.
  double points[16] = {-2, -2, 2, -2, 2, 2, -2, 2, -1, -1, 1, -1, 1, 1, -1, 1};
  std::int64_t starts[3] = {0, 5, 10};
  std::int32_t passed[10] = {0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
  carreau_plane_domain domain{};
};

TEST_F(PlaneDomain, ParityInsideAndSidesDetermineTheDomain) {
  expect(carreau_add_plane_domain(session, &domain));
  EXPECT_NEAR(area(mesh(0.2)), 12, 1e-12);
  expect(carreau_model_clear(session));
  domain.rest = CARREAU_REST_INSIDE;
  expect(carreau_add_plane_domain(session, &domain));
  EXPECT_NEAR(area(mesh(0.2)), 16, 1e-12);
  expect(carreau_model_clear(session));
  domain.rest = CARREAU_REST_OUTSIDE;
  const std::int32_t sides[3] = {1, 1, 40};
  domain.side_count = 1, domain.sides = sides;
  expect(carreau_add_plane_domain(session, &domain));
  carreau_mesh* const made = mesh(0.2);
  EXPECT_NEAR(area(made), 4, 1e-13);
  std::int64_t n = 0;
  expect(carreau_mesh_count(made, nullptr, &n, nullptr, nullptr));
  std::vector<std::int32_t> refs(n);
  expect(carreau_mesh_triangle_refs(made, n, refs.data()));
  EXPECT_EQ(refs, std::vector<std::int32_t>(n, 40));
}

TEST_F(PlaneDomain, ReferencesThatSeveralPointsHaveAreShown) {
  const std::int32_t refs[8] = {7, 7, 7, 7, 0, 0, 0, -3}, curve_refs[2] = {5, 0};
  domain.point_refs = refs, domain.curve_refs = curve_refs;
  expect(carreau_add_plane_domain(session, &domain));
  carreau_mesh* const made = mesh(0.5);
  std::int64_t n = 0;
  expect(carreau_mesh_count(made, &n, nullptr, nullptr, nullptr));
  std::vector<std::int32_t> found(n);
  std::vector<double> xyz(3 * n);
  expect(carreau_mesh_vertex_refs(made, n, found.data()));
  expect(carreau_mesh_vertices(made, n, xyz.data()));
  for (std::int64_t v = 0; v < n; ++v) {
    const double x = std::abs(xyz[3 * v]), y = std::abs(xyz[3 * v + 1]);
    const bool outer = x == 2 && y == 2, last = xyz[3 * v] == -1 && xyz[3 * v + 1] == 1;
    EXPECT_EQ(found[v], outer ? 7 : last ? -3 : 0) << x << ' ' << y;
  }
}

TEST_F(PlaneDomain, ArcsBoundPolygonsOfEqualEdges) {
  // A ring of radii 1 and 2, each circle one closed arc; then its upper half, of two arcs and two segments.
  const double circles[16] = {2, 0, 0, 2, -2, 0, 0, -2, 1, 0, 0, 1, -1, 0, 0, -1};
  std::int64_t whole[3] = {0, 3, 6}, half[5] = {0, 3, 5, 8, 10};
  std::int32_t around[6] = {0, 2, 0, 4, 6, 4}, over[10] = {0, 1, 2, 2, 6, 6, 5, 4, 4, 0};
  const std::int32_t arcs[4] = {CARREAU_ARCS, CARREAU_ARCS, CARREAU_ARCS, CARREAU_ARCS};
  const std::int32_t mixed[4] = {CARREAU_ARCS, CARREAU_SEGMENTS, CARREAU_ARCS, CARREAU_SEGMENTS};
  const std::int32_t refs[4] = {1, 3, 2, 3};
  domain.points = circles, domain.smooth = arcs, domain.curve_refs = refs;
  domain.curve_starts = whole, domain.curve_points = around;
  const std::int32_t ring_refs[2] = {1, 2};
  domain.curve_refs = ring_refs;
  const auto edges = [&](carreau_mesh* of, int ref) {
    std::int64_t n = 0;
    expect(carreau_mesh_count(of, nullptr, nullptr, &n, nullptr));
    std::vector<std::int32_t> found(n);
    expect(carreau_mesh_edge_refs(of, n, found.data()));
    return double(std::count(found.begin(), found.end(), ref));
  };
  // If an arc of angle a and radius r has n equal edges, the polygon with its centre has the area r^2 n / 2 sin(a / n).
  const auto polygon = [](double r, double angle, double n) { return r * r * n / 2 * std::sin(angle / n); };
  expect(carreau_add_plane_domain(session, &domain));
  carreau_mesh* made = mesh(0.2);
  EXPECT_GE(edges(made, 1), 60);
  EXPECT_NEAR(area(made), polygon(2, 2 * M_PI, edges(made, 1)) - polygon(1, 2 * M_PI, edges(made, 2)), 1e-6);
  expect(carreau_model_clear(session));
  domain.curve_count = 4, domain.curve_starts = half, domain.curve_points = over, domain.smooth = mixed;
  domain.curve_refs = refs;
  expect(carreau_add_plane_domain(session, &domain));
  made = mesh(0.1);
  EXPECT_EQ(edges(made, 3), 20);
  EXPECT_NEAR(area(made), polygon(2, M_PI, edges(made, 1)) - polygon(1, M_PI, edges(made, 2)), 1e-6);
  expect(carreau_model_clear(session));
  half[1] = 2;  // an arc of two points
  EXPECT_EQ(carreau_add_plane_domain(session, &domain), CARREAU_ERR_MODEL);
  EXPECT_NE(error().find("of arcs passes 2 points"), std::string::npos) << error();
}

TEST_F(PlaneDomain, SizesAtPointsGiveWayToABackgroundMesh) {
  const double sizes[8] = {0.5, 0.5, 0.5, 0.5, 0.1, 0.1, 0.1, 0.1};
  domain.sizes = sizes;
  expect(carreau_add_plane_domain(session, &domain));
  std::int32_t has_sizes = 0;
  expect(carreau_plane_has_sizes(session, &has_sizes));
  EXPECT_EQ(has_sizes, 1);
  expect(carreau_set_integer(session, "hphy_flag", 2));
  carreau_mesh* made = mesh(1);
  std::int64_t n = 0, fine = 0, coarse = 0;
  expect(carreau_mesh_count(made, &n, &fine, nullptr, nullptr));
  const std::vector<double> wanted(n, 0.4);
  expect(carreau_set_vertex_sizes(session, n, wanted.data()));
  made = mesh(1);
  expect(carreau_mesh_count(made, nullptr, &coarse, nullptr, nullptr));
  EXPECT_NEAR(double(coarse), 12 / (std::sqrt(3) / 4 * 0.16), 0.25 * 12 / (std::sqrt(3) / 4 * 0.16));
  EXPECT_GT(fine, 2 * coarse);
}

TEST_F(PlaneDomain, MeshFilesHaveDimensionTwo) {
  expect(carreau_add_plane_domain(session, &domain));
  const std::string path = ::testing::TempDir() + "plane_domain.mesh";
  expect(carreau_mesh_write(mesh(0.5), path.c_str()));
  carreau_mesh* read = nullptr;
  ASSERT_EQ(carreau_mesh_create(&read), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_read(read, path.c_str()), CARREAU_OK);
  std::int32_t dimension = 0;
  EXPECT_EQ(carreau_mesh_dimension(read, &dimension), CARREAU_OK);
  EXPECT_EQ(dimension, 2);
  carreau_mesh_free(read);
  std::remove(path.c_str());
}

TEST_F(PlaneDomain, WrongArgumentsAreSentences) {
  const auto refused = [&](carreau_status status, const char* sentence) {
    EXPECT_EQ(carreau_add_plane_domain(session, &domain), status);
    EXPECT_NE(error().find(sentence), std::string::npos) << error();
  };
  EXPECT_EQ(carreau_add_plane_domain(session, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_add_plane_domain(nullptr, &domain), CARREAU_ERR_ARGUMENT);
  domain.rest = 3;
  refused(CARREAU_ERR_ARGUMENT, "domain->rest is 3");
  domain.rest = 0, domain.points = nullptr;
  refused(CARREAU_ERR_ARGUMENT, "domain->points is NULL");
  domain.points = points, domain.point_count = -1;
  refused(CARREAU_ERR_ARGUMENT, "domain->point_count is -1");
  domain.point_count = 8, passed[1] = 90;
  refused(CARREAU_ERR_MODEL, "curve 1 names the point 91, which does not exist");
  passed[1] = 1, starts[1] = -4;
  refused(CARREAU_ERR_ARGUMENT, "domain->curve_starts does not ascend");
  starts[1] = 5, points[9] = NAN;
  refused(CARREAU_ERR_MODEL, "point 5 has a coordinate that is not finite");
  points[9] = -3;
  refused(CARREAU_ERR_MODEL, "cross or touch at");
  points[9] = -1;
  expect(carreau_add_plane_domain(session, &domain));
  refused(CARREAU_ERR_ARGUMENT, "the session has faces already");
  expect(carreau_model_clear(session));
  EXPECT_EQ(carreau_load_plane_domain(session, "/nowhere/x.poly", nullptr, 0), CARREAU_ERR_FILE);
  EXPECT_EQ(carreau_load_plane_domain(session, "x.step", nullptr, 0), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_load_plane_domain(session, "x.poly", nullptr, -1), CARREAU_ERR_ARGUMENT);
}

}  // namespace
