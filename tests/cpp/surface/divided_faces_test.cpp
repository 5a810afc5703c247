// SPDX-License-Identifier: BSD-3-Clause
// Faces so large that the plane mesher divides them: seams, poles, holes, internal curves, metrics, several at once.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/analytic_cad.h"
#include "geometric_run.h"
#include "plane/kernel/thresholds.h"
#include "session/session.h"

namespace carreau {
namespace {

using namespace testing;
using Defects = std::vector<std::string>;
constexpr double pi = std::numbers::pi;

AnalyticCad plane_face(std::vector<AnalyticCurve> curves) {
  return one_face(
      [](Vec2 p) {
        return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}};
      },
      std::move(curves));
}
AnalyticCad whole_torus() {
  return one_face([](Vec2 p) { return torus_jet(p, 1, 0.4); }, rectangle({0, 0}, {2 * pi, 2 * pi}));
}
AnalyticCad plate_with_holes() {
  std::vector<AnalyticCurve> curves = rectangle({0, 0}, {2, 2});
  for (const Vec2& centre : {Vec2{0.5, 0.6}, Vec2{1.3, 0.5}, Vec2{1.1, 1.4}})
    for (const int half : {2, 1}) curves.push_back(arc(centre, 0.2, half * pi, (half - 1) * pi));
  return plane_face(std::move(curves));
}
AnalyticCad plate_with_curves() {
  std::vector<AnalyticCurve> curves = rectangle({0, 0}, {2, 2});
  curves.push_back(arc({1, 1}, 0.7, 0, pi));
  curves.push_back(segment({0, 0}, {0.9, 0.7}));
  return plane_face(std::move(curves));
}
Model model_with_curves(const AnalyticCad& cad) {
  Model model = unglued(cad);
  Face& face = model.faces[0];
  face.curves[4].type = face.curves[5].type = CurveType::internal;
  face.points = {{.ref = 0, .uv = {1, 1}}, {.ref = 0, .uv = {1.61, 0.33}}};
  return model;
}
/// Two walls of a box, which share an edge.
AnalyticCad two_walls() {
  AnalyticCad cad = plane_face(rectangle({0, 0}, {1, 1}));
  cad.faces[2] = {[](Vec2 p) {
                    return SurfaceJet{{0, p.x(), p.y()}, {0, 1, 0}, {0, 0, 1}, {}, {}, {}};
                  },
                  rectangle({0, 0}, {1, 1})};
  return cad;
}

struct Case {
  const char* name;
  AnalyticCad (*make)();
  double size;  ///< 0: by chords in both principal directions
  int euler;    ///< characteristic of the surface
  bool closed;
  Model (*model)(const AnalyticCad&) = unglued;
  std::function<void(Parameters&)> more = {};
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::unique_ptr<Session> session_of(const Case& c, std::shared_ptr<Cad> cad, Model model, Monitor& monitor) {
  auto session = std::make_unique<Session>(monitor);
  session->set_cad(std::move(cad));
  session->set_model(std::move(model));
  Parameters& p = session->parameters();
  if (c.size > 0) {
    p.set("hphydef", c.size), p.set("hphymin", c.size / 100), p.set("hphymax", 10 * c.size);
  } else {
    p.set("hphy_flag", 0), p.set("hgeo_flag", 1), p.set("geo_rule", "chord"), p.set("geo_metric", 1);
    p.set("eps_chord", 1e-5), p.set("hgeomin", 1e-5), p.set("hgeomax", 10.);
  }
  if (c.more) c.more(p);
  return session;
}

SurfaceMesh meshed(const Case& c, int threads) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  const auto cad = std::make_shared<AnalyticCad>(c.make());
  Monitor monitor;
  const auto session = session_of(c, cad, c.model(*cad), monitor);
  session->parameters().set("threads", threads);
  session->make_mesh();
  return session->mesh();
}

long euler_characteristic(const SurfaceMesh& mesh) {
  std::set<std::int32_t> vertices;
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  long triangles = 0;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles) {
      ++triangles;
      for (int i = 0; i < 3; ++i) {
        const std::int32_t a = face.vertex[t[i]], b = face.vertex[t[(i + 1) % 3]];
        vertices.insert(a);
        edges.emplace_back(std::min(a, b), std::max(a, b));
      }
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) + triangles;
}

class DividedFaces : public ::testing::TestWithParam<Case> {};

TEST_P(DividedFaces, AreSoundAndTheSameForAnyNumberOfThreads) {
  const Case& c = GetParam();
  const SurfaceMesh one = meshed(c, 1);
  for (const FaceMesh& face : one.faces) ASSERT_GT(static_cast<double>(face.triangles.size()), plane::triangles_a_piece);
  EXPECT_EQ(find_defects(one, {.closed = c.closed}), Defects{});
  EXPECT_EQ(euler_characteristic(one), c.euler);
  for (const int threads : {2, 3, 7}) {
    const SurfaceMesh several = meshed(c, threads);
    ASSERT_EQ(several.vertices, one.vertices) << threads;
    ASSERT_EQ(several.faces.size(), one.faces.size());
    for (std::size_t f = 0; f < one.faces.size(); ++f) {
      ASSERT_EQ(several.faces[f].triangles, one.faces[f].triangles) << threads;
      ASSERT_EQ(several.faces[f].uv, one.faces[f].uv) << threads;
      ASSERT_EQ(several.faces[f].vertex, one.faces[f].vertex) << threads;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Large, DividedFaces,
    ::testing::Values(
        Case{"SphereWithPoles", sphere, 0.0095, 2, true}, Case{"TorusWithSeams", whole_torus, 0.011, 0, true},
        Case{"PlateWithHoles", plate_with_holes, 0.0052, -2, false},
        Case{"PlateWithCurves", plate_with_curves, 0.0055, 1, false, model_with_curves},
        Case{"TwoWalls", two_walls, 0.0029, 1, false}, Case{"ByChordInBothDirections", whole_torus, 0, 0, true},
        Case{"Algebraic", plate_with_holes, 0.0052, -2, false, unglued, [](Parameters& p) { p.set("frontal", 0); }},
        Case{"ShapeTrials", torus, 0.005, 0, false, unglued, [](Parameters& p) { p.set("shape_trials", 1); }}),
    [](const auto& of) { return std::string(of.param.name); });

/// A host with a hole in it: it fails at one place.
class FailingTorus final : public AnalyticCad {
 public:
  FailingTorus() : AnalyticCad(whole_torus()) {}
  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    for (const Vec2& p : uv)
      if (fails && (p - Vec2{2, 3}).norm() < 0.02) throw CallbackError(Where{.face = face}, "no surface there");
    AnalyticCad::surface(face, want, uv, out);
  }
  bool fails = true;
};

TEST(DividedFaces, FailuresOfTheHostAreReportedAsByOneThread) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  const Case c{"", whole_torus, 0.011, 0, true};
  std::set<std::string> sentences;
  for (const int threads : {1, 2, 7}) {
    const auto cad = std::make_shared<FailingTorus>();
    Monitor monitor;
    const auto session = session_of(c, cad, unglued(*cad), monitor);
    session->parameters().set("threads", threads);
    try {
      session->make_mesh();
      FAIL() << "the host's failure was lost";
    } catch (const CallbackError& error) {
      sentences.insert(error.what());
    }
  }
  EXPECT_EQ(sentences.size(), 1U);
  EXPECT_NE(sentences.begin()->find("face 1"), std::string::npos) << *sentences.begin();
}

}  // namespace
}  // namespace carreau
