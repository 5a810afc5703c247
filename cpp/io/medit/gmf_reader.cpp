// SPDX-License-Identifier: BSD-3-Clause
#include "io/medit/element_sections.h"
#include "io/medit/gmf_sections.h"
#include "io/mesh_files.h"

namespace carreau {

namespace {

class GmfReader {
 public:
  GmfReader(std::string_view bytes, const std::string& name) : in_(bytes, name) {}

  FlatMesh read();

 private:
  void section(std::int32_t code);
  void vertices();
  template <std::size_t N>
  void entities(const char* what, ElementSections<std::size_t>::Section<N>& section);
  void check_indices() const;

  GmfSections in_;
  FlatMesh mesh_;
  bool has_dimension_ = false, has_vertices_ = false;
  ElementSections<std::size_t> elements_;
};

void GmfReader::vertices() {
  if (!has_dimension_) in_.fail(in_.position(), "vertices come before the dimension");
  if (has_vertices_) in_.fail(in_.position(), "vertices are given twice");
  has_vertices_ = true;
  const GmfSizes& sizes = in_.sizes();
  const std::size_t n = in_.count("vertices", static_cast<std::size_t>(mesh_.dimension) * sizes.real + sizes.index);
  mesh_.vertices.resize(n);
  mesh_.vertex_refs.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    Vec3& p = mesh_.vertices[i];
    p.x() = in_.real("a coordinate");
    p.y() = in_.real("a coordinate");
    if (mesh_.dimension == 3) p.z() = in_.real("a coordinate");
    mesh_.vertex_refs[i] = in_.reference();
  }
}

template <std::size_t N>
void GmfReader::entities(const char* what, ElementSections<std::size_t>::Section<N>& section) {
  if (section.start != 0) in_.fail(in_.position(), std::string(what) + " are given twice");
  const std::size_t n = in_.count(what, (N + 1) * in_.sizes().index);
  section.start = in_.position();
  const auto reference = [this] { return in_.reference(); };
  elements_.read(section, n, reference, reference);
}

void GmfReader::section(std::int32_t code) {
  switch (static_cast<GmfCode>(code)) {
    case GmfCode::dimension:
      if (has_dimension_) in_.fail(in_.position(), "the dimension is given twice");
      mesh_.dimension = in_.dimension();
      has_dimension_ = true;
      break;
    case GmfCode::vertices:
      return vertices();
    case GmfCode::edges:
      return entities("edges", elements_.edges);
    case GmfCode::edges_of_order_2:
      return entities("edges of order 2", elements_.edges3);
    case GmfCode::triangles:
      return entities("triangles", elements_.triangles);
    case GmfCode::quadrilaterals:
      return entities("quadrilaterals", elements_.quads);
    case GmfCode::tetrahedra:
      return entities("tetrahedra", elements_.tetrahedra);
    case GmfCode::tetrahedra_of_order_2:
      return entities("tetrahedra of order 2", elements_.tetrahedra10);
    case GmfCode::pyramids:
      return entities("pyramids", elements_.pyramids);
    case GmfCode::prisms:
      return entities("prisms", elements_.prisms);
    case GmfCode::hexahedra:
      return entities("hexahedra", elements_.hexahedra);
    case GmfCode::triangles_of_order_2:
      return entities("triangles of order 2", elements_.triangles6);
    case GmfCode::quadrilaterals_of_order_2:
      return entities("quadrilaterals of order 2", elements_.quads9);
    default:
      break;  // other sections are skipped whole
  }
}

void GmfReader::check_indices() const {
  const auto refuse = [this]<std::size_t N>(const char* what, const ElementSections<std::size_t>::Section<N>& section,
                                            std::size_t i, std::size_t) {
    in_.fail(section.start + i * (N + 1) * in_.sizes().index, std::string(what) + " " + std::to_string(i + 1) +
                                                                  " names a vertex that does not exist (there are " +
                                                                  std::to_string(mesh_.vertices.size()) + ")");
  };
  elements_.check_indices(mesh_.vertices.size(), refuse);
}

FlatMesh GmfReader::read() {
  in_.header();
  for (std::int32_t code; (code = in_.next()) != static_cast<std::int32_t>(GmfCode::end);) section(code);
  if (!has_vertices_) in_.fail(in_.position(), "the file has no vertices");
  check_indices();
  elements_.give_to(mesh_, in_.position(),
                    [this](std::size_t at, const std::string& sentence) { in_.fail(at, sentence); });
  return std::move(mesh_);
}

}  // namespace

FlatMesh read_mesh_binary(std::string_view bytes, const std::string& name) { return GmfReader(bytes, name).read(); }

}  // namespace carreau
