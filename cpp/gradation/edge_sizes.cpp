// SPDX-License-Identifier: BSD-3-Clause
#include "gradation/edge_sizes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/segment.h"

namespace carreau {

EdgeSizes::EdgeSizes(std::vector<Source> sources, double slope) : slope_(slope) {
  std::vector<BoxTree::Box> boxes(sources.size());
  std::vector<Vec3> centres;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    boxes[k].add(sources[k].a);
    boxes[k].add(sources[k].b);
    centres.push_back(sources[k].a + sources[k].b);
  }
  tree_ = BoxTree(boxes, centres);
  for (const std::int32_t k : tree_.order()) sources_.push_back(sources[static_cast<std::size_t>(k)]);
  least_.assign(tree_.nodes(), infinity);
  for (std::size_t n = tree_.nodes(); n-- > 0;) {
    const BoxTree::Node& node = tree_.node(n);
    for (std::int32_t k = node.first; k < node.first + node.count; ++k) least_[n] = std::min(least_[n], sources_[k].h);
    if (node.count == 0) least_[n] = std::min(least_[node.first], least_[node.first + 1]);
  }
}

double EdgeSizes::smallest() const noexcept { return sources_.empty() ? infinity : least_.front(); }

// With h = h(e) + s r: the integral of (2 pi r + 2 |e|) / h^2 for r up to the extent, over sqrt(3) / 4.
double EdgeSizes::triangles_within(double extent) const noexcept {
  double total = 0;
  for (const Source& e : sources_) {
    const double x = 1 + slope_ * extent / e.h;
    const double rings = 2 * std::numbers::pi / (slope_ * slope_) * (std::log(x) + 1 / x - 1);
    const double strips = 2 * norm(e.b - e.a) / (slope_ * e.h) * (1 - 1 / x);
    total += (rings + strips) / (std::numbers::sqrt3 / 4);
  }
  return total;
}

EdgeSizes EdgeSizes::bounded_below(double h) const {
  std::vector<Source> sources = sources_;
  for (Source& s : sources) s.h = std::max(s.h, h);
  return {std::move(sources), slope_};
}

double EdgeSizes::at(const Vec3& p, double most) const noexcept {
  tree_.nearest_first(
      [&](std::int32_t n) {
        return least_[n] + slope_ * std::sqrt(tree_.node(static_cast<std::size_t>(n)).box.squared_distance(p));
      },
      [&](double bound) { return bound < most; },
      [&](const BoxTree::Node& leaf) {
        for (std::int32_t k = leaf.first; k < leaf.first + leaf.count; ++k)
          most = std::min(most, sources_[k].h + slope_ * distance_to_segment(p, sources_[k].a, sources_[k].b));
      });
  return most;
}

}  // namespace carreau
