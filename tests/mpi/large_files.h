// SPDX-License-Identifier: BSD-3-Clause
// Files of more than 2^32 bytes, of which only little is written, and data sent in pieces.
#pragma once

#include <string>

namespace mpi_tests {

/// The slices of ranks of files of up to 2^63 - 1 bytes.
bool all_slices_cover();
/// Each rank writes behind 2^32 bytes by the library's own function, and reads the bytes of all. Collective.
bool writes_beyond_32_bits(const std::string& path, int rank, int size);
/// Data longer than a count of MPI go in pieces, here of few bytes: they arrive whole, and nothing behind them. Collective.
bool sends_in_pieces(int rank, int size);

}  // namespace mpi_tests
