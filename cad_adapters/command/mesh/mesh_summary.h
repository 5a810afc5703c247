// SPDX-License-Identifier: BSD-3-Clause
// The summary of `carreau mesh`, as text and as JSON.
#pragma once

#include <carreau.h>

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "check/crossings.h"
#include "check/short_edges.h"
#include "files/mesh_file.h"
#include "inputs/base/cad_input.h"
#include "mesh/mesh_options.h"

namespace command {

/// The figures of the last run of a session.
carreau_report report_of(carreau_session* session);

class Adaptation;

/// A run with its results, besides the data of session and mesh.
struct MeshRun {
  const MeshOptions& options;
  const CadInput& input;
  carreau_session* session = nullptr;
  carreau_mesh* mesh = nullptr;
  double seconds_reading = 0, seconds_writing = 0, seconds_processor = 0;
  std::vector<FaceResult> faces;
  std::vector<std::string> dumped;  ///< files of faces that failed
  std::vector<std::string> warnings = {};
  ShortEdges short_edges = {};
  Crossings crossings = {};
  carreau_quality quality = {};
  const Adaptation* adaptation = nullptr;
  std::function<std::string(const std::string& suffix)> volume_text = {};  ///< content of files of tetrahedra; empty: files have the mesh
};

/// "2 of 6 faces have no mesh: 3, 5"; "" when all have.
std::string failed_faces(const std::vector<FaceResult>& faces);

/// "2 entities of the file could not be read: #12 ADVANCED_FACE, ..."; "" when all could.
std::string lost_entities(const CadInput& input);

/// If the faces of the file close, or were glued, and the mesh has free edges: their number and curves. "" without free
/// edges, or if faces failed.
std::string unexpectedly_open(const MeshRun& run);

/// A table: faces, lengths, times, files; the library's own messages report counts, shape and the times of its phases.
std::vector<std::string> summary_lines(const MeshRun& run);

/// The table for a mesh that several processes keep in parts: `run.mesh` is the part of this one.
std::vector<std::string> part_lines(const MeshRun& run, int processes);
/// Sentences about such a mesh: that it has free edges although the file closes, and that triangles cross; "": not so.
std::string free_edges_of_parts(const MeshRun& run);
std::string crossings_of_parts(const MeshRun& run);
/// Counts the pairs of triangles that cross, and names the command that finds their faces. Empty when nothing crosses.
std::vector<std::string> crossing_lines_of_parts(const MeshRun& run);

/// All results of a run for programs, without the format: the output of `carreau mesh --json`. `delivered`: with the
/// measures of the mesh, which are computed if necessary.
nlohmann::ordered_json summary_json(const MeshRun& run, bool delivered);
/// The same for a mesh that several processes keep in parts.
nlohmann::ordered_json part_json(const MeshRun& run, int processes);

/// Prints summary_json() on the standard output, with the measures of the mesh when the parameter `measure` requires
/// them.
void print_json(const MeshRun& run);

}  // namespace command
