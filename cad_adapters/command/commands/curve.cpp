// SPDX-License-Identifier: BSD-3-Clause
// `carreau curve`: splines through points, cut in a metric, drawn (RR-2818).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "base/failure.h"
#include "base/json_output.h"
#include "base/lengths.h"
#include "base/output_files.h"
#include "base/text_file.h"
#include "commands/commands.h"
#include "curves/curve_output.h"
#include "files/session_handle.h"

namespace command {
namespace {

using Json = nlohmann::ordered_json;

/// Metrics of one size at all points.
std::vector<double> uniform(double size, const CurveInput& input) {
  const double k = 1 / (size * size);
  std::vector<double> metrics;
  for (std::size_t i = 0; i < input.points.size(); ++i)
    input.dimension == 2 ? metrics.insert(metrics.end(), {k, 0, k}) : metrics.insert(metrics.end(), {k, 0, 0, k, 0, k});
  return metrics;
}

double diagonal_of(const CurveInput& input) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = input.points[0][k], high = low;
    for (const Point& p : input.points) low = std::min(low, p[k]), high = std::max(high, p[k]);
    square += (high - low) * (high - low);
  }
  return std::sqrt(square);
}

struct Split {
  std::vector<double> cuts;
  double metric_length = 0;
};

Split split(carreau_session* session, const CurveInput& input, const InputCurve& curve, const CurveSupport& support,
            const std::vector<double>& metrics, int law) {
  const auto dimension = static_cast<std::size_t>(input.dimension), width = dimension == 2 ? std::size_t{3} : std::size_t{6};
  std::vector<double> points, at_nodes;
  for (const Point& p : support.points) points.insert(points.end(), p.begin(), p.begin() + static_cast<std::ptrdiff_t>(dimension));
  for (const std::size_t node : curve.nodes)
    at_nodes.insert(at_nodes.end(), metrics.begin() + static_cast<std::ptrdiff_t>(node * width), metrics.begin() + static_cast<std::ptrdiff_t>((node + 1) * width));
  carreau_curve c{};
  c.struct_size = sizeof c;
  c.dimension = input.dimension, c.law = law;
  c.point_count = static_cast<std::int64_t>(support.points.size()), c.metric_count = static_cast<std::int64_t>(curve.nodes.size());
  c.points = points.data(), c.abscissae = support.abscissae.data(), c.metrics = at_nodes.data();
  Split result;
  std::int64_t edges = 0;
  require(session, carreau_curve_split(session, &c, 0, nullptr, &edges, &result.metric_length));
  result.cuts.resize(static_cast<std::size_t>(edges) + 1);
  require(session, carreau_curve_split(session, &c, edges + 1, result.cuts.data(), nullptr, nullptr));
  return result;
}

/// The point of a polyline at an abscissa; abscissae ascend from call to call.
class Along {
 public:
  explicit Along(const std::vector<Point>& points) : points_(points) {}
  Point at(double s) {
    for (; next_ + 1 < points_.size() && start_ + edge() < s; ++next_) start_ += edge();
    const Point &p = points_[next_ - 1], &q = points_[next_];
    const double share = std::clamp((s - start_) / edge(), 0., 1.);
    return {p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1]), p[2] + share * (q[2] - p[2])};
  }

 private:
  [[nodiscard]] double edge() const {
    const Point d = minus(points_[next_], points_[next_ - 1]);
    return std::sqrt(dot(d, d));
  }
  const std::vector<Point>& points_;
  std::size_t next_ = 1;
  double start_ = 0;
};

/// Points that ends of curves share are one vertex.
std::map<std::size_t, std::size_t> number_ends(const CurveInput& input, CutCurves& cut) {
  std::map<std::size_t, std::size_t> end_of_node;
  for (const InputCurve& curve : input.curves) {
    const std::size_t first = curve.nodes.front(), last = curve.nodes.back();
    for (const std::size_t node : {first, last}) {
      if (node != first && input.points[node] == input.points[first]) {
        end_of_node[node] = end_of_node[first];  // a closed list of points
      } else if (end_of_node.try_emplace(node, cut.points.size()).second) {
        cut.points.push_back(input.points[node]);
      }
    }
  }
  cut.ends = cut.points.size();
  return end_of_node;
}

}  // namespace

int curve(const CurveOptions& options) {
  const CurveInput input = read_curves(options.input);
  OutputFiles files(options.outputs, {".mesh", ".mc", ".svg"}, {options.input});
  const std::vector<double> metrics =
      !options.sizes.empty() ? read_point_metrics(options.sizes, input)
                             : uniform(options.size.empty() ? diagonal_of(input) / 50 : parse_length(options.size, "--size").of(diagonal_of(input)), input);
  const int law = options.law == "geometric" ? 1 : options.law == "sinusoidal" ? 2 : 0;
  const bool spline = options.join.empty() ? !input.is_mesh : options.join == "spline";
  const SessionHandle session = make_session();
  CutCurves cut{.dimension = input.dimension, .points = {}, .curves = {}};
  const std::map<std::size_t, std::size_t> ends = number_ends(input, cut);
  Json rows = Json::array();
  for (const InputCurve& each : input.curves) {
    CurveSupport support = support_of(input, each, spline, options.tolerance);
    if (support.loops) std::fprintf(stderr, "warning: curve %d: a piece of its spline crosses itself\n", static_cast<int>(each.ref));
    const Split result = split(session.get(), input, each, support, metrics, law);
    CutCurve made{.ref = each.ref, .vertices = {ends.at(each.nodes.front())}, .abscissae = result.cuts, .support = {}};
    Along along(support.points);
    for (std::size_t i = 1; i + 1 < result.cuts.size(); ++i) made.vertices.push_back(cut.points.size()), cut.points.push_back(along.at(result.cuts[i]));
    made.vertices.push_back(ends.at(each.nodes.back()));
    made.support = std::move(support.points);
    cut.curves.push_back(std::move(made));
    const auto edges = static_cast<std::int64_t>(result.cuts.size()) - 1;
    if (!options.json)
      std::printf("curve %d: %lld %s, length %s, in the metric %s, of each edge %s\n", static_cast<int>(each.ref), static_cast<long long>(edges),
                  edges == 1 ? "edge" : "edges", number_text(result.cuts.back()).c_str(), number_text(result.metric_length).c_str(),
                  number_text(result.metric_length / static_cast<double>(edges)).c_str());
    rows.push_back({{"reference", each.ref}, {"edges", edges}, {"length", result.cuts.back()}, {"metric_length", result.metric_length}});
  }
  files.write([&](const std::vector<std::string>& hidden) {
    for (const std::string& path : hidden) {
      const std::string suffix = suffix_of(path);
      write_text(path, suffix == ".mesh" ? medit_text(cut) : suffix == ".mc" ? c_file_text(cut) : svg_text(cut, input, metrics));
    }
  });
  if (options.json) print_json("curve", {{"input", options.input}, {"curves", rows}});
  return 0;
}

}  // namespace command
