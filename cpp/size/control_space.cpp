#include "size/control_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "predicates/polygon_locator.h"

namespace carreau {

namespace {

// Cells of the first grid along each side, and the deepest level of the tree (cells of 2^-20 of the box).
constexpr int first_level = 2, deepest_level = 20;
// Levels of the table that finds leaves.
constexpr int table_levels = 7;
constexpr std::size_t batch = 1024;
// A length of the whole box in any direction is at least this: metrics are clamped on degenerate sides (HDR
// sec. 4.5.4).
constexpr double least_box_length = 1e-2;
constexpr double least_definite = 1e-12;
// How far an extrapolated tensor may be from what is known beside it.
constexpr double most_extrapolation = 3;
// The weight that unknown corners must have at a point for its sample to tell about them.
constexpr double least_weight = 0.2;

constexpr std::int64_t side = std::int64_t{1} << deepest_level;
constexpr std::uint64_t key_of(std::int64_t i, std::int64_t j) {
  return static_cast<std::uint64_t>(j) << 32 | static_cast<std::uint64_t>(i);
}

}  // namespace

/// Nodes are addressed by integer coordinates on the finest grid, so that cells of any size share them exactly.
class ControlSpaceBuilder {
 public:
  ControlSpaceBuilder(const SampledDomain& domain, const MetricSampler& sampler, const ControlSpaceOptions& options,
                      Monitor& monitor)
      : domain_(domain),
        locator_(domain.vertices, domain.edges),
        sampler_(sampler),
        options_(options),
        monitor_(monitor) {}

  ControlSpace run() {
    find_box();
    first_grid();
    refine();
    balance();
    tie_hanging_nodes();
    sample_border();
    fill_unknown();
    tie_hanging_nodes();
    finish();
    return std::move(space_);
  }

 private:
  enum class State : std::uint8_t { unknown, known, extrapolated };
  struct Node {
    std::int64_t i, j;
    State state = State::unknown;
    bool inside = false;
  };
  struct TreeCell {
    std::int64_t i, j, size;
    std::int32_t child = -1;
    std::int32_t node[4];
    bool test = false;  // worth looking at more closely
    double error = 0;   // found when its parent was tested
  };

  void find_box() {
    Vec2 low = domain_.vertices.at(0), high = low;
    for (const auto& [a, b] : domain_.edges)
      for (const Vec2 p : {domain_.vertices[a], domain_.vertices[b]}) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    low_ = low, high_ = high;
    width_ = high - low;
    if (!(width_.x > 0) || !(width_.y > 0)) throw DomainError("the parameter domain has no area");
  }

  [[nodiscard]] Vec2 place(std::int64_t i, std::int64_t j) const {
    // Exact at the box's own sides, where hosts are often defined just so far.
    const double x = static_cast<double>(i) / static_cast<double>(side),
                 y = static_cast<double>(j) / static_cast<double>(side);
    return {i == side ? high_.x : low_.x + x * width_.x, j == side ? high_.y : low_.y + y * width_.y};
  }

  std::int32_t node(std::int64_t i, std::int64_t j) {
    const auto [it, added] = node_of_.try_emplace(key_of(i, j), static_cast<std::int32_t>(nodes_.size()));
    if (added) {
      nodes_.push_back({i, j});
      values_.push_back({});
      nodes_.back().inside = locator_.contains(place(i, j));
      if (nodes_.back().inside) waiting_.push_back(it->second);
    }
    return it->second;
  }

  std::int32_t add_cell(std::int64_t i, std::int64_t j, std::int64_t size) {
    const std::int32_t n00 = node(i, j), n10 = node(i + size, j), n01 = node(i, j + size),
                       n11 = node(i + size, j + size);
    cells_.push_back({i, j, size, -1, {n00, n10, n01, n11}});
    return static_cast<std::int32_t>(cells_.size()) - 1;
  }

  [[nodiscard]] Metric2 clamped(Metric2 m) const {
    const double least = least_box_length * least_box_length;
    m.a = std::max(m.a, least / (width_.x * width_.x));
    m.c = std::max(m.c, least / (width_.y * width_.y));
    const double most = std::sqrt(m.a * m.c * (1 - least_definite));
    m.b = std::clamp(m.b, -most, most);
    return m;
  }

