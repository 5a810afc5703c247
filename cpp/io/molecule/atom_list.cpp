// SPDX-License-Identifier: BSD-3-Clause
#include "io/molecule/atom_list.h"

#include <algorithm>
#include <charconv>
#include <climits>
#include <cmath>

#include "io/molecule/elements.h"
#include "io/text.h"
#include "support/error.h"

namespace carreau {

namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

bool is_water(const std::string& residue) {
  return residue == "HOH" || residue == "WAT" || residue == "DOD" || residue == "H2O";
}

}  // namespace

void AtomList::fail(int line, const std::string& sentence) const {
  throw FileError(Where{.file = name_, .line = line}, sentence);
}

double AtomList::number(std::string_view word, const char* what, int line) const {
  word = trimmed(word);
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty()) fail(line, std::string(what) + " is missing");
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    fail(line, std::string(what) + " is " + shown(word) + ", which is not a finite number");
  return value;
}

void AtomList::add(const Vec3& centre, const std::string& element, int line) {
  const auto given = radii_.find(element);
  const auto radius = given != radii_.end() ? given->second : van_der_waals_radius(element);
  if (!radius) fail(line, shown(element) + " is not an element of the periodic table: it has no van der Waals radius");
  add(centre, *radius);
  file_.molecule.elements.push_back(element);
}

void AtomList::add(const BankAtom& atom) {
  if (is_water(atom.residue)) return void(++waters_);
  const std::string residue = atom.chain + '/' + atom.sequence;
  if (!atom.location.empty()) {
    if (residue_ != residue) residue_ = residue, location_ = atom.location;
    if (location_ != atom.location) return void(++alternates_);
  }
  add(atom.centre, atom.element, atom.line);
  std::string name = atom.residue;
  for (const std::string& part : {atom.chain, atom.sequence})
    if (!part.empty()) name += (name.empty() ? "" : " ") + part;
  file_.molecule.names.push_back(without_controls(name));
  serials_.push_back(atom.serial);
}

void AtomList::keep_numbers() {
  std::unordered_set<long long> seen;
  for (const long long serial : serials_)
    if (serial <= 0 || serial > INT_MAX / 2 || !seen.insert(serial).second)
      return remark("the atoms are numbered from 1: their serial numbers are not positive or not different");
  for (const long long serial : serials_) file_.molecule.numbers.push_back(static_cast<int>(serial));
}

MoleculeFile AtomList::finished(int line) && {
  if (size() == 0)
    fail(std::max(line, 1), waters_ > 0 ? "the file holds no atom but of waters" : "the file holds no atom");
  if (waters_ > 0) remark(std::to_string(waters_) + " atoms of waters are left out");
  if (alternates_ > 0) remark(std::to_string(alternates_) + " atoms at alternate locations are left out");
  if (!serials_.empty()) keep_numbers();
  return std::move(file_);
}

Lines::Lines(std::string_view text) : rest_(without_byte_order_mark(text)) {}

bool Lines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line = rest_.substr(0, end);
  if (line.ends_with('\r')) line.remove_suffix(1);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  ++number_;
  return true;
}

std::vector<std::string_view> words_of(std::string_view line, char comment) {
  if (comment != '\0') line = line.substr(0, line.find(comment));
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < line.size();) {
    if (is_blank(line[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < line.size() && !is_blank(line[end])) ++end;
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

}  // namespace carreau
