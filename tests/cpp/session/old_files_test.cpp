// SPDX-License-Identifier: BSD-3-Clause
// Files that were written for BLSURF (RT-0232 sec. 3.2, 3.3 and 4): everything that its manual allows.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include "common/analytic_cad.h"
#include "io/files.h"
#include "io/mesh_files.h"
#include "session/session.h"
#include "support/error.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
using testing::AnalyticFace;

class Hearer final : public Monitor {
 public:
  void message(Level level, std::string_view text) override {
    (level == Level::debug ? debug : level == Level::warning ? warnings : others).emplace_back(text);
  }
  static bool has(const std::vector<std::string>& texts, const std::string& part) {
    return std::any_of(texts.begin(), texts.end(), [&](const auto& t) { return t.find(part) != std::string::npos; });
  }
  std::vector<std::string> debug, warnings, others;
};

/// A polygon of the plane z = 0, moved along x in space.
AnalyticFace outline(const std::vector<Vec2>& corners, double shift = 0) {
  AnalyticFace face{[shift](Vec2 p) { return SurfaceJet{{p.x() + shift, p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }, {}};
  for (std::size_t i = 0; i < corners.size(); ++i)
    face.curves.push_back(testing::segment(corners[i], corners[(i + 1) % corners.size()]));
  return face;
}

/// A folder with an x.pardom and a blsurf.env, and the geometry that they describe.
struct OldRun {
  std::filesystem::path folder = std::filesystem::temp_directory_path() / ("carreau old " + std::to_string(::getpid()));
  Hearer monitor;
  Session session{monitor};

  explicit OldRun(AnalyticCad cad, const std::string& pardom) {
    std::filesystem::create_directories(folder);
    write_file((folder / "x.pardom").string(), pardom);
    session.set_cad(std::make_shared<AnalyticCad>(std::move(cad)));
  }
  ~OldRun() { std::filesystem::remove_all(folder); }
  OldRun(const OldRun&) = delete;
  OldRun& operator=(const OldRun&) = delete;

  void run(const std::string& env) {
    write_file((folder / "blsurf.env").string(), env);
    session.run_env((folder / "blsurf.env").string());
  }
  [[nodiscard]] FlatMesh read(const std::string& name) const { return read_mesh((folder / name).string()); }
  [[nodiscard]] std::vector<Vec3> vertices_of_reference(int ref) {
    std::vector<Vec3> found;
    const FlatMesh mesh = session.exported();
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      if (mesh.vertex_refs[v] == ref) found.push_back(mesh.vertices[v]);
    return found;
  }
};

AnalyticCad one_square() {
  AnalyticCad cad;
  cad.faces[1] = outline({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  return cad;
}
const std::string square_pardom = "1\n1 1 4\n1 1 1 2\n1 2 2 3\n1 3 3 4\n1 4 4 1\n";

/// Two unit squares side by side: curve 2 of the first, upwards, is curve 4 of the second, downwards.
AnalyticCad pair_of_squares(double shift = 0) {
  AnalyticCad cad = one_square();
  cad.faces[2] = outline({{1, 0}, {2, 0}, {2, 1}, {1, 1}}, shift);
  return cad;
}
std::string pair_pardom(const std::string& points1, const std::string& points2) {
  return "2\n1 1 4\n1 1 1 2\n1 2 2 3\n1 3 3 4\n1 4 4 1\n" + points1 + "\n2 1 4\n1 5 2 6\n1 6 6 5\n1 7 5 3\n1 2 3 2\n" + points2 + "\n";
}

TEST(OldFiles, TextsOfOldUsersAreRead) {
  OldRun run(one_square(), square_pardom + "0\nthis square was drawn in 1999, 'quotes and all\n");
  run.run("hphydef\n 0.1\nhinterp_flag = 1\ncall\ninimesh\ncall export\ncall exit\nthe rest is 'a note\n");
  EXPECT_TRUE(Hearer::has(run.monitor.warnings, "x.pardom, line 8: the text after the last surface is ignored (ns is 1)"));
  EXPECT_EQ(run.session.mesh().edge_count(), 40u);
  EXPECT_EQ(run.read("x.mesh").triangles.size(), run.session.mesh().triangle_count());
}

TEST(OldFiles, ReferencesOfAFileHaveNoLimitOfDistance) {
  const std::string pardom = pair_pardom("0", "0");
  OldRun run(pair_of_squares(0.1), pardom);  // diag is 2.3: the second square begins a twentieth of it away
  run.run("hphydef 0.2\ncall inimesh\ncall exit\n");
  EXPECT_TRUE(Hearer::has(run.monitor.warnings, "curves or ends of them are up to 0.1"));
  EXPECT_EQ(find_defects(run.session.mesh()), std::vector<std::string>{});
  const QualitySummary q = summarise_quality(run.session.exported());
  EXPECT_EQ(q.open_edges, 30u);  // the six outer sides of both
  EXPECT_THROW(run.run("hphydef 0.2\neps_glue 0.05\ncall inimesh\n"), InvalidModel);
  EXPECT_THROW(run.run("hphydef 0.2\neps_match 0.05\ncall inimesh\n"), InvalidModel);
  run.session.parameters().set("hphydef", 0.2);
  run.session.set_model(Model(run.session.model()));  // from memory
  EXPECT_THROW(run.session.make_mesh(), InvalidModel);
}

TEST(OldFiles, PointsOnCurvesCutThem) {
  // The point .25 up the common side, of reference 77, is imposed in the face that has it downwards.
  for (const bool in_both : {false, true}) {
    OldRun run(pair_of_squares(), pair_pardom(in_both ? "1 78 1. .25" : "0", "2 77 1. .25 99 1.5 .5"));
    run.run("hphydef 0.17\ncall inimesh\nflag 1\ncall export\ncall exit\n");
    EXPECT_EQ(find_defects(run.session.mesh()), std::vector<std::string>{});
    const std::vector<Vec3> found = run.vertices_of_reference(in_both ? 78 : 77);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_LE(norm(found[0] - Vec3{1, 0.25, 0}), 1e-14);
    EXPECT_EQ(run.vertices_of_reference(99).size(), 1u);
    const FlatMesh mesh = run.read("x.mesh");
    double area = 0, side = 0;
    for (const auto& [a, b, c] : mesh.triangles)
      area += norm(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])) / 2;
    EXPECT_NEAR(area, 2, 1e-12);
    EXPECT_EQ(summarise_quality(mesh).open_edges, 36u);  // conforming: six sides of six edges
    for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
      EXPECT_GE(mesh.edge_refs[e], 1);
      EXPECT_LE(mesh.edge_refs[e], 7);
      if (mesh.edge_refs[e] == 2) side += norm(mesh.vertices[mesh.edges[e][1]] - mesh.vertices[mesh.edges[e][0]]);
    }
    EXPECT_NEAR(side, 1, 1e-12);  // both parts are the curve of the file
  }
}

TEST(OldFiles, PointsOnCurvesAreFoundWithReferences) {
  const std::string pardom =
      "2\n1 1 4\n1 0 0 0\n1 0 0 0\n1 0 0 0\n1 0 0 0\n0\n2 1 4\n1 0 0 0\n1 0 0 0\n1 0 0 0\n1 0 0 0\n3 77 1 .25 2 2. .5 3 2 1\n";
  OldRun run(pair_of_squares(), pardom);
  run.run("hphydef 0.17\ncall inimesh\ncall exit\n");
  EXPECT_EQ(find_defects(run.session.mesh()), std::vector<std::string>{});
  ASSERT_EQ(run.vertices_of_reference(77).size(), 1u);
  EXPECT_LE(norm(run.vertices_of_reference(77)[0] - Vec3{1, 0.25, 0}), 1e-14);
  // Reference 2 is of a corner, too, whose number gluing chose; the point has it in results all the same.
  const std::vector<Vec3> two = run.vertices_of_reference(2);
  EXPECT_TRUE(std::any_of(two.begin(), two.end(), [](const Vec3& p) { return norm(p - Vec3{2, 0.5, 0}) < 1e-14; }));
  EXPECT_EQ(summarise_quality(run.session.exported()).open_edges, 36u);
  // x.pardom.new holds the cuts, and gives the same mesh.
  const std::vector<Vec3> before = run.session.mesh().vertices;
  std::filesystem::rename(run.folder / "x.pardom.new", run.folder / "again.pardom");
  run.run("pref again\nhphydef 0.17\ncall inimesh\ncall exit\n");
  EXPECT_EQ(run.session.mesh().vertices, before);
}

TEST(OldFiles, ABowTieCrossesItself) {
  AnalyticCad cad;
  cad.faces[1] = outline({{0, 0}, {1, 1}, {1, 0}, {0, 1}});
  OldRun run(std::move(cad), square_pardom + "0\n");
  try {
    run.run("hphydef 0.1\ncall inimesh\n");
    FAIL() << "it was meshed";
  } catch (const DomainError& error) {
    EXPECT_NE(std::string(error.what()).find("crosses itself"), std::string::npos) << error.what();
  }
}

// RT-0232 sec. 4 prints the mesh of a patch in both dimensions, with one numbering.
TEST(OldFiles, ExportsOfOnePatchHaveOneNumbering) {
  OldRun run(one_square(), square_pardom + "1 9 .3 .4\n");
  for (const std::string element : {"p1", "p2", "q1.0"}) {
    run.run("hphydef 0.1\nelement " + element + "\ncall inimesh\ncall export\noption onesurf2d\npref 2d\ncall export\n" +
            "option onesurf3d\npref 3d\ncall export\ncall exit\n");
    const FlatMesh space = run.read("x.mesh");
    for (const char* other : {"2d.mesh", "3d.mesh"}) {
      const FlatMesh plane = run.read(other);
      EXPECT_EQ(plane.triangles, space.triangles) << element << other;
      EXPECT_EQ(plane.vertex_refs, space.vertex_refs) << element << other;
      ASSERT_EQ(plane.vertices.size(), space.vertices.size());
      for (std::size_t v = 0; v < space.vertices.size(); ++v)
        ASSERT_LE(norm(plane.vertices[v] - space.vertices[v]), 1e-15) << element << " vertex " << v;
    }
  }
}

TEST(OldFiles, Verbosity100PrintsEachCurveAndFace) {
  OldRun run(one_square(), square_pardom + "0\n");
  run.run("hphydef 0.1\nverb 100\npref x\ncall inimesh\ncall exit\n");
  EXPECT_TRUE(Hearer::has(run.monitor.debug, "blsurf.env, line 4: call inimesh with hphydef 0.1, pref 'x', verb 100"));
  EXPECT_TRUE(Hearer::has(run.monitor.debug, "curve 3: 10 edges, length 1"));
  EXPECT_TRUE(Hearer::has(run.monitor.debug, "face 1: " + std::to_string(run.session.mesh().triangle_count()) + " triangles"));
}

TEST(OldFiles, FormatIsAnyThatTheLibraryWrites) {
  std::string known;
  try {
    (void)mesh_format_of("x.none");
  } catch (const InvalidArgument& error) {
    known = error.what();
  }
  Parameters parameters;
  std::size_t formats = 0;
  for (std::size_t at = known.find(": .") + 2; at < known.size(); ++formats) {
    const std::size_t end = std::min(known.find(", ", at), known.size());
    parameters.set("format", known.substr(at + 1, end - at - 1));
    at = end + 2;
  }
  EXPECT_GE(formats, 20u);
  const std::string choices = find_parameter("format")->choices;
  EXPECT_EQ(static_cast<std::size_t>(std::count(choices.begin(), choices.end(), '|')), formats);  // exr besides
}

}  // namespace
}  // namespace carreau
