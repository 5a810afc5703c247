// SPDX-License-Identifier: BSD-3-Clause
// Molecular surfaces through the ordinary pipeline.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "balls_from_files.h"
#include "geometry/molecule/molecule.h"
#include "session/session.h"

namespace carreau::molecule {
namespace {

constexpr double pi = std::numbers::pi;

double area_of(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles) {
      const Vec3& p = mesh.vertices[face.vertex[t[0]]];
      sum += norm(cross(mesh.vertices[face.vertex[t[1]]] - p, mesh.vertices[face.vertex[t[2]]] - p)) / 2;
    }
  return sum;
}

/// Euler's number of a closed mesh.
int euler_number_of(const SurfaceMesh& mesh) {
  return static_cast<int>(mesh.vertices.size()) - static_cast<int>(mesh.triangle_count() / 2);
}

/// Meshes with edges of one length; every face has a mesh without defects, closed.
SurfaceMesh mesh_of(const BuiltGeometry& built, double size) {
  Monitor silent;
  Session session(silent);
  session.set_cad(built.cad);
  session.set_model(built.model);
  session.parameters().set("hphy_flag", 1);
  session.parameters().set("hphydef", size);
  session.make_mesh();
  const SurfaceMesh mesh = session.mesh();
  EXPECT_EQ(find_defects(mesh, {.closed = true}), std::vector<std::string>{});
  return mesh;
}

BuiltGeometry built(const std::vector<Ball>& balls, SurfaceKind kind) {
  Monitor silent;
  return build_surface({balls}, {.kind = kind}, silent);
}

TEST(MolecularSurfaces, TwoBallsConvergeToTheirAreaAtSecondOrder) {
  const std::vector<Ball> balls{{{0, 0, 0}, 1.7}, {{1.5, 0, 0}, 1.7}};
  for (const auto& [kind, exact] : {std::pair{SurfaceKind::vws, 52.338933}, {SurfaceKind::sas, 149.979556}}) {
    double error[2];
    for (const int fine : {0, 1}) {
      const SurfaceMesh mesh = mesh_of(built(balls, kind), fine == 0 ? 0.3 : 0.15);
      EXPECT_EQ(euler_number_of(mesh), 2);
      error[fine] = exact - area_of(mesh);
    }
    EXPECT_GT(error[1], 0);
    EXPECT_NEAR(error[0] / error[1], 4, 0.6);
  }
}

TEST(MolecularSurfaces, ALoneBallIsTwoCharts) {
  const SurfaceMesh mesh = mesh_of(built({{{1, 2, 3}, 2}}, SurfaceKind::vws), 0.2);
  EXPECT_EQ(euler_number_of(mesh), 2);
  ASSERT_EQ(mesh.faces.size(), 2U);
  EXPECT_EQ(mesh.faces[1].shown_ref(), 1);
  for (const Vec3& p : mesh.vertices) EXPECT_NEAR(norm(p - Vec3{1, 2, 3}), 2, 1e-12);
  EXPECT_NEAR(area_of(mesh), 16 * pi, 0.2);
}

/// Vertices of each face at the radius of its atom, and in no other ball by more than a chord allows.
void check_distances(const SurfaceMesh& mesh, const std::vector<Ball>& balls, double size) {
  for (const FaceMesh& face : mesh.faces) {
    const Ball& ball = balls[face.shown_ref() - 1];
    for (const std::int32_t v : face.vertex) EXPECT_NEAR(norm(mesh.vertices[v] - ball.centre), ball.radius, 1e-12);
  }
  for (const Vec3& p : mesh.vertices)
    for (const Ball& ball : balls) EXPECT_GT(norm(p - ball.centre), ball.radius - size * size / (8 * ball.radius));
}

TEST(MolecularSurfaces, CaffeineIsClosedAndOnItsSpheres) {
  for (const auto& [kind, probe] : {std::pair{SurfaceKind::vws, 0.0}, {SurfaceKind::sas, 1.4}}) {
    const std::vector<Ball> balls = read_balls("caffeine.xyzr");
    Monitor silent;
    const SurfaceOptions options{.kind = kind};
    const Arrangement a = arrange(Molecule{balls}, options, silent);
    const SurfaceMesh mesh = mesh_of(build_surface({balls}, options, silent), 0.3);
    EXPECT_EQ(euler_number_of(mesh), a.euler_number());
    check_distances(mesh, a.balls, 0.3);
    EXPECT_NEAR(area_of(mesh), measure(a).area, 0.01 * measure(a).area);
  }
}

TEST(MolecularSurfaces, DnaIsClosedWithTheEulerNumberOfItsArcs) {
  const std::vector<Ball> balls = read_balls("1bna.xyzr");
  for (const auto& [kind, euler] : {std::pair{SurfaceKind::vws, -70}, {SurfaceKind::sas, 0}, {SurfaceKind::ses, 2}}) {
    Monitor silent;
    MoleculeSummary summary;
    const SurfaceMesh mesh = mesh_of(build_surface({balls}, {.kind = kind}, silent, &summary), 0.5);
    EXPECT_EQ(summary.euler_number, euler);
    EXPECT_EQ(euler_number_of(mesh), euler);
  }
}

/// A globule of a protein's density, 18 cubic angstrom an atom: places at random, 1.5 apart at least.
std::vector<Ball> globule(int n) {
  std::mt19937 random(3);
  const double ball = std::cbrt(3 * n * 18 / (4 * pi));
  std::uniform_real_distribution<double> place(-ball, ball);
  std::vector<Ball> balls;
  while (static_cast<int>(balls.size()) < n) {
    const double x = place(random), y = place(random), z = place(random);
    const Vec3 p{x, y, z};
    if (norm(p) > ball || std::any_of(balls.begin(), balls.end(), [&](const Ball& b) { return norm(p - b.centre) < 1.5; }))
      continue;
    balls.push_back({p, balls.size() % 2 == 0 ? 1.2 : balls.size() % 3 == 0 ? 1.52 : 1.7});
  }
  return balls;
}

TEST(MolecularSurfaces, GlobulesAreClosedWithTheEulerNumberOfTheirArcs) {
  for (const SurfaceKind kind : {SurfaceKind::vws, SurfaceKind::sas, SurfaceKind::ses}) {
    Monitor silent;
    MoleculeSummary summary;
    constexpr double size = 0.6, min_radius = 1.2;
    const SurfaceMesh mesh = mesh_of(build_surface({globule(100)}, {.kind = kind}, silent, &summary), size);
    EXPECT_EQ(euler_number_of(mesh), summary.euler_number);
    // Equilateral triangles on a sphere lose h^2 / (8 r^2) of its area; twice as much is allowed.
    const double chords = size * size / (4 * min_radius * min_radius);
    EXPECT_NEAR(area_of(mesh), summary.measures.area, chords * summary.measures.area);
    for (const FaceMesh& face : mesh.faces) EXPECT_NE(face.status, FaceStatus::failed);
  }
}

TEST(MolecularSurfaces, CaffeinesAreaConvergesAtSecondOrder) {
  for (const SurfaceKind kind : {SurfaceKind::vws, SurfaceKind::sas, SurfaceKind::ses}) {
    Monitor silent;
    MoleculeSummary summary;
    const BuiltGeometry caffeine = build_surface({read_balls("caffeine.xyzr")}, {.kind = kind}, silent, &summary);
    const double coarse = area_of(mesh_of(caffeine, 0.2)), fine = area_of(mesh_of(caffeine, 0.1));
    EXPECT_LT(coarse, fine);
    EXPECT_LT(fine, summary.measures.area);
    EXPECT_NEAR((4 * fine - coarse) / 3, summary.measures.area, 5e-4 * summary.measures.area);
  }
}

TEST(MolecularSurfaces, CavitiesAreKeptOrDropped) {
  std::vector<Ball> cage;
  for (int k = 0; k < 60; ++k) {
    const double z = 1 - (2 * k + 1) / 60.0, r = std::sqrt(1 - z * z), turn = 2.399963 * k;
    cage.push_back({Vec3{4 * r * std::cos(turn), 4 * r * std::sin(turn), 4 * z}, 1.6});
  }
  Monitor silent;
  for (const SurfaceKind kind : {SurfaceKind::vws, SurfaceKind::ses})
    for (const bool cavities : {true, false}) {
      MoleculeSummary summary;
      const SurfaceOptions options{.kind = kind, .probe = 0.5, .cavities = cavities};
      const SurfaceMesh mesh = mesh_of(build_surface({cage}, options, silent, &summary), 0.4);
      ASSERT_EQ(summary.measures.shell_volume.size(), 2U);
      EXPECT_EQ(summary.euler_number, cavities ? 4 : 2);
      EXPECT_EQ(euler_number_of(mesh), summary.euler_number);
    }
}

TEST(MolecularSurfaces, FourSpheresThroughAPointAreMeshed) {
  const std::vector<Ball> square{{{0, 0, 0}, 1.2}, {{1, 0, 0}, 1.2}, {{0, 1, 0}, 1.2}, {{1, 1, 0}, 1.2}};
  const SurfaceMesh mesh = mesh_of(built(square, SurfaceKind::vws), 0.2);
  EXPECT_EQ(euler_number_of(mesh), 2);
  EXPECT_EQ(mesh.faces.size(), 4U);
}

// ---- The solvent excluded surface ----

constexpr double probe = 1.4;

BuiltGeometry excluded(const std::vector<Ball>& balls, MoleculeSummary* summary = nullptr) {
  Monitor silent;
  return build_surface({balls}, {.kind = SurfaceKind::ses, .probe = probe}, silent, summary);
}

/// Three balls about a hole through which no probe fits, and in which the probes on both sides cross.
const std::vector<Ball> with_hole{{{0, 0, 0}, 1.7}, {{5, 0, 0}, 1.7}, {{2.5, 4.330127, 0}, 1.7}};
/// A spindle whose tube a third ball interrupts: its two probes cross, from tip to tip.
const std::vector<Ball> with_tips{{{0, 0, 0}, 1.7}, {{5.6, 0, 0}, 1.7}, {{2.8, 1.5, 0}, 1.7}};
const std::vector<Ball> with_many_tips{
    {{0, 0, 0}, 1.7}, {{5.6, 0, 0}, 1.7}, {{2.8, 2.5, 0}, 1.7}, {{2.8, -2.6, 0.3}, 1.5}};

/// A ball that a lower one and three others cover but for a triangle; `gap` is the radius of its inscribed circle, an
/// angle.
std::vector<Ball> ball_with_a_small_triangle(double gap, const std::array<double, 3>& azimuths) {
  constexpr double radius = 1.5, distance = 2, polar = pi / 3;
  std::vector<Ball> balls{{{0, 0, 0}, radius}};
  const double r = std::sqrt(radius * radius + distance * distance - 2 * radius * distance * std::cos(polar - gap));
  for (const double degrees : azimuths) {
    const double a = degrees * pi / 180;
    const Vec3 axis{std::sin(polar) * std::cos(a), std::sin(polar) * std::sin(a), std::cos(polar)};
    balls.push_back({distance * axis, r});
  }
  balls.push_back({{0, 0, -1.5}, 2.9});
  return balls;
}

// A hundred-thousandth of the diagonal, and a millionth of the radius, lie between the shortest and the longest side of
// some of these triangles.
TEST(MolecularSurfaces, PartsWhoseSidesShrinkToPointsVanish) {
  for (const std::array<double, 3>& azimuths : {std::array{0., 60., 210.}, {0., 100., 215.}})
    for (double gap = 2e-5; gap > 1e-7; gap /= 1.07) {
      const std::vector<Ball> balls = ball_with_a_small_triangle(gap, azimuths);
      const SurfaceMesh mesh = mesh_of(built(balls, SurfaceKind::vws), 2);
      EXPECT_EQ(euler_number_of(mesh), 2) << gap;
      for (const FaceMesh& face : mesh.faces) EXPECT_NE(face.status, FaceStatus::failed) << gap << ": " << face.why;
    }
}

TEST(SolventExcluded, TwoBallsHaveTheAreasOfTheirParts) {
  MoleculeSummary summary;
  const BuiltGeometry built = excluded({{{0, 0, 0}, 1.7}, {{1.5, 0, 0}, 1.7}}, &summary);
  EXPECT_NEAR(summary.measures.area - summary.torus, 45.1031, 5e-5);
  EXPECT_NEAR(summary.torus, 6.9721, 5e-5);
  EXPECT_EQ(summary.concave, 0);
  double error[2];
  for (const int fine : {0, 1}) error[fine] = summary.measures.area - area_of(mesh_of(built, fine == 0 ? 0.2 : 0.1));
  EXPECT_NEAR(error[0] / error[1], 4, 0.6);
}

TEST(SolventExcluded, AreasAndVolumesDoNotDependOnTheAxes) {
  for (const char* name : {"caffeine.xyzr", "1bna.xyzr"}) {
    const std::vector<Ball> balls = read_balls(name);
    std::vector<Ball> turned = balls;
    const double c = std::cos(0.7), s = std::sin(0.7);
    for (Ball& ball : turned) {
      const Vec3 p = ball.centre, q{c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()};
      ball.centre = Vec3{q.x() + 3, s * q.z() + c * q.y() - 7, c * q.z() - s * q.y() + 1};
    }
    MoleculeSummary given, after;
    excluded(balls, &given), excluded(turned, &after);
    EXPECT_NEAR(after.measures.area, given.measures.area, 1e-9 * given.measures.area);
    EXPECT_NEAR(after.measures.volume, given.measures.volume, 1e-9 * given.measures.volume);
    EXPECT_NEAR(after.torus, given.torus, 1e-9 * given.measures.area);
    EXPECT_NEAR(after.concave, given.concave, 1e-9 * given.measures.area);
  }
}

TEST(SolventExcluded, ASpindleComesApartAtTheAxis) {
  MoleculeSummary summary;
  const SurfaceMesh mesh = mesh_of(excluded({{{0, 0, 0}, 1.7}, {{5.6, 0, 0}, 1.7}}, &summary), 0.15);
  EXPECT_EQ(summary.euler_number, 4);
  EXPECT_EQ(euler_number_of(mesh), 4);
  EXPECT_EQ(mesh.faces.size(), 6U);
}

TEST(SolventExcluded, AProbeInAHoleThatItDoesNotPassMakesAHandle) {
  MoleculeSummary summary;
  const SurfaceMesh mesh = mesh_of(excluded(with_hole, &summary), 0.2);
  EXPECT_EQ(summary.euler_number, 0);
  EXPECT_EQ(euler_number_of(mesh), 0);
}

double volume_of(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles)
      sum += dot(mesh.vertices[face.vertex[t[0]]],
                 cross(mesh.vertices[face.vertex[t[1]]], mesh.vertices[face.vertex[t[2]]])) /
             6;
  return sum;
}

