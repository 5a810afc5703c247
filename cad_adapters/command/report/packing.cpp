// SPDX-License-Identifier: BSD-3-Clause
#include "report/packing.h"

#include <zlib.h>

#include "base/failure.h"

namespace command {
namespace {

std::uint32_t mask_of(int bytes) { return bytes >= 4 ? 0xffffffffu : (1u << 8 * bytes) - 1; }

/// Small differences of either sign become small numbers.
std::uint32_t folded(std::uint32_t difference, int bytes) {
  const std::uint32_t sign = 1u << (8 * bytes - 1), mask = mask_of(bytes);
  return (difference & sign) != 0 ? (~(difference << 1) & mask) : (difference << 1 & mask);
}

std::vector<std::uint32_t> differences(const std::vector<std::uint32_t>& numbers, int bytes, int stride) {
  std::vector<std::uint32_t> result(numbers.size());
  const auto step = static_cast<std::size_t>(stride);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::uint32_t before = i < step ? 0 : numbers[i - step];
    result[i] = folded((numbers[i] - before) & mask_of(bytes), bytes);
  }
  return result;
}

std::string planes(const std::vector<std::uint32_t>& numbers, int bytes) {
  std::string text;
  text.reserve(numbers.size() * static_cast<std::size_t>(bytes));
  for (int plane = 0; plane < bytes; ++plane)
    for (const std::uint32_t number : numbers) text += static_cast<char>(number >> 8 * plane & 255);
  return text;
}

std::string deflated(const std::string& bytes) {
  constexpr int level = 7;  // 9 takes thrice the time for half a per cent
  uLongf size = compressBound(bytes.size());
  std::string stream(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(stream.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), level) != Z_OK)
    throw Failure("There is not enough memory for the report.");
  stream.resize(size);
  return stream;
}

}  // namespace

std::string base64_of(const std::string& bytes) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) -> std::uint32_t {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0;
    };
    const std::uint32_t three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (const int shift : {18, 12, 6, 0}) text += letters[three >> shift & 63];
    if (i + 1 >= bytes.size()) text[text.size() - 2] = '=';
    if (i + 2 >= bytes.size()) text.back() = '=';
  }
  return text;
}

PackedNumbers packed(const std::vector<std::uint32_t>& numbers, int bytes, Coding coding, int stride) {
  const std::vector<std::uint32_t> coded =
      coding == Coding::delta ? differences(numbers, bytes, stride) : std::vector<std::uint32_t>();
  return {base64_of(deflated(planes(coding == Coding::delta ? coded : numbers, bytes))), numbers.size(), bytes, stride,
          coding};
}

}  // namespace command
