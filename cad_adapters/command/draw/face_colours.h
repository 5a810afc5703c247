// SPDX-License-Identifier: BSD-3-Clause
// Colours of faces, and the lines between them, as pictures and reports show both.
#pragma once

#include <cstdint>
#include <map>
#include <unordered_set>

#include "draw/raster.h"
#include "files/mesh_file.h"

namespace command {

/// Of 0xRRGGBB.
Colour srgb(int hex);

/// Colour of faces without one, 0xRRGGBB.
inline constexpr int grey = 0xbcc6d2;

/// One number for the side between two vertices, whichever comes first.
std::uint64_t side_key(std::int32_t a, std::int32_t b);

/// Keys of the sides along curves: the edges of the mesh, or sides between two references when the file has no edges.
std::unordered_set<std::uint64_t> sides_on_curves(const MeshArrays& mesh);

/// A colour of the palette for each reference, in the order of their first triangle: the first one that no neighbour
/// over an edge has. If twelve neighbours have all colours, the rank decides.
std::map<std::int32_t, Colour> colours_of_references(const MeshArrays& mesh);

/// Colours of faces: their own when any face has one (grey for the others), else colours of the palette.
std::map<std::int32_t, Colour> colours_of_faces(const MeshArrays& mesh);

}  // namespace command
