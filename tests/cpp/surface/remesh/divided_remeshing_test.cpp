// SPDX-License-Identifier: BSD-3-Clause
// Large meshes made anew in parts: they do not depend on the process that makes them, and no measure shows where parts
// have met.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <new>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "../../geometry/discrete/surfaces.h"
#include "common/thread_team.h"
#include "geometry/discrete/discrete_cad.h"
#include "mesh/quality.h"
#include "session/session.h"
#include "support/error.h"

namespace carreau {
namespace {

using namespace testing;

constexpr double usual_size = 0.04;  // 80 000 triangles

const BuiltGeometry& torus() {
  static const BuiltGeometry built =
      discrete_geometry(std::make_shared<const discrete::DiscreteSurface>(discrete::surface_of(discrete::torus(48, 24))));
  return built;
}

void prepare(Session& session, double size, int threads) {
  session.set_cad(torus().cad);
  session.set_model(torus().model);
  session.parameters().set("threads", threads);
  session.parameters().set("hphy_flag", 1);
  session.parameters().set("hphydef", size);
  session.parameters().set("element", "p2");  // straight triangles would be made in planes
}

SurfaceMesh made_by(int threads) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  Monitor silent;
  Session session(silent);
  prepare(session, usual_size, threads);
  session.make_mesh();
  return session.mesh();
}

const SurfaceMesh& made_by_one() {
  static const SurfaceMesh mesh = made_by(1);
  return mesh;
}

void expect_same(const SurfaceMesh& one, const SurfaceMesh& other) {
  EXPECT_EQ(one.vertices, other.vertices);
  ASSERT_EQ(one.faces.size(), other.faces.size());
  for (std::size_t f = 0; f < one.faces.size(); ++f) {
    EXPECT_EQ(one.faces[f].vertex, other.faces[f].vertex);
    EXPECT_EQ(one.faces[f].uv, other.faces[f].uv);
    EXPECT_EQ(one.faces[f].triangles, other.faces[f].triangles);
  }
}

/// Stops at the checkpoints from one on.
class Stopping final : public Monitor {
 public:
  explicit Stopping(int after) : left_(after) {}
  void checkpoint() override {
    if (left_.fetch_sub(1) <= 0) throw Cancelled("the run was stopped");
  }

 private:
  std::atomic<int> left_;
};

/// Each process meshes; `size` and `monitor` by rank. The exception of each, or "".
template <typename Size, typename MonitorOf>
std::vector<std::string> mesh_in_processes(int n, const Size& size, const MonitorOf& monitor, std::vector<SurfaceMesh>& meshes) {
  CommonOfThreads common(n);
  std::vector<std::string> thrown(static_cast<std::size_t>(n));
  meshes.resize(static_cast<std::size_t>(n));
  std::vector<std::thread> processes;
  for (int rank = 0; rank < n; ++rank)
    processes.emplace_back([&, rank] {
      const auto r = static_cast<std::size_t>(rank);
      const std::unique_ptr<Monitor> own = monitor(rank);
      Session session(*own);
      try {
        prepare(session, size(rank), 1);
        session.set_team(std::make_shared<ThreadLink>(common, rank));
        session.make_mesh();
        meshes[r] = session.mesh();
      } catch (const std::exception& error) {
        thrown[r] = error.what();
      }
    });
  for (std::thread& process : processes) process.join();
  return thrown;
}

std::unique_ptr<Monitor> silent(int) { return std::make_unique<Monitor>(); }

TEST(DividedRemeshing, ATorusMatchesATorusInOnePiece) {
  const SurfaceMesh& mesh = made_by_one();
  EXPECT_EQ(find_defects(mesh, {.closed = true}), std::vector<std::string>{});
  const auto n = static_cast<std::int64_t>(mesh.vertices.size()), m = static_cast<std::int64_t>(mesh.triangle_count());
  ASSERT_GT(m, 65536);
  EXPECT_EQ(2 * n, m);  // Euler number 0
  for (const Vec3& p : mesh.vertices) EXPECT_LT(discrete::distance_to_torus(p), 2e-4);
  std::vector<int> degree(mesh.vertices.size(), 0);
  double quality = 0, worst = 1, shortest = 10, longest = 0;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles) {
      const auto at = [&](int k) { return mesh.vertices[static_cast<std::size_t>(face.vertex[static_cast<std::size_t>(t[static_cast<std::size_t>(k % 3)])])]; };
      const double q = quality_q2(at(0), at(1), at(2));
      quality += q, worst = std::min(worst, q);
      for (int k = 0; k < 3; ++k) {
        const double l = norm(at(k + 1) - at(k)) / usual_size;
        shortest = std::min(shortest, l), longest = std::max(longest, l);
        ++degree[static_cast<std::size_t>(face.vertex[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])])];
      }
    }
  EXPECT_GE(quality / static_cast<double>(m), 0.985);
  EXPECT_GE(worst, 0.5);
  EXPECT_GE(shortest, 0.5);
  EXPECT_LE(longest, 1.6);
  const auto irregular = std::count_if(degree.begin(), degree.end(), [](int d) { return d != 6; });
  EXPECT_LE(irregular, n / 8);
}

