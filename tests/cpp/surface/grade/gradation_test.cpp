// SPDX-License-Identifier: BSD-3-Clause
// Gradation over whole models: closed forms, bounds on the field and on the mesh.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>

#include "common/analytic_cad.h"
#include "metric/field_length.h"
#include "session/session.h"
#include "surface/sample/face_sampling.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
constexpr double pi = std::numbers::pi;

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
    for (const FaceMesh& face : session->mesh().faces) EXPECT_EQ(face.status, FaceStatus::meshed) << face.why;
    quality = summarise_quality(session->exported());
  }
};

AnalyticCad square(double side) {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) {
                    return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}};
                  },
                  testing::rectangle({0, 0}, {side, side})};
  return cad;
}

/// The gradation of a mesh, by the sizes prescribed at its vertices.
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
    const auto size = [](Vec2 p) { return 0.01 + 0.011 * (1 + std::sin(3 * p.x()) * std::sin(2 * p.y())); };
    cad.size_on_surface = [size](int, Vec2 p) { return size(p); };
    const GradedRun run(std::move(cad), beta);
    expect_graded(
        run,
        [&](Vec3 x) {
          return size({x.x(), x.y()});
        },
        beta == 0 ? 2 : beta, 0.001);
    EXPECT_EQ(run.session->report().gradation_rounds, beta == 0 ? 0 : 1);
  }
}

// Distances along the surface from the point with reference 1, whose size is 0.01; 1 elsewhere.
struct Source {
  const char* name;
  AnalyticCad (*make)();
  double (*distance)(Vec3);
};

AnalyticCad sphere() {
  AnalyticCad cad;
  cad.faces[1] = {
      [](Vec2 p) {
        const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y());
        return SurfaceJet{{cv * cu, cv * su, sv}, {-cv * su, cv * cu, 0}, {-sv * cu, -sv * su, cv}, {}, {}, {}};
      },
      testing::rectangle({0, -pi / 2}, {2 * pi, pi / 2})};
  return cad;
}

AnalyticCad cylinder() {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) {
                    return SurfaceJet{
                        {std::cos(p.x()), std::sin(p.x()), p.y()}, {-std::sin(p.x()), std::cos(p.x()), 0}, {0, 0, 1}, {}, {}, {}};
                  },
                  testing::rectangle({0, 0}, {2 * pi, 3})};
  return cad;
}

// Two unit squares at a right angle along x = 1, the second with its own idea of u and v.
AnalyticCad fold() {
  AnalyticCad cad = square(1);
  cad.faces[2] = {[](Vec2 p) {
                    return SurfaceJet{{1, p.x(), 2 * p.y()}, {0, 1, 0}, {0, 0, 2}, {}, {}, {}};
                  },
                  testing::rectangle({0, 0}, {1, 0.5})};
  return cad;
}

AnalyticCad two_squares() {
  AnalyticCad cad = square(1);
  cad.faces[2] = {[](Vec2 p) {
                    return SurfaceJet{{1 + p.y(), p.x(), 0}, {0, 1, 0}, {1, 0, 0}, {}, {}, {}};
                  },
                  testing::rectangle({0, 0}, {1, 1})};
  return cad;
}

class PointSource : public ::testing::TestWithParam<Source> {};

