// SPDX-License-Identifier: BSD-3-Clause
// The delivered mesh as a session reports it: measured on request, in messages and in files.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "common/analytic_cad.h"
#include "io/delivered_json.h"
#include "io/mesh_files.h"
#include "session/session.h"
#include "support/infinity.h"

namespace carreau {
namespace {

namespace fs = std::filesystem;
using testing::AnalyticCad;
using Json = nlohmann::ordered_json;
using Kind = EvaluationKind;

struct Messages : Monitor {
  std::vector<std::pair<Level, std::string>> all;
  int stop_in_measure = -1;  // callbacks of progress in that phase before a stop
  void message(Level level, std::string_view text) override { all.emplace_back(level, text); }
  void progress(Phase phase, int, double) override {
    if (phase == Phase::measure && stop_in_measure-- == 0) request_stop();
  }
  [[nodiscard]] int count(Level level, const std::string& part) const {
    int n = 0;
    for (const auto& [l, text] : all) n += l == level && text.find(part) != std::string::npos;
    return n;
  }
};

class SessionDelivered : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("carreau_delivered_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    use(testing::torus_patch(), 0.2);
  }
  void TearDown() override { fs::remove_all(folder); }

  void use(AnalyticCad geometry, double size) {
    cad = std::make_shared<AnalyticCad>(std::move(geometry));
    session.set_cad(cad);
    session.set_model(testing::unglued(*cad));
    Parameters& p = session.parameters();
    p.set("hphydef", size);
    p.set("hphymin", size / 10);
    p.set("hphymax", size * 10);
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream in(folder / name, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }

  fs::path folder;
  Messages monitor;
  std::shared_ptr<AnalyticCad> cad;
  Session session{monitor};
};

TEST_F(SessionDelivered, IsMeasuredOnceOnRequest) {
  session.make_mesh();
  const CallCounts run = session.report().calls, before = cad->calls;
  EXPECT_EQ(monitor.count(Level::summary, "deviation A0, "), 0);
  const MeshEvaluation& d = session.delivered();
  EXPECT_EQ(monitor.count(Level::summary, "deviation A0, "), 1);
  EXPECT_EQ(d.calls.surf0, cad->calls.surf0 - before.surf0);
  EXPECT_GT(d.calls.surf0, 0);
  EXPECT_EQ(session.report().calls, run);
  const CallCounts after = cad->calls;
  EXPECT_EQ(&session.delivered(), &d);
  EXPECT_EQ(cad->calls, after);
  EXPECT_EQ(monitor.count(Level::summary, "deviation A0, "), 1);
  EXPECT_EQ(d[Kind::length].values.size(), d.edges.vertices.size());
  EXPECT_EQ(d[Kind::q2].values.size(), session.mesh().triangle_count());
  EXPECT_EQ(d[Kind::length_ratio].values.size(), session.mesh().vertices.size());
  const double edges = static_cast<double>(d.edges.vertices.size());
  EXPECT_LT(static_cast<double>(d.calls.surface()) / static_cast<double>(session.mesh().vertices.size()), 60);
  // Another mesh is measured anew. Uniform on a smooth patch: as prescribed.
  session.parameters().set("hphydef", 0.05);
  session.make_mesh();
  const MeshEvaluation& fine = session.delivered();
  EXPECT_NEAR(static_cast<double>(fine.edges.vertices.size()) / edges, 16, 1);
  EXPECT_NEAR(fine[Kind::length].spread.mean, 1, 0.01);
  EXPECT_GE(fine.share_in_range(), 0.999);
  EXPECT_GE(fine[Kind::metric_quality].spread.mean, 0.99);
}

TEST_F(SessionDelivered, MeasuresTheGeometryAndParametersOfTheRun) {
  session.make_mesh();
  const Json first = Json::parse(delivered_json(session.mesh(), session.report(), session.delivered()));
  session.make_mesh();
  session.parameters().reset_all();
  session.set_cad(nullptr);
  session.clear_model();
  const Json second = Json::parse(delivered_json(session.mesh(), session.report(), session.delivered()));
  EXPECT_EQ(first["measures"], second["measures"]);
}

TEST_F(SessionDelivered, TheParameterMeasuresEveryRun) {
  session.parameters().set("measure", 1);
  session.make_mesh();
  EXPECT_EQ(monitor.count(Level::summary, "metric length of edges: mean "), 1);
  const CallCounts after = cad->calls;
  (void)session.delivered();
  EXPECT_EQ(cad->calls, after);
  // The calls of the measure are no calls of the run: without it they are as many.
  const CallCounts run = session.report().calls;
  session.parameters().set("measure", 0);
  session.make_mesh();
  EXPECT_EQ(session.report().calls, run);
}

TEST_F(SessionDelivered, JsonIsValidAndAlwaysTheSame) {
  session.make_mesh();
  session.write_delivered(path("a.json"));
  const std::string text = read("a.json");
  const Json json = Json::parse(text);  // throws when it is not JSON
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"format", "mesh", "faces", "diag", "measures", "lengths_in_range", "short_edges",
                                            "long_edges", "folded_triangles", "beyond_tolerances", "not_met", "calls", "seconds"}));
  keys.clear();
  for (const auto& [key, value] : json["measures"].items()) {
    keys.push_back(key);
    std::int64_t sum = 0;
    for (const auto& n : value["histogram"]["counts"]) sum += n.get<std::int64_t>();
    EXPECT_EQ(sum, value["count"].get<std::int64_t>()) << key;
    EXPECT_EQ(value["histogram"]["counts"].size(), value["histogram"]["bounds"].size() + 1) << key;
    EXPECT_TRUE(value["limit"].is_null()) << key;  // only sizes were prescribed
  }
  EXPECT_EQ(keys, (std::vector<std::string>{"metric_length", "edge_angle", "gradation", "length_ratio", "Q1", "Q2",
                                            "metric_quality", "A0", "A1", "curve_A0", "curve_A1", "vertex_angle", "A0_bound", "A1_bound", "bound_share",
                                            "input_bound"}));
  const MeshEvaluation& d = session.delivered();
  EXPECT_EQ(json["measures"]["metric_length"]["mean"].get<double>(), d[Kind::length].spread.mean);
  EXPECT_EQ(json["measures"]["A0"]["max"].get<double>(), d[Kind::deviation].spread.max);
  EXPECT_EQ(json["mesh"]["triangles"].get<std::size_t>(), session.mesh().triangle_count());
  EXPECT_EQ(json["mesh"]["edges_on_curves"].get<std::size_t>(), session.mesh().edge_count());
  EXPECT_EQ(json["calls"]["measure"]["surf0"].get<std::int64_t>(), d.calls.surf0);
  EXPECT_EQ(json["calls"]["run"]["surf0"].get<std::int64_t>(), session.report().calls.surf0);
  EXPECT_EQ(read("a.json").substr(0, text.find("\"seconds\"")),
            delivered_json(session.mesh(), session.report(), d).substr(0, text.find("\"seconds\"")));
}

