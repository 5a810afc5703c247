// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/root_maps.h"

namespace carreau {

std::vector<CurveMember> maps_of_root(const CurveClass& all) {
  const int root = all.members.front().image.curve;
  std::vector<CurveMember> maps;
  if (all.turn) maps.push_back({{root, true, 1}, *all.turn});
  for (int k = 0; k < all.cycle.n; ++k) {
    const double shift = static_cast<double>(k) / all.cycle.n;
    if (k > 0) maps.push_back({{root, false, shift}, all.cycle.power(k)});
    if (all.cycle.turn) maps.push_back({{root, true, all.cycle.turned_at + shift}, all.cycle.power(k).after(*all.cycle.turn)});
  }
  return maps;
}

}  // namespace carreau
