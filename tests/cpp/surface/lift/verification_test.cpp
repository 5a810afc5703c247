// SPDX-License-Identifier: BSD-3-Clause
// The lifted vertices find details that the sampling of the metric misses: the patch is then sampled there and meshed
// again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string_view>

#include "common/analytic_cad.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;

struct Meshed {
  std::shared_ptr<AnalyticCad> cad;
  Monitor monitor;
  std::unique_ptr<Session> session;

  Meshed(AnalyticCad geometry, const std::vector<std::pair<const char*, double>>& values)
      : cad(std::make_shared<AnalyticCad>(std::move(geometry))), session(std::make_unique<Session>(monitor)) {
    session->set_cad(cad);
    session->set_model(testing::unglued(*cad));
    for (const auto& [name, value] : values) {
      if (std::string_view(name).ends_with("_flag"))
        session->parameters().set(name, static_cast<int>(value));
      else
        session->parameters().set(name, value);
    }
    session->make_mesh();
    EXPECT_EQ(find_defects(session->mesh()), std::vector<std::string>{});
  }

  /// Longest edge in space over the geometric mean of the sizes at its ends.
  [[nodiscard]] double longest(const std::function<double(Vec2)>& size) const {
    const FlatMesh mesh = session->exported();
    double most = 0;
    for (const auto& t : mesh.triangles)
      for (int i = 0; i < 3; ++i) {
        const Vec3 p = mesh.vertices[t[i]], q = mesh.vertices[t[(i + 1) % 3]];
        most = std::max(most, norm(q - p) / std::sqrt(size({p.x(), p.y()}) * size({q.x(), q.y()})));
      }
    return most;
  }
};

/// Places that lie on no coarse grid.
std::vector<Vec2> places() {
  std::vector<Vec2> result;
  for (int i = 1; i <= 4; ++i)
    result.push_back({std::fmod(0.618034 * i, 1) * 0.8 + 0.1, std::fmod(0.414214 * i, 1) * 0.8 + 0.1});
  return result;
}

/// The unit square, flat but for a steep bump, narrower than an edge.
AnalyticCad bump(Vec2 place) {
  AnalyticCad cad;
  cad.faces[1] = {[place](Vec2 p) {
                    constexpr double w = 0.0015, height = 0.003;
                    const Vec2 d = (1 / w) * (p - place);
                    const double z = height * std::exp(-0.5 * dot(d, d)), k = 1 / w;
                    return SurfaceJet{{p.x(), p.y(), z},
                                      {1, 0, -z * d.x() * k},
                                      {0, 1, -z * d.y() * k},
                                      {0, 0, z * (d.x() * d.x() - 1) * k * k},
                                      {0, 0, z * d.x() * d.y() * k * k},
                                      {0, 0, z * (d.y() * d.y() - 1) * k * k}};
                  },
                  testing::rectangle({0, 0}, {1, 1})};
  return cad;
}

AnalyticCad plane() {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) {
                    return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}};
                  },
                  testing::rectangle({0, 0}, {1, 1})};
  return cad;
}

TEST(Verification, BumpsThatNoSampleHitsAreMeshedAtTheirSize) {
  int corrections = 0;
  for (const Vec2& place : places()) {
    const Meshed run(bump(place), {{"hphydef", 0.002}, {"hphymin", 0.0001}, {"hphymax", 1}});
    corrections += run.session->report().corrections;
    EXPECT_LE(run.longest([](Vec2) { return 0.002; }), 1.6) << place.x() << " " << place.y();
  }
  EXPECT_GE(corrections, 1);
}

TEST(Verification, DipsOfTheSizesThatNoSampleHitsAreMeshed) {
  int corrections = 0;
  for (const Vec2& place : places()) {
    const auto size = [place](Vec2 p) {
      const Vec2 d = (1 / 0.0015) * (p - place);
      return 0.002 * (1 - 0.75 * std::exp(-0.5 * dot(d, d)));
    };
    AnalyticCad cad = plane();
    cad.size_on_surface = [size](int, Vec2 p) { return std::optional<double>(size(p)); };
    const Meshed run(std::move(cad), {{"hphy_flag", 2}, {"hphymin", 0.0001}, {"hphymax", 1}});
    corrections += run.session->report().corrections;
    EXPECT_LE(run.longest(size), 1.6) << place.x() << " " << place.y();
  }
  EXPECT_GE(corrections, 1);
}

TEST(Verification, SampledDetailsCostNothing) {
  for (const double size : {0.5, 0.1, 0.03}) {
    AnalyticCad cad;
    cad.faces[1] = {[](Vec2 p) { return testing::torus_jet(p, 2, 0.7); },
                    testing::rectangle({0, 0}, {2 * std::numbers::pi, 2 * std::numbers::pi})};
    const Meshed run(std::move(cad), {{"hphydef", size}, {"hphymin", size / 10}, {"hphymax", 10}});
    EXPECT_EQ(run.session->report().corrections, 0);
  }
  const Meshed run(testing::paraboloid(), {{"hphy_flag", 0}, {"hgeo_flag", 1}});
  EXPECT_EQ(run.session->report().corrections, 0);
}

TEST(Verification, SizesAtVerticesAreTheHosts) {
  const auto size = [](Vec2 p) { return 0.02 + 0.05 * p.x(); };
  AnalyticCad cad = plane();
  cad.size_on_surface = [size](int, Vec2 p) { return std::optional<double>(size(p)); };
  const Meshed run(std::move(cad), {{"hphy_flag", 2}, {"hphymin", 0.0001}, {"hphymax", 1}});
  const FlatMesh mesh = run.session->exported();
  const std::vector<double>& sizes = run.session->vertex_sizes();
  ASSERT_EQ(sizes.size(), mesh.vertices.size());
  std::size_t exact = 0;
  for (std::size_t v = 0; v < sizes.size(); ++v) {
    EXPECT_NEAR(sizes[v], size({mesh.vertices[v].x(), mesh.vertices[v].y()}), 0.02 * sizes[v]);
    exact += sizes[v] == size({mesh.vertices[v].x(), mesh.vertices[v].y()});
  }
  EXPECT_GT(exact, sizes.size() / 2);
}

}  // namespace
}  // namespace carreau
