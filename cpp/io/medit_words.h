// Words and numbers of Medit's ASCII formats (.mesh, .sol), read with errors that name the line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace carreau {

/// Walks through a text; keeps references to both arguments. Errors are FileErrors.
class MeditWords {
 public:
  MeditWords(std::string_view text, const std::string& name)
      : text_(text), name_(name), p_(text.data()), end_(text.data() + text.size()) {}

  /// Throws FileError with the line of the character `at`.
  [[noreturn]] void fail(const char* at, const std::string& sentence) const;

  /// Empty at the end of the text.
  std::string_view word();
  /// A finite number; Fortran's exponents are taken too.
  double real(const char* what);
  std::int32_t integer(const char* what);
  /// A number of entities of `words_each` words each: not negative, and no more than the rest of the text can hold.
  std::size_t count(const std::string& what, std::size_t words_each);
  /// The first word and the version behind it. `kind`: "a mesh file".
  void header(const char* kind);
  /// 2 or 3.
  std::int32_t dimension();
  /// Numbers and quoted names up to the next word that starts with a letter.
  void skip_section();

  [[nodiscard]] const char* position() const noexcept { return p_; }
  [[nodiscard]] const char* end() const noexcept { return end_; }
  /// Back to an earlier position().
  void go_back(const char* position) noexcept { p_ = position; }

 private:
  void skip_blanks() noexcept;
  std::string_view number_word(const char* what);

  std::string_view text_;
  const std::string& name_;
  const char* p_;
  const char* end_;
};

/// True for the name of a section that the format knows and that neither readers of meshes nor of solutions need. Other
/// names are errors: a misspelt "Triangels" must not pass for a mesh without triangles.
bool is_known_section(std::string_view name) noexcept;

}  // namespace carreau
