#include <cstring>
#include <limits>

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
  return 200 + vertex * mesh.vertices.size() + 16 * mesh.triangles.size() + 12 * mesh.edges.size();
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
  writer.section(GmfCode::vertices, 4 + mesh.vertices.size() * (8 * static_cast<std::size_t>(mesh.dimension) + 4));
  writer.integer(static_cast<std::int32_t>(mesh.vertices.size()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& p = mesh.vertices[i];
    writer.real(p.x());
    writer.real(p.y());
    if (mesh.dimension == 3) writer.real(p.z());
    writer.integer(ref_of(mesh.vertex_refs, i));
  }
  writer.entities(GmfCode::edges, mesh.edges, mesh.edge_refs);
  writer.entities(GmfCode::triangles, mesh.triangles, mesh.triangle_refs);
  writer.section(GmfCode::end, 0);
  return std::move(writer.bytes());
}

}  // namespace carreau
