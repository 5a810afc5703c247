/* SPDX-License-Identifier: BSD-3-Clause */
/* clang-format off */
/* carreau_mpi.h: meshes made by the processes (ranks) of an MPI communicator, and the part of each rank. C99, and C++ as
 * well. Library: libcarreau_mpi, which links MPI; libcarreau does not.
 *
 * In five lines, on every rank:
 *   carreau_session_create(&session); ... geometry, model, parameters: the same on every rank ...
 *   carreau_mesh_generate_mpi(session, MPI_Comm_c2f(MPI_COMM_WORLD));   // the mesh of one process, bit for bit
 *   carreau_mpi_write(session, comm, "big.pvtu");                       // or "big.meshb"
 *   carreau_session_mesh(session, &mesh);
 *   carreau_part_create(mesh, rank, size, 1, &part);                    // this rank's triangles and a layer of ghosts
 * A mesh that no rank could hold: each keeps its part.
 *   carreau_mesh_generate_parts(session, comm, &part);
 *   carreau_part_write(session, part, comm, "huge.meshb");
 *
 * The rules of carreau.h hold. Communicators are given as Fortran's handles, which are integers of every MPI:
 * MPI_Comm_c2f(comm). Functions that take one are collective. MPI must have been initialised, with MPI_THREAD_FUNNELED
 * at least; with MPI_THREAD_MULTIPLE threads of a rank take faces without waiting for the calling thread.
 */
/* clang-format on */
#ifndef CARREAU_MPI_H
#define CARREAU_MPI_H

#include "carreau.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Meshes ---- */

/* carreau_mesh_generate by all ranks of a communicator. Every rank has the whole mesh afterwards. An error on one rank
 * ends the call on all of them. Errors: as carreau_mesh_generate and carreau_set_team; CALLBACK (MPI has failed). */
CARREAU_API carreau_status carreau_mesh_generate_mpi(carreau_session* session, int32_t comm);

/* The part of a mesh that is one rank's. */
typedef struct carreau_part carreau_part;

/* Generates the mesh in parts, one kept by each rank: no rank has the whole mesh, whose size the memory of all ranks bounds. A
 * part is the triangles of the faces that the rank has meshed, with a layer of ghosts; it is the rank's until carreau_part_free.
 * Vertices, triangles and their numbers are identical to the mesh of carreau_mesh_generate_mpi. Options that need the whole mesh make
 * it on each rank (carreau_mesh_generate_part of carreau.h). Else an earlier mesh of the session stays.
 * Errors: as carreau_mesh_generate_part; CALLBACK (MPI has failed). With PARTIAL (some faces failed) there is a part. */
CARREAU_API carreau_status carreau_mesh_generate_parts(carreau_session* session, int32_t comm, carreau_part** out_part);

/* Calls carreau_set_team with the ranks of a communicator: from now on all of them make every mesh of the session. They also call together
 * the functions that carreau_set_team lists (estimates, fields carried over, ...). The communicator is duplicated; the duplicate stays
 * until MPI_Finalize. Free the session, or give it another team, before that.
 * Errors: ARGUMENT (no communicator, MPI is not initialised), CALLBACK (MPI has failed). */
CARREAU_API carreau_status carreau_mpi_attach(carreau_session* session, int32_t comm);

/* Writes the mesh of the session by all ranks into one folder that all of them see. The path of rank 0 counts.
 *   .pvtu   a file of VTK's XML for the parts of all ranks, x.pvtu, and one a rank beside it, x_0.vtu, x_1.vtu, ...: its
 *           triangles and a layer of ghosts (vtkGhostType), references of faces, GlobalPointIds, GlobalElementIds and
 *           the rank; straight triangles only
 *   others  .meshb and whatever carreau_mesh_encode knows: one file, by MPI-IO, with the bytes of carreau_mesh_write
 * Files get their names when all of them are complete; an error leaves older ones as they were.
 * Errors: FILE, ARGUMENT (suffix), SEQUENCE (no mesh), on all ranks. */
CARREAU_API carreau_status carreau_mpi_write(carreau_session* session, int32_t comm, const char* path);

/* ---- Parts ---- */

/* Parts of a mesh that every rank has (carreau_part_create) make no call of MPI: every process can make the part of any rank. */

