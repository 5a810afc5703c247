// SPDX-License-Identifier: BSD-3-Clause
// Faces narrower than the size: matched sides and one layer of triangles, or none and one curve in place of two.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <set>
#include <string>

#include "common/analytic_cad.h"
#include "mesh/quality.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
using testing::AnalyticCurve;
using testing::AnalyticFace;
constexpr double pi = std::numbers::pi;

/// A plane face: corners in space, counterclockwise seen from outside.
AnalyticFace plane_face(const std::vector<Vec3>& corners) {
  Vec3 normal{};
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal = normal + cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  const Vec3 n = (1 / norm(normal)) * normal, o = corners[0];
  std::size_t far = 1;  // the first side may be tiny
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (norm(corners[i] - o) > norm(corners[far] - o)) far = i;
  const Vec3 x = (1 / norm(corners[far] - o)) * (corners[far] - o), y = cross(n, x);
  AnalyticFace face{[=](Vec2 p) { return SurfaceJet{o + p.x() * x + p.y() * y, x, y, {}, {}, {}}; }, {}};
  const auto uv = [=](Vec3 p) { return Vec2{dot(p - o, x), dot(p - o, y)}; };
  for (std::size_t i = 0; i < corners.size(); ++i)
    face.curves.push_back(testing::segment(uv(corners[i]), uv(corners[(i + 1) % corners.size()])));
  return face;
}

AnalyticCad polyhedron(const std::vector<Vec3>& points, const std::vector<std::vector<int>>& faces) {
  AnalyticCad cad;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    std::vector<Vec3> corners;
    for (const int i : faces[f]) corners.push_back(points[static_cast<std::size_t>(i)]);
    cad.faces[static_cast<int>(f) + 1] = plane_face(corners);
  }
  return cad;
}

/// A polygon of the (x, z) plane, counterclockwise seen from y = -1, between y = 0 and y = 1: faces 1 .. n are its
/// sides.
AnalyticCad prism(const std::vector<Vec2>& polygon) {
  const int n = static_cast<int>(polygon.size());
  std::vector<Vec3> points;
  for (const double y : {0.0, 1.0})
    for (const Vec2& p : polygon) points.push_back({p.x(), y, p.y()});
  std::vector<std::vector<int>> faces;
  for (int i = 0; i < n; ++i) faces.push_back({i, n + i, n + (i + 1) % n, (i + 1) % n});
  std::vector<int> front, back;
  for (int i = 0; i < n; ++i) front.push_back(i), back.push_back(n + n - 1 - i);
  faces.push_back(front);
  faces.push_back(back);
  return polyhedron(points, faces);
}

double area_of(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return twice / 2;
}

AnalyticFace disc(double radius, double z, double from, bool up) {
  const double sign = up ? 1 : -1;
  return {[=](Vec2 p) {
            return SurfaceJet{{p.x(), sign * p.y(), z}, {1, 0, 0}, {0, sign, 0}, {}, {}, {}};
          },
          {testing::arc({0, 0}, radius, sign * from, sign * from + 2 * pi)}};
}
AnalyticFace cylinder(double radius, double low, double high, double from) {
  return {[=](Vec2 p) {
            const double c = radius * std::cos(p.x()), s = radius * std::sin(p.x());
            return SurfaceJet{{c, s, p.y()}, {-s, c, 0}, {0, 0, 1}, {-c, -s, 0}, {}, {}};
          },
          testing::rectangle({from, low}, {from + 2 * pi, high})};
}
/// Two cylinders on one axis, one on the other; face 3 is the ring where they meet. Seams lie at two angles.
AnalyticCad stepped(double step, double angle) {
  AnalyticCad cad;
  cad.faces[1] = disc(1 + step, -1, 0, false);
  cad.faces[2] = cylinder(1 + step, -1, 0, 0);
  cad.faces[3] = disc(1 + step, 0, 0, true);
  cad.faces[3].curves.push_back(testing::arc({0, 0}, 1, angle + 2 * pi, angle));
  cad.faces[4] = cylinder(1, 0, 1, angle);
  cad.faces[5] = disc(1, 1, angle, true);
  return cad;
}

FaceCurve curve(int ref, int end1, int end2) { return {.ref = ref, .end1 = end1, .end2 = end2}; }
Face face(int ref, std::vector<FaceCurve> curves) {
  return Face{.ref = ref, .curves = std::move(curves), .points = {}};
}

