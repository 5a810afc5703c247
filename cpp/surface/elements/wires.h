// SPDX-License-Identifier: BSD-3-Clause
// Curves that no face has, in meshes whose elements are made without them.
#pragma once

#include "surface/elements/work.h"

namespace carreau {

/// Makes two edges of each edge of a wire, at half its metric length, where all elements are cut.
void halve_wires(const ElementWork& work);

/// Gives each edge of a wire the node at half its metric length.
void give_nodes_to_wires(const ElementWork& work);

}  // namespace carreau
