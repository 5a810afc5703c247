// SPDX-License-Identifier: BSD-3-Clause
#include "io/model/env.h"

#include <algorithm>

#include "io/files.h"
#include "io/text.h"
#include "support/error.h"

namespace carreau {

namespace {

/// RT-0232 sec. 3.3: "un espace, une tabulation ou un signe égal"; files made on Windows have the carriage return.
constexpr bool is_blank(char c) noexcept { return c == ' ' || c == '\t' || c == '=' || c == '\r'; }
constexpr bool is_quote(char c) noexcept { return c == '\'' || c == '"'; }
/// Bytes of UTF-8 sequences count as printable: file names have accents.
constexpr bool is_printable(char c) noexcept {
  return (c >= ' ' && c != '\x7F') || static_cast<unsigned char>(c) >= 0x80;
}

struct Word {
  std::string text;
  bool quoted = false;
};

/// Words of one line.
class EnvLine {
 public:
  EnvLine(std::string_view line, const Where& where) : line_(line), where_(where) {}

  /// False at the end of the line or at a comment.
  bool next(Word& word) {
    while (pos_ < line_.size() && is_blank(line_[pos_])) ++pos_;
    if (pos_ == line_.size() || line_[pos_] == '!') return false;
    word = is_quote(line_[pos_]) ? quoted_word() : plain_word();
    return true;
  }

 private:
  [[noreturn]] void fail(const std::string& sentence) const { throw FileError(where_, sentence); }

  void check(char c) const {
    if (!is_printable(c) && c != '\t')
      fail("a character that is not printable (code " + std::to_string(static_cast<unsigned char>(c)) + ")");
  }

  Word plain_word() {
    Word word;
    while (pos_ < line_.size() && !is_blank(line_[pos_]) && line_[pos_] != '!') {
      check(line_[pos_]);
      if (is_quote(line_[pos_])) fail("a quote inside the word " + shown(word.text));
      word.text += line_[pos_++];
    }
    return word;
  }

  Word quoted_word() {
    Word word{.text = {}, .quoted = true};
    const char quote = line_[pos_++];
    for (;; ++pos_) {
      if (pos_ >= line_.size()) fail("the quote that opens " + shown(word.text) + " is not closed on its line");
      if (line_[pos_] == quote) {
        const bool doubled = pos_ + 1 < line_.size() && line_[pos_ + 1] == quote;  // represents a quote, as in Fortran
        if (!doubled) break;
        ++pos_;
      }
      check(line_[pos_]);
      word.text += line_[pos_];
    }
    ++pos_;
    if (pos_ < line_.size() && !is_blank(line_[pos_]) && line_[pos_] != '!')
      fail("a blank is missing after the quote that closes " + shown(word.text));
    return word;
  }

  std::string_view line_;
  const Where& where_;
  std::size_t pos_ = 0;
};

}  // namespace

std::vector<EnvPair> read_env_text(std::string_view text, const std::string& name) {
  text = without_byte_order_mark(text);
  std::vector<EnvPair> pairs;
  Where where{.file = name, .line = 0};
  Word variable, word;
  int line_of_variable = 0;  // 0: a name comes next
  const auto without_value = [&] {
    throw FileError({.file = name, .line = line_of_variable}, shown(variable.text) + " has no value");
  };
  while (!text.empty()) {
    ++where.line;
    const std::size_t end = std::min(text.find('\n'), text.size());
    EnvLine line(text.substr(0, end), where);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (line.next(word)) {
      if (line_of_variable == 0) {
        if (word.quoted)
          throw FileError(where, "the name of a variable was expected, not the text " + shown(word.text));
        variable = word;
        line_of_variable = where.line;
        continue;
      }
      // A value may stand on a later line (RT-0232 sec. 3.3: words between blanks), but an action is none.
      if (where.line > line_of_variable && word.text == "call" && !word.quoted) without_value();
      pairs.push_back({variable.text, word.text, word.quoted, line_of_variable});
      line_of_variable = 0;
      // BLSURF leaves the program there: anything may follow.
      if (variable.text == "call" && word.text == "exit") return pairs;
    }
  }
  if (line_of_variable != 0) without_value();
  return pairs;
}

std::vector<EnvPair> read_env(const std::string& path) {
  constexpr std::size_t limit = std::size_t{1} << 24;
  return read_env_text(read_file(path, limit), path);
}

}  // namespace carreau
