// SPDX-License-Identifier: BSD-3-Clause
// The allowed loss of shapes by a collapse for its gain in lengths.
#pragma once

#include <cstdint>
#include <optional>

#include "surface/independent/base/free_mesh.h"

namespace carreau {

/// Returns the loss of shapes around a collapse, if the lengths that come into range justify it and the budget allows it (ShapeBudget);
/// otherwise nothing. `before`, `after`: the triangles around `gone` that stay. The two triangles that go count with the mean shape.
[[nodiscard]] std::optional<double> cost_of_collapse(const FreeMesh& mesh, std::int32_t gone, std::int32_t kept,
                                                     const TriangleShapes& before, const TriangleShapes& after);

}  // namespace carreau
