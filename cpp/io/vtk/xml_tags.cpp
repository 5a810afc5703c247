// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtk/xml_tags.h"

#include <algorithm>
#include <utility>

#include "io/text.h"

namespace carreau {

namespace {

constexpr bool is_blank(char c) noexcept { return c == ' ' || (c >= '\t' && c <= '\r'); }
constexpr bool is_of_name(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == ':' || c == '.';
}

/// The five predefined entities of XML; others stay as they are.
std::string unescaped(std::string_view text) {
  static constexpr std::pair<std::string_view, char> entities[] = {
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  std::string result;
  while (!text.empty()) {
    const auto* const found = std::find_if(std::begin(entities), std::end(entities),
                                           [&](const auto& entity) { return text.starts_with(entity.first); });
    const bool any = found != std::end(entities);
    result += any ? found->second : text.front();
    text.remove_prefix(any ? found->first.size() : 1);
  }
  return result;
}

}  // namespace

std::string XmlTag::attribute(std::string_view key) const {
  const auto found = attributes.find(key);
  return found == attributes.end() ? "" : found->second;
}

void XmlTags::skip_to(const char* at, std::string_view closing) {
  p_ = std::search(p_, end_, closing.begin(), closing.end());
  if (p_ == end_) fail(at, "the file ends before " + std::string(closing) + " closes what begins here");
  p_ += closing.size();
}

void XmlTags::skip_blanks() noexcept {
  while (p_ != end_ && is_blank(*p_)) ++p_;
}

std::string_view XmlTags::name(const char* at) {
  const char* const begin = p_;
  while (p_ != end_ && is_of_name(*p_)) ++p_;
  if (p_ == begin) fail(at, "this is not a tag of XML");
  return {begin, static_cast<std::size_t>(p_ - begin)};
}

void XmlTags::attribute(XmlTag& tag) {
  const std::string_view key = name(tag.at);
  skip_blanks();
  if (p_ == end_ || *p_ != '=') fail(tag.at, "attribute " + shown(key) + " has no value");
  ++p_;
  skip_blanks();
  if (p_ == end_ || (*p_ != '"' && *p_ != '\'')) fail(tag.at, "the value of " + shown(key) + " has no quotes");
  const char quote = *p_++;
  const char* const begin = p_;
  while (p_ != end_ && *p_ != quote) ++p_;
  if (p_ == end_) fail(tag.at, "the value of " + shown(key) + " is not closed");
  if (!tag.attributes.emplace(key, unescaped({begin, static_cast<std::size_t>(p_ - begin)})).second)
    fail(tag.at, "attribute " + shown(key) + " is given twice");
  ++p_;
}

XmlTag XmlTags::next() {
  for (;;) {
    p_ = std::find(p_, end_, '<');
    XmlTag tag;
    tag.at = p_;
    if (p_ == end_) return tag;
    ++p_;
    const std::string_view rest(p_, static_cast<std::size_t>(end_ - p_));
    if (rest.starts_with("?")) {
      skip_to(tag.at, "?>");
      continue;
    }
    if (rest.starts_with("!--")) {
      skip_to(tag.at, "-->");
      continue;
    }
    if (rest.starts_with("/")) ++p_, tag.opens = false, tag.closes = true;
    tag.name = name(tag.at);
    for (;;) {
      skip_blanks();
      if (p_ == end_) fail(tag.at, "the file ends inside a tag");
      if (*p_ == '>') break;
      if (*p_ == '/') {
        tag.closes = true;
        ++p_;
        continue;
      }
      attribute(tag);
    }
    tag.after = ++p_;
    return tag;
  }
}

}  // namespace carreau
