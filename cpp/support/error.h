// SPDX-License-Identifier: BSD-3-Clause
// Errors of the engine: one class a cause, each carrying the entities that it is about.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "support/vec.h"

namespace carreau {

/// The entities an error is about. Zero, empty or absent means "not concerned".
/// References are the host's own (RT-0232 sec. 3.2), not indices.
struct Where {
  int face = 0;         ///< reference of a face (refs)
  int curve_index = 0;  ///< rank of a curve in its face, from 1 (ic)
  int curve = 0;        ///< reference of a curve (refc)
  int point = 0;        ///< reference of a point (refp)
  std::optional<Vec2> uv{};
  std::optional<double> t{};
  std::string file{};
  int line = 0;  ///< from 1

  /// "x.pardom, line 12: face 3, curve 2 (reference 17), u = 0.5, v = 1: " or "" when nothing is set.
  [[nodiscard]] std::string prefix() const;
};

/// Base of all errors that the engine throws on purpose. what() is a complete sentence that
/// starts with the location.
class Error : public std::runtime_error {
 public:
  Error(Where where, const std::string& sentence)
      : std::runtime_error(where.prefix() + sentence), where_(std::move(where)) {}
  explicit Error(const std::string& sentence) : std::runtime_error(sentence) {}
  [[nodiscard]] const Where& where() const noexcept { return where_; }

 private:
  Where where_;
};

/// An argument or a parameter violates its precondition.
struct InvalidArgument : Error {
  using Error::Error;
};
/// Faces, curves, points or references contradict the rules of RT-0232 sec. 3.2.
struct InvalidModel : Error {
  using Error::Error;
};
/// A file cannot be opened, read, understood or written.
struct FileError : Error {
  using Error::Error;
};
/// The host's geometry failed: a status, NaN or infinity, a reversed interval, a wrong derivative.
struct CallbackError : Error {
  using Error::Error;
};
/// A parameter domain cannot be meshed: its boundary does not close, crosses itself, is turned wrong.
struct DomainError : Error {
  using Error::Error;
};
/// The mesh would exceed the limit set by the caller or by memory.
struct LimitError : Error {
  using Error::Error;
};
/// The host requested a stop.
struct Cancelled : Error {
  using Error::Error;
};

}  // namespace carreau
