// SPDX-License-Identifier: BSD-3-Clause
// All that `carreau check` and reports look at in a mesh.
#pragma once

#include <carreau.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "check/crossings.h"
#include "check/mesh_report.h"
#include "files/mesh_file.h"

namespace command {

struct MeshCheck {
  std::int64_t vertices = 0, triangles = 0, edges = 0, faces = 0, defects = 0;
  std::string sentences;  ///< of defects, a line each
  carreau_quality quality{};
  carreau_cell_quality cells{};
  std::int32_t order = 1;  ///< of the elements
  MeshReport report;
  Crossings crossings;
  std::vector<FaceResult> not_meshed;  ///< faces that the file knows of and has no triangles of
  bool measured = false;               ///< indices and numbers allow quality and report
};

struct CheckLimits {
  bool closed = false;  ///< an edge of one triangle is a defect too
  int limit = 20;       ///< defects to look for
  int worst = 3;        ///< triangles to list
};

/// `arrays` belong to `mesh`. `known`: its crossings, when they were computed before. Throws Failure.
MeshCheck check_of(carreau_mesh* mesh, const MeshArrays& arrays, const CheckLimits& limits,
                   const Crossings* known = nullptr);
/// Does this with arrays that are in memory only while they are needed.
MeshCheck check_of(carreau_mesh* mesh, const CheckLimits& limits);

/// True if the mesh has elements that are not straight triangles.
bool has_elements(const carreau_cell_quality& quality);

/// The object that `carreau check --json` prints, without its format. Crossings count as a defect unless they are allowed.
nlohmann::ordered_json check_json(const MeshCheck& check, const std::string& name, int limit, bool allow_crossings = false);

}  // namespace command
