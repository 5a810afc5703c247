// SPDX-License-Identifier: BSD-3-Clause
#include "surface/discrete/periodic_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "mesh/triangle_search.h"
#include "model/format_point.h"
#include "model/traces.h"
#include "periodic/find_map.h"
#include "periodic/invalid_periodicity.h"
#include "periodic/thresholds.h"
#include "support/error.h"
#include "support/format.h"
#include "support/infinity.h"
#include "support/shares.h"
#include "support/short_number.h"

namespace carreau {

namespace {

using namespace thresholds::periodic;

struct Miss {
  double distance = 0;
  Vec3 where{0, 0, 0};
};

// Share of the shortest edge of a line that images may miss by.
constexpr double max_share_of_edge = 0.2;

// Fractions of a line where its direction is compared.
constexpr double quarter = 0.25;

class Finder {
 public:
  Finder(const Model& model, double diag, std::size_t given, SurfaceMesh& mesh)
      : model_(model), given_(static_cast<std::int32_t>(given)), mesh_(mesh), lines_of_(mesh.faces.size()), boxes_(mesh.faces.size()) {
    result_.gap = max_gap * diag;
    for (std::size_t c = 0; c < mesh.curves.size(); ++c) {  // vertices of a line stay distinct
      const std::vector<Vec3> trace = trace_of(static_cast<int>(c));
      for (std::size_t k = 1; k < trace.size(); ++k) result_.gap = std::min(result_.gap, max_share_of_edge * norm(trace[k] - trace[k - 1]));
    }
    result_.gap = std::max(result_.gap, shares::negligible * max_gap * diag);
    for (const Periodicity& each : model.periodicities) add_map(each);
    cut_at_images();
    for (std::size_t c = 0; c < mesh.curves.size(); ++c)
      for (const CurveMeshUse& use : mesh.curves[c].uses) lines_of_[use.face].insert(static_cast<int>(c));
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      for (const std::int32_t v : mesh.faces[f].vertex) boxes_[f].add(mesh.vertices[v]);
  }

  PeriodicTriangles run() {
    for (const Periodicity& given : model_.periodicities) add(given);
    collect(face_steps_, mesh_.faces.size(), false, result_.faces);
    collect(line_steps_, mesh_.curves.size(), true, result_.lines);
    return std::move(result_);
  }

 private:
  [[nodiscard]] int ref(int face) const { return mesh_.faces[face].ref; }
  // Vertices between the given ones lie on smooth curves, which depend on the triangles of one side.
  [[nodiscard]] std::vector<std::int32_t> given_of(const CurveMesh& curve) const {
    std::vector<std::int32_t> chain;
    std::ranges::copy_if(curve.vertices, std::back_inserter(chain), [this](std::int32_t v) { return v < given_; });
    return chain;
  }
  [[nodiscard]] std::vector<Vec3> trace_of(int line) const {
    std::vector<Vec3> trace;
    for (const std::int32_t v : given_of(mesh_.curves[line])) trace.push_back(mesh_.vertices[v]);
    return trace;
  }
  [[nodiscard]] bool is_closed(int line) const { return mesh_.curves[line].vertices.front() == mesh_.curves[line].vertices.back(); }
  [[nodiscard]] std::vector<Vec3> image_of(int line, const Isometry& map) const {
    std::vector<Vec3> image = trace_of(line);
    for (Vec3& p : image) p = map(p);
    return image;
  }

  [[nodiscard]] int index_of(int reference) const {
    for (int f = 0; f < std::ssize(mesh_.faces); ++f)
      if (ref(f) == reference && !mesh_.faces[f].triangles.empty()) return f;
    throw InvalidPeriodicity(Where{.face = reference}, "the face is periodic, and the model has no such face with triangles");
  }

  void add(const Periodicity& given) {
    if (norm(given.direction) > 0) return add_found(translation_along(given.direction));
    if (given.slaves.empty()) return add_found(*given.map);
    for (std::size_t i = 0; i < given.slaves.size(); ++i) {
      const int slave = index_of(given.slaves[i]), master = index_of(given.masters[i]);
      if (slave == master) throw InvalidPeriodicity(Where{.face = given.slaves[i]}, "the face is periodic with itself: divide it into a master and a slave");
      std::optional<Isometry> map = given.map;
      if (!map) map = find_map(ends_of(master), ends_of(slave), result_.gap, [&](const Isometry& m) { return lines_between(master, slave, m).has_value(); });
      if (!map) throw InvalidPeriodicity(Where{.face = ref(slave)}, "no map carries face " + std::to_string(ref(master)) + " onto the face");
      if (!add_face(master, slave, *map)) throw InvalidPeriodicity(Where{.face = ref(slave)}, why_not(master, slave, *map));
    }
  }

