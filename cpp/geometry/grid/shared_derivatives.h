// SPDX-License-Identifier: BSD-3-Clause
// Derivatives at nodes that several blocks have in common.
#pragma once

#include <unordered_map>
#include <vector>

#include "geometry/grid/borders.h"
#include "geometry/grid/coons_surface.h"
#include "geometry/grid/parameters.h"

namespace carreau::grid {

/// Quality of a derivative at a node, the best first.
enum class Rank : char { inner, across, one_sided, none };

/// Sets of derivatives with regard to u or v at border nodes that are equal up to their signs.
class SharedDerivatives {
 public:
  struct Slot {
    int block;
    std::size_t node;
    bool along_u;
  };

  /// The number of a derivative, new or known.
  std::size_t number(const Slot& slot);
  /// a is sign times b.
  void unite(std::size_t a, std::size_t b, int sign);
  /// Offers a value for slot a; the best rank wins, and the first of equal ranks.
  void offer(std::size_t a, Rank rank, const Vec3& value);
  /// Forgets the values of other ranks.
  void keep(Rank rank) {
    for (Best& best : best_)
      if (best.rank != rank) best = {};
  }
  /// Calls set(slot, value) for every slot whose set has a value.
  template <typename Set>
  void for_values(Set&& set) {
    for (std::size_t k = 0; k < slots_.size(); ++k) {
      const auto [root, sign] = find(k);
      if (best_[root].rank != Rank::none) set(slots_[k], Vec3(sign * best_[root].value));
    }
  }

 private:
  struct Signed {
    std::size_t root;
    int sign;
  };
  struct Best {
    Rank rank = Rank::none;
    Vec3 value;
  };
  [[nodiscard]] Signed find(std::size_t k);

  std::vector<Slot> slots_;
  std::vector<Signed> parent_;
  std::vector<Best> best_;
  std::unordered_map<std::uint64_t, std::size_t> known_;
};

}  // namespace carreau::grid
