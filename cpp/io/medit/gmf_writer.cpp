// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <limits>

#include "io/element_lists.h"
#include "io/medit/gmf.h"
#include "io/mesh_writers.h"

namespace carreau {

namespace {

template <typename T>
void append_raw(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

class GmfWriter {
 public:
  explicit GmfWriter(int version) : sizes_(gmf_sizes(version)) {
    append_raw(bytes_, std::int32_t{1});
    append_raw(bytes_, std::int32_t{version});
  }

  /// Starts a section whose content, the count included, takes `content` bytes.
  void section(GmfCode code, std::size_t content) {
    append_raw(bytes_, static_cast<std::int32_t>(code));
    position(code == GmfCode::end ? 0 : bytes_.size() + sizes_.position + content);
  }

  void integer(std::int32_t value) { append_raw(bytes_, value); }
  void real(double value) { append_raw(bytes_, value); }

  template <std::size_t N>
  void entities(GmfCode code, const std::vector<std::array<std::int32_t, N>>& list,
                const std::vector<std::int32_t>& refs) {
    if (list.empty()) return;
    section(code, 4 + list.size() * 4 * (N + 1));
    integer(static_cast<std::int32_t>(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (const std::int32_t vertex : list[i]) integer(vertex + 1);
      integer(ref_of(refs, i));
    }
  }

  std::string& bytes() { return bytes_; }

 private:
  void position(std::size_t value) {
    if (sizes_.position == 4)
      append_raw(bytes_, static_cast<std::int32_t>(value));
    else
      append_raw(bytes_, static_cast<std::int64_t>(value));
  }

  GmfSizes sizes_;
  std::string bytes_;
};

std::size_t estimated_size(const FlatMesh& mesh) noexcept {
  const std::size_t vertex = 8 * static_cast<std::size_t>(mesh.dimension) + 4;
  // Of elements of second order no more than 40 bytes, and a vertex for a quadrilateral.
  return 300 + vertex * (mesh.vertices.size() + mesh.cells.size()) + 16 * mesh.triangles.size() +
         40 * mesh.cells.size() + 16 * mesh.edges.size();
}

}  // namespace

bool gmf_needs_64_bits(const FlatMesh& mesh) noexcept {
  return estimated_size(mesh) > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
}

std::string gmf_bytes(const FlatMesh& mesh, int version) {
  GmfWriter writer(version);
  writer.bytes().reserve(estimated_size(mesh));
  writer.section(GmfCode::dimension, 4);
  writer.integer(mesh.dimension);
  const MeditElements elements(mesh);
  const std::size_t vertices = mesh.vertices.size() + elements.centres.size();
  writer.section(GmfCode::vertices, 4 + vertices * (8 * static_cast<std::size_t>(mesh.dimension) + 4));
  writer.integer(static_cast<std::int32_t>(vertices));
  const auto add = [&](const Vec3& p, std::int32_t ref) {
    writer.real(p.x());
    writer.real(p.y());
    if (mesh.dimension == 3) writer.real(p.z());
    writer.integer(ref);
  };
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) add(mesh.vertices[i], ref_of(mesh.vertex_refs, i));
  for (const Vec3& centre : elements.centres) add(centre, 0);
  const ElementLists& lists = elements.lists;
  writer.entities(GmfCode::edges, lists.edges.nodes, lists.edges.refs);
  writer.entities(GmfCode::triangles, lists.triangles.nodes, lists.triangles.refs);
  writer.entities(GmfCode::quadrilaterals, lists.quads.nodes, lists.quads.refs);
  writer.entities(GmfCode::triangles_of_order_2, lists.triangles6.nodes, lists.triangles6.refs);
  writer.entities(GmfCode::edges_of_order_2, lists.edges3.nodes, lists.edges3.refs);
  writer.entities(GmfCode::quadrilaterals_of_order_2, elements.quads9.nodes, elements.quads9.refs);
  writer.section(GmfCode::end, 0);
  return std::move(writer.bytes());
}

}  // namespace carreau
