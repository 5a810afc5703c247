// SPDX-License-Identifier: BSD-3-Clause
// Files of more than 2^32 bytes, of which only little is written, and what is sent in pieces.
#pragma once

#include <string>

namespace mpi_tests {

/// What ranks have of files of up to 2^63 - 1 bytes.
bool all_slices_cover();
/// Each rank writes behind 2^32 bytes by the library's own function, and reads what all have written. By all ranks.
bool writes_beyond_32_bits(const std::string& path, int rank, int size);
/// What is longer than a count of MPI goes in pieces, here of few bytes: it arrives whole, and nothing behind it. By all ranks.
bool sends_in_pieces(int rank, int size);

}  // namespace mpi_tests
