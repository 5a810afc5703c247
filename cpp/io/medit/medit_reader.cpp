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
  void entities(const std::string& what, std::vector<std::array<std::int32_t, N>>& list,
                std::vector<std::int32_t>& refs, const char*& start);
  void refuse_others(std::string_view section);
  template <std::size_t N>
  void check_indices(const char* what, const std::vector<std::array<std::int32_t, N>>& list, const char* start);

  MeditWords in_;
  FlatMesh mesh_;
  bool has_vertices_ = false;
  const char* edges_start_ = nullptr;  ///< of the first record; null: no section yet
  const char* triangles_start_ = nullptr;
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
void MeditReader::entities(const std::string& what, std::vector<std::array<std::int32_t, N>>& list,
                           std::vector<std::int32_t>& refs, const char*& start) {
  if (start != nullptr) in_.fail(in_.position(), what + " come twice");
  const std::size_t n = in_.count(what, N + 1);
  start = in_.position();
  list.resize(n);
  refs.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::int32_t& vertex : list[i]) {
      const std::int32_t from_one = in_.integer("the number of a vertex");
      vertex = from_one > 0 ? from_one - 1 : -1;  // refused by check_indices, when all vertices are known
    }
    refs[i] = in_.integer("a reference");
  }
}

template <std::size_t N>
void MeditReader::check_indices(const char* what, const std::vector<std::array<std::int32_t, N>>& list,
                                const char* start) {
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t k = 0; k < N; ++k) {
      if (list[i][k] >= 0 && static_cast<std::size_t>(list[i][k]) < mesh_.vertices.size()) continue;
      // Lines are not kept: the words are counted again to find this one.
      in_.go_back(start);
      for (std::size_t skipped = 0; skipped < i * (N + 1) + k; ++skipped) in_.word();
      const std::string_view found = in_.word();
      in_.fail(found.data(), std::string(what) + " " + std::to_string(i + 1) + " names vertex " + std::string(found) +
                                 ", but there are " + std::to_string(mesh_.vertices.size()));
    }
}

// Without them the surface would have holes that its owner does not know.
void MeditReader::refuse_others(std::string_view section) {
  const std::int32_t n = in_.integer("the number of elements");
  if (n != 0)
    in_.fail(section.data(),
             std::to_string(n) + " " + std::string(section) + "; triangles with three vertices are read only");
}

FlatMesh MeditReader::read() {
  in_.header("a mesh file");
  for (;;) {
    const std::string_view name =
        in_.next_section({"Vertices", "Edges", "Triangles", "Quadrilaterals", "TrianglesP2", "QuadrilateralsQ2"});
    if (name.empty()) break;
    if (name == "Vertices")
      vertices();
    else if (name == "Edges")
      entities("edges", mesh_.edges, mesh_.edge_refs, edges_start_);
    else if (name == "Triangles")
      entities("triangles", mesh_.triangles, mesh_.triangle_refs, triangles_start_);
    else
      refuse_others(name);
  }
  if (!has_vertices_) in_.fail(in_.position(), "the file has no Vertices");
  check_indices("edge", mesh_.edges, edges_start_);
  check_indices("triangle", mesh_.triangles, triangles_start_);
  return std::move(mesh_);
}

}  // namespace

FlatMesh read_mesh_text(std::string_view text, const std::string& name) {
  return MeditReader(without_byte_order_mark(text), name).read();
}

}  // namespace carreau
