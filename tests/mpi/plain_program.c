/* SPDX-License-Identifier: BSD-3-Clause */
/* plain_program TEAPOT OUT: a rank of a program that does not include mpi.h: libcarreau_mpi starts and ends MPI. */
#include <carreau_geometry.h>
#include <carreau_mpi.h>
#include <stdio.h>

static int32_t run(carreau_session* session, int32_t comm, const char* teapot, const char* out) {
  if (carreau_load_bezier(session, teapot) != CARREAU_OK || carreau_set_real(session, "hphydef", 0.3) != CARREAU_OK ||
      carreau_mpi_attach(session, comm) != CARREAU_OK || carreau_mesh_generate(session) != CARREAU_OK)
    return 2;
  return carreau_mpi_write(session, comm, out) == CARREAU_OK ? 0 : 2;
}

int main(int count, char** arguments) {
  int32_t comm = 0, rank = 0, size = 0, code = 2, speaker = 0, alone = 0;
  carreau_session* session = NULL;
  if (count != 3 || carreau_session_create(&session) != CARREAU_OK) return 2;
  if (carreau_mpi_start(&comm, &rank, &size) != CARREAU_OK) return 2;
  const int32_t mine = run(session, comm, arguments[1], arguments[2]);
  if (carreau_mpi_leave(mine, 5, &code, &speaker, &alone) != CARREAU_OK) return 2;
  if (code != 0 && rank == speaker) fprintf(stderr, "rank %d of %d: %s\n", (int)rank, (int)size, carreau_last_error(session));
  if (alone) carreau_mpi_abort(code); /* the others wait for this rank somewhere */
  carreau_session_free(session);
  if (carreau_mpi_finish() != CARREAU_OK) return 2;
  return code;
}
