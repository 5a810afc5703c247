// SPDX-License-Identifier: BSD-3-Clause
#include "curves/curve_input.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "base/failure.h"
#include "base/text_file.h"

namespace command {
namespace {

Point plus(const Point& a, double s, const Point& b) { return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]}; }
double length_of(const Point& a) { return std::sqrt(dot(a, a)); }

/// Lines of a text without comments, and their numbers from 1.
template <typename Take>
void for_lines(const std::string& text, Take take) {
  std::istringstream in(text);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line.erase(std::min(line.find_first_of("#!"), line.size()));
    std::istringstream words(line);
    std::vector<double> values;
    for (std::string word; words >> word;) {
      char* end = nullptr;
      values.push_back(std::strtod(word.c_str(), &end));
      if (*end != '\0' || !std::isfinite(values.back())) values.back() = std::nan("");
    }
    take(number, values);
  }
}

[[noreturn]] void fail(const std::string& path, int line, const std::string& sentence) {
  throw Failure(path + ", line " + std::to_string(line) + ": " + sentence);
}

void require_numbers(const std::string& path, int line, const std::vector<double>& values) {
  if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); })) fail(path, line, "a word is not a number.");
}

CurveInput read_points(const std::string& path) {
  CurveInput input;
  bool starts = true;
  std::size_t columns = 0;
  for_lines(read_text(path), [&](int line, const std::vector<double>& values) {
    if (values.empty()) {
      starts = true;
      return;
    }
    require_numbers(path, line, values);
    if (columns == 0) columns = values.size();
    if (values.size() != columns || columns < 2 || columns > 3)
      fail(path, line, "a point has two or three coordinates, as many on every line.");
    if (starts) input.curves.push_back({static_cast<std::int32_t>(input.curves.size()) + 1, {}});
    starts = false;
    input.curves.back().nodes.push_back(input.points.size());
    input.points.push_back({values[0], values[1], columns == 3 ? values[2] : 0});
  });
  input.dimension = columns == 3 ? 3 : 2;
  return input;
}

/// Chains of edges: from ends and branches first, then closed.
void add_chains(std::int32_t ref, const std::vector<std::array<std::int32_t, 2>>& edges, CurveInput& input) {
  std::map<std::int32_t, std::vector<std::size_t>> around;
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const std::int32_t v : edges[e]) around[v].push_back(e);
  std::vector<char> used(edges.size(), 0);
  const auto walk = [&](std::size_t e, std::int32_t from) {
    InputCurve curve{ref, {static_cast<std::size_t>(from)}};
    for (std::int32_t at = from;;) {
      used[e] = 1;
      at = edges[e][0] == at ? edges[e][1] : edges[e][0];
      curve.nodes.push_back(static_cast<std::size_t>(at));
      const std::vector<std::size_t>& next = around[at];
      if (next.size() != 2 || at == from) break;
      const std::size_t other = next[0] == e ? next[1] : next[0];
      if (used[other] != 0) break;
      e = other;
    }
    input.curves.push_back(std::move(curve));
  };
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (used[e] == 0 && around[edges[e][end]].size() != 2) walk(e, edges[e][end]);
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (used[e] == 0) walk(e, edges[e][0]);
}

CurveInput read_edges(const std::string& path) {
  const MeshHandle mesh = read_mesh(path);
  const MeshArrays arrays = arrays_of(mesh.get());
  std::vector<std::int32_t> refs(arrays.edges.size());
  require(mesh.get(), carreau_mesh_edge_refs(mesh.get(), static_cast<std::int64_t>(refs.size()), refs.data()));
  CurveInput input{.dimension = arrays.dimension, .is_mesh = true, .points = arrays.vertices, .curves = {}};
  std::map<std::int32_t, std::vector<std::array<std::int32_t, 2>>> by_ref;
  for (std::size_t e = 0; e < refs.size(); ++e) by_ref[refs[e]].push_back(arrays.edges[e]);
  for (const auto& [ref, edges] : by_ref) add_chains(ref, edges, input);
  return input;
}

/// A cubic piece between two points (RR-2818 sec. 3.3): the derivatives at its ends are given, or free.
struct Piece {
  Point a0, a1, a2, a3;

  [[nodiscard]] Point at(double t) const { return plus(plus(plus(a0, t, a1), t * t, a2), t * t * t, a3); }
};

Piece piece_between(const Point& b, const Point& c, const Point* before, const Point* after) {
  const Point d = minus(c, b), none{0, 0, 0};
  if (before != nullptr && after != nullptr)
    return {b, *before, plus(plus(plus(none, 3, d), -2, *before), -1, *after), plus(plus(plus(none, -2, d), 1, *before), 1, *after)};
  if (before != nullptr) return {b, *before, minus(d, *before), none};
  if (after != nullptr) return {b, minus(plus(d, 1, d), *after), minus(*after, d), none};
  return {b, d, none, none};
}

/// Two parameters of [0, 1] have one place in the plane (sec. 3.6).
bool has_loop(const Piece& p) {
  const double cross32 = p.a3[0] * p.a2[1] - p.a2[0] * p.a3[1];
  if (cross32 == 0) return false;
  const double sum = (p.a1[0] * p.a3[1] - p.a3[0] * p.a1[1]) / cross32;
  const std::size_t k = std::abs(p.a3[0]) > std::abs(p.a3[1]) ? 0 : 1;
  const double product = (p.a1[k] + p.a2[k] * sum + p.a3[k] * sum * sum) / p.a3[k];
  const double root = sum * sum - 4 * product;
  if (!(root > 0)) return false;
  const double low = (sum - std::sqrt(root)) / 2, high = (sum + std::sqrt(root)) / 2;
  return low >= 0 && high <= 1;
}