/// Gluing by polylines cannot distinguish circles as near as that.
Model stepped_model() {
  Model model;
  model.faces = {face(1, {curve(1, 1, 1)}), face(2, {curve(1, 1, 1), curve(2, 1, 2), curve(3, 2, 2), curve(2, 2, 1)}),
                 face(3, {curve(3, 2, 2), curve(4, 3, 3)}),
                 face(4, {curve(4, 3, 3), curve(5, 3, 4), curve(6, 4, 4), curve(5, 4, 3)}), face(5, {curve(6, 4, 4)})};
  return model;
}

struct Meshed {
  Monitor monitor;
  Session session{monitor};

  Meshed(const AnalyticCad& cad, double size, const char* mode, double ratio = 0.1)
      : Meshed(testing::unglued(cad), cad, size, mode, ratio) {}
  Meshed(const Model& model, const AnalyticCad& cad, double size, const char* mode, double ratio = 0.1,
         double eps_glue = 1e-8) {
    session.set_cad(std::make_shared<AnalyticCad>(cad));
    session.set_model(model);
    session.parameters().set("hphydef", size);
    session.parameters().set("hphymin", size / 10);
    session.parameters().set("hphymax", size * 10);
    session.parameters().set("eps_glue", eps_glue);
    session.parameters().set("eps_ends", 0.0);
    session.parameters().set("narrow_faces", mode);
    session.parameters().set("narrow_ratio", ratio);
    session.make_mesh();
  }
  [[nodiscard]] const SurfaceMesh& mesh() const { return session.mesh(); }
  [[nodiscard]] const FaceMesh& face(int ref) const { return mesh().faces[static_cast<std::size_t>(ref) - 1]; }
  [[nodiscard]] QualitySummary quality() const { return summarise_quality(session.exported()); }
  [[nodiscard]] double volume() const {
    double sum = 0;
    const FlatMesh flat = session.exported();
    for (const auto& t : flat.triangles)
      sum += dot(flat.vertices[t[0]], cross(flat.vertices[t[1]], flat.vertices[t[2]])) / 6;
    return sum;
  }
  void expect_closed(long euler) const {
    EXPECT_EQ(find_defects(mesh(), {.closed = true, .limit = 5}), std::vector<std::string>{});
    const QualitySummary q = quality();
    EXPECT_EQ(static_cast<long>(mesh().vertices.size()) - static_cast<long>(q.edges) + static_cast<long>(q.triangles),
              euler);
    for (const FaceMesh& f : mesh().faces) EXPECT_NE(f.status, FaceStatus::failed) << f.why;
  }
  void expect_collapsed(int ref) const {
    EXPECT_EQ(face(ref).status, FaceStatus::collapsed) << ref << ": " << face(ref).why;
    EXPECT_TRUE(face(ref).triangles.empty());
    EXPECT_NE(face(ref).why.find("narrow"), std::string::npos);
  }
  /// Only vertices of its curves, and a triangle for each of their edges except at the tips.
  void expect_one_layer(int ref) const {
    const FaceMesh& f = face(ref);
    EXPECT_EQ(f.status, FaceStatus::mended) << f.why;
    EXPECT_NE(f.why.find("one layer"), std::string::npos) << f.why;
    std::set<std::int32_t> on_curves;
    for (const CurveMesh& curve : mesh().curves)
      for (const CurveMeshUse& use : curve.uses)
        if (mesh().faces[use.face].ref == ref) on_curves.insert(curve.vertices.begin(), curve.vertices.end());
    EXPECT_EQ(std::set<std::int32_t>(f.vertex.begin(), f.vertex.end()), on_curves);
  }
};

/// 12 sizes from diag / 5 to diag / `finest`.
std::vector<double> sizes(double diag, double finest = 60) {
  std::vector<double> all;
  for (int i = 0; i < 12; ++i) all.push_back(diag / 5 * std::pow(5 / finest, i / 11.0));
  return all;
}

// ---- the box with a chamfer of 1e-4 of its diagonal ----

const double box_diag = std::sqrt(3.0);
const double chamfer = 1e-4 * box_diag / std::numbers::sqrt2;
const std::vector<Vec2> chamfered{{0, 0}, {1, 0}, {1, 1 - chamfer}, {1 - chamfer, 1}, {0, 1}};

TEST(Narrow, ChamferOfABoxCollapses) {
  for (const double size : sizes(box_diag, 300)) {
    SCOPED_TRACE(size);
    const Meshed run(prism(chamfered), size, "collapse");
    run.expect_closed(2);
    run.expect_collapsed(3);
    // The two sides are plane but for one row of vertices that moved by the width of the chamfer.
    const double width = chamfer * std::numbers::sqrt2;
    EXPECT_NEAR(run.volume(), area_of(chamfered), 2 * width);
    EXPECT_NEAR(run.quality().area, 6, 8 * width);
    EXPECT_GT(run.quality().q2.min, 0.5);
  }
}