  // Calls the sampler for the nodes that wait, in order.
  void sample_waiting() {
    std::vector<Vec2> uv;
    std::vector<Metric2> metric;
    for (std::size_t start = 0; start < waiting_.size(); start += batch) {
      monitor_.checkpoint();
      const std::size_t n = std::min(batch, waiting_.size() - start);
      uv.clear();
      for (std::size_t k = 0; k < n; ++k)
        uv.push_back(place(nodes_[waiting_[start + k]].i, nodes_[waiting_[start + k]].j));
      metric.resize(n);
      sampler_(uv, metric);
      for (std::size_t k = 0; k < n; ++k) {
        values_[waiting_[start + k]] = clamped(metric[k]);
        nodes_[waiting_[start + k]].state = State::known;
      }
      space_.samples_ += n;
    }
    waiting_.clear();
  }

  void first_grid() {
    const std::int64_t n = std::int64_t{1} << first_level, size = side / n;
    for (std::int64_t j = 0; j < n; ++j)
      for (std::int64_t i = 0; i < n; ++i) cells_[add_cell(i * size, j * size, size)].test = true;
    roots_ = cells_.size();
    sample_waiting();
  }

  void split(std::int32_t cell) {
    const TreeCell c = cells_[cell];
    const std::int64_t half = c.size / 2;
    const std::int32_t first = add_cell(c.i, c.j, half);
    add_cell(c.i + half, c.j, half);
    add_cell(c.i, c.j + half, half);
    add_cell(c.i + half, c.j + half, half);
    cells_[cell].child = first;
    cells_[cell].test = false;
  }

  // Largest relative difference of a squared length between both tensors.
  static double difference(Metric2 m, Metric2 truth) {
    const double det = determinant(truth);
    // Eigenvalues of truth^-1 m.
    const double trace = (truth.c * m.a - 2 * truth.b * m.b + truth.a * m.c) / det, product = determinant(m) / det;
    const double root = std::sqrt(std::max(0.25 * trace * trace - product, 0.0));
    return std::max(std::abs(0.5 * trace + root - 1), std::abs(0.5 * trace - root - 1));
  }

  // What interpolation in a split cell was wrong by, at the five nodes that its children added.
  double error_of(const TreeCell& c) const {
    const auto v = [&](std::int32_t n) -> const Metric2& { return values_[n]; };
    const auto known = [&](std::int32_t n) { return nodes_[n].state == State::known; };
    double worst = 0;
    const auto compare = [&](std::int32_t middle, std::initializer_list<std::int32_t> ends) {
      if (!known(middle)) return;
      Metric2 sum{0, 0, 0};
      for (const std::int32_t e : ends) {
        if (!known(e)) return;
        sum = sum + v(e);
      }
      worst = std::max(worst, difference((1.0 / static_cast<double>(ends.size())) * sum, v(middle)));
    };
    const TreeCell* k = &cells_[c.child];
    compare(k[0].node[1], {c.node[0], c.node[1]});
    compare(k[0].node[2], {c.node[0], c.node[2]});
    compare(k[1].node[3], {c.node[1], c.node[3]});
    compare(k[2].node[3], {c.node[2], c.node[3]});
    compare(k[0].node[3], {c.node[0], c.node[1], c.node[2], c.node[3]});
    return worst;
  }

  // Number of unit triangles, from the leaves as they are.
  double measure() const {
    double area = 0;
    for (const TreeCell& c : cells_) {
      if (c.child >= 0) continue;
      Metric2 sum{0, 0, 0};
      int known = 0;
      for (const std::int32_t n : c.node)
        if (nodes_[n].state != State::unknown) sum = sum + values_[n], ++known;
      if (known == 0) continue;
      int inside = 0;
      for (int k = 0; k < 4; ++k)
        inside += locator_.contains(place(c.i + (1 + 2 * (k % 2)) * c.size / 4, c.j + (1 + 2 * (k / 2)) * c.size / 4))
                      ? 1
                      : 0;
      const double share = static_cast<double>(c.size) / static_cast<double>(side);
      area += 0.25 * inside * share * share * std::sqrt(std::max(determinant((1.0 / known) * sum), 0.0));
    }
    return area * width_.x * width_.y / (0.25 * std::numbers::sqrt3);
  }

