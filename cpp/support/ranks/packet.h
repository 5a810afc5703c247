// SPDX-License-Identifier: BSD-3-Clause
// Converts values to bytes and back: messages between processes of one program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "support/error.h"
#include "support/vec.h"

namespace carreau {

/// Puts one value after another, in the byte order of the machine. Lists are preceded by their length.
class PacketWriter {
 public:
  void put(std::int64_t value);
  void put(double value);
  void put(bool value) { put(std::int64_t{value ? 1 : 0}); }
  void put(std::string_view text);
  void put(const std::vector<double>& values);
  void put(const std::vector<std::int32_t>& values);
  void put(const std::vector<Vec2>& points);
  void put(const std::vector<Vec3>& points);
  void put(const Vec2& point) { put(point.x()), put(point.y()); }
  void put(const Where& where);

  [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }
  std::string take() noexcept { return std::move(bytes_); }

 private:
  void append(const void* from, std::size_t size);

  std::string bytes_;
};

/// Gives the values back in the order in which they were put. Throws Error if the bytes end earlier: another version of
/// the program wrote them.
class PacketReader {
 public:
  /// Keeps a view of `bytes`.
  explicit PacketReader(std::string_view bytes) : rest_(bytes) {}

  std::int64_t integer();
  double real();
  bool flag() { return integer() != 0; }
  std::string text();
  std::vector<double> reals();
  std::vector<std::int32_t> integers();
  std::vector<Vec2> plane_points();
  std::vector<Vec3> points();
  Vec2 plane_point();
  Where where();
  /// A length of a list whose entries take at least `each` bytes.
  std::size_t count(std::size_t each);
  [[nodiscard]] bool at_end() const noexcept { return rest_.empty(); }

 private:
  void copy(void* to, std::size_t size);

  std::string_view rest_;
};

}  // namespace carreau
