// SPDX-License-Identifier: BSD-3-Clause
// Internal curves as cracks: each side has vertices of its own (RT-0232 sec. 2.1).
#pragma once

#include "surface/result.h"

namespace carreau {

/// Cuts the mesh open along the edges of internal curves. A vertex around which triangles fall into several parts
/// becomes one for each part, the first of which keeps it: the tip of a crack inside a face stays one vertex, its mouth on
/// a border and places where cracks meet do not. A curve becomes two, of one reference: the one on the left of its first
/// use keeps its place, the others follow behind all curves. New vertices follow those before, with their references and
/// sizes; places in (u, v) stay. Elements of any kind. The mesh stays as it is where there is no internal curve.
void open_cracks(CompositeResult& result);

}  // namespace carreau