TEST(Narrow, ChamferOfABoxHasOneLayer) {
  for (const double size : sizes(box_diag)) {
    SCOPED_TRACE(size);
    const Meshed run(prism(chamfered), size, "one_layer");
    run.expect_closed(2);
    run.expect_one_layer(3);
    EXPECT_NEAR(run.volume(), area_of(chamfered), 1e-12);
    // Right triangles of sides h and w: Q2 = sqrt(3) h w / (h^2 + w^2).
    const double width = chamfer * std::numbers::sqrt2;
    double worst = 1, longest = 0;
    for (const auto& t : run.face(3).triangles) {
      Vec3 p[3];
      for (int i = 0; i < 3; ++i) p[i] = run.mesh().vertices[run.face(3).vertex[t[i]]];
      worst = std::min(worst, quality_q2(p[0], p[1], p[2]));
      for (int i = 0; i < 3; ++i) longest = std::max(longest, norm(p[(i + 1) % 3] - p[i]));
    }
    EXPECT_GT(worst, 0.99 * std::numbers::sqrt3 * width / longest);
    EXPECT_LT(longest, 1.5 * size);
  }
}

TEST(Narrow, IsKeptByDefault) {
  const Meshed run(prism(chamfered), 0.1, "keep");
  run.expect_closed(2);
  EXPECT_EQ(run.face(3).status, FaceStatus::meshed);
  EXPECT_NEAR(run.volume(), area_of(chamfered), 1e-12);
}

TEST(Narrow, RatioDefinesNarrowFaces) {
  const std::vector<Vec2> wide{{0, 0}, {1, 0}, {1, 0.95}, {0.95, 1}, {0, 1}};  // 0.07 wide
  const Meshed narrower(prism(wide), 0.2, "collapse", 0.3);
  EXPECT_EQ(narrower.face(3).status, FaceStatus::meshed);
  const Meshed wider(prism(wide), 0.2, "collapse", 0.4);
  wider.expect_closed(2);
  wider.expect_collapsed(3);
}

// ---- several slivers side by side: an edge rounded by eight chamfers ----

std::vector<Vec2> rounded(int n, double radius) {
  std::vector<Vec2> polygon{{0, 0}, {1, 0}};
  for (int i = 0; i <= n; ++i)
    polygon.push_back({1 - radius + radius * std::cos(pi / 2 * i / n), 1 - radius + radius * std::sin(pi / 2 * i / n)});
  polygon.push_back({0, 1});
  return polygon;
}

TEST(Narrow, ChainOfSliversCollapsesToOneCurve) {
  const std::vector<Vec2> polygon = rounded(8, 5e-4);
  for (const double size : sizes(box_diag)) {
    SCOPED_TRACE(size);
    const Meshed run(prism(polygon), size, "collapse");
    run.expect_closed(2);
    for (int ref = 3; ref < 11; ++ref) run.expect_collapsed(ref);
    EXPECT_NEAR(run.volume(), area_of(polygon), 2e-3);
    EXPECT_GT(run.quality().q2.min, 0.45);
  }
}

TEST(Narrow, ChainOfSliversHasOneLayerEach) {
  const std::vector<Vec2> polygon = rounded(8, 5e-4);
  for (const double size : sizes(box_diag)) {
    SCOPED_TRACE(size);
    const Meshed run(prism(polygon), size, "one_layer");
    run.expect_closed(2);
    for (int ref = 3; ref < 11; ++ref) run.expect_one_layer(ref);
    EXPECT_NEAR(run.volume(), area_of(polygon), 1e-12);
  }
}

// ---- a wedge: a sliver triangle ----

AnalyticCad wedge(double width) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0},         {0, 1, 0},        {0, 0, 1},
                                 {1, 0, 1}, {0, 1, 1}, {1 - width, 1, 1}, {1, 1, 1 - width}};
  return polyhedron(points,
                    {{3, 2, 1, 0}, {0, 1, 5, 4}, {0, 4, 6, 3}, {4, 5, 7, 6}, {1, 2, 8, 5}, {2, 3, 6, 7, 8}, {5, 8, 7}});
}

TEST(Narrow, WedgeCollapses) {
  for (const double size : sizes(box_diag)) {
    SCOPED_TRACE(size);
    const Meshed run(wedge(2e-4), size, "collapse");
    run.expect_closed(2);
    run.expect_collapsed(7);
    EXPECT_NEAR(run.volume(), 1, 1e-3);
    EXPECT_GT(run.quality().q2.min, 0.45);
  }
}

