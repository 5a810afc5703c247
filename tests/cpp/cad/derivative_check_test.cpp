// SPDX-License-Identifier: BSD-3-Clause
#include "cad/derivative_check.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "surfaces.h"

namespace carreau {
namespace {

using namespace testing;

const std::array<Vec2, 5> points{Vec2{0.21, 0.17}, {0.83, 0.31}, {0.5, 0.5}, {0.29, 0.77}, {0.71, 0.89}};
const std::array<double, 3> parameters{0.31, 0.92, 1.73};

std::vector<std::string> texts_of(const std::vector<WrongDerivative>& wrong) {
  std::vector<std::string> texts;
  for (const WrongDerivative& each : wrong) texts.push_back(each.text());
  return texts;
}

std::vector<std::string> check(Cad& cad, double scale = 1) {
  std::array<Vec2, 5> uv = points;
  for (Vec2& p : uv) p = scale * p;
  return texts_of(find_wrong_surface_derivatives(cad, 1, uv, {0, 0}, {scale, scale}, true));
}

std::vector<std::string> check_curve(FaceCad& cad) {
  return texts_of(find_wrong_curve_derivatives(cad, 1, 2, parameters, cad.interval, true));
}

TEST(FindWrongDerivatives, FindsNothingInSoundGeometry) {
  FaceCad cad;
  EXPECT_TRUE(check(cad).empty());
  EXPECT_TRUE(check_curve(cad).empty());
  for (const auto& jet : std::initializer_list<std::function<SurfaceJet(Vec2)>>{
           paraboloid_jet, stereographic_jet, monkey_saddle_jet, [](Vec2 p) { return torus_jet(p, 2, 0.7); },
           [](Vec2 p) { return cylinder_jet(p, 1e-3); },
           [](Vec2 p) {
             return SurfaceJet{{1e7 + p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}};
           }}) {
    cad.jet = jet;
    const auto wrong = check(cad);
    EXPECT_TRUE(wrong.empty()) << wrong.front();
  }
}

TEST(FindWrongDerivatives, DoesNotDependOnScale) {
  for (const double model : {1e-6, 1.0, 1e6})
    for (const double scale : {1e-4, 1.0, 1e5}) {
      FaceCad cad;
      double factor = 1;
      cad.jet = [&](Vec2 p) {
        const SurfaceJet j = torus_jet((1 / scale) * p, 2, 0.7);
        const double a = model / scale, b = a / scale;
        return SurfaceJet{model * j.s, (factor * a) * j.su, a * j.sv, b * j.suu, b * j.suv, b * j.svv};
      };
      EXPECT_TRUE(check(cad, scale).empty()) << model << " " << scale;
      factor = 1.1;
      const auto wrong = check(cad, scale);
      ASSERT_EQ(wrong.size(), 1U) << model << " " << scale;
      EXPECT_NE(wrong[0].find("surf1 gives Su"), std::string::npos) << wrong[0];
    }
}

TEST(FindWrongDerivatives, ReportsRoutinePlaceAndBothValues) {
  FaceCad cad;
  cad.jet = [](Vec2 p) {
    SurfaceJet jet = paraboloid_jet(p);
    jet.sv.z() = -jet.sv.z();
    return jet;
  };
  const auto wrong = check(cad);
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_EQ(wrong[0],
            "face 1, u = 0.21, v = 0.17: surf1 gives Sv = (0, 1, -0.17), but finite differences give (0, 1, 0.17)");
}

TEST(FindWrongDerivatives, FindsEachWrongSecondDerivative) {
  const std::array<const char*, 3> names{"Suu", "Suv", "Svv"};
  for (std::size_t k = 0; k < 3; ++k) {
    FaceCad cad;
    cad.jet = [k](Vec2 p) {
      SurfaceJet jet = torus_jet(p, 2, 0.7);
      Vec3& broken = k == 0 ? jet.suu : k == 1 ? jet.suv : jet.svv;
      broken = 2 * broken;
      return jet;
    };
    const auto wrong = check(cad);
    ASSERT_EQ(wrong.size(), 1U);
    EXPECT_NE(wrong[0].find(std::string("surf2 gives ") + names[k] + " = "), std::string::npos) << wrong[0];
    EXPECT_TRUE(find_wrong_surface_derivatives(cad, 1, points, {0, 0}, {1, 1}, false).empty());
  }
}

TEST(FindWrongDerivatives, FindsSwappedAndMissingDerivatives) {
  FaceCad cad;
  cad.jet = [](Vec2 p) {
    SurfaceJet jet = torus_jet(p, 2, 0.7);
    std::swap(jet.su, jet.sv);
    return jet;
  };
  EXPECT_EQ(check(cad).size(), 1U);
  cad.jet = [](Vec2 p) {
    SurfaceJet jet = torus_jet(p, 2, 0.7);
    jet.su = jet.sv = {};
    return jet;
  };
  EXPECT_EQ(check(cad).size(), 1U);
}

TEST(FindWrongDerivatives, FindsWrongDerivativesOfCurves) {
  FaceCad cad;
  const auto right = cad.along;
  cad.along = [&](double t) {
    CurveJet jet = right(t);
    jet.ct.x() = -jet.ct.x();
    return jet;
  };
  auto wrong = check_curve(cad);
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_EQ(wrong[0].substr(0, 44), "face 1, curve 2, t = 0.31: curv1 gives Ct = ") << wrong[0];
  cad.along = [&](double t) {
    CurveJet jet = right(t);
    jet.ctt = 0.5 * jet.ctt;
    return jet;
  };
  wrong = check_curve(cad);
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_NE(wrong[0].find("curv2 gives Ctt = "), std::string::npos) << wrong[0];
}

TEST(FindWrongDerivatives, TakesNoKinkForAnError) {
  // |u - 0.5|: at the kink any of both sides is right; three of the points lie on it.
  FaceCad cad;
  cad.jet = [](Vec2 p) {
    const double side = p.x() < 0.5 ? -1 : 1;
    return SurfaceJet{{p.x(), p.y(), std::abs(p.x() - 0.5)}, {1, 0, side}, {0, 1, 0}, {}, {}, {}};
  };
  const std::array<Vec2, 3> on{Vec2{0.5, 0.2}, {0.5, 0.5}, {0.49995, 0.7}};
  EXPECT_TRUE(find_wrong_surface_derivatives(cad, 1, on, {0, 0}, {1, 1}, true).empty());
}

TEST(FindWrongDerivatives, TakesNoSingularPointForAnError) {
  // A pole, where a host may give the derivatives of a point nearby (RT-0232 sec. 2.1), and a square root.
  constexpr double pi = 3.141592653589793;
  FaceCad cad;
  cad.jet = [](Vec2 p) {
    SurfaceJet jet = sphere_jet({p.x(), std::min(p.y(), pi / 2 - 5e-3)}, 1);
    jet.s = sphere_jet(p, 1).s;
    return jet;
  };
  const std::array<Vec2, 2> near_pole{Vec2{1, pi / 2}, {2, pi / 2 - 1e-3}};
  EXPECT_TRUE(find_wrong_surface_derivatives(cad, 1, near_pole, {0, 0}, {3, pi / 2}, false).empty());

  cad.jet = [](Vec2 p) {  // RT-0232 sec. 2.1 example 2: unstable at the equator
    const double z = std::sqrt(1 - dot(p, p));
    return SurfaceJet{{p.x(), p.y(), z}, {1, 0, -p.x() / z}, {0, 1, -p.y() / z}, {}, {}, {}};
  };
  const std::array<Vec2, 3> near_equator{Vec2{0.6, 0.79999}, {-0.9999, 0}, {0.70710678, 0.70710678}};
  EXPECT_TRUE(find_wrong_surface_derivatives(cad, 1, near_equator, {-1, -1}, {1, 1}, false).empty());
}

TEST(FindWrongDerivatives, RecognisesNoisyAndFailingHosts) {
  FaceCad cad;
  cad.jet = [](Vec2 p) {  // single precision inside
    SurfaceJet jet = torus_jet(p, 2, 0.7);
    jet.s = {static_cast<float>(jet.s.x()), static_cast<float>(jet.s.y()), static_cast<float>(jet.s.z())};
    jet.su = {static_cast<float>(jet.su.x()), static_cast<float>(jet.su.y()), static_cast<float>(jet.su.z())};
    return jet;
  };
  EXPECT_TRUE(check(cad).empty());
  cad.jet = [](Vec2 p) {
    SurfaceJet jet = torus_jet(p, 2, 0.7);
    if (p.x() > 0.5) jet.su = {std::numeric_limits<double>::quiet_NaN(), 0, 0};
    return jet;
  };
  EXPECT_TRUE(check(cad).empty());
  cad.jet = [](Vec2 p) -> SurfaceJet {
    if (p.x() > 0.2) throw CallbackError("beyond the host's domain");
    return torus_jet(p, 2, 0.7);
  };
  EXPECT_TRUE(check(cad).empty());
}

TEST(FindWrongDerivatives, ChecksOnlyDerivativesOfTheHost) {
  FaceCad cad;
  cad.jet = [](Vec2 p) {
    SurfaceJet jet = torus_jet(p, 2, 0.7);
    jet.su = jet.suu = {};
    return jet;
  };
  cad.gives = want_position;
  EXPECT_TRUE(check(cad).empty());
  EXPECT_EQ(cad.calls.surf0, 0);
}

TEST(FindWrongDerivatives, CallsASoundHostFewTimes) {
  FaceCad cad;
  find_wrong_surface_derivatives(cad, 1, points, {0, 0}, {1, 1}, false);
  EXPECT_EQ(cad.calls.surf0, 20);
  EXPECT_EQ(cad.calls.surf1, 5);
  EXPECT_EQ(cad.calls.surf2, 0);
  cad.calls = {};
  check(cad);
  EXPECT_EQ(cad.calls.surface(), 50);
  cad.calls = {};
  check_curve(cad);
  EXPECT_EQ(cad.calls.curv0 + cad.calls.curv1 + cad.calls.curv2, 18);
}

TEST(FindWrongDerivatives, StaysInTheBox) {
  FaceCad cad;
  cad.jet = [](Vec2 p) {
    EXPECT_TRUE(0 <= p.x() && p.x() <= 1 && 0 <= p.y() && p.y() <= 1);
    SurfaceJet jet = torus_jet(p, 2, 0.7);
    jet.su = 3 * jet.su;
    return jet;
  };
  const std::array<Vec2, 4> corners{Vec2{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(find_wrong_surface_derivatives(cad, 1, corners, {0, 0}, {1, 1}, true).size(), 1U);
}

}  // namespace
}  // namespace carreau
