// SPDX-License-Identifier: BSD-3-Clause
// Internal curves as cracks: each side has its own vertices (RT-0232 sec. 2.1).
#pragma once

#include "surface/result.h"

namespace carreau {

/// Cuts the mesh open along the edges of internal curves. If the triangles around a vertex fall into several parts, each part gets a
/// vertex, and the first part keeps the old vertex. The tip of a crack inside a face stays one vertex. Its mouth on a border and places
/// where cracks meet are divided. A curve becomes two curves with its reference. The curve on the left of its first use keeps the index,
/// the others follow behind all curves. New vertices follow the old ones, with their references and sizes; places in (u, v) stay. Elements
/// of any kind. A mesh without internal curves stays as it is.
void open_cracks(CompositeResult& result);

}  // namespace carreau
