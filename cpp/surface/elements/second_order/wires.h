// SPDX-License-Identifier: BSD-3-Clause
// Free curves, in meshes whose elements are made without them.
#pragma once

#include "surface/elements/base/work.h"

namespace carreau {

/// Halves each edge of a free curve at half its metric length, if all elements are cut.
void halve_wires(const ElementWork& work);

/// Gives each edge of a free curve the node at half its metric length.
void give_nodes_to_wires(const ElementWork& work);

}  // namespace carreau
