// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstring>
#include <string>
#include <string_view>

#include "io/element_lists.h"
#include "io/files.h"
#include "io/medit/gmf.h"
#include "io/medit/surface_file.h"
#include "io/mesh_writers.h"

namespace carreau {

namespace {

/// Bytes reach the sink in blocks: the whole file is never in memory.
class GmfWriter {
 public:
  GmfWriter(int version, const ByteSink& sink) : version_(version), sink_(sink) {
    block_.resize(block_size);
    append(std::int32_t{1});
    append(std::int32_t{version});
  }

  /// Starts a section of `count` records of `record` bytes each.
  void section(GmfCode code, std::size_t count, std::size_t record) {
    const std::uint64_t next = gmf_next(written_ + used_, version_, count, record);
    append(static_cast<std::int32_t>(code));
    position(next);
    append(static_cast<std::int32_t>(count));
  }
  void dimension(int value) {
    const std::uint64_t next = gmf_next(written_ + used_, version_, 0, 0);
    append(static_cast<std::int32_t>(GmfCode::dimension));
    position(next);
    append(std::int32_t{value});
  }
  void end() {
    append(static_cast<std::int32_t>(GmfCode::end));
    position(0);
    flush();
  }

  template <std::size_t N>
  void entities(GmfCode code, const std::vector<std::array<std::int32_t, N>>& list,
                const std::vector<std::int32_t>& refs) {
    if (list.empty()) return;
    section(code, list.size(), 4 * (N + 1));
    std::array<std::int32_t, N + 1> record;
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (std::size_t k = 0; k < N; ++k) record[k] = list[i][k] + 1;
      record[N] = ref_of(refs, i);
      append(record);
    }
  }

  void vertex(const Vec3& p, std::int32_t ref, int dimension) {
    if (dimension == 3)
      append(std::array<double, 3>{p.x(), p.y(), p.z()});
    else
      append(std::array<double, 2>{p.x(), p.y()});
    append(ref);
  }

  template <typename T>
  void append(T value) {
    if (used_ + sizeof value > block_size) flush();
    std::memcpy(block_.data() + used_, &value, sizeof value);
    used_ += sizeof value;
  }

 private:
  static constexpr std::size_t block_size = std::size_t{1} << 20;

  void position(std::uint64_t value) {
    if (gmf_sizes(version_).position == 4)
      append(static_cast<std::int32_t>(value));
    else
      append(static_cast<std::int64_t>(value));
  }
  void flush() {
    sink_(std::string_view(block_).substr(0, used_));
    written_ += used_;
    used_ = 0;
  }

  int version_;
  const ByteSink& sink_;
  std::string block_;
  std::size_t used_ = 0;  // bytes of the block
  std::uint64_t written_ = 0;
};

GmfCounts counts_of(const FlatMesh& mesh) noexcept {
  return {.dimension = mesh.dimension,
          .vertices = mesh.vertices.size(),
          .triangles = mesh.triangles.size(),
          .edges = mesh.edges.size(),
          .cells = mesh.cells.size()};
}

constexpr std::size_t on_point_bytes = 8, on_curve_bytes = 24, on_face_bytes = 32;

std::uint64_t bytes_of(const MeshAssociation& association, const FlatMesh& mesh) noexcept {
  constexpr std::uint64_t headers = 4 * 20;
  return headers + on_point_bytes * (association.points.size() + mesh.edges.size()) + on_curve_bytes * association.curves.size() +
         on_face_bytes * association.faces.size();
}

/// Records as libMeshb has them: vertex, entity, parameters, distance from it.
void write_association(const MeshAssociation& association, const ElementList<2>& edges, GmfWriter& writer) {
  const auto entity = [&](std::size_t index, std::int32_t ref) { writer.append(std::array{static_cast<std::int32_t>(index) + 1, ref}); };
  if (!association.points.empty()) writer.section(GmfCode::vertices_on_points, association.points.size(), on_point_bytes);
  for (const MeshAssociation::OnPoint& on : association.points) entity(on.node, on.ref);
  if (!association.curves.empty()) writer.section(GmfCode::vertices_on_curves, association.curves.size(), on_curve_bytes);
  for (const MeshAssociation::OnCurve& on : association.curves) entity(on.node, on.ref), writer.append(std::array{on.t, 0.0});
  if (!association.faces.empty()) writer.section(GmfCode::vertices_on_faces, association.faces.size(), on_face_bytes);
  for (const MeshAssociation::OnFace& on : association.faces) entity(on.node, on.ref), writer.append(std::array{on.uv.x(), on.uv.y(), 0.0});
  if (!edges.nodes.empty()) writer.section(GmfCode::edges_on_curves, edges.nodes.size(), on_point_bytes);
  for (std::size_t e = 0; e < edges.nodes.size(); ++e) entity(e, edges.refs[e]);
}

}  // namespace

