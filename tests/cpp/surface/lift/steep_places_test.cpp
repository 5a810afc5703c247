// SPDX-License-Identifier: BSD-3-Clause
// Spots of a background mesh in space that are narrower than the edges around them are found, wherever they lie (one in
// seven is not by the samples of the field and vertices of the mesh alone).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>

#include "common/analytic_cad.h"
#include "session/session.h"
#include "support/infinity.h"

namespace carreau {
namespace {

using testing::AnalyticCad;

constexpr double coarse = 0.2, fine = 0.01, radius = 0.08;

struct Patch {
  const char* name;
  std::function<SurfaceJet(Vec2)> at;
  Vec2 low, high;
  int columns, rows;  // of the background mesh: its edges are a quarter of the sizes
};

SurfaceJet wavy_jet(Vec2 p) {
  std::array<Vec3, 16> control;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) control[4 * i + j] = {0.7 * i, 0.7 * j + 0.2 * (i % 2), (i + 2 * j) % 3 == 1 ? 0.8 : 0};
  return testing::bezier_jet(control, p);
}

std::vector<Patch> patches() {
  return {{"sphere", testing::stereographic_jet, {-0.6, -0.6}, {0.6, 0.6}, 36, 36},
          {"torus", [](Vec2 p) { return testing::torus_jet(p, 2, 0.7); }, {0, 0}, {1.2, 3}, 56, 40},
          {"bicubic", wavy_jet, {0, 0}, {1, 1}, 44, 44}};
}

BackgroundMesh lifted_grid(const Patch& patch) {
  BackgroundMesh mesh;
  const int nx = patch.columns, ny = patch.rows;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      mesh.vertices.push_back(patch
                                  .at({std::lerp(patch.low.x(), patch.high.x(), i / double(nx)),
                                       std::lerp(patch.low.y(), patch.high.y(), j / double(ny))})
                                  .s);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const std::int32_t k = j * (nx + 1) + i;
      mesh.triangles.push_back({k, k + 1, k + nx + 2});
      mesh.triangles.push_back({k, k + nx + 2, k + nx + 1});
    }
  mesh.values.sizes.assign(mesh.vertices.size(), coarse);
  return mesh;
}

/// The metric length by Simpson's rule in the background.
double metric_length(BackgroundField& field, Vec3 p, Vec3 q) {
  constexpr int parts = 16;
  double sum = 0;
  for (int k = 0; k <= parts; ++k)
    sum += (k == 0 || k == parts ? 1
            : k % 2 == 1         ? 4
                                 : 2) /
           field.on_surface(1, {}, lerp(p, q, k / double(parts))).size;
  return sum * norm(q - p) / (3 * parts);
}

struct Lengths {
  double in_range = 0, longest = 0, nearest_vertex = infinity;
};

/// Metric lengths of edges that end within `around` of a place, and that from the place to the nearest vertex.
Lengths measure(const FlatMesh& mesh, const BackgroundMesh& background, Vec3 place, double around) {
  BackgroundField field(background);
  Lengths l;
  double count = 0;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Vec3 p = mesh.vertices[t[i]], q = mesh.vertices[t[(i + 1) % 3]];
      if (norm(p - place) > around && norm(q - place) > around) continue;
      const double length = metric_length(field, p, q);
      l.in_range += length >= std::numbers::sqrt2 / 2 && length <= std::numbers::sqrt2 ? 1 : 0;
      l.longest = std::max(l.longest, length);
      l.nearest_vertex = std::min(l.nearest_vertex, metric_length(field, p, place));
      ++count;
    }
  l.in_range /= count;
  return l;
}

