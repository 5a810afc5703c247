// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/control_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "control_space_fields.h"
#include "metric/metric2_algebra.h"
#include "predicates/polygon_locator.h"

namespace carreau {
namespace {

using fields::Field;

// Counts calls, and calls outside the domain.
struct Asked {
  std::size_t points = 0, outside = 0, largest_batch = 0;
};

ControlSpace build(const Field& field, const ControlSpaceOptions& options = {}, Asked* asked = nullptr) {
  const PolygonLocator locator(field.domain.vertices, field.domain.edges);
  Asked own;
  Asked& a = asked != nullptr ? *asked : own;
  Monitor monitor;
  const MetricSampler sampler = [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
    a.points += uv.size();
    a.largest_batch = std::max(a.largest_batch, uv.size());
    for (std::size_t i = 0; i < uv.size(); ++i) {
      if (!locator.contains(uv[i])) ++a.outside;
      metric[i] = field.metric(uv[i]);
    }
  };
  const ControlSpace space = ControlSpace::build(field.domain, sampler, options, monitor);
  EXPECT_EQ(space.samples(), a.points);
  EXPECT_EQ(a.outside, 0u) << field.name;
  return space;
}

class Points {
 public:
  explicit Points(const SampledDomain& domain) : locator_(domain.vertices, domain.edges) {
    low_ = high_ = domain.vertices[0];
    for (const Vec2& p : domain.vertices) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    }
  }
  Vec2 inside() {
    for (;;) {
      const Vec2 p = in_box();
      if (locator_.contains(p)) return p;
    }
  }
  Vec2 in_box() { return {low_.x() + unit_(engine_) * (high_.x() - low_.x()), low_.y() + unit_(engine_) * (high_.y() - low_.y())}; }
  [[nodiscard]] Vec2 extent() const { return high_ - low_; }
  Vec2 direction() {
    const double a = 2 * fields::pi * unit_(engine_);
    return {std::cos(a), std::sin(a)};
  }
  // The vector of metric length at most 1 in a direction that is random for the metric, no longer than the box.
  Vec2 edge(Metric2 m) {
    const Metric2 s = square_root(m);
    const double det = accurate_determinant(s);
    const Vec2 x = direction();
    const Vec2 d{(s.c * x.x() - s.b * x.y()) / det, (s.a * x.y() - s.b * x.x()) / det};
    const double share = std::max(std::abs(d.x()) / width().x(), std::abs(d.y()) / width().y());
    return share > 1 ? (1 / share) * d : d;
  }
  [[nodiscard]] Vec2 width() const { return high_ - low_; }
  [[nodiscard]] Vec2 low() const { return low_; }
  [[nodiscard]] Vec2 high() const { return high_; }

