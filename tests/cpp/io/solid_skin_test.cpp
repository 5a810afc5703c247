// SPDX-License-Identifier: BSD-3-Clause
// Volume meshes of each format: their outer faces are closed, turned outward, and enclose the volume.
#include "io/solid_skin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <sstream>

#include "io/mesh_files.h"
#include "io_test_support.h"

namespace carreau {
namespace {

using Edges = std::vector<std::array<int, 2>>;

/// A shape of the unit cube: corners, and edges in the order of a format.
struct Solid {
  SolidShape shape;
  std::vector<Vec3> corners;
  double volume;
};
const Solid tetrahedron{SolidShape::tetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1.0 / 6};
const Solid pyramid{SolidShape::pyramid, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}, 1.0 / 3};
const Solid prism{SolidShape::prism, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, 0.5};
const Solid hexahedron{
    SolidShape::hexahedron,
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
    1};

/// Corners, then the middles of edges.
std::vector<Vec3> nodes_of(const Solid& solid, const Edges& edges) {
  std::vector<Vec3> nodes = solid.corners;
  for (const auto& [a, b] : edges) nodes.push_back((solid.corners[std::size_t(a)] + solid.corners[std::size_t(b)]) / 2);
  return nodes;
}

double enclosed_volume(const FlatMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += dot(mesh.vertices[std::size_t(a)], cross(mesh.vertices[std::size_t(b)], mesh.vertices[std::size_t(c)])) / 6;
  return volume;
}

void expect_closed(const FlatMesh& mesh, double volume, const std::string& name) {
  std::map<std::array<std::int32_t, 2>, int> sides;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
  EXPECT_FALSE(mesh.triangles.empty()) << name;
  for (const auto& [side, n] : sides) {
    const std::array<std::int32_t, 2> back{side[1], side[0]};
    EXPECT_TRUE(n == 1 && sides.contains(back)) << name;
  }
  EXPECT_NEAR(enclosed_volume(mesh), volume, 1e-12) << name;
}

/// Nodes on the sides of elements of order 2 are in the middle of these sides.
void expect_middles(const FlatMesh& mesh, const std::string& name) {
  ASSERT_TRUE(mesh.is_quadratic()) << name;
  for (const Cell& cell : mesh.cells) {
    const auto n = std::size_t(corner_count(cell.kind));
    const auto at = [&](std::size_t k) -> const Vec3& { return mesh.vertices[std::size_t(cell.nodes[k])]; };
    for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(at(n + k), Vec3((at(k) + at((k + 1) % n)) / 2)) << name;
  }
}

std::string vtu(const std::vector<Vec3>& nodes, int type) {
  std::ostringstream text;
  text << "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='" << nodes.size()
       << "' NumberOfCells='1'><Points><DataArray type='Float64' NumberOfComponents='3' format='ascii'>";
  for (const Vec3& p : nodes) text << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  text << "</DataArray></Points><Cells><DataArray type='Int32' Name='connectivity' format='ascii'>";
  for (std::size_t k = 0; k < nodes.size(); ++k) text << k << ' ';
  text << "</DataArray><DataArray type='Int32' Name='offsets' format='ascii'>" << nodes.size()
       << "</DataArray><DataArray type='UInt8' Name='types' format='ascii'>" << type << "</DataArray></Cells>"
       << "<CellData><DataArray type='Int32' Name='reference' format='ascii'>7</DataArray></CellData>"
       << "</Piece></UnstructuredGrid></VTKFile>";
  return text.str();
}

std::string msh(const std::vector<Vec3>& nodes, int type) {
  std::ostringstream text;
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << nodes.size() << '\n';
  for (std::size_t k = 0; k < nodes.size(); ++k)
    text << k + 1 << ' ' << nodes[k].x() << ' ' << nodes[k].y() << ' ' << nodes[k].z() << '\n';
  text << "$EndNodes\n$Elements\n1\n1 " << type << " 2 7 7";
  for (std::size_t k = 0; k < nodes.size(); ++k) text << ' ' << k + 1;
  text << "\n$EndElements\n";
  return text.str();
}

std::string medit(const std::vector<Vec3>& nodes, const std::string& section) {
  std::ostringstream text;
  text << "MeshVersionFormatted 2\nDimension 3\nVertices\n" << nodes.size() << '\n';
  for (const Vec3& p : nodes) text << p.x() << ' ' << p.y() << ' ' << p.z() << " 0\n";
  text << section << "\n1\n";
  for (std::size_t k = 0; k < nodes.size(); ++k) text << k + 1 << ' ';
  text << "7\nEnd\n";
  return text.str();
}

std::string inp(const std::vector<Vec3>& nodes, const std::string& type) {
  std::ostringstream text;
  text << "*NODE\n";
  for (std::size_t k = 0; k < nodes.size(); ++k)
    text << k + 1 << ", " << nodes[k].x() << ", " << nodes[k].y() << ", " << nodes[k].z() << '\n';
  text << "*ELEMENT, TYPE=" << type << ", ELSET=face_7\n1";
  for (std::size_t k = 0; k < nodes.size(); ++k) text << (k == 12 ? ",\n" : ", ") << k + 1;
  text << '\n';
  return text.str();
}

std::string bdf(const std::vector<Vec3>& nodes, const std::string& card) {
  std::ostringstream text;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    text << "GRID," << k + 1 << ",," << nodes[k].x() << ',' << nodes[k].y() << ',' << nodes[k].z() << '\n';
  text << card << ",1,7";
  for (std::size_t k = 0; k < nodes.size(); ++k) text << ((k == 6 || k == 14) ? ",\n," : ",") << k + 1;
  text << "\nENDDATA\n";
  return text.str();
}

std::string unv(const std::vector<Vec3>& nodes, int descriptor, int first) {
  std::ostringstream text;
  text << "    -1\n  2411\n";
  for (std::size_t k = 0; k < nodes.size(); ++k)
    text << int(k) + first << " 1 1 11\n" << nodes[k].x() << ' ' << nodes[k].y() << ' ' << nodes[k].z() << '\n';
  text << "    -1\n    -1\n  2412\n1 " << descriptor << " 7 1 7 " << nodes.size() << '\n';
  for (std::size_t k = 0; k < nodes.size(); ++k) text << int(k) + first << (k % 8 == 7 ? '\n' : ' ');
  text << "\n    -1\n";
  return text.str();
}

std::string su2(const std::vector<Vec3>& nodes, int type) {
  std::ostringstream text;
  text << "NDIME= 3\nNELEM= 1\n" << type;
  for (std::size_t k = 0; k < nodes.size(); ++k) text << ' ' << k;
  text << " 0\nNPOIN= " << nodes.size() << '\n';
  for (std::size_t k = 0; k < nodes.size(); ++k) text << nodes[k].x() << ' ' << nodes[k].y() << ' ' << nodes[k].z() << ' ' << k << '\n';
  text << "NMARK= 0\n";
  return text.str();
}

TEST(SolidSkin, ASolidOfEachFormatIsItsOuterFaces) {
  struct Case {
    const Solid& solid;
    int vtk, gmsh, su2, unv;
    const char *medit, *inp, *bdf;
  };
  const Case cases[] = {{tetrahedron, 10, 4, 10, 111, "Tetrahedra", "C3D4", "CTETRA"},
                        {pyramid, 14, 7, 14, 0, "Pyramids", "C3D5", "CPYRAM"},
                        {prism, 13, 6, 13, 112, "Prisms", "C3D6", "CPENTA"},
                        {hexahedron, 12, 5, 12, 115, "Hexahedra", "C3D8R", "CHEXA"}};
  for (const Case& c : cases) {
    const std::vector<Vec3>& x = c.solid.corners;
    std::map<std::string, FlatMesh> read{{"vtu", read_mesh_vtu(vtu(x, c.vtk), "x")},
                                         {"msh", read_mesh_msh(msh(x, c.gmsh), "x")},
                                         {"mesh", read_mesh_text(medit(x, c.medit), "x")},
                                         {"inp", read_mesh_inp(inp(x, c.inp), "x")},
                                         {"bdf", read_mesh_bdf(bdf(x, c.bdf), "x")},
                                         {"su2", read_mesh_su2(su2(x, c.su2), "x")}};
    if (c.unv != 0) read["unv"] = read_mesh_unv(unv(x, c.unv, 1), "x"), read["unv 0"] = read_mesh_unv(unv(x, c.unv, 0), "x");
    for (const auto& [name, mesh] : read) {
      expect_closed(mesh, c.solid.volume, name + " " + c.medit);
      EXPECT_EQ(mesh.tetrahedra.size(), x.size() == 4 ? 1u : 0u) << name;
      const std::int32_t ref = name == "su2" ? 0 : 7;
      EXPECT_EQ(mesh.triangle_refs, std::vector<std::int32_t>(mesh.triangles.size(), ref)) << name;
    }
  }
}

TEST(SolidSkin, NodesOnEdgesMatchEachFormat) {
  const Edges tet{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
      tet_gmsh{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {2, 3}, {1, 3}},
      pyr{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
      pyr_gmsh{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}},
      wedge{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
      wedge_gmsh{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}},
      wedge_bdf{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 3}},
      hex{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
      hex_gmsh{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}},
      hex_bdf{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};
  struct Case {
    const Solid& solid;
    const Edges &vtk, &gmsh, &bdf;
    int vtk_type, gmsh_type;
    const char *inp_type, *card;
  };
  const Case cases[] = {{tetrahedron, tet, tet_gmsh, tet, 24, 11, "C3D10M", "CTETRA"},
                        {pyramid, pyr, pyr_gmsh, pyr, 27, 19, "C3D13", "CPYRAM"},
                        {prism, wedge, wedge_gmsh, wedge_bdf, 26, 18, "C3D15", "CPENTA"},
                        {hexahedron, hex, hex_gmsh, hex_bdf, 25, 17, "C3D20R", "CHEXA"}};
  for (const Case& c : cases) {
    const std::map<std::string, FlatMesh> read{
        {"vtu", read_mesh_vtu(vtu(nodes_of(c.solid, c.vtk), c.vtk_type), "x")},
        {"msh", read_mesh_msh(msh(nodes_of(c.solid, c.gmsh), c.gmsh_type), "x")},
        {"inp", read_mesh_inp(inp(nodes_of(c.solid, c.vtk), c.inp_type), "x")},
        {"bdf", read_mesh_bdf(bdf(nodes_of(c.solid, c.bdf), c.card), "x")}};
    for (const auto& [name, mesh] : read) {
      expect_closed(mesh, c.solid.volume, name + " " + c.card);
      expect_middles(mesh, name + " " + c.card);
    }
  }
  const FlatMesh p2 = read_mesh_text(medit(nodes_of(tetrahedron, tet), "TetrahedraP2"), "x");
  expect_closed(p2, tetrahedron.volume, "mesh"), expect_middles(p2, "mesh");
  // I-DEAS lists nodes around the bottom, upright edges, and around the top.
  const auto around = [](const Solid& solid, const std::vector<std::array<int, 2>>& order) {
    std::vector<Vec3> nodes;
    for (const auto& [a, b] : order) nodes.push_back((solid.corners[std::size_t(a)] + solid.corners[std::size_t(b)]) / 2);
    return nodes;
  };
  const std::vector<Vec3> tetrahedron10 =
      around(tetrahedron, {{0, 0}, {0, 1}, {1, 1}, {1, 2}, {2, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}, {3, 3}});
  const std::vector<Vec3> prism15 =
      around(prism, {{0, 0}, {0, 1}, {1, 1}, {1, 2}, {2, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 3}, {3, 4}, {4, 4}, {4, 5}, {5, 5}, {5, 3}});
  const std::vector<Vec3> hexahedron20 =
      around(hexahedron, {{0, 0}, {0, 1}, {1, 1}, {1, 2}, {2, 2}, {2, 3}, {3, 3}, {3, 0}, {0, 4}, {1, 5},
                          {2, 6}, {3, 7}, {4, 4}, {4, 5}, {5, 5}, {5, 6}, {6, 6}, {6, 7}, {7, 7}, {7, 4}});
  for (const auto& [nodes, descriptor, volume] : {std::tuple(tetrahedron10, 118, tetrahedron.volume),
                                                  std::tuple(prism15, 113, prism.volume),
                                                  std::tuple(hexahedron20, 116, hexahedron.volume)}) {
    const FlatMesh mesh = read_mesh_unv(unv(nodes, descriptor, 1), "x");
    expect_closed(mesh, volume, "unv"), expect_middles(mesh, "unv");
  }
}

TEST(SolidSkin, FacesOfTwoSolidsAreInside) {
  // Cells of a grid, each turned by chance: only the faces of the box remain.
  std::mt19937 random(5);
  constexpr int n = 3;
  FlatMesh mesh;
  SolidSkin skin;
  const auto vertex = [](int i, int j, int k) { return static_cast<std::int32_t>(i + (n + 1) * (j + (n + 1) * k)); };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) mesh.vertices.emplace_back(i, j, k);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        std::array<std::int32_t, 8> c{vertex(i, j, k),     vertex(i + 1, j, k),     vertex(i + 1, j + 1, k),     vertex(i, j + 1, k),
                                      vertex(i, j, k + 1), vertex(i + 1, j, k + 1), vertex(i + 1, j + 1, k + 1), vertex(i, j + 1, k + 1)};
        if (random() % 2 == 0) std::rotate(c.begin(), c.begin() + 4, c.end());  // of negative volume
        if (random() % 2 == 0)
          skin.add(SolidShape::hexahedron, c, 1);
        else
          for (const auto& t : {std::array{0, 1, 2, 4, 5, 6}, std::array{0, 2, 3, 4, 6, 7}}) {
            std::array<std::int32_t, 6> prism_of{};
            for (std::size_t m = 0; m < 6; ++m) prism_of[m] = c[std::size_t(t[m])];
            skin.add(SolidShape::prism, prism_of, 2);
          }
      }
  mesh.vertex_refs.assign(mesh.vertices.size(), 0);
  ElementLists lists;
  skin.give_to(lists, mesh.vertices);
  double area = 0;
  set_elements(lists, mesh);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &p = mesh.vertices[std::size_t(a)], &q = mesh.vertices[std::size_t(b)], &r = mesh.vertices[std::size_t(c)];
    area += norm(cross(q - p, r - p)) / 2;
  }
  // A prism beside a hexahedron has two triangles where that has a quadrilateral.
  EXPECT_GE(area, 6 * n * n - 1e-9);
  EXPECT_NEAR(enclosed_volume(mesh), n * n * n, 1e-9);
}

TEST(SolidSkin, ASurfaceBesideSolidsIsTheSurface) {
  const std::string text = medit(tetrahedron.corners, "Tetrahedra");
  std::string both = text;
  both.insert(both.find("End"), "Triangles\n1\n1 2 3 9\n");
  EXPECT_EQ(read_mesh_text(both, "x").triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}}));
}

}  // namespace
}  // namespace carreau
