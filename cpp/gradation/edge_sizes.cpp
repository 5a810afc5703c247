#include "gradation/edge_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "support/segment.h"

namespace carreau {

namespace {

constexpr int leaf_size = 4;
// Halves of halves: more than any number of edges needs.
constexpr std::size_t deepest = 64;

double distance_to_box(const Vec3& p, const Vec3& low, const Vec3& high) noexcept {
  const auto beyond = [](double x, double from, double to) { return std::max({from - x, x - to, 0.}); };
  return norm(
      Vec3{beyond(p.x(), low.x(), high.x()), beyond(p.y(), low.y(), high.y()), beyond(p.z(), low.z(), high.z())});
}

}  // namespace

EdgeSizes::EdgeSizes(std::vector<Source> sources, double slope) : sources_(std::move(sources)), slope_(slope) {
  if (sources_.empty()) return;
  nodes_.push_back({{}, {}, 0, 0, static_cast<int>(sources_.size()), -1});
  for (int k = 0; k < static_cast<int>(nodes_.size()); ++k) build(k);
}

// The box of a node, and its halves along the box' longest side.
void EdgeSizes::build(int node) {
  Node n = nodes_[node];
  n.low = n.high = sources_[n.first].a, n.h = sources_[n.first].h;
  for (int k = n.first; k < n.end; ++k) {
    const Source& s = sources_[k];
    n.low = n.low.cwiseMin(s.a.cwiseMin(s.b)), n.high = n.high.cwiseMax(s.a.cwiseMax(s.b)), n.h = std::min(n.h, s.h);
  }
  if (n.end - n.first > leaf_size) {
    const Vec3 extent = n.high - n.low;
    const int axis = extent.x() >= extent.y() && extent.x() >= extent.z() ? 0 : extent.y() >= extent.z() ? 1 : 2;
    const int middle = (n.first + n.end) / 2;
    std::nth_element(
        sources_.begin() + n.first, sources_.begin() + middle, sources_.begin() + n.end,
        [axis](const Source& p, const Source& q) { return p.a[axis] + p.b[axis] < q.a[axis] + q.b[axis]; });
    n.children = static_cast<int>(nodes_.size());
    nodes_.push_back({{}, {}, 0, n.first, middle, -1});
    nodes_.push_back({{}, {}, 0, middle, n.end, -1});
  }
  nodes_[node] = n;
}

double EdgeSizes::at(const Vec3& p, double most) const noexcept {
  if (sources_.empty()) return most;
  std::array<int, deepest> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& n = nodes_[stack[--top]];
    if (n.h + slope_ * distance_to_box(p, n.low, n.high) >= most) continue;
    if (n.children < 0) {
      for (int k = n.first; k < n.end; ++k) {
        const Source& s = sources_[k];
        most = std::min(most, s.h + slope_ * distance_to_segment(p, s.a, s.b));
      }
      continue;
    }
    // The nearer half first: it may rule out the other one.
    const auto bound = [&](int k) { return nodes_[k].h + slope_ * distance_to_box(p, nodes_[k].low, nodes_[k].high); };
    const int near = bound(n.children) <= bound(n.children + 1) ? n.children : n.children + 1;
    stack[top++] = 2 * n.children + 1 - near;
    stack[top++] = near;
  }
  return most;
}

}  // namespace carreau
