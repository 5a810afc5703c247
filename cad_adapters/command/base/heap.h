// SPDX-License-Identifier: BSD-3-Clause
// The memory that this program's arrays come from.
#pragma once

namespace command {

/// Makes glibc keep freed memory instead of returning it to Linux, and requests large pages: each new page of 4 KiB
/// costs a fault. Call it before the first large allocation. Does nothing with another C library. The library itself
/// does not change the settings of its host's memory.
void prepare_heap();

/// Returns free memory to the system when there is much of it: the pieces of a large face, before its whole mesh is put
/// together.
void give_back_heap();

}  // namespace command