TEST(DividedRemeshing, TheSameForAnyNumberOfThreads) { expect_same(made_by_one(), made_by(3)); }

TEST(DividedRemeshing, TheSameForAnyNumberOfProcesses) {
  std::vector<SurfaceMesh> meshes;
  const auto thrown = mesh_in_processes(3, [](int) { return usual_size; }, silent, meshes);
  for (const std::string& sentence : thrown) ASSERT_EQ(sentence, "");
  for (const SurfaceMesh& mesh : meshes) expect_same(made_by_one(), mesh);
}

TEST(DividedRemeshing, ProcessesThatDifferAreNamed) {
  std::vector<SurfaceMesh> meshes;
  const auto thrown = mesh_in_processes(3, [](int rank) { return rank == 2 ? 1.001 * usual_size : usual_size; }, silent, meshes);
  for (const std::string& sentence : thrown) EXPECT_NE(sentence.find("rank 2"), std::string::npos) << sentence;
}

TEST(DividedRemeshing, AStopOfOneProcessIsOneOfAll) {
  const auto monitor = [](int rank) -> std::unique_ptr<Monitor> {
    if (rank == 1) return std::make_unique<Stopping>(100'000);
    return std::make_unique<Monitor>();
  };
  std::vector<SurfaceMesh> meshes;
  const auto thrown = mesh_in_processes(2, [](int) { return usual_size; }, monitor, meshes);
  for (const std::string& sentence : thrown) EXPECT_NE(sentence.find("stop"), std::string::npos) << sentence;
  for (const SurfaceMesh& mesh : meshes) EXPECT_TRUE(mesh.vertices.empty());
}

/// The torus, whose host fails from a call on.
class FailingCad final : public Cad {
 public:
  enum class How { sound, callback, memory };
  void fail(How how, std::int64_t from) { how_ = how, left_ = from; }
  [[nodiscard]] std::int64_t calls() const { return calls_; }

  [[nodiscard]] bool reentrant() const noexcept override { return true; }
  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    ++calls_;
    if (how_ != How::sound && left_.fetch_sub(1) <= 0) {
      if (how_ == How::memory) throw std::bad_alloc();
      throw CallbackError(Where{.face = face}, "the surface is lost");
    }
    torus().cad->surface(face, want, uv, out);
  }
  Interval curve_interval(int face, int ic) override { return torus().cad->curve_interval(face, ic); }
  CurveJet curve(int face, int ic, unsigned want, double t) override { return torus().cad->curve(face, ic, want, t); }

 private:
  How how_ = How::sound;
  std::atomic<std::int64_t> left_{0}, calls_{0};
};

struct Outcome {
  std::string sentence;
  bool kept = false;  // the previous mesh
  std::int64_t calls = 0;
};

/// Two processes make a coarse mesh, and then one in parts, of which the host of the second one fails from a call on.
std::vector<Outcome> remeshed(FailingCad::How how, std::int64_t from) {
  CommonOfThreads common(2);
  std::vector<Outcome> outcomes(2);
  std::vector<std::thread> processes;
  for (int rank = 0; rank < 2; ++rank)
    processes.emplace_back([&, rank] {
      Outcome& outcome = outcomes[static_cast<std::size_t>(rank)];
      Monitor monitor;
      const auto cad = std::make_shared<FailingCad>();
      Session session(monitor);
      prepare(session, 0.4, 1);
      session.set_triangles(std::dynamic_pointer_cast<const discrete::DiscreteCad>(torus().cad));
      session.set_cad(cad);
      session.set_team(std::make_shared<ThreadLink>(common, rank));
      session.make_mesh();
      const SurfaceMesh before = session.mesh();
      const std::int64_t calls = cad->calls();
      session.parameters().set("hphydef", usual_size);
      if (rank == 1) cad->fail(how, from);
      try {
        session.make_mesh();
      } catch (const std::exception& error) {
        outcome.sentence = error.what();
      }
      outcome.kept = session.mesh().vertices == before.vertices;
      outcome.calls = cad->calls() - calls;
    });
  for (std::thread& process : processes) process.join();
  return outcomes;
}

// In the middle of the calls of a sound run parts are remeshed: they make nearly all of them.
TEST(DividedRemeshing, AHostThatFailsInOneProcessEndsTheRunOfAllAndTheMeshOfBeforeStays) {
  const std::vector<Outcome> sound = remeshed(FailingCad::How::sound, 0);
  for (const Outcome& outcome : sound) {
    EXPECT_EQ(outcome.sentence, "");
    EXPECT_FALSE(outcome.kept);
  }
  for (const auto& [how, words] : {std::pair{FailingCad::How::callback, "the surface is lost"}, std::pair{FailingCad::How::memory, "memory"}})
    for (const Outcome& outcome : remeshed(how, sound[1].calls / 2)) {
      EXPECT_TRUE(outcome.kept);
      const bool told = outcome.sentence.find(words) != std::string::npos || outcome.sentence == "std::bad_alloc";
      EXPECT_TRUE(told) << outcome.sentence;
    }
}

}  // namespace
}  // namespace carreau