TEST(SteepPlaces, SpotsOfABackgroundInSpaceAreMeshed) {
  double in_range = 0, spots = 0;
  for (const Patch& patch : patches()) {
    const BackgroundMesh plain = lifted_grid(patch);
    for (std::size_t spot = 0; spot < plain.vertices.size(); spot += 101) {
      BackgroundMesh background = plain;
      for (std::size_t v = 0; v < plain.vertices.size(); ++v)
        if (norm(plain.vertices[v] - plain.vertices[spot]) < radius) background.values.sizes[v] = fine;
      auto cad = std::make_shared<AnalyticCad>();
      cad->faces[1] = {patch.at, testing::rectangle(patch.low, patch.high)};
      Monitor monitor;
      Session session(monitor);
      session.set_cad(cad);
      session.set_model(testing::unglued(*cad));
      session.parameters().set("hphy_flag", 2);
      session.parameters().set("hphymin", 1e-4);
      session.parameters().set("hphymax", 10.);
      session.set_background(std::make_shared<BackgroundField>(background));
      session.make_mesh();
      EXPECT_EQ(find_defects(session.mesh()), std::vector<std::string>{});
      const Vec3 place = plain.vertices[spot];
      const Lengths l = measure(session.exported(), background, place, coarse);
      // Within the spot sizes are the same; sizes of the rim grow twentyfold on a quarter of an edge.
      EXPECT_LE(l.longest, 3) << patch.name << ' ' << spot;
      EXPECT_LE(l.nearest_vertex, 1) << patch.name << ' ' << spot;
      in_range += l.in_range;
      ++spots;
      if (std::getenv("CARREAU_TEST_VERBOSE") != nullptr)
        std::printf("%s %zu: in range %.3f, longest %.2f, nearest %.2f; %d corrections\n", patch.name, spot, l.in_range,
                    l.longest, l.nearest_vertex, session.report().corrections);
    }
  }
  EXPECT_GE(in_range / spots, 2. / 3);
}

/// [0, 2] x [0, 1] of the plane, as two faces.
std::shared_ptr<AnalyticCad> two_squares() {
  auto cad = std::make_shared<AnalyticCad>();
  for (const int face : {1, 2})
    cad->faces[face] = {[face](Vec2 p) {
                          return SurfaceJet{{p.x() + face - 1, p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}};
                        },
                        testing::rectangle({0, 0}, {1, 1})};
  return cad;
}

// From a spot in one face sizes grow in the other one too, wherever it lies (the samples of the graph of the gradation
// alone miss all of these: sizes beyond the common side were thirteen times too large). Between vertices of the graph,
// whose edges are two sizes long, they may exceed the cone.
TEST(SteepPlaces, SizesGrowFromSpotsInAllFaces) {
  constexpr double gradation = 1.3, narrow = 0.02;
  const Patch plane{"plane", [](Vec2 p) { return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; },
                    {0, 0},  {2, 1},
                    100,     50};
  for (const double y : {0.23, 0.37, 0.49, 0.66, 0.78}) {
    BackgroundMesh background = lifted_grid(plane);
    const Vec3 place{0.93, y, 0};
    std::vector<Vec3> spot;
    for (std::size_t v = 0; v < background.vertices.size(); ++v)
      if (norm(background.vertices[v] - place) < narrow) {
        background.values.sizes[v] = fine;
        spot.push_back(background.vertices[v]);
      }
    Monitor monitor;
    Session session(monitor);
    const auto cad = two_squares();
    session.set_cad(cad);
    session.set_model(testing::unglued(*cad));
    session.parameters().set("hphy_flag", 2);
    session.parameters().set("hphymin", 1e-4);
    session.parameters().set("hphymax", 10.);
    session.parameters().set("gradation", gradation);
    session.set_background(std::make_shared<BackgroundField>(background));
    session.make_mesh();
    EXPECT_EQ(find_defects(session.mesh()), std::vector<std::string>{});
    double steepest = 0;
    for (std::size_t v = 0; v < session.mesh().vertices.size(); ++v) {
      const Vec3 x = session.mesh().vertices[v];
      if (x.x() < 1) continue;
      double away = infinity;
      for (const Vec3& s : spot) away = std::min(away, norm(x - s));
      steepest = std::max(steepest, session.vertex_sizes()[v] / std::min(coarse, fine + std::log(gradation) * away));
    }
    EXPECT_LE(steepest, gradation * gradation) << y;
    if (std::getenv("CARREAU_TEST_VERBOSE") != nullptr)
      std::printf("spot at %.2f: %.3f times the cone; %zu triangles, %d rounds of %zu\n", y, steepest,
                  session.mesh().triangle_count(), session.report().gradation_rounds,
                  session.report().gradation_triangles);
  }
}

}  // namespace
}  // namespace carreau