/* Divides the triangles of a mesh by recursive bisection of the coordinates of their centres (M. J. Berger, S. H. Bokhari,
 * IEEE Trans. Computers C-36 (1987)): parts differ by one triangle at most. Parts depend on the mesh and on `size` alone.
 * A vertex belongs to the least rank that has a triangle at it. Ghosts are the triangles of other ranks that touch the
 * part's own in a vertex, `layers` times (0: none). Both halves of a quadrilateral count as triangles.
 * Errors: ARGUMENT (out_part, rank, size, layers), SEQUENCE (no mesh), MEMORY; carreau_mesh_last_error has the sentence
 * of those about the mesh. */
CARREAU_API carreau_status carreau_part_create(carreau_mesh* mesh, int32_t rank, int32_t size, int32_t layers,
                                               carreau_part** out_part);
/* The mesh of a part of carreau_mesh_generate_parts, which lives as long as the part. It has places, references of faces and vertices,
 * edges of curves, faces and their status (carreau_mesh_...), and the quality of the whole mesh (carreau_mesh_part_quality).
 * Errors: ARGUMENT (NULL), SEQUENCE (the part is one of carreau_part_create, whose mesh you have). */
CARREAU_API carreau_status carreau_part_mesh(const carreau_part* part, carreau_mesh** out_mesh);
/* Writes the parts of carreau_mesh_generate_parts as carreau_mpi_write does: .pvtu, a piece for each rank, or .meshb, one file with
 * the bytes of one process, which no rank makes as a whole. The path of rank 0 counts. The session gets the sentence of an error.
 * Errors: FILE, ARGUMENT (suffix, part), SEQUENCE (a part of carreau_part_create), on all ranks. */
CARREAU_API carreau_status carreau_part_write(carreau_session* session, const carreau_part* part, int32_t comm, const char* path);
/* NULL is allowed. */
CARREAU_API void carreau_part_free(carreau_part* part);
/* Triangles and vertices of the part; own ones come first, in ascending order of their numbers in the mesh, then ghosts
 * of other ranks. Any pointer but part may be NULL. */
CARREAU_API carreau_status carreau_part_count(const carreau_part* part, int64_t* out_own_triangles, int64_t* out_triangles,
                                              int64_t* out_own_vertices, int64_t* out_vertices);
/* Copy results into arrays with room for `capacity` rows. Any array may be NULL.
 *   numbers   in the whole mesh, from 0
 *   owners    ranks
 *   layers    0: own, else the layer of the ghost
 *   vertices  rows of 3, from 0, numbered in the part
 *   rows      numbers of the same vertices that are consecutive on each rank, rank 0's first: the rows of distributed
 *             matrices of solvers
 * Errors: ARGUMENT (part, capacity). */
CARREAU_API carreau_status carreau_part_triangles(const carreau_part* part, int64_t capacity, int64_t out_numbers[],
                                                  int32_t out_owners[], int32_t out_layers[], int32_t out_vertices[]);
CARREAU_API carreau_status carreau_part_vertices(const carreau_part* part, int64_t capacity, int64_t out_numbers[],
                                                 int32_t out_owners[], int64_t out_rows[]);

/* ---- Programs ---- */

/* For programs that load this library when they run: MPI_Init_thread, unless that has been done, and the handle, rank and
 * size of MPI_COMM_WORLD. Errors: CALLBACK (MPI has failed). */
CARREAU_API carreau_status carreau_mpi_start(int32_t* out_comm, int32_t* out_rank, int32_t* out_size);
/* Before the end of such a program: waits until all ranks are here. `code` is the rank's exit code, *out_code the greatest
 * of all, *out_speaker the lowest rank that has this code and should print the reason. A rank that has failed (code > 1)
 * does not wait for others for more than `seconds`, since they may wait for it. *out_alone is 1 then, *out_speaker the
 * rank itself, and the program must print the reason and call carreau_mpi_abort. Errors: CALLBACK (MPI has failed). */
CARREAU_API carreau_status carreau_mpi_leave(int32_t code, double seconds, int32_t* out_code, int32_t* out_speaker,
                                             int32_t* out_alone);
/* The end, after carreau_mpi_leave: waits for all ranks again, so that no rank ends while it prints, and finalises MPI.
 * Errors: CALLBACK (MPI has failed). */
CARREAU_API carreau_status carreau_mpi_finish(void);
/* Ends all ranks of the program at once. */
CARREAU_API void carreau_mpi_abort(int32_t code);

#ifdef __cplusplus
}
#endif
#endif
