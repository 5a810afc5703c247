// SPDX-License-Identifier: BSD-3-Clause
/// Meshes: see carreau.hpp.
#ifndef CARREAU_MESH_HPP
#define CARREAU_MESH_HPP

#include "error.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace carreau {

// ---- Meshes ----

/// A face of a mesh: carreau_face with copies of its texts.
struct Face {
  int ref = 0;
  int status = CARREAU_FACE_NOT_MESHED; ///< CARREAU_FACE_...
  std::int64_t triangles = 0;
  std::string why;  ///< sentence for mended, failed and collapsed faces
  std::string name;
  int rgb = -1; ///< 0xRRGGBB, or -1
};

/// Arrays of a mesh of the caller. Rows of vertices, triangles and edges, and defaults of empty spans, are as in carreau_mesh_arrays.
struct MeshArrays {
  std::span<const Point3> vertices{};
  std::span<const Triangle> triangles{};
  std::span<const Edge> edges{};
  std::span<const std::int32_t> vertex_refs{}, triangle_refs{}, edge_refs{};
  std::span<const std::array<Point2, 3>> corner_uv{};
};

/// The vertices of a part: numbers in the whole mesh, ranks, and rows of solvers.
struct PartVertices {
  std::vector<std::int64_t> numbers;
  std::vector<std::int32_t> owners;
  std::vector<std::int64_t> rows;
};

/// The triangles of a part: numbers in the whole mesh, and ranks.
struct PartTriangles {
  std::vector<std::int64_t> numbers;
  std::vector<std::int32_t> owners;
};

/// Pairs of triangles that cross, and a place of each.
struct Intersections {
  std::int64_t count = 0; ///< of all pairs; the vectors may hold fewer
  std::vector<Edge> triangles;
  std::vector<Point3> places;
};

/// Regions of space that a mesh bounds.
struct Regions {
  std::vector<std::int32_t> solids; ///< 0: a hole
  std::vector<Point3> inside;
};

/// An independent mesh, or the mesh of a session, which then lives as long as this object.
class Mesh {
 public:
  /// An empty mesh, to be filled by read, from_arrays or carreau::remesh.
  Mesh() {
    if (const carreau_status status = carreau_mesh_create(&mesh_); status != CARREAU_OK) detail::fail(status, "");
  }
  /// The mesh of a file.
  explicit Mesh(const std::string& path) : Mesh() { read(path); }
  /// A copy of arrays.
  explicit Mesh(const MeshArrays& arrays) : Mesh() { from_arrays(arrays); }
  /// A handle of the C interface that `owner` keeps alive.
  Mesh(carreau_mesh* mesh, std::shared_ptr<void> owner) : mesh_(mesh), owner_(std::move(owner)) {}
  /// A mesh that was moved from may be assigned to and destroyed alone.
  Mesh(Mesh&& other) noexcept : mesh_(std::exchange(other.mesh_, nullptr)), owner_(std::move(other.owner_)) {}
  Mesh& operator=(Mesh&& other) noexcept {
    std::swap(mesh_, other.mesh_);
    owner_.swap(other.owner_);
    return *this;
  }
  ~Mesh() {
    if (owner_ == nullptr) carreau_mesh_free(mesh_);
  }
  /// The handle of the C interface; it stays this object's.
  [[nodiscard]] carreau_mesh* get() const { return mesh_; }

  void read(const std::string& path) { done(carreau_mesh_read(mesh_, path.c_str())); }
  void write(const std::string& path) const { done(carreau_mesh_write(mesh_, path.c_str())); }
  /// The bytes that write() would put into a file with this suffix (".meshb"). For a part the bytes of this process, and zeros in place of
  /// the bytes of others.
  [[nodiscard]] std::string encode(const std::string& suffix) const {
    std::string bytes;
    const carreau_bytes_fn append = [](std::int64_t position, std::int64_t n, const void* part, void* user) -> std::int32_t {
      try {
        auto& all = *static_cast<std::string*>(user);
        all.resize(static_cast<std::size_t>(position));
        all.append(static_cast<const char*>(part), static_cast<std::size_t>(n));
        return 0;
      } catch (...) { // no memory
        return 1;
      }
    };
    done(carreau_mesh_encode(mesh_, suffix.c_str(), append, &bytes));
    return bytes;
  }
  void from_arrays(const MeshArrays& arrays) {
    if (!sizes_agree(arrays)) detail::fail(CARREAU_ERR_ARGUMENT, "The arrays of a mesh have numbers of rows that do not agree.");
    auto in = detail::sized<carreau_mesh_arrays>();
    in.dimension = 3;
    in.vertex_count = detail::count_of(arrays.vertices.size());
    in.triangle_count = detail::count_of(arrays.triangles.size());
    in.edge_count = detail::count_of(arrays.edges.size());
    in.vertices = detail::flat(arrays.vertices);
    in.triangles = detail::flat(arrays.triangles);
    in.edges = detail::flat(arrays.edges);
    in.vertex_refs = detail::data_or_null(arrays.vertex_refs);
    in.triangle_refs = detail::data_or_null(arrays.triangle_refs);
    in.edge_refs = detail::data_or_null(arrays.edge_refs);
    in.corner_uv = arrays.corner_uv.empty() ? nullptr : arrays.corner_uv.front().front().data();
    done(carreau_mesh_from_arrays(mesh_, &in));
  }

