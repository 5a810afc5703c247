// SPDX-License-Identifier: BSD-3-Clause
// Quadrilaterals and elements of second order in files.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>

#include "io/element_lists.h"
#include "io/mesh_files.h"
#include "io_test_support.h"
#include "mesh/defects/cell_defects.h"
#include "mesh/defects/flat_defects.h"

namespace carreau {
namespace {

/// A strip of `count` squares, every third one as two triangles, with its lower side as edges of a curve.
FlatMesh strip(int count, bool quadratic, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> shift(-0.05, 0.05);
  FlatMesh mesh;
  const auto vertex = [&](double x, double y) {
    mesh.vertices.push_back({x + shift(random), y + shift(random), shift(random)});
    return static_cast<std::int32_t>(mesh.vertices.size()) - 1;
  };
  std::vector<std::int32_t> low, high;
  for (int i = 0; i <= count; ++i) low.push_back(vertex(i, 0)), high.push_back(vertex(i, 1));
  std::map<std::array<std::int32_t, 2>, std::int32_t> mids;
  const auto mid = [&](std::int32_t a, std::int32_t b) {
    const auto [at, fresh] = mids.try_emplace({std::min(a, b), std::max(a, b)}, 0);
    const Vec3 p = 0.5 * (mesh.vertices[a] + mesh.vertices[b]);
    if (fresh) at->second = vertex(p.x(), p.y());
    return at->second;
  };
  const auto add = [&](std::vector<std::int32_t> corners, std::int32_t ref) {
    Cell cell;
    const std::size_t n = corners.size();
    cell.kind = n == 3 ? (quadratic ? CellKind::triangle6 : CellKind::triangle3)
                       : (quadratic ? CellKind::quad8 : CellKind::quad4);
    std::ranges::copy(corners, cell.nodes.begin());
    for (std::size_t i = 0; quadratic && i < n; ++i) cell.nodes[n + i] = mid(corners[i], corners[(i + 1) % n]);
    add_cell(mesh, cell, ref);
  };
  for (int i = 0; i < count; ++i)
    if (i % 3 != 2) {
      const std::vector<std::int32_t> quad{low[i], low[i + 1], high[i + 1], high[i]};
      add(quad, 7);
    }
  for (int i = 2; i < count; i += 3) {
    add({low[i], low[i + 1], high[i + 1]}, 8);
    add({low[i], high[i + 1], high[i]}, 8);
  }
  for (int i = 0; i < count; ++i) {
    mesh.edges.push_back({low[i], low[i + 1]}), mesh.edge_refs.push_back(3);
    if (quadratic) mesh.edge_mids.push_back(mid(low[i], low[i + 1]));
  }
  mesh.vertex_refs.assign(mesh.vertices.size(), 0);
  return mesh;
}

/// The element with its smallest corner first: readers turn quadrilaterals.
Cell turned(Cell cell) {
  const int n = corner_count(cell.kind);
  const auto first = std::min_element(cell.nodes.begin(), cell.nodes.begin() + n) - cell.nodes.begin();
  std::rotate(cell.nodes.begin(), cell.nodes.begin() + first, cell.nodes.begin() + n);
  if (is_quadratic(cell.kind))
    std::rotate(cell.nodes.begin() + n, cell.nodes.begin() + n + first, cell.nodes.begin() + 2 * n);
  return cell;
}

void expect_same(const FlatMesh& found, const FlatMesh& wanted, const std::string& what) {
  EXPECT_EQ(found.vertices, wanted.vertices) << what;
  EXPECT_EQ(found.triangle_refs, wanted.triangle_refs) << what;
  EXPECT_EQ(found.edges, wanted.edges) << what;
  EXPECT_EQ(found.edge_mids, wanted.edge_mids) << what;
  ASSERT_EQ(found.cells.size(), wanted.cells.size()) << what;
  for (std::size_t c = 0; c < found.cells.size(); ++c)
    EXPECT_EQ(turned(found.cells[c]), turned(wanted.cells[c])) << what << c;
  EXPECT_EQ(find_cell_defects(found), std::vector<std::string>{}) << what;
}

TEST(ElementFiles, MeshesOfMixedElementsReadBackExactly) {
  const TemporaryFolder folder;
  for (const bool quadratic : {false, true})
    for (unsigned seed = 0; seed < 20; ++seed) {
      const FlatMesh mesh = strip(9, quadratic, seed);
      ASSERT_EQ(find_defects(mesh, {}), std::vector<std::string>{});
      for (const std::string suffix : {"mesh", "meshb", "msh", "msh2", "vtu"}) {
        const std::string path = folder.file("m." + suffix);
        write_mesh(mesh, path, mesh_format_of(path));
        expect_same(read_mesh(path), mesh, suffix);
      }
    }
}

// Elements of one square share halves: a reader that turns them anew each time would change a mesh at each reading.
TEST(ElementFiles, ElementsOverTheSameCornersReadBackExactly) {
  std::mt19937_64 random(7);
  for (int run = 0; run < 2000; ++run) {
    std::string text = "NDIME= 3\nNELEM= 0\nNPOIN= 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 .5 0\n";
    for (int marker = 0; marker < 4; ++marker) {
      std::array<int, 5> corners{0, 1, 2, 3, 4};
      std::ranges::shuffle(corners, random);
      const bool quad = random() % 3 != 0;
      text += "MARKER_TAG= face_" + std::to_string(9 - marker) + "\nMARKER_ELEMS= 1\n" + (quad ? "9" : "5");
      for (std::size_t k = 0; k < (quad ? 4U : 3U); ++k) text += " " + std::to_string(corners[k]);
      text += "\n";
    }
    const FlatMesh mesh = read_mesh_su2(text, "x");
    for (const MeshFormat format : {MeshFormat::mesh, MeshFormat::meshb, MeshFormat::vtu}) {
      const std::string bytes = mesh_bytes(mesh, format);
      const FlatMesh again = format == MeshFormat::mesh    ? read_mesh_text(bytes, "x")
                             : format == MeshFormat::meshb ? read_mesh_binary(bytes, "x")
                                                           : read_mesh_vtu(bytes, "x");
      ASSERT_EQ(again.triangles, mesh.triangles) << text;
      ASSERT_EQ(again.triangle_refs, mesh.triangle_refs) << text;
      ASSERT_EQ(again.cells, mesh.cells) << text;
    }
  }
}

TEST(ElementFiles, StlHasTheStraightTriangles) {
  const FlatMesh mesh = strip(9, true, 1);
  const FlatMesh found = read_mesh_stl(mesh_bytes(mesh, MeshFormat::stl, {.ascii_stl = true}), "a");
  EXPECT_TRUE(found.cells.empty());
  EXPECT_EQ(found.triangles.size(), mesh.triangles.size());
}

TEST(ElementFiles, TheNinthNodeOfMeditIsTheCentreOfTheEight) {
  const FlatMesh mesh = strip(2, true, 4);
  const MeditElements elements(mesh);
  ASSERT_EQ(elements.centres.size(), 2U);
  std::string text = mesh_bytes(mesh, MeshFormat::mesh);
  EXPECT_NE(text.find("QuadrilateralsQ2"), std::string::npos);
  FlatMesh moved = mesh;  // the same file with another centre
  moved.vertices.push_back({0.5, 0.5, 1});
  moved.vertex_refs.push_back(0);
  text = mesh_bytes(moved, MeshFormat::mesh);
  const std::size_t at = text.find("QuadrilateralsQ2");
  const std::string last = std::to_string(moved.vertices.size() + 2), ours = std::to_string(moved.vertices.size());
  const std::size_t found = text.rfind(" " + last + " ");
  ASSERT_GT(found, at);
  text.replace(found + 1, last.size(), ours);
  // The ninth node is not kept, wherever it lies.
  const FlatMesh read = read_mesh_text(text, "a");
  EXPECT_EQ(read.cells.size(), mesh.cells.size());
  EXPECT_EQ(read.vertices.size(), mesh.vertices.size() + 1);  // the centre that no element has any more
}

TEST(ElementFiles, OrdersAreNotMixed) {
  FlatMesh mesh = strip(3, true, 2);
  std::string text = mesh_bytes(mesh, MeshFormat::mesh);
  text.insert(text.rfind("\nEnd"), "\nTriangles\n1\n1 3 4 1\n");
  EXPECT_NE(sentence_of<FileError>([&] { read_mesh_text(text, "a"); }).find("first and of second order are mixed"),
            std::string::npos);
}

TEST(ElementFiles, FilesThatNoReaderWouldTakeAreRejected) {
  FlatMesh mesh = strip(3, true, 2);
  mesh.cells[0].nodes[5] = 1000;
  EXPECT_NE(sentence_of<InvalidArgument>([&] { mesh_bytes(mesh, MeshFormat::vtu); }).find("element 0"),
            std::string::npos);
  mesh = strip(3, false, 2);
  mesh.triangles.pop_back(), mesh.triangle_refs.pop_back();
  EXPECT_NE(sentence_of<InvalidArgument>([&] { mesh_bytes(mesh, MeshFormat::msh); }).find("triangles"),
            std::string::npos);
}

}  // namespace
}  // namespace carreau
