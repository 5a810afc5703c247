// SPDX-License-Identifier: BSD-3-Clause
// Triangle's files: .poly (points, segments, holes, regions) and .node (points); J. R. Shewchuk's description of the formats.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "io/plane/plane_files.h"
#include "io/plane/tokens.h"
#include "io/text.h"
#include "predicates/predicates.h"

namespace carreau {

namespace {

/// Points by their numbers in a file.
struct Points {
  std::vector<PlanePoint> points;
  std::map<int, int> index;
};

/// "number of points, dimension, attributes, markers", then a point a line.
Points read_points(Tokens& in) {
  Points read;
  const int at = in.line();
  const std::size_t n = in.count("the number of points", 3);
  const int dimension = in.integer("the dimension"), attributes = in.integer("the number of attributes"),
            markers = in.integer("the number of markers");
  if (dimension != 2) in.fail(at, "the dimension is " + std::to_string(dimension) + ", not 2");
  if (attributes < 0 || markers < 0 || markers > 1)
    in.fail(at, "the number of attributes is negative, or the number of markers is not 0 or 1");
  for (std::size_t i = 0; i < n; ++i) {
    PlanePoint point;
    point.line = in.line();
    const int number = in.integer("the number of a point");
    point.xy.x() = in.real("a coordinate"), point.xy.y() = in.real("a coordinate");
    for (int k = 0; k < attributes; ++k) (void)in.real("an attribute");
    if (markers == 1) point.ref = in.integer("a marker");
    point.imposed = point.may_drop = true;
    point.name = std::to_string(number);
    if (!read.index.emplace(number, static_cast<int>(i)).second)
      in.fail(point.line, "point " + std::to_string(number) + " comes twice");
    read.points.push_back(std::move(point));
  }
  return read;
}

constexpr TokenRules poly_rules{.comment = "#"};

class PolyReader {
 public:
  PolyReader(std::string_view text, const std::string& name, std::string_view nodes, const std::string& nodes_name)
      : in_(text, name, poly_rules), nodes_(nodes), nodes_name_(nodes_name) {
    input_.source = name;
    input_.arrange = true;
  }

  PlaneDomainInput read() {
    input_.rest = PlaneRest::inside;
    points();
    segments();
    seeds(in_.count("the number of holes", 3), true);
    if (!in_.at_end()) seeds(in_.count("the number of regions", 3), false);
    in_.end();
    number_regions();
    return std::move(input_);
  }

 private:
  void points() {
    const int at = in_.line();
    Points read = read_points(in_);
    if (read.points.empty() && !nodes_.empty()) {
      Tokens in(nodes_, nodes_name_, poly_rules);
      read = read_points(in);
    }
    if (read.points.empty()) in_.fail(at, "the file has no points, and there is no .node file beside it");
    input_.points = std::move(read.points), index_ = std::move(read.index);
  }

  int point() {
    const int at = in_.line(), number = in_.integer("the number of a point");
    const auto found = index_.find(number);
    if (found == index_.end())
      in_.fail(at, "a segment names the point " + std::to_string(number) + ", which does not exist");
    return found->second;
  }

  void segments() {
    const int at = in_.line();
    const std::size_t n = in_.count("the number of segments", 3);
    const int markers = in_.integer("the number of markers");
    if (markers < 0 || markers > 1) in_.fail(at, "the number of markers is neither 0 nor 1");
    for (std::size_t i = 0; i < n; ++i) {
      PlaneCurve curve;
      curve.line = in_.line();
      curve.name = std::to_string(in_.integer("the number of a segment"));
      const int a = point(), b = point();
      curve.points = {a, b};
      if (markers == 1) curve.ref = in_.integer("a marker");
      input_.curves.push_back(std::move(curve));
    }
  }

  void seeds(std::size_t n, bool hole) {
    for (std::size_t i = 0; i < n; ++i) {
      PlaneSeed seed{.at = {}, .hole = hole, .ref = 0, .line = in_.line()};
      const int number = in_.integer(hole ? "the number of a hole" : "the number of a region");
      seed.at.x() = in_.real("a coordinate"), seed.at.y() = in_.real("a coordinate");
      input_.seeds.push_back(seed);
      if (hole) continue;
      numbers_.push_back(number);
      attributes_.push_back(in_.goes_on() ? in_.real("the attribute of a region") : 0);
      in_.skip_line();  // the largest area
    }
  }

  /// Numbers the regions by their attributes if all can be references: attributes of some and numbers of others might
  /// be equal.
  void number_regions() {
    constexpr double most = 1e9;
    const bool by_attribute = std::all_of(attributes_.begin(), attributes_.end(), [](double attribute) {
      return attribute > 0 && attribute <= most && attribute == std::floor(attribute);
    });
    std::size_t region = 0;
    for (PlaneSeed& seed : input_.seeds) {
      if (seed.hole) continue;
      seed.ref = by_attribute ? static_cast<int>(attributes_[region]) : std::max(0, numbers_[region]);
      ++region;
    }
  }

  Tokens in_;
  std::string_view nodes_;
  const std::string& nodes_name_;
  PlaneDomainInput input_;
  std::map<int, int> index_;
  std::vector<int> numbers_;        // of regions
  std::vector<double> attributes_;  // of regions
};

}  // namespace

PlaneDomainInput read_poly_text(std::string_view text, const std::string& name) {
  return PolyReader(text, name, {}, name).read();
}

PlaneDomainInput read_poly_text(std::string_view text, const std::string& name, std::string_view nodes,
                                const std::string& nodes_name) {
  return PolyReader(text, name, nodes, nodes_name).read();
}

PlaneDomainInput read_node_text(std::string_view text, const std::string& name) {
  Tokens in(text, name, poly_rules);
  PlaneDomainInput input;
  input.source = name, input.rest = PlaneRest::inside, input.arrange = true;
  input.points = read_points(in).points;
  in.end();
  // The convex hull by A. M. Andrew's chains; its points on sides are vertices by the arrangement.
  std::vector<int> order(input.points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](int p) -> const Vec2& { return input.points[static_cast<std::size_t>(p)].xy; };
  std::ranges::sort(order, {}, [&](int p) { return std::tuple(at(p).x(), at(p).y(), p); });
  const auto chain = [&](const auto& points) {
    std::vector<int> kept;
    for (const int p : points) {
      while (kept.size() >= 2 && orientation(at(kept[kept.size() - 2]), at(kept.back()), at(p)) <= 0) kept.pop_back();
      kept.push_back(p);
    }
    for (std::size_t k = 1; k < kept.size(); ++k) {
      PlaneCurve& side = input.curves.emplace_back();
      side.points = {kept[k - 1], kept[k]};
      side.name = std::to_string(input.curves.size());
    }
  };
  chain(order);
  std::ranges::reverse(order);
  chain(order);
  return input;
}

}  // namespace carreau