bool gmf_needs_64_bits(const FlatMesh& mesh, const MeshAssociation* association) noexcept {
  return gmf_needs_64_bits(counts_of(mesh), association != nullptr ? bytes_of(*association, mesh) : 0);
}

std::string gmf_bytes(const FlatMesh& mesh, int version, const MeshAssociation* association) {
  std::string bytes;
  bytes.reserve(gmf_most_bytes(counts_of(mesh)) + (association != nullptr ? bytes_of(*association, mesh) : 0));
  write_gmf(mesh, version, association, [&](std::string_view block) { bytes += block; });
  return bytes;
}

void write_surface(const SurfaceMesh& mesh, const FlatMesh& frame, const std::string& path) {
  const GmfCounts counts{
      .dimension = frame.dimension, .vertices = mesh.vertices.size(), .triangles = mesh.triangle_count(), .edges = frame.edges.size(), .cells = 0};
  NewFile file(path);
  std::uint64_t at = 0;
  const ByteSink sink = [&](std::string_view block) { file.write_at(at, block), at += block.size(); };
  GmfWriter writer(gmf_needs_64_bits(counts) ? 3 : 2, sink);
  writer.dimension(frame.dimension);
  writer.section(GmfCode::vertices, counts.vertices, 8 * static_cast<std::size_t>(frame.dimension) + 4);
  for (std::size_t v = 0; v < counts.vertices; ++v) writer.vertex(mesh.vertices[v], ref_of(frame.vertex_refs, v), frame.dimension);
  writer.entities(GmfCode::edges, frame.edges, frame.edge_refs);
  if (counts.triangles > 0) writer.section(GmfCode::triangles, counts.triangles, 16);
  for (const FaceMesh& face : mesh.faces) {
    const std::int32_t ref = face.shown_ref();
    for (const auto& [a, b, c] : face.triangles) writer.append(std::array{face.vertex[a] + 1, face.vertex[b] + 1, face.vertex[c] + 1, ref});
  }
  writer.end();
  file.commit();
}

void write_gmf(const FlatMesh& mesh, int version, const MeshAssociation* association, const ByteSink& sink) {
  GmfWriter writer(version, sink);
  writer.dimension(mesh.dimension);
  const MeditElements elements(mesh);
  writer.section(GmfCode::vertices, mesh.vertices.size() + elements.centres.size(),
                 8 * static_cast<std::size_t>(mesh.dimension) + 4);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) writer.vertex(mesh.vertices[i], ref_of(mesh.vertex_refs, i), mesh.dimension);
  for (const Vec3& centre : elements.centres) writer.vertex(centre, 0, mesh.dimension);
  const ElementLists& lists = elements.lists;
  writer.entities(GmfCode::edges, lists.edges.nodes, lists.edges.refs);
  writer.entities(GmfCode::triangles, elements.triangles, elements.triangle_refs);
  writer.entities(GmfCode::quadrilaterals, lists.quads.nodes, lists.quads.refs);
  writer.entities(GmfCode::triangles_of_order_2, lists.triangles6.nodes, lists.triangles6.refs);
  writer.entities(GmfCode::edges_of_order_2, lists.edges3.nodes, lists.edges3.refs);
  writer.entities(GmfCode::quadrilaterals_of_order_2, elements.quads9.nodes, elements.quads9.refs);
  if (association != nullptr) write_association(*association, lists.edges, writer);
  writer.end();
}

}  // namespace carreau
