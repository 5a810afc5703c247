// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtk/zlib_blocks.h"

#include <zlib.h>

#include <numeric>
#include <stdexcept>

namespace carreau {

namespace {
// No zlib stream holds more than this for each of its bytes: larger claims are rejected.
constexpr std::uint64_t best_ratio = 1032;
}  // namespace

ZlibBlocks ZlibBlocks::of(std::span<const std::uint64_t> numbers) {
  ZlibBlocks blocks{.block = numbers[1], .last = numbers[2], .compressed = {}};
  blocks.compressed.assign(numbers.begin() + fixed_numbers, numbers.end());
  return blocks;
}

std::uint64_t ZlibBlocks::compressed_size() const noexcept {
  return std::accumulate(compressed.begin(), compressed.end(), std::uint64_t{0});
}

std::uint64_t ZlibBlocks::size_of(std::size_t i) const noexcept {
  return i + 1 == compressed.size() && last != 0 ? last : block;
}

std::string inflated(const ZlibBlocks& blocks, std::string_view bytes) {
  std::string whole;
  for (std::size_t i = 0; i < blocks.compressed.size(); ++i) {
    const std::uint64_t stored = blocks.compressed[i], size = blocks.size_of(i);
    const auto fail = [&](const char* why) {
      throw std::runtime_error("block " + std::to_string(i + 1) + " of its " +
                               std::to_string(blocks.compressed.size()) + " compressed blocks " + why);
    };
    if (size / best_ratio > stored) fail("is too large for its compressed bytes");
    const std::size_t before = whole.size();
    whole.resize(before + static_cast<std::size_t>(size));
    uLongf written = static_cast<uLongf>(size);
    const int status = uncompress(reinterpret_cast<Bytef*>(whole.data() + before), &written,
                                  reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(stored));
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status != Z_OK || written != size) fail("is damaged");
    bytes.remove_prefix(static_cast<std::size_t>(stored));
  }
  return whole;
}

}  // namespace carreau
