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
  void refuse_others(const char* what);
  void vertices();
  template <std::size_t N>
  void entities(const char* what, std::vector<std::array<std::int32_t, N>>& list, std::vector<std::int32_t>& refs,
                std::size_t& start);
  template <std::size_t N>
  void check_indices(const char* what, const std::vector<std::array<std::int32_t, N>>& list, std::size_t start) const;

  GmfSections in_;
  FlatMesh mesh_;
  bool has_dimension_ = false, has_vertices_ = false;
  std::size_t edges_start_ = 0, triangles_start_ = 0;  ///< of the first record; 0: no section yet
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
void GmfReader::entities(const char* what, std::vector<std::array<std::int32_t, N>>& list,
                         std::vector<std::int32_t>& refs, std::size_t& start) {
  if (start != 0) in_.fail(in_.position(), std::string(what) + " are given twice");
  const std::size_t n = in_.count(what, (N + 1) * in_.sizes().index);
  start = in_.position();
  list.resize(n);
  refs.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::int32_t& vertex : list[i]) {
      const std::int32_t from_one = in_.reference();
      // The smallest integer has no predecessor; any value below 0 is refused when all vertices are known.
      vertex = from_one > 0 ? from_one - 1 : -1;
    }
    refs[i] = in_.reference();
  }
}

template <std::size_t N>
void GmfReader::check_indices(const char* what, const std::vector<std::array<std::int32_t, N>>& list,
                              std::size_t start) const {
  for (std::size_t i = 0; i < list.size(); ++i)
    for (const std::int32_t vertex : list[i])
      if (vertex < 0 || static_cast<std::size_t>(vertex) >= mesh_.vertices.size())
        in_.fail(start + i * (N + 1) * in_.sizes().index, std::string(what) + " " + std::to_string(i + 1) +
                                                              " names a vertex that does not exist (there are " +
                                                              std::to_string(mesh_.vertices.size()) + ")");
}

// Without them the surface would have holes that its owner does not know.
void GmfReader::refuse_others(const char* what) {
  const std::size_t at = in_.position();
  const std::int64_t n = in_.announced();
  if (n != 0) in_.fail(at, std::to_string(n) + " " + what + "; triangles with three vertices are read only");
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
      return entities("edges", mesh_.edges, mesh_.edge_refs, edges_start_);
    case GmfCode::triangles:
      return entities("triangles", mesh_.triangles, mesh_.triangle_refs, triangles_start_);
    case GmfCode::quadrilaterals:
      return refuse_others("quadrilaterals");
    case GmfCode::triangles_of_order_2:
      return refuse_others("triangles of order 2");
    case GmfCode::quadrilaterals_of_order_2:
      return refuse_others("quadrilaterals of order 2");
    default:
      break;  // other sections are skipped whole
  }
}

FlatMesh GmfReader::read() {
  in_.header();
  for (std::int32_t code; (code = in_.next()) != static_cast<std::int32_t>(GmfCode::end);) section(code);
  if (!has_vertices_) in_.fail(in_.position(), "the file has no vertices");
  check_indices("edge", mesh_.edges, edges_start_);
  check_indices("triangle", mesh_.triangles, triangles_start_);
  return std::move(mesh_);
}

}  // namespace

FlatMesh read_mesh_binary(std::string_view bytes, const std::string& name) { return GmfReader(bytes, name).read(); }

}  // namespace carreau
