// SPDX-License-Identifier: BSD-3-Clause
#include "tessellated_step.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <string_view>

#include "failure.h"
#include "text_file.h"

namespace command {
namespace {

constexpr double millimetres_of_metre = 1000, millimetres_of_inch = 25.4;

std::string bytes_of_step(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (text.empty()) throw Failure("'" + path + "' cannot be read: " + std::strerror(errno) + ".");
  return text;
}

/// The records of the data section: text between '=' and ';' by number.
class Records {
 public:
  Records(std::string path, std::string text) : path_(std::move(path)), text_(std::move(text)) { find(); }

  struct Record {
    std::string_view type, arguments;  // a complex entity has no type
  };
  [[nodiscard]] const std::map<int, Record>& all() const { return records_; }

  [[noreturn]] void fail(int number, const std::string& why) const {
    throw Failure("'" + path_ + "', #" + std::to_string(number) + ": " + why + ".");
  }
  [[nodiscard]] const Record& at(int number, int from) const {
    const auto found = records_.find(number);
    if (found == records_.end()) fail(from, "it refers to #" + std::to_string(number) + ", which is not there");
    return found->second;
  }

  /// The arguments of a record, or the members of a list without its brackets.
  static std::vector<std::string_view> split(std::string_view list) {
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
  /// Without the brackets; empty when it has none.
  static std::string_view inside(std::string_view list) {
    return list.size() >= 2 && list.front() == '(' && list.back() == ')' ? list.substr(1, list.size() - 2)
                                                                         : std::string_view();
  }
  static std::string_view trimmed(std::string_view s) {
    constexpr std::string_view blanks = " \t\r\n";
    const std::size_t first = s.find_first_not_of(blanks);
    return first == std::string_view::npos ? std::string_view()
                                           : s.substr(first, s.find_last_not_of(blanks) - first + 1);
  }
  static int reference(std::string_view s) {
    return !s.empty() && s.front() == '#' ? std::atoi(std::string(s.substr(1)).c_str()) : 0;
  }
  /// All numbers of a list, whatever its inner brackets.
  [[nodiscard]] std::vector<double> numbers(std::string_view list, int from) const {
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

 private:
  void find() {
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

  /// Where the record that begins here ends.
  std::size_t take(std::size_t at) {
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

  std::string path_, text_;
  std::map<int, Record> records_;
};

bool is_face(std::string_view type) { return type == "TRIANGULATED_FACE" || type == "COMPLEX_TRIANGULATED_FACE"; }
bool is_body(std::string_view type) { return type == "TESSELLATED_SHELL" || type == "TESSELLATED_SOLID"; }

/// Millimetres of the file's unit of length.
double unit_of(const Records& records) {
  double unit = 1;
  for (const auto& [number, record] : records.all()) {
    if (!record.type.empty() || record.arguments.find("LENGTH_UNIT") == std::string_view::npos) continue;
    if (record.arguments.find("CONVERSION_BASED_UNIT") != std::string_view::npos)
      return record.arguments.find("'INCH") != std::string_view::npos ? millimetres_of_inch : unit;
    if (record.arguments.find(".METRE.") == std::string_view::npos) continue;
    const auto has = [&](const char* prefix) { return record.arguments.find(prefix) != std::string_view::npos; };
    unit = has(".MILLI.") ? 1 : has(".CENTI.") ? 10 : has(".MICRO.") ? 1e-3 : millimetres_of_metre;
  }
  return unit;
}

class TessellationReader {
 public:
  explicit TessellationReader(const Records& records) : records_(records), unit_(unit_of(records)) {}

  Tessellation run() {
    std::vector<int> faces;
    for (const auto& [number, record] : records_.all())
      if (is_body(record.type))
        for (const std::string_view item : Records::split(Records::inside(argument(number, record, 1))))
          if (const int face = Records::reference(item); is_face(records_.at(face, number).type)) faces.push_back(face);
    if (faces.empty())
      for (const auto& [number, record] : records_.all())
        if (is_face(record.type)) faces.push_back(number);
    for (const int face : faces) add_face(face, records_.at(face, face));
    return std::move(made_);
  }

 private:
  [[nodiscard]] std::string_view argument(int number, const Records::Record& record, std::size_t rank) const {
    const std::vector<std::string_view> all = Records::split(record.arguments);
    if (rank >= all.size()) records_.fail(number, "it has too few attributes");
    return all[rank];
  }

  /// Where the points of a list begin among the vertices.
  std::int64_t points(int list, int from, std::int64_t& count) {
    const Records::Record& record = records_.at(list, from);
    if (record.type != "COORDINATES_LIST") records_.fail(from, "its coordinates are no COORDINATES_LIST");
    const auto [known, fresh] = first_of_list_.try_emplace(list, std::pair(0, 0));
    if (fresh) {
      const std::vector<double> values = records_.numbers(argument(list, record, 2), list);
      if (values.empty() || values.size() % 3 != 0) records_.fail(list, "its points have no three coordinates");
      known->second = {static_cast<std::int64_t>(made_.vertices.size() / 3),
                       static_cast<std::int64_t>(values.size() / 3)};
      for (const double x : values) made_.vertices.push_back(unit_ * x);
    }
    count = known->second.second;
    return known->second.first;
  }

  void add_face(int number, const Records::Record& record) {
    ++ref_;
    std::int64_t count = 0;
    const std::int64_t first = points(Records::reference(argument(number, record, 1)), number, count);
    const std::vector<double> index = records_.numbers(argument(number, record, 5), number);
    const auto vertex = [&](double local) {
      double rank = local;
      if (!index.empty()) {
        if (!(local >= 1 && local <= static_cast<double>(index.size())))
          records_.fail(number, "an index is out of range");
        rank = index[static_cast<std::size_t>(local) - 1];
      }
      if (!(rank >= 1 && rank <= static_cast<double>(count))) records_.fail(number, "an index is out of range");
      return static_cast<std::int32_t>(first + static_cast<std::int64_t>(rank) - 1);
    };
    const auto add = [&](double a, double b, double c) {
      const std::int32_t corners[] = {vertex(a), vertex(b), vertex(c)};
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        return;  // a turn of a strip
      made_.triangles.insert(made_.triangles.end(), std::begin(corners), std::end(corners));
      made_.refs.push_back(ref_);
    };
    if (record.type == "TRIANGULATED_FACE") {
      const std::vector<double> corners = records_.numbers(argument(number, record, 6), number);
      if (corners.size() % 3 != 0) records_.fail(number, "a triangle has no three corners");
      for (std::size_t i = 0; i + 2 < corners.size(); i += 3) add(corners[i], corners[i + 1], corners[i + 2]);
      return;
    }
    for (const std::string_view strip : Records::split(Records::inside(argument(number, record, 6)))) {
      const std::vector<double> p = records_.numbers(strip, number);
      for (std::size_t i = 2; i < p.size(); ++i)
        i % 2 == 0 ? add(p[i - 2], p[i - 1], p[i]) : add(p[i - 1], p[i - 2], p[i]);
    }
    for (const std::string_view fan : Records::split(Records::inside(argument(number, record, 7)))) {
      const std::vector<double> p = records_.numbers(fan, number);
      for (std::size_t i = 2; i < p.size(); ++i) add(p[0], p[i - 1], p[i]);
    }
  }

  const Records& records_;
  double unit_;
  Tessellation made_;
  std::int32_t ref_ = 0;
  std::map<int, std::pair<std::int64_t, std::int64_t>> first_of_list_;
};

}  // namespace

bool is_tessellated_step(const std::string& path) {
  constexpr std::size_t head = 1 << 16;
  const std::string suffix = suffix_of(path);
  if (suffix != ".stp" && suffix != ".step") return false;
  std::ifstream stream(path, std::ios::binary);
  std::string start(head, '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(stream.gcount()));
  if (start.find("AP242") == std::string::npos) return false;  // of the schema: no other one has tessellated shapes
  const std::string text = bytes_of_step(path);
  const auto has = [&](const char* type) { return text.find(type) != std::string::npos; };
  return has("TRIANGULATED_FACE") && !has("ADVANCED_FACE") && !has("FACE_SURFACE");
}

Tessellation read_tessellation(const std::string& path) {
  const Records records(path, bytes_of_step(path));
  for (const auto& [number, record] : records.all())
    if (record.type == "NEXT_ASSEMBLY_USAGE_OCCURRENCE")
      records.fail(number, "tessellated parts of an assembly are not read");
  return TessellationReader(records).run();
}

}  // namespace command