  [[nodiscard]] std::vector<Vec3> ends_of(int face) const {
    std::set<std::int32_t> ends;
    for (const int c : lines_of_[face]) ends.insert({mesh_.curves[c].vertices.front(), mesh_.curves[c].vertices.back()});
    std::vector<Vec3> points;
    for (const std::int32_t v : ends) points.push_back(mesh_.vertices[v]);
    return points;
  }

  [[nodiscard]] Isometry translation_along(const Vec3& direction) const {
    const Vec3 along = direction / norm(direction);
    double low = infinity, high = -infinity;
    for (const Vec3& p : mesh_.vertices) low = std::min(low, dot(p, along)), high = std::max(high, dot(p, along));
    char text[32];
    std::snprintf(text, sizeof text, "%.12g", high - low);
    Isometry map;
    map.shift = std::strtod(text, nullptr) * along;
    for (int i = 0; i < 3; ++i)
      if (along[i] == 0) map.shift[i] = 0;
    return map;
  }

  void add_map(const Periodicity& given) {
    const bool known = given.map || norm(given.direction) > 0;
    if (!known) return;
    const Isometry map = norm(given.direction) > 0 ? translation_along(given.direction) : *given.map;
    maps_.push_back(map), maps_.push_back(map.inverse());
  }

  // Angles of lines decide on corners, and rounding on angles: images of corners are corners. So are ends of the part of a line that a map
  // carries onto lines: borders of a sheet may pass from one side of a cell to the next without a corner.
  void cut_at_images() {
    std::vector<std::int32_t> on_lines;
    std::vector<std::array<std::int32_t, 3>> points, segments;
    for (const CurveMesh& curve : mesh_.curves) {
      const std::vector<std::int32_t> chain = given_of(curve);
      for (std::size_t k = 0; k < chain.size(); ++k) {
        on_lines.push_back(chain[k]);
        points.push_back({chain[k], chain[k], chain[k]});
        if (k > 0) segments.push_back({chain[k - 1], chain[k], chain[k]});
      }
    }
    if (maps_.empty() || points.empty()) return;
    const TriangleSearch vertices(mesh_.vertices, points), lines(mesh_.vertices, segments);
    std::vector<std::int32_t> corners;
    for (const std::int32_t v : ends_of_parts(lines)) make_corner(v, corners);
    for (const std::int32_t v : on_lines)
      if (mesh_.vertex_ref[v] != 0) corners.push_back(v);
    for (std::size_t i = 0; i < corners.size(); ++i)
      for (const Isometry& map : maps_) {
        const NearestOnMesh nearest = vertices.nearest(map(mesh_.vertices[corners[i]]));
        if (nearest.distance <= result_.gap) make_corner(points[nearest.triangle][0], corners);
      }
    std::ranges::sort(result_.corners);
  }

  [[nodiscard]] std::vector<std::int32_t> ends_of_parts(const TriangleSearch& lines) const {
    std::vector<std::int32_t> ends;
    BoxTree::Box of_lines;
    for (const CurveMesh& curve : mesh_.curves)
      for (const std::int32_t v : curve.vertices) of_lines.add(mesh_.vertices[v]);
    const auto is_on_lines = [&](const Vec3& p) {
      return norm(p - p.cwiseMax(of_lines.low).cwiseMin(of_lines.high)) <= result_.gap && lines.nearest(p).distance <= result_.gap;
    };
    for (const Isometry& map : maps_)
      for (const CurveMesh& curve : mesh_.curves) {
        const std::vector<std::int32_t> chain = given_of(curve);
        std::vector<char> is_carried;
        for (const std::int32_t v : chain) is_carried.push_back(is_on_lines(map(mesh_.vertices[v])) ? 1 : 0);
        for (std::size_t k = 1; k < is_carried.size(); ++k)
          if (is_carried[k] != is_carried[k - 1]) ends.push_back(chain[is_carried[k] != 0 ? k : k - 1]);
      }
    return ends;
  }

  void make_corner(std::int32_t v, std::vector<std::int32_t>& corners) {
    if (mesh_.vertex_ref[v] != 0) return;
    cut_line_at(v);
    mesh_.vertex_ref[v] = *std::ranges::max_element(mesh_.vertex_ref) + 1;
    corners.push_back(v), result_.corners.push_back(v);
  }

