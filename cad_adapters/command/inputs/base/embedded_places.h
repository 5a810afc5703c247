// SPDX-License-Identifier: BSD-3-Clause
// Points and curves of space that a mesh has, by options.
#pragma once

#include <carreau.h>

#include <string>
#include <vector>

namespace command {

struct EmbedChoice {
  std::vector<std::string> points;  ///< "x,y,z"
  std::vector<std::string> curves;  ///< files of points
  bool wires = false;               ///< wires of the file that lie on faces
  double ridges = 0;                ///< radius of curvature below which ridges of grids become edges; 0: none do
};

/// Embeds points, curves, wires and ridges in the model of a session, which has its parameters and its geometry. The name of a curve is the name of
/// its file without suffix. Throws Failure.
void embed(carreau_session* session, const EmbedChoice& choice);

}  // namespace command
