// SPDX-License-Identifier: BSD-3-Clause
// Airfoils as the UIUC Airfoil Coordinates Database has them: a name, then points. In Selig's layout points run from the
// trailing edge over the upper side to the leading edge and back below. Lednicer's layout starts with numbers of points;
// then come the upper and the lower side, each from the leading edge.
#include <algorithm>
#include <cmath>
#include <optional>

#include "io/plane/plane_files.h"
#include "io/text.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

struct Row {
  Vec2 xy;
  int line = 0;
};

class AirfoilReader {
 public:
  AirfoilReader(std::string_view text, const std::string& name) : name_(name) { read_rows(text); }

  PlaneDomainInput read() {
    input_.source = name_, input_.rest = PlaneRest::inside, input_.arrange = true;
    order_sides();
    std::vector<Row> kept;
    for (const Row& row : rows_)
      if (kept.empty() || row.xy != kept.back().xy) kept.push_back(row);
    const bool sharp = kept.size() > 1 && kept.front().xy == kept.back().xy;
    if (sharp) kept.pop_back();
    if (kept.size() < 3) fail(last_line_, "an airfoil has three different points or more, not " + std::to_string(kept.size()));
    constexpr int surface = 1, base = 2;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      PlanePoint& point = input_.points.emplace_back();
      point.xy = kept[i].xy, point.line = kept[i].line, point.name = std::to_string(i + 1);
      PlaneCurve& side = input_.curves.emplace_back();
      const bool closes = i + 1 == kept.size();
      side.points = {static_cast<int>(i), closes ? 0 : static_cast<int>(i + 1)};
      side.ref = closes && !sharp ? base : surface;
      side.line = kept[i].line, side.name = std::to_string(i + 1);
    }
    return std::move(input_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& sentence) const {
    throw FileError({.file = name_, .line = std::max(line, 1)}, sentence);
  }

  /// Two finite numbers, perhaps with a comma between them.
  static std::optional<Vec2> numbers_in(std::string_view line) {
    std::string words(line);
    std::ranges::replace(words, ',', ' ');
    std::string_view rest = trimmed(words);
    Vec2 xy;
    for (int k = 0; k < 2; ++k) {
      const std::size_t end = rest.find_first_of(" \t");
      if (!parse_number(rest.substr(0, end), xy[k]) || !std::isfinite(xy[k])) return std::nullopt;
      rest = end == std::string_view::npos ? std::string_view{} : trimmed(rest.substr(end));
      if (k == 0 && rest.empty()) return std::nullopt;
    }
    return rest.empty() ? std::optional<Vec2>(xy) : std::nullopt;
  }

  void read_rows(std::string_view text) {
    text = without_byte_order_mark(text);
    for (std::size_t from = 0; from < text.size();) {
      const std::size_t end = std::min(text.find('\n', from), text.size());
      const std::string_view line = trimmed(text.substr(from, end - from));
      from = end + 1, ++last_line_;
      if (line.empty() || line.front() == '#') continue;
      const auto xy = numbers_in(line);
      if (!xy && !rows_.empty()) fail(last_line_, "two coordinates were expected, not " + shown(line));
      if (!xy && titled_) fail(last_line_, "two coordinates or two numbers of points were expected, not " + shown(line));
      if (xy)
        rows_.push_back({*xy, last_line_});
      else
        titled_ = true;
    }
  }

  /// Lednicer's rows become Selig's.
  void order_sides() {
    if (rows_.empty()) fail(last_line_, "the file has no points");
    const Vec2 counts = rows_.front().xy;
    const bool whole = counts.x() == std::floor(counts.x()) && counts.y() == std::floor(counts.y());
    constexpr double smallest = 2, largest = 1e6;  // a chord is 1: coordinates are smaller
    if (!whole || counts.minCoeff() < smallest || counts.maxCoeff() > largest) return;
    const auto upper = static_cast<std::ptrdiff_t>(counts.x()), lower = static_cast<std::ptrdiff_t>(counts.y());
    if (static_cast<std::ptrdiff_t>(rows_.size()) != 1 + upper + lower)
      fail(rows_.front().line, std::to_string(upper) + " and " + std::to_string(lower) + " points are announced, and there are " +
                                   std::to_string(rows_.size() - 1));
    rows_.erase(rows_.begin());
    std::reverse(rows_.begin(), rows_.begin() + upper);
  }

  const std::string& name_;
  std::vector<Row> rows_;
  PlaneDomainInput input_;
  int last_line_ = 0;
  bool titled_ = false;
};

}  // namespace

PlaneDomainInput read_airfoil_text(std::string_view text, const std::string& name) {
  return AirfoilReader(text, name).read();
}

}  // namespace carreau
