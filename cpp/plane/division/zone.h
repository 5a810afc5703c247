// SPDX-License-Identifier: BSD-3-Clause
// The zone around separators, which is improved once more after the pieces have been joined.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plane/division/inner_edges.h"
#include "plane/division/near_separators.h"
#include "plane/division/pieces.h"
#include "plane/division/undivided.h"

namespace carreau::plane {

/// The input of the improvement of a zone.
struct ZoneContext {
  const PlaneDomain& domain;
  const InnerEdges& inner;  ///< of the domain
  const ControlSpace& metric;
  Field::Known known;
  const PlaneMesherOptions& options;
  Monitor& monitor;
};

/// Some layers of triangles on both sides of all separators. Vertices keep their numbers; removed vertices are in no
/// triangle.
struct Zone {
  std::vector<Vec2> vertices;
  std::vector<std::int32_t> whole;  ///< by vertex: its number in the whole mesh; fewer entries than vertices, new ones come last
  std::vector<std::uint8_t> fixed;  ///< by vertex: imposed, or on the rim of the zone
  std::vector<std::uint8_t> level;  ///< by vertex: layers from the separators; new vertices: zone_layers
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> band;  ///< by triangle: the separator that it belongs to; Pieces::several: several
};

struct MeshedPiece {
  UndividedMesh work;
  NearSeparators near;
};

/// The whole mesh before its zone is improved: vertices of the domain, vertices of separators, then vertices inside of
/// pieces.
struct JoinedPieces {
  const Pieces& pieces;
  std::span<const MeshedPiece> meshes;
  std::vector<std::int32_t> inside;  ///< by piece: its first vertex inside

  [[nodiscard]] const PlaneMesh& mesh(std::size_t piece) const noexcept { return meshes[piece].work.mesh; }
  [[nodiscard]] std::int32_t whole(std::size_t piece, std::int32_t v) const noexcept {
    const std::vector<std::int32_t>& shared = pieces.pieces[piece].whole;
    const auto n = static_cast<std::int32_t>(shared.size());
    return v < n ? shared[v] : inside[piece] + v - n;
  }
};

JoinedPieces join(const Pieces& pieces, std::span<const MeshedPiece> meshes);

/// The zone, improved: first the bands along separators, each separately, then the places at which several meet.
Zone improved_zone(const JoinedPieces& joined, const ZoneContext& context);

}  // namespace carreau::plane