  void cut_line_at(std::int32_t v) {
    for (std::size_t c = 0; c < mesh_.curves.size(); ++c) {
      std::vector<std::int32_t>& chain = mesh_.curves[c].vertices;
      const auto at = std::ranges::find(chain, v);
      if (at == chain.end()) continue;
      if (chain.front() == chain.back() && mesh_.vertex_ref[chain.front()] == 0) {
        chain.pop_back();
        std::rotate(chain.begin(), at, chain.end());
        chain.push_back(v);
        return;
      }
      CurveMesh rest = mesh_.curves[c];
      rest.ref = static_cast<int>(mesh_.curves.size()) + 1;
      rest.vertices.assign(at, chain.end());
      chain.erase(at + 1, chain.end());
      mesh_.curves.push_back(std::move(rest));
      return;
    }
  }

  // Pairs of faces, else pairs of open borders.
  void add_found(const Isometry& map) {
    std::size_t found = 0;
    for (int m = 0; m < std::ssize(mesh_.faces); ++m) {
      const BoxTree::Box image = image_box(m, map);
      for (int s = 0; s < std::ssize(mesh_.faces); ++s)
        if (s != m && box_distance(m, image, s) <= result_.gap && add_face(m, s, map)) ++found;
    }
    const bool borders = found == 0;
    for (int c = 0; c < std::ssize(mesh_.curves) && borders; ++c)
      if (mesh_.curves[c].uses.size() == 1) found += add_border(c, map) ? 1 : 0;
    if (found == 0) throw InvalidPeriodicity("the map of a periodicity carries no face and no border of the triangles onto another one; " + nearest_miss(map));
  }

  bool add_border(int from, const Isometry& map) {
    for (int to = 0; to < std::ssize(mesh_.curves); ++to)
      if (to != from && mesh_.curves[to].uses.size() == 1 && carries(from, to, map)) {
        line_steps_.push_back({from, to, map});
        return true;
      }
    return false;
  }

  [[nodiscard]] BoxTree::Box image_box(int face, const Isometry& map) const {
    BoxTree::Box image;
    for (const std::int32_t v : mesh_.faces[face].vertex) image.add(map(mesh_.vertices[v]));
    return image;
  }
  // `image`: the box of the master's image.
  [[nodiscard]] double box_distance(int master, const BoxTree::Box& image, int slave) const {
    if (lines_of_[master].empty() || lines_of_[slave].empty()) return infinity;
    return std::max(norm(image.low - boxes_[slave].low), norm(image.high - boxes_[slave].high));
  }

  bool add_face(int master, int slave, const Isometry& map) {
    const auto lines = lines_between(master, slave, map);
    if (!lines) return false;
    face_steps_.push_back({master, slave, map});
    for (const auto& [from, to] : *lines)
      if (from != to) line_steps_.push_back({from, to, map});
    return true;
  }

  [[nodiscard]] std::optional<std::vector<std::pair<int, int>>> lines_between(int master, int slave, const Isometry& map) const {
    const std::set<int>&from = lines_of_[master], &to = lines_of_[slave];
    if (from.empty() || from.size() != to.size()) return {};
    std::vector<std::pair<int, int>> pairs;
    std::set<int> left = to;
    for (const int c : from) {
      const auto found = std::ranges::find_if(left, [&](int d) { return carries(c, d, map); });
      if (found == left.end()) return {};
      pairs.emplace_back(c, *found);
      left.erase(found);
    }
    return pairs;
  }

  [[nodiscard]] bool carries(int from, int to, const Isometry& map) const {
    if (is_closed(from) != is_closed(to)) return false;
    const std::vector<Vec3> image = image_of(from, map), trace = trace_of(to);
    const double gap = result_.gap;
    const auto near = [gap](const Vec3& p, const Vec3& q) { return norm(p - q) <= gap; };
    if (!is_closed(from) && !(near(image.front(), trace.front()) && near(image.back(), trace.back())) &&
        !(near(image.front(), trace.back()) && near(image.back(), trace.front())))
      return false;
    return one_sided_distance(image, trace, gap) <= gap && one_sided_distance(trace, image, gap) <= gap;
  }

  [[nodiscard]] Miss miss_between(int master, int slave, const Isometry& map) const {
    Miss worst;
    const auto look = [&](int from, int to, const Isometry& by, bool there) {
      for (const int c : lines_of_[from])
        for (const Vec3& p : trace_of(c)) {
          double nearest = infinity;
          for (const int d : lines_of_[to]) nearest = std::min(nearest, nearest_on_trace(trace_of(d), by(p)).distance);
          if (nearest > worst.distance) worst = {nearest, there ? by(p) : p};
        }
    };
    look(master, slave, map, true);
    look(slave, master, map.inverse(), false);
    return worst;
  }

