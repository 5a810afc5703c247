// SPDX-License-Identifier: BSD-3-Clause
#include "support/ranks/packet.h"

#include <cstring>

namespace carreau {

namespace {

// Points are put as memory has them: their coordinates one after the other (support/vec.h asserts it).

[[noreturn]] void refuse() {
  throw Error("the data of another process end early: all processes must run the same version of the library");
}

}  // namespace

void PacketWriter::append(const void* from, std::size_t size) { bytes_.append(static_cast<const char*>(from), size); }
void PacketWriter::put(std::int64_t value) { append(&value, sizeof value); }
void PacketWriter::put(double value) { append(&value, sizeof value); }

void PacketWriter::put(std::string_view text) {
  put(static_cast<std::int64_t>(text.size()));
  bytes_.append(text);
}

void PacketWriter::put(const std::vector<double>& values) {
  put(static_cast<std::int64_t>(values.size()));
  append(values.data(), values.size() * sizeof(double));
}

void PacketWriter::put(const std::vector<std::int32_t>& values) {
  put(static_cast<std::int64_t>(values.size()));
  append(values.data(), values.size() * sizeof(std::int32_t));
}

void PacketWriter::put(const std::vector<Vec2>& points) {
  put(static_cast<std::int64_t>(points.size()));
  append(points.data(), points.size() * sizeof(Vec2));
}

void PacketWriter::put(const std::vector<Vec3>& points) {
  put(static_cast<std::int64_t>(points.size()));
  append(points.data(), points.size() * sizeof(Vec3));
}

void PacketWriter::put(const Where& where) {
  for (const int value : {where.face, where.curve_index, where.curve, where.point, where.line})
    put(std::int64_t{value});
  put(where.uv.has_value());
  if (where.uv) put(*where.uv);
  put(where.t.has_value());
  if (where.t) put(*where.t);
  put(std::string_view(where.file));
}

void PacketReader::copy(void* to, std::size_t size) {
  if (rest_.size() < size) refuse();
  if (size > 0) std::memcpy(to, rest_.data(), size);
  rest_.remove_prefix(size);
}

std::int64_t PacketReader::integer() {
  std::int64_t value = 0;
  copy(&value, sizeof value);
  return value;
}

double PacketReader::real() {
  double value = 0;
  copy(&value, sizeof value);
  return value;
}

std::size_t PacketReader::count(std::size_t each) {
  const std::int64_t n = integer();
  if (n < 0 || static_cast<std::uint64_t>(n) > rest_.size() / each) refuse();
  return static_cast<std::size_t>(n);
}

std::string PacketReader::text() {
  std::string text(count(1), '\0');
  copy(text.data(), text.size());
  return text;
}

std::vector<double> PacketReader::reals() {
  std::vector<double> values(count(sizeof(double)));
  copy(values.data(), values.size() * sizeof(double));
  return values;
}

std::vector<std::int32_t> PacketReader::integers() {
  std::vector<std::int32_t> values(count(sizeof(std::int32_t)));
  copy(values.data(), values.size() * sizeof(std::int32_t));
  return values;
}

Vec2 PacketReader::plane_point() {
  const double u = real(), v = real();
  return {u, v};
}

std::vector<Vec2> PacketReader::plane_points() {
  std::vector<Vec2> points(count(2 * sizeof(double)));
  copy(points.data(), points.size() * sizeof(Vec2));
  return points;
}

std::vector<Vec3> PacketReader::points() {
  std::vector<Vec3> points(count(3 * sizeof(double)));
  copy(points.data(), points.size() * sizeof(Vec3));
  return points;
}

Where PacketReader::where() {
  Where where;
  for (int* value : {&where.face, &where.curve_index, &where.curve, &where.point, &where.line})
    *value = static_cast<int>(integer());
  if (flag()) where.uv = plane_point();
  if (flag()) where.t = real();
  where.file = text();
  return where;
}

}  // namespace carreau
