// SPDX-License-Identifier: BSD-3-Clause
#include "surface/layers/layer_curves.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "support/angles.h"
#include "support/error.h"

namespace carreau {

LayerCurves::LayerCurves(const Model& model, const Topology& topology, std::span<const CurveLayers> layers, bool halved,
                         bool bent)
    : layers_(layers.begin(), layers.end()), bent_(bent) {
  if (layers_.empty()) return;
  for (CurveLayers& each : layers_) {
    if (!halved) break;
    each.first *= 1 + each.ratio, each.ratio *= each.ratio, each.count = (each.count + 1) / 2;
  }
  of_curve_.assign(topology.curves.size(), -1);
  for (std::size_t i = 0; i < layers_.size(); ++i)
    for (const int ref : layers_[i].curves) {
      bool found = false;
      for (std::size_t c = 0; c < topology.curves.size(); ++c) {
        const Curve& curve = topology.curves[c];
        const auto names = [&](const CurveUse& use) {
          return model.faces[static_cast<std::size_t>(use.face)].curves[static_cast<std::size_t>(use.curve)].shown_as == ref;
        };
        if (curve.ref != ref && std::none_of(curve.uses.begin(), curve.uses.end(), names)) continue;
        found = true;
        if (of_curve_[c] >= 0 && of_curve_[c] != static_cast<int>(i))
          throw InvalidArgument(Where{.curve = ref}.prefix() + "two sets of layers grow from it");
        of_curve_[c] = curve.degenerate ? -1 : static_cast<int>(i);
      }
      if (!found) throw InvalidArgument("layers: no face has a curve " + std::to_string(ref));
    }
}

std::vector<double> LayerCurves::heights(int layers, double longest) const {
  const CurveLayers& given = layers_[static_cast<std::size_t>(layers)];
  std::vector<double> all;
  double next = given.first;
  for (int k = 0; k < given.count && (k == 0 || next <= longest); ++k, next *= given.ratio) all.push_back(next);
  return all;
}

void LayerCurves::find_bulges(const CurveModel& model, std::span<const DiscreteCurve> curves) {
  bulges_.clear();
  if (!bent_ || layers_.empty()) return;
  bulges_.resize(curves.size());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const DiscreteCurve& d = curves[c];
    if (d.indivisible) continue;
    const CurveUse& use = model.curve(d.curve).uses[static_cast<std::size_t>(d.owner)];
    const CurveSupport& support = model.support(use);
    for (std::size_t k = 0; k + 1 < d.r.size(); ++k) {
      const double r = 0.5 * (d.r[k] + d.r[k + 1]);
      bulges_[c].push_back(support.point_at_arc((use.reversed ? 1 - r : r) * support.length()) - 0.5 * (d.xyz[k] + d.xyz[k + 1]));
    }
  }
}

namespace {

/// Lengths along a curve from one of its ends, at which rows of other curves meet it.
class SideRows {
 public:
  SideRows(const LayerCurves& layers, const CurveModel& model, const std::vector<DiscreteCurve>& curves)
      : layers_(layers), model_(model), curves_(curves) {}

  std::vector<double> from(std::size_t side, bool at_end) const {
    const Curve& curve = model_.topology.curves[side];
    const int point = at_end ? curve.end2 : curve.end1;
    const Vec3 along_side = away(curves_[side], at_end);
    for (const int c : model_.topology.points[static_cast<std::size_t>(point)].curves) {
      const int layers = layers_.of_curve(c);
      const Curve& other = model_.topology.curves[static_cast<std::size_t>(c)];
      if (layers < 0 || !share_a_face(curve, other)) continue;
      const DiscreteCurve& wall = curves_[static_cast<std::size_t>(c)];
      const Vec3 along_wall = away(wall, other.end2 == point && other.end1 != point);
      const double sine = norm(cross(along_side, along_wall)) / (norm(along_side) * norm(along_wall));
      if (!(sine > angles::cosine_of_45)) continue;  // cells would be skewed
      std::vector<double> at;
      double sum = 0;
      for (const double h : layers_.heights(layers, norm(along_wall))) at.push_back(sum += h / sine);
      return at;
    }
    return {};
  }

 private:
  static Vec3 away(const DiscreteCurve& curve, bool at_end) {
    const std::vector<Vec3>& p = curve.xyz;
    return at_end ? Vec3(p[p.size() - 2] - p.back()) : Vec3(p[1] - p[0]);
  }
  static bool share_a_face(const Curve& a, const Curve& b) {
    return std::any_of(a.uses.begin(), a.uses.end(), [&](const CurveUse& u) {
      return std::any_of(b.uses.begin(), b.uses.end(), [&](const CurveUse& w) { return w.face == u.face; });
    });
  }

  const LayerCurves& layers_;
  const CurveModel& model_;
  const std::vector<DiscreteCurve>& curves_;
};

/// Shares of the length between `first` and `last`, spaced as the vertices of the curve are.
std::vector<double> between(const DiscreteCurve& curve, double first, double last) {
  const auto edges_before = [&](double r) {
    const auto next = std::upper_bound(curve.r.begin() + 1, curve.r.end() - 1, r);
    const auto k = static_cast<std::size_t>(next - curve.r.begin());
    return static_cast<double>(k - 1) + (r - curve.r[k - 1]) / (curve.r[k] - curve.r[k - 1]);
  };
  const double from = edges_before(first), to = edges_before(last);
  const int n = std::max(1, static_cast<int>(std::lround(to - from)));
  std::vector<double> inside;
  for (int i = 1; i < n; ++i) {
    const double at = from + (to - from) * i / n;
    const std::size_t k = std::min(static_cast<std::size_t>(at), curve.r.size() - 2);
    inside.push_back(std::lerp(curve.r[k], curve.r[k + 1], at - static_cast<double>(k)));
  }
  return inside;
}

}  // namespace

void place_rows_on_sides(const LayerCurves& layers, const CurveModel& model, std::vector<DiscreteCurve>& curves) {
  if (layers.empty()) return;
  const SideRows rows(layers, model, curves);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    DiscreteCurve& side = curves[c];
    if (layers.of_curve(static_cast<int>(c)) >= 0 || side.indivisible || side.prescribed) continue;
    std::vector<double> low = rows.from(c, false), high = rows.from(c, true);
    if (low.empty() && high.empty()) continue;
    const double length = model.length(static_cast<int>(c));
    const auto last_row = [](const std::vector<double>& at) {
      return at.empty() ? 0 : at.back() - (at.size() > 1 ? at[at.size() - 2] : 0);
    };
    // One more row is left between the last rows of both ends.
    while (!low.empty() || !high.empty()) {
      const double a = last_row(low), b = last_row(high);
      const double used = (low.empty() ? 0 : low.back()) + (high.empty() ? 0 : high.back());
      if (used + std::max(a, b) <= length) break;
      (a >= b ? low : high).pop_back();
    }
    std::vector<double> inside;
    for (const double s : low) inside.push_back(s / length);
    const double first = low.empty() ? 0 : low.back() / length, last = high.empty() ? 1 : 1 - high.back() / length;
    for (const double r : between(side, first, last)) inside.push_back(r);
    for (auto s = high.rbegin(); s != high.rend(); ++s) inside.push_back(1 - *s / length);
    place_vertices(side, inside, model);
  }
}

}  // namespace carreau