  // Level by level: cells that are worth it are split, which samples the middles of their sides and their centre; what
  // these say about the parent's interpolation tells whether the children are worth it, which are 4 times more
  // accurate.
  void refine() {
    std::vector<std::int32_t> level(roots_);
    for (std::size_t c = 0; c < roots_; ++c) level[c] = static_cast<std::int32_t>(c);
    for (int depth = first_level; depth < deepest_level && !level.empty(); ++depth) {
      const double vertices = 0.5 * measure();
      const double budget =
          std::min(std::max(options_.samples_per_vertex * vertices, static_cast<double>(options_.min_samples)),
                   static_cast<double>(options_.max_samples));
      const double left = budget - static_cast<double>(space_.samples_);
      // Splitting a cell adds about three nodes.
      const auto affordable = static_cast<std::size_t>(std::max(left / 3, 0.0));
      if (depth > first_level && level.size() > affordable) {
        std::stable_sort(level.begin(), level.end(),
                         [this](std::int32_t p, std::int32_t q) { return cells_[p].error > cells_[q].error; });
        level.resize(affordable);
        std::sort(level.begin(), level.end());
      }
      for (const std::int32_t c : level) split(c);
      sample_waiting();
      std::vector<std::int32_t> next;
      for (const std::int32_t c : level) {
        const double error = error_of(cells_[c]);
        const std::int32_t first = cells_[c].child;
        for (std::int32_t k = first; k < first + 4; ++k) {
          // The error of the children is a quarter of what was found, where the field is smooth.
          cells_[k].error = error / 4;
          if (error / 4 > options_.tolerance && touches_domain(cells_[k])) next.push_back(k);
        }
      }
      level.swap(next);
    }
  }

  [[nodiscard]] bool touches_domain(const TreeCell& c) const {
    for (const std::int32_t n : c.node)
      if (nodes_[n].inside) return true;
    return false;
  }

  // A leaf beside leaves of half its size at most: then a node hangs on one coarse side at most.
  void balance() {
    for (bool changed = true; changed;) {
      changed = false;
      monitor_.checkpoint();
      const std::size_t count = cells_.size();
      for (std::size_t c = 0; c < count; ++c) {
        const TreeCell cell = cells_[c];
        if (cell.child >= 0 || cell.size < 4) continue;
        const std::int64_t quarter = cell.size / 4;
        bool fine = false;
        for (const std::int64_t k : {quarter, 3 * quarter}) {
          fine = fine || is_node(cell.i + k, cell.j) || is_node(cell.i + k, cell.j + cell.size) ||
                 is_node(cell.i, cell.j + k) || is_node(cell.i + cell.size, cell.j + k);
        }
        if (!fine) continue;
        split(static_cast<std::int32_t>(c));
        changed = true;
      }
      sample_waiting();
    }
  }

  [[nodiscard]] bool is_node(std::int64_t i, std::int64_t j) const { return node_of_.contains(key_of(i, j)); }
  [[nodiscard]] std::int32_t find_node(std::int64_t i, std::int64_t j) const {
    const auto it = node_of_.find(key_of(i, j));
    return it == node_of_.end() ? -1 : it->second;
  }

  // A node in the middle of a leaf's side takes the mean of the side's ends: the field is continuous.
  void tie_hanging_nodes() {
    // From coarse to fine: an end of a side may itself hang on a coarser one.
    std::vector<std::int32_t> leaves;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      if (cells_[c].child < 0 && cells_[c].size > 1) leaves.push_back(static_cast<std::int32_t>(c));
    std::stable_sort(leaves.begin(), leaves.end(),
                     [this](std::int32_t p, std::int32_t q) { return cells_[p].size > cells_[q].size; });
    for (const std::int32_t l : leaves) {
      const TreeCell& c = cells_[l];
      const std::int64_t half = c.size / 2;
      const auto tie = [&](std::int64_t i, std::int64_t j, std::int32_t p, std::int32_t q) {
        const std::int32_t n = find_node(i, j);
        if (n < 0 || nodes_[p].state == State::unknown || nodes_[q].state == State::unknown) return;
        values_[n] = 0.5 * (values_[p] + values_[q]);
        if (nodes_[n].state == State::unknown) nodes_[n].state = State::extrapolated;
      };
      tie(c.i + half, c.j, c.node[0], c.node[1]);
      tie(c.i + half, c.j + c.size, c.node[2], c.node[3]);
      tie(c.i, c.j + half, c.node[0], c.node[2]);
      tie(c.i + c.size, c.j + half, c.node[1], c.node[3]);
    }
  }

