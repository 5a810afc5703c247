// What `carreau mesh` has done: for a person, and for a program.
#pragma once

#include <carreau.h>

#include <string>
#include <vector>

#include "cad_input.h"
#include "commands.h"

namespace command {

struct FaceResult {
  std::int32_t ref = 0, status = CARREAU_FACE_FAILED;
  std::int64_t triangles = 0;
  std::string name, why;
};

/// A run with its results, besides what session and mesh know.
struct MeshRun {
  const MeshOptions& options;
  const CadInput& input;
  carreau_session* session = nullptr;
  carreau_mesh* mesh = nullptr;
  double seconds_reading = 0, seconds_writing = 0, seconds_processor = 0;
  std::vector<FaceResult> faces;  ///< of collect_faces()
};

/// Faces of the mesh and faces that are left out, by reference. Throws Failure.
std::vector<FaceResult> collect_faces(carreau_mesh* mesh, const CadInput& input);

/// "2 of 6 faces have no mesh: 3, 5"; "" when all have.
std::string failed_faces(const std::vector<FaceResult>& faces);

/// A table: faces, lengths, times, files; the library's own messages tell counts, shape and the times of its phases.
std::vector<std::string> summary_lines(const MeshRun& run);

/// Everything about a run that a program may want: a JSON object on the standard output.
void print_json(const MeshRun& run);

}  // namespace command
