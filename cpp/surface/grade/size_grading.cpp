#include "surface/grade/size_grading.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "curve/unit_discretisation.h"
#include "surface/grade/grading_round.h"

namespace carreau::detail {

namespace {

constexpr std::size_t most_size_minima = 50;
// Samples of a curve's sizes on each of its edges in the graph.
constexpr int samples_per_edge = 4;

}  // namespace

// Where some size is another vertex's, or some sample not what the corners of its triangle make of it, the
// prescribed sizes do not obey the gradation.
void GradingRound::find_rough(std::size_t f) {
  GradedFace& face = faces_[f];
  const auto prescribed = [&](std::int32_t v) { return prescribed_h_[graph_.places[place_of_[f] + v].vertex]; };
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    for (const std::int32_t v : face.triangles[t])
      if (dot(face.front[v].line, face.front[v].line) > 0 || face.h[v] < (1 - roughness) * prescribed(v))
        face.smooth[t] = 0;
  for (const Sample& s : samples_[f]) {
    double linear = 0;
    for (int i = 0; i < 3; ++i) linear += s.promised[i] * face.h[face.triangles[s.triangle][i]];
    if (std::abs(linear - s.h) > roughness * s.h) face.smooth[s.triangle] = 0;
  }
  widen_rough(face);
}

// Nor do they beside: samples are few.
void GradingRound::widen_rough(GradedFace& face) {
  std::vector<char> beside(face.uv.size(), 0);
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    if (face.smooth[t] == 0)
      for (const std::int32_t v : face.triangles[t]) beside[v] = 1;
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    for (const std::int32_t v : face.triangles[t])
      if (beside[v] != 0) face.smooth[t] = 0;
}

// A vertex that is the source of all its neighbours.
void GradingRound::find_size_minima(GradedFace& face) {
  std::vector<char> minimum(face.uv.size(), 1);
  for (const auto& t : face.triangles)
    for (int i = 0; i < 3; ++i)
      for (int k = 1; k < 3; ++k) {
        const std::int32_t v = t[i], w = t[(i + k) % 3];
        if (face.xyz[v] == face.xyz[w]) continue;  // a pole has several vertices
        const GradationFront& f = face.front[w];
        if (dot(f.line, f.line) == 0 || f.source_h != face.h[v]) minimum[v] = 0;
      }
  for (std::size_t v = 0; v < minimum.size() && face.size_minima.size() < most_size_minima; ++v)
    if (minimum[v] != 0) face.size_minima.push_back(face.uv[v]);
}

GradedModel GradingRound::grade(const std::vector<SizeSamples>& raw) {
  const double slope = slope_of_gradation(options_.gradation);
  const GradationFronts fronts = grade_fronts(graph_, h_, sources_, slope, monitor_);
  for (const auto& t : graph_.triangles)
    for (int i = 0; i < 3; ++i) {
      const int a = graph_.places[t[i]].vertex, b = graph_.places[t[(i + 1) % 3]].vertex;
      long_edges_ +=
          normalised_length(SizeLaw::linear, fronts.h[a], fronts.h[b], norm(graph_.xyz[a] - graph_.xyz[b])) > too_long;
    }
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (std::size_t v = 0; v < faces_[f].uv.size(); ++v) {
      faces_[f].front.push_back(fronts.front[place_of_[f] + v]);
      faces_[f].h.push_back(fronts.h[graph_.places[place_of_[f] + v].vertex]);
    }
    find_rough(f);
    find_size_minima(faces_[f]);
  }
  GradedModel result;
  result.triangles = graph_.triangles.size();
  result.field = std::make_shared<GradedField>(slope, std::move(faces_));
  for (std::size_t c = 0; c < raw.size(); ++c) result.curves.push_back(bounded(c, raw[c], fronts.h, *result.field));
  return result;
}

// Sizes along a curve, between the graded ones at its vertices in the graph.
SizeSamples GradingRound::bounded(std::size_t c, const SizeSamples& raw, const std::vector<double>& h,
                                  const GradedField& field) const {
  const DiscreteCurve& d = curves_[c];
  const Curve& curve = model_.topology.curves[c];
  SizeSamples result;
  const auto add = [&](double r, double size) {
    result.r.push_back(r);
    result.h.push_back(size);
    result.physical.push_back(raw.physical_at(r));
  };
  for (std::size_t k = 0; k + 1 < d.r.size(); ++k) {
    const double left = h[node_of_[c][k]], right = h[node_of_[c][k + 1]];
    add(d.r[k], left);
    if (d.indivisible) continue;
    for (const double r : between(d.r[k], d.r[k + 1], raw.r)) {
      const double w = (r - d.r[k]) / (d.r[k + 1] - d.r[k]);
      double size = std::lerp(left, right, w);
      const Vec3 xyz = lerp(d.xyz[k], d.xyz[k + 1], w);
      for (std::size_t u = 0; u < curve.uses.size(); ++u)
        size = std::min(
            size, field.size(curve.uses[u].face, lerp(d.uv_of_use[u][k], d.uv_of_use[u][k + 1], w), xyz, infinity));
      add(r, size);
    }
  }
  add(d.r.back(), h[node_of_[c].back()]);
  return result;
}

// Where the sizes of a curve are sampled inside an edge of the graph: at equal distances and where they are known.
std::vector<double> GradingRound::between(double from, double to, const std::vector<double>& known) {
  std::vector<double> at;
  for (int i = 1; i < samples_per_edge; ++i)
    at.push_back(std::lerp(from, to, static_cast<double>(i) / samples_per_edge));
  const double least = 1e-6 * (to - from);
  for (const double r : known)
    if (r > from + least && r < to - least) at.push_back(r);
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end(), [least](double p, double q) { return q - p < least; }), at.end());
  return at;
}

}  // namespace carreau::detail

namespace carreau {

namespace {

constexpr int most_rounds = 5;
// So many edges a triangle may be too long after the first round.
constexpr double few_edges = 0.01;

}  // namespace

GradedModel grade_model(const CurveModel& model, SizeRules& rules, const CompositeOptions& options, double diag,
                        Monitor& monitor) {
  std::vector<SizeSamples> raw;
  for (std::size_t c = 0; c < model.topology.curves.size(); ++c) {
    monitor.checkpoint();
    raw.push_back(sample_sizes(model, static_cast<int>(c), rules, {.lss = options.lss}));
  }
  GradedModel graded;
  std::size_t long_before = SIZE_MAX;
  double triangles_before = 0;
  for (int round = 1; round <= most_rounds; ++round) {
    detail::GradingRound next(model, rules, options, diag, monitor);
    graded = next.run(raw, graded);
    graded.rounds = round;
    if (next.long_edges() == 0) break;
    // Those of a pole stay, and a few others change nothing.
    const double change = static_cast<double>(graded.triangles) / std::max(triangles_before, 1.) - 1;
    const bool few = static_cast<double>(next.long_edges()) < few_edges * static_cast<double>(graded.triangles);
    if ((round > 1 && few) || (std::abs(change) < 0.1 && 2 * next.long_edges() > long_before)) break;
    long_before = next.long_edges();
    triangles_before = static_cast<double>(graded.triangles);
  }
  return graded;
}

}  // namespace carreau
