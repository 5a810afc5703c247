// Gradation over whole models: closed forms, bounds on the field and on the mesh.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>

#include "common/analytic_cad.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;

struct GradedRun {
  std::shared_ptr<AnalyticCad> cad;
  Monitor monitor;
  std::unique_ptr<Session> session;
  QualitySummary quality;

  GradedRun(AnalyticCad geometry, double beta, const std::function<void(Parameters&)>& more = {})
      : cad(std::make_shared<AnalyticCad>(std::move(geometry))) {
    session = std::make_unique<Session>(monitor);
    session->set_cad(cad);
    session->set_model(testing::unglued(*cad));
    Parameters& p = session->parameters();
    p.set("hphy_flag", 2);
    p.set("hphymin", 1e-6);
    p.set("hphymax", 1e6);
    p.set("gradation", beta);
    if (more) more(p);
    session->make_mesh();
    EXPECT_EQ(find_defects(session->mesh()), std::vector<std::string>{});
    quality = summarise_quality(session->exported());
  }
};

AnalyticCad square(double side) {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) {
                    return SurfaceJet{{p.x, p.y, 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}};
                  },
                  testing::rectangle({0, 0}, {side, side})};
  return cad;
}

/// What the gradation of a mesh is, by the sizes prescribed at its vertices.
struct Graded {
  double worst_error = 0;  // of a vertex's size against the closed form
  double steepest = 1;     // max(p / q, q / p)^(1 / length) of an edge, length by the linear law
  double adjacent = 1;     // ratio of the lengths of two edges of a triangle
};

Graded measure(const GradedRun& run, const std::function<double(Vec3)>& exact) {
  const SurfaceMesh& mesh = run.session->mesh();
  const auto& h = run.session->vertex_sizes();
  Graded g;
  for (std::size_t v = 0; v < h.size(); ++v)
    g.worst_error = std::max(g.worst_error, std::abs(h[v] / exact(mesh.vertices[v]) - 1));
  for (const FaceMesh& f : mesh.faces)
    for (const auto& t : f.triangles)
      for (int i = 0; i < 3; ++i) {
        const int a = f.vertex[t[i]], b = f.vertex[t[(i + 1) % 3]], c = f.vertex[t[(i + 2) % 3]];
        const double d = norm(mesh.vertices[a] - mesh.vertices[b]), p = h[a], q = h[b];
        const double l = std::abs(q - p) > 1e-9 * p ? d * std::log(q / p) / (q - p) : d / p;
        g.steepest = std::max(g.steepest, std::pow(std::max(p / q, q / p), 1 / l));
        const double other = norm(mesh.vertices[c] - mesh.vertices[b]);
        g.adjacent = std::max({g.adjacent, d / other, other / d});
      }
  return g;
}

void expect_graded(const GradedRun& run, const std::function<double(Vec3)>& exact, double beta, double error) {
  const Graded g = measure(run, exact);
  EXPECT_LE(g.worst_error, error) << beta;
  EXPECT_LE(g.steepest, 1.02 * beta);
  EXPECT_LE(g.adjacent, 1.6 * beta);
  const CompositeReport& r = run.session->report();
  ::testing::Test::RecordProperty("triangles", static_cast<int>(run.quality.triangles));
  if (std::getenv("CARREAU_TEST_VERBOSE") != nullptr)
    std::printf(
        "%zu triangles; error %.4f gradation %.3f adjacent %.2f; Q2 %.3f %.3f %.3f; %d rounds of %zu; %.3f of "
        "%.3f s; %d corrections; %.2f calls/vertex\n",
        run.quality.triangles, g.worst_error, g.steepest, g.adjacent, run.quality.q2.mean, run.quality.q2.p1,
        run.quality.q2.min, r.gradation_rounds, r.gradation_triangles, r.seconds_gradation, r.seconds_total,
        r.corrections,
        static_cast<double>(r.calls.surface()) / static_cast<double>(run.session->vertex_sizes().size()));
}

TEST(GradedModel, OneSmallPointOnAPlaneMakesACone) {
  for (const double beta : {1.1, 1.3, 2.}) {
    AnalyticCad cad = square(3);
    cad.size_at_point = [](int p) { return p == 1 ? 0.01 : 1.; };
    cad.size_on_surface = [](int, Vec2) { return 1.; };
    const GradedRun run(std::move(cad), beta);
    expect_graded(
        run, [&](Vec3 x) { return std::min(1., 0.01 + std::log(beta) * norm(x)); }, beta, 0.01);
  }
}

TEST(GradedModel, AFieldThatObeysIsLeftAsItIs) {
  for (const double beta : {0., 1.3, 2.}) {
    AnalyticCad cad = square(3);
    const auto size = [](Vec2 p) { return 0.01 + 0.011 * (1 + std::sin(3 * p.x) * std::sin(2 * p.y)); };
    cad.size_on_surface = [size](int, Vec2 p) { return size(p); };
    const GradedRun run(std::move(cad), beta);
    expect_graded(
        run,
        [&](Vec3 x) {
          return size({x.x, x.y});
        },
        beta == 0 ? 2 : beta, 0.001);
    EXPECT_EQ(run.session->report().gradation_rounds, beta == 0 ? 0 : 1);
  }
}

}  // namespace
}  // namespace carreau
