// SPDX-License-Identifier: BSD-3-Clause
// A large face that several processes make together equals the face of one process, and its host is called once over
// all of them.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/analytic_cad.h"
#include "common/thread_team.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;

using Settings = std::vector<std::pair<const char*, const char*>>;

struct Made {
  SurfaceMesh mesh;
  std::vector<double> sizes;
  CallCounts calls;
};

/// The mesh of a host whose size callback answers if `sizes` is true. With a link: as one of its processes.
Made made(const Settings& settings, bool sizes, const std::function<void(Session&)>& join) {
  auto cad = std::make_shared<AnalyticCad>(testing::paraboloid());
  std::int64_t sizes_asked = 0;
  if (sizes)
    cad->size_on_surface = [&](int, Vec2 p) {
      ++sizes_asked;
      return std::optional(0.008 * (1 + 0.2 * p.x()));
    };
  Monitor monitor;
  Session session(monitor);
  session.set_cad(cad);
  session.set_model(testing::unglued(*cad));
  for (const auto& [name, value] : settings) session.parameters().set_from_text(name, value, false);
  join(session);
  session.make_mesh();
  EXPECT_EQ(find_defects(session.mesh()), std::vector<std::string>{});
  Made result{session.mesh(), session.vertex_sizes(), cad->calls};
  result.calls.sizes = sizes_asked;
  return result;
}

/// The link of one of several threads, and the result of each.
std::vector<Made> made_together(int processes, const Settings& settings, bool sizes) {
  std::vector<Made> all(static_cast<std::size_t>(processes));
  testing::CommonOfThreads common(processes);
  std::vector<std::thread> threads;
  for (int rank = 0; rank < processes; ++rank)
    threads.emplace_back([&, rank] {
      all[static_cast<std::size_t>(rank)] =
          made(settings, sizes, [&](Session& session) { session.set_team(std::make_shared<testing::ThreadLink>(common, rank)); });
    });
  for (std::thread& thread : threads) thread.join();
  return all;
}

void expect_shared(const Settings& settings, bool sizes) {
  constexpr int processes = 3;
  const Made alone = made(settings, sizes, [](Session&) {});
  ASSERT_GT(alone.mesh.triangle_count(), 250'000U);
  CallCounts sum;
  for (const Made& one : made_together(processes, settings, sizes)) {
    EXPECT_EQ(one.mesh.vertices, alone.mesh.vertices);
    EXPECT_EQ(one.mesh.faces[0].triangles, alone.mesh.faces[0].triangles);
    EXPECT_EQ(one.mesh.faces[0].uv, alone.mesh.faces[0].uv);
    EXPECT_EQ(one.sizes, alone.sizes);
    sum.surf0 += one.calls.surf0, sum.surf1 += one.calls.surf1, sum.surf2 += one.calls.surf2, sum.sizes += one.calls.sizes;
  }
  // One of 64 is compared; each process makes its own calls for curves and single places.
  constexpr std::int64_t vertices = 125'000, own = vertices / 12;
  const auto expect_once = [&](std::int64_t of_all, std::int64_t of_one) {
    EXPECT_LT(of_all, of_one + processes * (of_one / 64 + own)) << of_one;
  };
  if (alone.calls.surf2 == 0) {  // else others request lower orders than metrics need, one by one
    expect_once(sum.surf0, alone.calls.surf0);
    expect_once(sum.surf1, alone.calls.surf1);
  } else {
    EXPECT_GT(alone.calls.surf2, settings.size() > 3 ? vertices : 0);
  }
  expect_once(sum.surf2, alone.calls.surf2);
  expect_once(sum.sizes, alone.calls.sizes);
}

TEST(SharedFaces, MatchWithSizesOfTheHost) { expect_shared({{"hphy_flag", "2"}, {"hphydef", "0.0085"}}, true); }
TEST(SharedFaces, MatchWithCurvature) { expect_shared({{"hphydef", "0.02"}, {"hgeo_flag", "1"}, {"angle_mesh", "0.35"}}, false); }
TEST(SharedFaces, MatchWithMetricsOfCurvature) {
  expect_shared({{"hphydef", "0.02"}, {"hgeo_flag", "1"}, {"angle_mesh", "0.3"}, {"geo_metric", "1"}, {"gradation", "1.3"}}, false);
}

}  // namespace
}  // namespace carreau