TEST(SolventExcluded, ManySpheresThroughAPointLeaveNoThinFaces) {
  std::vector<Ball> benzene;  // on its axis six spheres of carbons meet in two points
  for (int k = 0; k < 12; ++k) {
    const double r = k < 6 ? 1.39 : 2.48, turn = k * pi / 3;
    benzene.push_back({{r * std::cos(turn), r * std::sin(turn), 0}, k < 6 ? 1.7 : 1.2});
  }
  MoleculeSummary summary;
  const SurfaceMesh mesh = mesh_of(excluded(benzene, &summary), 0.2);
  EXPECT_EQ(summary.moved, 12U);
  EXPECT_EQ(euler_number_of(mesh), 2);
  EXPECT_NEAR(area_of(mesh), summary.measures.area, 0.01 * summary.measures.area);
  for (const CurveMesh& curve : mesh.curves)
    EXPECT_GT(norm(mesh.vertices[curve.vertices.front()] - mesh.vertices[curve.vertices[1]]), 1e-3);
}

TEST(SolventExcluded, AreasAndVolumesMatchFineMeshes) {
  for (const std::vector<Ball>& balls : {with_hole, with_tips, with_many_tips}) {
    MoleculeSummary summary;
    const BuiltGeometry built = excluded(balls, &summary);
    const SurfaceMesh coarse = mesh_of(built, 0.2), fine = mesh_of(built, 0.1);
    EXPECT_EQ(euler_number_of(fine), summary.euler_number);
    const double area = summary.measures.area, volume = summary.measures.volume;
    // Errors of second order: Richardson's extrapolation takes most of them away.
    EXPECT_NEAR((4 * area_of(fine) - area_of(coarse)) / 3, area, 1e-3 * area);
    EXPECT_NEAR((4 * volume_of(fine) - volume_of(coarse)) / 3, volume, 1e-3 * volume);
  }
}