 private:
  PolygonLocator locator_;
  Vec2 low_, high_;
  std::mt19937_64 engine_{77};
  std::uniform_real_distribution<double> unit_{0, 1};
};

struct Errors {
  double mean = 0, percentile99 = 0, worst = 0;
};

// Errors of the lengths of edges about as long as the mesh's edges, in units of the prescribed size.
Errors errors_of(const ControlSpace& space, const Field& field, int count = 20'000) {
  Points points(field.domain);
  std::vector<double> error;
  for (int k = 0; k < count; ++k) {
    const Vec2 p = points.inside();
    const Metric2 truth = field.metric(p), m = space.at(p);
    EXPECT_GT(accurate_determinant(m), 0) << field.name;
    EXPECT_GT(m.a, 0) << field.name;
    const Vec2 d = points.edge(truth);
    error.push_back(std::abs(length(m, d) - length(truth, d)));
  }
  std::sort(error.begin(), error.end());
  Errors e;
  for (const double x : error) e.mean += x / count;
  e.percentile99 = error[error.size() * 99 / 100];
  e.worst = error.back();
  return e;
}

struct Expectation {
  Field field;
  double mean, worst, samples_per_vertex;
};

class SmoothFields : public testing::TestWithParam<Expectation> {};

// The tolerance is 2 % at worst; on smooth fields the mean must be far below 0.1 %.
TEST_P(SmoothFields, AreReproducedFromFewSamples) {
  const Expectation& e = GetParam();
  Asked asked;
  const ControlSpace space = build(e.field, {}, &asked);
  const Errors errors = errors_of(space, e.field);
  EXPECT_LT(errors.mean, e.mean);
  EXPECT_LT(errors.worst, e.worst);
  EXPECT_LT(static_cast<double>(asked.points), e.samples_per_vertex * 0.5 * space.measure());
  EXPECT_LE(asked.largest_batch, 4096u);
}

INSTANTIATE_TEST_SUITE_P(FiveThousandTriangles, SmoothFields,
                         testing::Values(Expectation{fields::paraboloid(0.1546), 1e-4, 1e-3, 0.4},
                                         Expectation{fields::paraboloid_on_disc(0.13), 1e-4, 1e-2, 0.4},
                                         Expectation{fields::paraboloid_on_l_shape(0.12), 1e-4, 2e-3, 0.4},
                                         Expectation{fields::wavy_plate_with_holes(0.04), 1e-4, 2e-3, 0.4},
                                         Expectation{fields::hemisphere(0.05), 1e-4, 4e-3, 0.4},
                                         Expectation{fields::torus(0.18), 5e-4, 5e-3, 0.8},
                                         Expectation{fields::ellipsoid_by_curvature(4 * fields::pi / 180), 2e-4, 5e-3,
                                                     0.8},
                                         Expectation{fields::sphere_with_pole(0.055), 2e-4, 2e-2, 0.4},
                                         Expectation{fields::sphere_by_projection(0.05), 5e-4, 2e-2, 1.6},
                                         Expectation{fields::swirl(3, 0.045), 5e-4, 2e-2, 1.9}));

INSTANTIATE_TEST_SUITE_P(HundredThousandTriangles, SmoothFields,
                         testing::Values(Expectation{fields::paraboloid(0.034), 1e-5, 2e-4, 0.15},
                                         Expectation{fields::paraboloid_on_disc(0.03), 1e-5, 2e-3, 0.15},
                                         Expectation{fields::hemisphere(0.012), 1e-5, 2e-3, 0.2},
                                         Expectation{fields::torus(0.044), 2e-5, 5e-4, 0.15},
                                         Expectation{fields::sphere_with_pole(0.013), 1e-4, 2e-2, 0.15},
                                         Expectation{fields::sphere_by_projection(0.01), 1e-4, 2e-2, 0.2},
                                         Expectation{fields::swirl(7, 0.011), 3e-4, 2e-2, 0.7}));

TEST(ControlSpace, ErrorsFollowTheTolerance) {
  for (const Field& field : {fields::swirl(3, 0.02), fields::ellipsoid_by_curvature(0.14), fields::torus(0.18)}) {
    ControlSpaceOptions options;
    options.samples_per_vertex = 100;
    double last = 1;
    for (const double tolerance : {0.08, 0.02, 0.005}) {
      options.tolerance = tolerance;
      const Errors e = errors_of(build(field, options), field);
      EXPECT_LT(e.worst, tolerance) << field.name;
      EXPECT_LT(e.percentile99, 0.25 * tolerance) << field.name;
      EXPECT_LE(e.mean, last) << field.name;
      last = e.mean;
    }
  }
}

// If lengths along u and v are biquadratic they are in the space of functions, and cubic prediction is exact on them.
TEST(ControlSpace, BiquadraticRootsAreExact) {
  const Field field{"biquadratic root", fields::domain_of({fields::rectangle({-1, 2}, {3, 5}, 40)}), [](Vec2 p) {
                      const double u = p.x(), v = p.y();
                      return square({100 + u * u - v * v * u, 0, 25 + 0.2 * u * u * v * v});
                    }};
  const ControlSpace space = build(field);
  Points points(field.domain);
  for (int k = 0; k < 5000; ++k) {
    const Vec2 p = points.inside();
    EXPECT_LT(length_error(space.at(p), field.metric(p)), 1e-11);
  }
}

// Differences of a field that is as smooth as a leaf equal the differences of at() itself.
TEST(ControlSpace, SlopesMatchTheMetric) {
  for (const Field& field : {fields::paraboloid(0.1), fields::torus(0.05), fields::swirl(4, 0.02)}) {
    const ControlSpace space = build(field);
    Points points(field.domain);
    int jumps = 0;
    for (int k = 0; k < 200; ++k) {
      const Vec2 p = points.inside();
      const MetricSlopes s = space.slopes_at(p);
      const Metric2 m = space.at(p);
      const double scale = m.a + m.c;
      EXPECT_NEAR(s.metric.a, m.a, 1e-12 * scale);
      EXPECT_NEAR(s.metric.b, m.b, 1e-12 * scale);
      EXPECT_NEAR(s.metric.c, m.c, 1e-12 * scale);
      const Vec2 d = 1e-6 * points.extent();
      const auto difference = [&](Vec2 e) { return space.at(p + e) + -1.0 * space.at(p + -1.0 * e); };
      const Metric2 u = difference({d.x(), 0}), v = difference({0, d.y()});
      const auto far = [&](Metric2 told, double step, Metric2 seen) {
        const double most =
            1e-4 * std::abs(2 * step) * (std::abs(told.a) + std::abs(told.b) + std::abs(told.c)) + 1e-8 * scale;
        const Metric2 off = seen + -2 * step * told;
        return std::abs(off.a) + std::abs(off.b) + std::abs(off.c) > most;
      };
      if (far(s.by_u, d.x(), u) || far(s.by_v, d.y(), v)) ++jumps;  // the border of a leaf, or of the box, in between
    }
    EXPECT_LE(jumps, 4) << field.name;
  }
}

TEST(ControlSpace, ConstantGivesBackTheMetric) {
  const Metric2 m{3e12, 1.7, 0.1};
  const ControlSpace space = ControlSpace::constant(m);
  EXPECT_EQ(space.at({0, 0}), m);
  EXPECT_EQ(space.at({-1e9, 1e9}), m);
  EXPECT_EQ(space.samples(), 0u);
  EXPECT_TRUE(space.is_constant());
  EXPECT_FALSE(build(fields::ring(0.1)).is_constant());
}

// A kink across which the size changes with slope 1/2 in units of itself, and a corner of it: cells stop at a fraction
// of an edge.
TEST(ControlSpace, SharpSizesAreFollowedDownToTheEdgesOfTheMesh) {
  const Field field = fields::ring(0.1);
  Asked asked;
  const ControlSpace space = build(field, {}, &asked);
  const Errors e = errors_of(space, field);
  EXPECT_LT(e.mean, 2e-3);
  EXPECT_LT(e.percentile99, 0.02);
  EXPECT_LT(static_cast<double>(asked.points), 800 + 4.1 * 0.5 * space.measure());
}

TEST(ControlSpace, SizesMayVaryAThousandfold) {
  const Field field = fields::thousandfold_sizes();
  const ControlSpace space = build(field);
  for (double r = 1e-4; r < 0.3; r *= 1.3)
    for (int k = 0; k < 8; ++k) {
      const Vec2 p{0.3 + r * std::cos(k), 0.4 + r * std::sin(k)};
      EXPECT_LT(length_error(space.at(p), field.metric(p)), 0.02) << r;
    }
}

// Three edges wide, in a field that is constant elsewhere.
TEST(ControlSpace, ASmallSpotIsNotMissed) {
  for (const Vec2& centre : {Vec2{0.37, 0.61}, Vec2{0.52, 0.48}, Vec2{0.11, 0.87}}) {
    const Field field{"spot", fields::domain_of({fields::rectangle({0, 0}, {1, 1}, 50)}), [centre](Vec2 p) {
                        const Vec2 d = (1 / 0.03) * (p - centre);
                        const double h = 0.02 * (1 - 0.5 * std::exp(-dot(d, d)));
                        return Metric2{1 / (h * h), 0, 1 / (h * h)};
                      }};
    const ControlSpace space = build(field);
    EXPECT_LT(length_error(space.at(centre), field.metric(centre)), 0.02);
    EXPECT_LT(errors_of(space, field).worst, 0.02);
  }
}

// The largest jump along a segment, found by halving towards it.
double largest_jump(const ControlSpace& space, Vec2 p, Vec2 q) {
  const auto error = [&](double s, double t) { return length_error(space.at(lerp(p, q, s)), space.at(lerp(p, q, t))); };
  constexpr int parts = 400;
  double worst = 0, start = 0;
  for (int k = 0; k < parts; ++k) {
    const double e = error(static_cast<double>(k) / parts, static_cast<double>(k + 1) / parts);
    if (e > worst) worst = e, start = static_cast<double>(k) / parts;
  }
  double low = start, high = start + 1.0 / parts;
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    (error(low, middle) > error(middle, high) ? high : low) = middle;
  }
  return error(low, high);
}

