#include "io/element_lists.h"
#include "io/medit/medit_words.h"
#include "io/mesh_files.h"
#include "io/text.h"
#include "support/error.h"

namespace carreau {

namespace {

class MeditReader {
 public:
  MeditReader(std::string_view text, const std::string& name) : in_(text, name) {}

  FlatMesh read();

 private:
  void vertices();
  /// A list and where its first record is; null: no section yet.
  template <std::size_t N>
  struct Section {
    ElementList<N> list;
    const char* start = nullptr;
  };
  template <std::size_t N>
  void entities(const std::string& what, Section<N>& section);
  template <std::size_t N>
  void check_indices(const char* what, const Section<N>& section);
  bool read_section(std::string_view name);
  void check_all_indices();
  void take_elements();

  MeditWords in_;
  FlatMesh mesh_;
  bool has_vertices_ = false;
  Section<2> edges_;
  Section<3> edges3_, triangles_;
  Section<4> quads_;
  Section<6> triangles6_;
  Section<9> quads9_;
};

void MeditReader::vertices() {
  if (!in_.dimension()) in_.fail(in_.position(), "Vertices comes before Dimension");
  if (has_vertices_) in_.fail(in_.position(), "Vertices comes twice");
  has_vertices_ = true;
  mesh_.dimension = *in_.dimension();
  const std::size_t n = in_.count("vertices", static_cast<std::size_t>(mesh_.dimension) + 1);
  mesh_.vertices.resize(n);
  mesh_.vertex_refs.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    Vec3& p = mesh_.vertices[i];
    p.x() = in_.real("a coordinate of a vertex");
    p.y() = in_.real("a coordinate of a vertex");
    if (mesh_.dimension == 3) p.z() = in_.real("a coordinate of a vertex");
    mesh_.vertex_refs[i] = in_.integer("the reference of a vertex");
  }
}

template <std::size_t N>
void MeditReader::entities(const std::string& what, Section<N>& section) {
  if (section.start != nullptr) in_.fail(in_.position(), what + " come twice");
  const std::size_t n = in_.count(what, N + 1);
  section.start = in_.position();
  section.list.nodes.resize(n);
  section.list.refs.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::int32_t& vertex : section.list.nodes[i]) {
      const std::int32_t from_one = in_.integer("the number of a vertex");
      vertex = from_one > 0 ? from_one - 1 : -1;  // refused by check_indices, when all vertices are known
    }
    section.list.refs[i] = in_.integer("a reference");
  }
}

template <std::size_t N>
void MeditReader::check_indices(const char* what, const Section<N>& section) {
  const auto& list = section.list.nodes;
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t k = 0; k < N; ++k) {
      if (list[i][k] >= 0 && static_cast<std::size_t>(list[i][k]) < mesh_.vertices.size()) continue;
      // Lines are not kept: the words are counted again to find this one.
      in_.go_back(section.start);
      for (std::size_t skipped = 0; skipped < i * (N + 1) + k; ++skipped) in_.word();
      const std::string_view found = in_.word();
      in_.fail(found.data(), std::string(what) + " " + std::to_string(i + 1) + " names vertex " + std::string(found) +
                                 ", but there are " + std::to_string(mesh_.vertices.size()));
    }
}

bool MeditReader::read_section(std::string_view name) {
  if (name == "Vertices")
    vertices();
  else if (name == "Edges")
    entities("edges", edges_);
  else if (name == "EdgesP2")
    entities("edges of order 2", edges3_);
  else if (name == "Triangles")
    entities("triangles", triangles_);
  else if (name == "Quadrilaterals")
    entities("quadrilaterals", quads_);
  else if (name == "TrianglesP2")
    entities("triangles of order 2", triangles6_);
  else if (name == "QuadrilateralsQ2")
    entities("quadrilaterals of order 2", quads9_);
  return !name.empty();
}

void MeditReader::check_all_indices() {
  check_indices("edge", edges_);
  check_indices("edge of order 2", edges3_);
  check_indices("triangle", triangles_);
  check_indices("quadrilateral", quads_);
  check_indices("triangle of order 2", triangles6_);
  check_indices("quadrilateral of order 2", quads9_);
}

void MeditReader::take_elements() {
  ElementLists lists{.triangles = std::move(triangles_.list),
                     .triangles6 = std::move(triangles6_.list),
                     .quads = std::move(quads_.list),
                     .quads8 = {},
                     .edges = std::move(edges_.list),
                     .edges3 = std::move(edges3_.list)};
  std::size_t bad = 0;
  if (!take_quads9(quads9_.list.nodes, quads9_.list.refs, lists, mesh_, bad))
    in_.fail(quads9_.start, "quadrilateral of order 2 " + std::to_string(bad + 1) +
                                " has a ninth node that is not where its eight others put the centre");
  try {
    set_elements(lists, mesh_);
  } catch (const InvalidArgument& error) {
    in_.fail(in_.position(), error.what());
  }
}

FlatMesh MeditReader::read() {
  in_.header("a mesh file");
  while (read_section(in_.next_section({"Vertices", "Edges", "EdgesP2", "Triangles", "Quadrilaterals", "TrianglesP2",
                                        "QuadrilateralsQ2"}))) {
  }
  if (!has_vertices_) in_.fail(in_.position(), "the file has no Vertices");
  check_all_indices();
  take_elements();
  return std::move(mesh_);
}

}  // namespace

FlatMesh read_mesh_text(std::string_view text, const std::string& name) {
  return MeditReader(without_byte_order_mark(text), name).read();
}

}  // namespace carreau
