// SPDX-License-Identifier: BSD-3-Clause
// Reader of the loop _atom_site of mmCIF files (PDBx/mmCIF dictionary; syntax of CIF 1.1).
#include <algorithm>
#include <charconv>
#include <utility>

#include "io/molecule/atom_list.h"
#include "io/molecule/elements.h"
#include "io/text.h"

namespace carreau {

namespace {

/// A value or a word of the syntax.
struct Token {
  std::string_view text;
  int line = 0;
  bool quoted = false;  ///< then it is a value whatever it looks like
  bool end = false;

  [[nodiscard]] bool is_name() const { return !quoted && text.starts_with('_'); }
  [[nodiscard]] bool is_loop() const { return !quoted && is("loop_"); }
  [[nodiscard]] bool is_word() const {
    return is_name() || is_loop() || (!quoted && (begins("data_") || begins("save_") || is("stop_") || is("global_")));
  }

 private:
  [[nodiscard]] bool begins(std::string_view lower) const {
    return text.size() >= lower.size() && std::equal(lower.begin(), lower.end(), text.begin(), [](char a, char b) {
             return a == (b >= 'A' && b <= 'Z' ? static_cast<char>(b - 'A' + 'a') : b);
           });
  }
  [[nodiscard]] bool is(std::string_view lower) const { return text.size() == lower.size() && begins(lower); }
};

class Tokens {
 public:
  Tokens(std::string_view text, const AtomList& atoms) : text_(without_byte_order_mark(text)), atoms_(atoms) {}

  Token next() {
    skip_blanks();
    if (at_ == text_.size()) return {.text = {}, .line = line_, .end = true};
    if (text_[at_] == ';' && (at_ == 0 || text_[at_ - 1] == '\n')) return text_field();
    if (text_[at_] == '\'' || text_[at_] == '"') return quoted();
    const std::size_t first = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return {.text = text_.substr(first, at_ - first), .line = line_};
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  void skip_blanks() {
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '#')
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      if (at_ == text_.size() || !is_blank(text_[at_])) return;
      if (text_[at_] == '\n') ++line_;
    }
  }

  /// Between two lines that begin with a semicolon.
  Token text_field() {
    const int line = line_;
    const std::size_t first = at_ + 1, end = text_.find("\n;", at_);
    if (end == std::string_view::npos) atoms_.fail(line, "the text that begins here does not end");
    line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(first),
                                         text_.begin() + static_cast<std::ptrdiff_t>(end), '\n')) +
             1;
    at_ = end + 2;
    return {.text = text_.substr(first, end - first), .line = line, .quoted = true};
  }

  /// A quote ends the value only before a blank.
  Token quoted() {
    const char quote = text_[at_];
    const std::size_t first = ++at_;
    for (; at_ < text_.size() && text_[at_] != '\n'; ++at_)
      if (text_[at_] == quote && (at_ + 1 == text_.size() || is_blank(text_[at_ + 1])))
        return {.text = text_.substr(first, at_++ - first), .line = line_, .quoted = true};
    atoms_.fail(line_, "a quote that begins here does not end on its line");
  }

  std::string_view text_;
  const AtomList& atoms_;
  std::size_t at_ = 0;
  int line_ = 1;
};

constexpr std::string_view category = "_atom_site.";

class AtomSites {
 public:
  AtomSites(std::vector<std::string_view> columns, AtomList& atoms) : columns_(std::move(columns)), atoms_(atoms) {}

  [[nodiscard]] std::size_t width() const { return columns_.size(); }

  void add(const std::vector<Token>& row) {
    const int line = row.front().line;
    const std::string_view model = value(row, "pdbx_PDB_model_num");
    if (!started_) model_ = model, started_ = true;
    if (model != model_) {
      if (!std::exchange(told_, true)) atoms_.remark("models after the first one are not read");
      return;
    }
    BankAtom atom;
    atom.line = line;
    atom.element = element_symbol(value(row, "type_symbol"));
    atom.residue = either(row, "auth_comp_id", "label_comp_id");
    atom.chain = either(row, "auth_asym_id", "label_asym_id");
    atom.sequence =
        std::string(either(row, "auth_seq_id", "label_seq_id")) + std::string(value(row, "pdbx_PDB_ins_code"));
    atom.location = value(row, "label_alt_id");
    const std::string_view id = value(row, "id");
    std::from_chars(id.data(), id.data() + id.size(), atom.serial);
    atom.centre = {atoms_.number(value(row, "Cartn_x"), "Cartn_x", line),
                   atoms_.number(value(row, "Cartn_y"), "Cartn_y", line),
                   atoms_.number(value(row, "Cartn_z"), "Cartn_z", line)};
    atoms_.add(atom);
  }

 private:
  /// Empty: there is no such column, or it holds none.
  [[nodiscard]] std::string_view value(const std::vector<Token>& row, std::string_view column) const {
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    if (found == columns_.end()) return {};
    const Token& token = row[static_cast<std::size_t>(found - columns_.begin())];
    return !token.quoted && (token.text == "." || token.text == "?") ? std::string_view{} : token.text;
  }
  [[nodiscard]] std::string_view either(const std::vector<Token>& row, std::string_view first,
                                        std::string_view second) const {
    const std::string_view found = value(row, first);
    return found.empty() ? value(row, second) : found;
  }

  std::vector<std::string_view> columns_;
  AtomList& atoms_;
  std::string_view model_;
  bool started_ = false, told_ = false;
};

/// After "loop_": reads names and values; returns the token that follows.
Token read_loop(Tokens& tokens, AtomList& atoms) {
  std::vector<std::string_view> names;
  Token token = tokens.next();
  bool of_atoms = true;
  for (; !token.end && token.is_name(); token = tokens.next()) {
    of_atoms = of_atoms && token.text.starts_with(category);
    names.push_back(of_atoms ? token.text.substr(category.size()) : token.text);
  }
  if (names.empty()) atoms.fail(token.line, "loop_ is followed by no name");
  if (!of_atoms) {
    while (!token.end && !token.is_word()) token = tokens.next();
    return token;
  }
  AtomSites sites(std::move(names), atoms);
  std::vector<Token> row;
  for (; !token.end && !token.is_word(); token = tokens.next()) {
    row.push_back(token);
    if (row.size() < sites.width()) continue;
    sites.add(row);
    row.clear();
  }
  if (!row.empty())
    atoms.fail(token.line, "the last row of _atom_site has " + std::to_string(row.size()) + " values, not " +
                               std::to_string(sites.width()));
  return token;
}

}  // namespace

MoleculeFile read_mmcif(std::string_view text, const std::string& name, const Radii& radii) {
  AtomList atoms(name, radii);
  Tokens tokens(text, atoms);
  int line = 1;
  for (Token token = tokens.next(); !token.end;) {
    token = token.is_loop() ? read_loop(tokens, atoms) : tokens.next();
    line = token.line;
  }
  return std::move(atoms).finished(line);
}

}  // namespace carreau