  /// Numbers of vertices, triangles and edges of curves.
  [[nodiscard]] std::int64_t vertex_count() const { return counts().vertices; }
  /// See vertex_count.
  [[nodiscard]] std::int64_t triangle_count() const { return counts().triangles; }
  /// See vertex_count.
  [[nodiscard]] std::int64_t edge_count() const { return counts().edges; }
  [[nodiscard]] int dimension() const {
    std::int32_t out = 0;
    done(carreau_mesh_dimension(mesh_, &out));
    return out;
  }
  /// Order of the elements: 1, 2, or, of a file, 3 or 4.
  [[nodiscard]] int order() const {
    std::int32_t out = 0;
    done(carreau_mesh_order(mesh_, &out));
    return out;
  }
  [[nodiscard]] std::vector<Point3> vertices() const {
    return rows<double, 3>(counts().vertices, carreau_mesh_vertices);
  }
  [[nodiscard]] std::vector<std::int32_t> vertex_refs() const {
    return values<std::int32_t>(counts().vertices, carreau_mesh_vertex_refs);
  }
  [[nodiscard]] std::vector<double> vertex_sizes() const {
    return values<double>(counts().vertices, carreau_mesh_vertex_sizes);
  }
  [[nodiscard]] std::vector<Triangle> triangles() const {
    return rows<std::int32_t, 3>(counts().triangles, carreau_mesh_triangles);
  }
  [[nodiscard]] std::vector<std::int32_t> triangle_refs() const {
    return values<std::int32_t>(counts().triangles, carreau_mesh_triangle_refs);
  }
  /// u, v of the three corners of each triangle: rows of 6.
  [[nodiscard]] std::vector<std::array<double, 6>> corner_uv() const {
    return rows<double, 6>(counts().triangles, carreau_mesh_corner_uv);
  }
  [[nodiscard]] std::vector<Triangle> corner_faces() const {
    return rows<std::int32_t, 3>(counts().triangles, carreau_mesh_corner_faces);
  }
  [[nodiscard]] std::vector<Edge> edges() const { return rows<std::int32_t, 2>(counts().edges, carreau_mesh_edges); }
  [[nodiscard]] std::vector<std::int32_t> edge_refs() const {
    return values<std::int32_t>(counts().edges, carreau_mesh_edge_refs);
  }
  [[nodiscard]] std::vector<std::int32_t> edge_mids() const {
    return values<std::int32_t>(counts().edges, carreau_mesh_edge_mids);
  }

  /// Nodes of an element of a kind, CARREAU_CELL_...
  static constexpr int nodes_of(int kind) { return kind == CARREAU_CELL_QUAD4 ? 4 : kind == CARREAU_CELL_QUAD8 ? 8 : 3 * kind; }
  [[nodiscard]] std::int64_t cell_count(int kind) const {
    std::int64_t out = 0;
    done(carreau_mesh_cell_count(mesh_, kind, &out));
    return out;
  }
  /// Nodes of all elements of a kind: nodes_of(kind) to an element.
  [[nodiscard]] std::vector<std::int32_t> cells(int kind) const {
    const std::int64_t n = cell_count(kind);
    std::vector<std::int32_t> out(static_cast<std::size_t>(n * nodes_of(kind)));
    if (n > 0) done(carreau_mesh_cells(mesh_, kind, n, out.data(), nullptr));
    return out;
  }
  /// References of the faces of all elements of a kind.
  [[nodiscard]] std::vector<std::int32_t> cell_refs(int kind) const {
    const std::int64_t n = cell_count(kind);
    std::vector<std::int32_t> nodes(static_cast<std::size_t>(n * nodes_of(kind))), out(static_cast<std::size_t>(n));
    if (n > 0) done(carreau_mesh_cells(mesh_, kind, n, nodes.data(), out.data()));
    return out;
  }
  /// u, v of all nodes, in the order of cells.
  [[nodiscard]] std::vector<Point2> cell_uv(int kind) const {
    const std::int64_t n = cell_count(kind);
    std::vector<Point2> out(static_cast<std::size_t>(n * nodes_of(kind)));
    if (n > 0) done(carreau_mesh_cell_uv(mesh_, kind, n, detail::flat(out)));
    return out;
  }
  /// References of the faces that cell_uv is of, of all nodes.
  [[nodiscard]] std::vector<std::int32_t> cell_faces(int kind) const {
    const std::int64_t n = cell_count(kind);
    std::vector<std::int32_t> out(static_cast<std::size_t>(n * nodes_of(kind)));
    if (n > 0) done(carreau_mesh_cell_faces(mesh_, kind, n, out.data()));
    return out;
  }