/// A probe at its radius from each vertex, along the normal there, goes into no ball; and no vertex is in a probe that
/// touches three balls.
void check_probes(const std::vector<Ball>& balls, double size) {
  Monitor silent;
  const Arrangement grown = arrange(Molecule{balls}, {.kind = SurfaceKind::ses, .probe = probe}, silent);
  const BuiltGeometry built = excluded(balls);
  const SurfaceMesh mesh = mesh_of(built, size);
  for (const FaceMesh& face : mesh.faces)
    for (std::size_t k = 0; k < face.vertex.size(); ++k) {
      const SurfaceJet jet = surface_at(*built.cad, face.ref, want_position | want_first, face.uv[k]);
      const Vec3 normal = cross(jet.su, jet.sv), centre = jet.s + probe / norm(normal) * normal;
      if (norm(normal) < 1e-6) continue;  // the tip of a spindle
      for (const Ball& ball : balls) ASSERT_GT(norm(centre - ball.centre), ball.radius + probe - 1e-9);
    }
  for (const Vec3& p : mesh.vertices)
    for (const Vertex& v : grown.vertices) ASSERT_GT(norm(p - v.x), probe - 1e-9);
}

TEST(SolventExcluded, NoProbeBesideAVertexGoesIntoABall) {
  for (const std::vector<Ball>& balls : {with_hole, with_tips, with_many_tips}) check_probes(balls, 0.2);
  check_probes(read_balls("caffeine.xyzr"), 0.3);
}

