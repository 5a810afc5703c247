// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/covering/clusters.h"

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

#include "atlas/covering/ring.h"
#include "atlas/covering/thresholds.h"
#include "atlas/pivots.h"
#include "support/angles.h"
#include "support/error.h"
#include "support/short_number.h"

namespace carreau::atlas {
namespace {

constexpr std::int32_t none = -1;

class Growth {
 public:
  Growth(const Triangulation& surface, const Fans& fans, int hops)
      : surface_(surface), fans_(fans), hops_(hops), cluster_(fans.size(), none) {}

  Partition grow() {
    choose_seeds();
    grow_cores();
    while (join_nearest()) {
    }
    join_rest();
    return cluster_;
  }

 private:
  [[nodiscard]] std::int32_t& of(std::int32_t v) { return cluster_[static_cast<std::size_t>(v)]; }
  [[nodiscard]] const Vec3& place(std::int32_t v) const { return surface_.vertices[static_cast<std::size_t>(v)]; }

  /// Visits vertices in the order of their distance in edges, which is at most `most`.
  template <typename Visit>
  void walk(std::int32_t from, int most, Visit&& visit) const {
    std::vector<std::int32_t> front{from};
    std::set<std::int32_t> seen{from};
    for (int d = 0; d <= most && !front.empty(); ++d) {
      std::vector<std::int32_t> next;
      for (const std::int32_t v : front) {
        visit(v, d);
        for (const std::int32_t w : fans_.around(v))
          if (seen.insert(w).second) next.push_back(w);
      }
      front = std::move(next);
    }
  }

  /// In the order of a walk from the first vertex, so that they are packed, each as far from the others as it must be.
  void choose_seeds() {
    const int apart = 2 * hops_;
    std::vector<char> taken(cluster_.size(), 0), seen(cluster_.size(), 0);
    for (std::size_t first = 0; first < cluster_.size(); ++first) {
      if (seen[first] != 0) continue;
      std::vector<std::int32_t> queue{static_cast<std::int32_t>(first)};
      seen[first] = 1;
      for (std::size_t i = 0; i < queue.size(); ++i) {
        const std::int32_t v = queue[i];
        if (taken[static_cast<std::size_t>(v)] == 0) {
          seeds_.push_back(v);
          walk(v, apart, [&](std::int32_t w, int) { taken[static_cast<std::size_t>(w)] = 1; });
        }
        for (const std::int32_t w : fans_.around(v))
          if (seen[static_cast<std::size_t>(w)] == 0) seen[static_cast<std::size_t>(w)] = 1, queue.push_back(w);
      }
    }
  }

  void grow_cores() {
    for (std::size_t s = 0; s < seeds_.size(); ++s) {
      of(seeds_[s]) = static_cast<std::int32_t>(s);
      for (const std::int32_t w : fans_.around(seeds_[s])) of(w) = static_cast<std::int32_t>(s);
    }
  }

  /// Returns whether the cluster stays a disc with v, and v is in a triangle of it. The neighbours of v in the cluster
  /// must follow one another.
  [[nodiscard]] bool may_join(std::int32_t v, std::int32_t cluster) {
    const auto& fan = fans_.around(v);
    std::size_t runs = 0, count = 0;
    for (std::size_t k = 0; k < fan.size(); ++k) {
      const bool here = of(fan[k]) == cluster, before = of(fan[(k + fan.size() - 1) % fan.size()]) == cluster;
      count += here, runs += here && !before;
    }
    return count >= 2 && runs == 1 && count < fan.size();
  }

  /// The free vertex that is nearest to the seed of a cluster beside it joins it.
  bool join_nearest() {
    std::vector<std::tuple<double, std::int32_t, std::int32_t>> offers;
    for (std::size_t i = 0; i < cluster_.size(); ++i) {
      if (cluster_[i] != none) continue;
      const auto v = static_cast<std::int32_t>(i);
      for (const std::int32_t w : fans_.around(v))
        if (of(w) != none && may_join(v, of(w)))
          offers.emplace_back(norm(place(v) - place(seeds_[static_cast<std::size_t>(of(w))])), v, of(w));
    }
    std::sort(offers.begin(), offers.end());
    bool any = false;
    for (const auto& [distance, v, cluster] : offers)
      if (of(v) == none && may_join(v, cluster)) of(v) = cluster, any = true;
    return any;
  }

  /// Vertices that no cluster takes as a disc join a neighbour, and defects() reports them.
  void join_rest() {
    for (bool any = true; any;) {
      any = false;
      for (std::size_t i = 0; i < cluster_.size(); ++i) {
        if (cluster_[i] != none) continue;
        for (const std::int32_t w : fans_.around(static_cast<std::int32_t>(i)))
          if (of(w) != none) {
            cluster_[i] = of(w), any = true;
            break;
          }
      }
    }
  }

