// SPDX-License-Identifier: BSD-3-Clause
// Readers of .xyzr and .xyz, and the choice of a reader.
#include <charconv>

#include "io/files.h"
#include "io/molecule/atom_list.h"
#include "io/molecule/elements.h"
#include "io/text.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr const char* coordinate[3] = {"x", "y", "z"};

Vec3 centre_of(const AtomList& atoms, const std::vector<std::string_view>& words, std::size_t first, int line) {
  Vec3 centre;
  for (std::size_t i = 0; i < 3; ++i)
    centre[static_cast<Eigen::Index>(i)] =
        atoms.number(first + i < words.size() ? words[first + i] : std::string_view{}, coordinate[i], line);
  return centre;
}

bool is_integer(std::string_view word, long long& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

MoleculeFile read_xyzr(std::string_view text, const std::string& name) {
  AtomList atoms(name);
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    const std::vector<std::string_view> words = words_of(line, '#');
    if (words.empty()) continue;
    const Vec3 centre = centre_of(atoms, words, 0, lines.number());
    const double radius = atoms.number(words.size() > 3 ? words[3] : std::string_view{}, "the radius", lines.number());
    if (!(radius > 0)) atoms.fail(lines.number(), "the radius is " + format_number(radius) + "; it must be positive");
    atoms.add(centre, radius);
  }
  return std::move(atoms).finished(lines.number());
}

MoleculeFile read_xyz(std::string_view text, const std::string& name, const Radii& radii) {
  AtomList atoms(name, radii);
  Lines lines(text);
  std::string_view line;
  long long count = 0;
  if (!lines.next(line)) atoms.fail(1, "the file is empty");
  if (!is_integer(trimmed(line), count) || count <= 0)
    atoms.fail(1, "the first line is " + shown(trimmed(line)) + "; it must be a positive number of atoms");
  lines.next(line);  // the title
  for (long long k = 0; k < count; ++k) {
    if (!lines.next(line))
      atoms.fail(lines.number(),
                 "the file ends after " + std::to_string(k) + " of " + std::to_string(count) + " atoms");
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty()) atoms.fail(lines.number(), "an atom was expected, the line is empty");
    const Vec3 centre = centre_of(atoms, words, 1, lines.number());
    atoms.add(centre, element_symbol(words[0]), lines.number());
  }
  while (lines.next(line))
    if (!trimmed(line).empty()) {
      atoms.remark("lines after the first " + std::to_string(count) + " atoms are ignored");
      break;
    }
  return std::move(atoms).finished(lines.number());
}

MoleculeFile read_molecule(const std::string& path, const Radii& radii) {
  const std::string suffix = suffix_of(path);
  if (suffix == ".xyzr") return read_xyzr(read_file(path), path);
  const auto reader = suffix == ".xyz"                         ? read_xyz
                      : suffix == ".pdb" || suffix == ".ent"   ? read_pdb
                      : suffix == ".cif" || suffix == ".mmcif" ? read_mmcif
                                                               : nullptr;
  if (reader == nullptr)
    throw FileError(Where{.file = path}, "a molecule is read from .xyzr, .xyz, .pdb, .ent, .cif or .mmcif");
  return reader(read_file(path), path, radii);
}

}  // namespace carreau
