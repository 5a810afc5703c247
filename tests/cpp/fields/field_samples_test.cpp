// SPDX-License-Identifier: BSD-3-Clause
// Sampling of hosts that fail.
#include "fields/field_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "cad/checked_cad.h"
#include "common/analytic_cad.h"

namespace carreau {
namespace {

/// A paraboloid that is there in a part of its domain only. Counts the points that it evaluates.
class PartlyThere : public testing::AnalyticCad {
 public:
  explicit PartlyThere(std::function<bool(Vec2)> there)
      : AnalyticCad(testing::paraboloid()), there_(std::move(there)) {}
  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    AnalyticCad::surface(face, want, uv, out);
    asked += uv.size();
    for (std::size_t i = 0; i < uv.size(); ++i)
      if (!there_(uv[i])) out[i].s.x() = out[i].su.x() = std::nan("");
  }
  std::size_t asked = 0;

 private:
  std::function<bool(Vec2)> there_;
};

struct Sampled {
  std::vector<Vec2> uv;
  std::vector<SurfaceJet> jets;
  std::int64_t failures = 0;
};

/// On a square of n x n places of the domain, row by row.
Sampled sample(PartlyThere& host, int n) {
  CheckedCad cad(host);
  Monitor monitor;
  FieldSampler sampler(1, want_position | want_first, nullptr, cad, monitor);
  Sampled result;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) result.uv.push_back({(i + 0.5) / n, (j + 0.5) / n});
  result.jets.resize(result.uv.size());
  std::vector<Metric2> metric(result.uv.size());
  sampler.sample(result.uv, result.jets, metric);
  result.failures = sampler.failures();
  return result;
}

TEST(FieldSampler, CallsAHostThatFailsEverywhereAtFewPlaces) {
  constexpr int n = 256;
  PartlyThere host([](Vec2) { return false; });
  const Sampled found = sample(host, n);
  EXPECT_EQ(found.failures, n * n);
  for (const SurfaceJet& jet : found.jets) ASSERT_TRUE(std::isnan(jet.s.x()) && std::isnan(jet.su.y()));
  // In batches all of them, one by one not a tenth: each such call costs an exception.
  EXPECT_LT(host.asked, 1.4 * n * n);
}

TEST(FieldSampler, ReportsEveryPlaceWhereAHostFails) {
  constexpr int n = 128;
  const auto there = [](Vec2 p) { return norm(p - Vec2{0.7, 0.8}) < 0.2; };
  PartlyThere host(there);
  const Sampled found = sample(host, n);
  std::int64_t failing = 0;
  for (std::size_t k = 0; k < found.uv.size(); ++k) {
    failing += there(found.uv[k]) ? 0 : 1;
    // Half of a batch of rows before the first place that is found may hold others.
    if (found.uv[k].y() <= 0.7) continue;
    ASSERT_EQ(std::isnan(found.jets[k].s.x()), !there(found.uv[k])) << k;
  }
  EXPECT_NEAR(static_cast<double>(found.failures), static_cast<double>(failing), 2.0 * n);
}

}  // namespace
}  // namespace carreau