TEST_F(SessionDelivered, JsonListsFacesThatAreNotMeshedAsTheyAre) {
  SurfaceMesh mesh;
  for (const auto& [ref, status, why] : {std::tuple{3, FaceStatus::meshed, ""}, {5, FaceStatus::collapsed, "face 5: gone"},
                                         {8, FaceStatus::failed, "face 8: no \"curve\""}}) {
    FaceMesh& face = mesh.faces.emplace_back();
    face.ref = ref, face.status = status, face.why = why;
  }
  mesh.faces[1].name = "chamfer";
  MeshEvaluation nothing;
  summarise(nothing);
  const Json faces = Json::parse(delivered_json(mesh, {}, nothing))["faces"];
  EXPECT_EQ(faces, (Json{{{"reference", 5}, {"name", "chamfer"}, {"status", "collapsed"}, {"why", "face 5: gone"}},
                         {{"reference", 8}, {"name", ""}, {"status", "failed"}, {"why", "face 8: no \"curve\""}}}));
}

TEST_F(SessionDelivered, JsonHasNullForNonFiniteNumbers) {
  MeshEvaluation nothing;
  nothing[Kind::deviation].values = {std::nan(""), infinity};
  summarise(nothing);
  const Json json = Json::parse(delivered_json({}, {}, nothing));
  EXPECT_TRUE(json["measures"]["A0"]["mean"].is_null());
  EXPECT_TRUE(json["measures"]["A0"]["max"].is_null());
  EXPECT_EQ(json["measures"]["A0"]["count"].get<int>(), 1);
  EXPECT_TRUE(json["measures"]["Q2"]["mean"].is_null());
  EXPECT_EQ(json["lengths_in_range"].get<double>(), 0);
}

