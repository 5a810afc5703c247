// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstring>

#include "io/element_lists.h"
#include "io/medit/gmf.h"
#include "io/mesh_writers.h"

namespace carreau {

namespace {

/// Bytes reach the sink in blocks: the whole file is never in memory.
class GmfWriter {
 public:
  GmfWriter(int version, const ByteSink& sink) : version_(version), sink_(sink) {
    block_.reserve(block_size);
    append(std::int32_t{1});
    append(std::int32_t{version});
  }

  /// Starts a section of `count` records of `record` bytes each.
  void section(GmfCode code, std::size_t count, std::size_t record) {
    const std::uint64_t next = gmf_next(written_ + block_.size(), version_, count, record);
    append(static_cast<std::int32_t>(code));
    position(next);
    append(static_cast<std::int32_t>(count));
  }
  void dimension(int value) {
    const std::uint64_t next = gmf_next(written_ + block_.size(), version_, 0, 0);
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

  template <typename T>
  void append(T value) {
    if (block_.size() + sizeof value > block_size) flush();
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    block_.append(raw, sizeof value);
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
    sink_(block_);
    written_ += block_.size();
    block_.clear();
  }

  int version_;
  const ByteSink& sink_;
  std::string block_;
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

void write_gmf(const FlatMesh& mesh, int version, const MeshAssociation* association, const ByteSink& sink) {
  GmfWriter writer(version, sink);
  writer.dimension(mesh.dimension);
  const MeditElements elements(mesh);
  writer.section(GmfCode::vertices, mesh.vertices.size() + elements.centres.size(),
                 8 * static_cast<std::size_t>(mesh.dimension) + 4);
  const auto add = [&](const Vec3& p, std::int32_t ref) {
    if (mesh.dimension == 3)
      writer.append(std::array<double, 3>{p.x(), p.y(), p.z()});
    else
      writer.append(std::array<double, 2>{p.x(), p.y()});
    writer.append(ref);
  };
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) add(mesh.vertices[i], ref_of(mesh.vertex_refs, i));
  for (const Vec3& centre : elements.centres) add(centre, 0);
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
