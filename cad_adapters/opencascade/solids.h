// SPDX-License-Identifier: BSD-3-Clause
// The solids of a shape, and solids that touch or overlap.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "shape_file.h"

namespace carreau_occ {

struct Solids {
  /// For each face, from 0, the number, from 1, of the solid that its triangles look out of, and of the solid on the
  /// other side; 0: none.
  std::vector<std::array<int, 2>> of_face;
  /// For each solid, from 0; "": none. Solids of one name get numbers: bolt, bolt_2.
  std::vector<std::string> names;

  /// From 1.
  [[nodiscard]] bool has_face(int solid) const {
    return std::any_of(of_face.begin(), of_face.end(), [solid](const auto& sides) { return sides[0] == solid || sides[1] == solid; });
  }
  /// From 1; 0: "".
  [[nodiscard]] const char* name(int solid) const {
    return solid > 0 ? names[static_cast<std::size_t>(solid - 1)].c_str() : "";
  }
};

/// Numbers follow OpenCASCADE's map of solids. Nothing is thrown.
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