/// A spindle of short arcs, where the rest of a probe's triangle comes apart at both tips of one side.
TEST(SolventExcluded, PartsOfAProbeThatComeApartAreFacesOfTheirOwn) {
  std::mt19937 random(7);
  int apart = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::uniform_real_distribution<double> place(0, 8);
    std::vector<Ball> balls;
    for (int i = 0; i < 7; ++i) balls.push_back({{place(random), place(random), place(random)}, 1.7});
    MoleculeSummary summary;
    const BuiltGeometry built = excluded(balls, &summary);
    const SurfaceMesh mesh = mesh_of(built, 0.5);
    EXPECT_EQ(euler_number_of(mesh), summary.euler_number);
    for (const Face& face : built.model.faces) apart += face.ref > 7 && face.curves.size() == 3 ? 1 : 0;
  }
  EXPECT_GT(apart, 20);
}

TEST(SolventExcluded, NormalsAgreeAcrossAllInterfacesButCrossings) {
  const BuiltGeometry built = excluded(read_balls("caffeine.xyzr"));
  std::map<int, std::pair<Vec3, Vec3>> middle;  // of each curve: place and normal
  int smooth = 0;
  for (const Face& face : built.model.faces)
    for (std::size_t c = 0; c < face.curves.size(); ++c) {
      const int ic = static_cast<int>(c) + 1;
      const auto [a, b] = built.cad->curve_interval(face.ref, ic);
      const Vec2 uv = built.cad->curve(face.ref, ic, want_position, (a + b) / 2).c;
      const SurfaceJet jet = surface_at(*built.cad, face.ref, want_position | want_first, uv);
      const Vec3 n = cross(jet.su, jet.sv), normal = n / norm(n);
      const auto [at, first] = middle.try_emplace(face.curves[c].ref, jet.s, normal);
      if (first) continue;
      EXPECT_LT(norm(at->second.first - jet.s), 1e-10);
      EXPECT_LT(norm(at->second.second - normal), 1e-6);
      ++smooth;
    }
  EXPECT_EQ(smooth, static_cast<int>(middle.size()));
}

