// SPDX-License-Identifier: BSD-3-Clause
// Formulas of places, as `--size-map` takes them.
#pragma once

#include <memory>
#include <string>

#include "inputs/base/cad_input.h"

namespace command {

/// An expression in x, y, z, u, v with the operators and functions of muParser, pi included: "0.1 + abs(x) / 5",
/// "z > 1 ? 0.1 : 0.5". May be evaluated by several threads at a time.
class Formula {
 public:
  /// Throws Failure with the position (from 1) of the error, and if this program was built without muParser. `names`:
  /// the variables that it may use.
  explicit Formula(const std::string& text, const std::string& names = "xyzuv");
  ~Formula();
  Formula(const Formula&) = delete;
  Formula& operator=(const Formula&) = delete;

  /// Any number, or NaN when the expression has no value there.
  [[nodiscard]] double operator()(const Place& place) const noexcept;
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

  /// True if this program has formulas.
  static bool available() noexcept;

 private:
  std::string text_, names_;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace command