  [[nodiscard]] std::string why_not(int master, int slave, const Isometry& map) const {
    const Miss miss = miss_between(master, slave, map);
    return "the image of face " + std::to_string(ref(master)) + " and face " + std::to_string(ref(slave)) + " do not match: their boundaries " +
           (miss.distance > result_.gap ? "are " + short_number(miss.distance) + " apart at " + format_point(miss.where)
                                        : "are one, but their lines end at different corners");
  }

  [[nodiscard]] std::string nearest_miss(const Isometry& map) const {
    double nearest = infinity;
    int master = -1, slave = -1;
    for (int m = 0; m < std::ssize(mesh_.faces); ++m) {
      const BoxTree::Box image = image_box(m, map);
      for (int s = 0; s < std::ssize(mesh_.faces); ++s)
        if (const double miss = s == m ? infinity : box_distance(m, image, s); miss < nearest) nearest = miss, master = m, slave = s;
    }
    return master < 0 ? "it has no two faces with lines" : "nearest is face " + std::to_string(ref(slave)) + ": " + why_not(master, slave, map);
  }

  // ---- classes ----

  // Each slave once, with the map of the lowest of its class.
  void collect(const std::vector<TrianglePair>& steps, std::size_t n, bool turns, std::vector<TrianglePair>& pairs) {
    std::vector<std::vector<TrianglePair>> from(n);
    for (const TrianglePair& step : steps) {
      from[step.master].push_back(step);
      from[step.slave].push_back({step.slave, step.master, step.map.inverse()});
    }
    std::vector<char> known(n, 0);
    for (int root = 0; root < static_cast<int>(n); ++root) {
      if (from[root].empty() || known[root] != 0) continue;
      known[root] = 1;
      std::vector<TrianglePair> reached{{root, root, {}}};
      for (std::size_t i = 0; i < reached.size(); ++i) {
        const TrianglePair at = reached[i];
        for (const TrianglePair& step : from[at.slave]) {
          if (known[step.slave] != 0) {
            if (turns) require_way(at.slave, step);
            continue;
          }
          known[step.slave] = 1;
          if (turns) align(at.slave, step);
          reached.push_back({root, step.slave, step.map.after(at.map)});
        }
      }
      pairs.insert(pairs.end(), reached.begin() + 1, reached.end());
    }
  }

  [[nodiscard]] bool runs_alike(const std::vector<Vec3>& image, const std::vector<Vec3>& trace) const {
    return norm(image.front() - trace.front()) <= result_.gap &&
           norm(trace_point(image, quarter) - trace_point(trace, quarter)) <= norm(trace_point(image, quarter) - trace_point(trace, 1 - quarter));
  }

  void require_way(int from, const TrianglePair& step) const {
    if (runs_alike(image_of(from, step.map), trace_of(step.slave))) return;
    throw InvalidPeriodicity("two chains of periodicities carry a line of the triangles onto itself, reversed or shifted, near " +
                       format_point(trace_of(step.slave).front()) + ": such a line cannot be divided");
  }

  void align(int from, const TrianglePair& step) {
    std::vector<std::int32_t>& chain = mesh_.curves[step.slave].vertices;
    const std::vector<Vec3> image = image_of(from, step.map);
    if (is_closed(step.slave)) {
      chain.pop_back();
      const auto apart = [&](std::int32_t v) { return norm(mesh_.vertices[v] - image.front()); };
      const auto first = std::ranges::min_element(chain, {}, apart);
      if (apart(*first) > result_.gap)
        throw InvalidPeriodicity("a closed line of the triangles has no vertex at the image " + format_point(image.front()) +
                           " of the first vertex of its periodic partner: the nearest is " + short_number(apart(*first)) + " away");
      std::rotate(chain.begin(), first, chain.end());
      chain.push_back(chain.front());
    }
    if (!runs_alike(image, trace_of(step.slave))) std::ranges::reverse(chain);
    require_way(from, step);
  }

  const Model& model_;
  const std::int32_t given_;  // vertices of the triangles that are given come first
  SurfaceMesh& mesh_;
  std::vector<std::set<int>> lines_of_;  // by face
  std::vector<BoxTree::Box> boxes_;      // by face
  std::vector<Isometry> maps_;           // that are given, and their inverses
  std::vector<TrianglePair> face_steps_, line_steps_;
  PeriodicTriangles result_;
};

}  // namespace

std::vector<std::int32_t> PeriodicTriangles::twins(std::size_t n) const {
  std::vector<std::int32_t> twin(n, -1);
  for (const TrianglePair& pair : lines) twin[pair.master] = twin[pair.slave] = pair.master;
  return twin;
}

PeriodicTriangles find_periodic_triangles(const Model& model, double diag, std::size_t given, SurfaceMesh& mesh) {
  if (model.periodicities.empty()) return {};
  return Finder(model, diag, given, mesh).run();
}

}  // namespace carreau
