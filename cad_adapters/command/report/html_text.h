// SPDX-License-Identifier: BSD-3-Clause
// Pieces of HTML.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace command {

/// Text as content or as the value of an attribute in quotation marks. Special characters of HTML become references;
/// control characters and bytes that are not UTF-8 become U+FFFD.
std::string html(const std::string& text);

/// A number for a person: "%.4g"; "none" for NaN.
std::string number_text(double x);
/// "1 234 567": thin spaces between thousands.
std::string count_text(std::int64_t n);

/// A cell of a table. `text` is HTML.
struct HtmlCell {
  std::string text;
  bool is_number = false;  ///< to the right
  std::string sort = "";   ///< a number that rows are sorted by in place of the text; "": the text
};

HtmlCell text_cell(const std::string& plain);
HtmlCell number_cell(double x);
HtmlCell count_cell(std::int64_t n);

struct HtmlTable {
  std::string id;                    ///< "": none
  std::string caption;               ///< plain text, which readers of screens read first
  std::vector<std::string> columns;  ///< plain text
  bool sortable = false;
  std::vector<std::vector<HtmlCell>> rows = {};  ///< the first cell of each is its head
};

/// A table that scrolls by itself when it is wider than the page. "" without rows.
std::string html_of(const HtmlTable& table);

/// <section> with a heading; "" without content.
std::string section(const std::string& id, const std::string& heading, const std::string& content);

/// <ul>; texts are plain. "" without any.
std::string list_of(const std::vector<std::string>& texts);

}  // namespace command
