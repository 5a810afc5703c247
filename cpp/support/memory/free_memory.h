// SPDX-License-Identifier: BSD-3-Clause
// Memory that a step has freed, and that no later step finds in one piece.
#pragma once

namespace carreau {

/// Returns the pages of freed memory to the system (with the GNU library; else does nothing). It takes as long as their next use takes to
/// clear them, so call it after hundreds of megabytes.
void return_free_memory() noexcept;

}  // namespace carreau
