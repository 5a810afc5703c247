// SPDX-License-Identifier: BSD-3-Clause
#include "place_in_sentence.h"

#include "support/format.h"

namespace carreau::abi {

Where place_in_sentence(std::string_view sentence) {
  Where where;
  std::size_t start = 0;
  if (!sentence.starts_with("face ")) {
    if ((start = sentence.find(": face ")) == std::string_view::npos) return where;
    start += 2;
  }
  const std::string_view behind = sentence.substr(start), place = behind.substr(0, behind.find(": "));
  // The word behind a name, up to a comma, a bracket or the end.
  const auto after = [&](std::string_view name) -> std::string_view {
    const std::size_t at = place.find(name);
    if (at == std::string_view::npos) return {};
    const std::string_view rest = place.substr(at + name.size());
    return rest.substr(0, rest.find_first_of(",) "));
  };
  const auto integer = [&](std::string_view name, int& value) {
    if (const std::string_view word = after(name); word.empty() || !parse_number(word, value)) value = 0;
  };
  const auto real = [&](std::string_view name) -> std::optional<double> {
    double value = 0;
    const std::string_view word = after(name);
    return !word.empty() && parse_number(word, value) ? std::optional<double>(value) : std::nullopt;
  };
  integer("face ", where.face);
  integer("curve ", where.curve_index);
  integer("(reference ", where.curve);
  const std::optional<double> u = real("u = "), v = real("v = ");
  if (u && v) where.uv = Vec2{*u, *v};
  where.t = real("t = ");
  return where;
}

}  // namespace carreau::abi