TEST(ControlSpace, IsContinuousAcrossCellsOfAllSizes) {
  for (const Field& field : {fields::ring(0.2), fields::swirl(7, 0.05), fields::sphere_by_projection(0.05),
                             fields::wavy_plate_with_holes(0.1)}) {
    const ControlSpace space = build(field);
    Points points(field.domain);
    for (int k = 0; k < 200; ++k) {
      const Vec2 p = points.in_box(), q = points.in_box();
      EXPECT_LT(largest_jump(space, p, q), 1e-8) << field.name;
    }
  }
}

TEST(ControlSpace, IsDefiniteEverywhereInTheBoxAndTakesTheNearestValueOutside) {
  for (const Field& field : {fields::ring(0.3), fields::swirl(7, 0.1), fields::sphere_by_projection(0.1),
                             fields::sphere_with_pole(0.2), fields::paraboloid_on_l_shape(0.5)}) {
    const ControlSpace space = build(field);
    Points points(field.domain);
    for (int k = 0; k < 20'000; ++k) {
      const Metric2 m = space.at(points.in_box());
      ASSERT_TRUE(m.a > 0 && m.c > 0 && accurate_determinant(m) > 0) << field.name;
    }
    const Vec2 low = points.low(), high = points.high();
    EXPECT_EQ(space.at({low.x() - 1, low.y() - 7}), space.at(low));
    EXPECT_EQ(space.at({high.x() + 1, 0.3}), space.at({high.x(), 0.3}));
    EXPECT_EQ(space.at({0.3, 1e300}), space.at({0.3, high.y()}));
  }
}

