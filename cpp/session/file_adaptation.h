// SPDX-License-Identifier: BSD-3-Clause
// A step of the loop of HDR sec. 1.2 by files: fields on the last mesh, the next mesh, the fields on it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "session/session.h"
#include "size/background.h"

namespace carreau {

/// A mesh file (`.mesh`, `.meshb`, ...) with a file of sizes or metrics (`.sol`, `.solb`; BL2D's `.h`). A mesh of dimension 3 lies in space
/// and has triangles, tetrahedra or edges of curves. Triangles of a mesh of dimension 2 lie in the parameter planes of the faces that their
/// references name (0: any). With `one_plane` all faces lie in one plane, whatever references they have. Throws FileError with the file,
/// and the line or byte if there is one. `field`: see SolutionChoice.
std::shared_ptr<BackgroundField> read_background(const std::string& mesh_path, const std::string& sol_path,
                                                 bool one_plane = false, std::int32_t field = 0);

/// Sizes or metrics of a file (as above) at the given number of vertices, as metrics of space; metrics of dimension 2
/// have the smaller size across. Throws FileError.
std::vector<Metric3> read_metrics(const std::string& sol_path, std::size_t vertices);

/// Reads a mesh file (of a volume its surface) and prescribes the sizes or metrics that the parameters adapt_* derive from the fields of a
/// `.sol` or `.solb` at its vertices. A file of one symmetric tensor is read as metrics. Several scalars, and the components of vectors,
/// count together (intersection). On a mesh of dimension 2, sizes are lengths of the parameter planes; all faces of a plane model share one
/// plane. Throws the exceptions of read_background() and estimate_all().
std::shared_ptr<BackgroundField> background_of_fields(Session& session, const std::string& mesh_path,
                                                      const std::string& sol_path);

/// Transfers the fields of `sol_path`, of any types, from the vertices of `mesh_path` to the vertices of the session's mesh, and writes
/// them to `out_path`. Its dimension is 2 for a plane model: vectors get or lose the component z. Returns the number of vertices beside the
/// old mesh; they have the nearest values. The processes of a team share the work, and the first one writes. Throws FileError and
/// InvalidArgument.
std::int64_t transfer_files(Session& session, const std::string& mesh_path, const std::string& sol_path,
                            const std::string& out_path);

/// `call adapt` of blsurf.env: one step of the loop. Takes the fields adapt_sol at the vertices of adapt_mesh, or of
/// the session's mesh, as background_of_fields() does, and meshes the model with them. adapt_out receives the fields on
/// the new mesh. Throws FileError, InvalidArgument (no adapt_sol, no mesh), and the exceptions of make_mesh().
void adapt_by_files(Session& session, Monitor& monitor);

}  // namespace carreau
