// SPDX-License-Identifier: BSD-3-Clause
// Degenerate, thin and hostile domains and samplers; limits of the control space.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "control_space/control_space.h"
#include "control_space_fields.h"
#include "metric/metric2_algebra.h"
#include "predicates/polygon_locator.h"
#include "support/error.h"

namespace carreau {
namespace {

using fields::Field;

MetricSampler sampler_of(const Field& field) {
  return [&field](std::span<const Vec2> uv, std::span<Metric2> metric) {
    const PolygonLocator locator(field.domain.vertices, field.domain.edges);
    for (std::size_t i = 0; i < uv.size(); ++i) {
      EXPECT_TRUE(locator.contains(uv[i])) << field.name;
      metric[i] = field.metric(uv[i]);
    }
  };
}

ControlSpace build(const Field& field, const ControlSpaceOptions& options = {}) {
  Monitor monitor;
  return ControlSpace::build(field.domain, sampler_of(field), options, monitor);
}

TEST(ControlSpaceLimits, AThinSliverNeedsNoNodeInside) {
  const auto metric = [](Vec2 p) {
    const double s = 1 + p.x();
    return Metric2{1e4 * s, 1e3, 1e4};
  };
  for (const double width : {1e-2, 1e-5, 1e-9}) {
    const Field field{"sliver", fields::domain_of({fields::polygon({{0, 0}, {1, 1}, {1, 1 + width}}, 100)}), metric};
    const ControlSpace space = build(field);
    EXPECT_LT(space.samples(), 2000u);
    for (double t = 0.01; t < 1; t += 0.01)
      EXPECT_LT(length_error(space.at({t, t + 0.5 * t * width}), metric({t, t})), 0.01) << width;
  }
}

// A single triangle, and one whose size is much larger than itself.
TEST(ControlSpaceLimits, TinyDomainsTakeFewSamples) {
  for (const double h : {1.0, 1e-1, 1e3}) {
    const Field field{"triangle", fields::domain_of({{{0, 0}, {1, 0}, {0, 1}}}), [h](Vec2 p) {
                        return Metric2{(1 + p.x()) / (h * h), 0, 1 / (h * h)};
                      }};
    const ControlSpace space = build(field);
    EXPECT_LT(space.samples(), 300u);
    for (const Vec2& p : {Vec2{0.3, 0.3}, Vec2{0.01, 0.9}, Vec2{0, 0}, Vec2{0.5, 0.5}})
      EXPECT_LT(length_error(space.at(p), field.metric(p)), 0.01) << h;
  }
}

TEST(ControlSpaceLimits, SidesThatWaverByRoundingAreSides) {
  Field field = fields::paraboloid(0.1546);
  for (std::size_t k = 0; k < field.domain.vertices.size(); ++k) {
    Vec2& p = field.domain.vertices[k];
    const double wave = 1 + 4e-16 * static_cast<double>(k % 3);
    p = {p.x() * wave, p.y() * wave};
  }
  const ControlSpace space = build(field);
  EXPECT_LT(space.samples(), 1000u);
  for (double t = -2.5; t <= 2.5; t += 0.01)
    for (const Vec2& p : {Vec2{t, -2.5}, Vec2{2.5, t}, Vec2{t, 2.49}})
      EXPECT_LT(length_error(space.at(p), field.metric(p)), 2e-3) << t;
}

// The places of the sampler's queries, within rounding; every point is inside.
std::vector<Vec2> asked_at(const Field& field) {
  std::vector<Vec2> points;
  const MetricSampler inside = sampler_of(field);
  const MetricSampler recording = [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
    inside(uv, metric);
    points.insert(points.end(), uv.begin(), uv.end());
  };
  Monitor monitor;
  (void)ControlSpace::build(field.domain, recording, {}, monitor);
  return points;
}

// Vertices interpolated along straight sides leave them by a rounding: nodes there are sampled all the same, and not
// extrapolated.
TEST(ControlSpaceLimits, SidesThatWaverByRoundingAreSampledLikeSides) {
  const Vec2 low{0.1, -0.7}, high{0.9, 0.3};
  const int n = 60;
  const auto metric = [](Vec2 p) {
    const double h = 0.02 + 0.1 * (p.x() + p.y()) * (p.x() + p.y());
    return Metric2{1 / (h * h), 0, 1 / (h * h)};
  };
  const Field straight{"straight sides", fields::domain_of({fields::rectangle(low, high, n)}), metric};
  Field wavering{"sides by lerp", straight.domain, metric};
  const Vec2 corners[] = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  std::size_t off = 0;
  for (std::size_t k = 0; k < wavering.domain.vertices.size(); ++k) {
    const Vec2 a = corners[k / n], b = corners[(k / n + 1) % 4];
    const double t = static_cast<double>(k % n) / n;
    Vec2& p = wavering.domain.vertices[k];
    p = {(1 - t) * a.x() + t * b.x(), (1 - t) * a.y() + t * b.y()};
    if (p.x() != low.x() && p.x() != high.x() && p.y() != low.y() && p.y() != high.y()) ++off;
  }
  ASSERT_GT(off, static_cast<std::size_t>(n / 4));
  const std::vector<Vec2> expected = asked_at(straight), found = asked_at(wavering);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Vec2 d = found[k] - expected[k];
    EXPECT_LT(dot(d, d), 1e-28) << k;
  }
}

TEST(ControlSpaceLimits, AspectRatiosUpToAMillionAreKept) {
  const Field field{"aspect", fields::domain_of({fields::rectangle({0, 0}, {1, 1}, 20)}), [](Vec2 p) {
                      const double s = 1 + p.x() * p.y();
                      return Metric2{100 * s * s * 1e12, 0.3 * s * 1e8, 100 * (1 + 0.2 * std::sin(3 * p.x()))};
                    }};
  ControlSpaceOptions options;
  options.max_samples = 20'000;
  const ControlSpace space = build(field, options);
  EXPECT_LE(space.samples(), options.max_samples);
  for (double u = 0.05; u < 1; u += 0.1)
    for (double v = 0.05; v < 1; v += 0.1) EXPECT_LT(length_error(space.at({u, v}), field.metric({u, v})), 1e-3);
}

TEST(ControlSpaceLimits, AWideBoxMuchShorterThanAnEdgeKeepsItsMetric) {
  // 100 edges by 1e-4 edges: small is not degenerate.
  const Metric2 m{1e4, 0, 1e-8};
  const Field field{"ribbon", fields::domain_of({fields::rectangle({0, 0}, {1, 1}, 100)}), [m](Vec2) { return m; }};
  EXPECT_LT(length_error(build(field).at({0.3, 0.7}), m), 1e-9);
}

// HDR sec. 4.5.4: metrics are clamped at degenerate sides, and only there.
TEST(ControlSpaceLimits, DegenerateSidesAreClamped) {
  const Field field = fields::sphere_with_pole(0.1);
  const ControlSpace space = build(field);
  const double at_pole = length(space.at({3, fields::pi / 2}), {2 * fields::pi, 0});
  EXPECT_GT(at_pole, 1e-3);
  EXPECT_LT(at_pole, 2e-2);
  const double near_pole = fields::pi / 2 - 0.01;
  EXPECT_LT(length_error(space.at({3, near_pole}), field.metric({3, near_pole})), 0.05);
}

TEST(ControlSpaceLimits, ASamplerThatIsDegenerateEverywhereGivesADefiniteField) {
  for (const Metric2 m : {Metric2{0, 0, 0}, Metric2{1, 0, 0}, Metric2{1e8, 1e8, 1e8}, Metric2{1, 1.0000001, 1}}) {
    const Field field{"degenerate", fields::domain_of({fields::rectangle({0, 0}, {1, 1}, 10)}),
                      [m](Vec2) { return m; }};
    const Metric2 n = build(field).at({0.4, 0.6});
    EXPECT_GT(accurate_determinant(n), 0);
    EXPECT_TRUE(n.a > 0 && n.c > 0 && std::isfinite(n.a) && std::isfinite(n.c));
  }
}

TEST(ControlSpaceLimits, NoiseAndJumpsCostAtMostTheSamplesAllowed) {
  // Different at every point, so that no refinement helps; sizes about a thousandth of the box.
  const Field noise{"noise", fields::domain_of({fields::rectangle({0, 0}, {1, 1}, 500)}), [](Vec2 p) {
                      const double x = std::sin(12345.6 * p.x() + 54321.0 * p.y()) * 1e4;
                      const double h = 0.001 * (1 + 0.5 * (x - std::floor(x)));
                      return Metric2{1 / (h * h), 0, 1 / (h * h)};
                    }};
  ControlSpaceOptions options;
  for (const std::size_t most : {std::size_t{1000}, std::size_t{10'000}, std::size_t{200'000}}) {
    options.max_samples = most;
    const ControlSpace space = build(noise, options);
    EXPECT_LE(space.samples(), most);
    EXPECT_LT(space.bytes(), 40'000'000u);
    EXPECT_GT(accurate_determinant(space.at({0.123, 0.456})), 0);
  }
  const Field jump{"jump", fields::domain_of({fields::rectangle({0, 0}, {1, 1}, 50)}), [](Vec2 p) {
                     const double h = p.x() + p.y() > 1.0 ? 0.02 : 0.1;
                     return Metric2{1 / (h * h), 0, 1 / (h * h)};
                   }};
  const ControlSpace space = build(jump);
  EXPECT_LT(length_error(space.at({0.2, 0.2}), jump.metric({0.2, 0.2})), 1e-9);
  EXPECT_LT(length_error(space.at({0.8, 0.8}), jump.metric({0.8, 0.8})), 1e-9);
}

TEST(ControlSpaceLimits, SmallMeshesTakeLittleMemory) {
  EXPECT_LT(build(fields::paraboloid(0.1546)).bytes(), 300'000u);
  EXPECT_LT(build(fields::paraboloid(1.5)).bytes(), 60'000u);
}

TEST(ControlSpaceLimits, DomainsWithoutAreaAreNamed) {
  Monitor monitor;
  const MetricSampler sampler = [](std::span<const Vec2>, std::span<Metric2>) { FAIL(); };
  EXPECT_THROW((void)ControlSpace::build({}, sampler, {}, monitor), DomainError);
  const SampledDomain flat = fields::domain_of({{{0, 0}, {1, 0}, {0.5, 0}}});
  EXPECT_THROW((void)ControlSpace::build(flat, sampler, {}, monitor), DomainError);
}

TEST(ControlSpaceLimits, MetricsThatAreNotFiniteAreRejectedWithTheirPlace) {
  Monitor monitor;
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (const Vec2& place : {Vec2{0.5, 0.5}, Vec2{0, 0}, Vec2{0.25, 0.125}}) {
      bool met = false;
      const MetricSampler sampler = [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
        for (std::size_t i = 0; i < uv.size(); ++i) {
          const bool here = uv[i] == place;
          met = met || here;
          metric[i] = {here ? bad : 4e4, 0, 4e4};
        }
      };
      const SampledDomain square = fields::domain_of({fields::rectangle({0, 0}, {1, 1}, 10)});
      try {
        (void)ControlSpace::build(square, sampler, {}, monitor);
        EXPECT_FALSE(met);
      } catch (const DomainError& error) {
        ASSERT_TRUE(error.where().uv);
        EXPECT_EQ(*error.where().uv, place);
      }
    }
}

TEST(ControlSpaceLimits, WidthsBeyondFloatingPointNumbersAreRejected) {
  Monitor monitor;
  const SampledDomain square = fields::domain_of({fields::rectangle({0, 0}, {1e160, 1e160}, 10)});
  const MetricSampler sampler = [](std::span<const Vec2>, std::span<Metric2> metric) {
    std::ranges::fill(metric, Metric2{1, 0, 1});
  };
  EXPECT_THROW((void)ControlSpace::build(square, sampler, {}, monitor), DomainError);
}

TEST(ControlSpaceLimits, ErrorsOfTheSamplerAndStopsPassThrough) {
  const Field field = fields::paraboloid(0.1);
  Monitor monitor;
  int calls = 0;
  const MetricSampler failing = [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
    if (++calls == 3) throw CallbackError("surf1 returned NaN");
    for (std::size_t i = 0; i < uv.size(); ++i) metric[i] = field.metric(uv[i]);
  };
  EXPECT_THROW((void)ControlSpace::build(field.domain, failing, {}, monitor), CallbackError);
  int after = 0;
  const MetricSampler stopping = [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
    if (monitor.stop_requested()) ++after;
    monitor.request_stop();
    for (std::size_t i = 0; i < uv.size(); ++i) metric[i] = field.metric(uv[i]);
  };
  EXPECT_THROW((void)ControlSpace::build(field.domain, stopping, {}, monitor), Cancelled);
  EXPECT_EQ(after, 0);
}

}  // namespace
}  // namespace carreau
