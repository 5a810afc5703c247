// SPDX-License-Identifier: BSD-3-Clause
// Growth from short edges of a boundary, as far as a control space can follow it.
#pragma once

#include <optional>

#include "gradation/edge_sizes.h"
#include "surface/sample/face_sampling.h"

namespace carreau {

/// `space` is that of `input`, whose sizes grow from input.limits.edges. A parametrisation may leave a tiny edge so
/// little room in (u, v), beside the pole of a cone say, that samples miss most of the growth: the space then promises
/// a hundred times as many triangles as growth ever makes. Such sizes are raised, by eight as often as necessary,
/// until the space promises no more than twice what the sizes without growth and the growth in a plane ask for.
/// Returns what bounds sizes now and replaces `space`, which obeys them; empty: nothing had to be done. Evaluates the
/// face again only where the space promises many triangles. Throws what the host throws, and Cancelled.
std::optional<EdgeSizes> bound_growth(const PatchInput& input, Cad& cad, const SizeRules& rules,
                                      std::span<const Vec2> probe_points, Monitor& monitor, ControlSpace& space,
                                      Team* team = nullptr);

}  // namespace carreau