TEST_F(SessionDelivered, APrescriptionThatIsNotMetIsCountedAndReported) {
  // In the manual an edge of unit length makes the angle: half of them are above it.
  Parameters& p = session.parameters();
  p.set("hphy_flag", 0);
  p.set("hgeo_flag", 1);
  p.set("angle_mesh", 8.0);
  session.make_mesh();
  const MeshEvaluation& d = session.delivered();
  EXPECT_EQ(d[Kind::edge_angle].limit, 8);
  std::int64_t above = 0;
  for (const double angle : d[Kind::edge_angle].values) above += angle > 8;
  EXPECT_EQ(d[Kind::edge_angle].beyond, above);
  ASSERT_GT(above, 0);
  EXPECT_EQ(monitor.count(Level::warning,
                          std::to_string(above) + " of " + std::to_string(d.edges.vertices.size()) + " edges ("),
            1);
  EXPECT_EQ(monitor.count(Level::warning, "an angle with a tangent plane at their ends of more than the 8 prescribed"), 1);
  const Json json = Json::parse(delivered_json(session.mesh(), session.report(), d));
  EXPECT_EQ(json["measures"]["edge_angle"]["limit"].get<double>(), 8);
  EXPECT_EQ(json["measures"]["edge_angle"]["beyond"].get<std::int64_t>(), above);
  bool said = false;
  for (const auto& sentence : json["not_met"])
    said = said || sentence.get<std::string>().find("an angle with a tangent plane") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST_F(SessionDelivered, FieldsOfTheExportAreItsValues) {
  session.parameters().set("flag", 1);
  session.make_mesh();
  const MeshEvaluation& d = session.delivered();
  const FlatMesh flat = session.exported(&d);
  const auto field = [&](const FlatMesh& mesh, const std::string& name) -> const MeshField& {
    for (const MeshField& f : mesh.fields)
      if (f.name == name) return f;
    throw std::runtime_error("no field " + name);
  };
  ASSERT_EQ(flat.edges.size(), d.edges.vertices.size());
  EXPECT_EQ(field(flat, "metric_length").edge_values, d[Kind::length].values);
  EXPECT_EQ(field(flat, "A0").values, d[Kind::deviation].values);
  EXPECT_EQ(field(flat, "metric_quality").values, d[Kind::metric_quality].values);
  EXPECT_EQ(field(flat, "length_ratio").values, d[Kind::length_ratio].values);
  EXPECT_EQ(field(flat, "Q2").values, d[Kind::q2].values);
  std::size_t on_curves = 0;
  for (std::size_t e = 0; e < flat.edges.size(); ++e) {
    EXPECT_EQ(flat.edges[e], d.edges.vertices[e]);
    on_curves += flat.edge_refs[e] != 0;
  }
  EXPECT_EQ(on_curves, session.mesh().edge_count());
  // In the plane: every corner belongs to the triangle of space, with its values.
  session.parameters().set("option", "onesurf2d");
  const FlatMesh plane = session.exported(&d);
  EXPECT_EQ(plane.dimension, 2);
  EXPECT_EQ(field(plane, "A1").values, d[Kind::angle].values);
  EXPECT_EQ(plane.edges.size(), d.edges.vertices.size());
  // Without measures the export does not change.
  session.parameters().set("option", "allsurf3d");
  EXPECT_EQ(session.exported().edges.size(), session.mesh().edge_count());
  EXPECT_EQ(session.exported().fields.size(), 3U);
}

TEST_F(SessionDelivered, SphereInThePlaneHasNoValuesForFlattenedTriangles) {
  AnalyticCad sphere;
  constexpr double pi = std::numbers::pi;
  sphere.faces[4] = {[](Vec2 p) {
                       const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()),
                                    sv = std::sin(p.y());
                       return SurfaceJet{{cu * cv, su * cv, sv},  {-su * cv, cu * cv, 0}, {-cu * sv, -su * sv, cv},
                                         {-cu * cv, -su * cv, 0}, {su * sv, -cu * sv, 0}, {-cu * cv, -su * cv, -sv}};
                     },
                     testing::rectangle({0, -pi / 2}, {2 * pi, pi / 2})};
  use(std::move(sphere), 0.2);
  session.make_mesh();
  const FaceMesh& face = session.mesh().faces[0];
  ASSERT_FALSE(face.flattened.empty());
  const MeshEvaluation& d = session.delivered();
  EXPECT_EQ(d.folded_triangles, 0);
  EXPECT_EQ(2 * d.edges.vertices.size(), 3 * face.triangles.size());
  EXPECT_GE(d.share_in_range(), 0.99);
  // Lengths are arc lengths, at the poles too, where edges of (u, v) end at another longitude.
  for (std::size_t e = 0; e < d.edges.vertices.size(); ++e) {
    const Vec3 p = session.mesh().vertices[d.edges.vertices[e][0]], q = session.mesh().vertices[d.edges.vertices[e][1]];
    const double arc = 2 * std::asin(norm(q - p) / 2) / 0.2;
    const bool at_pole = std::max(std::abs(p.z()), std::abs(q.z())) > 1 - 1e-12;
    EXPECT_NEAR(d[Kind::length].values[e], arc, at_pole ? 1e-9 : 0.05);
  }
  EXPECT_GE(d[Kind::metric_quality].spread.min, 0.5);
  session.parameters().set("option", "allsurf2d");
  session.parameters().set("flag", 1);
  const FlatMesh plane = session.exported(&d);
  ASSERT_EQ(plane.triangles.size(), face.triangles.size() + face.flattened.size());
  for (const MeshField& f : plane.fields) {
    if (f.on_vertices || f.values.empty()) continue;
    for (std::size_t t = 0; t < f.values.size(); ++t) EXPECT_EQ(std::isnan(f.values[t]), t >= face.triangles.size());
  }
  session.write(path("plane.vtu"));  // the lists fit
}

