// SPDX-License-Identifier: BSD-3-Clause
// Files of BL2D: .data, .g, and sizes .hg, .hc, .h.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "io/plane/plane_files.h"
#include "io/plane/tokens.h"
#include "io/text.h"
#include "support/error.h"

namespace carreau {

namespace {

constexpr const char *end_of_section = ";", *arc_word = "ARC";

/// A control polygon, -1 for NULL, as a spline.
PlaneCurve spline_of(const std::vector<int>& control) {
  PlaneCurve curve;
  curve.smooth = true;
  curve.before = control.front(), curve.after = control.back();
  curve.points.assign(control.begin() + 1, control.end() - 1);
  return curve;
}

bool positive_definite(const Metric2& m) noexcept {
  return m.a > 0 && m.c > 0 && determinant(m) > 0 && std::isfinite(determinant(m));
}

/// Sizes h1 along a direction and h2 across (RR-2818 sec. 4.2).
Metric2 metric_along(double degrees, double h1, double h2) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const double p = 1 / (h1 * h1), q = 1 / (h2 * h2);
  return {p * c * c + q * s * s, (p - q) * c * s, p * s * s + q * c * c};
}

/// The side of a curve on which a subdomain lies, behind the number of the curve.
PlaneSide side_of(Tokens& in, int line, int curve, const char* signs) {
  PlaneSide side;
  side.line = line, side.curve = curve;
  const int sign = in.integer("the side of a segment");
  if (sign != 1 && sign != -1) in.fail(line, "the side of a segment is " + std::to_string(sign) + "; it must be " + signs);
  side.left = sign > 0;
  side.ref = in.integer("the reference of a subdomain");
  return side;
}

class DataReader {
 public:
  DataReader(std::string_view text, const std::string& name) : in_(text, name, {.comment = "--", .semicolons = true}) {
    input_.source = name;
  }

  PlaneDomainInput read() {
    input_.rest = PlaneRest::outside;
    for (const char* limit :
         {"the largest number of points", "the largest number of segments", "the largest number of subdomains"})
      (void)in_.count(limit, 0);
    while (!in_.take(end_of_section)) add_point();
    while (!in_.take(end_of_section)) input_.points[point("an imposed point")].imposed = true;
    while (!in_.take(end_of_section)) add_segment();
    while (!in_.take(end_of_section)) {
      const int p = point("a point");
      input_.points[p].ref = in_.integer("the reference of a point");
    }
    while (!in_.take(end_of_section)) {
      const int c = segment();
      input_.curves[c].ref = in_.integer("the reference of a segment");
    }
    while (!in_.take(end_of_section)) add_subdomain();
    if (!in_.at_end()) sizes();
    in_.end();
    return std::move(input_);
  }

 private:
  void add_point() {
    const Token name = in_.word("the name of a point");
    PlanePoint point;
    point.line = name.line, point.name = name.text;
    point.xy.x() = in_.real("a coordinate"), point.xy.y() = in_.real("a coordinate");
    if (name.text == "NULL") in_.fail(name.line, "no point may have the name NULL");
    if (!points_.emplace(point.name, static_cast<int>(input_.points.size())).second)
      in_.fail(name.line, "the point " + shown(name.text) + " comes twice");
    input_.points.push_back(std::move(point));
  }

  int point(const char* what) {
    const Token name = in_.word(what);
    const auto found = points_.find(std::string(name.text));
    if (found == points_.end()) in_.fail(name.line, "there is no point " + shown(name.text));
    return found->second;
  }

  int segment() {
    const Token name = in_.word("the name of a segment");
    const auto found = segments_.find(std::string(name.text));
    if (found == segments_.end()) in_.fail(name.line, "there is no segment " + shown(name.text));
    return found->second;
  }

  void add_segment() {
    const Token name = in_.word("the name of a segment");
    // Ours: `C ARC A M B ;`. A file that has a point of this name is an old one.
    const bool arcs = !points_.contains(arc_word) && in_.take(arc_word);
    std::vector<int> control;
    while (!in_.take(end_of_section)) control.push_back(in_.take("NULL") ? -1 : point("a control point"));
    if (arcs) return add_arcs(name, std::move(control));
    if (control.size() < 4)
      in_.fail(name.line, "the segment " + shown(name.text) + " has " + std::to_string(control.size()) +
                              " control points; it needs four: one before it, its ends, one behind");
    for (std::size_t i = 1; i + 1 < control.size(); ++i)
      if (control[i] < 0) in_.fail(name.line, "the segment " + shown(name.text) + " has NULL between its ends");
    add_curve(name, spline_of(control));
  }

  void add_arcs(const Token& name, std::vector<int> points) {
    if (std::find(points.begin(), points.end(), -1) != points.end())
      in_.fail(name.line, "the segment " + shown(name.text) + " of arcs has NULL; arcs pass all of their points");
    if (points.size() < 3 || points.size() % 2 == 0)
      in_.fail(name.line, "the segment " + shown(name.text) + " of arcs has " + std::to_string(points.size()) +
                              " points; each arc has a start, a point between and an end, with which the next starts");
    PlaneCurve curve;
    curve.arcs = true;
    curve.points = std::move(points);
    add_curve(name, std::move(curve));
  }

  void add_curve(const Token& name, PlaneCurve curve) {
    if (!segments_.emplace(std::string(name.text), static_cast<int>(input_.curves.size())).second)
      in_.fail(name.line, "the segment " + shown(name.text) + " comes twice");
    curve.line = name.line, curve.name = name.text;
    input_.curves.push_back(std::move(curve));
  }

