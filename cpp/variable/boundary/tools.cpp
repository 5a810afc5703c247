// SPDX-License-Identifier: BSD-3-Clause
#include "variable/boundary/tools.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "support/error.h"
#include "support/rounding_of.h"
#include "support/segment.h"
#include "variable/base/thresholds.h"

namespace carreau::variable {

namespace {

Vec2 left_of(const Vec2& d) noexcept { return {-d.y(), d.x()}; }
Vec2 unit(const Vec2& d) noexcept { return d / norm(d); }

/// Place of the nearest point, as a distance from the start.
double nearest_along(const ToolPart& part, const Vec2& p) noexcept {
  if (part.radius == 0) return part.length * fraction_on_segment(p, part.a, part.b);
  const Vec2 d = p - part.centre;
  double turn = std::atan2(d.y(), d.x()) - part.start;
  if (part.sweep < 0) turn = -turn;
  const double sweep = std::abs(part.sweep), circle = 2 * std::numbers::pi;
  turn -= circle * std::floor(turn / circle);
  if (turn <= sweep) return part.radius * turn;
  return turn - sweep < circle - turn ? part.length : 0;  // the nearer end
}

BoxTree::Box box_of(const ToolPart& part) {
  BoxTree::Box box;
  const auto add = [&](const Vec2& p) { box.add(Vec3{p.x(), p.y(), 0}); };
  add(part.a), add(part.b);
  if (part.radius == 0) return box;
  for (int quarter = 0; quarter < 4; ++quarter) {  // places at which the tangent is parallel to an axis
    const Vec2 direction{quarter == 0 ? 1. : quarter == 2 ? -1. : 0., quarter == 1 ? 1. : quarter == 3 ? -1. : 0.};
    const Vec2 extreme = part.centre + part.radius * direction;
    add(part.point(nearest_along(part, extreme)));
  }
  return box;
}

std::string name_of(std::int32_t tool) { return "tool " + std::to_string(tool) + " (from 0)"; }

void check(const Tool& tool, std::int32_t index) {
  const std::size_t n = tool.points.size();
  if (n < (tool.closed ? 3U : 2U))
    throw InvalidArgument(name_of(index) + " has " + std::to_string(n) + " points; " +
                          (tool.closed ? "a closed one needs three" : "it needs two"));
  if (!tool.radii.empty() && tool.radii.size() != n)
    throw InvalidArgument(name_of(index) + " has " + std::to_string(tool.radii.size()) + " radii for " +
                          std::to_string(n) + " points");
  double area = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::string place = "point " + std::to_string(k) + " of " + name_of(index);
    if (!is_finite(tool.points[k])) throw InvalidArgument(place + " has a coordinate that is not finite");
    if (!tool.radii.empty() && !(tool.radii[k] >= 0 && std::isfinite(tool.radii[k])))
      throw InvalidArgument(place + " has a radius that is negative or not finite");
    const Vec2 next = tool.points[(k + 1) % n];
    area += cross(tool.points[k], next);
    if ((k + 1 < n || tool.closed) && next == tool.points[k])
      throw InvalidArgument(place + " is repeated by the next one");
  }
  if (tool.closed && !(area > 0))
    throw InvalidArgument(name_of(index) + " is closed and runs clockwise: its solid must lie on its left");
}

/// Distance from point k to the beginning of its arc; 0: a sharp corner.
double setback(const Tool& tool, std::size_t k) {
  const std::size_t n = tool.points.size();
  if (tool.radii.empty() || tool.radii[k] == 0 || (!tool.closed && (k == 0 || k + 1 == n))) return 0;
  const Vec2 before = unit(tool.points[k] - tool.points[(k + n - 1) % n]),
             after = unit(tool.points[(k + 1) % n] - tool.points[k]);
  const double turn = std::abs(std::atan2(cross(before, after), dot(before, after)));
  return tool.radii[k] * std::tan(turn / 2);
}

ToolPart arc_at(const Tool& tool, std::size_t k, double back) {
  const std::size_t n = tool.points.size();
  const Vec2 corner = tool.points[k], before = unit(corner - tool.points[(k + n - 1) % n]),
             after = unit(tool.points[(k + 1) % n] - corner);
  ToolPart arc;
  arc.a = corner - back * before, arc.b = corner + back * after;
  arc.radius = tool.radii[k];
  arc.sweep = std::atan2(cross(before, after), dot(before, after));
  const Vec2 inwards = arc.sweep > 0 ? left_of(before) : Vec2(-left_of(before));
  arc.centre = arc.a + arc.radius * inwards;
  arc.start = std::atan2(-inwards.y(), -inwards.x());
  arc.length = arc.radius * std::abs(arc.sweep);
  return arc;
}

}  // namespace

