// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/covering/ring.h"

#include <algorithm>

namespace carreau::atlas {
namespace {

std::string name(std::int32_t v) { return std::to_string(v + 1); }

class RingWalk {
 public:
  RingWalk(const Fans& fans, const std::vector<std::int32_t>& cluster, const std::vector<std::int32_t>& members)
      : fans_(fans), cluster_(cluster), members_(members), own_(of(members.front())) {}

  Ring walk(std::string& defect) {
    const std::size_t all = spokes_of_all(defect);
    if (!defect.empty()) return {};
    const Spoke first = ring_.spokes.front();
    for (Spoke at = first;;) {
      const std::int32_t c = fans_.left_of(at.inner, at.outer);
      at = of(c) == own_ ? Spoke{c, at.outer} : Spoke{at.inner, c};
      if (at.inner == first.inner && at.outer == first.outer) break;
      ring_.spokes.push_back(at);
      if (ring_.spokes.size() > all) break;
    }
    start_at_a_border_vertex();
    find_triples();
    borders(defect);
    if (defect.empty() && ring_.spokes.size() != all)
      defect = "the cluster with vertex " + name(own()) + " is not a disc: it has a hole";
    if (defect.empty() && ring_.triples.size() < 2)
      defect = "the cluster with vertex " + name(own()) + " has " + std::to_string(ring_.triples.size()) +
               " places where three clusters meet; it needs two";
    return std::move(ring_);
  }

 private:
  [[nodiscard]] std::int32_t of(std::int32_t v) const { return cluster_[static_cast<std::size_t>(v)]; }
  [[nodiscard]] std::int32_t own() const { return members_.front(); }

  /// Counts them, and checks whether each vertex of the cluster is in a triangle of the pure zone.
  std::size_t spokes_of_all(std::string& defect) {
    std::size_t count = 0;
    for (const std::int32_t v : members_) {
      const auto& fan = fans_.around(v);
      bool in_triangle = false;
      for (std::size_t k = 0; k < fan.size(); ++k) {
        const bool here = of(fan[k]) == own_, next = of(fan[(k + 1) % fan.size()]) == own_;
        in_triangle = in_triangle || (here && next);
        if (here) continue;
        ++count;
        if (ring_.spokes.empty()) ring_.spokes.push_back({v, fan[k]});
      }
      if (!in_triangle && defect.empty())
        defect = "vertex " + name(v) + " is in no triangle whose vertices are all of its cluster";
    }
    if (count == 0 && defect.empty()) defect = "the cluster with vertex " + name(own()) + " is the whole surface";
    return count;
  }

  /// So that the spokes of one vertex follow one another.
  void start_at_a_border_vertex() {
    auto& s = ring_.spokes;
    for (std::size_t k = 0; k < s.size(); ++k)
      if (s[k].inner != s[(k + s.size() - 1) % s.size()].inner) {
        std::rotate(s.begin(), s.begin() + static_cast<std::ptrdiff_t>(k), s.end());
        return;
      }
  }

  void find_triples() {
    const auto& s = ring_.spokes;
    ring_.triples.clear();
    for (std::size_t k = 0; k < s.size(); ++k)
      if (of(s[k].outer) != of(s[(k + 1) % s.size()].outer)) ring_.triples.push_back(k);
  }

  void borders(std::string& defect) {
    const auto& s = ring_.spokes;
    for (std::size_t k = 0; k < s.size(); ++k) {
      if (ring_.inner_border.empty() || s[k].inner != ring_.inner_border.back())
        ring_.inner_border.push_back(s[k].inner), ring_.first_spoke.push_back(k);
      if (s[k].outer != s[(k + s.size() - 1) % s.size()].outer) ring_.outer_border.push_back(s[k].outer);
    }
    require_once(ring_.inner_border, "the cluster", defect),
        require_once(ring_.outer_border, "the region of the cluster", defect);
  }

  void require_once(std::vector<std::int32_t> border, const std::string& what, std::string& defect) const {
    if (!defect.empty()) return;
    std::sort(border.begin(), border.end());
    const auto twice = std::adjacent_find(border.begin(), border.end());
    if (twice != border.end())
      defect =
          what + " with vertex " + name(own()) + " is not a disc: its border passes vertex " + name(*twice) + " twice";
    else if (border.size() < 3)
      defect = what + " with vertex " + name(own()) + " has a border of fewer than three vertices";
  }

  const Fans& fans_;
  const std::vector<std::int32_t>& cluster_;
  const std::vector<std::int32_t>& members_;
  std::int32_t own_;
  Ring ring_;
};

}  // namespace

Ring ring_of(const Fans& fans, const std::vector<std::int32_t>& cluster, const std::vector<std::int32_t>& members,
             std::string& defect) {
  return RingWalk(fans, cluster, members).walk(defect);
}

}  // namespace carreau::atlas
