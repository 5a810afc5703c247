// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/sharp_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/discrete/sharp_angle.h"
#include "geometry/discrete/thresholds.h"
#include "support/angles.h"
#include "support/error.h"
#include "support/format.h"
#include "support/incidence.h"
#include "support/infinity.h"

namespace carreau::discrete {

namespace {


void check_angle(const char* name, double angle) {
  constexpr double half_turn = 180;
  if (!(angle > 0 && angle <= half_turn))
    throw InvalidArgument(std::string("the ") + name + " is " + format_number(angle) +
                          " degrees; it must lie above 0 and not above 180");
}

class LineFinder {
 public:
  LineFinder(const Triangulation& mesh, const SharpOptions& options)
      : mesh_(mesh), options_(options), at_vertex_(mesh.vertices.size(), mesh.edges) {}

  SharpLines run() {
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) bends_.push_back(mesh_.bend(static_cast<std::int32_t>(e)));
    found_.sharp_angle = options_.sharp_angle.value_or(thresholds::usual_sharp);
    if (!options_.sharp_angle && !options_.marked_only) {
      SharpAngle angle = find_sharp_angle(mesh_, bends_);
      found_.sharp_angle = angle.angle, round_ = std::move(angle.round);
    }
    found_.sharp.assign(mesh_.edges.size(), 0);
    certain_.assign(mesh_.edges.size(), 0);
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) start(static_cast<std::int32_t>(e));
    if (!options_.marked_only) {
      drop_few();
      go_on();
      drop_faded();
    }
    find_corners();
    find_lines();
    find_regions();
    found_.edges = std::ranges::count(found_.sharp, char{1});
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool is_sharp(std::int32_t e) const { return found_.sharp[index(e)] != 0; }
  [[nodiscard]] std::int32_t other(std::int32_t e, std::int32_t v) const {
    const Edge& edge = mesh_.edges[index(e)];
    return edge[0] == v ? edge[1] : edge[0];
  }
  [[nodiscard]] int degree(std::int32_t v) const {
    return static_cast<int>(std::ranges::count_if(at_vertex_.of(v), [&](std::int32_t e) { return is_sharp(e); }));
  }
  [[nodiscard]] Vec3 direction(std::int32_t e, std::int32_t from) const {
    const Vec3 d = mesh_.at(other(e, from)) - mesh_.at(from);
    return d / norm(d);
  }

  void start(std::int32_t e) {
    const auto both = mesh_.sides(e);
    const bool agree = both.size() == 2 && mesh_.beyond(both[0].triangle, both[0].side).triangle >= 0;
    const bool refs =
        options_.references && agree && mesh_.refs[index(both[0].triangle)] != mesh_.refs[index(both[1].triangle)];
    const bool marked = std::ranges::binary_search(mesh_.marked, mesh_.edges[index(e)]);
    if (!agree || refs || marked)
      found_.sharp[index(e)] = certain_[index(e)] = 1;
    else if (!options_.marked_only && bends_[index(e)] > found_.sharp_angle && (round_.empty() || round_[index(e)] == 0))
      found_.sharp[index(e)] = 1;
  }

