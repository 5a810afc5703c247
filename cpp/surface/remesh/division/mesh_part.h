// SPDX-License-Identifier: BSD-3-Clause
// Some triangles of a cross-patch mesh that one executor edits by itself.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/editable_mesh.h"
#include "support/ranks/packet.h"
#include "surface/remesh/edits/remeshing.h"
#include "surface/surface_place.h"

namespace carreau {

class CrossPatchMesh;

/// The part of each triangle of a mesh.
struct Division {
  static constexpr std::int32_t none = -1;
  std::vector<std::vector<std::int32_t>> parts;  ///< triangles, ascending
  std::vector<std::int32_t> part;                ///< by triangle

  Division(std::vector<std::vector<std::int32_t>> of_parts, std::size_t triangles);
  /// Vertices where parts of this division meet, ascending.
  [[nodiscard]] std::vector<std::int32_t> meeting(const CrossPatchMesh& mesh) const;
};

/// The triangles of a part, and triangles beyond with a corner on its border. The latter stay, and so do all vertices that do not belong to
/// the part alone.
struct MeshPart {
  std::vector<std::int32_t> vertex;  ///< numbers in the whole mesh, ascending
  std::vector<char> frozen;          ///< by vertex
  std::vector<EditableMesh::Triangle> triangles, beyond;

  MeshPart(const CrossPatchMesh& whole, const Division& division, std::int32_t part);
  /// Returns the local numbers of the vertices that are here, ascending.
  [[nodiscard]] std::vector<std::int32_t> local(std::span<const std::int32_t> vertices) const;
  /// Local number of a vertex of the whole mesh; -1: it is not here.
  [[nodiscard]] std::int32_t local(std::int32_t v) const;
};

/// The result of a part.
struct EditedPart {
  /// Corners are vertices of the whole mesh; numbers from its number of vertices on are new vertices.
  std::vector<EditableMesh::Triangle> triangles;
  std::vector<std::int32_t> moved;   ///< vertices of the whole mesh that are elsewhere
  std::vector<SurfacePlace> places;  ///< of the moved vertices, and behind them of the new ones
  RemeshingReport report;
  double cost = 0;                   ///< to shapes (ShapeBudget), where that is limited

  EditedPart() = default;
  /// `edited`: made of `part`.
  EditedPart(const CrossPatchMesh& whole, const MeshPart& part, const CrossPatchMesh& edited, const RemeshingReport& report);

  /// Converts to bytes for another process, and back. The second function throws Error for bytes that do not hold a
  /// part.
  void put(PacketWriter& packet) const;
  static EditedPart from(PacketReader& packet);
};

}  // namespace carreau
