// SPDX-License-Identifier: BSD-3-Clause
// Parametrisations whose speed changes by a million within next to nothing: meshes like the meshes of ordinary
// parametrisations.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "common/analytic_cad.h"
#include "mesh/quality.h"
#include "predicates/predicates.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
constexpr double pi = std::numbers::pi;

/// A function that grows by 1, the most of it within `width` of `place`, and its derivatives.
struct Step {
  double place, width, slope = 0.25;
  [[nodiscard]] double scale() const {
    return (1 - slope) / (std::atan((1 - place) / width) + std::atan(place / width));
  }
  [[nodiscard]] double at(double u) const {
    return scale() * (std::atan((u - place) / width) + std::atan(place / width)) + slope * u;
  }
  [[nodiscard]] double first(double u) const {
    const double x = (u - place) / width;
    return scale() / (width * (1 + x * x)) + slope;
  }
  [[nodiscard]] double second(double u) const {
    const double x = (u - place) / width;
    return -2 * scale() * x / (width * width * (1 + x * x) * (1 + x * x));
  }
};

/// S(x(u), y(v)) of a quarter of a cylinder of radius 1 and height 1.
SurfaceJet quarter(const Step& x, const Step& y, Vec2 p) {
  const double a = pi / 2 * x.at(p.x()), a1 = pi / 2 * x.first(p.x()), a2 = pi / 2 * x.second(p.x());
  const Vec3 r{std::cos(a), std::sin(a), 0}, t{-r.y(), r.x(), 0};
  return {{r.x(), r.y(), y.at(p.y())}, a1 * t, {0, 0, y.first(p.y())}, a2 * t + (-a1 * a1) * r, {}, {0, 0, y.second(p.y())}};
}
AnalyticCad quarter_of(const Step& x, const Step& y) {
  AnalyticCad cad;
  cad.faces[1] = {[=](Vec2 p) { return quarter(x, y, p); }, testing::rectangle({0, 0}, {1, 1})};
  return cad;
}
const Step linear{0.5, 1e3, 1};

std::size_t turned_in_domain(const FaceMesh& face) {
  std::size_t turned = 0;
  for (const auto& [a, b, c] : face.triangles) turned += orientation(face.uv[a], face.uv[b], face.uv[c]) > 0 ? 0 : 1;
  return turned;
}

std::unique_ptr<Session> meshed(const AnalyticCad& cad, double size, Monitor& monitor) {
  auto session = testing::session_of_size(cad, size, monitor);
  session->make_mesh();
  return session;
}

void expect_like_an_ordinary_one(const AnalyticCad& cad, double width) {
  constexpr double h = 0.05;
  Monitor monitor;
  const auto session = meshed(cad, h, monitor), ordinary = meshed(quarter_of(linear, linear), h, monitor);
  const QualitySummary q = summarise_quality(session->exported()), p = summarise_quality(ordinary->exported());
  const double triangles = static_cast<double>(session->mesh().triangle_count()),
               usual = static_cast<double>(ordinary->mesh().triangle_count());
  EXPECT_NEAR(q.area, pi / 2, pi / 2 * h * h) << width;  // chords of the circle: h^2 / 24 short
  EXPECT_NEAR(triangles, usual, 0.05 * usual) << width;
  EXPECT_GT(q.q2.mean, p.q2.mean - 0.01) << width;
  EXPECT_GT(q.q2.min, 0.6) << width;
  EXPECT_TRUE(find_defects(session->mesh()).empty()) << width;
  const FaceMesh& face = session->mesh().faces[0];
  EXPECT_EQ(turned_in_domain(face) == 0, face.status == FaceStatus::meshed) << width << " " << face.why;
  for (std::size_t v = 0; v < face.uv.size(); ++v) {
    const Vec3 error = cad.faces.at(1).at(face.uv[v]).s - session->mesh().vertices[face.vertex[v]];
    EXPECT_LT(norm(error), 1e-9) << width;
  }
}

TEST(UnevenParameters, FastWithinAMillionthInside) {
  for (const double width : {1e-4, 1e-6, 1e-9}) expect_like_an_ordinary_one(quarter_of({0.437, width}, linear), width);
}
TEST(UnevenParameters, FastAtABorder) {
  for (const double width : {1e-4, 1e-6, 1e-9}) expect_like_an_ordinary_one(quarter_of(linear, {0, width}), width);
}
TEST(UnevenParameters, FastAlongBoth) {
  for (const double width : {1e-5, 1e-7}) expect_like_an_ordinary_one(quarter_of({0.437, width}, {0.2, width}), width);
}

// Sizes that the host gives by place, and a gradation: as many triangles as in ordinary parameters.
TEST(UnevenParameters, SizesByPlaceAndGradation) {
  const Step fast{0.437, 1e-6};
  const auto triangles = [](const Step& x, double gradation) {
    AnalyticCad cad = quarter_of(x, linear);
    cad.size_on_surface = [x](int, Vec2 p) { return std::optional(0.03 + 0.1 * std::abs(x.at(p.x()) - 0.5)); };
    Monitor monitor;
    auto session = testing::session_of_size(cad, 0.05, monitor);
    session->parameters().set("hphy_flag", 2);
    session->parameters().set("gradation", gradation);
    session->make_mesh();
    EXPECT_TRUE(find_defects(session->mesh()).empty());
    EXPECT_GT(summarise_quality(session->exported()).q2.min, 0.4);
    return static_cast<double>(session->mesh().triangle_count());
  };
  for (const double gradation : {0., 1.3}) {
    const double usual = triangles(linear, gradation);
    EXPECT_NEAR(triangles(fast, gradation), usual, 0.1 * usual) << gradation;
  }
}

