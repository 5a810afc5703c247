// SPDX-License-Identifier: BSD-3-Clause
// Elements whose Jacobian is not positive: nodes inside their face move until it is.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "mesh/elements/jacobian.h"
#include "predicates/predicates.h"
#include "support/angles.h"
#include "support/error.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "surface/elements/base/curve_middles.h"
#include "surface/elements/base/invalid_report.h"
#include "surface/elements/base/mender.h"
#include "surface/elements/second_order/quadratic.h"
#include "surface/elements/base/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::elements;

/// A node with a place to test.
struct TriedNode {
  std::int32_t node;
  Vec2 uv;
  Vec3 xyz;
};

class FaceMender : public Mender<FaceMender, Vec2> {
 public:
  FaceMender(const ElementWork& work, std::size_t f, const std::vector<char>& fixed_mid,
             const std::vector<char>& fixed_vertex)
      : Mender(local_cells(work.result.mesh.faces[f]), static_cast<std::int32_t>(work.result.mesh.faces[f].uv.size()),
               static_cast<std::int32_t>(work.result.mesh.faces[f].uv.size() + work.result.mesh.faces[f].mid_uv.size()),
               joined(fixed_vertex, fixed_mid), work.monitor),
        work_(work),
        f_(f),
        face_(work.result.mesh.faces[f]) {}

  bool run(QuadraticReport& report) {
    report.crossed += find_below(good_jacobian);
    const bool all_good = bad().empty();
    mend();
    report.moved_nodes += moves();
    return all_good;
  }

  void tell_invalid(QuadraticReport& report) {
    (void)find_below(rounding_of::sizes);
    tell(report);
  }

  // If a mesh is turned over in (u, v) (FaceMesh::triangles) space alone decides.
  [[nodiscard]] double score(const Cell& cell) const {
    const auto [plane, space] = jacobians(cell);
    if (is_turned(cell)) return space.least();
    return std::min(space.least(), plane.min_along({0, 0, 1}));
  }
  [[nodiscard]] double bound(const Cell& cell) const {
    if (cell.kind != CellKind::triangle6) return -infinity;
    std::array<Vec2, 6> plane;
    std::array<Vec3, 6> space;
    for (std::size_t i = 0; i < 6; ++i) plane[i] = uv(cell.nodes[i]), space[i] = xyz(cell.nodes[i]);
    const double in_plane = min_of_triangle6(std::span<const Vec2>(plane));
    return std::min(in_plane, min_of_triangle6(std::span<const Vec3>(space)));
  }
  [[nodiscard]] double score_at(const Cell& cell, int corner) const {
    const auto [plane, space] = jacobians(cell);
    const std::size_t at = coefficient_at(cell.kind, corner);
    const Vec3 mean = space.mean();
    const double in_space = dot(space.c[at], mean) / dot(mean, mean);
    return is_turned(cell) ? in_space : std::min(in_space, plane.c[at].z() / plane.mean().z());
  }

  [[nodiscard]] std::array<double, 2> orientations(const Cell& cell) const {
    const std::array<std::int32_t, 8>& n = cell.nodes;
    const double first = orientation(uv(n[0]), uv(n[1]), uv(n[2]));
    return {first, corner_count(cell.kind) == 4 ? orientation(uv(n[0]), uv(n[2]), uv(n[3])) : first};
  }

  [[nodiscard]] std::array<Vec2, 8> ways(std::int32_t node, double step) const {
    const std::optional<ControlSpace>& space = work_.result.spaces[f_];
    const Metric2 metric = space ? space->at(uv(node)) : Metric2{};
    const UnitCircle circle(metric);
    const double by =
        step * reach(node, [&](std::int32_t a, std::int32_t b) { return length(metric, uv(b) - uv(a)); });
    std::array<Vec2, 8> all;
    for (int k = 0; k < 8; ++k) {
      const double angle = k * (std::acos(-1.0) / 4);
      all[k] = by * circle.vector({std::cos(angle), std::sin(angle)});
    }
    return all;
  }

