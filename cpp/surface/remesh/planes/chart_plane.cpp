// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/planes/chart_plane.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "predicates/clamped_int.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "surface/remesh/planes/thresholds.h"

namespace carreau {

using namespace thresholds::planes;

namespace {

// Barycentric, by corner; the sum is 1.
std::array<double, 3> weights_in(const std::array<Vec2, 3>& c, const Vec2& p) {
  const Vec2 b = c[1] - c[0], d = c[2] - c[0], q = p - c[0];
  const double area = cross(b, d);
  const double wb = cross(q, d) / area, wc = cross(b, q) / area;
  return {1 - wb - wc, wb, wc};
}


}  // namespace

ChartPlane::ChartPlane(const FlatAtlas& atlas, const Vec3& axis, std::span<const std::int32_t> triangles, double size,
                       bool slits)
    : atlas_(atlas), axis_(axis), origin_(atlas.centre[triangles.front()]), slits_(slits), step_(size) {
  const Vec3 other = std::abs(axis[0]) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  first_ = cross(other, axis);
  first_ /= norm(first_);
  second_ = cross(axis, first_);
  for (const std::int32_t t : triangles)
    for (const Vec3& n : atlas.corner[t]) least_ = std::min(least_, dot(n, axis));
  enclose(triangles);
  for (const std::int32_t t : triangles) fill(t);
  shown_.assign(triangles.begin(), triangles.end());
  std::set<std::int32_t> met;  // beyond
  std::vector<std::int32_t> ring(triangles.begin(), triangles.end());
  for (int k = 0; k < rings_beyond; ++k) {
    std::vector<std::int32_t> next;
    for (const std::int32_t t : ring)
      for (const std::int32_t u : atlas.at(t).beyond)
        if (is_shown(u) && !std::ranges::binary_search(triangles, u) && met.insert(u).second)
          next.push_back(u), fill(u);
    ring = std::move(next);
  }
  shown_.insert(shown_.end(), met.begin(), met.end());
  spread();
}

std::array<Vec2, 3> ChartPlane::corners(std::int32_t t) const {
  const auto& v = atlas_.at(t).vertex;
  return {project(atlas_.xyz(v[0])), project(atlas_.xyz(v[1])), project(atlas_.xyz(v[2]))};
}

void ChartPlane::enclose(std::span<const std::int32_t> triangles) {
  Vec2 low{infinity, infinity}, high{-infinity, -infinity};
  for (const std::int32_t t : triangles)
    for (const Vec2& p : corners(t))
      for (int i = 0; i < 2; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  for (int i = 0; i < 2; ++i) low[i] -= 2 * step_, high[i] += 2 * step_;
  low_ = low;
  const Vec2 extents = high - low;
  step_ = std::max(step_, std::sqrt(extents.x() * extents.y() / max_cells));
  columns_ = static_cast<int>(extents.x() / step_) + 1, rows_ = static_cast<int>(extents.y() / step_) + 1;
  raster_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1);
}

// Enters the triangle in the cells whose centre it contains, and in the cell of the triangle's centre.
void ChartPlane::fill(std::int32_t t) {
  const std::array<Vec2, 3> c = corners(t);
  if (!(cross(c[1] - c[0], c[2] - c[0]) > 0)) return;
  const auto column = [&](double x) {
    return clamped_int((x - low_.x()) / step_, 0, columns_ - 1);
  };
  const auto row = [&](double y) {
    return clamped_int((y - low_.y()) / step_, 0, rows_ - 1);
  };
  const Vec2 middle = (c[0] + c[1] + c[2]) / 3;
  if (std::int32_t& here = raster_[cell(column(middle.x()), row(middle.y()))]; here < 0) here = t;
  const auto [left, right] = std::minmax({c[0].x(), c[1].x(), c[2].x()});
  const auto [lower, upper] = std::minmax({c[0].y(), c[1].y(), c[2].y()});
  for (int j = row(lower); j <= row(upper); ++j)
    for (int i = column(left); i <= column(right); ++i) {
      std::int32_t& here = raster_[cell(i, j)];
      if (here >= 0) continue;
      const auto w = weights_in(c, {low_.x() + (i + 0.5) * step_, low_.y() + (j + 0.5) * step_});
      if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0) here = t;
    }
}

// Gives cells without a triangle the triangle of a neighbour, over and over.
void ChartPlane::spread() {
  std::vector<std::array<int, 2>> queue;
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i)
      if (raster_[cell(i, j)] >= 0) queue.push_back({i, j});
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const auto [i, j] = queue[k];
    const std::int32_t t = raster_[cell(i, j)];
    for (const auto& [di, dj] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      if (i + di < 0 || i + di >= columns_ || j + dj < 0 || j + dj >= rows_ || raster_[cell(i + di, j + dj)] >= 0)
        continue;
      raster_[cell(i + di, j + dj)] = t;
      queue.push_back({i + di, j + dj});
    }
  }
}