TEST_F(SessionDelivered, VtuHoldsTheValuesWhenMeasured) {
  session.make_mesh();
  session.write(path("bare.vtu"));
  EXPECT_EQ(read("bare.vtu").find("metric_quality"), std::string::npos);
  session.parameters().set("flag", 1);
  session.parameters().set("measure", 1);
  session.parameters().set("measure_bounds", 2);
  session.make_mesh();
  session.write(path("full.vtu"));
  const std::string full = read("full.vtu");
  for (const char* name :
       {"metric_length", "edge_angle", "gradation", "length_ratio", "Q1", "Q2", "metric_quality", "A0", "A1", "curve_A0", "curve_A1", "vertex_angle", "A0_bound", "A1_bound", "bound_share"})
    EXPECT_NE(full.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
  // Formats without fields stay as they are.
  session.write(path("full.mesh"));
  const FlatMesh mesh = read_mesh(path("full.mesh"));
  EXPECT_EQ(mesh.edges.size(), session.mesh().edge_count());
}

TEST_F(SessionDelivered, ActionOfBlsurfEnvWritesJsonBesideIt) {
  std::ofstream(folder / "blsurf.env")
      << "hphydef 0.2\nhphymin .02\nhphymax 2\ncall inimesh\npref torus\ncall measure\n"
         "pref torus format vtu flag 1\ncall export\ncall exit\n";
  session.run_env(path("blsurf.env"));
  EXPECT_EQ(Json::parse(read("torus.json"))["mesh"]["faces"].get<int>(), 1);
  EXPECT_NE(read("torus.vtu").find("\"A0\""), std::string::npos);

  std::ofstream(folder / "early.env") << "call measure\n";
  Session other(monitor);
  other.set_cad(cad);
  other.set_model(testing::unglued(*cad));
  try {
    other.run_env(path("early.env"));
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("call measure comes before any call inimesh"), std::string::npos);
  }
}