TEST(ControlSpace, IsTheSameEveryTime) {
  for (const Field& field : {fields::ring(0.3), fields::swirl(3, 0.05)}) {
    const ControlSpace one = build(field), two = build(field);
    EXPECT_EQ(one.samples(), two.samples());
    EXPECT_EQ(one.bytes(), two.bytes());
    EXPECT_EQ(one.measure(), two.measure());
    Points points(field.domain);
    for (int k = 0; k < 2000; ++k) {
      const Vec2 p = points.in_box();
      ASSERT_EQ(one.at(p), two.at(p));
    }
  }
}

// Boxes of 1e-6 x 1e6: powers of two, so that every operation is the same but for exponents.
TEST(ControlSpace, FollowsAStretchedParametrisationBitForBit) {
  const Field field = fields::hemisphere(0.1);
  const double x = std::ldexp(1, -20), y = std::ldexp(1, 20);
  Field stretched{"stretched", field.domain, [&](Vec2 p) {
                    const Metric2 m = field.metric({p.x() / x, p.y() / y});
                    return Metric2{m.a / (x * x), m.b / (x * y), m.c / (y * y)};
                  }};
  for (Vec2& p : stretched.domain.vertices) p = {p.x() * x, p.y() * y};
  const ControlSpace one = build(field), two = build(stretched);
  EXPECT_EQ(one.samples(), two.samples());
  Points points(field.domain);
  for (int k = 0; k < 2000; ++k) {
    const Vec2 p = points.in_box();
    const Metric2 m = one.at(p), n = two.at({p.x() * x, p.y() * y});
    ASSERT_EQ(m, (Metric2{n.a * x * x, n.b * x * y, n.c * y * y}));
  }
}

TEST(ControlSpace, MeasureIsTheAreaInUnitTriangles) {
  const double triangle = std::sqrt(3.0) / 4;
  // A sphere's zone has the area 2 pi times its height, a hemisphere 2 pi, a torus 4 pi^2 R r.
  const double h = 0.02;
  EXPECT_NEAR(build(fields::sphere_with_pole(h)).measure() * triangle * h * h / (2 * fields::pi * (1 + std::sin(1.0))),
              1, 1e-3);
  EXPECT_NEAR(build(fields::hemisphere(h)).measure() * triangle * h * h / (2 * fields::pi), 1, 0.01);
  EXPECT_NEAR(build(fields::torus(h)).measure() * triangle * h * h / (8 * fields::pi * fields::pi), 1, 1e-6);
}

}  // namespace
}  // namespace carreau
