// SPDX-License-Identifier: BSD-3-Clause
// Meshes that follow their geometry through the C interface: carried to changed geometries, refined.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "abi_fixture.h"
#include "carreau_geometry.h"

namespace abi_tests {
namespace {
namespace follow {

constexpr double pi = std::numbers::pi;
using Point = std::array<double, 3>;
using Place = std::array<double, 2>;

/// A geometry of functions.
struct Shape {
  std::function<Point(int, double, double)> surface;
  std::function<Place(int, int, double)> curve;  // t from 0 to 1
  std::function<void(carreau_session*)> model;
};

std::int32_t surface_of(std::int32_t face, double u, double v, std::int32_t, double* S, double*, double*, double*, double*, double*, void* user) {
  const Point p = static_cast<const Shape*>(user)->surface(face, u, v);
  std::copy(p.begin(), p.end(), S);
  return 0;
}
std::int32_t interval_of(std::int32_t, std::int32_t, double* a, double* b, void*) {
  *a = 0, *b = 1;
  return 0;
}
std::int32_t curve_of(std::int32_t face, std::int32_t ic, double t, std::int32_t, double* C, double*, double*, void* user) {
  const Place p = static_cast<const Shape*>(user)->curve(face, ic, t);
  C[0] = p[0], C[1] = p[1];
  return 0;
}

/// A session of a shape.
class ShapeRun {
 public:
  explicit ShapeRun(Shape shape, double size = 0.2, const char* element = "p1") : shape_(std::move(shape)) {
    EXPECT_EQ(carreau_session_create(&session), CARREAU_OK);
    auto cad = sized<carreau_cad>();
    cad.user = &shape_, cad.surface = surface_of, cad.curve_interval = interval_of, cad.curve = curve_of, cad.reentrant = 1;
    EXPECT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
    shape_.model(session);
    EXPECT_EQ(carreau_set_real(session, "hphydef", size), CARREAU_OK);
    EXPECT_EQ(carreau_set_text(session, "element", element), CARREAU_OK);
  }
  ShapeRun(const ShapeRun&) = delete;
  ShapeRun& operator=(const ShapeRun&) = delete;
  ~ShapeRun() { carreau_session_free(session); }

  carreau_mesh* mesh() const {
    carreau_mesh* handle = nullptr;
    EXPECT_EQ(carreau_session_mesh(session, &handle), CARREAU_OK) << error();
    return handle;
  }
  void generate() const { ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error(); }
  [[nodiscard]] MeshData data() const { return data_of(mesh()); }
  [[nodiscard]] std::string error() const { return carreau_last_error(session); }
  [[nodiscard]] std::int64_t cells(std::int32_t kind) const {
    std::int64_t n = 0;
    EXPECT_EQ(carreau_mesh_cell_count(mesh(), kind, &n), CARREAU_OK);
    return n;
  }
  [[nodiscard]] carreau_quality quality() const {
    auto q = sized<carreau_quality>();
    EXPECT_EQ(carreau_mesh_quality(mesh(), &q), CARREAU_OK);
    return q;
  }

  carreau_session* session = nullptr;

