// SPDX-License-Identifier: BSD-3-Clause
// Numbers as text in a page: whole numbers become planes of bytes, zlib's stream, base64.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace command {

/// The preparation of numbers for compression. `delta`: each is replaced by its difference from the number `stride`
/// before it (the first ones from 0), modulo 2^(8 bytes). Differences are folded: 0, -1, 1, -2, ... become 0, 1, 2, 3,
/// ...
enum class Coding { plain, delta };

struct PackedNumbers {
  std::string base64;     ///< of a zlib stream (RFC 1950): all lowest bytes, then all second ones, and so on
  std::size_t count = 0;  ///< of numbers
  int bytes = 0;          ///< planes: bytes of a number, 1 to 4
  int stride = 1;
  Coding coding = Coding::plain;
};

/// Every number is less than 2^(8 bytes). Throws Failure when there is not enough memory.
PackedNumbers packed(const std::vector<std::uint32_t>& numbers, int bytes, Coding coding, int stride = 1);

/// RFC 4648, with padding, in one line.
std::string base64_of(const std::string& bytes);

}  // namespace command