  /// Entities that periodicities carry onto each other: corners (dimension 0), curves (1), faces (2), with nodes {slave, master} from 0.
  struct PeriodicPair {
    int dimension = 2, slave = 0, master = 0;
    std::array<double, 12> transform{};  ///< of the master onto the slave, 3 x 4 row by row
    std::vector<std::array<std::int32_t, 2>> nodes = {};
  };
  [[nodiscard]] std::vector<PeriodicPair> periodic() const {
    std::int64_t pairs = 0, nodes = 0;
    done(carreau_mesh_periodic_count(mesh_, &pairs, &nodes));
    const auto n = static_cast<std::size_t>(pairs);
    std::vector<std::int32_t> dimensions(n), refs(2 * n), all(2 * static_cast<std::size_t>(nodes));
    std::vector<double> transforms(12 * n);
    std::vector<std::int64_t> counts(n);
    done(carreau_mesh_periodic(mesh_, pairs, nodes, dimensions.data(), refs.data(), transforms.data(), counts.data(), all.data()));
    std::vector<PeriodicPair> out(n);
    std::size_t next = 0;
    for (std::size_t i = 0; i < n; ++i) {
      out[i] = {dimensions[i], refs[2 * i], refs[2 * i + 1]};
      std::copy_n(transforms.begin() + static_cast<std::ptrdiff_t>(12 * i), 12, out[i].transform.begin());
      for (std::int64_t k = 0; k < counts[i]; ++k, next += 2) out[i].nodes.push_back({all[next], all[next + 1]});
    }
    return out;
  }

