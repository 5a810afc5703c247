// SPDX-License-Identifier: BSD-3-Clause
// Sections of Medit's ASCII formats (.mesh, .sol).
#pragma once

#include <initializer_list>
#include <optional>

#include "io/words.h"

namespace carreau {

class MeditWords : public Words {
 public:
  MeditWords(std::string_view text, const std::string& name) : Words(text, name, '#') {}

  /// The first word and the version behind it. `kind`: "a mesh file".
  void header(const char* kind);
  /// Goes to the next section with a name in `wanted`: returns its name, or "" at the word End, or at the end of the last line
  /// of a file without End. The dimension is read on the way; other sections that the format knows are skipped. Any other name
  /// is an error, unless skip_any_section() was called: a misspelt "Triangels" must not pass for a mesh without triangles.
  std::string_view next_section(std::initializer_list<std::string_view> wanted);
  /// Sections of other names are skipped, too.
  void skip_any_section() noexcept { takes_any_ = true; }
  /// True when the file has ended without the word End.
  [[nodiscard]] bool lacks_end() const noexcept { return ended_; }
  /// Throws FileError for a file without End that may be truncated.
  [[noreturn]] void fail_without_end() const;
  /// 2 or 3; nothing before it has come.
  [[nodiscard]] const std::optional<std::int32_t>& dimension() const noexcept { return dimension_; }

 private:
  void read_dimension(const char* at);
  /// Numbers and quoted names up to the next word that starts with a letter.
  void skip_section();
  void skip_unknown();

  std::optional<std::int32_t> dimension_;
  bool takes_any_ = false, ended_ = false;
};

}  // namespace carreau
