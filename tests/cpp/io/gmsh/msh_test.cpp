// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <sstream>

#include "io/mesh_files.h"
#include "io_test_support.h"

namespace carreau {
namespace {

/// A section of the file, without the lines that open and close it, word by word.
std::istringstream section(const std::string& text, const std::string& name) {
  const std::string open = "$" + name + "\n", close = "$End" + name + "\n";
  const std::size_t from = text.find(open), to = text.find(close);
  EXPECT_TRUE(from != std::string::npos && to != std::string::npos && from < to) << name;
  return std::istringstream(from < to ? text.substr(from + open.size(), to - from - open.size()) : "");
}

struct Element {
  int type, physical, entity;
  std::vector<int> nodes;
  friend bool operator==(const Element&, const Element&) = default;
};

struct Content {
  std::map<std::pair<int, int>, std::string> names;  // dimension and tag
  std::map<int, Vec3> nodes;
  std::map<int, Element> elements;
  std::map<std::pair<int, int>, std::vector<int>> bounds;  // of version 4.1, by dimension and tag
};

int nodes_of(int type) { return type == 15 ? 1 : type == 1 ? 2 : 3; }

void read_names(const std::string& text, Content& content) {
  auto words = section(text, "PhysicalNames");
  int count = 0, dim = 0, tag = 0;
  words >> count;
  for (int i = 0; i < count; ++i) {
    std::string name;
    words >> dim >> tag;
    std::getline(words, name);
    content.names[{dim, tag}] = name.substr(2, name.size() - 3);
  }
}

/// Reads version 2.2 by the manual of Gmsh.
Content read_2(const std::string& text) {
  Content content;
  read_names(text, content);
  auto words = section(text, "Nodes");
  int count = 0, tag = 0, tags = 0;
  words >> count;
  for (int i = 0; i < count; ++i) {
    Vec3 p;
    words >> tag >> p.x() >> p.y() >> p.z();
    content.nodes[tag] = p;
  }
  words = section(text, "Elements");
  words >> count;
  for (int i = 0; i < count; ++i) {
    Element e{};
    words >> tag >> e.type >> tags >> e.physical >> e.entity;
    EXPECT_EQ(tags, 2);
    e.nodes.resize(static_cast<std::size_t>(nodes_of(e.type)));
    for (int& node : e.nodes) words >> node;
    content.elements[tag] = e;
  }
  EXPECT_FALSE(words.fail());
  return content;
}

/// And of version 4.1.
Content read_4(const std::string& text) {
  Content content;
  read_names(text, content);
  auto words = section(text, "Entities");
  int counts[4], tag = 0, n = 0;
  double x = 0;
  for (int& count : counts) words >> count;
  std::map<std::pair<int, int>, int> physical;
  for (int i = 0; i < counts[0]; ++i) {
    words >> tag >> x >> x >> x >> n;
    EXPECT_EQ(n, 1);
    words >> physical[{0, tag}];
  }
  for (const int dim : {1, 2})
    for (int i = 0; i < counts[dim]; ++i) {
      words >> tag;
      for (int k = 0; k < 6; ++k) words >> x;
      words >> n >> physical[{dim, tag}];
      EXPECT_EQ(n, 1);
      words >> n;
      std::vector<int>& bounds = content.bounds[{dim, tag}];
      for (int k = 0; k < n; ++k) words >> bounds.emplace_back();
    }
  EXPECT_EQ(counts[3], 0);
  words = section(text, "Nodes");
  int blocks = 0, total = 0, dim = 0, entity = 0;
  words >> blocks >> total >> n >> n;
  for (int b = 0; b < blocks; ++b) {
    words >> dim >> entity >> n >> n;
    std::vector<int> tags(static_cast<std::size_t>(n));
    for (int& each : tags) words >> each;
    for (const int each : tags) {
      Vec3 p;
      words >> p.x() >> p.y() >> p.z();
      EXPECT_TRUE(content.nodes.emplace(each, p).second) << each;
    }
  }
  EXPECT_EQ(content.nodes.size(), static_cast<std::size_t>(total));
  words = section(text, "Elements");
  int type = 0;
  words >> blocks >> total >> n >> n;
  for (int b = 0; b < blocks; ++b) {
    words >> dim >> entity >> type >> n;
    for (int i = 0; i < n; ++i) {
      Element e{type, physical.at({dim, entity}), entity, {}};
      words >> tag;
      e.nodes.resize(static_cast<std::size_t>(nodes_of(type)));
      for (int& node : e.nodes) words >> node;
      content.elements[tag] = e;
    }
  }
  EXPECT_FALSE(words.fail());
  return content;
}

/// The square with two triangles on faces 3 and 7, one curve and one corner.
FlatMesh named_square() {
  FlatMesh mesh = square();
  mesh.triangle_refs = {3, 7};
  mesh.edges = {{0, 1}};
  mesh.edge_refs = {5};
  mesh.vertex_refs = {4, 0, 0, 0};
  mesh.faces = {{.ref = 3, .status = FaceStatus::meshed, .name = "lid \"A\""},
                {.ref = 7, .status = FaceStatus::meshed, .name = ""}};
  return mesh;
}

TEST(Msh, BothVersionsHoldTheSameMesh) {
  const FlatMesh mesh = named_square();
  const Content old = read_2(mesh_bytes(mesh, MeshFormat::msh2)), now = read_4(mesh_bytes(mesh, MeshFormat::msh));
  EXPECT_EQ(old.names, now.names);
  EXPECT_EQ(old.nodes, now.nodes);
  EXPECT_EQ(old.elements, now.elements);
  ASSERT_EQ(now.nodes.size(), mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    EXPECT_EQ(now.nodes.at(static_cast<int>(v) + 1), mesh.vertices[v]);  // bit for bit
  EXPECT_EQ(now.elements.size(), 4u);
  for (std::size_t t = 0; t < 2; ++t) {
    const auto& corners = mesh.triangles[t];
    const Element expected{2, t == 0 ? 3 : 7, t == 0 ? 3 : 7, {corners[0] + 1, corners[1] + 1, corners[2] + 1}};
    EXPECT_EQ(now.elements.at(static_cast<int>(t) + 3), expected);
  }
  EXPECT_EQ(now.elements.at(1), (Element{15, 4, 4, {1}}));
  EXPECT_EQ(now.elements.at(2), (Element{1, 5, 5, {1, 2}}));
  const std::map<std::pair<int, int>, std::string> names{
      {{0, 4}, "point_4"}, {{1, 5}, "curve_5"}, {{2, 3}, "lid _A_"}, {{2, 7}, "face_7"}};
  EXPECT_EQ(now.names, names);
}

TEST(Msh, EntitiesKnowTheirBorders) {
  // The square's border as curves 1 to 4 between points 1 to 4, and its diagonal as curve 9.
  FlatMesh mesh = named_square();
  mesh.vertex_refs = {1, 2, 3, 4}, mesh.fields.clear();
  const auto [a, b, c] = mesh.triangles[0];
  const auto& second = mesh.triangles[1];
  mesh.edges.clear(), mesh.edge_refs.clear();
  std::vector<std::array<std::int32_t, 2>> sides;
  for (const auto& t : {mesh.triangles[0], second})
    for (std::size_t i = 0; i < 3; ++i) sides.push_back({t[i], t[(i + 1) % 3]});
  int ref = 0;
  std::map<int, std::vector<int>> expected;  // of the faces
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto twin = std::find(sides.begin(), sides.end(), std::array{sides[s][1], sides[s][0]});
    if (twin != sides.end() && twin - sides.begin() < static_cast<std::ptrdiff_t>(s)) continue;
    mesh.edges.push_back(sides[s]), mesh.edge_refs.push_back(++ref);
    expected[s < 3 ? 3 : 7].push_back(ref);
    if (twin != sides.end()) expected[s < 3 ? 7 : 3].push_back(-ref);
  }
  ASSERT_EQ(ref, 5);
  Content content = read_4(mesh_bytes(mesh, MeshFormat::msh));
  for (auto& [face, bounds] : expected) {
    std::sort(bounds.begin(), bounds.end()), std::sort(content.bounds[{2, face}].begin(), content.bounds[{2, face}].end());
    EXPECT_EQ((content.bounds[{2, face}]), bounds) << face;
  }
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    EXPECT_EQ((content.bounds[{1, mesh.edge_refs[e]}]), (std::vector{mesh.vertex_refs[mesh.edges[e][0]], -mesh.vertex_refs[mesh.edges[e][1]]}));
  // A closed curve starts and ends at its point; a seam bounds its face from both sides.
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][2], mesh.triangles[0][1]});
  mesh.triangle_refs = {3, 3, 3};
  mesh.vertex_refs = {0, 0, 0, 0}, mesh.vertex_refs[a] = 6;
  mesh.edges = {{a, b}, {b, c}, {c, a}}, mesh.edge_refs = {5, 5, 5};
  content = read_4(mesh_bytes(mesh, MeshFormat::msh));
  EXPECT_EQ((content.bounds[{1, 5}]), (std::vector{6, -6}));
  EXPECT_EQ((content.bounds[{2, 3}]), (std::vector{5, -5}));
}

