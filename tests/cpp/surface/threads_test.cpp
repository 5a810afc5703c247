// SPDX-License-Identifier: BSD-3-Clause
// The mesh does not depend on the number of threads, and a host that is not re-entrant never sees a second thread.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include "common/analytic_cad.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;

/// The teapot as a host that remembers which threads call it.
class WatchedTeapot final : public Cad {
 public:
  explicit WatchedTeapot(bool reentrant) : reentrant_(reentrant), geometry_(testing::teapot()) {}

  void surface(int face, unsigned, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    bool alone = false;
    {
      const std::scoped_lock lock(mutex_);
      threads.insert(std::this_thread::get_id());
      alone = threads.size() == 1;
    }
    // A machine with other work starts threads late.
    if (reentrant_ && alone) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    for (std::size_t i = 0; i < uv.size(); ++i) out[i] = geometry_.faces.at(face).at(uv[i]);
  }
  Interval curve_interval(int face, int ic) override { return geometry_.curve_interval(face, ic); }
  CurveJet curve(int face, int ic, unsigned want, double t) override { return geometry_.curve(face, ic, want, t); }
  [[nodiscard]] bool reentrant() const noexcept override { return reentrant_; }
  [[nodiscard]] Model model() { return testing::unglued(geometry_); }

  std::set<std::thread::id> threads;

 private:
  bool reentrant_;
  AnalyticCad geometry_;
  std::mutex mutex_;
};

struct Made {
  SurfaceMesh mesh;
  std::vector<double> sizes;
  std::set<std::thread::id> threads;
};

Made make(int threads, bool reentrant, bool geometric) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  const auto cad = std::make_shared<WatchedTeapot>(reentrant);
  Monitor monitor;
  Session session(monitor);
  session.set_cad(cad);
  session.set_model(cad->model());
  session.parameters().set("threads", threads);
  if (geometric) {
    session.parameters().set("hphy_flag", 0);
    session.parameters().set("hgeo_flag", 1);
    session.parameters().set("angle_mesh", 16.);
  } else {
    session.parameters().set("hphydef", 0.15);
  }
  session.make_mesh();
  EXPECT_EQ(find_defects(session.mesh()), std::vector<std::string>{});
  return {session.mesh(), session.vertex_sizes(), cad->threads};
}

void expect_same(const Made& a, const Made& b) {
  ASSERT_EQ(a.mesh.vertices.size(), b.mesh.vertices.size());
  for (std::size_t i = 0; i < a.mesh.vertices.size(); ++i) {
    ASSERT_EQ(a.mesh.vertices[i].x(), b.mesh.vertices[i].x());
    ASSERT_EQ(a.mesh.vertices[i].y(), b.mesh.vertices[i].y());
    ASSERT_EQ(a.mesh.vertices[i].z(), b.mesh.vertices[i].z());
  }
  EXPECT_EQ(a.sizes, b.sizes);
  ASSERT_EQ(a.mesh.faces.size(), b.mesh.faces.size());
  for (std::size_t f = 0; f < a.mesh.faces.size(); ++f) {
    EXPECT_EQ(a.mesh.faces[f].triangles, b.mesh.faces[f].triangles);
    EXPECT_EQ(a.mesh.faces[f].status, b.mesh.faces[f].status);
  }
}

TEST(Threads, DoNotChangeTheMesh) {
  for (const bool geometric : {false, true}) {
    const Made one = make(1, false, geometric);
    for (const int threads : {2, 8})
      for (const bool reentrant : {false, true}) expect_same(one, make(threads, reentrant, geometric));
  }
}

TEST(Threads, AHostThatIsNotReentrantSeesOneOnly) {
  const Made made = make(8, false, true);
  EXPECT_EQ(made.threads, std::set{std::this_thread::get_id()});
}

TEST(Threads, AReentrantHostSeesSeveral) { EXPECT_GT(make(8, true, true).threads.size(), 1U); }

TEST(Threads, LimitsAndErrorsMatchOneThread) {
  for (const int threads : {1, 4}) {
    const auto cad = std::make_shared<AnalyticCad>(testing::teapot());
    cad->size_on_surface = [](int face, Vec2) -> std::optional<double> {
      if (face == 9 || face == 20) throw CallbackError(Where{.face = face}, "no size");
      return 0.2;
    };
    Monitor monitor;
    Session session(monitor);
    session.set_cad(cad);
    session.set_model(testing::unglued(*cad));
    session.parameters().set("threads", threads);
    session.parameters().set("max_triangles", 3000);
    EXPECT_THROW(session.make_mesh(), LimitError) << threads;
    session.parameters().set("max_triangles", 0);
    session.parameters().set("hphy_flag", 2);
    try {
      session.make_mesh();
      FAIL() << "the host's failure was lost";
    } catch (const CallbackError& error) {
      EXPECT_NE(std::string(error.what()).find("face 9"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace carreau
