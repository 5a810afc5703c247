// SPDX-License-Identifier: BSD-3-Clause
// Triangles that cross, by the faces that they belong to.
#pragma once

#include <carreau.h>

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "files/mesh_file.h"

namespace command {

struct FaceCrossing {
  std::array<std::int32_t, 2> faces{};      ///< ascending; may be equal
  std::int64_t pairs = 0;                   ///< of triangles
  std::array<std::int32_t, 2> triangles{};  ///< of the first pair, from 0
  Point place{};                            ///< where those cross
};

struct Crossings {
  std::int64_t pairs = 0;           ///< of triangles, all
  std::int64_t triangles = 0;       ///< that cross others, of the first million of pairs
  std::vector<FaceCrossing> faces;  ///< of the first million of pairs; most pairs first
};

/// Asks carreau_mesh_intersections. `refs`: of the triangles. threads, 0: all processors. Throws Failure.
Crossings crossings_of(carreau_mesh* mesh, const std::vector<std::int32_t>& refs, int threads);
Crossings crossings_of(carreau_mesh* mesh, int threads);

/// "faces 27 and 59: 66 pairs of triangles cross, first triangles 12 and 40 at (1, 2, 3)": at most `most` such
/// sentences. A last sentence counts the others.
std::vector<std::string> sentences_of(const Crossings& crossings, std::size_t most);

/// "28 pairs of triangles cross"; "": none does.
std::string crossings_count(std::int64_t pairs);

nlohmann::ordered_json crossings_json(const Crossings& crossings);

}  // namespace command