TEST(Msh, CurvesAndCornersAreLeftOutWithoutTheirGroups) {
  for (const MeshFormat format : {MeshFormat::msh2, MeshFormat::msh}) {
    const std::string text = mesh_bytes(named_square(), format, {.curve_groups = false});
    const Content content = format == MeshFormat::msh2 ? read_2(text) : read_4(text);
    EXPECT_EQ(content.names, (std::map<std::pair<int, int>, std::string>{{{2, 3}, "lid _A_"}, {{2, 7}, "face_7"}}));
    EXPECT_EQ(content.nodes.size(), 4u);
    ASSERT_EQ(content.elements.size(), 2u);
    for (const auto& [tag, element] : content.elements) EXPECT_EQ(element.type, 2);
  }
}

// libMesh keeps one name for each number: the last one.
TEST(Msh, NamesOfFacesComeAfterOtherNamesOfTheirNumbers) {
  FlatMesh mesh = named_square();
  mesh.edge_refs.assign(mesh.edge_refs.size(), 3), mesh.vertex_refs[0] = 7;
  mesh.names.face_solids = {{3, {3, 0}}, {7, {7, 0}}};
  for (const MeshFormat format : {MeshFormat::msh2, MeshFormat::msh}) {
    auto words = section(mesh_bytes(mesh, format), "PhysicalNames");
    int count = 0, dim = 0, tag = 0;
    words >> count;
    std::map<int, int> last;
    std::string name;
    for (int i = 0; i < count; ++i) {
      words >> dim >> tag;
      std::getline(words, name);
      last[tag] = dim;
    }
    EXPECT_EQ(count, format == MeshFormat::msh ? 6 : 4);
    EXPECT_EQ(last, (std::map<int, int>{{3, 2}, {7, 2}}));
  }
}

