// SPDX-License-Identifier: BSD-3-Clause
#include "variable/boundary/boundary_runs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "variable/base/thresholds.h"

namespace carreau::variable {

namespace {

/// Radians, not negative.
double turn_at(const BoundaryLoop& loop, std::size_t i) noexcept {
  const Vec2 p = loop.nodes[i].point - loop.nodes[loop.before(i)].point,
             q = loop.nodes[loop.after(i)].point - loop.nodes[i].point;
  return std::abs(std::atan2(cross(p, q), dot(p, q)));
}

bool is_end(const BoundaryLoop& loop, std::size_t i, double corner_angle) noexcept {
  const std::int32_t kind = loop.kind_of_edge(i);
  if (kind != loop.kind_of_edge(loop.before(i))) return true;
  if (kind >= Kind::bound) return false;
  return loop.nodes[i].is_bound() || turn_at(loop, i) > corner_angle * std::numbers::pi / 180;
}

double length_of(const BoundaryLoop& loop, const BoundaryRun& run) {
  double sum = 0;
  for (std::size_t k = 0; k < run.count; ++k) {
    const std::size_t i = (run.first + k) % loop.size();
    sum += loop.edges[i].follows_tool ? loop.edges[i].way : loop.length(i);
  }
  return sum;
}

/// Removes the nodes inside the run and its less important end.
void close(BoundaryLoop& loop, const BoundaryRun& run) {
  const std::size_t end = (run.first + run.count) % loop.size();
  const auto matters = [&](std::size_t i) { return (loop.nodes[i].is_bound() ? 10 : 0) + turn_at(loop, i); };
  const bool keep_first = matters(run.first) >= matters(end);
  std::vector<std::size_t> gone;
  for (std::size_t k = keep_first ? 1 : 0; k < run.count + (keep_first ? 1 : 0); ++k)
    gone.push_back((run.first + k) % loop.size());
  std::sort(gone.rbegin(), gone.rend());
  for (const std::size_t i : gone)
    if (loop.size() > 3) loop.remove(i);
}

}  // namespace

std::vector<BoundaryRun> runs_of(const BoundaryLoop& loop, double corner_angle) {
  const std::size_t n = loop.size();
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < n; ++i)
    if (is_end(loop, i, corner_angle)) ends.push_back(i);
  if (ends.empty()) return {{.first = 0, .count = n, .kind = loop.kind_of_edge(0), .closed = true}};
  std::vector<BoundaryRun> runs;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const std::size_t next = k + 1 < ends.size() ? ends[k + 1] : ends[0] + n;
    runs.push_back({.first = ends[k], .count = next - ends[k], .kind = loop.kind_of_edge(ends[k]), .closed = false});
  }
  return runs;
}

void join_close_ends(BoundaryLoop& loop, const Tools& tools, double corner_angle, double h_min) {
  for (std::size_t most = loop.size(); most > 0 && loop.size() > 3; --most) {
    const std::vector<BoundaryRun> runs = runs_of(loop, corner_angle);
    if (runs.size() < 2) return;
    const auto is_short = [&](const BoundaryRun& run) {
      return length_of(loop, run) < thresholds::variable::closest_ends * h_min;
    };
    const auto found = std::find_if(runs.begin(), runs.end(), is_short);
    if (found == runs.end()) return;
    close(loop, *found);
    follow_tools(loop, tools, h_min);
  }
}

void cut_tips(BoundaryLoop& loop, const Tools& tools, double h_min) {
  const double limit = thresholds::variable::sharpest_tip * std::numbers::pi / 180;
  const auto is_tip = [&](std::size_t i) {
    const Vec2 p = loop.nodes[loop.before(i)].point - loop.nodes[i].point,
               q = loop.nodes[loop.after(i)].point - loop.nodes[i].point;
    const double sine = cross(q, p);  // the piece lies between q and p, counterclockwise
    return sine >= 0 && std::atan2(std::abs(sine), dot(p, q)) < limit;  // not of -0
  };
  bool any = false;
  for (std::size_t i = 0; i < loop.size() && loop.size() > 3;) {
    if (!is_tip(i)) {
      ++i;
      continue;
    }
    loop.remove(i);
    any = true;
    i = i > 0 ? i - 1 : 0;  // the node before may be a tip now
  }
  if (any) follow_tools(loop, tools, h_min);
}

void smooth_imposed(BoundaryLoop& loop, int rounds) {
  const std::size_t n = loop.size();
  for (int round = 0; round < rounds; ++round) {
    std::vector<Vec2> moved;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 p = loop.nodes[i].point;
      moved.push_back(p);
      if (!loop.edges[i].bared || !loop.edges[loop.before(i)].bared || loop.nodes[i].is_bound()) continue;
      const Vec2 middle = (loop.nodes[loop.before(i)].point + loop.nodes[loop.after(i)].point) / 2;
      const Vec2 move = (middle - p) / 2;
      const double most = std::min(loop.length(i), loop.length(loop.before(i))) / 4, length = norm(move);
      moved.back() = p + (length > most ? most / length : 1) * move;
    }
    for (std::size_t i = 0; i < n; ++i) loop.nodes[i].point = moved[i];
  }
}

}  // namespace carreau::variable
