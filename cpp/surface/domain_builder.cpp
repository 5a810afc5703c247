#include "surface/domain_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>

#include "plane/domain_check.h"
#include "support/error.h"

namespace carreau {

namespace {

// Ends of curves that are one point in space are one vertex of the domain when they are nearer than this share of the
// shortest edge beside them: exact corners differ by rounding, seam corners by whole sides. Where only two curves of
// the face end nothing else could be meant, however short their edges have become: then than this share of the curves.
constexpr double joining_share = 0.25;

struct CurveEnd {
  int corner;  // index in Topology::points
  Vec2 uv;
  double reach;  // length of the edge, or curve, that ends here, in shares of the domain's box
  int vertex;    // of the domain, once known
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
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c)
      if (vanishes(curve_of_[c])) {
        const std::vector<Vec2>& uv = curves_[curve_of_[c]].uv_of_use[use_of(c)];
        for (std::size_t i = 1; i < uv.size(); ++i) joining_reach_ += distance(uv[i], uv[i - 1]);
      }
    collect_sides();
    count_ends();
    if (turn && vanishes(curve_of_[seed_curve_ - 1])) choose_another_seed();
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

  // An angle beside a length in millionths of a model's unit: both count by what the whole domain has of them.
  void measure_box() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec2 low{infinity, infinity}, high{-infinity, -infinity};
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c)
      for (const Vec2 p : curves_[curve_of_[c]].uv_of_use[use_of(c)]) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    if (high.x > low.x) box_.x = high.x - low.x;
    if (high.y > low.y) box_.y = high.y - low.y;
  }
  [[nodiscard]] double distance(Vec2 p, Vec2 q) const noexcept {
    return std::hypot((p.x - q.x) / box_.x, (p.y - q.y) / box_.y);
  }

  // Where points of a loop are near a pole, ends that agree in space are far apart in (u, v).
  void count_ends() {
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c) {
      const Curve& shape = topology_.curves[curve_of_[c]];
      if (vanishes(curve_of_[c])) continue;
      for (const int corner : {shape.end1, shape.end2}) ends_at_[stand_in(corner)].push_back(c);
    }
  }
  [[nodiscard]] bool joins_two_curves(int corner) const {
    const std::vector<int>& ends = ends_at_.at(stand_in(corner));
    return ends.size() == 2 && ends[0] != ends[1];
  }

  // Ends at one corner that a degenerate side keeps apart are two vertices, whichever curve comes first: both ends of a
  // side of 1e-5 are near each other for the long curves beside it.
  void collect_sides() {
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c) {
      const Curve& shape = topology_.curves[curve_of_[c]];
      if (!shape.degenerate || vanishes(curve_of_[c])) continue;
      const std::vector<Vec2>& uv = curves_[curve_of_[c]].uv_of_use[use_of(c)];
      const double reach = std::min(distance(uv[1], uv[0]), distance(uv.back(), uv[uv.size() - 2]));
      const auto [side, first] = side_at_.try_emplace(shape.end1, reach);
      if (!first) side->second = std::min(side->second, reach);
    }
  }

  // How far ends at a corner may be apart in (u, v) to be one vertex.
  [[nodiscard]] double joining_distance(int corner, double reach) const {
    const auto side = side_at_.find(corner);
    if (side != side_at_.end()) reach = std::min(reach, side->second);
    return std::max(joining_share * reach, joining_reach_);
  }

  int join_end(int corner, Vec2 uv, double reach, const DomainVertexOrigin& origin, Sizes size) {
    for (CurveEnd& end : ends_) {
      if (stand_in(end.corner) != stand_in(corner)) continue;
      if (distance(end.uv, uv) > joining_distance(corner, std::min(end.reach, reach))) continue;
      end.reach = std::min(end.reach, reach);
      return end.vertex;
    }
    ends_.push_back({corner, uv, reach, add_vertex(uv, origin, size)});
    return ends_.back().vertex;
  }

  // The curve that gives the orientation is gone: another one tells, as it is turned in the whole domain.
  void choose_another_seed() {
    const VanishingCurves none;
    const PlaneDomain whole = Builder(model_, topology_, curves_, index_, none).run(true).plane;
    const PlaneDomain plain = collect_face_domain(model_, topology_, curves_, index_).plane;
    std::size_t edge = 0;
    for (int c = 0; c < static_cast<int>(face_.curves.size()); ++c) {
      const int curve = curve_of_[c];
      if (!vanishes(curve) && whole.edges[edge].kind != PlaneEdgeKind::internal) {
        seed_curve_ = c + 1;
        seed_left_of_curve_ =
            (whole.edges[edge].a == plain.edges[edge].a) != topology_.curves[curve].uses[use_of(c)].reversed;
        return;
      }
      edge += static_cast<std::size_t>(curves_[curve].segments());
    }
  }

  [[nodiscard]] bool vanishes(int curve) const { return !vanishing_.curve.empty() && vanishing_.curve[curve] != 0; }
  [[nodiscard]] int stand_in(int corner) const {
    return vanishing_.corner.empty() ? corner : vanishing_.corner[corner];
  }

  // A point that faces surround needs three triangles (HDR sec. 4.5.4): one of each face that has a mere corner there,
  // the others shared out among those that have a side there. At a border they are wanted where there is room.
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
    if (vanishes(curve)) return;
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
    double whole = 0;
    for (int i = 0; i < n; ++i) whole += distance(uv[i + 1], uv[i]);
    int previous = -1;
    for (int i = 0; i <= n; ++i) {
      int vertex;
      if (i == 0 || i == n) {
        const int corner = i == 0 ? shape.end1 : shape.end2;
        const double beside = i == 0 ? distance(uv[1], uv[0]) : distance(uv[n], uv[n - 1]);
        const double reach = joins_two_curves(corner) ? whole : beside;
        vertex = join_end(corner, uv[i], reach, {.curve = curve, .node = i, .corner = corner},
                          {discrete.size[i], discrete.physical[i]});
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
  Vec2 box_{1, 1};                           // sides of the domain's box; lengths in (u, v) are shares of them
  double joining_reach_ = 0;                 // length of the curves that vanish
  std::map<int, double> side_at_;            // by corner: length of the shortest end of a degenerate side there
  std::map<int, std::vector<int>> ends_at_;  // by corner: curves of the face that end there, twice where both ends do
  FaceDomain domain_;
  std::vector<CurveEnd> ends_;
  int seed_curve_;  // rank, from 1
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

}  // namespace carreau
