// SPDX-License-Identifier: BSD-3-Clause
// Random Bezier nets: folded, with degenerate sides and control points at one place, tiny and huge, one or several.
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry_fuzz.h"
#include "session_handle.h"

namespace geometry_fuzz {
namespace {

struct Patches {
  std::vector<std::int32_t> degrees;
  std::vector<double> controls;
};

class Net {
 public:
  Net(int m, int n) : m_(m), n_(n), xyz_(static_cast<std::size_t>(3 * (m + 1) * (n + 1))) {}
  double* at(int i, int j) { return &xyz_[static_cast<std::size_t>(3 * (i * (n_ + 1) + j))]; }
  void set(int i, int j, const double* p) { std::copy_n(std::array{p[0], p[1], p[2]}.begin(), 3, at(i, j)); }
  int m() const { return m_; }
  int n() const { return n_; }
  std::vector<double>& xyz() { return xyz_; }

 private:
  int m_, n_;
  std::vector<double> xyz_;
};

/// A flat net over a rectangle from (x, y), with noise.
Net rectangle(Random& random, double x, double y) {
  const int most = random.chance(0.9) ? 4 : 9;
  Net net(1 + random.below(most), 1 + random.below(most));
  const double width = random.chance(0.7) ? 1 : random.power(-4, 2), noise = random.chance(0.3) ? 0 : random.power(-3, 0.5);
  for (int i = 0; i <= net.m(); ++i)
    for (int j = 0; j <= net.n(); ++j) {
      double* p = net.at(i, j);
      p[0] = x + width * i / net.m(), p[1] = y + static_cast<double>(j) / net.n();
      const bool border = i == 0 || j == 0 || i == net.m() || j == net.n();
      const double by = border && random.chance(0.5) ? 0 : noise;
      for (int k = 0; k < 3; ++k) p[k] += by * random.uniform(-1, 1);
    }
  return net;
}

void spoil(Random& random, Net& net) {
  const auto column = [&] { return random.below(net.m() + 1); };
  const auto row = [&] { return random.below(net.n() + 1); };
  const int i = column(), j = row();
  switch (random.below(8)) {
    case 0:  // a side, or a line amid the net, becomes a point
      for (int k = 0; k <= net.m(); ++k) net.set(k, j, net.at(0, j));
      break;
    case 1:
      for (int k = 0; k <= net.n(); ++k) net.set(i, k, net.at(i, 0));
      break;
    case 2: net.set(i, j, net.at(column(), row())); break;
    case 3:  // two columns change places
      for (int k = 0, other = column(); k <= net.n(); ++k) std::swap_ranges(net.at(i, k), net.at(i, k) + 3, net.at(other, k));
      break;
    case 4:  // a side closes upon the opposite side
      for (int k = 0; k <= net.n(); ++k) net.set(net.m(), k, net.at(0, k));
      break;
    case 5:  // all in one plane, or on one line
      for (std::size_t k = 2; k < net.xyz().size(); k += 3) net.xyz()[k] = 0;
      if (random.chance(0.3))
        for (std::size_t k = 1; k < net.xyz().size(); k += 3) net.xyz()[k] = 0;
      break;
    case 6:
      for (int k = 0; k < 3; ++k) net.at(i, j)[k] += random.uniform(-1, 1) * random.power(-6, 1);
      break;
    default:  // one side lies on its neighbour
      for (int k = 0; k <= std::min(net.m(), net.n()); ++k) net.set(k, 0, net.at(0, k));
  }
}

}  // namespace

Outcome run_bezier(std::uint64_t seed) {
  Random random(seed);
  Patches all;
  const int count = random.chance(0.5) ? 1 : 2 + random.below(3);
  std::vector<Net> nets;
  for (int k = 0; k < count; ++k) {
    Net net = rectangle(random, k % 2, k / 2);
    for (int n = random.chance(0.4) ? 0 : 1 + random.below(3); n > 0; --n) spoil(random, net);
    // A neighbour takes the side of the patch before it.
    if (k % 2 == 1 && random.chance(0.7) && net.n() == nets.back().n())
      for (int j = 0; j <= net.n(); ++j) net.set(0, j, nets.back().at(nets.back().m(), j));
    if (k > 0 && random.chance(0.1)) net = nets.back();
    nets.push_back(net);
  }
  const double scale = random.chance(0.7) ? 1 : random.power(-9, 9), away = random.chance(0.8) ? 0 : random.power(0, 6);
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
  for (Net& net : nets) {
    all.degrees.push_back(net.m()), all.degrees.push_back(net.n());
    for (std::size_t k = 0; k < net.xyz().size(); ++k) {
      const double x = scale * (net.xyz()[k] + away);
      all.controls.push_back(x);
      low[k % 3] = std::min(low[k % 3], x), high[k % 3] = std::max(high[k % 3], x);
    }
  }
  carreau_bezier given = sized<carreau_bezier>();
  given.patch_count = count, given.degrees = all.degrees.data(), given.controls = all.controls.data();
  const SessionHandle session;
  const carreau_status status = carreau_add_bezier(session, &given);
  if (status != CARREAU_OK) return {Result::rejected, fault_of(session, status, "carreau_add_bezier")};
  set_parameters(session, std::max(std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]), 1e-30), random);
  return mesh_and_check(session, false, random);
}

}  // namespace geometry_fuzz
