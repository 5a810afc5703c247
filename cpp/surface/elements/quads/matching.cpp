// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/quads/matching.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "predicates/clamped_int.h"
#include "support/work_sizes.h"
#include "surface/elements/quads/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::quads;

class Matching {
 public:
  Matching(std::size_t count, const std::vector<WeightedPair>& pairs, Monitor& monitor)
      : pairs_(pairs), monitor_(monitor), links_(count), chosen_(count, -1), on_path_(count, 0) {
    for (std::size_t e = 0; e < pairs.size(); ++e)
      for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
        auto link = links_[pairs[e].triangles[k]].begin();
        while (link->pair >= 0) ++link;
        *link = {static_cast<std::int32_t>(e), pairs[e].triangles[1 - k], pairs[e].weight};
      }
  }

  std::vector<std::int32_t> run() {
    choose_greedily();
    std::vector<std::int32_t> todo;
    for (std::size_t t = 0; t < chosen_.size(); ++t)
      if (!is_content(static_cast<std::int32_t>(t))) todo.push_back(static_cast<std::int32_t>(t));
    constexpr int max_rounds = 20;
    for (int round = 0; round < max_rounds && !todo.empty(); ++round) todo = improve(todo);
    std::vector<std::int32_t> result;
    for (std::size_t t = 0; t < chosen_.size(); ++t)
      if (chosen_[t] >= 0 && pairs_[chosen_[t]].triangles[0] == static_cast<std::int32_t>(t))
        result.push_back(chosen_[t]);
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  /// A pair as seen from one of its triangles; `pair` is -1 without a pair. The pairs of a triangle come first.
  struct Link {
    std::int32_t pair = -1, other = -1;
    double weight = 0;
  };
  /// Triangles in the order in which an alternating path or circle passes through them.
  struct Path {
    std::array<std::int32_t, longest_path + 2> triangle{};
    std::size_t size = 0;
    void push(std::int32_t t) noexcept { triangle[size++] = t; }
    void pop() noexcept { --size; }
  };

  [[nodiscard]] std::int32_t other(std::int32_t pair, std::int32_t t) const {
    const auto& both = pairs_[pair].triangles;
    return both[0] == t ? both[1] : both[0];
  }

  // Returns whether the pair has nearly the largest weight: paths that gain start elsewhere.
  [[nodiscard]] bool is_content(std::int32_t t) const {
    constexpr double content = 0.92;
    return chosen_[t] >= 0 && pairs_[chosen_[t]].weight > content * heaviest_;
  }

  // Sorts by classes of nearly equal weights; a class keeps the given order.
  [[nodiscard]] std::vector<std::int32_t> heaviest_first() const {
    static constexpr std::size_t weight_classes = 4096;
    const auto class_of = [&](const WeightedPair& pair) {
      return static_cast<std::size_t>(clamped_int((1 - pair.weight / heaviest_) * (weight_classes - 1),
                                                0, static_cast<int>(weight_classes) - 1));
    };
    std::vector<std::int32_t> start(weight_classes + 1, 0), order(pairs_.size());
    for (const WeightedPair& pair : pairs_) ++start[class_of(pair) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    for (std::size_t e = 0; e < pairs_.size(); ++e)
      order[static_cast<std::size_t>(start[class_of(pairs_[e])]++)] = static_cast<std::int32_t>(e);
    return order;
  }

  void choose_greedily() {
    for (const WeightedPair& pair : pairs_) heaviest_ = std::max(heaviest_, pair.weight);
    const std::vector<std::int32_t> order = heaviest_first();
    monitor_.checkpoint();
    for (const std::int32_t e : order) {
      const auto [t, u] = pairs_[e].triangles;
      if (chosen_[t] < 0 && chosen_[u] < 0) chosen_[t] = chosen_[u] = e;
    }
  }

  // Returns the triangles of changed pairs, and their neighbours.
  std::vector<std::int32_t> improve(const std::vector<std::int32_t>& todo) {
    std::vector<std::int32_t> changed;
    int n = 0;
    for (const std::int32_t t : todo) {
      if (++n % work_sizes::searches == 0) monitor_.checkpoint();
      if (is_content(t) || !search_from(t)) continue;
      for (std::size_t k = 0; k < best_path_.size; ++k) {
        changed.push_back(best_path_.triangle[k]);
        for (const Link& link : links_[best_path_.triangle[k]])
          if (link.pair >= 0) changed.push_back(link.other);
      }
    }
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    return changed;
  }

  // The best alternating path or circle from t, applied if it gains.
  bool search_from(std::int32_t t) {
    best_gain_ = 1e-9;  // more than rounding
    best_path_.size = path_.size = 0;
    path_.push(t);
    on_path_[t] = 1;
    if (chosen_[t] < 0) {
      add_pairs(t, 0);
    } else {
      const std::int32_t u = other(chosen_[t], t);
      step_along_chosen(u, -pairs_[chosen_[t]].weight);
      if (best_path_.size == 0) add_pairs_of_circle(t);
    }
    on_path_[t] = 0;
    if (best_path_.size == 0) return false;
    apply();
    return true;
  }

  // t is free, or has lost its pair: every pair that it is not in may be added.
  void add_pairs(std::int32_t t, double gain) {
    if (path_.size > longest_path) return;
    for (const Link& link : links_[t]) {
      if (link.pair < 0) break;
      const std::int32_t u = link.other;
      if (link.pair == chosen_[t] || on_path_[u] != 0) continue;
      const double now = gain + link.weight;
      path_.push(u);
      on_path_[u] = 1;
      if (chosen_[u] < 0)
        keep_if_best(now, false);
      else
        lose_pair(u, now);
      on_path_[u] = 0;
      path_.pop();
    }
  }

  void lose_pair(std::int32_t u, double gain) {
    const std::int32_t w = other(chosen_[u], u);
    const double now = gain - pairs_[chosen_[u]].weight;
    if (w == path_.triangle[0]) {
      if (path_.size % 2 == 0) keep_if_best(now, true);
      return;
    }
    if (on_path_[w] != 0) return;
    step_along_chosen(w, now);
  }

  // The end of a pair that goes: the path may end there, or go on.
  void step_along_chosen(std::int32_t w, double gain) {
    path_.push(w);
    on_path_[w] = 1;
    keep_if_best(gain, false);
    constexpr double max_loss = 2.5;  // of a path on its way
    if (gain > -max_loss) add_pairs(w, gain);
    on_path_[w] = 0;
    path_.pop();
  }

  // Circles: t takes a new pair, and loses its own at the end.
  void add_pairs_of_circle(std::int32_t t) { add_pairs(t, 0); }

  void keep_if_best(double gain, bool circle) {
    if (gain <= best_gain_) return;
    if (!circle && chosen_[path_.triangle[0]] >= 0 && starts_with_new_pair()) return;
    best_gain_ = gain;
    best_path_ = path_;
    best_is_circle_ = circle;
  }
  // Returns whether the path leaves its first triangle by a new pair: such a path is valid only if it closes.
  [[nodiscard]] bool starts_with_new_pair() const {
    const std::int32_t first = path_.triangle[0];
    return path_.size > 1 && other(chosen_[first], first) != path_.triangle[1];
  }

  void apply() {
    const std::size_t n = best_path_.size;
    const auto& path = best_path_.triangle;
    const bool drops_first = chosen_[path[0]] >= 0 && !best_is_circle_;
    if (drops_first) chosen_[path[0]] = -1;
    if (chosen_[path[n - 1]] >= 0 && !best_is_circle_ && (n % 2 == (drops_first ? 0U : 1U))) chosen_[path[n - 1]] = -1;
    for (std::size_t k = drops_first ? 1 : 0; k + 1 < n; k += 2)
      for (const Link& link : links_[path[k]])
        if (link.pair >= 0 && link.other == path[k + 1]) chosen_[path[k]] = chosen_[path[k + 1]] = link.pair;
  }

  const std::vector<WeightedPair>& pairs_;
  Monitor& monitor_;
  std::vector<std::array<Link, 3>> links_;  // by triangle
  std::vector<std::int32_t> chosen_;        // by triangle: its pair, or -1
  std::vector<char> on_path_;
  Path path_, best_path_;
  double best_gain_ = 0, heaviest_ = 0;
  bool best_is_circle_ = false;
};

}  // namespace

std::vector<std::int32_t> match(std::size_t count, const std::vector<WeightedPair>& pairs, Monitor& monitor) {
  return Matching(count, pairs, monitor).run();
}

}  // namespace carreau