TEST_F(SessionDelivered, ErrorsAreReportedAndLoseNothing) {
  EXPECT_THROW(session.delivered(), InvalidArgument);
  EXPECT_THROW(session.write_delivered(path("a.json")), InvalidArgument);
  session.make_mesh();
  const std::size_t triangles = session.mesh().triangle_count();
  EXPECT_THROW(session.write_delivered(path("no_such_folder/a.json")), FileError);
  std::ofstream(folder / "a.json") << "older";

  // A stop during the measure, then a host that fails: nothing is kept, the next one is whole.
  Session fresh(monitor);
  fresh.set_cad(cad);
  fresh.set_model(testing::unglued(*cad));
  fresh.make_mesh();
  monitor.stop_in_measure = 0;
  EXPECT_THROW(fresh.write_delivered(path("a.json")), Cancelled);
  EXPECT_EQ(read("a.json"), "older");
  monitor.clear_stop();
  monitor.stop_in_measure = -1;
  const auto sound = cad->faces[1].at;
  cad->faces[1].at = [sound](Vec2 p) {
    SurfaceJet jet = sound(p);
    jet.s.x() = std::nan("");
    return jet;
  };
  try {
    fresh.delivered();
    FAIL();
  } catch (const CallbackError& error) {
    EXPECT_NE(std::string(error.what()).find("surf0"), std::string::npos) << error.what();
  }
  cad->faces[1].at = sound;
  EXPECT_EQ(fresh.delivered().edges.of_triangle.size(), fresh.mesh().triangle_count());

  // With measure = 1 a run whose measure fails leaves the mesh before it.
  session.parameters().set("measure", 1);
  session.parameters().set("hphydef", 0.1);
  monitor.stop_in_measure = 0;
  EXPECT_THROW(session.make_mesh(), Cancelled);
  monitor.clear_stop();
  EXPECT_EQ(session.mesh().triangle_count(), triangles);
}

// A box 2 x 2 whose sides are .05 high: edges of .5 leave their triangles a Q2 of .2 at most.
TEST_F(SessionDelivered, StripsAreNamedWithTheirWidth) {
  const auto rectangle = [](Vec3 o, Vec3 x, Vec3 y) {
    const Vec3 u = (1 / norm(x)) * x, v = (1 / norm(y)) * y;
    return testing::AnalyticFace{[=](Vec2 p) { return SurfaceJet{o + p.x() * u + p.y() * v, u, v, {}, {}, {}}; },
                                 testing::rectangle({0, 0}, {norm(x), norm(y)})};
  };
  AnalyticCad cad_of_box;
  cad_of_box.faces[1] = rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
  cad_of_box.faces[2] = rectangle({0, 0, 0}, {2, 0, 0}, {0, 0, 0.05});
  use(cad_of_box, 0.5);
  session.make_mesh();
  EXPECT_EQ(monitor.count(Level::summary, "a strip is so narrow"), 1);
  EXPECT_EQ(monitor.count(Level::summary, "face 2 (0.04878 wide, "), 1);  // 2 x .05 over half of 4.1
  monitor.all.clear();
  use(cad_of_box, 0.05);
  session.make_mesh();
  EXPECT_EQ(monitor.count(Level::summary, "so narrow"), 0);
}

}  // namespace
}  // namespace carreau