  /// Solids on both sides of a face by its reference: the solid that its triangles look out of, and the other solid; 0:
  /// none.
  [[nodiscard]] std::array<std::int32_t, 2> face_sides(int face) const {
    std::array<std::int32_t, 2> solids{};
    done(carreau_mesh_face_sides(mesh_, face, solids.data()));
    return solids;
  }
  /// The name of points (dimension 0), curves (1), a face (2) or a solid (3); "": none.
  [[nodiscard]] std::string entity_name(int dimension, int ref) const { return carreau_mesh_entity_name(mesh_, dimension, ref); }
  [[nodiscard]] std::vector<Face> faces() const {
    std::vector<Face> out;
    const std::int64_t n = counts().faces;
    for (std::int64_t i = 0; i < n; ++i) {
      auto face = detail::sized<carreau_face>();
      done(carreau_mesh_face(mesh_, i, &face));
      out.push_back({face.ref, face.status, face.triangles, face.why, face.name, face.rgb});
    }
    return out;
  }
  [[nodiscard]] carreau_quality quality() const { return filled(carreau_mesh_quality); }
  /// For a part: its counts, the quality of the whole mesh, and numbers of its vertices and triangles there.
  [[nodiscard]] carreau_part_counts part_counts() const { return filled(carreau_mesh_part_count); }
  [[nodiscard]] carreau_quality part_quality() const { return filled(carreau_mesh_part_quality); }
  [[nodiscard]] PartVertices part_vertices() const {
    PartVertices out;
    const auto n = static_cast<std::size_t>(counts().vertices);
    out.numbers.resize(n), out.owners.resize(n), out.rows.resize(n);
    done(carreau_mesh_part_vertices(mesh_, detail::count_of(n), out.numbers.data(), out.owners.data(), out.rows.data()));
    return out;
  }
  [[nodiscard]] PartTriangles part_triangles() const {
    PartTriangles out;
    const auto n = static_cast<std::size_t>(counts().triangles);
    out.numbers.resize(n), out.owners.resize(n);
    done(carreau_mesh_part_triangles(mesh_, detail::count_of(n), out.numbers.data(), out.owners.data()));
    return out;
  }
  [[nodiscard]] carreau_cell_quality cell_quality() const { return filled(carreau_mesh_cell_quality); }
  /// A sentence for each of the first `limit` defects; none: empty.
  [[nodiscard]] std::vector<std::string> defects(bool closed = false, std::int64_t limit = 100) const {
    std::int64_t count = 0;
    const char* text = "";
    done(carreau_mesh_defects(mesh_, closed ? 1 : 0, limit, &count, &text));
    std::vector<std::string> out;
    for (std::string_view left = text; !left.empty();) {
      const std::size_t end = left.find('\n');
      out.emplace_back(left.substr(0, end));
      left.remove_prefix(end == std::string_view::npos ? left.size() : end + 1);
    }
    return out;
  }
  /// Regions that the mesh bounds, with a point inside each; solid 0: a hole.
  [[nodiscard]] Regions regions() const {
    Regions out;
    std::int64_t count = 0;
    done(carreau_mesh_regions(mesh_, 0, &count, nullptr, nullptr));
    out.solids.resize(static_cast<std::size_t>(count));
    out.inside.resize(out.solids.size());
    done(carreau_mesh_regions(mesh_, count, &count, out.solids.data(), detail::flat(out.inside)));
    return out;
  }
  /// Solids on both sides of each triangle: the one that it looks out of, and the other one; 0: none.
  [[nodiscard]] std::vector<Edge> triangle_sides() const {
    std::int64_t m = 0;
    done(carreau_mesh_count(mesh_, nullptr, &m, nullptr, nullptr));
    std::vector<Edge> out(static_cast<std::size_t>(m));
    done(carreau_mesh_triangle_sides(mesh_, m, detail::flat(out)));
    return out;
  }
  /// At most `capacity` pairs; the count is of all.
  [[nodiscard]] Intersections intersections(std::int64_t capacity = 1000, int threads = 0) const {
    Intersections out;
    out.triangles.resize(static_cast<std::size_t>(capacity));
    out.places.resize(out.triangles.size());
    done(carreau_mesh_intersections(mesh_, threads, capacity, &out.count, detail::flat(out.triangles), detail::flat(out.places)));
    const auto known = static_cast<std::size_t>(std::min(capacity, out.count));
    out.triangles.resize(known);
    out.places.resize(known);
    return out;
  }
  /// Metrics of space at the vertices, from a .sol, .solb or .h.
  [[nodiscard]] std::vector<Tensor3> read_metrics(const std::string& sol_path) const {
    return rows<double, 6>(counts().vertices, [&](carreau_mesh* mesh, std::int64_t capacity, double* out) {
      return carreau_mesh_read_metrics(mesh, sol_path.c_str(), capacity, out);
    });
  }

  /// @cond INTERNAL For the other headers of this interface.
  /// Throws the error of a status of a call on this mesh.
  void done(carreau_status status) const {
    if (status != CARREAU_OK) detail::fail(status, carreau_mesh_last_error(mesh_));
  }
  /// Arrays by a function of the C interface that copies `n` rows.
  template <typename Number, typename Copy>
  [[nodiscard]] std::vector<Number> values(std::int64_t n, Copy&& copy) const {
    std::vector<Number> out(static_cast<std::size_t>(n));
    if (n > 0) done(copy(mesh_, n, out.data()));
    return out;
  }
  /// @endcond

 private:
  struct Counts {
    std::int64_t vertices = 0, triangles = 0, edges = 0, faces = 0;
  };

  [[nodiscard]] Counts counts() const {
    Counts out;
    done(carreau_mesh_count(mesh_, &out.vertices, &out.triangles, &out.edges, &out.faces));
    return out;
  }
  template <typename Number, std::size_t N, typename Copy>
  [[nodiscard]] std::vector<std::array<Number, N>> rows(std::int64_t n, Copy&& copy) const {
    std::vector<std::array<Number, N>> out(static_cast<std::size_t>(n));
    if (n > 0) done(copy(mesh_, n, detail::flat(out)));
    return out;
  }
  template <typename Struct>
  [[nodiscard]] Struct filled(carreau_status (*fill)(carreau_mesh*, Struct*)) const {
    auto out = detail::sized<Struct>();
    done(fill(mesh_, &out));
    return out;
  }
  static bool sizes_agree(const MeshArrays& arrays) {
    const auto fits = [](std::size_t n, std::size_t rows) { return n == 0 || n == rows; };
    return fits(arrays.vertex_refs.size(), arrays.vertices.size()) && fits(arrays.triangle_refs.size(), arrays.triangles.size()) &&
           fits(arrays.edge_refs.size(), arrays.edges.size()) && fits(arrays.corner_uv.size(), arrays.triangles.size());
  }

  carreau_mesh* mesh_ = nullptr;
  std::shared_ptr<void> owner_; ///< of a session's mesh
};

} // namespace carreau

#endif