TEST_P(PointSource, SizesGrowWithTheDistanceAlongTheSurface) {
  for (const double beta : {1.1, 1.3, 2.}) {
    AnalyticCad cad = GetParam().make();
    cad.size_at_point = [](int p) { return p == 1 ? 0.01 : 1.; };
    cad.size_on_surface = [](int, Vec2) { return 1.; };
    const GradedRun run(std::move(cad), beta);
    const auto exact = [&](Vec3 x) { return std::min(1., 0.01 + std::log(beta) * GetParam().distance(x)); };
    expect_graded(run, exact, beta, 0.02);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Surfaces, PointSource,
    ::testing::Values(Source{"sphere", sphere, [](Vec3 x) { return std::acos(std::clamp(-x.z(), -1., 1.)); }},
                      Source{"cylinder", cylinder, [](Vec3 x) { return std::hypot(std::atan2(x.y(), x.x()), x.z()); }},
                      Source{"fold", fold, [](Vec3 x) { return std::hypot(x.x() + x.z(), x.y()); }},
                      Source{"two_squares", two_squares, [](Vec3 x) { return std::hypot(x.x(), x.y()); }}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST(GradedModel, SizesOfPatchesThatJumpAreJoined) {
  for (const double beta : {1.1, 1.3, 2.}) {
    AnalyticCad cad = two_squares();
    cad.size_on_surface = [](int face, Vec2) { return face == 1 ? 0.02 : 1.; };
    const GradedRun run(std::move(cad), beta);
    expect_graded(
        run, [&](Vec3 x) { return 0.02 + std::log(beta) * std::max(0., x.x() - 1); }, beta, 0.02);
  }
}

TEST(GradedModel, ASmallCurveIsLeftGently) {
  for (const double beta : {1.1, 1.3, 2.}) {
    AnalyticCad cad = square(1);
    cad.size_on_surface = [](int, Vec2) { return 1.; };
    cad.size_on_curve = [](int, int ic, double) { return ic == 1 ? 0.01 : 1.; };
    const GradedRun run(std::move(cad), beta);
    expect_graded(
        run, [&](Vec3 x) { return 0.01 + std::log(beta) * x.y(); }, beta, 0.02);
  }
}

// The largest gradation of the mesh's edges in the control spaces that they were made from.
double steepest_in_control_spaces(AnalyticCad& cad, CompositeOptions options, double* share_over) {
  Monitor monitor;
  ModelSupports supports = build_supports(testing::unglued(cad), cad, 1, 1, monitor);
  const Model model = glue(testing::unglued(cad), traces_of(supports), supports.diag / 500);
  const Topology topology = build_topology(model, traces_of(supports), supports.diag / 100);
  if (options.size.hgeomax == 0) options.size.hgeomax = supports.diag / 5, options.size.hgeomin = supports.diag / 500;
  const CompositeResult result = mesh_composite(model, topology, supports, cad, options, monitor);
  EXPECT_EQ(find_defects(result.mesh), std::vector<std::string>{});
  double steepest = 1;
  std::size_t over = 0, count = 0;
  for (std::size_t f = 0; f < result.mesh.faces.size(); ++f) {
    const FaceMesh& face = result.mesh.faces[f];
    const ControlSpace& space = *result.spaces[f];
    std::vector<double> h;
    for (const Vec2& uv : face.uv) h.push_back(isotropic_size(surface_at(cad, face.ref, want_first, uv), space.at(uv)));
    for (const auto& t : face.triangles)
      for (int i = 0; i < 3; ++i) {
        const int a = t[i], b = t[(i + 1) % 3];
        if (!(h[a] > 0) || !(h[b] > 0)) continue;
        const double l = field_length([&](Vec2 p) { return space.at(p); }, face.uv[a], face.uv[b], 0.1);
        const double g = std::pow(std::max(h[a] / h[b], h[b] / h[a]), 1 / l);
        steepest = std::max(steepest, g);
        over += g > 1.02 * options.gradation ? 1 : 0;
        ++count;
      }
  }
  *share_over = static_cast<double>(over) / static_cast<double>(count);
  if (std::getenv("CARREAU_TEST_VERBOSE") != nullptr)
    std::printf("%g: %zu triangles, gradation %.4f, %zu of %zu over 1.02\n", options.gradation,
                result.mesh.triangle_count(), steepest, over, count);
  return steepest;
}

CompositeOptions host_sizes(double beta) {
  CompositeOptions options;
  options.gradation = beta;
  options.size = {.physical = PhysicalSizes::asked, .hphydef = 1, .hphymin = 1e-3, .hphymax = 10};
  return options;
}

CompositeOptions curvature(double beta) {
  CompositeOptions options;
  options.gradation = beta;
  options.size = {.physical = PhysicalSizes::ignored, .geometric = GeometricSizes::curvature, .hphydef = 1, .hphymin = 1e-3, .hphymax = 10};
  return options;
}

// A band with sharp sides through a face: no sample knows where they are.
AnalyticCad band() {
  AnalyticCad cad = square(1);
  cad.size_on_surface = [](int, Vec2 p) { return std::abs(p.x() - 0.3 - 0.3 * p.y() * p.y()) < 0.05 ? 0.01 : 1; };
  return cad;
}

AnalyticCad with_point(AnalyticCad cad) {
  cad.size_at_point = [](int p) { return p == 1 ? 0.01 : 1.; };
  cad.size_on_surface = [](int face, Vec2) { return face == 1 ? 1. : 0.1; };
  return cad;
}

TEST(GradedModel, ControlSpacesObeyTheGradation) {
  for (const double beta : {1.1, 1.3, 2.})
    for (const auto make : {two_squares, cylinder, fold, sphere}) {
      AnalyticCad cad = with_point(make());
      double over = 0;
      EXPECT_LE(steepest_in_control_spaces(cad, host_sizes(beta), &over), 1.02 * beta);
    }
}

TEST(GradedModel, ControlSpacesObeyWherePrescribedSizesAreRough) {
  for (const double beta : {1.1, 1.3, 2.}) {
    double over = 0;
    AnalyticCad cad = band();
    EXPECT_LE(steepest_in_control_spaces(cad, host_sizes(beta), &over), 1.02 * beta);
    cad = testing::teapot();
    EXPECT_LE(steepest_in_control_spaces(cad, curvature(beta), &over), 1.02 * beta);
  }
}

// Metrics of space by closed forms.
class SpaceMetric : public PrescriptionSource {
 public:
  explicit SpaceMetric(std::function<Metric3(Vec3)> at) : at_(std::move(at)) {}
  Prescription on_surface(int, Vec2, Vec3 xyz) override { return Prescription::of_space(at_(xyz)); }
  Prescription on_curve(int, int, double, Vec2, Vec3 xyz) override { return Prescription::of_space(at_(xyz)); }
  Prescription at_point(int, Vec3 xyz) override { return Prescription::of_space(at_(xyz)); }

 private:
  std::function<Metric3(Vec3)> at_;
};

struct Anisotropic {
  double steepest = 1, over = 0, in_range = 0, shape = 0, worst_shape = 1;
  double by_parameters = 1;  // as steepest, along the image of the edge's segment of (u, v) instead of its chord
};

// The offset of parameters whose image in the tangent plane is the image of a chord.
Vec2 offset_along(const SurfaceJet& j, Vec3 chord) {
  const Metric2 g = induced_metric(j.su, j.sv, 1);
  const double p = dot(chord, j.su), q = dot(chord, j.sv);
  return (1 / determinant(g)) * Vec2{g.c * p - g.b * q, g.a * q - g.b * p};
}

// Gradation of sizes along the edges in the control spaces, lengths and shapes there. Along an edge is along its chord:
// the image of a segment of (u, v) turns as the parametrisation does, up to 60 degrees on a coarse edge of the teapot,
// and a metric that is the same everywhere would have a gradation.
Anisotropic measure_directions(AnalyticCad& cad, CompositeOptions options, SpaceMetric* source, CompositeResult* kept) {
  Monitor monitor;
  if (source != nullptr) options.size.sources = {source};
  ModelSupports supports = build_supports(testing::unglued(cad), cad, 1, 1, monitor);
  const Model model = glue(testing::unglued(cad), traces_of(supports), supports.diag / 500);
  const Topology topology = build_topology(model, traces_of(supports), supports.diag / 100);
  if (options.size.hgeomax == 0) options.size.hgeomax = supports.diag / 5, options.size.hgeomin = supports.diag / 500;
  *kept = mesh_composite(model, topology, supports, cad, options, monitor);
  EXPECT_EQ(find_defects(kept->mesh), std::vector<std::string>{});
  Anisotropic a;
  double count = 0, triangles = 0;
  for (std::size_t f = 0; f < kept->mesh.faces.size(); ++f) {
    const FaceMesh& face = kept->mesh.faces[f];
    const ControlSpace& space = *kept->spaces[f];
    std::vector<SurfaceJet> jets(face.uv.size());
    cad.surface(face.ref, want_position | want_first, face.uv, jets);
    for (const auto& t : face.triangles) {
      double squares = 0;
      for (int i = 0; i < 3; ++i) {
        const int p = t[i], q = t[(i + 1) % 3];
        const Vec2 d = face.uv[q] - face.uv[p];
        const double l = field_length([&](Vec2 x) { return space.at(x); }, face.uv[p], face.uv[q], 0.1);
        const auto along = [&](int v, Vec2 e) {
          return norm(e.x() * jets[v].su + e.y() * jets[v].sv) / length(space.at(face.uv[v]), e);
        };
        const auto gradation = [&](double h1, double h2) { return std::pow(std::max(h1 / h2, h2 / h1), 1 / l); };
        const Vec3 chord = jets[q].s - jets[p].s;
        const double g = gradation(along(p, offset_along(jets[p], chord)), along(q, offset_along(jets[q], chord)));
        a.steepest = std::max(a.steepest, g);
        a.by_parameters = std::max(a.by_parameters, gradation(along(p, d), along(q, d)));
        a.over += g > 1.02 * options.gradation ? 1 : 0;
        a.in_range += l >= std::numbers::sqrt2 / 2 && l <= std::numbers::sqrt2 ? 1 : 0;
        squares += l * l;
        ++count;
      }
      const Vec2 o = face.uv[t[0]], m = (1. / 3) * (o + face.uv[t[1]] + face.uv[t[2]]);
      const double q = 2 * std::numbers::sqrt3 * cross(face.uv[t[1]] - o, face.uv[t[2]] - o) *
                       std::sqrt(determinant(space.at(m))) / squares;
      a.shape += q;
      a.worst_shape = std::min(a.worst_shape, q);
      ++triangles;
    }
  }
  a.over /= count, a.in_range /= count, a.shape /= triangles;
  if (std::getenv("CARREAU_TEST_VERBOSE") != nullptr)
    std::printf(
        "%g: %zu triangles, gradation %.4f, share over %.5f, in range %.4f, shape %.3f %.3f; %d rounds of %zu; "
        "%.3f of %.3f s; %lld calls\n",
        options.gradation, kept->mesh.triangle_count(), a.steepest, a.over, a.in_range, a.shape, a.worst_shape,
        kept->report.gradation_rounds, kept->report.gradation_triangles, kept->report.seconds_gradation,
        kept->report.seconds_total, static_cast<long long>(kept->report.calls.surface()));
  return a;
}

TEST(GradedMetrics, ALayerGrowsInBothDirections) {
  // Sizes 0.01 across and 0.1 along the side y = 0, 1 x 1 elsewhere: both grow by the layer's metric.
  for (const double beta : {1.1, 1.3, 2.}) {
    AnalyticCad cad = square(2);
    SpaceMetric source([](Vec3 x) {
      return x.y() < 1e-9 ? metric_of_sizes({0, 1, 0}, 0.01, 0.1) : isotropic_metric3(1);
    });
    CompositeResult result;
    const Anisotropic a = measure_directions(cad, host_sizes(beta), &source, &result);
    EXPECT_EQ(a.over, 0);
    EXPECT_GE(a.in_range, 0.94);
    double error = 0;
    for (std::size_t v = 0; v < result.vertex_size.size(); ++v) {
      const Vec3 x = result.mesh.vertices[v];
      if (x.x() == 0 || x.x() == 2 || x.y() == 0 || x.y() == 2) continue;  // sizes along the border
      const double across = std::min(1., 0.01 + std::log(beta) * x.y()), along = std::min(1., 10 * across);
      error = std::max(error, std::abs(result.vertex_size[v] / std::sqrt(across * along) - 1));
    }
    EXPECT_LE(error, 0.1);  // where a size stops growing
  }
}

TEST(GradedMetrics, CurvatureOfTheTeapot) {
  for (const double beta : {1.1, 1.3, 2.}) {
    CompositeOptions options = curvature(beta);
    options.size.geo_anisotropic = true;
    AnalyticCad cad = testing::teapot();
    CompositeResult result;
    const Anisotropic a = measure_directions(cad, options, nullptr, &result);
    EXPECT_EQ(a.over, 0);
    EXPECT_GE(a.in_range, 0.98);
    EXPECT_GE(a.shape, 0.94);
  }
}

// z = 0.4 sin(2 u) cos(3 v): inflections everywhere, between which directions turn. One edge in a hundred would exceed
// the gradation in the field alone.
TEST(GradedMetrics, CurvatureOfWaves) {
  for (const bool guaranteed : {false, true})
    for (const double beta : {1.1, 1.3, 2.}) {
      AnalyticCad cad;
      cad.faces[1] = {[](Vec2 p) {
                        const double a = 0.4, s = std::sin(2 * p.x()), c = std::cos(2 * p.x()), t = std::sin(3 * p.y()),
                                     d = std::cos(3 * p.y());
                        return SurfaceJet{{p.x(), p.y(), a * s * d},  {1, 0, 2 * a * c * d},  {0, 1, -3 * a * s * t},
                                          {0, 0, -4 * a * s * d}, {0, 0, -6 * a * c * t}, {0, 0, -9 * a * s * d}};
                      },
                      testing::rectangle({0, 0}, {2 * pi, 2 * pi})};
      CompositeOptions options = curvature(beta);
      options.size.geo_anisotropic = true;
      options.size.geo_guarantee = guaranteed;
      CompositeResult result;
      const Anisotropic a = measure_directions(cad, options, nullptr, &result);
      EXPECT_EQ(a.over, 0) << beta;
      EXPECT_GE(a.in_range, 0.98) << beta;
      EXPECT_GE(a.shape, 0.93) << beta;
      EXPECT_GE(a.worst_shape, 0.2) << beta;
    }
}

// One metric everywhere has no gradation, though segments of the parameter plane bend by 20 degrees and more.
TEST(GradedMetrics, BentParametersAreNoGradation) {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) {
                    const double c = std::cos(p.x()), s = std::sin(p.x());
                    return SurfaceJet{{p.y() * c, p.y() * s, 0}, {-p.y() * s, p.y() * c, 0}, {c, s, 0}, {}, {}, {}};
                  },
                  testing::rectangle({0, 0.3}, {pi / 2, 1.5})};
  SpaceMetric source([](Vec3) { return metric_of_sizes({1, 0, 0}, 0.03, 0.15); });
  CompositeResult result;
  const Anisotropic a = measure_directions(cad, host_sizes(1.3), &source, &result);
  EXPECT_LE(a.steepest, 1.04);  // the control space is off by 1 % at either end of 0.7 edges or more
  EXPECT_GE(a.by_parameters, 1.3);
}

TEST(GradedMetrics, FieldsThatObeyAreLeftAsTheyAre) {
  for (const double beta : {0., 1.3}) {
    AnalyticCad cad = square(2);
    SpaceMetric source([](Vec3) { return metric_of_sizes({1, 2, 0}, 0.01, 0.1); });
    CompositeResult result;
    const Anisotropic a = measure_directions(cad, host_sizes(beta), &source, &result);
    EXPECT_LE(a.steepest, 1.001);
  }
}

// The size along a curve does not apply to a face that only has one of its ends, least of all if the curve is normal to
// the face.
TEST(GradedMetrics, CurvesBoundFacesThatHoldThem) {
  AnalyticCad cad = fold();
  constexpr double along = 0.2, across = 0.02;  // of the crease
  SpaceMetric source([](Vec3) { return metric_of_sizes({0, 1, 0}, along, across); });
  CompositeResult result;
  const Anisotropic a = measure_directions(cad, host_sizes(1.3), &source, &result);
  EXPECT_LE(a.steepest, 1.001);
  const double of_unit_square = 4 / (std::numbers::sqrt3 * along * across);
  for (const FaceMesh& face : result.mesh.faces)
    EXPECT_NEAR(static_cast<double>(face.triangles.size()) / of_unit_square, 1, 0.1);
}

class Watcher : public Monitor {
 public:
  void progress(Phase phase, int, double fraction) override {
    EXPECT_GE(fraction, last_);
    EXPECT_LE(fraction, 1);
    last_ = fraction;
    seen_gradation = seen_gradation || phase == Phase::gradation;
    if (stop_there && phase == Phase::gradation) request_stop();
  }
  bool seen_gradation = false, stop_there = false;

 private:
  double last_ = 0;
};

TEST(GradedModel, ReportsItsProgressAndStops) {
  for (const bool stop : {false, true}) {
    Watcher watcher;
    watcher.stop_there = stop;
    Session session(watcher);
    auto cad = std::make_shared<AnalyticCad>(with_point(two_squares()));
    session.set_cad(cad);
    session.set_model(testing::unglued(*cad));
    session.parameters().set("hphy_flag", 2);
    session.parameters().set("gradation", 1.3);
    if (stop)
      EXPECT_THROW(session.make_mesh(), Cancelled);
    else
      session.make_mesh();
    EXPECT_TRUE(watcher.seen_gradation);
    EXPECT_EQ(session.has_mesh(), !stop);
  }
}

TEST(GradedModel, IsTheSameEachTime) {
  for (const bool directions : {false, true}) {
    CompositeOptions options = curvature(1.3);
    options.size.geo_anisotropic = directions;
    CompositeResult first, second;
    AnalyticCad cad = testing::torus_patch();
    measure_directions(cad, options, nullptr, &first);
    measure_directions(cad, options, nullptr, &second);
    EXPECT_EQ(first.mesh.vertices, second.mesh.vertices);
    EXPECT_EQ(first.vertex_size, second.vertex_size);
  }
}

// The unit of length is the host's: multiples by a power of two have an identical mesh.
TEST(GradedModel, IsTheSameInAnyUnitOfLength) {
  for (const int anisotropic : {0, 1}) {
    std::vector<Vec3> one;
    for (const double unit : {1., 0x1p-20, 0x1p20}) {
      AnalyticCad cad;
      cad.faces[1] = {[unit](Vec2 p) {
                        const SurfaceJet j = testing::torus_jet(p, 1, 0.4);
                        return SurfaceJet{unit * j.s,   unit * j.su,  unit * j.sv,
                                          unit * j.suu, unit * j.suv, unit * j.svv};
                      },
                      testing::rectangle({0, 0}, {pi / 2, 2 * pi})};
      const GradedRun run(std::move(cad), 1.1, [&](Parameters& p) {
        p.set("hphy_flag", 0);
        p.set("hgeo_flag", 1);
        p.set("geo_metric", anisotropic);
      });
      std::vector<Vec3> vertices = run.session->mesh().vertices;
      for (Vec3& v : vertices) v = (1 / unit) * v;
      if (one.empty()) one = vertices;
      EXPECT_EQ(vertices, one) << unit;
    }
  }
}

// A plate [0, 4] x [-1, 1] with a disc of radius `radius` cut out at the origin of x = 2: gaps of 1 - radius.
AnalyticCad plate_with_hole(double radius) {
  AnalyticCad cad = square(1);
  cad.faces[1].curves = testing::rectangle({0, -1}, {4, 1});
  cad.faces[1].curves.push_back(testing::arc({2, 0}, radius, 2 * pi, pi));
  cad.faces[1].curves.push_back(testing::arc({2, 0}, radius, pi, 0));
  return cad;
}

TEST(Proximity, NarrowZonesHoldTheRequestedLayers) {
  for (const double radius : {0.8, 0.9, 0.95})
    for (const int layers : {2, 4}) {
      const GradedRun run(plate_with_hole(radius), 1.3, [&](Parameters& p) {
        p.set("hphy_flag", 1);
        p.set("hphydef", 0.3);
        p.set("proximity", layers);
      });
      const double wanted = (1 - radius) / layers;
      const SurfaceMesh& mesh = run.session->mesh();
      const auto& h = run.session->vertex_sizes();
      double narrowest = 1, widest = 0;
      for (std::size_t v = 0; v < h.size(); ++v) {
        const Vec3 x = mesh.vertices[v];
        if (std::abs(x.x() - 2) < 0.05 && std::abs(x.y()) > radius - 1e-9)
          narrowest = std::min(narrowest, h[v]), widest = std::max(widest, h[v]);
      }
      if (std::getenv("CARREAU_TEST_VERBOSE") != nullptr)
        std::printf("radius %g layers %d: wanted %.4f, sizes %.4f to %.4f; %zu triangles, %d rounds\n", radius, layers,
                    wanted, narrowest, widest, mesh.triangle_count(), run.session->report().gradation_rounds);
      EXPECT_LE(widest, 1.1 * wanted);
      EXPECT_GE(narrowest, 0.9 * wanted);
      EXPECT_LE(*std::max_element(h.begin(), h.end()), 0.3 + 1e-12);
    }
}

// No number of layers fits into the tip of a wedge: it is a triangle of the size prescribed there, and sizes do not go
// to zero. Beyond, they follow the gap.
TEST(Proximity, WedgesEndInATriangle) {
  for (const double degrees : {1., 3., 10.}) {
    const double opening = std::tan(degrees * pi / 180), wanted = 0.1;
    AnalyticCad cad = square(1);
    cad.faces[1].curves = {testing::segment({0, 0}, {1, 0}), testing::segment({1, 0}, {1, opening}),
                           testing::segment({1, opening}, {0, 0})};
    constexpr int layers = 3;
    const GradedRun run(cad, 1.3, [&](Parameters& p) {
      p.set("hphy_flag", 1);
      p.set("hphydef", wanted);
      p.set("proximity", layers);
    });
    const SurfaceMesh& mesh = run.session->mesh();
    const auto& h = run.session->vertex_sizes();
    // As wide as it is one prescribed edge from the tip, less the distance between two vertices of the graph.
    EXPECT_GE(*std::min_element(h.begin(), h.end()), 0.7 * wanted * opening / layers) << degrees;
    for (std::size_t v = 0; v < h.size(); ++v) {
      const double x = mesh.vertices[v].x();
      if (x < 2 * wanted || x > 1 - 2.5 * opening) continue;  // the blunt end has corners, too
      EXPECT_LE(h[v], 1.1 * std::min(wanted, x * opening / layers)) << degrees << " at x = " << x;
    }
  }
}

TEST(Proximity, WideDomainsAreLeftAlone) {
  for (const int layers : {0, 3}) {
    const GradedRun run(square(1), 1.3, [&](Parameters& p) {
      p.set("hphy_flag", 1);
      p.set("hphydef", 0.2);
      p.set("proximity", layers);
    });
    for (const double h : run.session->vertex_sizes()) EXPECT_EQ(h, 0.2);
  }
}

TEST(Proximity, NeedsAGradation) {
  Monitor monitor;
  Session session(monitor);
  session.set_cad(std::make_shared<AnalyticCad>(square(1)));
  session.set_model(testing::unglued(square(1)));
  session.parameters().set("proximity", 2);
  EXPECT_THROW(session.make_mesh(), InvalidArgument);
  EXPECT_THROW(session.parameters().set("gradation", 0.9), InvalidArgument);
  EXPECT_THROW(session.parameters().set("gradation", 1.), InvalidArgument);
  EXPECT_THROW(session.parameters().set("gradation", -1.), InvalidArgument);
}

}  // namespace
}  // namespace carreau
