// SPDX-License-Identifier: BSD-3-Clause
// The solids of a shape, and those that touch or overlap.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "shape_file.h"

namespace carreau_occ {

struct Solids {
  std::vector<int> of_face;        ///< by face from 0: number of its solid from 1, 0: none
  std::vector<std::string> names;  ///< by solid from 0; "": none
};

/// Numbers are those of OpenCASCADE's map of solids. Nothing is thrown.
Solids solids_of(const ShapeFile& file);

/// Two solids that have no face in common but common points.
struct SolidContact {
  std::array<int, 2> solids{};  ///< from 1, ascending
  bool overlap = false;         ///< an edge of one runs inside the other; else they touch
  std::array<double, 3> place{};
};

struct SolidContacts {
  std::vector<SolidContact> contacts;  ///< by solids
  int untested = 0;                    ///< pairs whose boxes meet, beyond the bound of work
};

/// Compares boxes, then classifies points on the edges of each solid against the other one. Nothing is thrown: solids
/// that OpenCASCADE fails on have no contacts.
SolidContacts find_contacts(const ShapeFile& file);

}  // namespace carreau_occ