Vec2 ToolPart::point(double along) const noexcept {
  if (along <= 0) return a;
  if (along >= length) return b;
  if (radius == 0) return lerp(a, b, along / length);
  const double angle = start + sweep * (along / length);
  return centre + radius * Vec2{std::cos(angle), std::sin(angle)};
}

Vec2 ToolPart::tangent(double along) const noexcept {
  if (radius == 0) return unit(b - a);
  const double angle = start + sweep * (along / length);
  const Vec2 outwards{std::cos(angle), std::sin(angle)};
  return sweep > 0 ? left_of(outwards) : Vec2(-left_of(outwards));
}

Tools::Tools(std::span<const Tool> tools) {
  for (std::size_t i = 0; i < tools.size(); ++i) add(tools[i], static_cast<std::int32_t>(i));
  std::vector<BoxTree::Box> boxes;
  std::vector<Vec3> centres;
  for (const ToolPart& part : parts_) {
    boxes.push_back(box_of(part));
    centres.emplace_back((boxes.back().low + boxes.back().high) / 2);
  }
  tree_ = BoxTree(boxes, centres);
  add_nodes();
}

void Tools::add(const Tool& tool, std::int32_t index) {
  check(tool, index);
  const std::size_t n = tool.points.size(), sides = tool.closed ? n : n - 1;
  std::vector<double> back;
  for (std::size_t k = 0; k < n; ++k) back.push_back(setback(tool, k));
  Extent extent{.first = static_cast<std::int32_t>(parts_.size()), .last = 0, .length = 0, .closed = tool.closed};
  const auto append = [&](ToolPart part) {
    part.tool = index, part.s = extent.length;
    extent.length += part.length;
    parts_.push_back(part);
  };
  for (std::size_t k = 0; k < sides; ++k) {
    const std::size_t next = (k + 1) % n;
    const Vec2 p = tool.points[k], q = tool.points[next];
    const double length = norm(q - p), rest = length - back[k] - back[next];
    if (rest < -rounding_of::heights * length)
      throw InvalidArgument("the radii at points " + std::to_string(k) + " and " + std::to_string(next) + " of " +
                            name_of(index) + " do not fit on the side between them");
    if (back[k] > 0) append(arc_at(tool, k, back[k]));
    if (rest <= rounding_of::heights * length) continue;
    ToolPart side;
    side.a = p + back[k] / length * (q - p), side.b = q - back[next] / length * (q - p);
    side.length = rest;
    append(side);
  }
  extent.last = static_cast<std::int32_t>(parts_.size()) - 1;
  for (std::int32_t i = extent.first; i <= extent.last; ++i) {
    ToolPart& part = parts_[static_cast<std::size_t>(i)];
    part.previous = i > extent.first ? i - 1 : extent.closed ? extent.last : -1;
    part.next = i < extent.last ? i + 1 : extent.closed ? extent.first : -1;
  }
  tool_.push_back(extent);
}

