// SPDX-License-Identifier: BSD-3-Clause
#include "surface/domain/domain_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>

#include "support/error.h"
#include "support/format.h"
#include "support/infinity.h"
#include "support/shares.h"
#include "surface/domain/domain_check.h"
#include "surface/domain/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::domain;

/// Ends of curves that are one vertex of the domain.
struct Junction {
  int corner;  // index in Topology::points
  Vec2 uv;
  double reach;     // length of the shortest edge that ends here, in shares of the domain's box
  double length;    // of the shortest curve that ends here
  int degree = 0;   // ends of curves that bound the domain
  int vertex = -1;  // of the domain, once known
};

class Builder {
 public:
  Builder(const Model& model, const Topology& topology, std::span<const DiscreteCurve> curves, int face,
          const VanishingCurves& vanishing)
      : model_(model),
        face_(model.faces[face]),
        vanishing_(vanishing),
        curve_of_(topology.curve_of[face]),
        topology_(topology),
        curves_(curves),
        index_(face),
        seed_curve_(std::abs(face_.orientation)),
        seed_left_of_curve_(face_.orientation > 0) {}

  FaceDomain run(bool turn) {
    measure_box();
    choose_longest_part();
    find_points();
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c)
      if (is_vanishing(curve_of_[c])) {
        joining_reach_ += length_of(uv_of(c));
      }
    do {
      collect_sides();
      collect_junctions();
    } while (leave_out_spikes());
    if (turn && is_vanishing(curve_of_[seed_curve_ - 1])) choose_another_seed();
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c) add_curve(c);
    for (int p = 0; p < static_cast<int>(face_.points.size()); ++p) add_vertex(face_.points[p].uv, {.point = p}, {});
    if (turn) orient();
    return std::move(domain_);
  }

 private:
  struct Sizes {
    double prescribed = 0, physical = 0;
  };

  int add_vertex(Vec2 uv, const DomainVertexOrigin& origin, Sizes size) {
    domain_.plane.vertices.push_back(uv);
    domain_.origin.push_back(origin);
    domain_.size.push_back(size.prescribed);
    domain_.physical.push_back(size.physical);
    return static_cast<int>(domain_.plane.vertices.size()) - 1;
  }

  // Rank of this face-curve among the uses of its curve in space.
  int use_of(int c) const {
    const auto& uses = topology_.curves[curve_of_[c]].uses;
    const auto it =
        std::find_if(uses.begin(), uses.end(), [&](const CurveUse& u) { return u.face == index_ && u.curve == c; });
    return static_cast<int>(it - uses.begin());
  }

  [[nodiscard]] const std::vector<Vec2>& uv_of(int c) const { return curves_[curve_of_[c]].uv_of_use[use_of(c)]; }

  // Scales of u and v: both are measured relative to the domain. An angle may stand beside a length in millionths of a
  // model's unit.
  void measure_box() {
    Vec2 low{infinity, infinity}, high{-infinity, -infinity};
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c)
      for (const Vec2& p : uv_of(c)) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    if (high.x() > low.x()) box_.x() = high.x() - low.x();
    if (high.y() > low.y()) box_.y() = high.y() - low.y();
  }
  [[nodiscard]] double distance(const Vec2& p, const Vec2& q) const noexcept {
    return std::hypot((p.x() - q.x()) / box_.x(), (p.y() - q.y()) / box_.y());
  }

  [[nodiscard]] double length_of(std::span<const Vec2> uv) const noexcept {
    double length = 0;
    for (std::size_t i = 1; i < uv.size(); ++i) length += distance(uv[i], uv[i - 1]);
    return length;
  }

  // All parts of the curve that gives the orientation agree; a tiny part may have to go.
  void choose_longest_part() {
    const int whole = host_rank(face_, seed_curve_ - 1);
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c)
      if (host_rank(face_, c) == whole && length_of(uv_of(c)) > length_of(uv_of(seed_curve_ - 1))) seed_curve_ = c + 1;
  }

  // The curve that gives the orientation stays, whatever its size.
  void find_points() {
    is_point_.assign(face_.curves.size(), 0);
    std::map<int, double> reach;  // by corner: shortest edge of other curves
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c) {
      const Curve& shape = topology_.curves[curve_of_[c]];
      if (shape.degenerate) continue;
      const std::vector<Vec2>& uv = uv_of(c);
      const auto lower = [&](int corner, double length) {
        const auto [it, first] = reach.try_emplace(corner, length);
        if (!first) it->second = std::min(it->second, length);
      };
      lower(shape.end1, distance(uv[1], uv[0]));
      lower(shape.end2, distance(uv.back(), uv[uv.size() - 2]));
    }
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c) {
      const Curve& shape = topology_.curves[curve_of_[c]];
      const auto beside = reach.find(shape.end1);
      if (!shape.degenerate || shape.end1 != shape.end2 || beside == reach.end() || c + 1 == seed_curve_) continue;
      is_point_[c] = length_of(uv_of(c)) <= shares::negligible * beside->second;
    }
  }

  // Two ends at one corner that a degenerate side keeps apart are two vertices, whichever curve comes first. For the
  // long curves beside a side of 1e-5 both of its ends are near each other.
  void collect_sides() {
    side_at_.clear();
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c) {
      const Curve& shape = topology_.curves[curve_of_[c]];
      if (!shape.degenerate || is_left_out(c)) continue;
      const std::vector<Vec2>& uv = uv_of(c);
      const double reach = std::min(distance(uv[1], uv[0]), distance(uv.back(), uv[uv.size() - 2]));
      const auto [side, first] = side_at_.try_emplace(shape.end1, reach);
      if (!first) side->second = std::min(side->second, reach);
    }
  }

  // Largest distance in (u, v) of ends at a corner that are one vertex.
  [[nodiscard]] double joining_distance(int corner, double reach) const {
    const auto side = side_at_.find(corner);
    if (side != side_at_.end()) reach = std::min(reach, side->second);
    return std::max(joining_share * reach, joining_reach_);
  }

  int junction_at(int corner, Vec2 uv, double reach, double length) {
    for (int j = 0; j < static_cast<int>(junctions_.size()); ++j) {
      Junction& other = junctions_[j];
      if (stand_in(other.corner) != stand_in(corner)) continue;
      if (distance(other.uv, uv) > joining_distance(corner, std::min(other.reach, reach))) continue;
      other.reach = std::min(other.reach, reach);
      other.length = std::min(other.length, length);
      return j;
    }
    junctions_.push_back({corner, uv, reach, length});
    return static_cast<int>(junctions_.size()) - 1;
  }

  void collect_junctions() {
    junctions_.clear();
    junctions_of_curve_.assign(face_.curves.size(), {-1, -1});
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c) {
      if (is_left_out(c)) continue;
      const Curve& shape = topology_.curves[curve_of_[c]];
      const std::vector<Vec2>& uv = uv_of(c);
      const std::size_t n = uv.size() - 1;
      const double length = length_of(uv);
      junctions_of_curve_[c] = {junction_at(shape.end1, uv[0], distance(uv[1], uv[0]), length),
                                junction_at(shape.end2, uv[n], distance(uv[n], uv[n - 1]), length)};
      if (face_.curves[c].type == CurveType::internal) continue;
      for (const int j : junctions_of_curve_[c]) ++junctions_[j].degree;
    }
    close_loops();
  }

  // Leaves out short sides that are one point in space and close no loop. The host's tolerance is larger than such an
  // edge, so the ends of its neighbours ignore it. Returns whether there was one.
  bool leave_out_spikes() {
    const std::vector<char> before = is_point_;
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c) {
      if (is_left_out(c) || c + 1 == seed_curve_ || face_.curves[c].type == CurveType::internal) continue;
      const auto [i, j] = junctions_of_curve_[c];
      if (!topology_.curves[curve_of_[c]].degenerate || i == j) continue;
      if (junctions_[i].degree % 2 == 0 && junctions_[j].degree % 2 == 0) continue;
      is_point_[c] = length_of(uv_of(c)) <= joining_share * shortest_beside(c);
    }
    return is_point_ != before;
  }

  // Length of the shortest other curve that ends at the corner of a side; 0 if no other curve does.
  [[nodiscard]] double shortest_beside(int side) const {
    const auto corner_of = [this](int c) { return stand_in(topology_.curves[curve_of_[c]].end1); };
    double shortest = infinity;
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c) {
      const int far_end = stand_in(topology_.curves[curve_of_[c]].end2);
      if (c == side || is_left_out(c) || (corner_of(c) != corner_of(side) && far_end != corner_of(side))) continue;
      shortest = std::min(shortest, length_of(uv_of(c)));
    }
    return std::isfinite(shortest) ? shortest : 0;
  }

  // Two junctions of one corner at which an odd number of curves end were torn apart by a gap: nearest ones first.
  void close_loops() {
    for (;;) {
      double nearest = infinity;
      std::array<int, 2> pair{-1, -1};
      for (int i = 0; i < static_cast<int>(junctions_.size()); ++i)
        for (int j = i + 1; j < static_cast<int>(junctions_.size()); ++j) {
          const Junction &p = junctions_[i], &q = junctions_[j];
          if (p.degree % 2 == 0 || q.degree % 2 == 0 || stand_in(p.corner) != stand_in(q.corner)) continue;
          const double apart = distance(p.uv, q.uv);
          if (apart > joining_share * std::min(p.length, q.length) || apart >= nearest) continue;
          nearest = apart;
          pair = {i, j};
        }
      if (pair[0] < 0) return;
      junctions_[pair[0]].degree += junctions_[pair[1]].degree;
      junctions_[pair[1]].degree = 0;
      for (auto& ends : junctions_of_curve_)
        for (int& j : ends)
          if (j == pair[1]) j = pair[0];
    }
  }

  // Replaces the curve that gave the orientation and is gone. The new curve takes its direction from the whole domain.
  void choose_another_seed() {
    const VanishingCurves none;
    const PlaneDomain whole = Builder(model_, topology_, curves_, index_, none).run(true).plane;
    const PlaneDomain plain = collect_face_domain(model_, topology_, curves_, index_).plane;
    std::size_t edge = 0;
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c) {
      const int curve = curve_of_[c];
      if (is_point_[c] != 0) continue;
      if (!is_vanishing(curve) && whole.edges[edge].kind != PlaneEdgeKind::internal) {
        seed_curve_ = c + 1;
        seed_left_of_curve_ =
            (whole.edges[edge].a == plain.edges[edge].a) != topology_.curves[curve].uses[use_of(c)].reversed;
        return;
      }
      edge += static_cast<std::size_t>(curves_[curve].segments());
    }
  }

  [[nodiscard]] bool is_left_out(int c) const { return is_point_[c] != 0 || is_vanishing(curve_of_[c]); }
  [[nodiscard]] bool is_vanishing(int curve) const { return !vanishing_.curve.empty() && vanishing_.curve[curve] != 0; }
  [[nodiscard]] int stand_in(int corner) const {
    return vanishing_.corner.empty() ? corner : vanishing_.corner[corner];
  }

  // A point that faces surround needs three triangles (HDR sec. 4.5.4). Each face with a mere corner there has one
  // triangle; the faces with a side there share the rest. At a border there are three triangles if there is room.
  struct Fan {
    int least = 1, wide = 1;
  };
  [[nodiscard]] Fan fan_at(const Curve& apex) const {
    int sides = 0, ends = 0;
    bool bordered = false;
    for (const int c : topology_.points[apex.end1].curves) {
      const Curve& curve = topology_.curves[c];
      const int uses = static_cast<int>(curve.uses.size());
      if (curve.degenerate) {
        sides += uses;
        continue;
      }
      const CurveUse& use = curve.uses.front();
      if (model_.faces[use.face].curves[use.curve].type == CurveType::internal) continue;  // no border
      bordered = bordered || uses < 2;
      ends += uses * ((curve.end1 == apex.end1 ? 1 : 0) + (curve.end2 == apex.end1 ? 1 : 0));
    }
    const int corners = std::max(ends / 2 - sides, 0);  // each face has two ends of curves there
    const int share = std::max((3 - corners + sides - 1) / std::max(sides, 1), 1);
    return {bordered ? 1 : share, share};
  }

  void add_curve(int c) {
    const int curve = curve_of_[c];
    if (is_left_out(c)) return;
    const Curve& shape = topology_.curves[curve];
    const int use = use_of(c);
    const DiscreteCurve& discrete = curves_[curve];
    // In the direction of the first use, whatever this face's own direction is.
    const std::vector<Vec2>& uv = discrete.uv_of_use[use];
    const int n = static_cast<int>(uv.size()) - 1;
    // An internal curve that is one point in space bounds nothing.
    const PlaneEdgeKind kind = face_.curves[c].type == CurveType::internal ? PlaneEdgeKind::internal
                               : shape.degenerate                          ? PlaneEdgeKind::degenerate
                                                                           : PlaneEdgeKind::boundary;
    const Fan fan = shape.degenerate ? fan_at(shape) : Fan{};
    int previous = -1;
    for (int i = 0; i <= n; ++i) {
      int vertex;
      if (i == 0 || i == n) {
        const int corner = i == 0 ? shape.end1 : shape.end2;
        Junction& end = junctions_[junctions_of_curve_[c][i == 0 ? 0 : 1]];
        if (end.vertex < 0)
          end.vertex = add_vertex(uv[i], {.curve = curve, .node = i, .corner = corner},
                                  {discrete.size[i], discrete.physical[i]});
        vertex = end.vertex;
      } else {
        vertex = add_vertex(uv[i], {.curve = curve, .node = i}, {discrete.size[i], discrete.physical[i]});
      }
      if (i > 0) domain_.plane.edges.push_back({previous, vertex, kind, curve, i - 1, fan.least, fan.wide});
      if (i == 1 && c + 1 == seed_curve_) {
        seed_ = static_cast<int>(domain_.plane.edges.size()) - 1;
        // The sign of the orientation is for the face's own direction of the curve.
        seed_left_ = seed_left_of_curve_ != shape.uses[use].reversed;
      }
      previous = vertex;
    }
  }

  void orient() {
    const std::vector<std::string> defects = find_open_loops(
        domain_.plane, [this](const PlaneEdge& edge) { return curve_name(topology_, edge.curve, index_); });
    if (orient_loops(domain_.plane, seed_, seed_left_)) return;
    const Where where{.face = face_.ref, .curve_index = std::abs(face_.orientation)};
    if (!defects.empty()) throw DomainError(where, defects.front());
    if (const std::optional<EdgeConflict> crossing = find_a_crossing(domain_.plane))
      throw TurnedDomain(where, "the boundary crosses itself at (u, v) = (" + format_number(crossing->uv.x()) + ", " +
                                    format_number(crossing->uv.y()) +
                                    "), so that the side given by the orientation is not the inside of the domain");
    throw TurnedDomain(
        where,
        "the boundary is turned the wrong way: the side given by the orientation is not the inside of the domain");
  }

  const Model& model_;
  const Face& face_;
  const VanishingCurves& vanishing_;
  const std::vector<int>& curve_of_;
  const Topology& topology_;
  std::span<const DiscreteCurve> curves_;
  int index_;
  Vec2 box_{1, 1};                 // sides of the domain's box; lengths in (u, v) are shares of them
  double joining_reach_ = 0;       // length of the curves that vanish
  std::vector<char> is_point_;     // by rank: curves that are left out because they are one point in (u, v)
  std::map<int, double> side_at_;  // by corner: length of the shortest end of a degenerate side there
  FaceDomain domain_;
  std::vector<Junction> junctions_;
  std::vector<std::array<int, 2>> junctions_of_curve_;  // by rank: at its first and at its last end
  int seed_curve_;                                      // rank, from 1
  bool seed_left_of_curve_;
  int seed_ = 0;
  bool seed_left_ = true;
};

}  // namespace

