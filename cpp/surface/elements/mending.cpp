// SPDX-License-Identifier: BSD-3-Clause
// Elements whose Jacobian is not positive: nodes inside their face move until it is.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "mesh/elements/jacobian.h"
#include "predicates/predicates.h"
#include "support/error.h"
#include "support/infinity.h"
#include "surface/elements/curve_middles.h"
#include "surface/elements/quadratic.h"
#include "surface/elements/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::elements;

/// A node with a place that is tried.
struct Trial {
  std::int32_t node;
  Vec2 uv;
  Vec3 xyz;
};

class Mender {
 public:
  Mender(const ElementWork& work, std::size_t f, const std::vector<char>& fixed_mid,
         const std::vector<char>& fixed_vertex)
      : work_(work),
        f_(f),
        face_(work.result.mesh.faces[f]),
        corners_(static_cast<std::int32_t>(face_.uv.size())),
        fixed_(fixed_vertex),
        cells_(local_cells(face_)) {
    fixed_.insert(fixed_.end(), fixed_mid.begin(), fixed_mid.end());
  }

  void run(QuadraticReport& report) {
    find_bad(report);
    if (bad_.empty()) return;
    find_cells_of_nodes();
    for (int round = 0; round < most_rounds; ++round) {
      work_.monitor.checkpoint();
      const std::size_t before = moves_;
      for (std::size_t i = 0, n = bad_.size(); i < n; ++i) mend(cells_[bad_[i]]);
      std::erase_if(bad_, [&](std::int32_t c) { return score(cells_[c]) >= good_jacobian; });
      if (moves_ == before || bad_.empty()) break;
    }
    report.moved_nodes += moves_;
  }

  void tell_invalid(QuadraticReport& report) {
    for (std::size_t c = 0; c < cells_.size(); ++c)
      if (score(cells_[c]) < least_jacobian) bad_.push_back(static_cast<std::int32_t>(c));
    tell(report);
  }

 private:
  [[nodiscard]] const Vec2& uv(std::int32_t node) const {
    return node < corners_ ? face_.uv[node] : face_.mid_uv[node - corners_];
  }
  [[nodiscard]] const Vec3& xyz(std::int32_t node) const {
    const SurfaceMesh& mesh = work_.result.mesh;
    return node < corners_ ? mesh.vertices[face_.vertex[node]] : mesh.mid_vertices[face_.mid_vertex[node - corners_]];
  }
  void put(const Trial& trial) {
    SurfaceMesh& mesh = work_.result.mesh;
    if (trial.node < corners_) {
      face_.uv[trial.node] = trial.uv;
      mesh.vertices[face_.vertex[trial.node]] = trial.xyz;
    } else {
      face_.mid_uv[trial.node - corners_] = trial.uv;
      mesh.mid_vertices[face_.mid_vertex[trial.node - corners_]] = trial.xyz;
    }
  }

