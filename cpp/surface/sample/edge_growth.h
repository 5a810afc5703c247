// SPDX-License-Identifier: BSD-3-Clause
// Limits growth from short edges of a boundary to the resolution of a control space.
#pragma once

#include <optional>

#include "gradation/edge_sizes.h"
#include "surface/sample/face_sampling.h"

namespace carreau {

/// `space` belongs to `input`, whose sizes grow from input.limits.edges. A parametrisation may leave a tiny edge very
/// little room in (u, v), for example beside the pole of a cone. Samples then miss most of the growth. The space
/// promises a hundred times as many triangles as growth ever makes. Such sizes are raised, by eight as often as
/// necessary, until the number of triangles is acceptable. The limit is twice the number for the sizes without growth
/// and for growth in a plane. Returns the new bounds of sizes and replaces `space`, which obeys them; empty if all was
/// well. Evaluates the face again only if the space promises many triangles. Throws the exceptions of the host, and
/// Cancelled.
std::optional<EdgeSizes> bound_growth(const PatchInput& input, Cad& cad, const SizeRules& rules,
                                      std::span<const Vec2> probe_points, Monitor& monitor, ControlSpace& space);

}  // namespace carreau
