// SPDX-License-Identifier: BSD-3-Clause
// Random molecules, and grids of random nodes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry_fuzz.h"
#include "session_handle.h"

namespace geometry_fuzz {

/// A few balls: beside one another, inside one another, at one place, touching, on a lattice.
Outcome run_molecule(std::uint64_t seed) {
  Random random(seed);
  const int n = 1 + random.below(7), lattice = random.chance(0.3) ? 1 : 0;
  const double spread = random.uniform(0.5, 3), scale = random.chance(0.8) ? 1 : random.power(-6, 6);
  std::vector<double> centers, radii;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k)
      centers.push_back(scale * (lattice > 0 ? random.below(3) : spread * random.uniform(-1, 1)));
    radii.push_back(scale * (lattice > 0 ? (random.chance(0.5) ? 1 : 0.5) : random.uniform(0.3, 1.8)));
    if (i > 0 && random.chance(0.1)) std::copy_n(centers.end() - 6, 3, centers.end() - 3);
    if (random.chance(0.05)) radii.back() *= random.power(-6, 0);
  }
  carreau_molecule_options options = sized<carreau_molecule_options>();
  options.surface = 1 + random.below(3);
  options.drop_cavities = random.below(2);
  options.probe = scale * (random.chance(0.7) ? 1.4 : random.power(-3, 1));
  const SessionHandle session;
  const carreau_status status = carreau_add_molecule(session, &options, n, centers.data(), radii.data());
  if (status != CARREAU_OK) return {Result::rejected, fault_of(session, status, "carreau_add_molecule")};
  set_parameters(session, 4 * spread * scale, random);
  return mesh_and_check(session, false, random);
}

/// Nets of nodes with noise, steps, repeated rows, poles and missing nodes.
Outcome run_grid(std::uint64_t seed) {
  Random random(seed);
  const int blocks = 1 + random.below(3);
  const double noise = random.chance(0.3) ? 0 : random.power(-3, 0.5), scale = random.chance(0.8) ? 1 : random.power(-6, 6);
  std::vector<std::int32_t> counts;
  std::vector<double> nodes;
  for (int b = 0; b < blocks; ++b) {
    const int columns = 2 + random.below(7), rows = 2 + random.below(7), pole = random.chance(0.2) ? 0 : -1;
    const int again = random.chance(0.2) ? random.below(rows) : -1;
    const double missing = random.chance(0.3) ? random.uniform(0, 0.3) : 0, turn = random.chance(0.3) ? random.uniform(0, 7) : 0;
    counts.push_back(columns), counts.push_back(rows);
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        const double x = static_cast<double>(i) / (columns - 1), y = static_cast<double>(j == again ? j - 1 : j) / (rows - 1);
        double p[3] = {b + (j == pole ? 0 : x), y, 0};
        if (turn > 0) p[0] = (1 + b) * std::cos(turn * x), p[2] = (1 + b) * std::sin(turn * x);
        const bool border = i == 0 || j == 0 || i == columns - 1 || j == rows - 1;
        const bool none = random.chance(missing);
        for (double& each : p) {
          if (!border) each += noise * random.uniform(-1, 1);
          nodes.push_back(none ? std::numeric_limits<double>::quiet_NaN() : scale * each);
        }
      }
  }
  carreau_grid_options options = sized<carreau_grid_options>();
  options.lengths = random.below(2), options.orient = random.below(2), options.fill = random.below(2);
  options.join_angle = random.chance(0.3) ? random.uniform(1, 90) : 0;
  options.smoothing_rounds = random.chance(0.2) ? 1 + random.below(3) : 0;
  options.continuity = seed % 2 == 1 ? 2 : 1;
  const SessionHandle session;
  carreau_status status = carreau_add_grid(session, &options, blocks, counts.data(), nodes.data());
  if (status != CARREAU_OK) return {Result::rejected, fault_of(session, status, "carreau_add_grid")};
  set_parameters(session, 2 * scale, random);
  if (seed % 4 == 1) status = carreau_model_embed_ridges(session, scale / 2, nullptr);
  if (status != CARREAU_OK) return {Result::rejected, fault_of(session, status, "carreau_model_embed_ridges")};
  return mesh_and_check(session, false, random);
}

}  // namespace geometry_fuzz
