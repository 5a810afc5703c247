// SPDX-License-Identifier: BSD-3-Clause
// Triangle's .poly files: points, segments, holes, regions; J. R. Shewchuk's description of the format.
#include <algorithm>
#include <cmath>
#include <map>

#include "io/plane/plane_files.h"
#include "io/plane/tokens.h"
#include "io/text.h"

namespace carreau {

namespace {

class PolyReader {
 public:
  PolyReader(std::string_view text, const std::string& name) : in_(text, name, {.comment = "#"}) {
    input_.source = name;
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
    const std::size_t n = in_.count("the number of points", 3);
    if (n == 0) in_.fail(at, "the file has no points of its own; those of a .node file are not read");
    const int dimension = in_.integer("the dimension"), attributes = in_.integer("the number of attributes"),
              markers = in_.integer("the number of markers");
    if (dimension != 2) in_.fail(at, "the dimension is " + std::to_string(dimension) + ", not 2");
    if (attributes < 0 || markers < 0 || markers > 1)
      in_.fail(at, "the number of attributes is negative, or that of markers neither 0 nor 1");
    for (std::size_t i = 0; i < n; ++i) {
      PlanePoint point;
      point.line = in_.line();
      const int number = in_.integer("the number of a point");
      point.xy.x() = in_.real("a coordinate"), point.xy.y() = in_.real("a coordinate");
      for (int k = 0; k < attributes; ++k) (void)in_.real("an attribute");
      if (markers == 1) point.ref = in_.integer("a marker");
      point.imposed = point.may_drop = true;
      point.name = std::to_string(number);
      if (!index_.emplace(number, static_cast<int>(i)).second)
        in_.fail(point.line, "point " + std::to_string(number) + " comes twice");
      input_.points.push_back(std::move(point));
    }
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

  /// By their attributes if all can be references: those of some and numbers of others might be the same.
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
  PlaneDomainInput input_;
  std::map<int, int> index_;
  std::vector<int> numbers_;        // of regions
  std::vector<double> attributes_;  // of regions
};

}  // namespace

PlaneDomainInput read_poly_text(std::string_view text, const std::string& name) {
  return PolyReader(text, name).read();
}

}  // namespace carreau
