// SPDX-License-Identifier: BSD-3-Clause
// carreau.hpp: files, models, backgrounds, routines of cad_m; atlases.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "hosts.h"
#include "wrapper_host.h"

namespace {

using carreau::Point2;
using carreau::Point3;
using wrapper_tests::error_of;
using wrapper_tests::paraboloid;
using wrapper_tests::session_of;

/// A folder of the test's own, which goes with it.
class WrapperFiles : public testing::Test {
 protected:
  WrapperFiles() : folder_(std::filesystem::path(testing::TempDir()) / ("wrapper_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~WrapperFiles() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }

 private:
  std::filesystem::path folder_;
};

/// Sizes of 0.3 at all vertices of a mesh, as a .sol.
std::string sizes_of(const carreau::Mesh& mesh) {
  std::string text = "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n" + std::to_string(mesh.vertex_count()) + "\n1 1\n";
  for (std::int64_t i = 0; i < mesh.vertex_count(); ++i) text += "0.3\n";
  return text + "End\n";
}

TEST_F(WrapperFiles, ModelsGoThereAndBack) {
  carreau::Session session = session_of(paraboloid());
  session.check_model();
  session.write_pardom(path("x.pardom"));
  carreau::Session other;
  other.set_geometry(paraboloid());
  other.read_pardom(path("x.pardom"));
  other.set("hphydef", 0.5);
  session.generate();
  other.generate();
  EXPECT_EQ(other.mesh().vertices(), session.mesh().vertices());
  const carreau::Error wrong = error_of([&] { other.read_pardom(file("y.pardom", "one\n")); });
  EXPECT_EQ(wrong.status(), carreau::Status::file);
  EXPECT_EQ(wrong.place().line, 1);
  other.clear_model();
  EXPECT_EQ(other.model().faces.size(), 0U);
}

TEST_F(WrapperFiles, RunsTheRoutinesOfAnOldProgram) {
  carreau::Session session;
  session.set_cad_m(paraboloid_cad_m());
  wrapper_tests::add_sides(session);
  session.write_pardom(path("x.pardom"));
  session.clear_model();
  EXPECT_EQ(session.run_env(file("blsurf.env", "pref x\nhphydef 0.5\ncall inimesh\ncall export\ncall exit\n")), carreau::Outcome::complete);
  const carreau::Mesh written(path("x.mesh"));
  EXPECT_EQ(written.triangle_count(), session.mesh().triangle_count());
  session.read_env(file("other.env", "hphydef 0.25\ncall exit\n"));
  EXPECT_EQ(session.get_real("hphydef"), 0.25);
}

TEST_F(WrapperFiles, FacesHaveNamesColoursAndParts) {
  carreau::Session session = session_of(paraboloid());
  session.name_face(1, "bowl");
  session.color_face(1, 0x8000ff);
  session.set_face_sides(1, 1, 0);
  session.name_entities(3, {1}, "glass");
  wrapper_tests::add_sides(session, 2);
  session.part_of_face(2, 1);
  session.leave_out_face(2, "it is the first one once more");
  EXPECT_EQ(session.generate(), carreau::Outcome::partial);
  const std::vector<carreau::Face> faces = session.mesh().faces();
  ASSERT_EQ(faces.size(), 1U);
  EXPECT_EQ(faces[0].name, "bowl");
  EXPECT_EQ(faces[0].rgb, 0x8000ff);
  EXPECT_EQ(faces[0].status, CARREAU_FACE_FAILED);
  EXPECT_EQ(faces[0].why, "it is the first one once more");
  EXPECT_EQ(session.mesh().face_sides(1), (std::array<std::int32_t, 2>{1, 0}));
  EXPECT_EQ(session.mesh().entity_name(3, 1), "glass");
  EXPECT_EQ(error_of([&] { session.part_of_curve(77, 1); }).status(), carreau::Status::argument);
}

TEST_F(WrapperFiles, SidesOfABowlArePeriodic) {
  carreau::Session session = session_of(paraboloid());
  EXPECT_EQ(error_of([&] { session.add_period({0, 0, 0}); }).status(), carreau::Status::argument);
  const std::array<std::int32_t, 1> face{1};
  EXPECT_EQ(error_of([&] { session.add_periodicity(face, face); }).status(), carreau::Status::argument);
  EXPECT_EQ(session.generate(), carreau::Outcome::complete);
  EXPECT_TRUE(session.mesh().periodic().empty());
}

TEST_F(WrapperFiles, StopsFromACallback) {
  carreau::Session session;
  carreau::Geometry geometry = paraboloid();
  geometry.surface = [&](int, double u, double v, int) { return session.stop(), wrapper_tests::paraboloid_at(u, v); };
  session.set_geometry(geometry);
  wrapper_tests::add_sides(session);
  EXPECT_EQ(error_of([&] { session.generate(); }).status(), carreau::Status::cancelled);
}

TEST_F(WrapperFiles, TakesBackgroundsFromFilesAndArrays) {
  carreau::Session session = session_of(paraboloid());
  session.generate();
  carreau::Mesh first;
  const std::vector<Point3> vertices = session.mesh().vertices();
  const std::vector<carreau::Triangle> triangles = session.mesh().triangles();
  first.from_arrays({.vertices = vertices, .triangles = triangles});
  first.write(path("first.mesh"));
  const std::string sizes = file("first.sol", sizes_of(first));
  first.read(path("first.mesh"));
  EXPECT_NEAR(first.read_metrics(sizes)[0][0], 1 / 0.09, 1e-12);
  const auto mesh_by = [&](auto&& set) {
    session.clear_background();
    set();
    session.generate();
    return session.mesh().triangle_count();
  };
  const std::int64_t by_file = mesh_by([&] { session.set_background_mesh(path("first.mesh"), sizes); });
  const std::vector<double> same(vertices.size(), 0.3);
  const std::span<const double> flat(vertices.front().data(), 3 * vertices.size());
  EXPECT_EQ(mesh_by([&] { session.set_background({.vertices = flat, .triangles = triangles, .sizes = same}); }), by_file);
  EXPECT_GT(session.background_report().asked, 0);
  EXPECT_EQ(error_of([&] { session.set_background({.vertices = flat, .triangles = triangles, .sizes = std::span(same).first(2)}); }).status(),
            carreau::Status::argument);
  session.clear_background();
  const std::int64_t plain = mesh_by([] {});
  session.add_attractor(std::vector<double>{0, 0, 0}, std::vector<carreau::Triangle>{{0, 0, 0}}, 0.01, 0.3, 0.3);
  EXPECT_GT(mesh_by([] {}), plain);
  session.clear_attractors();
  EXPECT_EQ(mesh_by([] {}), plain);
  session.add_layers(std::vector<std::int32_t>{1}, 0.01, 1.2, 3);
  EXPECT_GT(mesh_by([] {}), plain);
  EXPECT_EQ(session.layers_report().rows, 3);
  session.clear_layers();
  const double m = 1 / 0.09;
  session.set_vertex_metrics(std::vector<carreau::Tensor3>(static_cast<std::size_t>(session.mesh().vertex_count()), {m, 0, 0, m, 0, m}));
  session.generate();
  EXPECT_NEAR(static_cast<double>(session.mesh().triangle_count()) / static_cast<double>(by_file), 1, 0.02);
}

TEST_F(WrapperFiles, AdaptsByFiles) {
  carreau::Session session = session_of(paraboloid());
  session.generate();
  session.mesh().write(path("first.mesh"));
  const std::string field = file("first.sol", sizes_of(session.mesh())); // a constant field
  carreau::set_background_fields(session, path("first.mesh"), field);
  session.generate();
  EXPECT_GE(carreau::transfer_files(session, path("first.mesh"), field, path("second.sol")), 0);
  EXPECT_TRUE(std::filesystem::exists(path("second.sol")));
}

TEST_F(WrapperFiles, LoadsTheContentOfFiles) {
  carreau::Session session;
  carreau::load_bezier(session, file("one.bpt", "1\n1 1\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n"));
  carreau::load_molecule(session, {.surface = CARREAU_SAS, .probe = 1}, file("one.xyzr", "5 0 0 1\n"));
  EXPECT_NEAR(carreau::molecule_measure(session).area, 16 * std::numbers::pi, 1e-9);
  carreau::load_grid(session, file("heights.txt", "0 0 0\n0 1 0\n0 0 0\n"));
  EXPECT_EQ(carreau::geometries(session).size(), 3U);
  session.set("hphydef", 0.5);
  session.generate();
  carreau_exr_options small{};
  small.longest = 32, small.face = 1;
  session.write_exr(path("sizes.png"), small);
  EXPECT_TRUE(std::filesystem::exists(path("sizes.png")));

  carreau::Session plane;
  carreau::load_plane_domain(plane, file("square.poly", "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n"));
  plane.set("hphydef", 0.2);
  plane.generate();
  EXPECT_NEAR(plane.mesh().quality().area, 1, 1e-12);
  plane.mesh().write(path("square.stl"));
  carreau::Session flat;
  carreau::load_triangles(flat, path("square.stl"));
  flat.set("hphydef", 0.2);
  flat.generate();
  EXPECT_NEAR(flat.mesh().quality().area, 1, 1e-6);
}

TEST_F(WrapperFiles, ElementsHaveTheirNodes) {
  carreau::Session session = session_of(paraboloid());
  session.set("element", "p2");
  session.generate();
  const carreau::Mesh mesh = session.mesh();
  EXPECT_EQ(mesh.cell_count(CARREAU_CELL_TRIANGLE6), mesh.triangle_count());
  EXPECT_EQ(carreau::Mesh::nodes_of(CARREAU_CELL_TRIANGLE6), 6);
  EXPECT_EQ(carreau::Mesh::nodes_of(CARREAU_CELL_QUAD8), 8);
  EXPECT_EQ(std::ssize(mesh.cells(CARREAU_CELL_TRIANGLE6)), 6 * mesh.triangle_count());
  EXPECT_EQ(mesh.cells(CARREAU_CELL_QUAD4).size(), 0U);
  EXPECT_EQ(carreau::version(), "0.1.0");
  EXPECT_EQ(carreau::version_number(), 100);
  EXPECT_EQ(carreau::Prescription::space({1, 0, 0, 1, 0, 1}).kind, CARREAU_METRIC_SPACE);
}

TEST_F(WrapperFiles, AnnuliAreDrawn) {
  const std::array<Point2, 4> inner{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}, outer{{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}};
  const carreau::Annulus annulus(inner, outer);
  EXPECT_FALSE(annulus.skeleton().empty());
  annulus.write_exr(path("annulus.exr"), 16);
  EXPECT_TRUE(std::filesystem::exists(path("annulus.exr")));
}

TEST_F(WrapperFiles, RemeshingKeepsDamageAndElementValues) {
  carreau::Mesh mesh;
  const std::array<double, 8> square{0, 0, 1, 0, 1, 1, 0, 1};
  const std::array<std::int32_t, 6> triangles{0, 1, 2, 0, 2, 3};
  const std::array<double, 2> damage{0, 0}, pressure{4, 4};
  carreau_remesh_input input{};
  input.vertex_count = 4, input.triangle_count = 2;
  input.vertices = square.data(), input.triangles = triangles.data();
  input.element_components = 1, input.element_values = pressure.data(), input.damage = damage.data();
  input.h_min = 0.05, input.h_max = 0.2, input.step = 0.01;
  carreau::remesh(mesh, input);
  for (const double value : carreau::remesh_element_values(mesh, 1)) EXPECT_NEAR(value, 4, 1e-12);
  for (const double value : carreau::remesh_damage(mesh)) EXPECT_EQ(value, 0);
}

/// A sphere: an octahedron whose triangles are cut into four `times` times, vertices moved to it.
struct Ball {
  std::vector<Point3> xyz{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<carreau::Triangle> triangles{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};

  explicit Ball(int times) {
    for (int i = 0; i < times; ++i) divide();
  }

 private:
  std::int32_t middle(std::int32_t a, std::int32_t b) {
    Point3 p{};
    for (std::size_t i = 0; i < 3; ++i) p[i] = xyz[static_cast<std::size_t>(a)][i] + xyz[static_cast<std::size_t>(b)][i];
    const double length = std::hypot(p[0], p[1], p[2]);
    for (double& x : p) x /= length;
    const auto found = std::ranges::find(xyz, p);
    if (found != xyz.end()) return static_cast<std::int32_t>(found - xyz.begin());
    xyz.push_back(p);
    return static_cast<std::int32_t>(xyz.size() - 1);
  }
  void divide() {
    const std::vector<carreau::Triangle> before = std::exchange(triangles, {});
    for (const auto& [a, b, c] : before) {
      const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const carreau::Triangle& t : {carreau::Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) triangles.push_back(t);
    }
  }
};

TEST_F(WrapperFiles, AtlasesCoverASphere) {
  const Ball ball(3);
  const carreau::Atlas atlas(ball.xyz, ball.triangles);
  const carreau_atlas_counts count = atlas.count();
  EXPECT_GT(count.charts, 3);
  EXPECT_GT(atlas.chart(0).vertices, 0);
  const std::array<Point2, 1> shared{{{0.5, 0.1}}};
  const std::vector<Point2> place = atlas.annulus_points(0, shared);
  const carreau::ChartZones zones = atlas.zones(0, place);
  EXPECT_EQ(zones.zones[0], CARREAU_ZONE_ANNULUS);
  const Point3 point = atlas.points(0, place).xyz[0];
  EXPECT_NEAR(std::hypot(point[0], point[1], point[2]), 1, 0.05);
  double weights = zones.weights[0];
  for (std::int64_t j = 1; j < count.charts; ++j) {
    const carreau::Transition there = atlas.transition(0, j, place);
    if (there.found[0] == 0) continue;
    weights += atlas.zones(j, there.xy).weights[0];
    const Point3 same = atlas.points(j, there.xy).xyz[0];
    EXPECT_NEAR(std::hypot(same[0] - point[0], same[1] - point[1], same[2] - point[2]), 0, 1e-9);
  }
  EXPECT_NEAR(weights, 1, 1e-9);
  carreau::Session session;
  atlas.add_to(session);
  EXPECT_EQ(std::int64_t{carreau::geometries(session)[0].faces}, count.charts);
}

}  // namespace
