// SPDX-License-Identifier: BSD-3-Clause
// What a collapse may cost in shapes for what it gains in lengths.
#pragma once

#include <cstdint>

#include "surface/independent/free_mesh.h"

namespace carreau {

/// Whether shapes around lose more by a collapse than the lengths that come into range are worth (SurfaceTolerances). `before`, `after`: the triangles around `gone` that stay. The two that go count as triangles of
/// `good_shape` each would: a mesh with fewer good triangles is no better for it.
[[nodiscard]] bool costs_too_much(const FreeMesh& mesh, std::int32_t gone, std::int32_t kept,
                                  const TriangleShapes& before, const TriangleShapes& after);

}  // namespace carreau
