// SPDX-License-Identifier: BSD-3-Clause
// Meshes that would have too many triangles: rejected and bounded sizes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/quality.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using std::numbers::pi;
using testing::AnalyticCad;

/// Squares of one and of `side` side by side in the plane, not joined.
AnalyticCad squares(double side) {
  const auto square = [](Vec2 low, double l) {
    return testing::AnalyticFace{[](Vec2 p) {
                                   return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}};
                                 },
                                 testing::rectangle(low, {low.x() + l, low.y() + l})};
  };
  AnalyticCad cad;
  cad.faces[1] = square({0, 0}, 1);
  cad.faces[2] = square({2, 0}, side);
  cad.faces[3] = square({0, 2}, 1);
  return cad;
}

TEST(Limits, AFaceBeyondThemFailsAlone) {
  for (const int threads : {1, 4}) {
    Monitor monitor;
    const auto session = testing::session_of_size(squares(10), 0.1, monitor);
    session->parameters().set("max_triangles", 1000);
    session->parameters().set("threads", threads);
    session->make_mesh();
    const SurfaceMesh& mesh = session->mesh();
    EXPECT_EQ(find_defects(mesh, {.limit = 5}), std::vector<std::string>{});
    EXPECT_EQ(mesh.faces[0].status, FaceStatus::meshed);
    EXPECT_EQ(mesh.faces[2].status, FaceStatus::meshed);
    EXPECT_EQ(mesh.faces[1].status, FaceStatus::failed);
    EXPECT_TRUE(mesh.faces[1].why.starts_with("face 2: the mesh would have about ")) << mesh.faces[1].why;
    EXPECT_NE(mesh.faces[1].why.find("1000"), std::string::npos) << mesh.faces[1].why;
  }
}

TEST(Limits, FacesThatFitOneByOneButNotTogetherAreRejected) {
  for (const int threads : {1, 4}) {
    Monitor monitor;
    const auto session = testing::session_of_size(squares(1), 0.1, monitor);
    session->parameters().set("max_triangles", 400);
    session->parameters().set("threads", threads);
    EXPECT_THROW(session->make_mesh(), LimitError);
    session->parameters().set("max_triangles", 0);
    session->make_mesh();
    EXPECT_GT(session->mesh().faces[1].triangles.size(), 200U);
  }
}

TEST(Limits, AModelWithoutAnyOtherFaceIsRejected) {
  Monitor monitor;
  AnalyticCad cad = squares(10);
  cad.faces.erase(1), cad.faces.erase(3);
  const auto session = testing::session_of_size(cad, 0.1, monitor);
  session->parameters().set("max_triangles", 1000);
  try {
    session->make_mesh();
    FAIL() << "the limit was passed over";
  } catch (const LimitError& error) {
    EXPECT_EQ(error.where().face, 2);
  }
}

/// The side of a cone cut off at radius `top`, and the disc there: radius 200, height 500, v along the generators.
AnalyticCad cut_cone(double top) {
  const double length = std::hypot(500, 200 - top), slope = (200 - top) / length, rise = 500 / length;
  AnalyticCad cad;
  cad.faces[1] = {[=](Vec2 p) {
                    const double c = std::cos(p.x()), s = std::sin(p.x()), r = 200 - slope * p.y();
                    return SurfaceJet{{r * c, r * s, rise * p.y()},   {-r * s, r * c, 0},
                                      {-slope * c, -slope * s, rise}, {-r * c, -r * s, 0},
                                      {slope * s, -slope * c, 0},     {0, 0, 0}};
                  },
                  testing::rectangle({0, 0}, {2 * pi, length})};
  cad.faces[2] = {[](Vec2 p) {
                    return SurfaceJet{{p.x(), p.y(), 500}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}};
                  },
                  {testing::arc({0, 0}, top, 0, 2 * pi)}};
  return cad;
}

/// Its references: gluing would take the small circle for a point.
Model model_of_cone() {
  Face side, disc;
  side.ref = 1, disc.ref = 2;
  side.curves = {{.ref = 1, .end1 = 1, .end2 = 1},
                 {.ref = 2, .end1 = 1, .end2 = 2},
                 {.ref = 3, .end1 = 2, .end2 = 2},
                 {.ref = 2, .end1 = 2, .end2 = 1}};
  disc.curves = {{.ref = 3, .end1 = 2, .end2 = 2}};
  return {{side, disc}, {}};
}

// If sizes grow by 1.5 from edges of 8e-7, the samples of a square grid in (u, v) see only the first edge: the control
// space promised 860 000 triangles. A ring of growth has 6 to 10, and there are 20 from one e-fold to the next.
TEST(Limits, GrowthFromTinyEdgesIsBoundedByTheControlSpace) {
  for (const double top : {1.6e-5, 1.6e-6, 4.8e-7}) {
    SCOPED_TRACE(top);
    Monitor monitor;
    const auto session = testing::session_of_command(cut_cone(top), 40, monitor);
    session->set_model(model_of_cone());
    session->make_mesh();
    const SurfaceMesh& mesh = session->mesh();
    const FaceMesh& face = mesh.faces[0];
    EXPECT_EQ(find_defects(mesh, {.limit = 5}), std::vector<std::string>{});
    const double without = pi * 200 * std::hypot(500, 200) / (std::sqrt(3.) / 4 * 40 * 40);
    EXPECT_LT(static_cast<double>(face.triangles.size()), without + 10 * 20 * std::log(500 / top));
    EXPECT_NE(face.why.find("sizes cannot grow from edges as short as "), std::string::npos) << face.why;
  }
}

TEST(Limits, GrowthThatCanBeFollowedIsNot) {
  Monitor monitor;
  const auto session = testing::session_of_command(cut_cone(5), 40, monitor);
  session->set_model(model_of_cone());
  session->make_mesh();
  EXPECT_EQ(session->mesh().faces[0].why.find("sizes cannot grow"), std::string::npos) << session->mesh().faces[0].why;
}

}  // namespace
}  // namespace carreau
