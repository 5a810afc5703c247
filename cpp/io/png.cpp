// SPDX-License-Identifier: BSD-3-Clause
#include "io/png.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string_view>
#include <vector>

#include "support/error.h"

namespace carreau {
namespace {

constexpr int max_png_side = 65536;
constexpr int rows_at_once = 32;

void append_number(std::string& bytes, std::uint32_t n) {
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(n >> shift & 255);
}

/// Length, name and bytes, and a check sum of both.
void append_chunk(std::string& file, std::string_view name, std::string_view content) {
  append_number(file, static_cast<std::uint32_t>(content.size()));
  const std::size_t from = file.size();
  file += name;
  file += content;
  const auto* bytes = reinterpret_cast<const Bytef*>(file.data() + from);
  append_number(file, static_cast<std::uint32_t>(crc32_z(0, bytes, file.size() - from)));
}

/// One zlib stream, cut into chunks as it grows.
class Deflater {
 public:
  explicit Deflater(std::string& file) : file_(file) {
    if (deflateInit(&stream_, Z_DEFAULT_COMPRESSION) != Z_OK) throw std::bad_alloc();
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  void add(std::vector<Bytef>& bytes, bool last) {
    stream_.next_in = bytes.data();
    stream_.avail_in = static_cast<uInt>(bytes.size());
    std::string packed;
    do {
      std::array<char, 1 << 16> room;
      stream_.next_out = reinterpret_cast<Bytef*>(room.data());
      stream_.avail_out = static_cast<uInt>(room.size());
      deflate(&stream_, last ? Z_FINISH : Z_NO_FLUSH);
      packed.append(room.data(), room.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
    if (!packed.empty()) append_chunk(file_, "IDAT", packed);
  }

 private:
  std::string& file_;
  z_stream stream_{};
};

}  // namespace

std::uint8_t srgb_byte(double linear) noexcept {
  const double x = linear > 0 ? std::min(linear, 1.0) : 0;  // NaN: 0
  const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

std::string png_bytes(int width, int height, const PngRows& rows) {
  if (width < 1 || height < 1 || width > max_png_side || height > max_png_side)
    throw InvalidArgument("an image would be " + std::to_string(width) + " x " + std::to_string(height) +
                          " pixels; each number must be from 1 to " + std::to_string(max_png_side));
  std::string file = "\x89PNG\r\n\x1a\n", header;
  append_number(header, static_cast<std::uint32_t>(width));
  append_number(header, static_cast<std::uint32_t>(height));
  header += {8, 2, 0, 0, 0};  // bits, colours without alpha, deflate, filters by row, not interlaced
  append_chunk(file, "IHDR", header);
  Deflater deflater(file);
  std::vector<std::array<float, 3>> pixels;
  std::vector<Bytef> bytes;
  for (int first = 0; first < height; first += rows_at_once) {
    const int count = std::min(rows_at_once, height - first);
    pixels.assign(static_cast<std::size_t>(count) * static_cast<std::size_t>(width), {0, 0, 0});
    rows(first, count, pixels);
    bytes.clear();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (i % static_cast<std::size_t>(width) == 0) bytes.push_back(0);  // no filter
      for (const float part : pixels[i]) bytes.push_back(srgb_byte(static_cast<double>(part)));
    }
    deflater.add(bytes, first + count == height);
  }
  append_chunk(file, "IEND", "");
  return file;
}

}  // namespace carreau
