// SPDX-License-Identifier: BSD-3-Clause
// Common helpers of the tests of files.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <clocale>
#include <cmath>
#include <filesystem>
#include <limits>
#include <locale>
#include <random>
#include <string>

#include "mesh/flat_mesh.h"
#include "support/error.h"

namespace carreau {

/// A new folder, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() / ("carreau io " + std::string(test->test_suite_name()) + "." +
                                                      test->name() + " " + std::to_string(std::random_device{}()));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

/// A decimal comma and groups of digits in C++ streams and, where the machine has such a locale, in C functions too.
class CommaLocale {
 public:
  CommaLocale() : before_(std::locale::global(std::locale(std::locale(), new Comma))) {
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "fr_FR"})
      if (std::setlocale(LC_NUMERIC, name) != nullptr) break;
  }
  ~CommaLocale() {
    std::setlocale(LC_NUMERIC, "C");
    std::locale::global(before_);
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

 private:
  struct Comma : std::numpunct<char> {
    [[nodiscard]] char do_decimal_point() const override { return ','; }
    [[nodiscard]] char do_thousands_sep() const override { return '.'; }
    [[nodiscard]] std::string do_grouping() const override { return "\3"; }
  };
  std::locale before_;
};

/// The sentence of the error of type E that `action` throws; "" when it throws nothing.
template <typename E, typename Action>
std::string sentence_of(Action&& action) {
  try {
    action();
  } catch (const E& error) {
    return error.what();
  }
  return "";
}

/// Numbers in a chosen byte order, whatever the machine's.
class Bytes {
 public:
  explicit Bytes(bool big_endian = false) : big_(big_endian) {}
  Bytes& i32(std::int64_t value) { return put(static_cast<std::uint64_t>(value), 4); }
  Bytes& i64(std::int64_t value) { return put(static_cast<std::uint64_t>(value), 8); }
  Bytes& f32(float value) { return put(std::bit_cast<std::uint32_t>(value), 4); }
  Bytes& f64(double value) { return put(std::bit_cast<std::uint64_t>(value), 8); }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] std::int64_t size() const { return static_cast<std::int64_t>(text_.size()); }

 private:
  Bytes& put(std::uint64_t value, int size) {
    for (int k = 0; k < size; ++k) text_ += static_cast<char>(value >> 8 * (big_ ? size - 1 - k : k));
    return *this;
  }
  bool big_;
  std::string text_;
};

/// A finite double of any magnitude, sign and length of mantissa; often a short number.
inline double random_double(std::mt19937_64& random) {
  if (random() % 4 == 0) return static_cast<double>(static_cast<int>(random() % 2001) - 1000) / 8;
  for (;;) {
    const double value = std::bit_cast<double>(static_cast<std::uint64_t>(random()));
    if (std::isfinite(value)) return value;
  }
}

/// Any numbers that a file can hold; not a sound surface.
inline FlatMesh random_mesh(std::mt19937_64& random) {
  FlatMesh mesh;
  mesh.dimension = random() % 2 == 0 ? 2 : 3;
  const std::size_t n = 1 + random() % 50;
  const auto ref = [&] { return static_cast<std::int32_t>(random()); };
  const auto index = [&] { return static_cast<std::int32_t>(random() % n); };
  for (std::size_t i = 0; i < n; ++i) {
    mesh.vertices.push_back({random_double(random), random_double(random), 0});
    if (mesh.dimension == 3) mesh.vertices.back().z() = random_double(random);
    mesh.vertex_refs.push_back(ref());
  }
  for (std::size_t i = random() % 60; i > 0; --i) {
    mesh.triangles.push_back({index(), index(), index()});
    mesh.triangle_refs.push_back(ref());
  }
  for (std::size_t i = random() % 20; i > 0; --i) {
    mesh.edges.push_back({index(), index()});
    mesh.edge_refs.push_back(ref());
  }
  return mesh;
}

/// The unit square in two triangles of references 7 and -2, its four sides, two fields.
inline FlatMesh square() {
  FlatMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0.5}};
  mesh.vertex_refs = {1, 2, 0, 4};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.triangle_refs = {7, -2};
  mesh.edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  mesh.edge_refs = {11, 12, 13, 14};
  mesh.fields = {{"size", true, 1, {0.1, 0.2, 0.3, 0.4}}, {"quality & <shape>", false, 2, {1, 2, 3, 4}}};
  return mesh;
}

inline void expect_same_geometry(const FlatMesh& a, const FlatMesh& b) {
  EXPECT_EQ(a.dimension, b.dimension);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.vertex_refs, b.vertex_refs);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.triangle_refs, b.triangle_refs);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.edge_refs, b.edge_refs);
}

}  // namespace carreau
