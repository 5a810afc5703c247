// SPDX-License-Identifier: BSD-3-Clause
// carreau.hpp: the meshes of the C interface, exceptions across it, lifetimes, and every group of functions once.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "abi_fixture.h"
#include "wrapper_host.h"

namespace {

using carreau::Point2;
using carreau::Point3;
using wrapper_tests::add_sides;
using wrapper_tests::error_of;
using wrapper_tests::paraboloid;
using wrapper_tests::paraboloid_at;
using wrapper_tests::session_of;

carreau::Geometry batched_paraboloid() {
  carreau::Geometry out = paraboloid();
  out.surface = {};
  out.surface_batch = [](int, std::span<const Point2> uv, int order, const carreau::SurfaceRows& rows) {
    EXPECT_EQ(rows.su.size(), order >= 1 ? uv.size() : 0);
    EXPECT_EQ(rows.svv.size(), order >= 2 ? uv.size() : 0);
    for (std::size_t i = 0; i < uv.size(); ++i) {
      const carreau::SurfacePoint p = paraboloid_at(uv[i][0], uv[i][1]);
      rows.s[i] = p.s;
      if (order >= 1) rows.su[i] = p.su, rows.sv[i] = p.sv;
      if (order >= 2) rows.suu[i] = p.suu, rows.suv[i] = p.suv, rows.svv[i] = p.svv;
    }
  };
  return out;
}

abi_tests::MeshData by_the_c_interface(double size) {
  test_host host{};
  carreau_session* session = nullptr;
  EXPECT_EQ(carreau_session_create(&session), CARREAU_OK);
  host.session = session;
  const carreau_cad cad = paraboloid_cad(&host);
  EXPECT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
  EXPECT_EQ(paraboloid_model(session), CARREAU_OK);
  EXPECT_EQ(carreau_set_real(session, "hphydef", size), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_OK);
  carreau_mesh* mesh = nullptr;
  EXPECT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
  abi_tests::MeshData out = abi_tests::data_of(mesh);
  carreau_session_free(session);
  return out;
}

std::string nested_in(const carreau::Error& error) {
  try {
    std::rethrow_if_nested(error);
  } catch (const std::exception& cause) {
    return cause.what();
  }
  return "nothing";
}

std::string thrown_by(carreau::Session& session) {
  try {
    session.generate();
  } catch (const carreau::Error& error) {
    // Slicing loses the nested exception: look at the object that was thrown.
    return nested_in(error);
  } catch (const std::out_of_range& late) { // a message at the very end
    return late.what();
  }
  return "no error";
}

TEST(Wrapper, MakesTheMeshOfTheCInterfaceBitForBit) {
  const abi_tests::MeshData expected = by_the_c_interface(0.2);
  for (const carreau::Geometry& geometry : {paraboloid(), batched_paraboloid()}) {
    carreau::Session session = session_of(geometry, 0.2);
    EXPECT_EQ(session.generate(), carreau::Outcome::complete);
    EXPECT_EQ(abi_tests::data_of(session.mesh().get()), expected);
  }
}

TEST(Wrapper, GivesTheArraysOfTheCInterface) {
  carreau::Session session = session_of(paraboloid());
  session.generate();
  const carreau::Mesh mesh = session.mesh();
  const abi_tests::MeshData data = abi_tests::data_of(mesh.get());
  const std::vector<Point3> vertices = mesh.vertices();
  ASSERT_EQ(vertices.size(), data.vertex_count());
  EXPECT_EQ(std::vector<double>(vertices.front().data(), vertices.front().data() + data.xyz.size()), data.xyz);
  EXPECT_EQ(mesh.vertex_refs(), data.vertex_refs);
  EXPECT_EQ(mesh.vertex_sizes(), data.sizes);
  EXPECT_EQ(mesh.triangles().size(), data.triangle_count());
  EXPECT_EQ(mesh.triangles().back()[2], data.triangles.back());
  EXPECT_EQ(mesh.triangle_refs(), data.triangle_refs);
  EXPECT_EQ(mesh.corner_uv().back()[5], data.uv.back());
  EXPECT_EQ(mesh.edges().size(), data.edge_count());
  EXPECT_EQ(mesh.edge_refs(), data.edge_refs);
  EXPECT_EQ(mesh.cells(CARREAU_CELL_TRIANGLE3), data.triangles);
  EXPECT_EQ(mesh.cell_refs(CARREAU_CELL_TRIANGLE3), data.triangle_refs);
  EXPECT_EQ(mesh.cell_uv(CARREAU_CELL_TRIANGLE3).back()[1], data.uv.back());
  EXPECT_EQ(mesh.cell_faces(CARREAU_CELL_TRIANGLE3), std::vector<std::int32_t>(data.triangles.size(), 1));
  EXPECT_EQ(mesh.edge_mids(), std::vector<std::int32_t>(data.edge_count(), -1));
  EXPECT_EQ(mesh.corner_faces().size(), data.triangle_count());
  EXPECT_EQ(mesh.dimension(), 3);
  EXPECT_EQ(mesh.order(), 1);
  EXPECT_TRUE(mesh.defects().empty());
  EXPECT_FALSE(mesh.defects(/*closed=*/true).empty());
  EXPECT_EQ(mesh.intersections().count, 0);
  EXPECT_EQ(mesh.quality().triangles, mesh.triangle_count());
  EXPECT_EQ(mesh.cell_quality().triangles3, mesh.triangle_count());
  ASSERT_EQ(mesh.faces().size(), 1U);
  EXPECT_EQ(mesh.faces()[0].triangles, mesh.triangle_count());
  EXPECT_EQ(mesh.faces()[0].status, CARREAU_FACE_MESHED);
}

TEST(Wrapper, ArraysAndFilesComeBack) {
  carreau::Session session = session_of(paraboloid());
  session.generate();
  const carreau::Mesh mesh = session.mesh();
  const auto vertices = mesh.vertices();
  const auto triangles = mesh.triangles();
  const carreau::Mesh copy(carreau::MeshArrays{.vertices = vertices, .triangles = triangles});
  EXPECT_EQ(copy.vertices(), vertices);
  EXPECT_EQ(copy.triangles(), triangles);
  EXPECT_THROW((void)copy.regions(), carreau::Error);  // a bowl is open
  EXPECT_THROW((void)copy.triangle_sides(), carreau::Error);
  const std::vector<Point3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::array<std::int32_t, 3>> sides{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const carreau::Mesh tetrahedron(carreau::MeshArrays{.vertices = corners, .triangles = sides});
  EXPECT_EQ(tetrahedron.regions().solids, std::vector<std::int32_t>{1});
  const Point3 inside = tetrahedron.regions().inside.front();
  EXPECT_LT(inside[0] + inside[1] + inside[2], 1);
  EXPECT_GT(std::min({inside[0], inside[1], inside[2]}), 0);
  EXPECT_EQ(tetrahedron.triangle_sides()[3], (std::array<std::int32_t, 2>{1, 0}));
  const std::string path = testing::TempDir() + "wrapper.meshb";
  copy.write(path);
  EXPECT_EQ(carreau::Mesh(path).vertices(), vertices);
  std::remove(path.c_str());
  const std::vector<std::int32_t> too_few(3);
  const carreau::MeshArrays wrong{.vertices = vertices, .triangles = triangles, .triangle_refs = too_few};
  EXPECT_EQ(error_of([&] { const carreau::Mesh refused(wrong); }).status(), carreau::Status::argument);
}

TEST(Wrapper, NestsTheExceptionOfACallback) {
  carreau::Geometry geometry = paraboloid();
  geometry.surface = [](int, double u, double v, int) {
    if (u > 1) throw std::domain_error("no surface beyond u = 1");
    return paraboloid_at(u, v);
  };
  carreau::Session session = session_of(geometry);
  const carreau::Error error = error_of([&] { session.generate(); });
  EXPECT_EQ(error.status(), carreau::Status::callback);
  EXPECT_NE(std::string(error.what()).find("no surface beyond u = 1"), std::string::npos) << error.what();
  EXPECT_EQ(error.place().face, 1);
  EXPECT_GT(error.place().uv[0], 1);
  EXPECT_EQ(thrown_by(session), "no surface beyond u = 1");
  session.set_geometry(paraboloid()); // the session goes on
  EXPECT_EQ(session.generate(), carreau::Outcome::complete);
}

TEST(Wrapper, NestsExceptionsOfProgressMessagesSizesAndMetrics) {
  carreau::Session session = session_of(paraboloid());
  session.on_progress([](int, int, double) -> bool { throw std::runtime_error("progress"); });
  EXPECT_EQ(error_of([&] { session.generate(); }).status(), carreau::Status::cancelled);
  EXPECT_EQ(thrown_by(session), "progress");
  session.on_progress([](int, int, double) { return false; });
  EXPECT_EQ(error_of([&] { session.generate(); }).status(), carreau::Status::cancelled);
  EXPECT_EQ(thrown_by(session), "nothing");
  session.on_progress({});
  session.set("verb", 10);
  session.on_message([](int, std::string_view) { throw std::out_of_range("message"); });
  EXPECT_EQ(thrown_by(session), "message");
  session.on_message({});
  session.set_metrics({.surface = [](int, double, double) -> carreau::Prescription { throw std::runtime_error("metric"); }});
  EXPECT_EQ(thrown_by(session), "metric");
  session.set_metrics({});
  carreau::Geometry sized = paraboloid();
  sized.surface_size = [](int, double, double) -> std::optional<double> { throw std::runtime_error("size"); };
  session.set("hphy_flag", 2);
  session.set_geometry(sized);
  EXPECT_EQ(thrown_by(session), "size");
  session.set_geometry(paraboloid());
  session.set("hphy_flag", 1);
  EXPECT_EQ(session.generate(), carreau::Outcome::complete);
}

TEST(Wrapper, ReportsPlaceAndStatusOfErrors) {
  carreau::Session session;
  const carreau::Error unknown = error_of([&] { session.set("hphydeff", 1.0); });
  EXPECT_EQ(unknown.status(), carreau::Status::argument);
  EXPECT_EQ(unknown.status_name(), "CARREAU_ERR_ARGUMENT");
  EXPECT_NE(std::string(unknown.what()).find("hphydef"), std::string::npos);
  EXPECT_EQ(error_of([&] { session.generate(); }).status(), carreau::Status::sequence);
  EXPECT_EQ(error_of([&] { session.set("threads", std::int64_t{1} << 40); }).status(), carreau::Status::argument);
  EXPECT_EQ(error_of([&] { const carreau::Mesh none("none.mesh"); }).status(), carreau::Status::file);
  session.set_error(carreau::Status::limit, "too much");
  EXPECT_EQ(session.last_error(), "too much");
}

TEST(Wrapper, AnswersOfNoneLeaveTheDefault) {
  carreau::Geometry silent = paraboloid();
  silent.surface_size = [](int, double, double) -> std::optional<double> { return std::nullopt; };
  silent.curve_size = [](int, int, double) -> std::optional<double> { return 0.5; };
  silent.point_size = [](int) -> std::optional<double> { return 0.5; };
  carreau::Session session = session_of(silent, 0.2); // sizes of the curves around count, not this one
  session.set("hphy_flag", 2);
  session.generate();
  for (const double size : session.mesh().vertex_sizes()) EXPECT_NEAR(size, 0.5, 5e-3);
}

TEST(Wrapper, MetricsHoldByDirection) {
  carreau::Geometry flat = paraboloid();
  flat.surface_order = 0;
  flat.surface = [](int, double u, double v, int) -> carreau::SurfacePoint { return {.s = {u, v, 0}}; };
  carreau::Session session = session_of(flat);
  session.set_metrics({.surface = [](int, double, double) { return carreau::Prescription::tangent(0.5, 0.1, {1, 0, 0}); }});
  session.generate();
  const std::vector<Point3> one_by_one = session.mesh().vertices();
  session.set_metrics({.surface_batch = [](int, std::span<const Point2> uv, std::span<const Point3> xyz, std::span<carreau::Prescription> out) {
    EXPECT_EQ(xyz[0][0], uv[0][0]);
    std::ranges::fill(out, carreau::Prescription::tangent(0.5, 0.1, {1, 0, 0}));
  }});
  session.generate();
  EXPECT_EQ(session.mesh().vertices(), one_by_one);
  const double area = 25, per_triangle = 0.5 * 0.1 * std::sqrt(3.0) / 4;
  EXPECT_NEAR(static_cast<double>(session.mesh().triangle_count()) * per_triangle / area, 1, 0.15);
}

/// Counts copies of itself that are alive.
struct Counted {
  std::shared_ptr<int> alive;
  carreau::SurfacePoint operator()(int, double u, double v, int) const { return paraboloid_at(u, v); }
};

TEST(Wrapper, FreesCallbacksWhenNothingUsesThem) {
  const auto alive = std::make_shared<int>(0);
  {
    carreau::Geometry geometry = paraboloid();
    geometry.surface = Counted{alive};
    carreau::Session session = session_of(std::move(geometry));
    EXPECT_EQ(alive.use_count(), 2);
    session.generate();
    session.set_geometry(paraboloid());
    session.generate();
    EXPECT_EQ(alive.use_count(), 1);
    carreau::Geometry refused{.surface = Counted{alive}}; // no curves
    EXPECT_EQ(error_of([&] { session.set_geometry(std::move(refused)); }).status(), carreau::Status::argument);
  }
  EXPECT_EQ(alive.use_count(), 1);
}

TEST(Wrapper, MovesAndOutlives) {
  std::optional<carreau::Session> first(session_of(paraboloid()));
  double last = 0;
  first->on_progress([&](int, int, double fraction) { return last = fraction, true; });
  carreau::Session second(std::move(*first));
  first.reset();
  second.generate();
  EXPECT_EQ(last, 1);
  std::optional<carreau::Mesh> mesh(second.mesh());
  const std::int64_t triangles = mesh->triangle_count();
  second = carreau::Session();
  EXPECT_EQ(mesh->triangle_count(), triangles); // the session lives on in its mesh
  carreau::Mesh other = std::move(*mesh);
  mesh.reset();
  EXPECT_EQ(other.triangle_count(), triangles);
}

TEST(Wrapper, ReadsModelsAndParametersBack) {
  carreau::Session session = session_of(paraboloid());
  session.add_point(1, 7, {0.5, 0.25});
  const carreau::Model model = session.model();
  ASSERT_EQ(model.curves.size(), 4U);
  EXPECT_EQ(model.curves[2].ends, (std::array<int, 2>{3, 4}));
  ASSERT_EQ(model.points.size(), 1U);
  EXPECT_EQ(model.points[0].uv, (Point2{0.5, 0.25}));
  EXPECT_EQ(model.faces[0].ref, 1);
  session.set("threads", 2);
  EXPECT_EQ(session.get_integer("threads"), 2);
  session.set_word("hphydef", "1.5d-1");
  EXPECT_EQ(session.get_real("hphydef"), 0.15);
  session.set("patches", "independent");
  EXPECT_EQ(session.get_text("patches"), "independent");
  EXPECT_EQ(session.get_integer("crossing_rounds"), 0);
  session.set("effort", 2);
  EXPECT_EQ(session.get_integer("crossing_rounds"), 20);
  session.set("crossing_rounds", 3);
  EXPECT_EQ(session.get_integer("crossing_rounds"), 3);
  session.reset("hphydef");
  session.reset();
  EXPECT_EQ(carreau::parameters().size(), static_cast<std::size_t>(carreau_parameter_count()));
}

TEST(Wrapper, DividesCurves) {
  carreau::Session session = session_of(paraboloid());
  session.divide_curve(1, 1, 7);
  session.divide_curve(1, 2, 5, CARREAU_GEOMETRIC, 1.2);
  session.divide_curve_at(1, 3, std::array{0.25, 0.5});
  session.generate();
  const std::vector<std::int32_t> refs = session.mesh().edge_refs();
  EXPECT_EQ(std::ranges::count(refs, 1), 7);
  EXPECT_EQ(std::ranges::count(refs, 2), 5);
  EXPECT_EQ(std::ranges::count(refs, 3), 3);
}

TEST(Wrapper, MeasuresTheDeliveredMesh) {
  carreau::Session session = session_of(paraboloid(), 0.2);
  session.generate();
  const carreau::Delivered delivered(session);
  EXPECT_EQ(delivered.figures().triangles, session.mesh().triangle_count());
  EXPECT_FALSE(delivered.text().empty());
  std::int64_t counted = 0;
  for (const auto& [bound, count] : delivered.histogram(CARREAU_MEASURE_Q2)) counted += count;
  EXPECT_EQ(counted, delivered.figures().triangles);
  const std::vector<double> q2 = delivered.values(CARREAU_MEASURE_Q2);
  EXPECT_EQ(*std::ranges::min_element(q2), delivered.measure(CARREAU_MEASURE_Q2).min);
  EXPECT_EQ(delivered.edges().size(), delivered.edge_curves().size());
  EXPECT_EQ(delivered.triangle_edges().size(), q2.size());
  EXPECT_GT(session.report().surf0_calls + session.report().surf1_calls + session.report().surf2_calls, 0);
  EXPECT_EQ(session.interfaces().size(), 4U);
}

TEST(Wrapper, AdaptsAndTransfers) {
  carreau::Geometry flat = paraboloid();
  flat.surface = [](int, double u, double v, int) -> carreau::SurfacePoint { return {{u, v, 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; };
  carreau::Session session = session_of(flat, 0.3);
  const auto field = [](const Point3& p) { return std::tanh(4 * p[0]); };
  carreau::Adaptation adaptation;
  adaptation.estimator.tolerance = 0.02;
  adaptation.iterations = 2;
  adaptation.field = [&](std::span<const Point3> points, std::span<double> values) { std::ranges::transform(points, values.begin(), field); };
  const carreau::Adapted adapted = carreau::adapt(session, adaptation);
  EXPECT_EQ(adapted.outcome, carreau::Outcome::complete);
  EXPECT_LT(adapted.report.error_max, adapted.report.error_max_before);

  std::vector<double> linear;
  for (const Point3& p : session.mesh().vertices()) linear.push_back(2 * p[0] - p[1]);
  const carreau::Estimate estimate = carreau::estimate(session, {}, linear);
  ASSERT_EQ(estimate.sizes.size(), linear.size());
  session.set_vertex_sizes(std::vector<double>(linear.size(), 0.4));
  session.generate();
  const carreau::Transferred moved = carreau::transfer(session, linear);
  const std::vector<Point3> vertices = session.mesh().vertices();
  ASSERT_EQ(moved.values.size(), vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) EXPECT_NEAR(moved.values[i], 2 * vertices[i][0] - vertices[i][1], 1e-9);
  adaptation.field = [](std::span<const Point3>, std::span<double>) { throw std::runtime_error("field"); };
  try {
    carreau::adapt(session, adaptation);
    FAIL();
  } catch (const carreau::Error& error) {
    EXPECT_EQ(nested_in(error), "field");
  }
}

TEST(Wrapper, KnowsTheAlgebraOfMetrics) {
  const std::array<double, 6> two{4, 0, 1, 1, 0, 4}; // sizes 1/2, 1 and 1, 1/2 along x and y
  const auto axes = carreau::metric::sizes(2, two);
  EXPECT_EQ(axes.sizes, (std::vector<double>{0.5, 1, 0.5, 1}));
  const std::span<const double> all(two);
  const auto smallest = carreau::metric::intersect(2, CARREAU_INTERSECT_IN_TURN, 2, all);
  EXPECT_NEAR(smallest[0], 4, 1e-12);
  EXPECT_NEAR(smallest[2], 4, 1e-12);
  const std::array<double, 1> half{0.5};
  const auto between = carreau::metric::interpolate(2, 1, all.subspan(0, 3), all.subspan(3), half);
  EXPECT_NEAR(between[0], 2, 1e-12); // geometric: sizes 1 / sqrt(2)
  const std::array<double, 4> edge{0, 0, 3, 0};
  EXPECT_NEAR(carreau::metric::lengths(2, 0, edge, std::array<double, 6>{4, 0, 1, 4, 0, 1})[0], 6, 1e-3);
  EXPECT_EQ(carreau::metric::of_sizes(2, std::array<double, 2>{0.5, 1}, std::array<double, 4>{1, 0, 0, 1}), (std::vector<double>{4, 0, 1}));
  EXPECT_EQ(carreau::metric::reduce(2, all.subspan(0, 3), all.subspan(3)).p_sizes.size(), 2U);
  const auto split = carreau::metric::curve_split(2, edge, std::array<double, 2>{0, 3}, std::array<double, 6>{4, 0, 4, 4, 0, 4});
  EXPECT_NEAR(split.length, 6, 1e-9);
  ASSERT_EQ(split.abscissae.size(), 7U);
  EXPECT_NEAR(split.abscissae[1], 0.5, 1e-6);
  EXPECT_EQ(error_of([&] { carreau::metric::sizes(2, all.subspan(0, 4)); }).status(), carreau::Status::argument);
}

TEST(Wrapper, AddsGeometriesOfTheLibrary) {
  carreau::Session session;
  carreau::BezierPatch patch{.m = 1, .n = 1, .controls = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}}};
  carreau::add_bezier(session, std::span(&patch, 1));
  EXPECT_EQ(carreau::bezier_degrees(session, 1), (std::array<std::int32_t, 2>{1, 1}));
  const std::array<Point2, 1> middle{{{0.5, 0.25}}};
  EXPECT_EQ(carreau::geometry_points(session, 1, middle)[0], (Point3{0.5, 0.25, 0}));
  EXPECT_EQ(carreau::geometry_curve(session, 1, 1, 0.5)[1], 0);
  const std::array<Point3, 1> center{{{5, 0, 0}}};
  carreau::add_molecule(session, {.surface = CARREAU_VWS}, center, std::array<double, 1>{1});
  EXPECT_NEAR(carreau::molecule_measure(session).area, 4 * std::numbers::pi, 1e-12);
  EXPECT_EQ(carreau::molecule_atoms(session).areas.size(), 1U);
  EXPECT_EQ(carreau::molecule_atom_name(session, 1), std::nullopt);
  std::vector<Point3> nodes;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) nodes.push_back({10.0 + i, 1.0 * j, 0});
  const carreau::GridBlock block{3, 3, nodes};
  carreau_grid_options splines{};
  splines.continuity = 2;
  carreau::add_grid(session, std::span(&block, 1), splines);
  EXPECT_EQ(carreau::embed_ridges(session, 1), 0);  // a plane
  carreau::add_geometry(session, paraboloid(), [&] { add_sides(session); });
  ASSERT_EQ(carreau::geometries(session).size(), 4U);
  EXPECT_EQ(carreau::geometries(session)[3].kind, CARREAU_GEOMETRY_CALLBACKS);
  EXPECT_THROW(carreau::add_geometry(session, paraboloid(), [] { throw std::logic_error("no"); }), std::logic_error);
  EXPECT_EQ(carreau::geometries(session).size(), 4U);
  session.set("hphydef", 0.5);
  EXPECT_EQ(session.generate(), carreau::Outcome::complete);
  EXPECT_EQ(session.mesh().faces().size(), 4U);
}

TEST(Wrapper, EvaluatesAndProjects) {
  carreau::Session session;
  const carreau::BezierPatch patch{.m = 1, .n = 1, .controls = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1}}}; // z = u v
  carreau::add_bezier(session, std::span(&patch, 1));
  const std::array<Point2, 1> middle{{{0.5, 0.25}}};
  const carreau::Evaluated at = carreau::evaluate_face(session, 1, middle, 2);
  EXPECT_EQ(at.xyz[0], (Point3{0.5, 0.25, 0.125}));
  EXPECT_EQ(at.first[1], (Point3{0, 1, 0.5}));
  EXPECT_EQ(at.second[1], (Point3{0, 0, 1}));
  EXPECT_EQ(carreau::evaluate_face(session, 1, middle).first.size(), 0U);
  const std::array<Point3, 2> x{{{0.5 - 0.25, 0.25 - 0.5, 0.125 + 1}, {2, -1, 0}}}; // along the normal, and beyond a corner
  const carreau::Projected found = carreau::project(session, x);
  EXPECT_NEAR(found.parameters[0], 0.5, 1e-12);
  EXPECT_NEAR(found.parameters[1], 0.25, 1e-12);
  EXPECT_NEAR(found.distances[0], std::sqrt(1.3125), 1e-12);
  EXPECT_EQ(found.closest[1], (Point3{1, 0, 0}));
  EXPECT_EQ(error_of([&] { carreau::project(session, x, 1); }).status(), carreau::Status::sequence); // gluing has found no curve yet
  session.set("hphydef", 0.5);
  session.generate();
  const carreau::Projected side = carreau::project(session, x, 1);
  EXPECT_NEAR(side.distances[1], std::sqrt(2), 1e-12);
  const carreau::Mesh mesh = session.mesh();
  const carreau::VertexEntities entities = carreau::vertex_entities(mesh);
  EXPECT_EQ(std::count(entities.dimensions.begin(), entities.dimensions.end(), 0), 4);
  EXPECT_EQ(entities.references[0], mesh.vertex_refs()[0]);
  const carreau::EdgeParameters edges = carreau::edge_parameters(mesh);
  EXPECT_EQ(edges.t.front()[0], 0);
  EXPECT_EQ(edges.faces, std::vector<std::int32_t>(edges.t.size(), 1));
  const std::array<double, 1> t{side.parameters[1]};
  EXPECT_EQ(carreau::evaluate_curve(session, side.references[1], t, 1).xyz[0], (Point3{1, 0, 0}));
  const std::array<Point3, 2> line{{{0.2, 0.25, 0.05}, {0.8, 0.25, 0.2}}};  // a ruling
  const int curve = carreau::embed_polyline(session, line, "line"), point = carreau::embed_point(session, {0.5, 0.6, 0.3});
  EXPECT_EQ(carreau::embed_wires(session), 0);
  session.generate();
  const std::vector<std::int32_t> edges_of = session.mesh().edge_refs(), vertices_of = session.mesh().vertex_refs();
  EXPECT_GE(std::count(edges_of.begin(), edges_of.end(), curve), 2);
  EXPECT_EQ(std::count(vertices_of.begin(), vertices_of.end(), point), 1);
  EXPECT_EQ(error_of([&] { carreau::embed_point(session, {0.5, 0.6, 0.5}); }).status(), carreau::Status::argument);
}

