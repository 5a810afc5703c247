// SPDX-License-Identifier: BSD-3-Clause
// Matches the vertices of both sides of a narrow face.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "surface/narrow/narrow_faces.h"
#include "surface/narrow/side_ruler.h"
#include "surface/narrow/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::narrow;

/// Lengths along a side at which it has vertices.
class Places {
 public:
  /// `period` is the length of a ring, and 0 of a side with two ends.
  Places(std::vector<double> s, double period) : s_(std::move(s)), period_(period) { std::sort(s_.begin(), s_.end()); }

  [[nodiscard]] bool any_near(double s, double tolerance) const {
    if (s_.empty()) return false;
    const auto above = std::lower_bound(s_.begin(), s_.end(), s);
    const auto is_near = [&](double v) {
      return std::abs(period_ > 0 ? std::remainder(v - s, period_) : v - s) <= tolerance;
    };
    return (above != s_.end() && is_near(*above)) || (above != s_.begin() && is_near(*(above - 1))) ||
           (period_ > 0 && (is_near(s_.front()) || is_near(s_.back())));
  }

 private:
  std::vector<double> s_;
  double period_;
};

class SideMatcher {
 public:
  SideMatcher(const CurveModel& model, std::span<const NarrowFace> faces, std::vector<DiscreteCurve>& curves)
      : model_(model), faces_(faces), curves_(curves), placed_(curves.size(), 0), version_(curves.size(), 0),
        is_matched_(faces.size(), 1) {
    for (std::size_t i = 0; i < faces.size(); ++i)
      if (faces[i].point) is_matched_[i] = 0;
  }

  // A face whose sides exchange vertices without end is left out, and the others begin anew from the curves as given.
  SidesMatched run(bool from_the_start) {
    SidesMatched result;
    while (const std::optional<std::size_t> disagrees = match_all(from_the_start)) {
      is_matched_[*disagrees] = 0;
      result.unmatched.push_back(faces_[*disagrees].face);
      for (auto& [curve, given] : given_) curves_[curve] = std::move(given);
      given_.clear();
      std::fill(placed_.begin(), placed_.end(), 0);
    }
    std::sort(result.unmatched.begin(), result.unmatched.end());
    for (const auto& [curve, given] : given_) result.changed.push_back(curve);
    return result;
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

  // Places of the vertices of `from` where `to` has no vertex.
  static Fractions missing(const NarrowFace& narrow, const std::vector<Vertex>& from, const SideRuler& to,
                           const std::vector<Vertex>& there) {
    Fractions fractions;
    const double near = same_place_distance(narrow, to);
    std::vector<double> known;
    for (const Vertex& vertex : there) known.push_back(vertex.s);
    const Places places(std::move(known), narrow.ring ? to.length() : 0);
    for (const Vertex& vertex : from) {
      const SideRuler::Place place = to.place_of(vertex.xyz);
      const bool at_end = !narrow.ring && (place.s <= near || place.s >= to.length() - near);
      if (!at_end && place.r > 0 && place.r < 1 && !places.any_near(place.s, near))
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
    if (curves_[curve].indivisible || curves_[curve].prescribed) return;
    std::sort(inside.begin(), inside.end());
    inside.erase(std::unique(inside.begin(), inside.end()), inside.end());
    given_.try_emplace(curve, curves_[curve]);
    const std::vector<double> before = curves_[curve].r;
    place_vertices(curves_[curve], inside, model_);
    if (curves_[curve].r != before) ++version_[curve];
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

  // A vertex has one place at most on each curve. A curve with more vertices than all sides together copies images of
  // images, whose number may double in each round.
  [[nodiscard]] bool has_too_many(const SideRuler& side) const {
    for (std::size_t p = 0; p < side.parts(); ++p)
      if (curves_[side.curve(p)].r.size() > max_vertices_) return true;
    return false;
  }

  // False: a side has too many vertices.
  bool complete(const NarrowFace& narrow) {
    const SideRuler one(model_, narrow.face, narrow.side[0]), other(model_, narrow.face, narrow.side[1]);
    insert(missing(narrow, vertices(one, narrow.ring), other, vertices(other, narrow.ring)));
    if (has_too_many(other)) return false;
    insert(missing(narrow, vertices(other, narrow.ring), one, vertices(one, narrow.ring)));
    return !has_too_many(one);
  }

  [[nodiscard]] std::vector<int> curves_of(const NarrowFace& narrow) const {
    std::vector<int> curves;
    for (const Side& side : narrow.side)
      for (const SidePart& part : side) curves.push_back(model_.topology.curve_of[narrow.face][part.curve]);
    return curves;
  }

  // Returns the face whose places disagree, if any. If one face inserts vertices in a curve, other faces with that
  // curve must follow. A face that still inserts after as many rounds as there are faces in a row never ends. Faces
  // whose curves have not changed are passed over.
  std::optional<std::size_t> match_all(bool from_the_start) {
    std::vector<std::vector<int>> curves(faces_.size());
    std::set<int> all;
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (is_matched_[i] != 0) curves[i] = curves_of(faces_[i]), all.insert(curves[i].begin(), curves[i].end());
    max_vertices_ = 0;
    for (const int curve : all) max_vertices_ += curves_[curve].r.size();
    if (from_the_start)
      for (std::size_t i = 0; i < faces_.size(); ++i)
        if (is_matched_[i] != 0) match(faces_[i]);
    std::vector<std::int64_t> looked_at(faces_.size(), -1);
    std::optional<std::size_t> inserts;  // the first face that inserts a vertex in the last round
    for (std::size_t round = 0; round <= faces_.size() + 1; ++round) {
      inserts.reset();
      for (std::size_t i = 0; i < faces_.size(); ++i) {
        const std::int64_t version = version_of(curves[i]);
        if (is_matched_[i] == 0 || std::exchange(looked_at[i], version) == version) continue;
        if (!complete(faces_[i])) return i;
        if (!inserts && version_of(curves[i]) != version) inserts = i;
      }
      if (!inserts) break;
    }
    return inserts;
  }
  [[nodiscard]] std::int64_t version_of(std::span<const int> curves) const {
    std::int64_t version = 0;
    for (const int curve : curves) version += version_[curve];
    return version;
  }

  const CurveModel& model_;
  std::span<const NarrowFace> faces_;
  std::vector<DiscreteCurve>& curves_;
  std::vector<char> placed_;            // by curve
  std::vector<std::int64_t> version_;   // by curve: it grows with each change
  std::vector<char> is_matched_;        // by face
  std::map<int, DiscreteCurve> given_;  // curves that have changed, as they were given
  std::size_t max_vertices_ = 0;       // of one curve
};

}  // namespace

SidesMatched match_sides(const CurveModel& model, std::span<const NarrowFace> faces, std::vector<DiscreteCurve>& curves) {
  return SideMatcher(model, faces, curves).run(true);
}

SidesMatched complete_sides(const CurveModel& model, std::span<const NarrowFace> faces,
                            std::vector<DiscreteCurve>& curves) {
  return SideMatcher(model, faces, curves).run(false);
}

void leave_to_mesher(std::span<const int> faces, std::vector<NarrowFace>& strips) {
  std::erase_if(strips, [&](const NarrowFace& strip) { return std::binary_search(faces.begin(), faces.end(), strip.face); });
}

}  // namespace carreau
