// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/tessellated/step_records.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "base/failure.h"

namespace command {

std::string bytes_of_step(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (text.empty()) throw Failure("'" + path + "' cannot be read: " + std::strerror(errno) + ".");
  return text;
}

StepRecords::StepRecords(std::string path, std::string text) : path_(std::move(path)), text_(std::move(text)) {
  find();
}

void StepRecords::fail(int number, const std::string& why) const {
  throw Failure("'" + path_ + "', #" + std::to_string(number) + ": " + why + ".");
}

const StepRecords::Record& StepRecords::at(int number, int from) const {
  const auto found = records_.find(number);
  if (found == records_.end()) fail(from, "it refers to #" + std::to_string(number) + ", which is not there");
  return found->second;
}

std::string_view StepRecords::argument(int number, const Record& record, std::size_t rank) const {
  const std::vector<std::string_view> all = split(record.arguments);
  if (rank >= all.size()) fail(number, "it has too few attributes");
  return all[rank];
}

std::vector<int> StepRecords::references(std::string_view list) {
  std::vector<int> numbers;
  for (const std::string_view item : split(inside(list)))
    if (const int number = reference(item); number != 0) numbers.push_back(number);
  return numbers;
}

std::vector<double> StepRecords::numbers(std::string_view list, int from) const {
  std::vector<double> values;
  const char *at = list.data(), *const end = at + list.size();
  while (at < end) {
    if (std::strchr("(), \t\r\n", *at) != nullptr) {
      ++at;
      continue;
    }
    char* next = nullptr;
    values.push_back(std::strtod(at, &next));  // the text ends with a zero
    if (next == at) fail(from, "a number was expected, not '" + std::string(1, *at) + "'");
    at = next;
  }
  return values;
}

std::vector<std::string_view> StepRecords::split(std::string_view list) {
  std::vector<std::string_view> parts;
  int depth = 0;
  bool text = false;
  std::size_t from = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const char c = list[i];
    if (c == '\'') text = !text;
    if (text) continue;
    if (c == '(') ++depth;
    if (c == ')') --depth;
    if (c == ',' && depth == 0) parts.push_back(trimmed(list.substr(from, i - from))), from = i + 1;
  }
  if (!trimmed(list.substr(from)).empty() || !parts.empty()) parts.push_back(trimmed(list.substr(from)));
  return parts;
}

std::string_view StepRecords::inside(std::string_view list) {
  return list.size() >= 2 && list.front() == '(' && list.back() == ')' ? list.substr(1, list.size() - 2)
                                                                       : std::string_view();
}

std::string_view StepRecords::trimmed(std::string_view s) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = s.find_first_not_of(blanks);
  return first == std::string_view::npos ? std::string_view()
                                         : s.substr(first, s.find_last_not_of(blanks) - first + 1);
}

int StepRecords::reference(std::string_view s) {
  return !s.empty() && s.front() == '#' ? std::atoi(std::string(s.substr(1)).c_str()) : 0;
}

StepRecords::Record StepRecords::part(const Record& record, std::string_view type) {
  if (!record.type.empty()) return record.type == type ? record : Record{};
  const std::string_view all = record.arguments;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t bracket = all.find('(', at);
    if (bracket == std::string_view::npos) break;
    std::size_t end = bracket;
    bool text = false;
    for (int depth = 0; end < all.size(); ++end) {
      if (all[end] == '\'') text = !text;
      if (text) continue;
      if (all[end] == '(') ++depth;
      if (all[end] == ')' && --depth == 0) break;
    }
    if (end == all.size()) break;
    if (trimmed(all.substr(at, bracket - at)) == type) return {type, all.substr(bracket + 1, end - bracket - 1)};
    at = end + 1;
  }
  return {};
}

void StepRecords::find() {
  std::size_t at = text_.find("DATA;");
  while (at != std::string::npos) {
    at = text_.find_first_of("#'/", at);
    if (at == std::string::npos) return;
    if (text_[at] == '\'')
      at = text_.find('\'', at + 1);
    else if (text_.compare(at, 2, "/*") == 0)
      at = text_.find("*/", at + 2);
    else if (text_[at] == '#') {
      at = take(at);
      continue;
    }
    if (at != std::string::npos) ++at;
  }
}

std::size_t StepRecords::take(std::size_t at) {
  const int number = std::atoi(text_.c_str() + at + 1);
  std::size_t end = at;
  for (bool text = false; end < text_.size() && (text || text_[end] != ';'); ++end)
    if (text_[end] == '\'') text = !text;
  const std::size_t equals = text_.find('=', at);
  if (equals == std::string::npos || equals > end) return end;
  const std::string_view body = trimmed(std::string_view(text_).substr(equals + 1, end - equals - 1));
  const std::size_t bracket = body.find('(');
  if (bracket == std::string_view::npos) return end;
  records_[number] = {trimmed(body.substr(0, bracket)), inside(body.substr(bracket))};
  return end;
}

}  // namespace command