/// Adds the points of a piece behind t = a up to t = b.
void subdivide(const Piece& piece, double a, double b, double tolerance, int depth, std::vector<Point>& points) {
  const Point p = piece.at(a), q = piece.at(b), d = minus(q, p);
  const double length = length_of(d);
  double off = 0;
  for (const double share : {0.25, 0.5, 0.75}) {
    const Point r = minus(piece.at(a + share * (b - a)), p);
    off = std::max(off, length > 0 ? length_of(cross(d, r)) / length : length_of(r));
  }
  constexpr int deepest = 16;
  if (depth < deepest && off > tolerance * length) {
    subdivide(piece, a, (a + b) / 2, tolerance, depth + 1, points);
    subdivide(piece, (a + b) / 2, b, tolerance, depth + 1, points);
  } else {
    points.push_back(q);
  }
}

}  // namespace

CurveInput read_curves(const std::string& path) {
  const std::string suffix = suffix_of(path);
  const bool is_mesh = suffix == ".smo" || suffix == ".mc" || suffix == ".ms" ||
                       std::find(mesh_suffixes.begin(), mesh_suffixes.end(), suffix) != mesh_suffixes.end();
  CurveInput input = is_mesh ? read_edges(path) : read_points(path);
  if (input.curves.empty()) throw Failure("'" + path + "' has no curve.");
  for (const InputCurve& curve : input.curves)
    for (std::size_t i = 1; i < curve.nodes.size(); ++i)
      if (input.points[curve.nodes[i]] == input.points[curve.nodes[i - 1]])
        throw Failure("'" + path + "': points " + std::to_string(i) + " and " + std::to_string(i + 1) + " of curve " + std::to_string(curve.ref) + " coincide.");
  for (const InputCurve& curve : input.curves)
    if (curve.nodes.size() < 2) throw Failure("'" + path + "': curve " + std::to_string(curve.ref) + " has one point only.");
  return input;
}

std::vector<double> read_point_metrics(const std::string& path, const CurveInput& input) {
  std::vector<double> metrics;
  std::size_t rows = 0, width = 1;
  bool first = true;
  const std::string suffix = suffix_of(path);
  const bool has_header = suffix == ".h" || suffix == ".hc" || suffix == ".hg";
  const std::size_t full = input.dimension == 2 ? 3 : 6;
  for_lines(read_text(path), [&](int line, const std::vector<double>& values) {
    if (values.empty()) return;
    require_numbers(path, line, values);
    if (first && has_header) {
      if (values.size() != 2 || (values[1] != 1 && values[1] != static_cast<double>(full)))
        fail(path, line, "the first line is a number of points, and 1 (sizes) or " + std::to_string(full) + " (metrics).");
      width = static_cast<std::size_t>(values[1]);
      first = false;
      return;
    }
    if (first && values.size() == full) width = full;
    first = false;
    if (values.size() != width) fail(path, line, "there are " + std::to_string(width) + " values a point.");
    ++rows;
    if (width == full) {
      metrics.insert(metrics.end(), values.begin(), values.end());
      return;
    }
    if (!(values[0] > 0)) fail(path, line, "a size must be above 0.");
    const double k = 1 / (values[0] * values[0]);
    for (std::size_t i = 0; i < full; ++i) metrics.push_back(i == 0 || i + 1 == full || (full == 6 && i == 3) ? k : 0);
  });
  if (rows != input.points.size())
    throw Failure("'" + path + "' has values at " + std::to_string(rows) + " points; there are " + std::to_string(input.points.size()) + ".");
  return metrics;
}

CurveSupport support_of(const CurveInput& input, const InputCurve& curve, bool spline, double tolerance) {
  const std::size_t n = curve.nodes.size();
  std::vector<Point> p;
  for (const std::size_t node : curve.nodes) p.push_back(input.points[node]);
  const bool closed = n > 2 && p.front() == p.back();
  std::vector<Point> tangents(n);
  for (std::size_t i = 0; i < n; ++i) {
    const bool inner = i > 0 && i + 1 < n;
    if (inner || closed) tangents[i] = plus({0, 0, 0}, 0.5, minus(inner ? p[i + 1] : p[1], inner ? p[i - 1] : p[n - 2]));
  }
  CurveSupport support{.points = {p.front()}, .abscissae = {0}};
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const std::size_t before = support.points.size();
    if (spline) {
      const Piece piece = piece_between(p[i], p[i + 1], i > 0 || closed ? &tangents[i] : nullptr, i + 2 < n || closed ? &tangents[i + 1] : nullptr);
      support.loops = support.loops || (input.dimension == 2 && has_loop(piece));
      subdivide(piece, 0, 1, tolerance, 0, support.points);
    }
    if (!spline) support.points.push_back(p[i + 1]);
    support.points.back() = p[i + 1];
    double length = support.abscissae.back();
    for (std::size_t k = before; k < support.points.size(); ++k) length += length_of(minus(support.points[k], support.points[k - 1]));
    support.abscissae.push_back(length);
  }
  return support;
}

}  // namespace command
