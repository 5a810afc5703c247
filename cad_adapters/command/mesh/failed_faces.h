// SPDX-License-Identifier: BSD-3-Clause
// Domains and fields of failed faces.
#pragma once

#include <carreau.h>

#include <string>
#include <vector>

#include "files/mesh_file.h"
#include "inputs/base/cad_input.h"
#include "mesh/progress.h"

namespace command {

/// Writes files into a folder, for each face face_<ref>.mesh, its domain in the parameter plane, and face_<ref>.exr,
/// its fields; with its name between, when it has one (face_7_bore.mesh).
class FailedFaces {
 public:
  /// An empty folder: nothing is written. Throws Failure when `folder` is not a folder, or cannot be made or written
  /// in.
  explicit FailedFaces(std::string folder);

  /// A face whose geometry failed, while `session` has the model with it. The sentence of the session is lost.
  void dump_without_mesh(carreau_session* session, const CadInput& input, std::int32_t face, Progress& progress);
  /// Faces of a mesh that have no triangles: as the mesher has seen them, and as the input has them where it did not
  /// get so far.
  void dump_of_mesh(carreau_session* session, carreau_mesh* mesh, const CadInput& input,
                    const std::vector<FaceResult>& faces, Progress& progress);

  [[nodiscard]] const std::vector<std::string>& files() const noexcept { return files_; }

 private:
  [[nodiscard]] std::string stem(std::int32_t ref, const std::string& name) const;
  bool dump_meshed(carreau_session* session, carreau_mesh* mesh, const CadInput& input, const FaceResult& face);
  void write_fields(carreau_session* session, std::int32_t face, bool raw, const std::string& path);

  std::string folder_;
  std::vector<std::string> files_;
};

}  // namespace command
