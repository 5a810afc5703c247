// SPDX-License-Identifier: BSD-3-Clause
// The faces of a file, so that a person finds his.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "files/mesh_file.h"

namespace command {

struct FaceLook {
  std::int32_t number = 0;
  std::string name;      ///< "": none
  std::string kind;      ///< "plane", "cylinder", ...
  double area = 0;       ///< 0: it has none, or the geometry fails
  double perimeter = 0;  ///< of all its borders
  Point low{}, high{};   ///< its box
};

/// Length over width of the rectangle that has the area and the perimeter; 1 for shapes rounder than a square.
double narrowness(const FaceLook& face);

/// A table.
void print_faces(const std::vector<FaceLook>& faces);
nlohmann::ordered_json faces_json(const std::vector<FaceLook>& faces);

/// True if a name fits a pattern in which * stands for any characters and ? for one.
bool fits(const std::string& name, const std::string& pattern);

}  // namespace command
