#include "io/element_lists.h"
#include "io/medit/gmf_sections.h"
#include "io/mesh_files.h"
#include "support/error.h"

namespace carreau {

namespace {

class GmfReader {
 public:
  GmfReader(std::string_view bytes, const std::string& name) : in_(bytes, name) {}

  FlatMesh read();

 private:
  void section(std::int32_t code);
  void vertices();
  /// A list and where its first record is; 0: no section yet.
  template <std::size_t N>
  struct Section {
    ElementList<N> list;
    std::size_t start = 0;
  };
  template <std::size_t N>
  void entities(const char* what, Section<N>& section);
  template <std::size_t N>
  void check_indices(const char* what, const Section<N>& section) const;
  void check_all_indices() const;
  void take_elements();

  GmfSections in_;
  FlatMesh mesh_;
  bool has_dimension_ = false, has_vertices_ = false;
  Section<2> edges_;
  Section<3> edges3_, triangles_;
  Section<4> quads_;
  Section<6> triangles6_;
  Section<9> quads9_;
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
void GmfReader::entities(const char* what, Section<N>& section) {
  if (section.start != 0) in_.fail(in_.position(), std::string(what) + " are given twice");
  const std::size_t n = in_.count(what, (N + 1) * in_.sizes().index);
  section.start = in_.position();
  section.list.nodes.resize(n);
  section.list.refs.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::int32_t& vertex : section.list.nodes[i]) {
      const std::int32_t from_one = in_.reference();
      // The smallest integer has no predecessor; any value below 0 is refused when all vertices are known.
      vertex = from_one > 0 ? from_one - 1 : -1;
    }
    section.list.refs[i] = in_.reference();
  }
}

template <std::size_t N>
void GmfReader::check_indices(const char* what, const Section<N>& section) const {
  const auto& list = section.list.nodes;
  for (std::size_t i = 0; i < list.size(); ++i)
    for (const std::int32_t vertex : list[i])
      if (vertex < 0 || static_cast<std::size_t>(vertex) >= mesh_.vertices.size())
        in_.fail(section.start + i * (N + 1) * in_.sizes().index, std::string(what) + " " + std::to_string(i + 1) +
                                                                      " names a vertex that does not exist (there are " +
                                                                      std::to_string(mesh_.vertices.size()) + ")");
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
      return entities("edges", edges_);
    case GmfCode::edges_of_order_2:
      return entities("edges of order 2", edges3_);
    case GmfCode::triangles:
      return entities("triangles", triangles_);
    case GmfCode::quadrilaterals:
      return entities("quadrilaterals", quads_);
    case GmfCode::triangles_of_order_2:
      return entities("triangles of order 2", triangles6_);
    case GmfCode::quadrilaterals_of_order_2:
      return entities("quadrilaterals of order 2", quads9_);
    default:
      break;  // other sections are skipped whole
  }
}

void GmfReader::check_all_indices() const {
  check_indices("edge", edges_);
  check_indices("edge of order 2", edges3_);
  check_indices("triangle", triangles_);
  check_indices("quadrilateral", quads_);
  check_indices("triangle of order 2", triangles6_);
  check_indices("quadrilateral of order 2", quads9_);
}

void GmfReader::take_elements() {
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

FlatMesh GmfReader::read() {
  in_.header();
  for (std::int32_t code; (code = in_.next()) != static_cast<std::int32_t>(GmfCode::end);) section(code);
  if (!has_vertices_) in_.fail(in_.position(), "the file has no vertices");
  check_all_indices();
  take_elements();
  return std::move(mesh_);
}

}  // namespace

FlatMesh read_mesh_binary(std::string_view bytes, const std::string& name) { return GmfReader(bytes, name).read(); }

}  // namespace carreau
