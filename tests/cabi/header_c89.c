/* SPDX-License-Identifier: BSD-3-Clause */
/* A C89 host compiles every header: the compiler checks it with -std=c89 -pedantic -Werror. */
#include "carreau.h"
#include "carreau_atlas.h"
#include "carreau_geometry.h"
#include "carreau_remesh.h"

int main(void) {
  carreau_session* session = 0;
  carreau_status status = carreau_session_create(&session);
  carreau_session_free(session);
  return status == CARREAU_OK ? 0 : 1;
}