TEST(Narrow, WedgeHasOneLayer) {
  for (const double size : sizes(box_diag)) {
    SCOPED_TRACE(size);
    const Meshed run(wedge(2e-4), size, "one_layer");
    run.expect_closed(2);
    run.expect_one_layer(7);
    EXPECT_NEAR(run.volume(), 1 - 2e-4 * 2e-4 / 6, 1e-12);
  }
}

// ---- a ring between two cylinders ----

TEST(Narrow, RingBetweenCylindersCollapses) {
  const double diag = std::sqrt(12.0), step = 1e-4 * diag;
  for (const double angle : {0.0, 0.9, 3.0})
    for (const double size : sizes(diag)) {
      SCOPED_TRACE(::testing::Message() << "size " << size << ", seam at " << angle);
      const Meshed run(stepped_model(), stepped(step, angle), size, "collapse");
      run.expect_closed(2);
      run.expect_collapsed(3);
      const double chords = 0.5 * pi * (pi / 3) * size * size + 20 * step;  // of polygons in circles, both halves
      EXPECT_NEAR(run.volume(), 2 * pi, 2 * chords);
      EXPECT_GT(run.quality().q2.min, 0.3);
    }
}

TEST(Narrow, RingBetweenCylindersHasOneLayer) {
  const double diag = std::sqrt(12.0), step = 1e-4 * diag;
  for (const double angle : {0.0, 0.9, 3.0})
    for (const double size : sizes(diag)) {
      SCOPED_TRACE(::testing::Message() << "size " << size << ", seam at " << angle);
      const Meshed run(stepped_model(), stepped(step, angle), size, "one_layer");
      run.expect_closed(2);
      run.expect_one_layer(3);
      // The number of edges follows from the circle at this size, not from the width of the ring.
      EXPECT_LT(static_cast<double>(run.face(3).triangles.size()), 2 * (2 * pi / size + 8));
    }
}

/// The same curve, slower or faster at its start by a share of its mean pace.
AnalyticCurve paced(const AnalyticCurve& curve, double share) {
  return {{0, 1}, [=](double t) {
            const double w = 2 * pi, at = t + share * std::sin(w * t) / w, speed = 1 + share * std::cos(w * t);
            const CurveJet j = curve.at(at);
            return CurveJet{j.c, speed * j.ct, speed * speed * j.ctt - share * w * std::sin(w * t) * j.ct};
          }};
}

// Places on supports of uneven samples, and the lengths of their chords, differ by more than these rings are wide:
// vertices carried to and fro between the circles would be new ones each time.
TEST(Narrow, RingNarrowerThanItsSupportsAreAccurateHasTheEdgesOfOneCircle) {
  for (const double step : {1e-5, 1e-6, 1e-8})
    for (const char* mode : {"collapse", "one_layer"})
      for (const double size : {0.3, 0.05}) {
        SCOPED_TRACE(::testing::Message() << "step " << step << ", size " << size << ", " << mode);
        const bool collapses = std::string(mode) == "collapse";
        if (!collapses && step < 1e-6) continue;  // the chords of the circles cross
        AnalyticCad cad = stepped(step, 0);
        for (AnalyticCurve& circle : cad.faces[3].curves) circle = paced(circle, 0.6);
        const Meshed run(stepped_model(), cad, size, mode);
        run.expect_closed(2);
        if (collapses) run.expect_collapsed(3);
        for (const CurveMesh& curve : run.mesh().curves)
          EXPECT_LT(static_cast<double>(curve.vertices.size()), 2 * pi / size + 4);
      }
}

// ---- a face whose edges are all tiny ----

TEST(Narrow, TinyFaceCollapsesToAPoint) {
  // A corner of the box cut off.
  const double w = 2e-4;
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0},     {0, 1, 0},     {0, 0, 1},
                                 {1, 0, 1}, {0, 1, 1}, {1 - w, 1, 1}, {1, 1 - w, 1}, {1, 1, 1 - w}};
  const std::vector<std::vector<int>> faces{{3, 2, 1, 0},    {0, 1, 5, 4},    {0, 4, 6, 3}, {4, 5, 8, 7, 6},
                                            {1, 2, 9, 8, 5}, {2, 3, 6, 7, 9}, {7, 8, 9}};
  for (const double size : sizes(box_diag)) {
    SCOPED_TRACE(size);
    const Meshed run(polyhedron(points, faces), size, "collapse");
    run.expect_closed(2);
    run.expect_collapsed(7);
    EXPECT_NEAR(run.volume(), 1, 1e-3);
    EXPECT_GT(run.quality().q2.min, 0.45);
  }
}