std::string curve_name(const Topology& topology, int curve, int face) {
  std::string name = "curve ";
  for (const CurveUse& use : topology.curves[curve].uses)
    if (use.face == face) {
      name += std::to_string(use.curve + 1) + ' ';
      break;
    }
  return name + "(reference " + std::to_string(topology.curves[curve].ref) + ")";
}

FaceDomain build_face_domain(const Model& model, const Topology& topology, std::span<const DiscreteCurve> curves,
                             int face, const VanishingCurves& vanishing) {
  return Builder(model, topology, curves, face, vanishing).run(true);
}

FaceDomain collect_face_domain(const Model& model, const Topology& topology, std::span<const DiscreteCurve> curves,
                               int face) {
  const VanishingCurves none;
  return Builder(model, topology, curves, face, none).run(false);
}

std::vector<Vec3> positions_on_curves(const FaceDomain& domain, const std::vector<DiscreteCurve>& curves,
                                      const Topology& topology) {
  std::vector<Vec3> positions;
  for (const DomainVertexOrigin& origin : domain.origin) {
    if (origin.curve < 0) break;
    positions.push_back(origin.corner >= 0 ? topology.points[origin.corner].position
                                           : curves[origin.curve].xyz[origin.node]);
  }
  return positions;
}

}  // namespace carreau
