// SPDX-License-Identifier: BSD-3-Clause
#include "large_files.h"

#include <fcntl.h>
#include <mpi.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "../../cabi/mpi/src/slices.h"

namespace mpi_tests {

namespace {

using carreau_mpi::slice_of;

constexpr std::int64_t beyond = (std::int64_t{1} << 32) + 12345;

/// Slices lie one behind the other, from 0 to n, and differ by one byte at most.
bool slices_cover(std::int64_t n, int size) {
  std::int64_t end = 0;
  for (int rank = 0; rank < size; ++rank) {
    const auto [begin, next] = slice_of(n, rank, size);
    if (begin != end || next - begin < n / size || next - begin > n / size + 1) return false;
    end = next;
  }
  return end == n;
}

}  // namespace

bool all_slices_cover() {
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t n : {std::int64_t{0}, std::int64_t{5}, (std::int64_t{1} << 31) - 1, std::int64_t{1} << 31, beyond, std::int64_t{7} << 40, most})
    for (const int size : {1, 2, 3, 7, 1000, 65536})
      if (!slices_cover(n, size)) return false;
  return true;
}

// A hole of four GiB takes no room.
bool writes_beyond_32_bits(const std::string& path, int rank, int size) {
  constexpr std::int64_t each = 1000;
  const std::string mine(static_cast<std::size_t>(each), static_cast<char>('a' + rank % 26));
  MPI_File file = MPI_FILE_NULL;
  if (MPI_File_open(MPI_COMM_WORLD, path.c_str(), MPI_MODE_WRONLY | MPI_MODE_CREATE, MPI_INFO_NULL, &file) != MPI_SUCCESS) return false;
  constexpr std::size_t at_once = 77;  // many calls, the last one with the rest
  const bool written = carreau_mpi::write_at(file, beyond + rank * each, mine.data(), mine.size(), at_once);
  MPI_File_close(&file);
  MPI_Barrier(MPI_COMM_WORLD);
  struct stat status {};
  const int opened = open(path.c_str(), O_RDONLY);
  std::string found(static_cast<std::size_t>(each) * static_cast<std::size_t>(size), 0);
  const bool read = pread(opened, found.data(), found.size(), beyond) == static_cast<ssize_t>(found.size());
  const bool sparse = fstat(opened, &status) == 0 && status.st_size == beyond + size * each && status.st_blocks * 512 < (1 << 24);
  close(opened);
  bool same = true;
  for (std::size_t i = 0; i < found.size(); ++i)
    same = same && found[i] == static_cast<char>('a' + static_cast<int>(i / static_cast<std::size_t>(each)) % 26);
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank == 0) unlink(path.c_str());
  return written && read && sparse && same;
}

bool sends_in_pieces(int rank, int size) {
  constexpr std::size_t each = 1000, guard = 9;
  bool same = true;
  for (const std::size_t most : {std::size_t{1}, std::size_t{77}, std::size_t{500}, each, 2 * each})
    for (int from = 0; from < size; ++from) {
      std::string bytes(each + guard, '?');
      const auto wanted = [&](std::size_t i) { return static_cast<char>((i * 31 + static_cast<std::size_t>(from)) % 251); };
      if (rank == from)
        for (std::size_t i = 0; i < each; ++i) bytes[i] = wanted(i);
      same = carreau_mpi::broadcast(MPI_COMM_WORLD, from, bytes.data(), each, most) == MPI_SUCCESS && same;
      for (std::size_t i = 0; i < bytes.size(); ++i) same = same && bytes[i] == (i < each ? wanted(i) : '?');
    }
  return same;
}

}  // namespace mpi_tests