TEST(Msh, FacesOfOneNameAreOneGroup) {
  FlatMesh mesh = named_square();
  mesh.faces[0].name = mesh.faces[1].name = "wall";
  for (const Content& content :
       {read_2(mesh_bytes(mesh, MeshFormat::msh2)), read_4(mesh_bytes(mesh, MeshFormat::msh))}) {
    EXPECT_EQ(content.elements.at(3).physical, 3);
    EXPECT_EQ(content.elements.at(4).physical, 3);
    EXPECT_EQ(content.elements.at(3).entity, 3);
    EXPECT_EQ(content.elements.at(4).entity, 7);
    EXPECT_EQ(content.names.size(), 3u);
    EXPECT_EQ(content.names.at({2, 3}), "wall");
  }
}

TEST(Msh, TagsArePositiveWhateverTheReferences) {
  FlatMesh mesh = square();
  mesh.edges.clear(), mesh.edge_refs.clear(), mesh.vertex_refs.clear();
  constexpr std::int32_t largest = std::numeric_limits<std::int32_t>::max();
  for (const auto& refs : {std::vector<std::int32_t>{-2, 0}, {-2, largest}, {-2, 1}, {largest - 1, 0}}) {
    mesh.triangle_refs = refs;
    const Content content = read_4(mesh_bytes(mesh, MeshFormat::msh));
    for (const auto& [tag, element] : content.elements) EXPECT_GT(element.entity, 0);
    EXPECT_NE(content.elements.at(1).entity, content.elements.at(2).entity);
  }
  mesh.triangle_refs.clear();
  EXPECT_EQ(read_4(mesh_bytes(mesh, MeshFormat::msh)).elements.at(2).entity, 1);
}

TEST(Names, AreInVtuAsFieldDataAndInStlAsSolids) {
  const FlatMesh mesh = named_square();
  const std::string vtu = mesh_bytes(mesh, MeshFormat::vtu);
  const std::size_t at = vtu.find("Name=\"face_name\"");
  ASSERT_NE(at, std::string::npos);
  std::istringstream codes(vtu.substr(vtu.find('>', at) + 1));
  std::string names;
  for (int code = 0, ends = 0; ends < 2 && codes >> code;) {
    names += static_cast<char>(code);
    ends += code == 0 ? 1 : 0;
  }
  EXPECT_EQ(names, std::string("lid \"A\"\0\0", 9));
  const std::string stl = mesh_bytes(mesh, MeshFormat::stl, {.ascii_stl = true});
  EXPECT_EQ(stl.substr(0, 14), "solid lid _A_\n");
  EXPECT_NE(stl.find("\nsolid surface_7\n"), std::string::npos);
}

}  // namespace
}  // namespace carreau
