// SPDX-License-Identifier: BSD-3-Clause
#include "volume/inner_sizes.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <unordered_map>
#include <unordered_set>

namespace command {
namespace {

constexpr int deepest = 18;  ///< level of the smallest cells; a cell of level 0 is the box
/// Coordinates are integers. The smallest cells have an even width, since their centres are nodes.
constexpr std::int32_t box_width = 1 << (deepest + 1);
constexpr std::size_t max_cells = 200000;   ///< a mesh of 5 million tetrahedra, 1 GB in engines
constexpr int first_level_of_maps = 4;      ///< 16 cells across see a map before its variation decides
constexpr double cell_in_sizes = 4;         ///< widest cell where sizes vary: linear interpolation errs by a tenth
constexpr double near_uniform = 1.25;       ///< ratio of sizes in a cell that needs no division

using Triple = std::array<std::int32_t, 3>;

struct Cell {
  Triple low{};  ///< corner
  int level = 0;
  [[nodiscard]] std::int32_t width() const noexcept { return box_width >> level; }
  [[nodiscard]] Cell parent() const noexcept {
    const std::int32_t mask = ~(2 * width() - 1);
    return {{low[0] & mask, low[1] & mask, low[2] & mask}, level - 1};
  }
  [[nodiscard]] Cell neighbour(int x, int y, int z) const noexcept {
    return {{low[0] + x * width(), low[1] + y * width(), low[2] + z * width()}, level};
  }
};

bool is_in_box(const Cell& cell) {
  return std::all_of(cell.low.begin(), cell.low.end(), [](std::int32_t x) { return x >= 0 && x < box_width; });
}

/// 20 bits of each coordinate of a node, whose range includes box_width.
std::uint64_t key_of(const Triple& p) {
  std::uint64_t key = 0;
  for (const std::int32_t x : p) key = key << 20U | static_cast<std::uint64_t>(x);
  return key;
}

/// Cells whose neighbours, in all 26 directions, have at most twice and at least half their width.
class Octree {
 public:
  void divide(const Cell& cell) {
    if (!is_in_box(cell) || is_divided(cell)) return;
    if (cell.level > 0) divide(cell.parent());
    divided_[static_cast<std::size_t>(cell.level)].insert(key_of(cell.low));
    ++count_;
    if (cell.level == 0) return;
    for (int i = 0; i < 27; ++i)
      if (i != 13)
        if (const Cell beside = cell.neighbour(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1); is_in_box(beside)) divide(beside.parent());
  }
  [[nodiscard]] bool is_divided(const Cell& cell) const { return divided_[static_cast<std::size_t>(cell.level)].count(key_of(cell.low)) > 0; }
  [[nodiscard]] std::size_t cells() const noexcept { return 1 + 7 * count_; }
  [[nodiscard]] std::vector<Cell> leaves() const {
    std::vector<Cell> found, open{Cell{}};
    while (!open.empty()) {
      const Cell cell = open.back();
      open.pop_back();
      if (!is_divided(cell)) {
        found.push_back(cell);
        continue;
      }
      const std::int32_t half = cell.width() / 2;
      for (int i = 7; i >= 0; --i) open.push_back({{cell.low[0] + (i & 1) * half, cell.low[1] + (i >> 1 & 1) * half, cell.low[2] + (i >> 2) * half}, cell.level + 1});
    }
    return found;
  }
  [[nodiscard]] Cell leaf_at(const Triple& p) const {
    Cell cell;
    while (is_divided(cell)) {
      ++cell.level;
      for (std::size_t k = 0; k < 3; ++k) cell.low[k] = p[k] & ~(cell.width() - 1);
    }
    return cell;
  }

 private:
  std::array<std::unordered_set<std::uint64_t>, deepest + 1> divided_;
  std::size_t count_ = 0;
};

class Field {
 public:
  Field(const SolidSurface& surface, const InnerBounds& bounds) : surface_(surface), bounds_(bounds) {
    low_ = high_ = surface.vertices.front();
    for (const Point& p : surface.vertices)
      for (std::size_t k = 0; k < 3; ++k) low_[k] = std::min(low_[k], p[k]), high_[k] = std::max(high_[k], p[k]);
    constexpr double margin = 1.05;  // the surface lies inside the box
    double width = 0;
    for (std::size_t k = 0; k < 3; ++k) width = std::max(width, margin * (high_[k] - low_[k]));
    for (std::size_t k = 0; k < 3; ++k) origin_[k] = .5 * (low_[k] + high_[k] - width);
    unit_ = width / box_width;
  }

