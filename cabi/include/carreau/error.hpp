// SPDX-License-Identifier: BSD-3-Clause
/// Points, status values and exceptions of the C++ interface: see carreau.hpp.
#ifndef CARREAU_ERROR_HPP
#define CARREAU_ERROR_HPP

#include "../carreau.h"

#include <array>
#include <cstdint>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace carreau {

/// u, v, or x, y of the plane.
using Point2 = std::array<double, 2>;
/// x, y, z.
using Point3 = std::array<double, 3>;
/// xx, xy, xz, yy, yz, zz of a metric of space, in 1 / model length^2.
using Tensor3 = std::array<double, 6>;
/// Vertices of a triangle, from 0.
using Triangle = std::array<std::int32_t, 3>;
/// Vertices of an edge, from 0; also pairs of triangles.
using Edge = std::array<std::int32_t, 2>;

/// The version of the library that runs, "0.1.0", and major * 10000 + minor * 100 + patch.
inline std::string_view version() { return carreau_version(); }
inline int version_number() { return carreau_version_number(); }

// ---- Errors ----

/// carreau_status, without CARREAU_OK.
enum class Status : std::int32_t {
  argument = CARREAU_ERR_ARGUMENT,
  model = CARREAU_ERR_MODEL,
  file = CARREAU_ERR_FILE,
  callback = CARREAU_ERR_CALLBACK,
  domain = CARREAU_ERR_DOMAIN,
  limit = CARREAU_ERR_LIMIT,
  cancelled = CARREAU_ERR_CANCELLED,
  memory = CARREAU_ERR_MEMORY,
  sequence = CARREAU_ERR_SEQUENCE,
  partial = CARREAU_ERR_PARTIAL,
  busy = CARREAU_ERR_BUSY,
  internal = CARREAU_ERR_INTERNAL
};

/// A call that has failed. what() is the sentence of carreau_last_error. When a callback has thrown, that exception is nested
/// (std::rethrow_if_nested).
class Error : public std::runtime_error {
 public:
  Error(carreau_status status, const std::string& sentence, const carreau_error_place& place = {})
      : std::runtime_error(sentence.empty() ? carreau_status_meaning(status) : sentence), status_(status), place_(place) {}

  /// The kind of the failure.
  [[nodiscard]] Status status() const { return Status{status_}; }
  /// "CARREAU_ERR_FILE"
  [[nodiscard]] std::string_view status_name() const { return carreau_status_name(status_); }
  /// The face, curve, point, line and parameters concerned; 0 or NaN for missing ones.
  [[nodiscard]] const carreau_error_place& place() const { return place_; }

 private:
  carreau_status status_;
  carreau_error_place place_;
};

/// States if all faces were meshed. For a partial mesh, Mesh::faces and Session::last_error describe the missing faces.
enum class Outcome { complete, partial };

namespace detail {

template <typename Struct>
Struct sized() {
  Struct out{};
  out.struct_size = sizeof(Struct);
  return out;
}

/// The options of a caller, whose struct_size may be left out.
template <typename Struct>
Struct sized(Struct in) {
  in.struct_size = sizeof(Struct);
  return in;
}

inline std::int64_t count_of(std::size_t n) { return static_cast<std::int64_t>(n); }

template <typename Item>
Item* data_or_null(std::span<Item> items) {
  return items.empty() ? nullptr : items.data();
}

/// Rows of numbers as the plain array that the C interface takes.
template <typename Number, std::size_t N>
const Number* flat(std::span<const std::array<Number, N>> rows) {
  static_assert(sizeof(std::array<Number, N>) == N * sizeof(Number));
  return rows.empty() ? nullptr : rows.front().data();
}
template <typename Number, std::size_t N>
Number* flat(std::vector<std::array<Number, N>>& rows) {
  static_assert(sizeof(std::array<Number, N>) == N * sizeof(Number));
  return rows.empty() ? nullptr : rows.front().data();
}

/// Throws the error of a call, with the exception of a callback nested in it.
[[noreturn]] inline void fail(carreau_status status, const char* sentence, const carreau_error_place& place = {},
                              std::exception_ptr cause = nullptr) {
  const Error error(status, sentence, place);
  if (!cause) throw error;
  try {
    std::rethrow_exception(cause);
  } catch (...) {
    std::throw_with_nested(error);
  }
}

} // namespace detail

} // namespace carreau

#endif
