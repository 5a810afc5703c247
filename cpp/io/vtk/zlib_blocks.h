// SPDX-License-Identifier: BSD-3-Clause
// Compressed arrays of VTK XML files: blocks of zlib behind a header with their sizes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carreau {

/// The header: number of blocks, bytes of a whole block and of the last one (0: it is whole), compressed bytes of each.
struct ZlibBlocks {
  std::uint64_t block = 0, last = 0;
  std::vector<std::uint64_t> compressed;

  /// Numbers of a header before the numbers of the blocks.
  static constexpr std::size_t fixed_numbers = 3;
  /// `numbers`: the whole header.
  static ZlibBlocks of(std::span<const std::uint64_t> numbers);
  [[nodiscard]] std::uint64_t compressed_size() const noexcept;
  /// Size of block i after decompression.
  [[nodiscard]] std::uint64_t size_of(std::size_t i) const noexcept;
};

/// The content of the blocks. Throws std::runtime_error, with a part of a sentence, if they do not agree with the
/// header. `bytes`: of all blocks, one behind the other, as many as compressed_size().
std::string inflated(const ZlibBlocks& blocks, std::string_view bytes);

}  // namespace carreau