// The curve that a plane face has in common with such a one is one, and an imposed point keeps its parameters to the
// last bit.
TEST(UnevenParameters, NeighboursAndImposedPoints) {
  AnalyticCad cad = quarter_of({0.437, 1e-6}, linear);
  cad.faces[2] = {
      [](Vec2 p) {
        return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}};
      },
      {testing::arc({0, 0}, 1, 0, pi / 2), testing::segment({0, 1}, {0, 0}), testing::segment({0, 0}, {1, 0})}};
  Monitor monitor;
  auto session = testing::session_of_size(cad, 0.05, monitor);
  Model model = testing::unglued(cad);
  const Vec2 imposed{0.4370003, 0.61};
  model.faces[0].points.push_back({.ref = 5, .uv = imposed});
  session->set_model(model);
  session->make_mesh();
  EXPECT_TRUE(find_defects(session->mesh(), {.closed = false}).empty());
  const QualitySummary q = summarise_quality(session->exported());
  EXPECT_NEAR(q.area, pi / 2 + pi / 4, 0.01);
  // The open border of the quarter without the common arc, and of the sector without the arc.
  EXPECT_NEAR(static_cast<double>(q.open_edges) * 0.05, 1 + 1 + pi / 2 + 1 + 1, 0.2);
  const std::vector<Vec2>& uv = session->mesh().faces[0].uv;
  EXPECT_NE(std::find(uv.begin(), uv.end(), imposed), uv.end());
}

/// A bicubic rational patch with one weight of `large` and one of 1 / large.
SurfaceJet rational(double large, Vec2 p) {
  const auto basis = [](double t) {
    const double s = 1 - t;
    return std::array<double, 4>{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  };
  const auto slope = [](double t) {
    const double s = 1 - t;
    return std::array<double, 4>{-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
  };
  const auto b = basis(p.x()), c = basis(p.y()), b1 = slope(p.x()), c1 = slope(p.y());
  double w = 0, wu = 0, wv = 0;
  Vec3 s{}, su{}, sv{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const double weight = i == 1 && j == 2 ? large : i == 2 && j == 1 ? 1 / large : 1;
      const double k = weight * b[i] * c[j], ku = weight * b1[i] * c[j], kv = weight * b[i] * c1[j];
      const auto x = static_cast<double>(i + 1), y = static_cast<double>(j + 1);
      const Vec3 control{x, y, static_cast<double>((i + 1) * (j + 1) % 3)};
      w += k, wu += ku, wv += kv;
      s = s + k * control, su = su + ku * control, sv = sv + kv * control;
    }
  s = (1 / w) * s;
  return {s, (1 / w) * (su - wu * s), (1 / w) * (sv - wv * s), {}, {}, {}};
}

// Its triangles cover its area, here a sum over cells that are narrow where the weights meet. No x(u), y(v) makes it
// even: triangles are good in space, and in (u, v) some are turned, which is reported.
TEST(UnevenParameters, ExtremeWeights) {
  constexpr double large = 1e4;
  constexpr std::size_t cells = 300;
  const auto graded = [](std::size_t k) {
    return k == 0 ? 0. : k == cells ? 1. : 0.5 * (1 + std::tanh(36. * static_cast<double>(k) / cells - 18));
  };
  std::vector<Vec3> grid;
  for (std::size_t i = 0; i <= cells; ++i)
    for (std::size_t j = 0; j <= cells; ++j) grid.push_back(rational(large, {graded(i), graded(j)}).s);
  double area = 0;
  for (std::size_t i = 0; i < cells; ++i)
    for (std::size_t j = 0; j < cells; ++j) {
      const Vec3 a = grid[i * (cells + 1) + j], c = grid[(i + 1) * (cells + 1) + j + 1];
      for (const Vec3& b : {grid[(i + 1) * (cells + 1) + j], grid[i * (cells + 1) + j + 1]})
        area += 0.5 * norm(cross(b - a, c - a));
    }
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) { return rational(large, p); }, testing::rectangle({0, 0}, {1, 1})};
  Monitor monitor;
  const auto session = meshed(cad, 0.1, monitor);
  const QualitySummary q = summarise_quality(session->exported());
  EXPECT_NEAR(q.area, area, 0.01 * area);
  EXPECT_GT(q.q2.mean, 0.95);
  EXPECT_GT(q.q2.min, 0.3);
  EXPECT_NEAR(static_cast<double>(q.triangles), area / (std::sqrt(3) / 4 * 0.01), 0.25 * q.triangles);
  const FaceMesh& face = session->mesh().faces[0];
  EXPECT_EQ(turned_in_domain(face) == 0, face.status == FaceStatus::meshed);
  EXPECT_NE(face.why.find(std::to_string(turned_in_domain(face)) + " triangles are turned over in (u, v)"),
            std::string::npos)
      << face.why;
}

// A change that is fast along neither parameter's lines cannot be followed: the error comes at once, with the place.
TEST(UnevenParameters, FastAlongASlantedLine) {
  AnalyticCad cad;
  const Step step{0.437, 1e-7};
  cad.faces[1] = {[=](Vec2 p) {
                    const double u = p.x() + 0.2 * (p.y() - 0.5), x = step.first(u);
                    return SurfaceJet{{step.at(u), p.y(), 0}, {x, 0, 0}, {0.2 * x, 1, 0}, {}, {}, {}};
                  },
                  testing::rectangle({0, 0}, {1, 1})};
  Monitor monitor;
  try {
    meshed(cad, 0.05, monitor);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("times as fast as elsewhere"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("face 1, u = "), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace carreau