  const Triangulation& surface_;
  const Fans& fans_;
  int hops_;
  Partition cluster_;
  std::vector<std::int32_t> seeds_;
};

}  // namespace

std::vector<std::vector<std::int32_t>> members_of(const Partition& partition) {
  std::vector<std::vector<std::int32_t>> members;
  for (std::size_t v = 0; v < partition.size(); ++v) {
    if (partition[v] < 0 || static_cast<std::size_t>(partition[v]) >= partition.size())
      throw InvalidArgument("the cluster of vertex " + std::to_string(v + 1) + " is " + std::to_string(partition[v]) +
                            "; clusters are numbered from 0, without gaps");
    if (members.size() <= static_cast<std::size_t>(partition[v]))
      members.resize(static_cast<std::size_t>(partition[v]) + 1);
    members[static_cast<std::size_t>(partition[v])].push_back(static_cast<std::int32_t>(v));
  }
  for (std::size_t c = 0; c < members.size(); ++c)
    if (members[c].empty())
      throw InvalidArgument("cluster " + std::to_string(c) +
                            " has no vertex; clusters are numbered from 0, without gaps");
  return members;
}

Partition grown_clusters(const Triangulation& surface, const Fans& fans, int hops) {
  return Growth(surface, fans, hops).grow();
}

namespace {

/// The least distance between both borders along rays from the centre to their vertices, as a share of the ray.
double min_width(const Polygon& inner, const Polygon& outer, const Vec2& centre) {
  const auto nearest = [&](const Polygon& border, const Vec2& ray) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < border.size(); ++i) {
      const Vec2 a = border[i] - centre, edge = border[next_of(i, border.size())] - border[i];
      const double determinant = cross(ray, edge), share = cross(a, ray) / determinant,
                   along = cross(a, edge) / determinant;
      if (determinant != 0 && share >= 0 && share <= 1 && along > 0) best = std::min(best, along);
    }
    return best;  // in units of the ray
  };
  double width = std::numeric_limits<double>::infinity();
  for (const Vec2& v : inner) width = std::min(width, nearest(outer, v - centre) - 1);
  for (const Vec2& v : outer) width = std::min(width, 1 - nearest(inner, v - centre));
  return width;
}

struct Defect {
  double badness = 0;
  std::string sentence = {};
};

Defect find_defect(const Triangulation& surface, const Fans& fans, const Partition& partition,
                   const std::vector<std::int32_t>& members) {
  Defect defect;
  const Ring ring = ring_of(fans, partition, members, defect.sentence);
  if (!defect.sentence.empty()) return {thresholds::no_disc, defect.sentence};
  const Frame frame = frame_of(surface, fans, members);
  const std::string cluster = "the cluster with vertex " + std::to_string(members.front() + 1);
  if (frame.min_cosine < angles::cosine_of_78)
    return {thresholds::steep + angles::cosine_of_78 - frame.min_cosine,
            cluster + " is far from its plane: the normal at vertex " + std::to_string(frame.steepest + 1) +
                " makes an angle of cosine " + short_number(frame.min_cosine) + " with the normal of the plane"};
  const auto projected = [&](const std::vector<std::int32_t>& border) {
    Polygon p;
    for (const std::int32_t v : border) p.push_back(frame.project(surface.vertices[static_cast<std::size_t>(v)]));
    return p;
  };
  try {
    const Polygon inner = projected(ring.inner_border), outer = projected(ring.outer_border);
    require_simple(inner, "the pure zone"), require_simple(outer, "the region"), require_annulus(inner, outer);
    // Not a defect, but a shape that distorts its chart: the sentence is empty.
    const StarCentre star = star_centre(inner);
    if (!star.found) return {thresholds::no_star, ""};
    const double room = std::min({star.room, room_around(outer, star.place), min_width(inner, outer, star.place)});
    return {thresholds::no_star * std::clamp(1 - room / thresholds::star_room, 0.0, 1.0), ""};
  } catch (const DomainError& error) {
    return {thresholds::folded, cluster + " does not project to its plane: " + error.what()};
  }
}

}  // namespace

std::string defect_of(const Triangulation& surface, const Fans& fans, const Partition& partition,
                      const std::vector<std::int32_t>& members) {
  return find_defect(surface, fans, partition, members).sentence;
}

double cluster_badness(const Triangulation& surface, const Fans& fans, const Partition& partition,
                       const std::vector<std::int32_t>& members) {
  return find_defect(surface, fans, partition, members).badness;
}

std::vector<std::string> defects(const Triangulation& surface, const Fans& fans, const Partition& partition) {
  std::vector<std::string> list;
  for (const auto& members : members_of(partition)) list.push_back(defect_of(surface, fans, partition, members));
  return list;
}

}  // namespace carreau::atlas