std::optional<Foot> ChartPlane::find(const Vec2& p, bool roughly) const {
  const int i = clamped_int((p.x() - low_.x()) / step_, 0, columns_ - 1),
            j = clamped_int((p.y() - low_.y()) / step_, 0, rows_ - 1);
  std::int32_t t = raster_[cell(i, j)], before = -1;
  for (int step = 0; step <= rounding_of::max_steps && t >= 0; ++step) {
    if (step == rounding_of::max_steps) t = straight_to(p, t);
    const std::array<double, 3> w = weights_in(corners(t), p);
    std::int32_t next = -1;
    double least = -rounding_of::places;
    for (int k = 0; k < 3; ++k)
      if (const std::int32_t u = atlas_.at(t).beyond[(k + 1) % 3]; w[k] < least && u != before && is_shown(u))
        least = w[k], next = u;
    if (next < 0) {
      if (roughly || (w[0] >= -rounding_of::places && w[1] >= -rounding_of::places && w[2] >= -rounding_of::places)) return foot_in(t, w);
      break;
    }
    before = t, t = next;
  }
  if (t < 0) return {};
  Found found = find_around(t, p);
  if (slits_)  // on its other side, perhaps
    for (int k = std::max(j - 1, 0); k <= std::min(j + 1, rows_ - 1); ++k)
      for (int n = std::max(i - 1, 0); n <= std::min(i + 1, columns_ - 1) && found.outside > 0; ++n)
        if (const Found other = find_around(raster_[cell(n, k)], p); other.outside < found.outside) found = other;
  if (found.outside > max_miss * step_) found = find_anywhere(p, found);
  return foot_in(found.triangle, weights_in(corners(found.triangle), p));
}

bool ChartPlane::is_shown(std::int32_t t) const {
  return t >= 0 && dot(atlas_.normal[t], axis_) > thresholds::planes::min_cosine;
}

std::optional<Foot> ChartPlane::foot_in(std::int32_t t, std::array<double, 3> w) const {
  double sum = 0;
  for (double& each : w) sum += each = std::max(each, 0.0);
  if (!(sum > 0)) return {};
  const Charts& charts = atlas_.charts;
  return Foot{t, (w[0] / sum) * charts.uv(t, 0) + (w[1] / sum) * charts.uv(t, 1) + (w[2] / sum) * charts.uv(t, 2)};
}

// Lower bound of the distance of a place outside of a triangle.
double ChartPlane::outside(std::int32_t t, const Vec2& p) const {
  const std::array<Vec2, 3> c = corners(t);
  const std::array<double, 3> w = weights_in(c, p);
  const double area = cross(c[1] - c[0], c[2] - c[0]);
  double most = 0;
  for (int i = 0; i < 3; ++i) most = std::max(most, -w[i] * area / norm(c[(i + 2) % 3] - c[(i + 1) % 3]));
  return most;
}

// Along the straight line from the middle of the first triangle to p: as far as triangles are shown.
std::int32_t ChartPlane::straight_to(const Vec2& p, std::int32_t first) const {
  const std::array<Vec2, 3> begin = corners(first);
  const Vec2 from = (begin[0] + begin[1] + begin[2]) / 3;
  std::int32_t t = first, before = -1;
  for (int step = 0; step < max_cells; ++step) {
    const std::array<Vec2, 3> c = corners(t);
    const std::array<double, 3> there = weights_in(c, p), here = weights_in(c, from);
    std::int32_t next = -1;
    double way = infinity;
    for (int k = 0; k < 3; ++k) {
      if (there[k] >= -rounding_of::places || here[k] <= there[k]) continue;
      const std::int32_t u = atlas_.at(t).beyond[(k + 1) % 3];
      if (const double to_side = here[k] / (here[k] - there[k]); u != before && is_shown(u) && to_side < way)
        way = to_side, next = u;
    }
    if (next < 0) break;
    before = t, t = next;
  }
  return t;
}

// The triangle that contains a place, or the nearest one, behind all barriers: needles that lean away divide the
// regions that they cross.
ChartPlane::Found ChartPlane::find_anywhere(const Vec2& p, Found best) const {
  for (const std::int32_t t : shown_) {
    if (!is_shown(t)) continue;
    if (const double d = outside(t, p); d < best.outside) best = {t, d};
    if (!(best.outside > 0)) break;
  }
  return best;
}

// Searches from triangle to triangle, the nearest first, if no straight way leads to the place.
ChartPlane::Found ChartPlane::find_around(std::int32_t first, const Vec2& p) const {
  std::vector<Found> around{{first, outside(first, p)}};
  std::vector<char> done{0};
  for (;;) {
    std::size_t best = around.size();
    for (std::size_t k = 0; k < around.size(); ++k)
      if (done[k] == 0 && (best == around.size() || around[k].outside < around[best].outside)) best = k;
    if (best == around.size() || around.size() >= rounding_of::max_steps || !(around[best].outside > 0)) break;
    done[best] = 1;
    for (const std::int32_t u : atlas_.at(around[best].triangle).beyond)
      if (is_shown(u) && std::ranges::find(around, u, &Found::triangle) == around.end())
        around.push_back({u, outside(u, p)}), done.push_back(0);
  }
  return *std::ranges::min_element(around, {}, &Found::outside);
}

// The metric of z(x, y) over the plane: 1 + the squares of its slopes, which follow from the normal.
Metric2 ChartPlane::metric(const Foot& at) const {
  const std::array<double, 3> w = atlas_.charts.weights(at.triangle, at.uv);
  const auto& n = atlas_.corner[at.triangle];
  Vec3 normal = w[0] * n[0] + w[1] * n[1] + w[2] * n[2];
  // Opposite normals at the corners of a folded triangle cancel out, and a triangle without area has no weights.
  if (!(norm(normal) > rounding_of::places)) normal = atlas_.normal[at.triangle];
  if (!(norm(normal) > rounding_of::places)) return {1, 0, 1};
  const double up = std::max(dot(normal, axis_), thresholds::planes::min_cosine * norm(normal));
  const double p = dot(normal, first_) / up, q = dot(normal, second_) / up;
  return {1 + p * p, p * q, 1 + q * q};
}

}  // namespace carreau
