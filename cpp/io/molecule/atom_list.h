// SPDX-License-Identifier: BSD-3-Clause
// Functions that the readers of molecules share.
#pragma once

#include <set>
#include <unordered_set>

#include "io/molecule/molecule_files.h"

namespace carreau {

/// An atom as a file of a protein bank has it.
struct BankAtom {
  std::string element, residue, chain, sequence;
  std::string location;  ///< mark of an alternate one; empty: the only one
  long long serial = 0;
  Vec3 centre;
  int line = 0;
};

/// Gathers atoms in the order of a file.
class AtomList {
 public:
  /// Keeps a reference to `name`. `radii` replace radii of the table.
  explicit AtomList(const std::string& name, Radii radii = {}) : name_(name), radii_(std::move(radii)) {}

  [[noreturn]] void fail(int line, const std::string& sentence) const;
  /// A finite number.
  [[nodiscard]] double number(std::string_view word, const char* what, int line) const;

  void add(const Vec3& centre, double radius) { file_.molecule.balls.push_back({centre, radius}); }
  void add(const Vec3& centre, const std::string& element, int line);
  /// Leaves out waters and alternate locations.
  void add(const BankAtom& atom);
  void remark(std::string sentence) { file_.remarks.push_back(std::move(sentence)); }
  [[nodiscard]] std::size_t size() const { return file_.molecule.balls.size(); }
  /// `line`: of the end of the file.
  MoleculeFile finished(int line) &&;

 private:
  void keep_numbers();

  const std::string& name_;
  Radii radii_;
  MoleculeFile file_;
  std::vector<long long> serials_;
  std::string residue_, location_;  // of the last atom that has alternate ones
  std::size_t waters_ = 0, alternates_ = 0;
};

/// Lines of a text, without their ends.
class Lines {
 public:
  explicit Lines(std::string_view text);
  /// False at the end of the text.
  bool next(std::string_view& line);
  [[nodiscard]] int number() const { return number_; }  ///< of the last one, from 1

 private:
  std::string_view rest_;
  int number_ = 0;
};

/// Words of a line between blanks, up to `comment`.
std::vector<std::string_view> words_of(std::string_view line, char comment = '\0');

}  // namespace carreau
