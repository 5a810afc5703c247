// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/built/formula.h"

#include <muParser.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/failure.h"

namespace command {
namespace {

constexpr std::size_t longest = 4096;  // longer texts are not typed formulas

[[noreturn]] void refuse(const std::string& text, std::size_t position, const std::string& why) {
  throw Failure("The formula '" + text + "' is wrong at position " + std::to_string(position + 1) + ": " + why + ".");
}

/// Characters that muParser would take for more than an expression: assignments, which would change x for good, lists
/// and strings.
void check_characters(const std::string& text) {
  if (text.find_first_not_of(" \t") == std::string::npos) throw Failure("The formula is empty.");
  if (text.size() > longest) throw Failure("The formula has more than " + std::to_string(longest) + " characters.");
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if ((c < ' ' && c != '\t') || c > '~') refuse(text.substr(0, i) + "...", i, "a character that is not plain text");
    if (c == '"') refuse(text, i, "strings are not allowed");
    if (c != '=') continue;
    if (i + 1 < text.size() && text[i + 1] == '=') {
      ++i;
      continue;
    }
    if (i == 0 || std::string("<>!").find(text[i - 1]) == std::string::npos)
      refuse(text, i, "'=' assigns; '==' compares");
  }
}

/// An expression with its variables.
struct Evaluator {
  Place at;
  mu::Parser parser;

  Evaluator(const std::string& text, const std::string& names) {
    for (const auto& [name, variable] : {std::pair{"x", &at.x}, std::pair{"y", &at.y}, std::pair{"z", &at.z},
                                         std::pair{"u", &at.u}, std::pair{"v", &at.v}})
      if (names.find(name) != std::string::npos) parser.DefineVar(name, variable);
    parser.DefineConst("pi", 3.14159265358979323846);
    parser.SetExpr(text);
  }
};

std::atomic<std::uint64_t> next_serial{1};

}  // namespace

struct Formula::State {
  std::uint64_t serial = next_serial.fetch_add(1);
};

Formula::Formula(const std::string& text, const std::string& names)
    : text_(text), names_(names), state_(std::make_unique<State>()) {
  check_characters(text);
  try {
    Evaluator evaluator(text, names);
    evaluator.parser.Eval();
    if (evaluator.parser.GetNumResults() != 1) throw Failure("The formula '" + text + "' has more than one value.");
  } catch (const mu::Parser::exception_type& error) {
    std::string why = error.GetMsg();
    // It counts positions from 0.
    for (const char* tail : {" found at position", " at position"}) why = why.substr(0, why.find(tail));
    while (!why.empty() && (why.back() == '.' || why.back() == ' ')) why.pop_back();
    const auto position = static_cast<std::size_t>(std::max(static_cast<int>(error.GetPos()), 0));
    refuse(text, std::min(position, text.size()), why);
  }
}

Formula::~Formula() = default;

double Formula::operator()(const Place& place) const noexcept try {
  // A parser holds the values of its variables, so that each thread has parsers. A few formulas are in use at a time: a
  // size, and the coordinates of a surface.
  struct Known {
    std::uint64_t serial = 0;
    std::unique_ptr<Evaluator> evaluator;
  };
  static thread_local std::array<Known, 8> all;
  Known& known = all[state_->serial % all.size()];
  if (known.serial != state_->serial) known = {state_->serial, std::make_unique<Evaluator>(text_, names_)};
  known.evaluator->at = place;
  return known.evaluator->parser.Eval();
} catch (...) {  // muParser's own errors at run time, and no memory
  return std::numeric_limits<double>::quiet_NaN();
}

bool Formula::available() noexcept { return true; }

}  // namespace command
