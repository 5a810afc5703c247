// SPDX-License-Identifier: BSD-3-Clause
#include "curves/curve_output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/failure.h"

namespace command {
namespace {

std::string exact(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

std::size_t count_edges(const CutCurves& cut) {
  std::size_t edges = 0;
  for (const CutCurve& curve : cut.curves) edges += curve.vertices.size() - 1;
  return edges;
}

/// Lower left and upper right corner.
std::array<Point, 2> box_of(const std::vector<Point>& points) {
  std::array<Point, 2> box{points.front(), points.front()};
  for (const Point& p : points)
    for (std::size_t k = 0; k < 3; ++k) box[0][k] = std::min(box[0][k], p[k]), box[1][k] = std::max(box[1][k], p[k]);
  return box;
}

std::string pair_text(const Point& p) { return exact(p[0]) + " " + exact(p[1]); }

constexpr int circle_sides = 72;

/// The unit circle of a metric (xx xy yy) around p, by the inverse of its Cholesky factor.
std::vector<Point> unit_circle(const Point& p, double xx, double xy, double yy) {
  const double l11 = std::sqrt(xx), l21 = xy / l11, l22 = std::sqrt(yy - l21 * l21);
  std::vector<Point> circle;
  for (int i = 0; i <= circle_sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / circle_sides, y = std::sin(angle) / l22;
    circle.push_back({p[0] + (std::cos(angle) - l21 * y) / l11, p[1] + y, 0});
  }
  return circle;
}

}  // namespace

std::string medit_text(const CutCurves& cut) {
  std::string text = "MeshVersionFormatted 2\nDimension " + std::to_string(cut.dimension) + "\nVertices\n" + std::to_string(cut.points.size()) + "\n";
  for (const Point& p : cut.points) text += pair_text(p) + (cut.dimension == 3 ? " " + exact(p[2]) : "") + " 0\n";
  text += "Edges\n" + std::to_string(count_edges(cut)) + "\n";
  for (const CutCurve& curve : cut.curves)
    for (std::size_t i = 1; i < curve.vertices.size(); ++i)
      text += std::to_string(curve.vertices[i - 1] + 1) + " " + std::to_string(curve.vertices[i] + 1) + " " + std::to_string(curve.ref) + "\n";
  return text + "End\n";
}

std::string c_file_text(const CutCurves& cut) {
  if (cut.dimension != 2) throw Failure("A .mc file has dimension 2; these curves have dimension 3.");
  const std::string vertices = std::to_string(cut.points.size()), curves = std::to_string(cut.curves.size());
  const auto [low, high] = box_of(cut.points);
  std::string text = "p1\n" + vertices + " " + std::to_string(count_edges(cut)) + " 1\n" + pair_text(low) + "\n" + pair_text(high) + "\n\n";
  for (const Point& p : cut.points) text += pair_text(p) + "\n";
  text += "\n";
  for (const CutCurve& curve : cut.curves)
    for (std::size_t i = 1; i < curve.vertices.size(); ++i)
      text += "1 " + std::to_string(curve.vertices[i - 1] + 1) + " " + std::to_string(curve.vertices[i] + 1) + "\n";
  const std::vector<std::size_t>& first = cut.curves.front().vertices;
  text += "\n" + std::to_string(first[0] + 1) + " " + std::to_string(first[1] + 1) + "\n\nsupplement\n" + vertices + " 0 " +
          std::to_string(cut.ends) + " " + std::to_string(cut.points.size() - cut.ends) + " " + curves + "\n";
  for (const CutCurve& curve : cut.curves) {
    text += std::to_string(curve.vertices.size()) + "\n";
    for (std::size_t i = 0; i < curve.vertices.size(); ++i) text += std::to_string(curve.vertices[i] + 1) + " " + exact(curve.abscissae[i]) + "\n";
  }
  return text + "\n0 tgvectors\n";
}

std::string svg_text(const CutCurves& cut, const CurveInput& input, const std::vector<double>& metrics) {
  const std::size_t width = input.dimension == 2 ? 3 : 6;
  std::vector<std::vector<Point>> circles;
  std::vector<Point> all = cut.points;
  for (std::size_t i = 0; i < input.points.size() && !metrics.empty(); ++i) {
    const double* m = &metrics[i * width];
    circles.push_back(unit_circle(input.points[i], m[0], m[1], width == 3 ? m[2] : m[3]));
    all.insert(all.end(), circles.back().begin(), circles.back().end());
  }
  for (const CutCurve& curve : cut.curves) all.insert(all.end(), curve.support.begin(), curve.support.end());
  const auto [low, high] = box_of(all);
  constexpr double pixels = 800, margin = 10;
  const double extent = std::max(high[0] - low[0], high[1] - low[1]), scale = extent > 0 ? (pixels - 2 * margin) / extent : 1;
  const auto place = [&, low = low, high = high](const Point& p) {
    char text[64];
    std::snprintf(text, sizeof text, "%.2f,%.2f", margin + scale * (p[0] - low[0]), margin + scale * (high[1] - p[1]));
    return std::string(text);
  };
  const auto line = [&](const std::vector<Point>& points, const char* style) {
    std::string text = "<polyline fill=\"none\" " + std::string(style) + " points=\"";
    for (const Point& p : points) text += (&p == points.data() ? "" : " ") + place(p);
    return text + "\"/>\n";
  };
  char head[160];
  std::snprintf(head, sizeof head, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\">\n", 2 * margin + scale * (high[0] - low[0]),
                2 * margin + scale * (high[1] - low[1]));
  std::string text = head;
  for (const std::vector<Point>& circle : circles) text += line(circle, "stroke=\"#7fa8d0\"");
  for (const CutCurve& curve : cut.curves) text += line(curve.support, "stroke=\"#303030\"");
  for (const Point& p : cut.points) {
    const std::string at = place(p);
    const std::size_t comma = at.find(',');
    text += "<circle r=\"3\" fill=\"#c03020\" cx=\"" + at.substr(0, comma) + "\" cy=\"" + at.substr(comma + 1) + "\"/>\n";
  }
  return text + "</svg>\n";
}

}  // namespace command
