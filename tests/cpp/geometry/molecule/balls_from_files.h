// SPDX-License-Identifier: BSD-3-Clause
// Molecules of tests/data.
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "geometry/molecule/balls.h"

namespace carreau::molecule {

inline std::vector<Ball> read_balls(const std::string& name, double probe = 0) {
  std::ifstream in(std::string(CARREAU_SOURCE_DIR) + "/tests/data/molecule/" + name);
  std::vector<Ball> balls;
  for (double x, y, z, r; in >> x >> y >> z >> r;) balls.push_back({{x, y, z}, r + probe});
  return balls;
}

}  // namespace carreau::molecule
