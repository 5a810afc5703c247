// SPDX-License-Identifier: BSD-3-Clause
// Tags of an XML file, one after the other: as much of XML as VTK's files need.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "io/words.h"

namespace carreau {

struct XmlTag {
  std::string_view name;        ///< empty: the file has ended
  bool opens = true;            ///< <name> or <name/>
  bool closes = false;          ///< </name> or <name/>
  const char* at = nullptr;     ///< of its '<'
  const char* after = nullptr;  ///< of the character behind its '>'
  std::map<std::string, std::string, std::less<>> attributes{};

  /// Value of an attribute; "" if absent.
  [[nodiscard]] std::string attribute(std::string_view key) const;
};

/// Walks through a text; keeps references to both arguments. Errors are FileErrors.
class XmlTags {
 public:
  XmlTags(std::string_view text, const std::string& name) : in_(text, name), p_(text.data()), end_(in_.end()) {}

  /// The next tag; declarations and comments are skipped.
  XmlTag next();
  /// Throws FileError with the line of the character `at`.
  [[noreturn]] void fail(const char* at, const std::string& sentence) const { in_.fail(at, sentence); }

 private:
  void skip_to(const char* at, std::string_view closing);
  void skip_blanks() noexcept;
  std::string_view name(const char* at);
  void attribute(XmlTag& tag);

  Words in_;  // for errors
  const char* p_;
  const char* end_;
};

}  // namespace carreau
