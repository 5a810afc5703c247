// SPDX-License-Identifier: BSD-3-Clause
// The memory that this program's arrays come from.
#pragma once

namespace command {

/// Before anything large is allocated: lets glibc keep what is freed instead of giving it back and asking again, and asks
/// Linux for large pages there. Each new page of 4 KiB costs a fault (docs/scale.md).
/// Does nothing with another C library. The library itself leaves its host's memory alone.
void prepare_heap();

/// Gives back what is free when that is much: the pieces of a large face, before its whole mesh is put together.
void give_back_heap();

}  // namespace command
