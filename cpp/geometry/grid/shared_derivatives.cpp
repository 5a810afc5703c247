// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/grid/shared_derivatives.h"

namespace carreau::grid {

std::size_t SharedDerivatives::number(const Slot& slot) {
  const std::uint64_t key = (static_cast<std::uint64_t>(slot.block) << 33U) |
                            (static_cast<std::uint64_t>(slot.node) << 1U) | (slot.along_u ? 1U : 0U);
  const auto [found, is_new] = known_.try_emplace(key, slots_.size());
  if (is_new) {
    parent_.push_back({slots_.size(), 1});
    slots_.push_back(slot);
    best_.emplace_back();
  }
  return found->second;
}

SharedDerivatives::Signed SharedDerivatives::find(std::size_t k) {
  Signed at{k, 1};
  while (parent_[at.root].root != at.root) {
    const Signed up = parent_[at.root];
    at = {up.root, at.sign * up.sign};
  }
  parent_[k] = at;
  return at;
}

void SharedDerivatives::unite(std::size_t a, std::size_t b, int sign) {
  const Signed p = find(a), q = find(b);
  if (p.root == q.root) return;
  const int between = sign * p.sign * q.sign;  // of the roots
  const std::size_t low = std::min(p.root, q.root), high = std::max(p.root, q.root);
  parent_[high] = {low, between};
  if (best_[high].rank < best_[low].rank) best_[low] = {best_[high].rank, between * best_[high].value};
}

void SharedDerivatives::offer(std::size_t a, Rank rank, const Vec3& value) {
  const Signed at = find(a);
  Best& best = best_[at.root];
  if (rank < best.rank) best = {rank, at.sign * value};
}

}  // namespace carreau::grid
