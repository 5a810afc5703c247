// SPDX-License-Identifier: BSD-3-Clause
// The bytes of a part of a mesh in the binary file of the whole mesh.
#include <algorithm>
#include <cstring>
#include <limits>

#include "io/medit/gmf.h"
#include "io/medit/part_files.h"
#include "support/error.h"

namespace carreau {

namespace {

/// Joins consecutive pieces, up to a block.
class PositionedWriter {
 public:
  explicit PositionedWriter(const PositionedSink& sink) : sink_(sink) { block_.reserve(block_size); }
  ~PositionedWriter() = default;
  PositionedWriter(const PositionedWriter&) = delete;
  PositionedWriter& operator=(const PositionedWriter&) = delete;

  void go_to(std::uint64_t position) {
    if (position == begin_ + block_.size()) return;
    flush();
    begin_ = position;
  }
  template <typename T>
  void append(T value) {
    if (block_.size() + sizeof value > block_size) flush();
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    block_.append(raw, sizeof value);
  }
  void flush() {
    if (!block_.empty()) sink_(begin_, block_);
    begin_ += block_.size();
    block_.clear();
  }

 private:
  static constexpr std::size_t block_size = std::size_t{1} << 20;

  const PositionedSink& sink_;
  std::string block_;
  std::uint64_t begin_ = 0;
};

/// The sections of the whole file, as write_gmf() puts them.
class GmfFile {
 public:
  GmfFile(const PartMesh& part, const FlatMesh& mesh, const PositionedSink& sink)
      : part_(part),
        mesh_(mesh),
        version_(version_of(part, mesh.dimension)),
        sizes_(gmf_sizes(version_)),
        vertex_size_(8 * static_cast<std::uint64_t>(mesh.dimension) + sizes_.index),
        writer_(sink) {}

  void write() {
    // The number 1, the version, and the section of the dimension.
    const std::uint64_t vertices = 8 + 8 + sizes_.position;
    const std::uint64_t edges = gmf_next(vertices, version_, count(part_.vertices), vertex_size_);
    const std::uint64_t of_edges = 3 * sizes_.index, of_triangles = 4 * sizes_.index;
    const std::uint64_t triangles = part_.file_edges == 0 ? edges : gmf_next(edges, version_, count(part_.file_edges), of_edges);
    const std::uint64_t end = part_.triangles == 0 ? triangles : gmf_next(triangles, version_, count(part_.triangles), of_triangles);
    const bool first = part_.rank == 0;
    if (first) begin_file(vertices);
    if (first) begin_section(GmfCode::vertices, vertices, edges, part_.vertices);
    write_vertices(vertices);
    if (first && part_.file_edges > 0) {
      begin_section(GmfCode::edges, edges, triangles, part_.file_edges);
      write_edges();
    }
    if (first && part_.triangles > 0) begin_section(GmfCode::triangles, triangles, end, part_.triangles);
    write_triangles(triangles, of_triangles);
    if (first) end_file(end);
    writer_.flush();
  }

 private:
  static std::uint64_t count(std::int64_t n) noexcept { return static_cast<std::uint64_t>(n); }
  static int version_of(const PartMesh& part, int dimension) noexcept {
    if (std::max(part.vertices, part.triangles) > std::numeric_limits<std::int32_t>::max()) return 4;
    const GmfCounts counts{.dimension = dimension,
                           .vertices = count(part.vertices),
                           .triangles = count(part.triangles),
                           .edges = count(part.file_edges),
                           .cells = 0};
    return gmf_needs_64_bits(counts) ? 3 : 2;
  }

  void number(std::size_t size, std::uint64_t value) {
    if (size == 4)
      writer_.append(static_cast<std::int32_t>(value));
    else
      writer_.append(static_cast<std::int64_t>(value));
  }
  void index(std::int64_t value) { number(sizes_.index, static_cast<std::uint64_t>(value)); }

  void begin_file(std::uint64_t next) {
    writer_.go_to(0);
    writer_.append(std::int32_t{1});
    writer_.append(static_cast<std::int32_t>(version_));
    writer_.append(static_cast<std::int32_t>(GmfCode::dimension));
    number(sizes_.position, next);
    writer_.append(static_cast<std::int32_t>(mesh_.dimension));
  }
  void begin_section(GmfCode code, std::uint64_t at, std::uint64_t next, std::int64_t entities) {
    writer_.go_to(at);
    writer_.append(static_cast<std::int32_t>(code));
    number(sizes_.position, next);
    number(sizes_.count, count(entities));
  }
  [[nodiscard]] std::uint64_t records_of(std::uint64_t section) const noexcept { return section + 4 + sizes_.position + sizes_.count; }
  void end_file(std::uint64_t at) {
    writer_.go_to(at);
    writer_.append(static_cast<std::int32_t>(GmfCode::end));
    number(sizes_.position, 0);
  }

  void write_vertices(std::uint64_t section) {
    for (std::size_t v = 0; v < count(part_.own_vertices); ++v) {
      writer_.go_to(records_of(section) + count(part_.vertex_number[v]) * vertex_size_);
      const Vec3& p = mesh_.vertices[v];
      writer_.append(p.x());
      writer_.append(p.y());
      if (mesh_.dimension == 3) writer_.append(p.z());
      index(mesh_.vertex_refs[v]);
    }
  }
  void write_edges() {
    for (std::size_t e = 0; e < part_.file_edge_vertices.size(); ++e) {
      for (const std::int32_t v : part_.file_edge_vertices[e]) index(std::int64_t{v} + 1);
      index(part_.file_edge_refs[e]);
    }
  }
  void write_triangles(std::uint64_t section, std::uint64_t size) {
    for (std::size_t t = 0; t < count(part_.own_triangles); ++t) {
      writer_.go_to(records_of(section) + count(part_.triangle_number[t]) * size);
      for (const std::int32_t v : mesh_.triangles[t]) index(part_.vertex_number[static_cast<std::size_t>(v)] + 1);
      index(mesh_.triangle_refs[t]);
    }
  }

  const PartMesh& part_;
  const FlatMesh& mesh_;
  int version_;
  GmfSizes sizes_;
  std::uint64_t vertex_size_;
  PositionedWriter writer_;
};

}  // namespace

void write_part(const PartMesh& part, const FlatMesh& mesh, MeshFormat format, const PositionedSink& sink) {
  if (format != MeshFormat::meshb)
    throw InvalidArgument("a mesh that several processes keep in parts is written to .meshb only, of the formats of one file");
  for (std::size_t v = 0; v < static_cast<std::size_t>(part.own_vertices); ++v)
    if (!is_finite(mesh.vertices[v]))
      throw InvalidArgument("a mesh cannot be written: vertex " + std::to_string(part.vertex_number[v]) +
                            " (from 0) has a coordinate that is not finite");
  if (!mesh.cells.empty())
    sink(part.begin_in_file, part.bytes_of_file);
  else
    GmfFile(part, mesh, sink).write();
}

}  // namespace carreau
