// SPDX-License-Identifier: BSD-3-Clause
// Control spaces of small domains, for fields that are defined beyond them.
#pragma once

#include <optional>

#include "control_space/control_space.h"

namespace carreau {

/// Samples `sampler` at the nodes of an even grid over the box of `domain`, outside of the domain too: the field must be
/// smooth in the whole box, apart from kinks of sizes. A cell is about as wide as an edge of the mesh. Empty if the box is
/// many edges wide: there ControlSpace::build() takes fewer samples. Throws as ControlSpace::build().
std::optional<ControlSpace> build_even_space(const SampledDomain& domain, const MetricSampler& sampler, Monitor& monitor);

}  // namespace carreau
