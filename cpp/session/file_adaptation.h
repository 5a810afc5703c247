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

/// A mesh file (`.mesh`, `.meshb`, ...) with a file of sizes or metrics (`.sol`, `.solb`; BL2D's `.h`). A mesh of dimension 3
/// is one of space, of triangles, tetrahedra or edges of curves; the triangles of one of dimension 2 lie in the parameter planes of the faces that their
/// references name (0: any); with `one_plane` all faces lie in one, whatever references say. Throws FileError; names the
/// file, and the line or byte where there is one. `field`: see SolutionChoice.
std::shared_ptr<BackgroundField> read_background(const std::string& mesh_path, const std::string& sol_path,
                                                 bool one_plane = false, std::int32_t field = 0);

/// Sizes or metrics of a file (as above) at so many vertices, as metrics of space; those of dimension 2 have the smaller
/// size across. Throws FileError.
std::vector<Metric3> read_metrics(const std::string& sol_path, std::size_t vertices);

/// A mesh file, of a volume its surface, with the sizes or metrics that the fields of a `.sol` or `.solb` at its vertices ask for, by the parameters
/// adapt_*; a file of one symmetric tensor is taken as metrics. Several scalars, and the components of vectors, count
/// together (intersection). On a mesh of dimension 2, sizes are lengths of the parameter planes; those of a plane model
/// are one plane. Throws what read_background() and estimate_all() throw.
std::shared_ptr<BackgroundField> background_of_fields(Session& session, const std::string& mesh_path,
                                                      const std::string& sol_path);

/// Writes the fields of `sol_path` at the vertices of `mesh_path` as they are at the vertices of the session's mesh, of
/// any types, to `out_path`, whose dimension is 2 for a plane model: vectors get or lose the component z. Returns the
/// number of vertices beside the old mesh; they have the nearest values. The processes of a team share the work, and the first one writes. Throws
/// FileError and InvalidArgument.
std::int64_t transfer_files(Session& session, const std::string& mesh_path, const std::string& sol_path,
                            const std::string& out_path);

/// `call adapt` of blsurf.env: one step of the loop. The fields adapt_sol at the vertices of adapt_mesh, or of the
/// session's mesh, are taken as background_of_fields() does, and the model is meshed again by that; adapt_out gets the
/// fields on the new mesh. Throws FileError, InvalidArgument (no adapt_sol, no mesh), and what make_mesh() throws.
void adapt_by_files(Session& session, Monitor& monitor);

}  // namespace carreau
