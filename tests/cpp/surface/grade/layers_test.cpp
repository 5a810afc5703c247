// SPDX-License-Identifier: BSD-3-Clause
// Narrow zones hold at least the requested layers of triangles (parameter proximity), counted in the mesh.
#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <numbers>
#include <set>

#include "common/analytic_cad.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
constexpr double pi = std::numbers::pi;

SurfaceJet plane(Vec2 p) { return {{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }

std::unique_ptr<Session> meshed(const AnalyticCad& cad, double size, int layers, Monitor& monitor,
                                double gradation = 1.4) {
  auto session = std::make_unique<Session>(monitor);
  session->set_cad(std::make_shared<AnalyticCad>(cad));
  session->set_model(testing::unglued(cad));
  Parameters& p = session->parameters();
  p.set("hphydef", size);
  p.set("hphymin", size / 1000);
  p.set("hphymax", size);
  p.set("eps_glue", 1e-6);
  p.set("gradation", gradation);
  p.set("proximity", layers);
  session->make_mesh();
  EXPECT_EQ(find_defects(session->mesh()), std::vector<std::string>{});
  return session;
}

/// Fewest edges of triangles of one face on a way from a vertex that `starts` to one that `ends`: the layers between.
/// Ways pass vertices that are `inside` only.
template <typename Starts, typename Ends, typename Inside>
int layers_between(const SurfaceMesh& mesh, std::size_t face_index, Starts&& starts, Ends&& ends, Inside&& inside) {
  const FaceMesh& face = mesh.faces[face_index];
  std::vector<std::set<std::int32_t>> next(mesh.vertices.size());
  for (const auto& t : face.triangles)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = face.vertex[t[i]], b = face.vertex[t[(i + 1) % 3]];
      next[static_cast<std::size_t>(a)].insert(b);
      next[static_cast<std::size_t>(b)].insert(a);
    }
  std::vector<int> steps(mesh.vertices.size(), -1);
  std::deque<std::size_t> front;
  for (std::size_t v = 0; v < steps.size(); ++v)
    if (!next[v].empty() && starts(mesh.vertices[v])) steps[v] = 0, front.push_back(v);
  while (!front.empty()) {
    const std::size_t v = front.front();
    front.pop_front();
    if (ends(mesh.vertices[v])) return steps[v];
    for (const std::int32_t w : next[v])
      if (int& step = steps[static_cast<std::size_t>(w)];
          step < 0 && inside(mesh.vertices[static_cast<std::size_t>(w)]))
        step = steps[v] + 1, front.push_back(static_cast<std::size_t>(w));
  }
  return -1;
}

bool anywhere(Vec3) { return true; }

template <typename Starts, typename Ends>
int layers_between(const SurfaceMesh& mesh, std::size_t face_index, Starts&& starts, Ends&& ends) {
  return layers_between(mesh, face_index, starts, ends, anywhere);
}

/// The places of ways across a narrow zone. Towards corners, and where its sides part, there is no narrow zone
/// (size/README).
enum class Ways : std::uint8_t { anywhere, in_the_zone };

void expect_layers_across_a_strip(double width, int layers, Ways ways) {
  SCOPED_TRACE(::testing::Message() << "width " << width << ", layers " << layers);
  AnalyticCad cad;
  cad.faces[1] = {plane, testing::rectangle({0, 0}, {1, width})};
  Monitor monitor;
  const auto session = meshed(cad, 0.4, layers, monitor);
  // Away from the ends, whose corners join both sides.
  const auto inside = [&](Vec3 p) { return p.x() > 2 * width && p.x() < 1 - 2 * width; };
  const auto low = [&](Vec3 p) { return p.y() == 0 && inside(p); };
  const auto high = [&](Vec3 p) { return p.y() > width - 1e-9 && inside(p); };
  const auto way = [&](Vec3 p) { return ways == Ways::anywhere || inside(p); };
  EXPECT_GE(layers_between(session->mesh(), 0, low, high, way), layers);
}

void expect_layers_around_a_hole(double gap, int layers, Ways ways) {
  SCOPED_TRACE(::testing::Message() << "gap " << gap << ", layers " << layers);
  AnalyticCad cad;
  cad.faces[1] = {plane, testing::rectangle({-2, -1}, {2, 1})};
  cad.faces[1].curves.push_back(testing::arc({0, 0}, 1 - gap, 2 * pi, pi));
  cad.faces[1].curves.push_back(testing::arc({0, 0}, 1 - gap, pi, 0));
  Monitor monitor;
  const auto session = meshed(cad, 0.5, layers, monitor);
  const auto on_hole = [&](Vec3 p) { return std::hypot(p.x(), p.y()) < 1 - gap + 1e-9; };
  const auto on_border = [](Vec3 p) { return std::abs(p.y()) > 1 - 1e-9; };
  // Within 30 degrees of where the gap is narrowest.
  const auto way = [&](Vec3 p) { return ways == Ways::anywhere || std::abs(p.x()) < (1 - gap) / 2; };
  EXPECT_GE(layers_between(
                session->mesh(), 0, [&](Vec3 p) { return on_hole(p) && way(p); }, on_border, way),
            layers);
}

TEST(Layers, AcrossStripsOfDifferentWidths) {
  for (const double width : {0.2, 0.1, 0.03})
    for (const int layers : {1, 2, 3}) expect_layers_across_a_strip(width, layers, Ways::anywhere);
}

// Also at its ends, where a corner is near, but not one that the two long sides share.
TEST(Layers, AcrossTheEndsOfAStrip) {
  for (const double gradation : {1.1, 1.3, 2.})
    for (const int layers : {1, 2, 3, 5, 8}) {
      SCOPED_TRACE(::testing::Message() << "gradation " << gradation << ", layers " << layers);
      AnalyticCad cad;
      cad.faces[1] = {plane, testing::rectangle({0, 0}, {4, 0.05})};
      Monitor monitor;
      const auto session = meshed(cad, 0.5, layers, monitor, gradation);
      const auto low = [](Vec3 p) { return p.y() == 0; };
      const auto high = [](Vec3 p) { return p.y() > 0.05 - 1e-9; };
      EXPECT_GE(layers_between(session->mesh(), 0, low, high), layers);
    }
}

TEST(Layers, BetweenAHoleAndTheBorder) {
  for (const double gap : {0.3, 0.1, 0.05})
    for (const int layers : {1, 2, 3}) expect_layers_around_a_hole(gap, layers, Ways::anywhere);
}

TEST(Layers, FiveOrMore) {
  for (const int layers : {4, 5, 8, 12}) {
    for (const double width : {0.2, 0.1, 0.03}) expect_layers_across_a_strip(width, layers, Ways::in_the_zone);
    for (const double gap : {0.3, 0.1, 0.05}) expect_layers_around_a_hole(gap, layers, Ways::in_the_zone);
  }
}

// The strip is a face between two wide ones.
TEST(Layers, BetweenTwoCommonCurves) {
  for (const double width : {0.2, 0.05})
    for (const int layers : {2, 3}) {
      SCOPED_TRACE(::testing::Message() << "width " << width << ", layers " << layers);
      AnalyticCad cad;
      cad.faces[1] = {plane, testing::rectangle({0, -1}, {1, 0})};
      cad.faces[2] = {plane, testing::rectangle({0, 0}, {1, width})};
      cad.faces[3] = {plane, testing::rectangle({0, width}, {1, 1})};
      Monitor monitor;
      const auto session = meshed(cad, 0.3, layers, monitor);
      const auto inside = [&](Vec3 p) { return p.x() > 2 * width && p.x() < 1 - 2 * width; };
      EXPECT_GE(layers_between(
                    session->mesh(), 1, [&](Vec3 p) { return p.y() == 0 && inside(p); },
                    [&](Vec3 p) { return p.y() > width - 1e-9 && inside(p); }),
                layers);
    }
}

}  // namespace
}  // namespace carreau
