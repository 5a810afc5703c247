// SPDX-License-Identifier: BSD-3-Clause
// Vertices of both sides of a narrow face at the same places.
#include <algorithm>
#include <cmath>
#include <map>

#include "surface/narrow/narrow_faces.h"
#include "surface/narrow/side_ruler.h"
#include "surface/narrow/thresholds.h"
#include "support/error.h"

namespace carreau {

namespace {

using namespace thresholds::narrow;

class SideMatcher {
 public:
  SideMatcher(const CurveModel& model, std::span<const NarrowFace> faces, std::vector<DiscreteCurve>& curves)
      : model_(model), faces_(faces), curves_(curves), placed_(curves.size(), 0), changed_(curves.size(), 0) {}

  void match_all() {
    for (const NarrowFace& narrow : faces_)
      if (!narrow.point) match(narrow);
  }

  // What one face inserts in a curve another one that has the curve must follow: there are no more rounds than faces in
  // a row. A vertex has one place at most on each curve: a curve with more than all vertices together takes images of
  // images, whose number may double in each round.
  std::vector<int> complete_all() {
    most_vertices_ = 0;
    for (const DiscreteCurve& curve : curves_) most_vertices_ += curve.r.size();
    for (std::size_t round = 0; round <= faces_.size() + 1; ++round) {
      bool any = false;
      for (const NarrowFace& narrow : faces_)
        if (!narrow.point) any |= complete(narrow);
      if (!any) break;
    }
    std::vector<int> changed;
    for (std::size_t c = 0; c < changed_.size(); ++c)
      if (changed_[c] != 0) changed.push_back(static_cast<int>(c));
    return changed;
  }

 private:
  using Fractions = std::map<int, std::vector<double>>;  // by curve

  struct Vertex {
    double s;
    Vec3 xyz;
  };

  [[nodiscard]] bool any_placed(const SideRuler& side) const {
    for (std::size_t p = 0; p < side.parts(); ++p)
      if (placed_[side.curve(p)] != 0) return true;
    return false;
  }

  // Corners between parts, and where a ring starts.
  static std::vector<Vertex> corners(const SideRuler& side, bool ring) {
    std::vector<Vertex> all;
    for (std::size_t p = ring ? 0 : 1; p < side.parts(); ++p)
      all.push_back({side.start(p), side.point_at(side.start(p))});
    return all;
  }
  [[nodiscard]] std::vector<Vertex> vertices(const SideRuler& side, bool ring) const {
    std::vector<Vertex> all = corners(side, ring);
    for (std::size_t p = 0; p < side.parts(); ++p) {
      const DiscreteCurve& d = curves_[side.curve(p)];
      for (std::size_t i = 1; i + 1 < d.r.size(); ++i) all.push_back({side.s_of(p, d.r[i]), d.xyz[i]});
    }
    return all;
  }

  static bool is_near(const std::vector<Vertex>& vertices, double s, double tolerance, double period) {
    return std::any_of(vertices.begin(), vertices.end(), [&](const Vertex& v) {
      return std::abs(period > 0 ? std::remainder(v.s - s, period) : v.s - s) <= tolerance;
    });
  }

  // Where `from` has vertices and `to` has not.
  static Fractions missing(const NarrowFace& narrow, const std::vector<Vertex>& from, const SideRuler& to,
                           const std::vector<Vertex>& there) {
    Fractions fractions;
    const double near = same_place_distance(narrow, to), period = narrow.ring ? to.length() : 0;
    for (const Vertex& vertex : from) {
      const SideRuler::Place place = to.place_of(vertex.xyz);
      const bool at_end = !narrow.ring && (place.s <= near || place.s >= to.length() - near);
      if (!at_end && place.r > 0 && place.r < 1 && !is_near(there, place.s, near, period))
        fractions[to.curve(place.part)].push_back(place.r);
    }
    for (auto& [curve, r] : fractions) {
      std::sort(r.begin(), r.end());
      r.erase(std::unique(r.begin(), r.end()), r.end());
    }
    return fractions;
  }

  void insert(const Fractions& fractions) {
    for (const auto& [curve, added] : fractions) {
      const std::vector<double>& r = curves_[curve].r;
      std::vector<double> inside(r.begin() + 1, r.end() - 1);
      inside.insert(inside.end(), added.begin(), added.end());
      place(curve, std::move(inside));
    }
  }
  void place(int curve, std::vector<double> inside) {
    std::sort(inside.begin(), inside.end());
    inside.erase(std::unique(inside.begin(), inside.end()), inside.end());
    place_vertices(curves_[curve], inside, model_);
    changed_[curve] = 1;
  }

