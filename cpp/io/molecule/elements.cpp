// SPDX-License-Identifier: BSD-3-Clause
#include "io/molecule/elements.h"

#include <algorithm>
#include <array>
#include <utility>

namespace carreau {

namespace {

constexpr std::array<std::pair<std::string_view, double>, 39> radii{{
    {"Ag", 1.72}, {"Ar", 1.88}, {"As", 1.85}, {"Au", 1.66}, {"Br", 1.85}, {"C", 1.70},  {"Cd", 1.58}, {"Cl", 1.75},
    {"Cu", 1.40}, {"D", 1.20},  {"F", 1.47},  {"Ga", 1.87}, {"H", 1.20},  {"He", 1.40}, {"Hg", 1.55}, {"I", 1.98},
    {"In", 1.93}, {"K", 2.75},  {"Kr", 2.02}, {"Li", 1.82}, {"Mg", 1.73}, {"N", 1.55},  {"Na", 2.27}, {"Ne", 1.54},
    {"Ni", 1.63}, {"O", 1.52},  {"P", 1.80},  {"Pb", 2.02}, {"Pd", 1.63}, {"Pt", 1.72}, {"S", 1.80},  {"Se", 1.90},
    {"Si", 2.10}, {"Sn", 2.17}, {"Te", 2.06}, {"Tl", 1.96}, {"U", 1.86},  {"Xe", 2.16}, {"Zn", 1.39},
}};

constexpr bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
constexpr char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

std::string element_symbol(std::string_view letters) {
  std::string symbol;
  for (const char c : letters)
    if (is_letter(c)) symbol += symbol.empty() ? upper(c) : lower(c);
  return symbol;
}

std::optional<double> bondi_radius(std::string_view symbol) {
  const auto found = std::lower_bound(radii.begin(), radii.end(), symbol,
                                      [](const auto& row, std::string_view s) { return row.first < s; });
  if (found == radii.end() || found->first != symbol) return {};
  return found->second;
}

}  // namespace carreau
