// SPDX-License-Identifier: BSD-3-Clause
#include "support/gauss.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "support/error.h"

namespace carreau {

GaussRule gauss_rule(int n) {
  if (n < 1 || n > 64)
    throw InvalidArgument("a Gauss rule has 1 to 64 points, not " + std::to_string(n));
  GaussRule rule;
  rule.node.resize(n);
  rule.weight.resize(n);
  for (int i = 0; i < (n + 1) / 2; ++i) {
    // Roots of the Legendre polynomial P_n by Newton's method; the start is good to 1 / n^4.
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 8; ++step) {
      double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    if (2 * i + 1 == n) x = 0;
    const double weight = 1 / ((1 - x * x) * slope * slope);
    rule.node[i] = 0.5 * (1 - x);
    rule.node[n - 1 - i] = 0.5 * (1 + x);
    rule.weight[i] = rule.weight[n - 1 - i] = weight;
  }
  return rule;
}

std::array<Barycentric, 7> triangle_rule() {
  const double root = std::sqrt(15.0);
  const double near = (6 - root) / 21, far = (6 + root) / 21;
  const double near_weight = (155 - root) / 1200, far_weight = (155 + root) / 1200;
  std::array<Barycentric, 7> rule{};
  rule[0] = {1.0 / 3, 1.0 / 3, 1.0 / 3, 9.0 / 40};
  std::size_t k = 1;
  for (const auto& [x, w] : {std::pair{near, near_weight}, std::pair{far, far_weight}}) {
    rule[k++] = {1 - 2 * x, x, x, w};
    rule[k++] = {x, 1 - 2 * x, x, w};
    rule[k++] = {x, x, 1 - 2 * x, w};
  }
  return rule;
}

}  // namespace carreau
