// SPDX-License-Identifier: BSD-3-Clause
// Borders that stay, and borders that sharp_angle removes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

#include "independent/patchworks.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using namespace testing;

/// A prism along y, 4 long, over the polyline of (x, z); its ends and its base are open. Strips have references 1, 2...
AnalyticCad folded_sheet(const std::vector<Vec2>& profile) {
  AnalyticCad cad;
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    const Vec2 p = profile[k], d = profile[k + 1] - profile[k];
    const auto plane = [p, d](Vec2 q) {
      return SurfaceJet{
          {p.x() + q.x() * d.x(), q.y(), p.y() + q.x() * d.y()}, {d.x(), 0, d.y()}, {0, 1, 0}, {}, {}, {}};
    };
    cad.faces[static_cast<int>(k) + 1] = {plane, rectangle({0, 0}, {1, 4})};
  }
  return cad;
}

/// Two planes and a chamfer of width .1 that turns by 30 degrees from each.
AnalyticCad chamfered() {
  const double w = 0.1, c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
  const Vec2 a{0, 0}, b{2, 0}, on{2 + w * c, -w * s};
  const Vec2 end = on + 2 * Vec2{std::cos(std::numbers::pi / 3), -std::sin(std::numbers::pi / 3)};
  return folded_sheet({a, b, on, end});
}

std::unique_ptr<Session> freed(const AnalyticCad& cad, double size, double sharp_angle, Monitor& monitor) {
  auto session = session_of_size(cad, size, monitor);
  session->parameters().set("patches", "independent");
  session->parameters().set("sharp_angle", sharp_angle);
  session->make_mesh();
  EXPECT_TRUE(find_defects(session->mesh()).empty());
  return session;
}

TEST(SharpEdges, ChamfersStayUntilTheAngleIsRaised) {
  Monitor quiet;
  const AnalyticCad cad = chamfered();
  const auto kept = freed(cad, 0.5, 1, quiet), gone = freed(cad, 0.5, 45, quiet);
  EXPECT_FALSE(kept->mesh().faces[1].triangles.empty());
  double area = 0;
  const FaceMesh& chamfer = kept->mesh().faces[1];
  for (const auto& t : chamfer.triangles) {
    const auto corner = [&](int i) -> const Vec3& { return kept->mesh().vertices[chamfer.vertex[t[i]]]; };
    area += norm(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
  }
  EXPECT_NEAR(area, 0.4, 1e-12);
  EXPECT_EQ(gone->mesh().faces[1].triangles.size(), 0U);
  EXPECT_EQ(gone->mesh().faces[1].status, FaceStatus::collapsed);
  EXPECT_NE(gone->mesh().faces[1].why.find("face 2"), std::string::npos);
  // The report of the delivered mesh lists it.
  const std::string file = ::testing::TempDir() + "carreau_chamfer.json";
  gone->write_delivered(file);
  std::ifstream in(file);
  const std::string json(std::istreambuf_iterator<char>(in), {});
  std::filesystem::remove(file);
  EXPECT_NE(json.find(R"("reference": 2,)"), std::string::npos) << json;
  EXPECT_NE(json.find(R"("status": "collapsed")"), std::string::npos) << json;
}

/// A square of side 4 with `count` by `count` square holes of the given side.
AnalyticCad perforated(int count, double side) {
  const auto plane = [](Vec2 p) { return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; };
  AnalyticCad cad;
  cad.faces[1] = {plane, rectangle({0, 0}, {4, 4})};
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const Vec2 a{(4. * i + 2) / count, (4. * j + 2) / count}, c = a + Vec2(side, side);
      const Vec2 b{c.x(), a.y()}, d{a.x(), c.y()};
      for (const AnalyticCurve& s : {segment(a, d), segment(d, c), segment(c, b), segment(b, a)})
        cad.faces[1].curves.push_back(s);
    }
  return cad;
}

// Sides of holes are shorter than the size, so that lengths beside them cannot be as prescribed: shapes do not become
// worse for it.
TEST(SharpEdges, ShapesBesideSmallHolesAreNoWorse) {
  Monitor quiet;
  for (const auto& [count, side] : {std::pair{3, 0.2}, {4, 0.2}, {5, 0.1}}) {
    const AnalyticCad cad = perforated(count, side);
    const auto patches = session_of_size(cad, 0.5, quiet);
    patches->make_mesh();
    const auto mesh = freed(cad, 0.5, 1, quiet);
    const QualitySummary before = summarise_quality(patches->exported()), after = summarise_quality(mesh->exported());
    EXPECT_GE(after.q2.mean, before.q2.mean);
    EXPECT_GE(after.q2.min, before.q2.min);
  }
}

TEST(SharpEdges, CornersAndLinesOfASquareAreKept) {
  Monitor quiet;
  const auto session = freed(folded_sheet({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}}), 1, 1, quiet);
  // Only the four corners and sides of the sheet, without the borders inside.
  double length = 0;
  int corners = 0;
  for (const CurveMesh& curve : session->mesh().curves)
    for (std::size_t i = 1; i < curve.vertices.size(); ++i) {
      const Vec3 p = session->mesh().vertices[curve.vertices[i - 1]], q = session->mesh().vertices[curve.vertices[i]];
      length += norm(q - p);
      const bool on_rim =
          (p.x() == q.x() && (p.x() == 0 || p.x() == 4)) || (p.y() == q.y() && (p.y() == 0 || p.y() == 4));
      EXPECT_TRUE(on_rim);
    }
  for (const Vec3& p : session->mesh().vertices)
    corners += (p.x() == 0 || p.x() == 4) && (p.y() == 0 || p.y() == 4) ? 1 : 0;
  EXPECT_NEAR(length, 16, 1e-12);
  EXPECT_EQ(corners, 4);
}

}  // namespace
}  // namespace carreau
