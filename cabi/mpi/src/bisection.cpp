// SPDX-License-Identifier: BSD-3-Clause
// Recursive coordinate bisection: M. J. Berger, S. H. Bokhari, IEEE Trans. Computers C-36 (1987) 570.
#include <algorithm>
#include <limits>
#include <numeric>

#include "part.h"

namespace carreau_mpi {

namespace {

using Point = std::array<double, 3>;
using Iterator = std::vector<std::int32_t>::iterator;

/// Three times the centre: the order is the same.
Point centre(const WholeMesh& mesh, std::int32_t triangle) {
  Point sum{0, 0, 0};
  for (const std::int32_t v : mesh.triangles[static_cast<std::size_t>(triangle)])
    for (std::size_t i = 0; i < 3; ++i) sum[i] += mesh.vertices[static_cast<std::size_t>(v)][i];
  return sum;
}

std::size_t longest_axis(const WholeMesh& mesh, Iterator begin, Iterator end) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Point low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (Iterator t = begin; t != end; ++t) {
    const Point p = centre(mesh, *t);
    for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  }
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
  return axis;
}

/// Triangles [begin, end) get the ranks [first, last). The begin of each rank's share depends on the whole mesh alone, so
/// that shares differ by one at most.
struct Bisection {
  const WholeMesh& mesh;
  std::vector<std::int32_t>& rank_of;
  std::int64_t size;
  std::vector<double> key;  // of the axis that is cut across, by triangle

  [[nodiscard]] std::ptrdiff_t start_of(std::int64_t rank) const {
    return static_cast<std::ptrdiff_t>(static_cast<std::int64_t>(rank_of.size()) * rank / size);
  }

  void divide(Iterator begin, Iterator end, int first, int last) {
    if (last - first == 1) {
      for (Iterator t = begin; t != end; ++t) rank_of[static_cast<std::size_t>(*t)] = first;
      return;
    }
    const int middle = first + (last - first) / 2;
    const Iterator cut = begin + (start_of(middle) - start_of(first));
    if (begin != end) {
      const std::size_t axis = longest_axis(mesh, begin, end);
      for (Iterator t = begin; t != end; ++t) key[static_cast<std::size_t>(*t)] = centre(mesh, *t)[axis];
      const auto before = [&](std::int32_t a, std::int32_t b) {
        const double x = key[static_cast<std::size_t>(a)], y = key[static_cast<std::size_t>(b)];
        return x != y ? x < y : a < b;  // a total order: the sets on both sides are the same everywhere
      };
      std::nth_element(begin, cut, end, before);
    }
    divide(begin, cut, first, middle);
    divide(cut, end, middle, last);
  }
};

}  // namespace

std::vector<std::int32_t> bisect(const WholeMesh& mesh, int size) {
  const std::size_t m = mesh.triangles.size();
  std::vector<std::int32_t> order(m), rank_of(m, 0);
  std::iota(order.begin(), order.end(), 0);
  Bisection{mesh, rank_of, size, std::vector<double>(size > 1 ? m : 0)}.divide(order.begin(), order.end(), 0, size);
  return rank_of;
}

}  // namespace carreau_mpi