TEST(SolventExcluded, PatchesHaveTheDerivativesOfTheirPositions) {
  const BuiltGeometry built = excluded(with_many_tips);
  constexpr double h = 1e-5;
  for (const Face& face : built.model.faces) {
    const auto [a, b] = built.cad->curve_interval(face.ref, 1);
    const CurveJet curve = built.cad->curve(face.ref, 1, 7, (a + 2 * b) / 3);
    const CurveJet after = built.cad->curve(face.ref, 1, 7, (a + 2 * b) / 3 + h);
    EXPECT_LT(norm(after.c - curve.c - h * curve.ct - h * h / 2 * curve.ctt), 1e-12);
    EXPECT_LT(norm(after.ct - curve.ct - h * curve.ctt), 1e-8);
    const SurfaceJet jet = surface_at(*built.cad, face.ref, 7, curve.c);
    const SurfaceJet u = surface_at(*built.cad, face.ref, 7, curve.c + Vec2{h, 0});
    const SurfaceJet v = surface_at(*built.cad, face.ref, 7, curve.c + Vec2{0, h});
    EXPECT_LT(norm(u.s - jet.s - h * jet.su - h * h / 2 * jet.suu), 1e-12);
    EXPECT_LT(norm(v.s - jet.s - h * jet.sv - h * h / 2 * jet.svv), 1e-12);
    EXPECT_LT(norm(u.su - jet.su - h * jet.suu), 1e-8);
    EXPECT_LT(norm(u.sv - jet.sv - h * jet.suv), 1e-8);
    EXPECT_LT(norm(v.sv - jet.sv - h * jet.svv), 1e-8);
    // The smaller radius of curvature, from the fundamental forms.
    const Vec3 n = cross(jet.su, jet.sv) / norm(cross(jet.su, jet.sv));
    const double e = dot(jet.su, jet.su), f = dot(jet.su, jet.sv), g = dot(jet.sv, jet.sv);
    const double l = dot(jet.suu, n), m = dot(jet.suv, n), q = dot(jet.svv, n), det = e * g - f * f;
    const double mean = (e * q - 2 * f * m + g * l) / (2 * det), gauss = (l * q - m * m) / det;
    const double largest = std::abs(mean) + std::sqrt(std::max(0.0, mean * mean - gauss));
    EXPECT_NEAR(built.cad->surface_radius(face.ref, curve.c).value() * largest, 1, 1e-6);
  }
}

}  // namespace
}  // namespace carreau::molecule