  /// Empty outside the domain, or where the host has no answer.
  [[nodiscard]] std::vector<TriedNode> places(const std::vector<std::pair<std::int32_t, Vec2>>& moves) const {
    std::vector<TriedNode> trials;
    std::vector<Vec2> places;
    for (const auto& [node, by] : moves) {
      trials.push_back({node, uv(node) + by, {}});
      if (!is_inside(trials.back())) return {};
      places.push_back(trials.back().uv);
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

  [[nodiscard]] TriedNode trial_of(std::int32_t node) const { return {node, uv(node), xyz(node)}; }
  void put(const TriedNode& trial) {
    SurfaceMesh& mesh = work_.result.mesh;
    if (trial.node < corners()) {
      face_.uv[trial.node] = trial.uv;
      mesh.vertices[face_.vertex[trial.node]] = trial.xyz;
    } else {
      face_.mid_uv[trial.node - corners()] = trial.uv;
      mesh.mid_vertices[face_.mid_vertex[trial.node - corners()]] = trial.xyz;
    }
  }

 private:
  static std::vector<char> joined(std::vector<char> vertices, const std::vector<char>& mids) {
    vertices.insert(vertices.end(), mids.begin(), mids.end());
    return vertices;
  }
  [[nodiscard]] const Vec2& uv(std::int32_t node) const {
    return node < corners() ? face_.uv[node] : face_.mid_uv[node - corners()];
  }
  [[nodiscard]] const Vec3& xyz(std::int32_t node) const {
    const SurfaceMesh& mesh = work_.result.mesh;
    return node < corners() ? mesh.vertices[face_.vertex[node]] : mesh.mid_vertices[face_.mid_vertex[node - corners()]];
  }
  [[nodiscard]] std::pair<Jacobian, Jacobian> jacobians(const Cell& cell) const {
    const auto n = static_cast<std::size_t>(node_count(cell.kind));
    std::array<Vec3, 8> plane, space;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2& p = uv(cell.nodes[i]);
      plane[i] = {p.x(), p.y(), 0};
      space[i] = xyz(cell.nodes[i]);
    }
    return {jacobian(cell.kind, {plane.data(), n}), jacobian(cell.kind, {space.data(), n})};
  }
  [[nodiscard]] bool is_turned(const Cell& cell) const {
    return orientation(uv(cell.nodes[0]), uv(cell.nodes[1]), uv(cell.nodes[2])) <= 0;
  }

  // Hosts are evaluated inside the domain only: in the straight triangles around.
  [[nodiscard]] bool is_inside(const TriedNode& trial) const {
    const auto beside = around(trial.node);
    return std::any_of(beside.begin(), beside.end(), [&](std::int32_t c) {
      const std::array<std::int32_t, 8>& n = cells()[c].nodes;
      return holds(n[0], n[1], n[2], trial.uv) ||
             (corner_count(cells()[c].kind) == 4 && holds(n[0], n[2], n[3], trial.uv));
    });
  }
  [[nodiscard]] bool holds(std::int32_t a, std::int32_t b, std::int32_t c, const Vec2& p) const {
    return orientation(uv(a), uv(b), p) >= 0 && orientation(uv(b), uv(c), p) >= 0 && orientation(uv(c), uv(a), p) >= 0;
  }

  void tell(QuadraticReport& report) const {
    InvalidElements invalid{.face = f_, .count = 0, .uv = {}};
    double least = infinity;
    std::vector<CurveSide> sides;
    for (const std::int32_t c : bad()) {
      const double found = score(cells()[c]);
      if (invalid.count++ == 0) sides = curve_sides(work_, f_);
      if (found < least) least = found, invalid.uv = middle(cells()[c]);
      InvalidElement element{.face = f_};
      for (int i = 0; i < corner_count(cells()[c].kind); ++i)
        if (const CurveSide* side = side_at(cells()[c], i, sides)) element.coarse.push_back({side->curve, side->segment});
      add_cusps(cells()[c], sides, report.cusps);
      element.sides = finer_sides(work_.result.mesh, face_, cells()[c], work_.result.vertex_size, work_.options.element);
      report.elements.push_back(std::move(element));
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
  static const CurveSide* side_at(const Cell& cell, int i, const std::vector<CurveSide>& sides) {
    const int n = corner_count(cell.kind);
    const auto [a, b] = std::minmax(cell.nodes[i % n], cell.nodes[(i + 1) % n]);
    const auto at = std::lower_bound(sides.begin(), sides.end(), CurveSide{a, b, 0, 0, -1});
    return at != sides.end() && at->a == a && at->b == b ? &*at : nullptr;
  }
  // Adds cusps of elements whose validity depends on the nodes of two edges of curves alone.
  void add_cusps(const Cell& cell, const std::vector<CurveSide>& sides, std::vector<CuspEnd>& cusps) const {
    const int n = corner_count(cell.kind);
    for (int i = 0; i < n; ++i) {
      const CurveSide *from = side_at(cell, i + n - 1, sides), *to = side_at(cell, i, sides);
      if (from == nullptr || to == nullptr) continue;
      const std::int32_t corner = cell.nodes[i];
      const auto tangent = [&](int side, int end) -> Vec3 {
        return 4 * xyz(cell.nodes[n + side % n]) - 3 * xyz(corner) - xyz(cell.nodes[end % n]);
      };
      const Vec3 d = tangent(i + n - 1, i + n - 1), e = tangent(i, i + 1);
      if (!(dot(d, e) > 0) || norm(cross(d, e)) > angles::touching * dot(d, e)) continue;
      for (const CurveSide* side : {from, to}) {
        const auto& chain = work_.result.mesh.curves[side->curve].vertices;
        cusps.push_back({side->curve, side->segment, chain[side->segment] == face_.vertex[corner]});
      }
    }
  }

  const ElementWork& work_;
  std::size_t f_;
  FaceMesh& face_;
};

}  // namespace

bool mend_face(const ElementWork& work, std::size_t face, const std::vector<char>& fixed_mid,
               const std::vector<char>& fixed_vertex, QuadraticReport& report) {
  return FaceMender(work, face, fixed_mid, fixed_vertex).run(report);
}

void find_invalid(const ElementWork& work, std::size_t face, QuadraticReport& report) {
  FaceMender(work, face, {}, {}).tell_invalid(report);
}

}  // namespace carreau
