// SPDX-License-Identifier: BSD-3-Clause
// Reader of .pdb: the columns of the format 3.3, sections ATOM, HETATM, MODEL.
#include <charconv>

#include "io/molecule/atom_list.h"
#include "io/molecule/elements.h"
#include "io/text.h"

namespace carreau {

namespace {

/// Columns count from 1, the last one included; columns beyond a short line are empty.
std::string_view columns(std::string_view line, std::size_t first, std::size_t last) {
  return line.size() < first ? std::string_view{} : trimmed(line.substr(first - 1, last - first + 1));
}

/// The element from columns 77 and 78, or from the name of the atom: elements of two letters begin in column 13.
std::string element_of(std::string_view line) {
  if (const std::string symbol = element_symbol(columns(line, 77, 78)); !symbol.empty()) return symbol;
  const std::string two = element_symbol(line.substr(std::min<std::size_t>(12, line.size()), 2));
  const bool left = line.size() > 13 && line[12] != ' ' && two.size() == 2;
  const std::string name = element_symbol(columns(line, 13, 16));
  // Names of four letters such as HG11 begin there too.
  if (left && columns(line, 13, 16).size() < 4 && van_der_waals_radius(two) && line.starts_with("HETATM")) return two;
  return name.substr(0, 1);
}

BankAtom atom_of(std::string_view line, int number, const AtomList& atoms) {
  BankAtom atom;
  atom.line = number;
  atom.element = element_of(line);
  atom.residue = columns(line, 18, 20);
  atom.chain = columns(line, 22, 22);
  atom.sequence = columns(line, 23, 27);
  atom.location = columns(line, 17, 17);
  const std::string_view serial = columns(line, 7, 11);
  std::from_chars(serial.data(), serial.data() + serial.size(), atom.serial);
  atom.centre = {atoms.number(columns(line, 31, 38), "x", number), atoms.number(columns(line, 39, 46), "y", number),
                 atoms.number(columns(line, 47, 54), "z", number)};
  return atom;
}

}  // namespace

MoleculeFile read_pdb(std::string_view text, const std::string& name, const Radii& radii) {
  AtomList atoms(name, radii);
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    if (line.starts_with("ENDMDL") && atoms.size() > 0) {
      while (lines.next(line))
        if (line.starts_with("MODEL")) {
          atoms.remark("models after the first one are not read");
          break;
        }
      break;
    }
    if (line.starts_with("ATOM  ") || line.starts_with("HETATM")) atoms.add(atom_of(line, lines.number(), atoms));
  }
  return std::move(atoms).finished(lines.number());
}

}  // namespace carreau
