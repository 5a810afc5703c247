// SPDX-License-Identifier: BSD-3-Clause
// The slice of a file that belongs to a rank, and how many bytes are written and sent: positions and lengths have 64 bits,
// counts of MPI 32.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace carreau_mpi {

/// Bytes from `begin` to before `end`.
struct SliceRange {
  std::int64_t begin = 0, end = 0;
};

/// The slice of a rank when n bytes are cut into `size` slices that differ by one byte at most.
constexpr SliceRange slice_of(std::int64_t n, int rank, int size) noexcept {
  const auto first = [n, size](std::int64_t r) { return n / size * r + std::min<std::int64_t>(n % size, r); };
  return {first(rank), first(std::int64_t{rank} + 1)};
}

constexpr std::size_t most_of_a_call = std::size_t{1} << 30;

/// MPI_Bcast of n bytes, `most` at a time; MPI's own code. Collective.
inline int broadcast(MPI_Comm comm, int from, char* bytes, std::size_t n, std::size_t most = most_of_a_call) {
  for (std::size_t done = 0; done < n; done += most)
    if (const int code = MPI_Bcast(bytes + done, static_cast<int>(std::min(most, n - done)), MPI_BYTE, from, comm); code != MPI_SUCCESS)
      return code;
  return MPI_SUCCESS;
}

/// Writes n bytes at a position, `most` at a time. False: MPI has not written all of them.
inline bool write_at(MPI_File file, std::int64_t position, const char* bytes, std::size_t n,
                     std::size_t most = most_of_a_call) {
  for (std::size_t done = 0; done < n; done += most) {
    const int count = static_cast<int>(std::min(most, n - done));
    MPI_Status status;
    int written = 0;
    if (MPI_File_write_at(file, static_cast<MPI_Offset>(position) + static_cast<MPI_Offset>(done), bytes + done, count, MPI_BYTE,
                          &status) != MPI_SUCCESS)
      return false;
    MPI_Get_count(&status, MPI_BYTE, &written);
    if (written != count) return false;
  }
  return true;
}

}  // namespace carreau_mpi
