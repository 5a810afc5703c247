// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/smooth_borders.h"
#include "atlas/thresholds.h"

namespace carreau::atlas {
namespace {

/// The outer border of a part with a short edge at each joint.
OuterPieces with_edges_at_joints(const Part& part, const OuterPieces& given) {
  OuterPieces result = given;
  const auto add = [&](bool at_start) {
    const std::size_t k = at_start ? 0 : given.angle.size() - 2;
    const double joint = at_start ? 0 : part.total(), width = given.angle[k + 1] - given.angle[k];
    const Vec2 inner = at_start ? part.line.front() : part.line.back(), outer = given.line(k);
    const double rho = radius_on(inner, joint), room = (at_start ? given.radius.front() : given.radius.back()) - rho;
    const Vec2 parallel = inner / (1 + thresholds::room_at_joints * room / rho);
    double share = thresholds::rounded_share, at = joint;
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i, share /= 2) {
      at = joint + (at_start ? share : -share) * width;
      if ((radius_on(outer, at) - radius_on(parallel, at)) * part.side > 0) break;
    }
    const auto insert = [&](std::vector<double>& list, double ends, double inside) {
      (at_start ? list.front() : list.back()) = ends;
      list.insert(at_start ? list.begin() + 1 : list.end() - 1, inside);
    };
    insert(result.angle, joint, at);
    insert(result.radius, radius_on(parallel, joint), radius_on(parallel, at));
  };
  add(true), add(false);
  return result;
}

}  // namespace

Polygon begin_outside(std::vector<Part>& parts, std::vector<OuterPieces>& pieces) {
  // Nearly radial edges, where the view of a pivot jumps, have no smooth corners.
  const auto inner_radius = [](const Part& part, double at) {
    return radius_on(part.line[interval_of(part.angle, at)], at);
  };
  for (std::size_t n = 0; n < parts.size(); ++n) {
    parts[n].ratio_angle = pieces[n].angle;
    for (std::size_t k = 0; k < pieces[n].angle.size(); ++k)
      parts[n].ratio.push_back(pieces[n].radius[k] / inner_radius(parts[n], pieces[n].angle[k]));
  }
  limit_slopes(parts, thresholds::steepest_outer);
  for (std::size_t n = 0; n < parts.size(); ++n) {
    for (std::size_t k = 0; k < pieces[n].angle.size(); ++k)
      pieces[n].radius[k] = parts[n].ratio[k] * inner_radius(parts[n], pieces[n].angle[k]);
    parts[n].ratio.clear();
  }
  for (std::size_t n = 0; n < parts.size(); ++n) pieces[n] = with_edges_at_joints(parts[n], pieces[n]);
  Polygon border = polygon_of(parts, pieces);
  for (std::size_t n = 0; n < parts.size(); ++n) {
    Part& part = parts[n];
    const OuterPieces& outer = pieces[n];
    OuterPieces inner{outer.angle, {}};
    std::vector<double> phi;
    std::vector<Vec2> lines;
    for (std::size_t k = 0; k < outer.angle.size(); ++k) {
      const double at = outer.angle[k];
      const std::size_t i = interval_of(part.angle, at);
      inner.radius.push_back(inner_radius(part, at));
      const double share = (at - part.angle[i]) / (part.angle[i + 1] - part.angle[i]);
      phi.push_back(part.phi[i] + share * (part.phi[i + 1] - part.phi[i]));
      if (k + 1 < outer.angle.size()) lines.push_back(outer.line(k));
    }
    phi.front() = part.phi.front(), phi.back() = part.phi.back();
    part.angle = inner.angle, part.phi = std::move(phi), part.line = std::move(lines), part.outer_first = true;
    pieces[n] = std::move(inner);
  }
  return border;
}

}  // namespace carreau::atlas
