// SPDX-License-Identifier: BSD-3-Clause
// Triangles whose corners are of several charts.
#include <numbers>

#include "measure/measurement.h"
#include "metric/field_length.h"
#include "support/infinity.h"

namespace carreau {

void Measurement::measure_spread() {
  if (options_.atlas.charts == nullptr) return;
  static const std::array<Barycentric, 7> rule = triangle_rule();
  std::vector<std::array<double, 3>> weights;
  for (const Barycentric& w : rule) weights.push_back({w.a, w.b, w.c});
  const std::vector<SpreadSample> samples =
      spread_samples(mesh_, options_.atlas, cad_, gauss_.node, weights, monitor_);
  for (std::size_t k = 0, n = 0; k < samples.size(); k += n) {
    for (n = 1; k + n < samples.size() && samples[k + n].face == samples[k].face;) ++n;
    const std::span<const SpreadSample> here = std::span(samples).subspan(k, n);
    if (here.front().face < 0) {
      for (const SpreadSample& s : here) note_above(s, s.flat);
      continue;
    }
    std::vector<Vec2> uv;
    for (const SpreadSample& s : here) uv.push_back(s.uv);
    sampler_.run(here.front().face, mesh_.faces[here.front().face].ref, want_position | want_first, uv,
                 [&](std::size_t i, const SurfaceJet& jet, const Metric2& metric) { note(here[i], jet, metric); });
  }
  std::size_t last = samples.size();
  for (const SpreadSample& s : samples)
    if (s.triangle != last) finish_by_lengths(last = s.triangle);
  finish_beside_spread();
}

void Measurement::finish_beside_spread() {
  std::vector<char> late(edges_.segment.size(), 0);
  std::vector<std::size_t> plain;
  std::size_t place = 0;
  for (const FaceMesh& face : mesh_.faces)
    for (std::size_t t = 0; t < face.triangles.size(); ++t, ++place) {
      if (!face.is_spread(t)) plain.push_back(place);
      for (std::size_t i = 0; i < 3 && face.is_spread(t); ++i)
        if (edges_.names[place][i] != 0) late[static_cast<std::size_t>(edges_.of_triangle[place][i])] = 1;
    }
  for (const std::size_t t : plain)
    for (const std::int32_t edge : edges_.of_triangle[t])
      if (late[static_cast<std::size_t>(edge)] != 0) {
        finish_by_lengths(t);
        break;
      }
}

void Measurement::note_above(const SpreadSample& s, const Vec3& p) {
  if (s.side < 0) return raise_deviation(s.triangle, p);
  const std::int32_t edge = edges_.of_triangle[s.triangle][s.side];
  if (edges_.segment[edge] >= 0) return raise_deviation(s.triangle, p);
  if (edges_.names[s.triangle][s.side] != 0)
    above_[static_cast<std::size_t>(edge) * gauss_.node.size() + static_cast<std::size_t>(s.rank)] = p;
}

void Measurement::note(const SpreadSample& s, const SurfaceJet& jet, const Metric2& metric) {
  note_above(s, jet.s);
  const auto& c = triangle_[s.triangle];
  const std::array<Vec3, 3> p{mesh_.vertices[c[0]], mesh_.vertices[c[1]], mesh_.vertices[c[2]]};
  if (s.side < 0) {
    auto normal = unit_normal(jet);
    if (normal && s.turned) normal = -*normal;
    return raise_angle(s.triangle, p, normal);
  }
  if (edges_.names[s.triangle][s.side] == 0) return;
  const Vec3 chord = p[(s.side + 1) % 3] - p[s.side];
  const double l = norm(chord);
  double size = 0;
  const std::int32_t edge = edges_.of_triangle[s.triangle][s.side];
  if (const auto h = curve_sizes(edge, c[s.side])) {
    size = interpolate_size(options_.law, (*h)[0], (*h)[1], gauss_.node[s.rank]);
  } else {
    const double e = dot(jet.su, jet.su), f = dot(jet.su, jet.sv), g = dot(jet.sv, jet.sv);
    const double x = dot(jet.su, chord), y = dot(jet.sv, chord);
    const Vec2 way{g * x - f * y, e * y - f * x};
    size = norm(way.x() * jet.su + way.y() * jet.sv) / length(metric, way);
  }
  of(EvaluationKind::length)[edge] += gauss_.weight[s.rank] * l / size;
}

void Measurement::finish_by_lengths(std::size_t place) {
  std::array<double, 3> l{};
  for (std::size_t i = 0; i < 3; ++i) l[i] = of(EvaluationKind::length)[edges_.of_triangle[place][i]];
  const double s = (l[0] + l[1] + l[2]) / 2, squares = l[0] * l[0] + l[1] * l[1] + l[2] * l[2];
  const double area = std::sqrt(std::max(0.0, s * (s - l[0]) * (s - l[1]) * (s - l[2])));
  of(EvaluationKind::metric_quality)[place] =
      squares > 0 ? std::min(1.0, 4 * std::numbers::sqrt3 * area / squares) : 0;
}

}  // namespace carreau
