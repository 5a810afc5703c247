// SPDX-License-Identifier: BSD-3-Clause
// Plane domains as geometry.
#pragma once

#include <memory>
#include <string>

namespace command {

class CadInput;

/// How the file of a plane domain is read.
struct PlaneChoice {
  bool is_plane = false;    ///< the input is a plane domain
  std::string sizes;        ///< file of sizes or metrics at its vertices; empty: none
  int field = 0;            ///< of a file of sizes with several fields, from 1; 0: the only one
  double corner_angle = 0;  ///< degrees; polygons are smoothed between corners; 0: they are not
};

/// Whether the name is that of a file of plane domains.
bool is_plane_file(const std::string& path);

/// Throws Failure.
std::unique_ptr<CadInput> open_plane(const std::string& path, const PlaneChoice& choice);

}  // namespace command
