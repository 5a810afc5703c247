// SPDX-License-Identifier: BSD-3-Clause
// The functions of the sub-commands. Each returns the exit code, and throws Failure when it cannot be done.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/scene.h"
#include "inputs/base/input_choice.h"
#include "mesh/mesh_options.h"

namespace command {

struct PictureOptions {
  std::string mesh, out;
  int width = 1200, height = 900, samples = 3;
  std::string metrics;             ///< file of sizes or metrics whose ellipses are drawn, "mesh": the mesh's own; empty: none
  std::vector<std::string> views;  ///< side by side; none: iso, or top for a plane mesh
  SceneOptions scene;
  bool labels = false;  ///< numbers of faces
  TrianglesChoice triangles;  ///< draws lines that are found in triangles where `sharp` is given
  bool json = false;
};

int picture(const PictureOptions& options);

/// A line for a shell that gives a program these words.
std::string shell_line(const std::string& program, const std::vector<std::string>& words);

/// Meshes a file of geometry. 0 all faces, 1 some faces have no mesh; throws Failure when none has one.
int mesh(const MeshOptions& options);

struct InfoOptions : InputChoice {
  std::string input;
  int limit = 10;      ///< sentences of each kind
  bool faces = false;  ///< a line for each
  bool json = false;
};

/// Prints the content of a file of geometry, and potential meshing problems. 0; throws Failure.
int info(const InfoOptions& options);
/// `carreau info` on STEP, IGES and BREP files. Returns the exit code; throws Failure.
int print_cad_info(const InfoOptions& options);

struct ProjectOptions : InputChoice {
  std::string input, points;  ///< files
  std::string on = "faces";   ///< edges, vertices
  int number = 0;             ///< of the only entity; 0: all
  int threads = 0;            ///< 0: all cores
  bool json = false;
};

/// Prints the closest point of a geometry to each point of a file. 0; throws Failure.
int project(const ProjectOptions& options);

struct RefineOptions {
  std::string input;
  std::vector<std::string> outputs;
  TrianglesChoice triangles;
  double angle = 0;  ///< degrees
  int depth = 6;
  bool quiet = false, json = false;
};

/// Cuts triangles finer on the smooth surface over them (HDR sec. 4.9.3). 0; throws Failure.
int refine(const RefineOptions& options);

struct AreasOptions {
  std::string input;
  double probe = 1.4;
  std::string radii;
  bool atoms = false;  ///< a line for each
  int threads = 0;     ///< 0: all cores
  bool json = false;
};

/// Prints areas and volumes of the surfaces of a molecule, in closed form. 0; throws Failure.
int areas(const AreasOptions& options);

struct CurveOptions {
  std::string input;
  std::vector<std::string> outputs;
  std::string size, sizes;  ///< one length; a file of sizes or metrics at the points of the input
  std::string law = "linear", join;
  double tolerance = 0.01;
  bool json = false;
};

/// Joins points by splines, cuts curves in a metric, and draws them (RR-2818). 0; throws Failure.
int curve(const CurveOptions& options);

struct CheckOptions {
  std::string mesh;
  bool closed = false, allow_crossings = false, faces = false, json = false;
  int limit = 20, worst = 3;
};

/// Prints counts, quality and defects. 1 when there are defects.
int check(const CheckOptions& options);

struct ReportOptions {
  std::string mesh, out;
  std::string repeat;  ///< shell_line() of it
  bool json = false;
};

/// Writes a page of HTML about a mesh. 0; throws Failure.
int report(const ReportOptions& options);

struct FieldsOptions {
  MeshOptions mesh;  ///< input: also .env; outputs: the name of the images, .exr or .png
  int longest = 1024, width = 0, height = 0;
  int face = 0;  ///< reference of the only one; 0: all
  bool multi_part = false, raw = false, piz = false;
  std::vector<std::string> channels;  ///< names of field_groups(); none: all
};

/// Meshes, and writes the fields of sizes and metrics behind the mesh of `carreau mesh` as EXR or PNG files. 1 when the
/// files are written but not all faces have triangles.
int fields(const FieldsOptions& options);

/// Names of the groups of channels.
std::vector<std::string> field_groups();

struct ParamsOptions {
  std::string name;  ///< of the only one; empty: all
  bool json = false;
};

/// Prints the parameters, all or one of them.
int params(const ParamsOptions& options);

}  // namespace command