void Tools::add_nodes() {
  const double most = thresholds::variable::arc_node_angle * std::numbers::pi / 180;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const ToolPart& part = parts_[i];
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(part.sweep) / most)));
    for (int j = 0; j <= pieces; ++j) {
      if (j == pieces && part.next >= 0) break;  // the next part begins with it
      const double along = part.length * j / pieces;
      nodes_.push_back({static_cast<std::int32_t>(i), part.tool, part.s + along, part.point(along), 0, false});
    }
  }
}

bool Tools::is_in_solid(const ToolPlace& place, double along, const Vec2& p) const noexcept {
  const ToolPart& part = parts_[static_cast<std::size_t>(place.part)];
  Vec2 normal = left_of(part.tangent(along));
  const bool at_start = along <= 0, at_end = along >= part.length;
  if (at_start || at_end) {
    const std::int32_t beside = at_start ? part.previous : part.next;
    if (beside < 0) {  // beyond an open end nothing is solid; straight beside it the side counts
      const Vec2 d = p - place.point;
      return dot(d, normal) > 0 && std::abs(dot(d, part.tangent(along))) <= 1e-9 * norm(d);
    }
    const ToolPart& other = parts_[static_cast<std::size_t>(beside)];
    normal += left_of(other.tangent(at_start ? other.length : 0));
  }
  return dot(p - place.point, normal) > 0;
}

ToolPlace Tools::nearest(const Vec2& p) const noexcept {
  ToolPlace best;
  double along = 0, squared = infinity;
  const Vec3 q{p.x(), p.y(), 0};
  tree_.nearest_first([&](std::size_t n) { return tree_.node(n).box.squared_distance(q); },
                      [&](double bound) { return bound <= squared; },
                      [&](const BoxTree::Node& leaf) {
                        for (const std::int32_t i : tree_.things(leaf)) {
                          const ToolPart& part = parts_[static_cast<std::size_t>(i)];
                          const double there = nearest_along(part, p);
                          const Vec2 point = part.point(there), d = p - point;
                          const double found = dot(d, d);
                          if (found > squared || (found == squared && i > best.part)) continue;
                          squared = found, along = there;
                          best.part = i, best.tool = part.tool, best.s = part.s + there, best.point = point;
                        }
                      });
  if (best.part < 0) return best;
  best.distance = std::sqrt(squared);
  best.in_solid = squared > 0 && is_in_solid(best, along, p);
  return best;
}

double Tools::way_back(std::int32_t tool, double p, double q) const noexcept {
  const Extent& extent = tool_[static_cast<std::size_t>(tool)];
  const double way = p - q;
  return way < 0 && extent.closed ? way + extent.length : way;
}

ToolPlace Tools::at(std::int32_t tool, double s) const noexcept {
  const Extent& extent = tool_[static_cast<std::size_t>(tool)];
  if (extent.closed) s -= extent.length * std::floor(s / extent.length);
  std::int32_t i = extent.first;
  while (i < extent.last && parts_[static_cast<std::size_t>(i) + 1].s <= s) ++i;
  const ToolPart& part = parts_[static_cast<std::size_t>(i)];
  return {i, tool, s, part.point(s - part.s), 0, false};
}

std::vector<double> Tools::corners_back(std::int32_t tool, double p, double way) const {
  const Extent& extent = tool_[static_cast<std::size_t>(tool)];
  std::vector<double> ways;
  for (std::int32_t i = extent.first; i <= extent.last; ++i) {
    const ToolPart& part = parts_[static_cast<std::size_t>(i)];
    if (part.previous < 0) continue;
    const ToolPart& before = parts_[static_cast<std::size_t>(part.previous)];
    if (dot(before.tangent(before.length), part.tangent(0)) > 1 - 1e-9) continue;
    const double there = way_back(tool, p, part.s);
    if (there > 0 && there < way) ways.push_back(there);
  }
  std::sort(ways.begin(), ways.end());
  return ways;
}

}  // namespace carreau::variable