  void match(const NarrowFace& narrow) {
    SideRuler leader(model_, narrow.face, narrow.side[0]), follower(model_, narrow.face, narrow.side[1]);
    if (any_placed(follower) && !any_placed(leader)) std::swap(leader, follower);
    const bool free = !any_placed(follower);
    const Fractions stations = missing(narrow, corners(follower, narrow.ring), leader, corners(leader, narrow.ring));
    if (any_placed(leader))
      insert(missing(narrow, corners(follower, narrow.ring), leader, vertices(leader, narrow.ring)));
    else
      for (const auto& [curve, r] : stations) redistribute(curve, r);
    if (free) {
      const Fractions carried =
          missing(narrow, vertices(leader, narrow.ring), follower, corners(follower, narrow.ring));
      for (std::size_t p = 0; p < follower.parts(); ++p) {
        const auto it = carried.find(follower.curve(p));
        place(follower.curve(p), it != carried.end() ? it->second : std::vector<double>{});
      }
    }
    for (const SideRuler* side : {&leader, &follower})
      for (std::size_t p = 0; p < side->parts(); ++p) placed_[side->curve(p)] = 1;
  }

  // A curve that must have vertices at some places gets as many edges between them as it had, of equal numbers.
  void redistribute(int curve, const std::vector<double>& stations) {
    const std::vector<double> r = curves_[curve].r;
    const auto index_of = [&](double at) {
      const auto k = static_cast<std::size_t>(std::upper_bound(r.begin() + 1, r.end() - 1, at) - r.begin());
      return static_cast<double>(k - 1) + (at - r[k - 1]) / (r[k] - r[k - 1]);
    };
    const auto fraction_of = [&](double index) {
      const auto k = std::min(static_cast<std::size_t>(index), r.size() - 2);
      return r[k] + (index - static_cast<double>(k)) * (r[k + 1] - r[k]);
    };
    std::vector<double> inside, ends = stations;
    ends.insert(ends.begin(), 0.0);
    ends.push_back(1);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const double from = index_of(ends[i]), to = index_of(ends[i + 1]);
      const int edges = std::max(1, static_cast<int>(std::lround(to - from)));
      for (int e = 1; e < edges; ++e) inside.push_back(fraction_of(from + (to - from) * e / edges));
      if (i + 2 < ends.size()) inside.push_back(ends[i + 1]);
    }
    place(curve, std::move(inside));
  }

  void check_count(const NarrowFace& narrow, const SideRuler& side) const {
    for (std::size_t p = 0; p < side.parts(); ++p)
      if (curves_[side.curve(p)].r.size() > most_vertices_)
        throw DomainError(Where{.face = model_.model.faces[static_cast<std::size_t>(narrow.face)].ref,
                                .curve = model_.curve(side.curve(p)).ref},
                          "the sides of the narrow face get more vertices without end: places along them disagree");
  }

  bool complete(const NarrowFace& narrow) {
    const SideRuler one(model_, narrow.face, narrow.side[0]), other(model_, narrow.face, narrow.side[1]);
    const Fractions in_other = missing(narrow, vertices(one, narrow.ring), other, vertices(other, narrow.ring));
    insert(in_other);
    check_count(narrow, other);
    const Fractions in_one = missing(narrow, vertices(other, narrow.ring), one, vertices(one, narrow.ring));
    insert(in_one);
    check_count(narrow, one);
    return !in_one.empty() || !in_other.empty();
  }

  const CurveModel& model_;
  std::span<const NarrowFace> faces_;
  std::vector<DiscreteCurve>& curves_;
  std::vector<char> placed_, changed_;  // by curve
  std::size_t most_vertices_ = 0;       // of one curve
};

}  // namespace

void match_sides(const CurveModel& model, std::span<const NarrowFace> faces, std::vector<DiscreteCurve>& curves) {
  SideMatcher matcher(model, faces, curves);
  matcher.match_all();
  matcher.complete_all();
}

std::vector<int> complete_sides(const CurveModel& model, std::span<const NarrowFace> faces,
                                std::vector<DiscreteCurve>& curves) {
  return SideMatcher(model, faces, curves).complete_all();
}

}  // namespace carreau
