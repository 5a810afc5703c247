// SPDX-License-Identifier: BSD-3-Clause
// The variables that govern a run (RT-0232 sec. 3.3 fig. 13) and our own, in one table.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace carreau {

/// Values are part of the C ABI.
enum class ParameterType : int { integer = 1, real = 2, text = 3 };

/// A row of the table.
struct ParameterInfo {
  const char* name;
  ParameterType type;
  double minimum, maximum;  ///< of integers and reals, both allowed
  double default_number;    ///< of integers and reals; times diag when diag_relative
  bool diag_relative;
  const char* default_text;  ///< of texts
  const char* choices;       ///< of texts: "a|b|c", or nullptr when any text is allowed
  const char* help;          ///< one line, with the unit
  const char* set_by = "";   ///< "effort": takes its value by the level of that parameter until it is set itself
};

/// All parameters, in alphabetical order as in fig. 13.
std::span<const ParameterInfo> parameter_table();

/// Row of a name, nullptr when unknown. Names are case-sensitive, as in the manual.
const ParameterInfo* find_parameter(std::string_view name);

/// Levels of the parameter `effort`.
enum Effort : int { classic_effort = -1, no_effort = 0, usual_effort = 1, more_effort = 2 };

/// The known name nearest to a wrong one (edit distance), or empty when none is near.
std::string nearest_parameter(std::string_view name);

/// Values that have been set; everything else has its default.
class Parameters {
 public:
  /// Throw InvalidArgument with the reason: unknown name (with the nearest), wrong type, out of range.
  void set(std::string_view name, int value);
  void set(std::string_view name, double value);
  void set(std::string_view name, std::string_view value);
  /// From a word of blsurf.env.
  void set_from_text(std::string_view name, std::string_view word, bool quoted);

  [[nodiscard]] int integer(std::string_view name) const;
  /// A default that is relative to diag is multiplied by `diag`.
  [[nodiscard]] double real(std::string_view name, double diag = std::numeric_limits<double>::quiet_NaN()) const;
  [[nodiscard]] std::string text(std::string_view name) const;
  [[nodiscard]] bool is_set(std::string_view name) const;
  void reset(std::string_view name);
  void reset_all();

 private:
  std::vector<std::optional<std::variant<int, double, std::string>>> values_;
};

}  // namespace carreau
