// SPDX-License-Identifier: BSD-3-Clause
// Loops that OpenCASCADE's readers cut open at a seam: their ends are two vertices at one place.
#pragma once

#include <TopTools_IndexedMapOfShape.hxx>
#include <vector>

namespace carreau_occ {

struct HostFace;

/// Merges vertices of a face where odd numbers of its curves end, and which are one within their tolerances. They
/// become the vertex of the smaller number, in all faces; the nearest first.
void close_torn_loops(std::vector<HostFace>& faces, const TopTools_IndexedMapOfShape& vertices);

}  // namespace carreau_occ