TEST(Wrapper, CarriesRefinesAndRaisesMeshes) {
  const auto patch = [](double rise) { return carreau::BezierPatch{.m = 1, .n = 1, .controls = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, rise}}}; };  // z = rise u v
  carreau::Session before, after;
  const carreau::BezierPatch low = patch(1), high = patch(1.5);
  carreau::add_bezier(before, std::span(&low, 1)), carreau::add_bezier(after, std::span(&high, 1));
  for (carreau::Session* session : {&before, &after}) session->set("hphydef", 0.5);
  before.generate();
  EXPECT_EQ(carreau::carry_mesh(after, before.mesh()), carreau::Outcome::complete);
  EXPECT_EQ(after.mesh().triangles(), before.mesh().triangles());
  const std::vector<Point3> p = before.mesh().vertices(), q = after.mesh().vertices();
  for (std::size_t v = 0; v < p.size(); ++v) EXPECT_NEAR(q[v][2], 1.5 * p[v][2], 1e-9);
  const std::size_t triangles = after.mesh().triangles().size();
  carreau::halve_mesh(after);
  EXPECT_EQ(after.mesh().triangles().size(), 4 * triangles);
  const std::array<std::int32_t, 1> element{0};
  carreau::refine_elements(after, element);
  const carreau::Triangle first = after.mesh().triangles().front();
  const std::array<std::array<std::int32_t, 2>, 1> edge{{{first[0], first[1]}}};
  carreau::refine_edges(after, edge);
  EXPECT_GT(after.mesh().triangles().size(), 4 * triangles + 3);
  carreau::refine_to_sizes(after, std::vector<double>(after.mesh().vertices().size(), 0.05));
  EXPECT_GT(after.mesh().triangles().size(), 400U);
  EXPECT_EQ(carreau::raise_order(before, 3), 0);
  const carreau::RaisedElements raised = carreau::raised_elements(before, 3);
  EXPECT_EQ(raised.triangles.size(), 10 * before.mesh().triangles().size());
  for (const Point3& x : raised.nodes) EXPECT_NEAR(x[2], x[0] * x[1], 1e-12);
  carreau::write_raised(before, "raised.mesh");
  EXPECT_EQ(error_of([&] { carreau::write_raised(before, "raised.stl"); }).status(), carreau::Status::argument);
}

