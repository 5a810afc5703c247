// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/selection.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <functional>
#include <optional>
#include <set>

#include "base/failure.h"
#include "base/suggestions.h"
#include "inputs/base/face_list.h"

namespace command {
namespace {

constexpr std::array<const char*, 4> kinds{"vertex", "edge", "face", "solid"};

std::optional<std::int32_t> number_in(const std::string& text) {
  std::int32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number > 0 ? std::optional(number) : std::nullopt;
}

std::vector<std::string> split(const std::string& text, char by) {
  std::vector<std::string> pieces;
  for (std::size_t begin = 0, end = 0; begin <= text.size(); begin = end + 1) {
    end = std::min(text.find(by, begin), text.size());
    pieces.push_back(text.substr(begin, end - begin));
  }
  return pieces;
}

/// "3" or "12-19".
bool add_range(const std::string& piece, std::vector<std::int32_t>& refs) {
  constexpr std::int32_t longest = 10'000'000;
  const std::size_t dash = piece.find('-');
  const std::optional<std::int32_t> first = number_in(piece.substr(0, dash));
  const std::optional<std::int32_t> last = dash == std::string::npos ? first : number_in(piece.substr(dash + 1));
  if (!first || !last || *last < *first || *last - *first > longest) return false;
  for (std::int32_t ref = *first; ref <= *last; ++ref) refs.push_back(ref);
  return true;
}

std::optional<std::vector<std::int32_t>> numbers_in(const std::string& text) {
  std::vector<std::int32_t> refs;
  for (const std::string& piece : split(text, ','))
    if (!add_range(piece, refs)) return std::nullopt;
  std::sort(refs.begin(), refs.end());
  refs.erase(std::unique(refs.begin(), refs.end()), refs.end());
  return refs;
}

std::optional<std::int32_t> colour_in(const std::string& text) {
  const std::string digits = text.starts_with('#') ? text.substr(1) : text;
  std::int32_t rgb = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), rgb, 16);
  return digits.size() == 6 && error == std::errc() && end == digits.data() + 6 ? std::optional(rgb) : std::nullopt;
}

class Selector {
 public:
  Selector(const CadInput& input, const std::string& text, const std::string& option)
      : input_(input), text_(text), option_(option) {}

  Selection run() {
    const std::size_t colon = text_.find(':');
    const std::string kind = text_.substr(0, colon);
    if (colon != std::string::npos) {
      const std::string rest = text_.substr(colon + 1);
      if (kind == "color" || kind == "colour") return by_colour(rest);
      if (kind == "layer") return by_layer(rest);
      for (std::size_t dimension = 0; dimension < kinds.size(); ++dimension)
        if (kind == kinds[dimension]) return of_kind(static_cast<int>(dimension), rest);
    }
    return by_word();
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { throw Failure(option_ + " '" + text_ + "': " + why); }

  [[nodiscard]] Selection faces_where(const std::function<bool(std::int32_t)>& holds) const {
    Selection found;
    for (const std::int32_t face : input_.face_numbers())
      if (holds(face)) found.refs.push_back(face);
    std::sort(found.refs.begin(), found.refs.end());
    return found;
  }
  [[nodiscard]] Selection faces_named(const std::string& pattern) const {
    Selection named = faces_where([&](std::int32_t face) { return input_.face_name(face) == pattern; });
    return named.refs.empty() ? faces_where([&](std::int32_t face) { return fits(input_.face_name(face), pattern); }) : named;
  }
  [[nodiscard]] Selection solids_named(const std::string& pattern) const {
    std::set<std::int32_t> numbers;
    for (const std::int32_t face : input_.face_numbers())
      for (const CadInput::Part& part : input_.parts_beside(face))
        if (part.number > 0 && (part.name == pattern || fits(part.name, pattern))) numbers.insert(part.number);
    return {.dimension = 3, .refs = {numbers.begin(), numbers.end()}};
  }

  [[nodiscard]] Selection small_named(int dimension, const std::string& pattern) const {
    Selection found{.dimension = dimension, .refs = {}};
    for (const CadInput::Named& each : input_.named(dimension))
      if (each.name == pattern || fits(each.name, pattern)) found.refs.push_back(each.number);
    return found;
  }
  [[nodiscard]] Selection named(int dimension, const std::string& pattern) const {
    return dimension < 2 ? small_named(dimension, pattern) : dimension == 2 ? faces_named(pattern) : solids_named(pattern);
  }

  Selection by_layer(const std::string& pattern) const {
    Selection found = faces_where([&](std::int32_t face) { return input_.face_layer(face) == pattern || fits(input_.face_layer(face), pattern); });
    std::set<std::string> layers;
    for (const std::int32_t face : input_.face_numbers()) layers.insert(input_.face_layer(face));
    layers.erase("");
    if (layers.empty()) fail("the file has no layers.");
    if (found.refs.empty()) fail("no face is on this layer" + did_you_mean(pattern, {layers.begin(), layers.end()}));
    return found;
  }

  Selection by_colour(const std::string& text) const {
    const std::optional<std::int32_t> rgb = colour_in(text);
    if (!rgb) fail("a colour is written #rrggbb, as in color:#ff0000.");
    Selection found = faces_where([&](std::int32_t face) { return input_.face_colour(face) == *rgb; });
    if (found.refs.empty()) fail("no face has this colour.");
    return found;
  }

  Selection of_kind(int dimension, const std::string& text) const {
    if (const std::optional<std::vector<std::int32_t>> refs = numbers_in(text)) return known(dimension, *refs);
    Selection found = named(dimension, text);
    if (found.refs.empty()) fail("there is no such " + std::string(kinds[static_cast<std::size_t>(dimension)]) + suggestion(text));
    return found;
  }

  Selection known(int dimension, const std::vector<std::int32_t>& refs) const {
    std::set<std::int32_t> all;
    for (const std::int32_t face : input_.face_numbers()) {
      if (dimension == 2) all.insert(face);
      if (dimension == 3)
        for (const CadInput::Part& part : input_.parts_beside(face)) all.insert(part.number);
    }
    if (dimension >= 2)  // the session knows edges and vertices
      for (const std::int32_t ref : refs)
        if (!all.contains(ref)) fail("there is no " + std::string(kinds[static_cast<std::size_t>(dimension)]) + " " + std::to_string(ref) + ".");
    return {.dimension = dimension, .refs = refs};
  }

  Selection by_word() const {
    if (const std::optional<std::vector<std::int32_t>> refs = numbers_in(text_)) return known(2, *refs);
    for (const int dimension : {2, 3, 1, 0})
      if (Selection found = named(dimension, text_); !found.refs.empty()) return found;
    fail("no face, solid, edge or vertex has this name" + suggestion(text_));
  }

  [[nodiscard]] std::string suggestion(const std::string& word) const {
    std::set<std::string> names;
    for (const std::int32_t face : input_.face_numbers()) {
      names.insert(input_.face_name(face));
      for (const CadInput::Part& part : input_.parts_beside(face)) names.insert(part.name);
    }
    for (const int dimension : {0, 1})
      for (const CadInput::Named& each : input_.named(dimension)) names.insert(each.name);
    names.erase("");
    return did_you_mean(word, {names.begin(), names.end()}) + " `carreau info --faces` lists all.";
  }

  const CadInput& input_;
  const std::string& text_;
  const std::string& option_;
};

}  // namespace

Selection select(const CadInput& input, const std::string& text, const std::string& option) {
  return Selector(input, text, option).run();
}

}  // namespace command
