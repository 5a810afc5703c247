// SPDX-License-Identifier: BSD-3-Clause
// The content of a report.
#pragma once

#include <carreau.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "check/mesh_check.h"
#include "files/mesh_file.h"
#include "report/triangle_values.h"

namespace command {

/// A parameter that has another value than its default.
struct AskedValue {
  std::string name, value, usual, help;
};

struct ReportContent {
  std::string file;    ///< that the mesh is of, as it was named
  std::string repeat;  ///< a line for a shell that makes the report again
  MeshArrays mesh;
  MeshCheck check;
  std::vector<std::uint8_t> halves;    ///< of halves_of(); empty when the mesh cannot be measured
  std::vector<TriangleValues> values;  ///< the first is the shape quality; empty when the mesh cannot be measured
  std::vector<AskedValue> asked;
  nlohmann::ordered_json run;  ///< what `carreau mesh --json` prints, with "delivered"; null for a mesh from a file
};

constexpr int defects_told = 100;

/// The content about a mesh, without the names and the run. `known`: its crossings. Throws Failure.
ReportContent content_of(carreau_mesh* mesh, const Crossings* known = nullptr);

/// Parameters of a session after its run. Throws Failure.
std::vector<AskedValue> asked_of(carreau_session* session);

/// The whole page: a file of HTML that needs no other.
std::string report_page(const ReportContent& content);

}  // namespace command
