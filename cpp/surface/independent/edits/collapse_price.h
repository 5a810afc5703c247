// SPDX-License-Identifier: BSD-3-Clause
// What a collapse may cost in shapes for what it gains in lengths.
#pragma once

#include <cstdint>
#include <optional>

#include "surface/independent/base/free_mesh.h"

namespace carreau {

/// What shapes around lose by a collapse, if the lengths that come into range are worth it and there is as much left (ShapeBudget); else none. `before`, `after`:
/// the triangles around `gone` that stay. The two that go count as triangles of the mean each would.
[[nodiscard]] std::optional<double> cost_of_collapse(const FreeMesh& mesh, std::int32_t gone, std::int32_t kept,
                                                     const TriangleShapes& before, const TriangleShapes& after);

}  // namespace carreau