  void add_subdomain() {
    const int line = in_.line(), curve = segment();
    input_.sides.push_back(side_of(in_, line, curve, "+1 or -1"));
  }

  double size() {
    const int at = in_.line();
    const double h = in_.real("a size");
    if (!(h > 0)) in_.fail(at, "a size is not positive");
    return h;
  }

  void sizes() {
    const Token kind = in_.word("isotrope or anisotrope");
    const bool isotropic = kind.text == "isotrope";
    if (!isotropic && kind.text != "anisotrope")
      in_.fail(kind.line, "isotrope or anisotrope was expected, not " + shown(kind.text));
    while (!in_.take(end_of_section)) {
      const int at = in_.line();
      PlanePoint& here = input_.points[point("a point")];
      if (isotropic) {
        here.size = size();
        continue;
      }
      const double angle = in_.real("an angle"), h1 = size(), h2 = size();
      here.metric = metric_along(angle, h1, h2);
      if (!positive_definite(*here.metric)) in_.fail(at, "the sizes make no metric");
    }
  }

  Tokens in_;
  PlaneDomainInput input_;
  std::map<std::string, int> points_, segments_;
};

class GeometryReader {
 public:
  GeometryReader(std::string_view text, const std::string& name) : in_(text, name, {}) { input_.source = name; }

  PlaneDomainInput read() {
    input_.rest = PlaneRest::outside;
    const std::size_t points = in_.count("the number of points", 2),
                      imposed = in_.count("the number of imposed points", 1),
                      references = in_.count("the number of points with a reference", 2);
    const int at = in_.line();
    if (in_.integer("the fourth number") != 0)
      in_.fail(at, "the fourth number of the header is not 0: its meaning is unknown");
    const std::size_t segments = in_.count("the number of segments", 3),
                      subdomains = in_.count("the number of subdomains", 3);
    for (std::size_t i = 0; i < points; ++i) {
      PlanePoint point;
      point.line = in_.line();
      point.xy.x() = in_.real("a coordinate"), point.xy.y() = in_.real("a coordinate");
      input_.points.push_back(std::move(point));
    }
    for (std::size_t i = 0; i < imposed; ++i) input_.points[number(points, "an imposed point", 1)].imposed = true;
    for (std::size_t i = 0; i < references; ++i) {
      const int p = number(points, "a point", 1);
      input_.points[p].ref = in_.integer("the reference of a point");
    }
    for (std::size_t i = 0; i < segments; ++i) add_segment(points);
    for (std::size_t i = 0; i < subdomains; ++i) add_subdomain(segments);
    in_.end();
    return std::move(input_);
  }

 private:
  /// A number from 1 as an index; `least` = 0 allows 0, which becomes -1.
  int number(std::size_t n, const char* what, int least) {
    const int at = in_.line(), number = in_.integer(what);
    if (number < least || (number > 0 && static_cast<std::size_t>(number) > n))
      in_.fail(
          at, std::string(what) + " has the number " + std::to_string(number) + ", but there are " + std::to_string(n));
    return number - 1;
  }

  void add_segment(std::size_t points) {
    const int line = in_.line();
    const std::size_t n = in_.count("the number of control points", 1);
    if (n < 4) in_.fail(line, "a segment has " + std::to_string(n) + " control points; it needs four");
    std::vector<int> control;
    for (std::size_t i = 0; i < n; ++i)
      control.push_back(number(points, "a control point", i == 0 || i + 1 == n ? 0 : 1));
    PlaneCurve curve = spline_of(control);
    curve.line = line;
    curve.ref = in_.integer("the reference of a segment");
    input_.curves.push_back(std::move(curve));
  }

  void add_subdomain(std::size_t segments) {
    const int line = in_.line(), curve = number(segments, "a segment", 1);
    input_.sides.push_back(side_of(in_, line, curve, "1 or -1"));
  }

  Tokens in_;
  PlaneDomainInput input_;
};

}  // namespace

PlaneDomainInput read_bl2d_data_text(std::string_view text, const std::string& name) {
  return DataReader(text, name).read();
}
PlaneDomainInput read_bl2d_g_text(std::string_view text, const std::string& name) {
  return GeometryReader(text, name).read();
}

Solution read_bl2d_sizes_text(std::string_view text, const std::string& name) {
  Tokens in(text, name, {});
  const int at = in.line();
  const std::size_t n = in.count("the number of values", 1);
  const int components = in.integer("the number of components");
  if (components != 1 && components != 3)
    in.fail(at, "the number of components is " + std::to_string(components) + "; it must be 1 (sizes) or 3 (metrics)");
  Solution solution{.dimension = 2, .tensor = components == 3, .values = {}};
  for (std::size_t i = 0; i < n; ++i) {
    const int line = in.line();
    for (int k = 0; k < components; ++k) solution.values.push_back(in.real("a value"));
    if (solution.tensor ? !positive_definite(plane_tensor(solution, i)) : !(solution.values.back() > 0))
      in.fail(line, solution.tensor ? "a metric is not positive definite" : "a size is not positive");
  }
  in.end();
  return solution;
}

void set_point_sizes(PlaneDomainInput& input, const Solution& sizes, const std::string& name) {
  if (sizes.count() != input.points.size())
    throw FileError({.file = name}, "it has values at " + std::to_string(sizes.count()) + " points, but " +
                                        input.source + " has " + std::to_string(input.points.size()));
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    if (sizes.tensor)
      input.points[i].metric = plane_tensor(sizes, i);
    else
      input.points[i].size = sizes.values[i];
  }
}

}  // namespace carreau