TEST(Wrapper, TakesTrianglesAndPlaneDomains) {
  const std::array<Point3, 4> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const std::array<carreau::Triangle, 4> sides{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  carreau::Session session;
  carreau::add_triangles(session, {.vertices = corners, .triangles = sides});
  EXPECT_EQ(carreau::triangles_measure(session).regions, 4);
  EXPECT_EQ(carreau::triangles_refine(session, 10, 0).triangle_count(), 4);
  session.set("hphydef", 0.2);
  session.generate();
  EXPECT_LT(carreau::triangles_distances(session)[0], 1e-12);
  for (const double bound : carreau::triangles_bounds(session)) EXPECT_LT(bound, 1e-5);
  EXPECT_TRUE(session.mesh().defects(/*closed=*/true).empty());
  EXPECT_NEAR(session.mesh().quality().area, 1.5 + std::sqrt(3.0) / 2, 1e-12);

  const std::array<double, 8> points{0, 0, 2, 0, 2, 1, 0, 1};
  const std::array<std::int64_t, 2> starts{0, 5};
  const std::array<std::int32_t, 5> along{0, 1, 2, 3, 0};
  carreau_plane_domain domain{};
  domain.point_count = 4, domain.curve_count = 1;
  domain.points = points.data(), domain.curve_starts = starts.data(), domain.curve_points = along.data();
  carreau::Session plane;
  carreau::add_plane_domain(plane, domain);
  EXPECT_FALSE(carreau::plane_has_sizes(plane));
  plane.set("hphydef", 0.2);
  plane.generate();
  EXPECT_NEAR(plane.mesh().quality().area, 2, 1e-12);
}

TEST(Wrapper, DescribesLoopsAndAnnuli) {
  const std::array<Point2, 4> inner{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}, outer{{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}};
  const carreau::Loop loop(inner);
  EXPECT_FALSE(loop.pivots().empty());
  const std::array<double, 2> phi{0, 1};
  EXPECT_NEAR(loop.invert(loop.points(phi).xy, 1e-9)[1], 1, 1e-12);
  const carreau::Annulus annulus(inner, outer);
  const std::array<Point2, 1> place{{{0.5, 1}}};
  const carreau::AnnulusPlaces back = annulus.invert(annulus.points(place).xy);
  EXPECT_EQ(back.zones[0], CARREAU_ZONE_ANNULUS);
  EXPECT_NEAR(back.tau_phi[0][0], 0.5, 1e-10);
  EXPECT_NEAR(back.tau_phi[0][1], 1, 1e-10);
  EXPECT_FALSE(annulus.outer_border().empty());
  EXPECT_EQ(error_of([&] { const carreau::Loop crossing(std::array<Point2, 4>{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}); }).status(),
            carreau::Status::domain);
}

TEST(Wrapper, RemeshesAndAddsFields) {
  carreau::Mesh mesh;
  const std::array<double, 8> square{0, 0, 1, 0, 1, 1, 0, 1};
  const std::array<std::int32_t, 6> triangles{0, 1, 2, 0, 2, 3};
  const std::array<double, 4> linear{0, 1, 3, 2}; // x + 2 y
  carreau_remesh_input input{};
  input.vertex_count = 4, input.triangle_count = 2;
  input.vertices = square.data(), input.triangles = triangles.data();
  input.nodal_components = 1, input.nodal_values = linear.data();
  input.h_min = 0.05, input.h_max = 0.2, input.step = 0.01;
  EXPECT_NEAR(carreau::remesh(mesh, input).area, 1, 1e-12);
  const std::vector<double> values = carreau::remesh_nodal_values(mesh, 1);
  const std::vector<Point3> vertices = mesh.vertices();
  ASSERT_EQ(values.size(), vertices.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], vertices[i][0] + 2 * vertices[i][1], 1e-12);
  carreau::add_field(mesh, "x + 2 y", true, 1, values);
  EXPECT_EQ(error_of([&] { carreau::add_field(mesh, "short", true, 2, values); }).status(), carreau::Status::argument);
}

} // namespace
