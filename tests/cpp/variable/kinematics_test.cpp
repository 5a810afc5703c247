// HDR sec. 3.4.6 with given displacement and damage.
#include "kinematics.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

#include "pieces.h"

namespace carreau::testing {
namespace {

using namespace variable;

void write_mesh(const std::string& path, const RemeshResult& r) {
  std::ofstream f(path);
  f.precision(12);
  f << "MeshVersionFormatted 2\nDimension 2\nVertices\n" << r.piece.vertices.size() << "\n";
  for (std::size_t v = 0; v < r.piece.vertices.size(); ++v)
    f << r.piece.vertices[v].x() << " " << r.piece.vertices[v].y() << " " << r.vertex_kinds[v] << "\n";
  f << "Triangles\n" << r.piece.triangles.size() << "\n";
  for (std::size_t t = 0; t < r.piece.triangles.size(); ++t)
    f << r.piece.triangles[t][0] + 1 << " " << r.piece.triangles[t][1] + 1 << " " << r.piece.triangles[t][2] + 1 << " "
      << r.parts[t] + 1 << "\n";
  f << "Edges\n" << r.edges.size() << "\n";
  for (std::size_t t = 0; t < r.edges.size(); ++t)
    f << r.edges[t][0] + 1 << " " << r.edges[t][1] + 1 << " " << r.edge_kinds[t] << "\n";
  f << "End\n";
}

void run(Kinematics& kinematics, const std::string& name, int increments) {
  Monitor monitor;
  double worst_mean = 1, worst = 1, time = 0;
  for (int i = 1; i <= increments; ++i) {
    const RemeshInput& input = kinematics.advance();
    const auto start = std::chrono::steady_clock::now();
    RemeshResult result;
    try {
      result = remesh(input, monitor);
    } catch (const Error& e) {
      FAIL() << i << ": " << e.what();
    }
    time += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    const auto defects = find_defects(input, result);
    EXPECT_TRUE(defects.empty()) << i << ": " << defects.front();
    const PieceQuality q = quality_of(result.piece, [&](Vec2) { return 1.; });
    worst_mean = std::min(worst_mean, q.q2_mean), worst = std::min(worst, q.q2_worst);
    const RemeshSummary& s = result.summary;
    if (i % 10 == 0 || s.boundary != Faithfulness::smooth || q.q2_worst < 0.3)
      std::printf("%d: %zu triangles, Q2 %.3f %.3f, area %.3f geometry %.3f given %.3f bound %.2e removed %.3f (%d %d), parts %d, bound %d imposed %d, boundary %d\n", i,
                  result.piece.triangles.size(), q.q2_mean, q.q2_worst, s.area, s.area_geometry, s.area_given, s.area_bound, s.area_removed,
                  int(s.damaged), int(s.at_multiple_vertices), s.parts_found, int(s.bound_vertices), int(s.imposed_vertices), int(s.boundary));
    if (const char* folder = std::getenv("PICTURES"))
      if (i % 10 == 0 || i==2 || q.q2_worst<.3) write_mesh(std::string(folder) + "/" + name + std::to_string(i) + ".mesh", result);
    kinematics.accept(std::move(result));
  }
  std::printf("%s: Q2 %.4f %.4f, %.2f ms a remeshing\n", name.c_str(), worst_mean, worst, time / increments);
}

TEST(Kinematics, BrazilianTest) { run(*brazilian_test(), "brazilian", 230); }
TEST(Kinematics, OrthogonalCutting) { run(*orthogonal_cutting(), "cutting", 610); }

}  // namespace
}  // namespace carreau::testing