  std::int32_t leaf_at(Vec2 p) const {
    const double x = std::clamp((p.x - low_.x) / width_.x, 0.0, 1.0),
                 y = std::clamp((p.y - low_.y) / width_.y, 0.0, 1.0);
    const std::int64_t i = std::min(static_cast<std::int64_t>(x * static_cast<double>(side)), side - 1);
    const std::int64_t j = std::min(static_cast<std::int64_t>(y * static_cast<double>(side)), side - 1);
    const std::int64_t n = std::int64_t{1} << first_level, size = side / n;
    auto cell = static_cast<std::int32_t>((j / size) * n + i / size);
    while (cells_[cell].child >= 0) {
      const TreeCell& c = cells_[cell];
      cell = c.child + (i >= c.i + c.size / 2 ? 1 : 0) + (j >= c.j + c.size / 2 ? 2 : 0);
    }
    return cell;
  }

  // One boundary vertex in each leaf that the boundary cuts tells what its outer corners would have to be.
  void sample_border() {
    struct Probe {
      std::int32_t leaf;
      Vec2 uv;
    };
    std::vector<Probe> probes;
    std::vector<char> probed(cells_.size(), 0);
    for (const auto& [a, b] : domain_.edges) {
      const Vec2 p = domain_.vertices[a];
      const std::int32_t leaf = leaf_at(p);
      const TreeCell& c = cells_[leaf];
      if (probed[leaf] != 0 || unknown_weight(c, p) < least_weight) continue;
      probed[leaf] = 1;
      probes.push_back({leaf, p});
    }
    std::vector<Metric2> sum(nodes_.size(), Metric2{0, 0, 0});
    std::vector<int> votes(nodes_.size(), 0);
    std::vector<Vec2> uv;
    std::vector<Metric2> metric;
    for (std::size_t start = 0; start < probes.size(); start += batch) {
      monitor_.checkpoint();
      const std::size_t n = std::min(batch, probes.size() - start);
      uv.clear();
      for (std::size_t k = 0; k < n; ++k) uv.push_back(probes[start + k].uv);
      metric.resize(n);
      sampler_(uv, metric);
      space_.samples_ += n;
      for (std::size_t k = 0; k < n; ++k) {
        const TreeCell& c = cells_[probes[start + k].leaf];
        const Metric2 truth = clamped(metric[k]);
        Metric2 rest = truth;
        const auto w = weights(c, uv[k]);
        for (int q = 0; q < 4; ++q)
          if (nodes_[c.node[q]].state != State::unknown) rest = rest + (-w[q]) * values_[c.node[q]];
        const Metric2 outer = tamed((1 / unknown_weight(c, uv[k])) * rest, truth);
        for (const std::int32_t q : c.node)
          if (nodes_[q].state == State::unknown) sum[q] = sum[q] + outer, ++votes[q];
      }
    }
    for (std::size_t n = 0; n < nodes_.size(); ++n)
      if (votes[n] > 0) values_[n] = (1.0 / votes[n]) * sum[n], nodes_[n].state = State::extrapolated;
  }