  // Of a mesh that is turned over in (u, v) (FaceMesh::triangles) space alone decides.
  [[nodiscard]] double score(const Cell& cell) const {
    const auto n = static_cast<std::size_t>(node_count(cell.kind));
    std::array<Vec3, 8> plane, space;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2& p = uv(cell.nodes[i]);
      plane[i] = {p.x(), p.y(), 0};
      space[i] = xyz(cell.nodes[i]);
    }
    const double in_space = jacobian(cell.kind, {space.data(), n}).least();
    if (is_turned(cell)) return in_space;
    return std::min(in_space, jacobian(cell.kind, {plane.data(), n}).least_along({0, 0, 1}));
  }
  [[nodiscard]] bool is_turned(const Cell& cell) const {
    return orientation(uv(cell.nodes[0]), uv(cell.nodes[1]), uv(cell.nodes[2])) <= 0;
  }

  void find_bad(QuadraticReport& report) {
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const double found = score(cells_[c]);
      if (found < good_jacobian) bad_.push_back(static_cast<std::int32_t>(c));
      if (found < least_jacobian) ++report.crossed;
    }
  }

  void find_cells_of_nodes() {
    first_.assign(static_cast<std::size_t>(corners_) + face_.mid_uv.size() + 1, 0);
    for (const Cell& cell : cells_)
      for (const std::int32_t node : cell.nodes)
        if (node >= 0) ++first_[node + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    of_node_.resize(static_cast<std::size_t>(first_.back()));
    std::vector<std::int32_t> next = first_;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (const std::int32_t node : cells_[c].nodes)
        if (node >= 0) of_node_[next[node]++] = static_cast<std::int32_t>(c);
  }
  [[nodiscard]] std::span<const std::int32_t> around(std::int32_t node) const {
    return std::span(of_node_).subspan(first_[node], first_[node + 1] - first_[node]);
  }

  [[nodiscard]] double worst(std::int32_t node) const {
    double least = good_jacobian;  // more is not wanted
    for (const std::int32_t c : around(node)) least = std::min(least, score(cells_[c]));
    return least;
  }

  void mend(const Cell& cell) {
    const int corners = corner_count(cell.kind), all = node_count(cell.kind);
    for (int i = corners; i < all && score(cell) < good_jacobian; ++i) search(cell.nodes[i]);
    for (int i = 0; i < corners && score(cell) < good_jacobian; ++i) search(cell.nodes[i]);
  }

  /// The other nodes of a cell's sides that end at corner `v`, and the nodes on them.
  template <typename Use>
  void for_sides(std::int32_t v, const Use& use) const {
    for (const std::int32_t c : around(v)) {
      const Cell& cell = cells_[c];
      const int n = corner_count(cell.kind);
      for (int i = 0; i < n; ++i) {
        const std::int32_t a = cell.nodes[i], b = cell.nodes[(i + 1) % n];
        if (a == v || b == v) use(a == v ? b : a, cell.nodes[n + i]);
      }
    }
  }

  // Half the longest side in the metric that ends at a corner, or that an edge's node halves.
  [[nodiscard]] double reach(std::int32_t node, const Metric2& metric) const {
    double longest = 0;
    if (node < corners_) {
      for_sides(node, [&](std::int32_t end, std::int32_t) {
        longest = std::max(longest, length(metric, uv(end) - uv(node)));
      });
      return longest;
    }
    for (const std::int32_t c : around(node)) {
      const Cell& cell = cells_[c];
      const int n = corner_count(cell.kind);
      for (int i = 0; i < n; ++i)
        if (cell.nodes[n + i] == node)
          longest = std::max(longest, length(metric, uv(cell.nodes[(i + 1) % n]) - uv(cell.nodes[i])));
    }
    return longest;
  }

  // Hosts are asked inside the domain only: in the straight triangles around.
  [[nodiscard]] bool is_inside(const Trial& trial) const {
    const auto cells = around(trial.node);
    return std::any_of(cells.begin(), cells.end(), [&](std::int32_t c) {
      const std::array<std::int32_t, 8>& n = cells_[c].nodes;
      return holds(n[0], n[1], n[2], trial.uv) ||
             (corner_count(cells_[c].kind) == 4 && holds(n[0], n[2], n[3], trial.uv));
    });
  }
  [[nodiscard]] bool holds(std::int32_t a, std::int32_t b, std::int32_t c, const Vec2& p) const {
    return orientation(uv(a), uv(b), p) >= 0 && orientation(uv(b), uv(c), p) >= 0 && orientation(uv(c), uv(a), p) >= 0;
  }

  /// The node, and, of a corner, the nodes on its sides, by half its way; empty outside the domain, or where the host
  /// has no answer.
  [[nodiscard]] std::vector<Trial> moved(std::int32_t node, const Vec2& by) const {
    std::vector<Trial> trials{{node, uv(node) + by, {}}};
    if (node < corners_)
      for_sides(node, [&](std::int32_t, std::int32_t mid) {
        const bool known = std::any_of(trials.begin(), trials.end(), [&](const Trial& t) { return t.node == mid; });
        if (!known && fixed_[mid] == 0) trials.push_back({mid, uv(mid) + 0.5 * by, {}});
      });
    std::vector<Vec2> places;
    for (const Trial& trial : trials) {
      if (!is_inside(trial)) return {};
      places.push_back(trial.uv);
    }
    std::vector<SurfaceJet> jets(places.size());
    try {
      work_.cad().surface(face_.ref, want_position, places, jets);
    } catch (const CallbackError&) {
      return {};
    }
    for (std::size_t i = 0; i < trials.size(); ++i) trials[i].xyz = jets[i].s;
    return trials;
  }

  // The triangles of the straight mesh stay as they are turned.
  [[nodiscard]] bool keeps_triangles(std::int32_t node, const std::vector<double>& before) const {
    std::size_t i = 0;
    for (const std::int32_t c : around(node)) {
      const std::array<double, 2> now = orientations(cells_[c]);
      for (const double side : now)
        if (side * before[i++] <= 0) return false;
    }
    return true;
  }
  [[nodiscard]] std::array<double, 2> orientations(const Cell& cell) const {
    const std::array<std::int32_t, 8>& n = cell.nodes;
    const double first = orientation(uv(n[0]), uv(n[1]), uv(n[2]));
    return {first, corner_count(cell.kind) == 4 ? orientation(uv(n[0]), uv(n[2]), uv(n[3])) : first};
  }

  /// Worst score around the node with `trials` in their places.
  double judge(const std::vector<Trial>& trials) {
    const std::int32_t node = trials.front().node;
    std::vector<Trial> back;
    std::vector<double> sides;
    for (const Trial& trial : trials) back.push_back({trial.node, uv(trial.node), xyz(trial.node)});
    for (const std::int32_t c : around(node))
      for (const double side : orientations(cells_[c])) sides.push_back(side);
    for (const Trial& trial : trials) put(trial);
    const double found = keeps_triangles(node, sides) ? worst(node) : -infinity;
    for (const Trial& trial : back) put(trial);
    return found;
  }

  // Pattern search: eight directions, halved steps.
  void search(std::int32_t node) {
    if (fixed_[node] != 0) return;
    double best = worst(node);
    const std::optional<ControlSpace>& space = work_.result.spaces[f_];
    for (double step = first_step; step >= last_step && best < good_jacobian;) {
      const Metric2 metric = space ? space->at(uv(node)) : Metric2{};
      const UnitCircle circle(metric);
      const double by = step * reach(node, metric);
      std::vector<Trial> chosen;
      for (int k = 0; k < 8; ++k) {
        const double angle = k * (std::acos(-1.0) / 4);
        const Vec2 way = by * circle.vector({std::cos(angle), std::sin(angle)});
        std::vector<Trial> trials = moved(node, way);
        if (trials.empty()) continue;
        const double found = judge(trials);
        if (found > best) best = found, chosen = std::move(trials);
      }
      if (chosen.empty()) {
        step /= 2;
        continue;
      }
      for (const Trial& trial : chosen) put(trial);
      ++moves_;
      note_bad(node);
    }
  }

  // What was good may be bad now, as long as something beside was worse.
  void note_bad(std::int32_t node) {
    for (const std::int32_t c : around(node))
      if (score(cells_[c]) < good_jacobian && std::find(bad_.begin(), bad_.end(), c) == bad_.end()) bad_.push_back(c);
  }

  void tell(QuadraticReport& report) const {
    InvalidElements invalid{.face = f_, .count = 0, .uv = {}};
    double least = infinity;
    std::vector<CurveSide> sides;
    for (const std::int32_t c : bad_) {
      const double found = score(cells_[c]);
      if (invalid.count++ == 0) sides = curve_sides(work_, f_);
      if (found < least) least = found, invalid.uv = middle(cells_[c]);
      add_coarse(cells_[c], sides, report.coarse);
      add_finer(cells_[c], report.finer[f_]);
      if (c < face_.quads) report.quads[f_].push_back(c);
    }
    std::sort(report.quads[f_].begin(), report.quads[f_].end());
    if (invalid.count > 0) report.invalid.push_back(invalid);
  }
  [[nodiscard]] Vec2 middle(const Cell& cell) const {
    const int n = corner_count(cell.kind);
    Vec2 sum{0, 0};
    for (int i = 0; i < n; ++i) sum += uv(cell.nodes[i]);
    return (1.0 / n) * sum;
  }
  void add_finer(const Cell& cell, std::vector<EdgeSizes::Source>& finer) const {
    const int n = corner_count(cell.kind);
    double longest = 0, least = infinity;
    for (int i = 0; i < n; ++i) {
      longest = std::max(longest, norm(xyz(cell.nodes[(i + 1) % n]) - xyz(cell.nodes[i])));
      const double size = work_.result.vertex_size[face_.vertex[cell.nodes[i]]];
      if (size > 0) least = std::min(least, size);
    }
    // Sizes are asked of the mesh that is cut, if one is.
    const double wanted = std::min(longest, least) * (has_quads_only(work_.options.element) ? 1 : 0.5);
    for (int i = 0; i < n; ++i) finer.push_back({xyz(cell.nodes[i]), xyz(cell.nodes[(i + 1) % n]), wanted});
  }
  static void add_coarse(const Cell& cell, const std::vector<CurveSide>& sides, std::vector<CurveEdge>& coarse) {
    const int n = corner_count(cell.kind);
    for (int i = 0; i < n; ++i) {
      const auto [a, b] = std::minmax(cell.nodes[i], cell.nodes[(i + 1) % n]);
      const auto at = std::lower_bound(sides.begin(), sides.end(), CurveSide{a, b, 0, 0, -1});
      if (at != sides.end() && at->a == a && at->b == b) coarse.push_back({at->curve, at->segment});
    }
  }

  const ElementWork& work_;
  std::size_t f_;
  FaceMesh& face_;
  std::int32_t corners_;
  std::vector<char> fixed_;  // by local node
  std::vector<Cell> cells_;
  std::vector<std::int32_t> bad_, first_, of_node_;
  std::size_t moves_ = 0;
};

}  // namespace

void mend_face(const ElementWork& work, std::size_t face, const std::vector<char>& fixed_mid,
               const std::vector<char>& fixed_vertex, QuadraticReport& report) {
  Mender(work, face, fixed_mid, fixed_vertex).run(report);
}

void find_invalid(const ElementWork& work, std::size_t face, QuadraticReport& report) {
  Mender(work, face, {}, {}).tell_invalid(report);
}

}  // namespace carreau