  InnerSizes run() {
    divide_at_vertices();
    while (true) {
      make_mesh();
      set_sizes();
      const std::vector<Cell> varied = varied_cells();
      if (varied.empty()) break;
      if (tree_.cells() + 7 * varied.size() > max_cells) {
        mesh_.is_coarse = true;
        break;
      }
      for (const Cell& cell : varied) tree_.divide(cell);
    }
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] Point place_of(const Triple& p) const {
    Point place{};
    for (std::size_t k = 0; k < 3; ++k) place[k] = origin_[k] + unit_ * p[k];
    return place;
  }
  [[nodiscard]] Cell leaf_at(const Point& p) const {
    Triple at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = static_cast<std::int32_t>((p[k] - origin_[k]) / unit_);
    return tree_.leaf_at(at);
  }

  [[nodiscard]] double bound_at(const Point& p) const {
    const double any = bounds_.largest > 0 ? bounds_.largest : surface_.diagonal;
    const double size = bounds_.map ? bounds_.map(p) : 0;
    return size > 0 ? std::min(size, any) : any;
  }

  /// Cells near vertices that are shorter than what options allow there.
  void divide_at_vertices() {
    if (bounds_.map)
      for (int level = 0; level < first_level_of_maps; ++level)
        for (const Cell& cell : tree_.leaves())
          if (cell.level == level && is_near(cell)) tree_.divide(cell);
    for (std::size_t v = 0; v < surface_.vertices.size() && tree_.cells() < max_cells; ++v) {
      const Point& p = surface_.vertices[v];
      if (surface_.sizes[v] * near_uniform > bound_at(p)) continue;
      for (Cell cell = leaf_at(p); cell.level < deepest && unit_ * cell.width() > cell_in_sizes * surface_.sizes[v]; cell = leaf_at(p)) tree_.divide(cell);
    }
  }

  /// True if the cell meets the box of the surface.
  [[nodiscard]] bool is_near(const Cell& cell) const {
    const Point p = place_of(cell.low);
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] > high_[k] || p[k] + unit_ * cell.width() < low_[k]) return false;
    return true;
  }

  std::int32_t node(const Triple& p) {
    const auto [at, is_new] = nodes_.try_emplace(key_of(p), static_cast<std::int32_t>(mesh_.nodes.size()));
    if (is_new) mesh_.nodes.push_back(place_of(p));
    return at->second;
  }

  /// Tetrahedra from the centre of a cell to a part of one of its sides, a square: a fan around the middle of the square. Its edges have nodes
  /// where a smaller cell has a corner.
  void join(std::int32_t centre, const Triple& low, std::size_t axis, std::int32_t width, bool outward) {
    const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
    Triple middle = low;
    middle[a] += width / 2, middle[b] += width / 2;
    const std::int32_t top = node(middle);
    std::array<Triple, 5> corners;
    corners.fill(low);
    corners[1][a] += width, corners[2][a] += width, corners[2][b] += width, corners[3][b] += width;
    for (std::size_t k = 0; k < 4; ++k) {
      Triple between{};
      for (std::size_t x = 0; x < 3; ++x) between[x] = (corners[k][x] + corners[k + 1][x]) / 2;
      const std::int32_t from = node(corners[k]), to = node(corners[k + 1]);
      std::array<std::int32_t, 3> chain{from, to, to};
      std::size_t parts = 1;
      if (corners_.count(key_of(between)) > 0) chain = {from, node(between), to}, parts = 2;
      for (std::size_t i = 0; i < parts; ++i) {
        std::array<std::int32_t, 4> t{chain[i], chain[i + 1], top, centre};
        if (outward) std::swap(t[0], t[1]);  // the centre lies before the triangle
        mesh_.tetrahedra.push_back(t);
      }
    }
  }

