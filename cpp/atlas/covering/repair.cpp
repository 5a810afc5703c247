// SPDX-License-Identifier: BSD-3-Clause
// Moves of single vertices between clusters, until a covering is well formed.
#include <algorithm>
#include <set>

#include "atlas/covering/clusters.h"
#include "atlas/covering/thresholds.h"
#include "support/work_bounds.h"

namespace carreau::atlas {
namespace {

class Repair {
 public:
  Repair(const Triangulation& surface, const Fans& fans, Partition& partition)
      : surface_(surface), fans_(fans), partition_(partition), members_(members_of(partition)) {
    for (const auto& members : members_) bad_.push_back(badness(members));
  }

  void run() {
    for (int pass = 0; pass < work_bounds::passes; ++pass) {
      bool any = false;
      for (std::size_t c = 0; c < members_.size(); ++c)
        if (bad_[c] >= thresholds::steep || (bad_[c] > 0 && pass < thresholds::shape_passes)) any = better(c) || any;
      if (!any) return;
    }
  }

 private:
  [[nodiscard]] std::int32_t& of(std::int32_t v) { return partition_[static_cast<std::size_t>(v)]; }
  [[nodiscard]] double badness(const std::vector<std::int32_t>& members) const {
    return members.empty() ? thresholds::no_disc : cluster_badness(surface_, fans_, partition_, members);
  }

  /// Clusters whose rings hold a triangle of v.
  [[nodiscard]] std::set<std::int32_t> touched(std::int32_t v) {
    std::set<std::int32_t> list{of(v)};
    for (const std::int32_t w : fans_.around(v)) list.insert(of(w));
    return list;
  }

  void move(std::int32_t v, std::int32_t to) {
    auto& from = members_[static_cast<std::size_t>(of(v))];
    from.erase(std::find(from.begin(), from.end(), v));
    auto& there = members_[static_cast<std::size_t>(to)];
    there.insert(std::lower_bound(there.begin(), there.end(), v), v);
    of(v) = to;
  }

  [[nodiscard]] double sum(const std::set<std::int32_t>& clusters) const {
    double s = 0;
    for (const std::int32_t c : clusters) s += bad_[static_cast<std::size_t>(c)];
    return s;
  }

  void judge(const std::set<std::int32_t>& clusters) {
    for (const std::int32_t c : clusters)
      bad_[static_cast<std::size_t>(c)] = badness(members_[static_cast<std::size_t>(c)]);
  }

  /// Neighbours in the cluster: they must follow one another around the vertex, and be two or more; otherwise it is no
  /// disc.
  [[nodiscard]] bool joins_well(std::int32_t v, std::int32_t to) {
    const auto& fan = fans_.around(v);
    std::size_t runs = 0, count = 0;
    for (std::size_t k = 0; k < fan.size(); ++k) {
      const bool here = of(fan[k]) == to, before = of(fan[(k + fan.size() - 1) % fan.size()]) == to;
      count += here, runs += here && !before;
    }
    return count >= 2 && runs == 1;
  }

  /// Makes one improving move of a vertex in or beside the cluster, or of two neighbouring vertices to one cluster.
  bool better(std::size_t c) {
    std::set<std::int32_t> near(members_[c].begin(), members_[c].end());
    for (const std::int32_t m : members_[c]) near.insert(fans_.around(m).begin(), fans_.around(m).end());
    for (const std::int32_t v : near)
      for (const std::int32_t to : touched(v))
        if (to != of(v) && joins_well(v, to) && try_moves({v}, to)) return true;
    if (bad_[c] < thresholds::steep) return false;
    for (const std::int32_t v : near)
      for (const std::int32_t to : touched(v))
        for (const std::int32_t w : fans_.around(v))
          if (to != of(v) && to != of(w) && w > v && try_moves({v, w}, to)) return true;
    return false;
  }

  bool try_moves(const std::vector<std::int32_t>& list, std::int32_t to) {
    std::set<std::int32_t> clusters{to};
    std::vector<std::int32_t> from;
    for (const std::int32_t v : list) clusters.merge(touched(v)), from.push_back(of(v));
    const double before = sum(clusters);
    for (const std::int32_t v : list) move(v, to);
    judge(clusters);
    constexpr double min_gain = 1e-3;
    if (sum(clusters) < before - min_gain) return true;
    for (std::size_t i = 0; i < list.size(); ++i) move(list[i], from[i]);
    judge(clusters);
    return false;
  }

  const Triangulation& surface_;
  const Fans& fans_;
  Partition& partition_;
  std::vector<std::vector<std::int32_t>> members_;
  std::vector<double> bad_;
};

}  // namespace

void repair_clusters(const Triangulation& surface, const Fans& fans, Partition& partition) {
  Repair(surface, fans, partition).run();
}

}  // namespace carreau::atlas