  // The paper drops lone edges; a few connected edges with a free end are noise as well.
  void drop_few() {
    UnionFind sets(mesh_.vertices.size());
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e)
      if (found_.sharp[e] != 0) sets.merge(index(mesh_.edges[e][0]), index(mesh_.edges[e][1]));
    std::vector<int> count(mesh_.vertices.size(), 0);
    std::vector<char> kept(mesh_.vertices.size(), 1);
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e)
      if (found_.sharp[e] != 0)
        count[sets.find(index(mesh_.edges[e][0]))] += certain_[e] != 0 ? thresholds::min_edges : 1;
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(kept.size()); ++v)
      if (degree(v) == 1) kept[sets.find(index(v))] = 0;
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) {
      const std::size_t set = sets.find(index(mesh_.edges[e][0]));
      if (found_.sharp[e] == 0 || kept[set] != 0 || count[set] >= thresholds::min_edges) continue;
      found_.sharp[e] = 0, ++found_.dropped;
    }
  }

  /// The edge over which a line goes on that ends at v with the edge `last`; -1: none.
  [[nodiscard]] std::int32_t candidate(std::int32_t v, std::int32_t last) const {
    double largest = 0;
    for (const std::int32_t e : at_vertex_.of(v))
      if (!is_sharp(e)) largest = std::max(largest, bends_[index(e)]);
    const double least = std::max(thresholds::share_of_largest * largest, thresholds::min_angle);
    const Vec3 came = direction(last, v);
    std::int32_t best = -1;
    double straightest = angles::cosine_of_60;
    for (const std::int32_t e : at_vertex_.of(v)) {
      if (is_sharp(e) || bends_[index(e)] < least) continue;
      if (const double straight = -dot(came, direction(e, v)); straight > straightest) straightest = straight, best = e;
    }
    return best;
  }

  /// Edges of the line that ends at v, back to its junction with another line.
  [[nodiscard]] std::vector<std::int32_t> line_to(std::int32_t v, std::int32_t last) const {
    std::vector<std::int32_t> line{last};
    std::int32_t at = other(last, v), e = last;
    while (at != v && degree(at) == 2) {
      for (const std::int32_t next : at_vertex_.of(at))
        if (is_sharp(next) && next != e) {
          e = next;
          break;
        }
      line.push_back(e);
      at = other(e, at);
    }
    return line;
  }

  // Ends are prolonged one after the other; a prolongation that does not reach another line is removed.
  void go_on() {
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh_.vertices.size()); ++v) {
      if (degree(v) != 1) continue;
      std::int32_t last = -1;
      for (const std::int32_t e : at_vertex_.of(v))
        if (is_sharp(e)) last = e;
      if (certain_[index(last)] != 0) continue;
      const std::size_t most = thresholds::max_prolongation * line_to(v, last).size();
      std::vector<std::int32_t> more;
      std::int32_t end = v;
      bool reached = false;
      while (!reached && more.size() < most) {
        const std::int32_t next = candidate(end, last);
        if (next < 0) break;
        end = other(next, end);
        reached = degree(end) > 0;
        found_.sharp[index(next)] = 1;
        more.push_back(last = next);
      }
      if (reached)
        found_.prolonged += static_cast<std::int64_t>(more.size());
      else
        for (const std::int32_t e : more) found_.sharp[index(e)] = 0;
    }
  }

  // Lines with a free end: short ones are noise, long ones stay and are reported.
  void drop_faded() {
    std::vector<std::int32_t> ends;
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh_.vertices.size()); ++v)
      if (degree(v) == 1) ends.push_back(v);
    for (const std::int32_t v : ends) {
      if (degree(v) != 1) continue;
      std::int32_t last = -1;
      for (const std::int32_t e : at_vertex_.of(v))
        if (is_sharp(e)) last = e;
      const std::vector<std::int32_t> line = line_to(v, last);
      const bool certain = std::ranges::any_of(line, [&](std::int32_t e) { return certain_[index(e)] != 0; });
      // If the angle was found, flatter edges that fade out belong to a tessellation.
      const bool clear = options_.sharp_angle ||
                         std::ranges::any_of(line, [&](std::int32_t e) { return bends_[index(e)] > thresholds::usual_sharp; });
      if (certain || (clear && static_cast<int>(line.size()) >= thresholds::min_edges)) continue;
      for (const std::int32_t e : line) found_.sharp[index(e)] = 0;
      found_.dropped += static_cast<std::int64_t>(line.size());
    }
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh_.vertices.size()); ++v)
      if (degree(v) == 1 && found_.faded++ == 0) {
        const Vec3& p = mesh_.at(v);
        found_.sentences.push_back("a sharp line fades out at (" + format_number(p.x()) + ", " + format_number(p.y()) +
                                   ", " + format_number(p.z()) + ")");
      }
  }

  // Corners are vertices where other than two lines meet, lines turn, or the surface is not one disc beside them.
  void find_corners() {
    const double cosine = std::cos(options_.corner_angle * std::numbers::pi / 180);
    const std::vector<int> discs = discs_of_vertices();
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh_.vertices.size()); ++v) {
      std::vector<std::int32_t> here;
      for (const std::int32_t e : at_vertex_.of(v))
        if (is_sharp(e)) here.push_back(e);
      bool corner = !here.empty() && here.size() != 2;
      if (here.empty()) corner = discs[index(v)] > 1;
      if (here.size() == 2) {
        corner = -dot(direction(here[0], v), direction(here[1], v)) < cosine;
        corner = corner || std::ranges::binary_search(options_.corners, v);
        for (const std::int32_t e : here) corner = corner || static_cast<int>(mesh_.sides(e).size()) != discs[index(v)];
      }
      if (corner) found_.corners.push_back(v);
    }
  }

  /// Parts of the triangles around each vertex that no sharp edge divides.
  [[nodiscard]] std::vector<int> discs_of_vertices() const {
    UnionFind sets = sectors_of(mesh_, found_.sharp);
    std::vector<int> discs(mesh_.vertices.size(), 0);
    for (std::size_t c = 0; c < 3 * mesh_.triangles.size(); ++c)
      if (sets.find(c) == c) ++discs[index(mesh_.triangles[c / 3][c % 3])];
    return discs;
  }

  void find_lines() {
    std::vector<char> used(mesh_.edges.size(), 0);
    const auto follow = [&](std::int32_t v, std::int32_t e) {
      Line line{{v}, {}};
      while (e >= 0) {
        used[index(e)] = 1;
        line.edges.push_back(e);
        line.vertices.push_back(v = other(e, v));
        e = -1;
        if (std::ranges::binary_search(found_.corners, v)) break;
        for (const std::int32_t next : at_vertex_.of(v))
          if (is_sharp(next) && used[index(next)] == 0) e = next;
      }
      found_.lines.push_back(std::move(line));
    };
    for (const std::int32_t v : found_.corners)
      for (const std::int32_t e : at_vertex_.of(v))
        if (is_sharp(e) && used[index(e)] == 0) follow(v, e);
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(mesh_.edges.size()); ++e)
      if (is_sharp(e) && used[index(e)] == 0) follow(mesh_.edges[index(e)][0], e);
  }

  void find_regions() {
    UnionFind sets(mesh_.triangles.size());
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e)
      if (found_.sharp[e] == 0) {
        const auto both = mesh_.sides(static_cast<std::int32_t>(e));
        sets.merge(index(both[0].triangle), index(both[1].triangle));
      }
    std::vector<std::int32_t> number(mesh_.triangles.size(), -1);
    for (std::size_t t = 0; t < number.size(); ++t) {
      const std::size_t first = sets.find(t);
      if (number[first] < 0) number[first] = found_.regions++;
      found_.region.push_back(number[first]);
    }
  }

  const Triangulation& mesh_;
  const SharpOptions& options_;
  Incidence at_vertex_;
  std::vector<double> bends_;  // by edge, degrees
  std::vector<char> round_;    // by edge: no feature; empty: all may be
  std::vector<char> certain_;  // by edge: no line has to be sought
  SharpLines found_;
};

}  // namespace

UnionFind sectors_of(const Triangulation& mesh, const std::vector<char>& sharp) {
  UnionFind sets(3 * mesh.triangles.size());
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t)
    for (int i = 0; i < 3; ++i) {
      if (sharp[index(mesh.edge(t, i))] != 0) continue;
      const Side u = mesh.beyond(t, i);  // runs the other way
      if (u.triangle < t) continue;
      const auto rank = [](std::int32_t triangle, int k) {
        return 3 * index(triangle) + static_cast<std::size_t>(k % 3);
      };
      sets.merge(rank(t, i), rank(u.triangle, u.side + 1));
      sets.merge(rank(t, i + 1), rank(u.triangle, u.side));
    }
  return sets;
}

SharpLines find_sharp_lines(const Triangulation& mesh, const SharpOptions& options) {
  if (options.sharp_angle) check_angle("sharp angle", *options.sharp_angle);
  check_angle("corner angle", options.corner_angle);
  return LineFinder(mesh, options).run();
}

}  // namespace carreau::discrete