  [[nodiscard]] std::array<double, 4> weights(const TreeCell& c, Vec2 p) const {
    const double s = static_cast<double>(side) / static_cast<double>(c.size);
    const double fx =
        std::clamp((p.x - low_.x) / width_.x * s - static_cast<double>(c.i) / static_cast<double>(c.size), 0.0, 1.0);
    const double fy =
        std::clamp((p.y - low_.y) / width_.y * s - static_cast<double>(c.j) / static_cast<double>(c.size), 0.0, 1.0);
    return {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
  }
  [[nodiscard]] double unknown_weight(const TreeCell& c, Vec2 p) const {
    const auto w = weights(c, p);
    double sum = 0;
    for (int q = 0; q < 4; ++q)
      if (nodes_[c.node[q]].state == State::unknown) sum += w[q];
    return sum;
  }

  // An extrapolation that stays definite and within reach of what is known; else the known value.
  static Metric2 tamed(Metric2 m, Metric2 known) {
    const bool sane = m.a > known.a / most_extrapolation && m.a < known.a * most_extrapolation &&
                      m.c > known.c / most_extrapolation && m.c < known.c * most_extrapolation &&
                      determinant(m) > determinant(known) / (most_extrapolation * most_extrapolation);
    return sane ? m : known;
  }

  // What is still unknown lies outside: planes through three known corners where there are, then the mean of
  // neighbours.
  void fill_unknown() {
    for (bool changed = true; changed;) {
      changed = false;
      monitor_.checkpoint();
      std::vector<Metric2> sum(nodes_.size(), Metric2{0, 0, 0});
      std::vector<int> votes(nodes_.size(), 0);
      for (const TreeCell& c : cells_) {
        if (c.child >= 0) continue;
        int unknown = 0;
        for (const std::int32_t n : c.node) unknown += nodes_[n].state == State::unknown ? 1 : 0;
        if (unknown == 0 || unknown == 4) continue;
        for (int q = 0; q < 4; ++q) {
          if (nodes_[c.node[q]].state != State::unknown) continue;
          Metric2 vote;
          if (unknown == 1) {
            // Opposite corner 3 - q; neighbours q ^ 1 and q ^ 2.
            const Metric2 &s = values_[c.node[q ^ 1]], &t = values_[c.node[q ^ 2]];
            vote = tamed(s + t + (-1.0) * values_[c.node[3 - q]], 0.5 * (s + t));
          } else {
            Metric2 mean{0, 0, 0};
            for (const std::int32_t n : c.node)
              if (nodes_[n].state != State::unknown) mean = mean + values_[n];
            vote = (1.0 / (4 - unknown)) * mean;
          }
          sum[c.node[q]] = sum[c.node[q]] + vote;
          ++votes[c.node[q]];
        }
      }
      for (std::size_t n = 0; n < nodes_.size(); ++n)
        if (votes[n] > 0) values_[n] = (1.0 / votes[n]) * sum[n], nodes_[n].state = State::extrapolated, changed = true;
    }
  }

  void finish() {
    space_.low_ = low_;
    space_.scale_ = {1 / width_.x, 1 / width_.y};
    space_.measure_ = measure();
    space_.nodes_ = std::move(values_);
    space_.cells_.clear();
    space_.cells_.reserve(cells_.size());
    int depth = first_level;
    for (const TreeCell& c : cells_) {
      ControlSpace::Cell cell;
      cell.scale = static_cast<double>(side) / static_cast<double>(c.size);
      cell.x = static_cast<double>(c.i) / static_cast<double>(c.size);
      cell.y = static_cast<double>(c.j) / static_cast<double>(c.size);
      cell.child = c.child;
      for (int q = 0; q < 4; ++q) cell.node[q] = c.node[q];
      space_.cells_.push_back(cell);
      while (depth < table_levels && c.size < side >> depth) ++depth;
    }
    fill_table(depth);
  }

  // The cell of each square of a uniform grid: the leaf that holds it, or the subtree that divides it.
  void fill_table(int depth) {
    const std::int64_t n = std::int64_t{1} << depth, size = side / n;
    space_.table_size_ = static_cast<double>(n);
    space_.table_.assign(static_cast<std::size_t>(n * n), 0);
    for (std::int64_t j = 0; j < n; ++j)
      for (std::int64_t i = 0; i < n; ++i) {
        const std::int64_t roots = std::int64_t{1} << first_level, root_size = side / roots;
        auto cell = static_cast<std::int32_t>((j * size / root_size) * roots + i * size / root_size);
        while (cells_[cell].child >= 0 && cells_[cell].size > size) {
          const TreeCell& c = cells_[cell];
          cell = c.child + (i * size >= c.i + c.size / 2 ? 1 : 0) + (j * size >= c.j + c.size / 2 ? 2 : 0);
        }
        space_.table_[static_cast<std::size_t>(j * n + i)] = cell;
      }
  }

  const SampledDomain& domain_;
  PolygonLocator locator_;
  const MetricSampler& sampler_;
  const ControlSpaceOptions& options_;
  Monitor& monitor_;
  Vec2 low_, high_, width_;
  std::vector<Node> nodes_;
  std::vector<Metric2> values_;
  std::unordered_map<std::uint64_t, std::int32_t> node_of_;
  std::vector<std::int32_t> waiting_;
  std::vector<TreeCell> cells_;
  std::size_t roots_ = 0;
  ControlSpace space_;
};

ControlSpace ControlSpace::build(const SampledDomain& domain, const MetricSampler& sampler,
                                 const ControlSpaceOptions& options, Monitor& monitor) {
  return ControlSpaceBuilder(domain, sampler, options, monitor).run();
}

ControlSpace ControlSpace::constant(Metric2 metric) {
  ControlSpace space;
  space.nodes_.assign(1, metric);
  return space;
}

}  // namespace carreau
