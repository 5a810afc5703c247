// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/grid/parameters.h"

#include <algorithm>

#include "geometry/grid/thresholds.h"
#include "model/union_find.h"
#include "support/shares.h"

namespace carreau::grid {

namespace {

/// Numbers of all intervals of all blocks: first intervals between columns, then intervals between rows.
class Intervals {
 public:
  explicit Intervals(const std::vector<Block>& blocks) {
    for (const Block& block : blocks) {
      first_.push_back(count_);
      columns_.push_back(static_cast<std::size_t>(block.columns - 1));
      count_ += static_cast<std::size_t>(block.columns + block.rows - 2);
    }
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t of(std::size_t block, bool along_u, int interval) const {
    return first_[block] + (along_u ? 0 : columns_[block]) + static_cast<std::size_t>(interval);
  }

 private:
  std::vector<std::size_t> first_, columns_;
  std::size_t count_ = 0;
};

struct Sum {
  double length = 0;
  std::size_t edges = 0;
};

void add_edges(const Block& block, std::size_t b, const Intervals& intervals, UnionFind& same, std::vector<Sum>& sums) {
  const auto add = [&](bool along_u, int interval, const Vec3& p, const Vec3& q) {
    if (!is_finite(p) || !is_finite(q)) return;
    Sum& sum = sums[same.find(intervals.of(b, along_u, interval))];
    sum.length += norm(q - p), ++sum.edges;
  };
  for (int j = 0; j < block.rows; ++j)
    for (int i = 0; i < block.columns; ++i) {
      if (i + 1 < block.columns) add(true, i, block.node(i, j), block.node(i + 1, j));
      if (j + 1 < block.rows) add(false, j, block.node(i, j), block.node(i, j + 1));
    }
}

/// Length of each interval.
std::vector<double> mean_lengths(const std::vector<Block>& blocks, const Borders& borders, const Intervals& intervals) {
  UnionFind same(intervals.count());
  for (const auto& [ends, uses] : borders.edges)
    for (const EdgeUse& use : uses) {
      const auto number = [&](const EdgeUse& of) {
        const int block = borders.faces[static_cast<std::size_t>(of.face)].block;
        return intervals.of(static_cast<std::size_t>(block), of.edge.along_u(), of.edge.interval());
      };
      same.merge(number(uses.front()), number(use));
    }
  std::vector<Sum> sums(intervals.count());
  for (std::size_t b = 0; b < blocks.size(); ++b) add_edges(blocks[b], b, intervals, same, sums);
  Sum all;
  for (const Sum& sum : sums) all.length += sum.length, all.edges += sum.edges;
  const double least = shares::negligible * all.length / static_cast<double>(std::max<std::size_t>(1, all.edges));
  std::vector<double> lengths;
  for (std::size_t k = 0; k < intervals.count(); ++k) {
    const Sum& sum = sums[same.find(k)];
    lengths.push_back(std::max(least, sum.edges > 0 ? sum.length / static_cast<double>(sum.edges) : least));
  }
  return lengths;
}

}  // namespace

std::vector<Knots> find_knots(const std::vector<Block>& blocks, const Borders& borders, bool lengths) {
  const Intervals intervals(blocks);
  const std::vector<double> length =
      lengths ? mean_lengths(blocks, borders, intervals) : std::vector<double>(intervals.count(), 1.0);
  std::vector<Knots> knots(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto cumulate = [&](std::vector<double>& to, bool along_u, int nodes) {
      to.push_back(0);
      for (int k = 0; k + 1 < nodes; ++k) to.push_back(to.back() + length[intervals.of(b, along_u, k)]);
    };
    cumulate(knots[b].u, true, blocks[b].columns);
    cumulate(knots[b].v, false, blocks[b].rows);
  }
  return knots;
}

}  // namespace carreau::grid
