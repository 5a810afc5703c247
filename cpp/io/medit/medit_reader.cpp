// SPDX-License-Identifier: BSD-3-Clause
#include "io/medit/element_sections.h"
#include "io/medit/medit_words.h"
#include "io/mesh_files.h"
#include "io/text.h"

namespace carreau {

namespace {

class MeditReader {
 public:
  MeditReader(std::string_view text, const std::string& name) : in_(text, name) {}

  FlatMesh read();

 private:
  void vertices();
  template <std::size_t N>
  void entities(const std::string& what, ElementSections<const char*>::Section<N>& section);
  bool read_section(std::string_view name);
  void check_indices();

  MeditWords in_;
  FlatMesh mesh_;
  bool has_vertices_ = false;
  ElementSections<const char*> elements_;
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
void MeditReader::entities(const std::string& what, ElementSections<const char*>::Section<N>& section) {
  if (section.start != nullptr) in_.fail(in_.position(), what + " come twice");
  const std::size_t n = in_.count(what, N + 1);
  section.start = in_.position();
  elements_.read(
      section, n, [this] { return in_.integer("the number of a vertex"); },
      [this] { return in_.integer("a reference"); });
}

bool MeditReader::read_section(std::string_view name) {
  if (name == "Vertices")
    vertices();
  else if (name == "Edges")
    entities("edges", elements_.edges);
  else if (name == "EdgesP2")
    entities("edges of order 2", elements_.edges3);
  else if (name == "Triangles")
    entities("triangles", elements_.triangles);
  else if (name == "Quadrilaterals")
    entities("quadrilaterals", elements_.quads);
  else if (name == "Tetrahedra")
    entities("tetrahedra", elements_.tetrahedra);
  else if (name == "TetrahedraP2")
    entities("tetrahedra of order 2", elements_.tetrahedra10);
  else if (name == "Pyramids")
    entities("pyramids", elements_.pyramids);
  else if (name == "Prisms" || name == "Pentahedra")
    entities("prisms", elements_.prisms);
  else if (name == "Hexahedra" || name == "Hexaedra")
    entities("hexahedra", elements_.hexahedra);
  else if (name == "TrianglesP2")
    entities("triangles of order 2", elements_.triangles6);
  else if (name == "QuadrilateralsQ2")
    entities("quadrilaterals of order 2", elements_.quads9);
  return !name.empty();
}

void MeditReader::check_indices() {
  const auto refuse = [this]<std::size_t N>(const char* what, const ElementSections<const char*>::Section<N>& section,
                                            std::size_t i, std::size_t k) {
    // Lines are not kept: the words are counted again to find this one.
    in_.go_back(section.start);
    for (std::size_t skipped = 0; skipped < i * (N + 1) + k; ++skipped) in_.word();
    const std::string_view found = in_.word();
    in_.fail(found.data(), std::string(what) + " " + std::to_string(i + 1) + " names vertex " + std::string(found) +
                               ", but there are " + std::to_string(mesh_.vertices.size()));
  };
  elements_.check_indices(mesh_.vertices.size(), refuse);
}

FlatMesh MeditReader::read() {
  in_.header("a mesh file");
  while (read_section(in_.next_section({"Vertices", "Edges", "EdgesP2", "Triangles", "Quadrilaterals", "Tetrahedra",
                                        "TetrahedraP2", "Pyramids", "Prisms", "Pentahedra", "Hexahedra", "Hexaedra",
                                        "TrianglesP2", "QuadrilateralsQ2"}))) {
  }
  if (in_.lacks_end() && !elements_.any()) in_.fail_without_end();
  if (!has_vertices_) in_.fail(in_.position(), "the file has no Vertices");
  check_indices();
  elements_.give_to(mesh_, in_.position(),
                    [this](const char* at, const std::string& sentence) { in_.fail(at, sentence); });
  return std::move(mesh_);
}

}  // namespace

FlatMesh read_mesh_text(std::string_view text, const std::string& name) {
  return MeditReader(without_byte_order_mark(text), name).read();
}

}  // namespace carreau