  void make_mesh() {
    mesh_ = {};
    nodes_.clear(), corners_.clear(), first_.clear();
    leaves_ = tree_.leaves();
    for (const Cell& cell : leaves_)
      for (int i = 0; i < 8; ++i)
        corners_.insert(key_of({cell.low[0] + (i & 1) * cell.width(), cell.low[1] + (i >> 1 & 1) * cell.width(), cell.low[2] + (i >> 2) * cell.width()}));
    for (const Cell& cell : leaves_) {
      first_.push_back(mesh_.tetrahedra.size());
      const std::int32_t width = cell.width(), half = width / 2;
      const std::int32_t centre = node({cell.low[0] + half, cell.low[1] + half, cell.low[2] + half});
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool outward : {false, true}) {
          Triple step{}, low = cell.low;
          step[axis] = outward ? 1 : -1;
          if (outward) low[axis] += width;
          const Cell beside = cell.neighbour(step[0], step[1], step[2]);
          if (!is_in_box(beside) || !tree_.is_divided(beside)) {
            join(centre, low, axis, width, outward);
            continue;
          }
          for (std::int32_t i = 0; i < 4; ++i) {
            Triple part = low;
            part[(axis + 1) % 3] += (i & 1) * half, part[(axis + 2) % 3] += (i >> 1) * half;
            join(centre, part, axis, half, outward);
          }
        }
    }
    first_.push_back(mesh_.tetrahedra.size());
  }

  [[nodiscard]] static double distance(const Point& p, const Point& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

  void set_sizes() {
    std::vector<double>& sizes = mesh_.sizes;
    sizes.resize(mesh_.nodes.size());
    for (const auto& [key, n] : nodes_) {
      const auto [at, is_new] = known_.try_emplace(key, 0);
      if (is_new) at->second = bound_at(mesh_.nodes[static_cast<std::size_t>(n)]);
      sizes[static_cast<std::size_t>(n)] = at->second;
    }
    std::unordered_map<std::uint64_t, std::size_t> cell_at;  // smallest cells have different corners; corners of others, too
    for (std::size_t i = 0; i < leaves_.size(); ++i) cell_at[key_of(leaves_[i].low)] = i;
    for (std::size_t v = 0; v < surface_.vertices.size(); ++v) {
      const Point& p = surface_.vertices[v];
      const std::size_t cell = cell_at.at(key_of(leaf_at(p).low));
      for (std::size_t t = first_[cell]; t < first_[cell + 1]; ++t)
        for (const std::int32_t n : mesh_.tetrahedra[t]) {
          double& size = sizes[static_cast<std::size_t>(n)];
          size = std::min(size, surface_.sizes[v] + bounds_.growth * distance(p, mesh_.nodes[static_cast<std::size_t>(n)]));
        }
    }
    grow();
  }

  /// Sizes differ along edges by at most growth times length: Dijkstra's algorithm from the smallest one.
  void grow() {
    std::vector<std::size_t> start(mesh_.nodes.size() + 1, 0);
    for (const auto& t : mesh_.tetrahedra)
      for (const std::int32_t n : t) start[static_cast<std::size_t>(n) + 1] += 3;
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) start[n + 1] += start[n];
    std::vector<std::int32_t> others(start.back());
    std::vector<std::size_t> end(start.begin(), start.end() - 1);
    for (const auto& t : mesh_.tetrahedra)
      for (const std::int32_t n : t)
        for (const std::int32_t m : t)
          if (m != n) others[end[static_cast<std::size_t>(n)]++] = m;
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) queue.emplace(mesh_.sizes[n], static_cast<std::int32_t>(n));
    while (!queue.empty()) {
      const auto [size, n] = queue.top();
      queue.pop();
      const auto at = static_cast<std::size_t>(n);
      if (size > mesh_.sizes[at]) continue;
      for (std::size_t i = start[at]; i < start[at + 1]; ++i) {
        const auto m = static_cast<std::size_t>(others[i]);
        const double grown = size + bounds_.growth * distance(mesh_.nodes[at], mesh_.nodes[m]);
        if (grown < mesh_.sizes[m]) mesh_.sizes[m] = grown, queue.emplace(grown, static_cast<std::int32_t>(m));
      }
    }
  }

  /// Cells in which sizes vary, and which are wide beside them.
  [[nodiscard]] std::vector<Cell> varied_cells() const {
    std::vector<Cell> found;
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      if (leaves_[i].level == deepest || !is_near(leaves_[i])) continue;
      double low = surface_.diagonal, high = 0;
      for (std::size_t t = first_[i]; t < first_[i + 1]; ++t)
        for (const std::int32_t n : mesh_.tetrahedra[t])
          low = std::min(low, mesh_.sizes[static_cast<std::size_t>(n)]), high = std::max(high, mesh_.sizes[static_cast<std::size_t>(n)]);
      if (high > near_uniform * low && unit_ * leaves_[i].width() > cell_in_sizes * low) found.push_back(leaves_[i]);
    }
    return found;
  }

  const SolidSurface& surface_;
  const InnerBounds& bounds_;
  Point low_{}, high_{}, origin_{};
  double unit_ = 0;
  Octree tree_;
  InnerSizes mesh_;
  std::vector<Cell> leaves_;
  std::vector<std::size_t> first_;  ///< tetrahedron of each leaf, and their number
  std::unordered_map<std::uint64_t, std::int32_t> nodes_;
  std::unordered_set<std::uint64_t> corners_;
  std::unordered_map<std::uint64_t, double> known_;  ///< bounds at nodes
};

}  // namespace

InnerSizes inner_sizes_of(const SolidSurface& surface, const InnerBounds& bounds) { return Field(surface, bounds).run(); }

}  // namespace command
