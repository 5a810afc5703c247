// SPDX-License-Identifier: BSD-3-Clause
#include "report/html_text.h"

#include <cmath>
#include <cstdio>

namespace command {
namespace {

constexpr const char* replacement = "\xEF\xBF\xBD";  // U+FFFD

/// Length of the UTF-8 sequence at `at`; 0: invalid (RFC 3629: no surrogates, nothing longer than needed).
std::size_t sequence_at(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(at + k < text.size() ? text[at + k] : 0); };
  const auto follows = [&](std::size_t k, int low = 0x80, int high = 0xBF) { return byte(k) >= low && byte(k) <= high; };
  const int first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const int low = first == 0xE0 ? 0xA0 : 0x80, high = first == 0xED ? 0x9F : 0xBF;
    return follows(1, low, high) && follows(2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const int low = first == 0xF0 ? 0x90 : 0x80, high = first == 0xF4 ? 0x8F : 0xBF;
    return follows(1, low, high) && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

/// A character of ASCII as HTML has it.
std::string escaped(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    case '\n':
    case '\t':
      return std::string(1, c);
    default:
      return c < ' ' || c == '\x7f' ? replacement : std::string(1, c);
  }
}

std::string head_of(const HtmlTable& table) {
  std::string text = "<thead><tr>";
  for (const std::string& column : table.columns)
    text += "<th scope=\"col\">" +
            (table.sortable ? "<button type=\"button\" class=\"sort\">" + html(column) + "</button>" : html(column)) +
            "</th>";
  return text + "</tr></thead>\n";
}

std::string row_of(const std::vector<HtmlCell>& row) {
  std::string text = "<tr>";
  for (std::size_t i = 0; i < row.size(); ++i) {
    const HtmlCell& cell = row[i];
    const std::string tag = i == 0 ? "th" : "td";
    text += "<" + tag + (i == 0 ? " scope=\"row\"" : "") + (cell.is_number ? " class=\"number\"" : "") +
            (cell.sort.empty() ? "" : " data-sort=\"" + cell.sort + "\"") + ">" + cell.text + "</" + tag + ">";
  }
  return text + "</tr>\n";
}

}  // namespace

std::string html(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_at(text, i);
    if (length == 1)
      result += escaped(text[i]);
    else
      result += length == 0 ? std::string(replacement) : text.substr(i, length);
    i += length == 0 ? 1 : length;
  }
  return result;
}

std::string number_text(double x) {
  if (std::isnan(x)) return "none";
  if (std::isinf(x)) return x > 0 ? "∞" : "−∞";
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

std::string count_text(std::int64_t n) {
  std::string text = std::to_string(n);
  for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > (n < 0 ? 1 : 0); at -= 3)
    text.insert(static_cast<std::size_t>(at), "\xE2\x80\xAF");  // narrow no-break space
  return text;
}

HtmlCell text_cell(const std::string& plain) { return {html(plain)}; }

HtmlCell number_cell(double x) {
  char sort[40];
  std::snprintf(sort, sizeof sort, "%.17g", x);
  return {number_text(x), true, std::isfinite(x) ? sort : "-1e999"};
}

HtmlCell count_cell(std::int64_t n) { return {count_text(n), true, std::to_string(n)}; }

std::string html_of(const HtmlTable& table) {
  if (table.rows.empty()) return "";
  std::string text = "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + html(table.caption) +
                     "\"><table" + (table.id.empty() ? "" : " id=\"" + table.id + "\"") + "><caption>" +
                     html(table.caption) + "</caption>\n";
  if (!table.columns.empty()) text += head_of(table);
  text += "<tbody>\n";
  for (const auto& row : table.rows) text += row_of(row);
  return text + "</tbody></table></div>\n";
}

std::string section(const std::string& id, const std::string& heading, const std::string& content) {
  if (content.empty()) return "";
  return "<section id=\"" + id + "\" aria-labelledby=\"" + id + "-heading\"><h2 id=\"" + id + "-heading\">" +
         html(heading) + "</h2>\n" + content + "</section>\n";
}

std::string list_of(const std::vector<std::string>& texts) {
  if (texts.empty()) return "";
  std::string list = "<ul>\n";
  for (const std::string& text : texts) list += "<li>" + html(text) + "</li>\n";
  return list + "</ul>\n";
}

}  // namespace command