 private:
  Shape shape_;
};

Place on_box(int ic, double t, double u0, double v0, double u1, double v1) {
  switch (ic) {
    case 1: return {u0 + t * (u1 - u0), v0};
    case 2: return {u1, v0 + t * (v1 - v0)};
    case 3: return {u1 + t * (u0 - u1), v1};
    default: return {u0, v1 + t * (v0 - v1)};
  }
}

void add_face(carreau_session* session, int face, const std::vector<std::array<int, 3>>& curves) {
  EXPECT_EQ(carreau_model_add_face(session, face, 1), CARREAU_OK);
  for (const auto& [ref, end1, end2] : curves) EXPECT_EQ(carreau_model_add_curve(session, face, CARREAU_BOUNDARY, ref, end1, end2), CARREAU_OK);
}

/// u is the angle times the radius if `by_length`: the domain changes then.
Shape cylinder(double radius, double height = 1, bool by_length = false) {
  const double around = by_length ? 2 * pi * radius : 2 * pi;
  return {[=](int, double u, double v) -> Point {
            const double angle = by_length ? u / radius : u;
            return {radius * std::cos(angle), radius * std::sin(angle), v};
          },
          [=](int, int ic, double t) { return on_box(ic, t, 0, 0, around, height); },
          [](carreau_session* s) { add_face(s, 1, {{1, 1, 1}, {2, 1, 2}, {3, 2, 2}, {2, 2, 1}}); }};
}

Shape sphere(double a, double b, double c) {
  return {[=](int, double u, double v) -> Point { return {a * std::cos(u) * std::cos(v), b * std::sin(u) * std::cos(v), c * std::sin(v)}; },
          [](int, int ic, double t) { return on_box(ic, t, 0, -pi / 2, 2 * pi, pi / 2); },
          [](carreau_session* s) { add_face(s, 1, {{1, 1, 1}, {2, 1, 2}, {3, 2, 2}, {2, 2, 1}}); }};
}

/// A square of side 2 with a hole in the plane.
Shape plate(double radius, double x = 0) {
  return {[](int, double u, double v) -> Point { return {u, v, 0}; },
          [=](int, int ic, double t) {
            return ic < 5 ? on_box(ic, t, -1, -1, 1, 1) : Place{x + radius * std::cos(2 * pi * t), -radius * std::sin(2 * pi * t)};
          },
          [](carreau_session* s) { add_face(s, 1, {{1, 1, 2}, {2, 2, 3}, {3, 3, 4}, {4, 4, 1}, {5, 5, 5}}); }};
}

/// Two rectangles with a common side, bent along it; `renumbered`: other references and another order of faces.
Shape roof(double width, double rise, bool renumbered) {
  const int left = renumbered ? 2 : 1;
  return {[=](int face, double u, double v) -> Point {
            return face == left ? Point{-width * (1 - u), 3 * v, rise * u} : Point{width * u, 3 * v, rise * (1 - u) + 0.1 * u * (1 - u)};
          },
          [](int, int ic, double t) { return on_box(ic, t, 0, 0, 1, 1); },
          [=](carreau_session* s) {
            const std::vector<std::array<int, 3>> of_left{{1, 1, 2}, {2, 2, 3}, {3, 3, 4}, {4, 4, 1}}, of_right{{5, 2, 5}, {6, 5, 6}, {7, 6, 3}, {2, 3, 2}};
            const std::vector<std::array<int, 3>> other_right{{1, 11, 12}, {2, 12, 13}, {3, 13, 14}, {4, 14, 11}}, other_left{{7, 15, 11}, {4, 11, 14}, {6, 14, 16}, {5, 16, 15}};
            if (renumbered)
              add_face(s, 1, other_right), add_face(s, 2, other_left);
            else
              add_face(s, 1, of_left), add_face(s, 2, of_right);
          }};
}

void expect_sound(const ShapeRun& run, bool closed = false) { EXPECT_TRUE(defects_of(run.mesh(), closed).empty()) << defects_of(run.mesh(), closed); }

TEST(Carry, SameGeometryGivesTheSameMesh) {
  for (const char* element : {"p1", "q1.0", "p2"}) {
    const ShapeRun a(cylinder(1), 0.2, element), b(cylinder(1), 0.2, element);
    a.generate();
    ASSERT_EQ(carreau_mesh_carry(b.session, a.mesh(), CARREAU_MATCH_REFERENCE), CARREAU_OK) << b.error();
    const MeshData p = a.data(), q = b.data();
    EXPECT_EQ(p.triangles, q.triangles);
    EXPECT_EQ(p.vertex_refs, q.vertex_refs);
    ASSERT_EQ(p.xyz.size(), q.xyz.size());
    for (std::size_t i = 0; i < p.xyz.size(); ++i) EXPECT_NEAR(p.xyz[i], q.xyz[i], 1e-12);
    expect_sound(b);
  }
}

// x = r (cos u, sin u), so that dx/dr is the unit vector of each vertex, whatever the parametrisation.
TEST(Carry, DerivativesByTheRadiusOfACylinder) {
  for (const auto& [by_length, element] : {std::pair(false, "p1"), {true, "p1"}, {false, "p2"}, {true, "p2"}, {true, "q2.0"}}) {
    const ShapeRun a(cylinder(1, 1, by_length), 0.2, element), up(cylinder(1 + 1e-4, 1, by_length), 0.2, element),
        down(cylinder(1 - 1e-4, 1, by_length), 0.2, element);
    a.generate();
    for (const ShapeRun* run : {&up, &down}) ASSERT_EQ(carreau_mesh_carry(run->session, a.mesh(), CARREAU_MATCH_ANY), CARREAU_OK) << run->error();
    const MeshData at = a.data(), p = up.data(), q = down.data();
    EXPECT_EQ(at.triangles, p.triangles);
    for (std::size_t v = 0; v < at.vertex_count(); ++v)
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR((p.xyz[3 * v + k] - q.xyz[3 * v + k]) / 2e-4, k < 2 ? at.xyz[3 * v + k] : 0, 1e-8);
    expect_sound(up);
  }
}

// On the hole dx/dr is the outward unit vector, on the sides 0; means of neighbours stay between them. Second order in the step.
TEST(Carry, DerivativesByTheRadiusOfAHole) {
  const ShapeRun a(plate(0.4));
  a.generate();
  const MeshData at = a.data();
  std::vector<double> last;
  double differences[2] = {0, 0};
  for (int step = 0; step < 3; ++step) {
    const double d = 0.02 / (1 << step);
    const ShapeRun up(plate(0.4 + d)), down(plate(0.4 - d));
    for (const ShapeRun* run : {&up, &down}) {
      ASSERT_EQ(carreau_mesh_carry(run->session, a.mesh(), CARREAU_MATCH_ANY), CARREAU_OK) << run->error();
      expect_sound(*run);
    }
    const MeshData p = up.data(), q = down.data();
    std::vector<double> derivative;
    for (std::size_t i = 0; i < at.xyz.size(); ++i) derivative.push_back((p.xyz[i] - q.xyz[i]) / (2 * d));
    for (std::size_t v = 0; v < at.vertex_count(); ++v) {
      const double x = at.xyz[3 * v], y = at.xyz[3 * v + 1], r = std::hypot(x, y), dx = derivative[3 * v], dy = derivative[3 * v + 1];
      EXPECT_LT(std::hypot(dx, dy), 1 + 1e-9);
      if (std::abs(r - 0.4) < 1e-9) {
        EXPECT_NEAR(dx, x / r, 1e-5);
        EXPECT_NEAR(dy, y / r, 1e-5);
      } else if (std::max(std::abs(x), std::abs(y)) > 1 - 1e-12) {
        EXPECT_NEAR(std::hypot(dx, dy), 0, 1e-9);
      }
    }
    for (std::size_t i = 0; i < last.size(); ++i) differences[step - 1] = std::max(differences[step - 1], std::abs(derivative[i] - last[i]));
    last = derivative;
  }
  EXPECT_LT(differences[1], 0.3 * differences[0] + 1e-9);
}

TEST(Carry, LargeChangesStayValidOrAreReported) {
  const ShapeRun a(plate(0.3), 0.1);
  a.generate();
  const ShapeRun b(plate(0.6), 0.1);
  ASSERT_EQ(carreau_mesh_carry(b.session, a.mesh(), CARREAU_MATCH_ANY), CARREAU_OK) << b.error();
  expect_sound(b);
  const MeshData carried = b.data();
  const auto edges = double(std::count(carried.edge_refs.begin(), carried.edge_refs.end(), 5));
  EXPECT_NEAR(b.quality().area, 4 - edges / 2 * 0.36 * std::sin(2 * pi / edges), 1e-6);  // a regular polygon is cut out
  // The hole leaves the plate: the face fails with its triangle.
  const ShapeRun c(plate(0.3, 0.9), 0.1);
  const carreau_status status = carreau_mesh_carry(c.session, a.mesh(), CARREAU_MATCH_ANY);
  EXPECT_EQ(status, CARREAU_ERR_DOMAIN);
  EXPECT_NE(c.error().find("turned"), std::string::npos) << c.error();
}

// The hole moves towards a side, before which triangles are pressed flat: their vertices move. Without that the worst triangle has .02.
TEST(Carry, ShapesThatFallMuchAreSmoothed) {
  for (const char* element : {"p1", "q1.0", "p2"}) {
    const ShapeRun a(plate(0.3), 0.1, element), b(plate(0.3, 0.45), 0.1, element);
    a.generate();
    std::string text;
    const auto log = [](std::int32_t level, const char* message, void* user) {
      if (level <= CARREAU_LEVEL_SUMMARY) *static_cast<std::string*>(user) += message;
    };
    ASSERT_EQ(carreau_set_message_callback(b.session, log, &text), CARREAU_OK);
    ASSERT_EQ(carreau_mesh_carry(b.session, a.mesh(), CARREAU_MATCH_ANY), CARREAU_OK) << b.error();
    expect_sound(b);
    EXPECT_NE(text.find("1 smoothed"), std::string::npos) << text;
    EXPECT_EQ(text.find("lowered") == std::string::npos, element[0] == 'p') << text;
    EXPECT_GT(b.quality().q2_min, 0.25);
  }
}

TEST(Carry, LowerShapesAreReported) {
  for (const double height : {1.2, 8.0}) {
    const ShapeRun a(cylinder(1), 0.2), b(cylinder(1, height), 0.2);
    a.generate();
    std::string text;
    const auto log = [](std::int32_t level, const char* message, void* user) {
      if (level == CARREAU_LEVEL_WARNING) *static_cast<std::string*>(user) += message;
    };
    ASSERT_EQ(carreau_set_message_callback(b.session, log, &text), CARREAU_OK);
    ASSERT_EQ(carreau_mesh_carry(b.session, a.mesh(), CARREAU_MATCH_ANY), CARREAU_OK) << b.error();
    EXPECT_EQ(text.find("face 1: the carrying has lowered the worst shape (Q2)") != std::string::npos, height > 2) << text;
    EXPECT_EQ(b.quality().q2_min < 0.5 * a.quality().q2_min, height > 2);
  }
}

TEST(Carry, PolesAndSeamsOfASphereFollow) {
  for (const char* element : {"p1", "p2", "q1.0"}) {
    const ShapeRun a(sphere(1, 1, 1), 0.3, element), b(sphere(2, 1.5, 1), 0.3, element);
    a.generate();
    ASSERT_EQ(carreau_mesh_carry(b.session, a.mesh(), CARREAU_MATCH_ANY), CARREAU_OK) << b.error();
    expect_sound(b, true);
    const MeshData p = a.data(), q = b.data();
    EXPECT_EQ(p.triangles, q.triangles);
    const std::size_t n = element[1] == '2' ? 0 : p.vertex_count();
    for (std::size_t v = 0; v < n; ++v) {
      const Point on{q.xyz[3 * v] / 2, q.xyz[3 * v + 1] / 1.5, q.xyz[3 * v + 2]};
      EXPECT_NEAR(on[0] * on[0] + on[1] * on[1] + on[2] * on[2], 1, 1e-12);
    }
  }
}

// The edge of a flattened triangle is one with a curve in space, but not in (u, v).
TEST(Carry, CornersThatArePolesKeepTheirSides) {
  const auto corner = [](double radius) {
    return Shape{[=](int, double u, double v) -> Point { return {radius * std::cos(u) * std::cos(v), radius * std::sin(u) * std::cos(v), radius * std::sin(v)}; },
                 [](int, int ic, double t) { return on_box(ic, t, 0, -pi / 2, 1.168, 0); },
                 [](carreau_session* s) { add_face(s, 1, {{1, 1, 1}, {2, 1, 2}, {3, 2, 3}, {4, 3, 1}}); }};
  };
  for (const double size : {0.8, 0.3}) {
    const ShapeRun a(corner(1), size), b(corner(2), size);
    a.generate();
    ASSERT_EQ(carreau_mesh_carry(b.session, a.mesh(), CARREAU_MATCH_ANY), CARREAU_OK) << b.error();
    const MeshData p = a.data(), q = b.data();
    EXPECT_EQ(p.triangles, q.triangles);
    for (std::size_t i = 0; i < p.xyz.size(); ++i) EXPECT_NEAR(2 * p.xyz[i], q.xyz[i], 1e-9);
    ASSERT_EQ(carreau_mesh_halve(b.session, 2), CARREAU_OK) << b.error();
    expect_sound(b);
  }
}

TEST(Carry, RenumberedFacesAreFound) {
  const ShapeRun a(roof(1, 0.5, false), 0.25), b(roof(1.2, 0.6, true), 0.25);
  a.generate();
  EXPECT_EQ(carreau_mesh_carry(b.session, a.mesh(), CARREAU_MATCH_REFERENCE), CARREAU_ERR_MODEL);
  EXPECT_NE(b.error().find("curve"), std::string::npos) << b.error();
  EXPECT_EQ(carreau_mesh_carry(b.session, a.mesh(), CARREAU_MATCH_NAME), CARREAU_ERR_MODEL);
  for (const int match : {CARREAU_MATCH_ANY, CARREAU_MATCH_SHAPE}) {
    ASSERT_EQ(carreau_mesh_carry(b.session, a.mesh(), match), CARREAU_OK) << b.error();
    expect_sound(b);
    const MeshData p = a.data(), q = b.data();
    ASSERT_EQ(p.vertex_count(), q.vertex_count());
    for (std::size_t v = 0; v < p.vertex_count(); ++v) {  // each vertex on the sheet of its image
      EXPECT_NEAR(q.xyz[3 * v], 1.2 * p.xyz[3 * v], 0.02);
      EXPECT_NEAR(q.xyz[3 * v + 1], p.xyz[3 * v + 1], 0.02);
    }
  }
}

TEST(Carry, NamesErrors) {
  const ShapeRun a(cylinder(1)), b(plate(0.3)), c(cylinder(1));
  EXPECT_EQ(carreau_mesh_carry(a.session, nullptr, CARREAU_MATCH_ANY), CARREAU_ERR_ARGUMENT);
  a.generate();
  EXPECT_EQ(carreau_mesh_carry(b.session, a.mesh(), CARREAU_MATCH_ANY), CARREAU_ERR_MODEL);
  EXPECT_NE(b.error().find("topologies differ"), std::string::npos) << b.error();
  EXPECT_EQ(carreau_mesh_carry(a.session, a.mesh(), CARREAU_MATCH_ANY), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_carry(c.session, a.mesh(), 9), CARREAU_ERR_ARGUMENT);
  carreau_mesh* file = nullptr;
  ASSERT_EQ(carreau_mesh_create(&file), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_carry(c.session, file, CARREAU_MATCH_ANY), CARREAU_ERR_ARGUMENT);
  carreau_mesh_free(file);
}

// ---- Refinement ----

TEST(Refine, HalvedElementsAreFourAndLieOnTheSurface) {
  for (const char* element : {"p1", "p2", "q1.0", "q2.0"}) {
    const ShapeRun run(sphere(1, 1, 1), 0.4, element);
    run.generate();
    const MeshData before = run.data();
    std::map<int, std::int64_t> count;
    for (int kind = 1; kind <= 4; ++kind) count[kind] = run.cells(kind);
    const double error_before = 4 * pi - run.quality().area;
    ASSERT_EQ(carreau_mesh_halve(run.session, 1), CARREAU_OK) << run.error();
    expect_sound(run, true);
    for (int kind = 1; kind <= 4; ++kind) EXPECT_EQ(run.cells(kind), 4 * count[kind]) << element << kind;
    const MeshData after = run.data();
    for (std::size_t v = 0; v < after.vertex_count(); ++v) EXPECT_NEAR(std::hypot(after.xyz[3 * v], after.xyz[3 * v + 1], after.xyz[3 * v + 2]), 1, 1e-12);
    if (element[1] == '1') {
      for (std::size_t i = 0; i < before.xyz.size(); ++i) EXPECT_EQ(before.xyz[i], after.xyz[i]);
      EXPECT_NEAR(4 * pi - run.quality().area, error_before / 4, 0.02 * error_before);
    }
    EXPECT_EQ(after.sizes.size(), after.vertex_count());
  }
}

TEST(Refine, CurvesAreHalvedByLength) {
  const ShapeRun run(cylinder(2));
  run.generate();
  const auto n = static_cast<std::int64_t>(run.data().edge_count());
  ASSERT_EQ(carreau_mesh_halve(run.session, 2), CARREAU_OK) << run.error();
  const MeshData data = run.data();
  EXPECT_EQ(data.edge_count(), 4 * n);
  std::map<int, std::pair<double, double>> spread;
  for (std::size_t e = 0; e < data.edge_count(); ++e) {
    double length = 0;
    for (std::size_t k = 0; k < 3; ++k) length += std::pow(data.xyz[3 * data.edges[2 * e + 1] + k] - data.xyz[3 * data.edges[2 * e] + k], 2);
    auto& [low, high] = spread.try_emplace(data.edge_refs[e], 1e9, 0).first->second;
    low = std::min(low, length), high = std::max(high, length);
  }
  for (const auto& [ref, range] : spread) EXPECT_NEAR(range.first, range.second, 1e-5 * range.second) << ref;
  std::vector<double> t(2 * data.edge_count());
  ASSERT_EQ(carreau_mesh_edge_parameters(run.mesh(), std::int64_t(data.edge_count()), t.data(), nullptr, nullptr), CARREAU_OK);
  for (const double at : t) EXPECT_TRUE(at >= 0 && at <= 1);
}

TEST(Refine, MarkedElementsKeepTheMeshConformingAndItsQuality) {
  const ShapeRun run(sphere(1, 1, 1), 0.3);
  run.generate();
  const double before = run.quality().q2_min;
  for (int level = 0; level < 5; ++level) {
    const MeshData data = run.data();
    std::vector<std::int32_t> marks;
    for (std::size_t t = 0; t < data.triangle_count(); ++t)
      if (data.xyz[3 * data.triangles[3 * t]] > 0.9 && data.xyz[3 * data.triangles[3 * t] + 1] > 0) marks.push_back(std::int32_t(t));
    ASSERT_EQ(carreau_mesh_refine(run.session, CARREAU_MARK_ELEMENTS, std::int64_t(marks.size()), marks.data()), CARREAU_OK) << run.error();
    expect_sound(run, true);
    EXPECT_GT(run.quality().q2_min, std::min(0.25, 0.5 * before)) << level;
  }
}

TEST(Refine, MarkedEdgesAreGone) {
  for (const char* element : {"p1", "q1.0", "p2"}) {
    const ShapeRun run(plate(0.4), 0.25, element);
    run.generate();
    const MeshData before = run.data();
    const std::int32_t marks[4] = {before.triangles[0], before.triangles[1], before.triangles[4], before.triangles[5]};
    const int marked = element[0] == 'q' ? 1 : 2;
    ASSERT_EQ(carreau_mesh_refine(run.session, CARREAU_MARK_EDGES, marked, marks), CARREAU_OK) << run.error();
    expect_sound(run);
    const MeshData after = run.data();
    for (std::size_t t = 0; t < after.triangle_count(); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        for (int k = 0; k < marked; ++k) {
          const std::set<std::int32_t> edge{after.triangles[3 * t + i], after.triangles[3 * t + (i + 1) % 3]};
          EXPECT_NE(edge, (std::set<std::int32_t>{marks[2 * k], marks[2 * k + 1]}));
        }
    EXPECT_GT(after.vertex_count(), before.vertex_count());
  }
}

TEST(Refine, SizesAreReached) {
  const ShapeRun run(plate(0.4), 0.3);
  run.generate();
  const MeshData before = run.data();
  std::vector<double> sizes;
  for (std::size_t v = 0; v < before.vertex_count(); ++v) sizes.push_back(before.xyz[3 * v] > 0 ? 0.05 : 0.3);
  ASSERT_EQ(carreau_mesh_refine_sizes(run.session, std::int64_t(sizes.size()), sizes.data()), CARREAU_OK) << run.error();
  expect_sound(run);
  const MeshData data = run.data();
  for (std::size_t t = 0; t < data.triangle_count(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = std::size_t(data.triangles[3 * t + i]), b = std::size_t(data.triangles[3 * t + (i + 1) % 3]);
      if (data.xyz[3 * a] < 0.3 || data.xyz[3 * b] < 0.3) continue;
      EXPECT_LT(std::hypot(data.xyz[3 * a] - data.xyz[3 * b], data.xyz[3 * a + 1] - data.xyz[3 * b + 1]), 0.0708);
    }
}

// The true curve lies outside of the chords of a coarse mesh: triangles beside it lose height.
TEST(Refine, HalvingKeepsShapesBesideCurves) {
  for (const auto& [radius, size, element] : {std::tuple(0.1, 0.9, "p1"), std::tuple(0.3, 0.9, "p1"), std::tuple(0.6, 0.9, "p1"), std::tuple(0.93, 0.5, "p1"), std::tuple(0.3, 0.9, "p2")}) {
    const ShapeRun run(plate(radius), size, element);
    run.generate();
    const double before = run.quality().q2_min;
    const std::int64_t n = run.cells(CARREAU_CELL_TRIANGLE3) + run.cells(CARREAU_CELL_TRIANGLE6);
    for (int level = 1, count = 4; level <= 4; ++level, count *= 4) {
      ASSERT_EQ(carreau_mesh_halve(run.session, 1), CARREAU_OK) << run.error();
      expect_sound(run);
      EXPECT_EQ(run.cells(CARREAU_CELL_TRIANGLE3) + run.cells(CARREAU_CELL_TRIANGLE6), count * n);
      EXPECT_GE(run.quality().q2_min, std::min(before, 0.6) - 1e-9) << radius << " " << element << " level " << level;
    }
  }
}

// Quadrilaterals beside holes whose coarse edges turn by up to a right angle: each level is convex, in space and in (u, v).
TEST(Refine, HalvedQuadrilateralsStayConvex) {
  for (const auto& [radius, size, element] :
       {std::tuple(0.1, 0.9, "q1.0"), std::tuple(0.3, 0.9, "q1.0"), std::tuple(0.6, 0.9, "q1.1"), std::tuple(0.93, 0.5, "q1.0"), std::tuple(0.6, 0.6, "q2.0")}) {
    const ShapeRun run(plate(radius), size, element);
    run.generate();
    const double before = run.quality().q2_mean;
    for (int level = 1; level <= 3; ++level) {
      ASSERT_EQ(carreau_mesh_halve(run.session, 1), CARREAU_OK) << run.error();
      expect_sound(run);
      EXPECT_GE(run.quality().q2_mean, before - 0.03) << radius << " " << element << " level " << level;
    }
  }
}

// At a pole an element has any place of the side that the pole flattens: it stays between the sides of the element.
TEST(Refine, HalvedQuadrilateralsAtPolesStayConvex) {
  for (const double size : {0.9, 0.5, 0.3}) {
    for (const char* element : {"q1.0", "q1.1", "p1"}) {
      const ShapeRun run(sphere(1, 1, 1), size, element);
      run.generate();
      for (int level = 1; level <= 2; ++level) {
        ASSERT_EQ(carreau_mesh_halve(run.session, 1), CARREAU_OK) << run.error();
        expect_sound(run, true);
      }
    }
  }
}

TEST(Refine, NamesErrorsAndKeepsTheMesh) {
  const ShapeRun run(plate(0.4));
  EXPECT_EQ(carreau_mesh_halve(run.session, 1), CARREAU_ERR_SEQUENCE);
  run.generate();
  const MeshData before = run.data();
  const std::int32_t far[2] = {0, 1 << 20};
  const double wrong[1] = {-1};
  EXPECT_EQ(carreau_mesh_refine(run.session, CARREAU_MARK_EDGES, 1, far), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(run.error().find("1048576"), std::string::npos);
  EXPECT_EQ(carreau_mesh_refine(run.session, CARREAU_MARK_ELEMENTS, 2, far), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_refine(run.session, 7, 0, far), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_refine_sizes(run.session, 1, wrong), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_halve(run.session, -1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(before, run.data());
}

// ---- Elements of order 3 and 4 ----

Shape torus(double R, double r) {
  return {[=](int, double u, double v) -> Point { return {(R + r * std::cos(v)) * std::cos(u), (R + r * std::cos(v)) * std::sin(u), r * std::sin(v)}; },
          [](int, int ic, double t) { return on_box(ic, t, 0, 0, 2 * pi, 2 * pi); },
          [](carreau_session* s) { add_face(s, 1, {{1, 1, 1}, {2, 1, 1}, {1, 1, 1}, {2, 1, 1}}); }};
}

struct Raised {
  int order = 0;
  std::vector<double> xyz;
  std::vector<std::int32_t> triangles, quads, edges;
  std::int64_t invalid = 0;
};

Raised raised(const ShapeRun& run, int order, int places = CARREAU_EQUIDISTANT) {
  Raised out;
  out.order = order;
  EXPECT_EQ(carreau_raise_order(run.session, order, places, &out.invalid), CARREAU_OK) << run.error();
  std::int64_t n = 0, t = 0, q = 0, e = 0;
  EXPECT_EQ(carreau_raised_count(run.session, &n, &t, &q, &e), CARREAU_OK);
  out.xyz.resize(3 * n), out.triangles.resize(t * (order + 1) * (order + 2) / 2), out.quads.resize(q * (order + 1) * (order + 1)), out.edges.resize(e * (order + 1));
  EXPECT_EQ(carreau_raised_nodes(run.session, n, out.xyz.data()), CARREAU_OK);
  std::vector<std::int32_t> refs(std::size_t(std::max({t, q, e})));
  if (t > 0) {
    EXPECT_EQ(carreau_raised_elements(run.session, 3, t, out.triangles.data(), refs.data()), CARREAU_OK);
    EXPECT_EQ(refs[0], 1);
  }
  if (q > 0) {
    EXPECT_EQ(carreau_raised_elements(run.session, 4, q, out.quads.data(), nullptr), CARREAU_OK);
  }
  EXPECT_EQ(carreau_raised_elements(run.session, 2, e, out.edges.data(), refs.data()), CARREAU_OK);
  return out;
}

// Lagrange's polynomial of node i of n + 1 equidistant ones, without the factors behind i.
double factor(int i, double x) {
  double value = 1;
  for (int m = 0; m < i; ++m) value *= (x - m) / (i - m);
  return value;
}

// (i, k) of a triangle's node in Gmsh's order, by its barycentric coordinates.
std::vector<std::array<int, 2>> triangle_nodes(int p, int first = 0) {
  if (p < 0) return {};
  if (p == 0) return {{first, first}};
  std::vector<std::array<int, 2>> all{{first, first}, {first + p, first}, {first, first + p}};
  for (int i = 1; i < p; ++i) all.push_back({first + i, first});
  for (int i = 1; i < p; ++i) all.push_back({first + p - i, first + i});
  for (int i = 1; i < p; ++i) all.push_back({first, first + p - i});
  for (const auto& inner : triangle_nodes(p - 3, first + 1)) all.push_back(inner);
  return all;
}

/// Largest error of `distance` at points of all triangles.
template <typename Distance>
double error_of_triangles(const Raised& mesh, const Distance& distance) {
  const int p = mesh.order;
  const auto nodes = triangle_nodes(p);
  double worst = 0;
  for (std::size_t row = 0; row < mesh.triangles.size(); row += nodes.size())
    for (int a = 0; a <= 9; ++a)
      for (int b = 0; a + b <= 9; ++b) {
        const double s = a / 9.0, t = b / 9.0;
        Point x{0, 0, 0};
        for (std::size_t n = 0; n < nodes.size(); ++n) {
          const auto [i, k] = nodes[n];
          const double w = factor(i, p * s) * factor(k, p * t) * factor(p - i - k, p * (1 - s - t));
          for (std::size_t c = 0; c < 3; ++c) x[c] += w * mesh.xyz[3 * std::size_t(mesh.triangles[row + n]) + c];
        }
        worst = std::max(worst, std::abs(distance(x)));
      }
  return worst;
}

TEST(HighOrder, InterpolationOfSphereAndTorusHasOrderPPlus1) {
  const auto to_sphere = [](const Point& x) { return std::hypot(x[0], x[1], x[2]) - 1; };
  const auto to_torus = [](const Point& x) { return std::hypot(std::hypot(x[0], x[1]) - 3, x[2]) - 1; };
  for (const int order : {2, 3, 4}) {
    double sphere_error[2], torus_error[2];
    for (const int level : {0, 1}) {
      const ShapeRun a(sphere(1, 1, 1), 0.5, "p2"), b(torus(3, 1), 0.8, "p2");
      for (const ShapeRun* run : {&a, &b}) {
        run->generate();
        ASSERT_EQ(carreau_mesh_halve(run->session, level), CARREAU_OK) << run->error();
      }
      const Raised on_sphere = raised(a, order), on_torus = raised(b, order);
      EXPECT_EQ(on_sphere.invalid + on_torus.invalid, 0);
      for (std::size_t v = 0; v < on_sphere.xyz.size(); v += 3) EXPECT_NEAR(to_sphere({on_sphere.xyz[v], on_sphere.xyz[v + 1], on_sphere.xyz[v + 2]}), 0, 1e-10);
      sphere_error[level] = error_of_triangles(on_sphere, to_sphere), torus_error[level] = error_of_triangles(on_torus, to_torus);
    }
    RecordProperty("sphere" + std::to_string(order), std::to_string(std::log2(sphere_error[0] / sphere_error[1])));
    EXPECT_GT(std::log2(sphere_error[0] / sphere_error[1]), order + 1 - 0.35) << order << " " << sphere_error[0] << " " << sphere_error[1];
    EXPECT_GT(std::log2(torus_error[0] / torus_error[1]), order + 1 - 0.35) << order << " " << torus_error[0] << " " << torus_error[1];
  }
}

TEST(HighOrder, NodesOfEdgesAreShared) {
  for (const char* element : {"p2", "q2.0"})
    for (const int order : {3, 4}) {
      const ShapeRun run(cylinder(1), 0.4, element);
      run.generate();
      for (const int places : {CARREAU_EQUIDISTANT, CARREAU_GAUSS_LOBATTO}) {
        const Raised mesh = raised(run, order, places);
        EXPECT_EQ(mesh.invalid, 0);
        for (std::size_t v = 0; v < mesh.xyz.size(); v += 3) EXPECT_NEAR(std::hypot(mesh.xyz[v], mesh.xyz[v + 1]), 1, 1e-10);
        // Each node is one of an element: V - E + F = 0 of a cylinder without its caps counts them.
        std::set<std::int32_t> used(mesh.triangles.begin(), mesh.triangles.end());
        used.insert(mesh.quads.begin(), mesh.quads.end());
        EXPECT_EQ(used.size(), mesh.xyz.size() / 3);
        const double s = places == CARREAU_EQUIDISTANT ? 1.0 / order : order == 3 ? (1 - std::sqrt(0.2)) / 2 : (1 - std::sqrt(3.0 / 7)) / 2;
        for (std::size_t row = 0; row < mesh.edges.size(); row += std::size_t(order) + 1) {  // by arc length
          const auto at = [&](std::size_t i) { return &mesh.xyz[3 * std::size_t(mesh.edges[row + i])]; };
          const auto arc = [](const double* p, const double* q) {
            return std::hypot(2 * std::asin(std::min(1.0, std::hypot(p[0] - q[0], p[1] - q[1]) / 2)), p[2] - q[2]);
          };
          EXPECT_NEAR(arc(at(0), at(2)), s * arc(at(0), at(1)), 1e-6);
        }
      }
    }
}

// x(s) of nodes (0, .12, .43, 1) rises everywhere, but the parabola through x(1/2) = .2469 falls at first: only all nodes decide. With x(1/3) = .05 it
// falls, too.
TEST(HighOrder, DefectsAreJudgedByAllNodes) {
  for (const auto& [third, invalid] : {std::pair(0.12, 0), {0.05, 1}}) {
    const double x[]{0, third, 0.43, 1};
    const int order[16][2]{{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 0}, {2, 0}, {3, 1}, {3, 2}, {2, 3}, {1, 3}, {0, 2}, {0, 1}, {1, 1}, {2, 1}, {2, 2}, {1, 2}};
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n16\n", row = "1 36 2 1 1";
    for (int k = 0; k < 16; ++k) {
      text += std::to_string(k + 1) + " " + std::to_string(x[order[k][0]]) + " " + std::to_string(order[k][1] / 3.0) + " 0\n";
      row += " " + std::to_string(k + 1);
    }
    const std::string path = ::testing::TempDir() + "cubic.msh";
    std::ofstream(path) << text << "$EndNodes\n$Elements\n1\n" << row << "\n$EndElements\n";
    carreau_mesh* mesh = nullptr;
    ASSERT_EQ(carreau_mesh_create(&mesh), CARREAU_OK);
    ASSERT_EQ(carreau_mesh_read(mesh, path.c_str()), CARREAU_OK);
    std::int64_t count = -1;
    const char* sentences = nullptr;
    ASSERT_EQ(carreau_mesh_defects(mesh, 0, 9, &count, &sentences), CARREAU_OK);
    EXPECT_EQ(count, invalid) << sentences;
    EXPECT_STREQ(sentences, invalid > 0 ? "element 0 of order 3: its Jacobian is not positive everywhere" : "");
    carreau_mesh_free(mesh);
  }
}

TEST(HighOrder, NamesErrors) {
  const ShapeRun run(cylinder(1), 0.5);
  EXPECT_EQ(carreau_raise_order(run.session, 3, 0, nullptr), CARREAU_ERR_SEQUENCE);
  run.generate();
  EXPECT_EQ(carreau_raised_count(run.session, nullptr, nullptr, nullptr, nullptr), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(carreau_raise_order(run.session, 5, 0, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_raise_order(run.session, 3, 2, nullptr), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_raise_order(run.session, 3, 1, nullptr), CARREAU_OK) << run.error();
  double xyz[3];
  EXPECT_EQ(carreau_raised_nodes(run.session, 1, xyz), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_raised_elements(run.session, 5, 1, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_raised_write(run.session, "x.stl"), CARREAU_ERR_ARGUMENT);
  run.generate();
  EXPECT_EQ(carreau_raised_write(run.session, "x.msh"), CARREAU_ERR_SEQUENCE);
}

}  // namespace follow
}  // namespace
}  // namespace abi_tests
