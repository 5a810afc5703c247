// SPDX-License-Identifier: BSD-3-Clause
#include "io/molecule/elements.h"

#include <algorithm>
#include <array>
#include <utility>

#include "io/molecule/atom_list.h"
#include "io/text.h"
#include "support/format.h"

namespace carreau {

namespace {

/// Bondi 1964 for his 38 elements (D and T: the value of H). Alvarez 2013 for others; if he has none, Mantina et al.
/// 2009 (At, Fr, Po, Ra, Rn) and for Pm and elements from Fm on 2.54 alpha^(1/7) bohr (Fedorov et al.
/// 2018) of the polarizabilities of Schwerdtfeger and Nagle 2019 (Lv: the mean of its neighbours).
constexpr std::array<std::pair<std::string_view, double>, 120> radii{{
    {"Ac", 2.80}, {"Ag", 1.72}, {"Al", 2.25}, {"Am", 2.83}, {"Ar", 1.88}, {"As", 1.85}, {"At", 2.02}, {"Au", 1.66},
    {"B", 1.91}, {"Ba", 3.03}, {"Be", 1.98}, {"Bh", 2.26}, {"Bi", 2.54}, {"Bk", 3.40}, {"Br", 1.85}, {"C", 1.70},
    {"Ca", 2.62}, {"Cd", 1.58}, {"Ce", 2.88}, {"Cf", 3.05}, {"Cl", 1.75}, {"Cm", 3.05}, {"Cn", 2.16}, {"Co", 2.40},
    {"Cr", 2.45}, {"Cs", 3.48}, {"Cu", 1.40}, {"D", 1.20}, {"Db", 2.29}, {"Ds", 2.21}, {"Dy", 2.87}, {"Er", 2.83},
    {"Es", 2.70}, {"Eu", 2.87}, {"F", 1.47}, {"Fe", 2.44}, {"Fl", 2.20}, {"Fm", 2.64}, {"Fr", 3.48}, {"Ga", 1.87},
    {"Gd", 2.83}, {"Ge", 2.29}, {"H", 1.20}, {"He", 1.40}, {"Hf", 2.63}, {"Hg", 1.55}, {"Ho", 2.81}, {"Hs", 2.24},
    {"I", 1.98}, {"In", 1.93}, {"Ir", 2.41}, {"K", 2.75}, {"Kr", 2.02}, {"La", 2.98}, {"Li", 1.82}, {"Lr", 3.06},
    {"Lu", 2.74}, {"Lv", 2.48}, {"Mc", 2.47}, {"Md", 2.63}, {"Mg", 1.73}, {"Mn", 2.45}, {"Mo", 2.45}, {"Mt", 2.22},
    {"N", 1.55}, {"Na", 2.27}, {"Nb", 2.56}, {"Nd", 2.95}, {"Ne", 1.54}, {"Nh", 2.17}, {"Ni", 1.63}, {"No", 2.63},
    {"Np", 2.82}, {"O", 1.52}, {"Og", 2.40}, {"Os", 2.48}, {"P", 1.80}, {"Pa", 2.88}, {"Pb", 2.02}, {"Pd", 1.63},
    {"Pm", 2.87}, {"Po", 1.97}, {"Pr", 2.92}, {"Pt", 1.72}, {"Pu", 2.81}, {"Ra", 2.83}, {"Rb", 3.21}, {"Re", 2.49},
    {"Rf", 2.64}, {"Rg", 2.21}, {"Rh", 2.44}, {"Rn", 2.20}, {"Ru", 2.46}, {"S", 1.80}, {"Sb", 2.47}, {"Sc", 2.58},
    {"Se", 1.90}, {"Sg", 2.28}, {"Si", 2.10}, {"Sm", 2.90}, {"Sn", 2.17}, {"Sr", 2.84}, {"T", 1.20}, {"Ta", 2.53},
    {"Tb", 2.79}, {"Tc", 2.44}, {"Te", 2.06}, {"Th", 2.93}, {"Ti", 2.46}, {"Tl", 1.96}, {"Tm", 2.79}, {"Ts", 2.50},
    {"U", 1.86}, {"V", 2.42}, {"W", 2.57}, {"Xe", 2.16}, {"Y", 2.75}, {"Yb", 2.80}, {"Zn", 1.39}, {"Zr", 2.52},
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

std::optional<double> van_der_waals_radius(std::string_view symbol) {
  const auto found = std::lower_bound(radii.begin(), radii.end(), symbol,
                                      [](const auto& row, std::string_view s) { return row.first < s; });
  if (found == radii.end() || found->first != symbol) return {};
  return found->second;
}

Radii read_radii(std::string_view text, const std::string& name) {
  const AtomList numbers(name);
  Radii radii;
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    const std::vector<std::string_view> words = words_of(line, '#');
    if (words.empty()) continue;
    const std::string symbol = element_symbol(words[0]);
    if (symbol.size() != words[0].size())
      numbers.fail(lines.number(), "the symbol of an element was expected, not " + shown(words[0]));
    const double radius =
        numbers.number(words.size() > 1 ? words[1] : std::string_view{}, "the radius", lines.number());
    if (!(radius > 0)) numbers.fail(lines.number(), "the radius is " + format_number(radius) + "; it must be positive");
    if (!radii.emplace(symbol, radius).second)
      numbers.fail(lines.number(), "the radius of " + symbol + " is given twice");
  }
  return radii;
}

}  // namespace carreau