// Not everything may vanish: the faces of a body smaller than the size stay.
TEST(Narrow, BodyDoesNotVanish) {
  const Meshed run(prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), 30, "collapse");
  run.expect_closed(2);
  EXPECT_GT(run.volume(), 0.3);
}

// A part is not collapsed either: a wire with a square section does not become a prism of three sides, even at an end.
TEST(Narrow, WireKeepsItsSection) {
  for (const double width : {1e-2, 1e-4}) {
    SCOPED_TRACE(width);
    const Meshed run(prism({{0, 0}, {width, 0}, {width, width}, {0, width}}), 0.3, "collapse");
    run.expect_closed(2);
    for (const FaceMesh& f : run.mesh().faces) EXPECT_NE(f.status, FaceStatus::collapsed) << f.why;
    EXPECT_NEAR(run.volume(), width * width, 1e-9 * width * width);
  }
}

// A plate thinner than the size keeps its rim, and all of its volume.
TEST(Narrow, ThinPlateKeepsItsRim) {
  for (const double size : {0.5, 0.1, 0.05}) {
    SCOPED_TRACE(size);
    const Meshed run(prism({{0, 0}, {1, 0}, {1, 1e-3}, {0, 1e-3}}), size, "collapse");
    run.expect_closed(2);
    EXPECT_NEAR(run.volume(), 1e-3, 1e-12);
  }
}

// ---- below the tolerance of a file ----

// A sliver whose two sides were glued to each other: nothing is between them, whatever the options.
TEST(Folded, FaceWithoutWidthIsNoFailure) {
  constexpr double width = 1e-9;
  AnalyticCad cad;
  cad.faces[1] = plane_face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  cad.faces[2] = plane_face({{0, 2, 0}, {1, 2, 0}, {1, 2 + width, 0}, {0, 2 + width, 0}});
  Model model;
  model.faces = {face(1, {curve(1, 1, 2), curve(2, 2, 3), curve(3, 3, 4), curve(4, 4, 1)}),
                 face(2, {curve(5, 5, 6), curve(6, 6, 6), curve(5, 6, 5), curve(7, 5, 5)})};
  const Meshed run(model, cad, 0.1, "keep");
  EXPECT_EQ(find_defects(run.mesh(), {.closed = false, .limit = 5}), std::vector<std::string>{});
  EXPECT_EQ(run.face(1).status, FaceStatus::meshed) << run.face(1).why;
  EXPECT_EQ(run.face(2).status, FaceStatus::collapsed) << run.face(2).why;
  EXPECT_NE(run.face(2).why.find("no width"), std::string::npos) << run.face(2).why;
  EXPECT_TRUE(run.face(2).triangles.empty());
}

// The same curve there and back bounds a whole cylinder, too, between its ends.
TEST(Folded, SeamsAreNot) {
  const AnalyticCad cad = stepped(0.1, 0.3);
  const Meshed run(stepped_model(), cad, 0.1, "keep");
  run.expect_closed(2);
  for (const FaceMesh& face : run.mesh().faces) EXPECT_NE(face.status, FaceStatus::collapsed) << face.ref;
}

// A side runs past its corner by less than points may be apart, and gluing makes the rest of it a separate curve: the
// next side starts at the corner.
TEST(Spikes, AreLeftOut) {
  for (const double spike : {1e-4, 4e-4, 1e-3})
    for (const double size : {0.3, 0.1, 0.02}) {
      SCOPED_TRACE(spike);
      SCOPED_TRACE(size);
      AnalyticCad cad;
      cad.faces[1] = {[](Vec2 p) {
                        return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}};
                      },
                      testing::rectangle({0, 0}, {1, 1})};
      std::vector<AnalyticCurve>& curves = cad.faces[1].curves;
      curves.push_back(curves.back());
      curves[3] = testing::segment({0, 1}, {-spike, 1});
      Model model;
      model.faces = {face(1, {curve(1, 1, 2), curve(2, 2, 3), curve(3, 3, 4), curve(4, 4, 4), curve(5, 4, 1)})};
      const Meshed run(model, cad, size, "keep", 0.1, 2 * spike);
      EXPECT_EQ(find_defects(run.mesh(), {.closed = false, .limit = 5}), std::vector<std::string>{});
      EXPECT_NE(run.face(1).status, FaceStatus::failed) << run.face(1).why;
      EXPECT_NEAR(run.quality().area, 1, 1e-12);
    }
}

}  // namespace
}  // namespace carreau
