/* SPDX-License-Identifier: BSD-3-Clause */
/* For LD_PRELOAD: each file takes SLOW_RENAME microseconds to get its name. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <unistd.h>

int rename(const char* from, const char* to) {
  int (*const real)(const char*, const char*) = (int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename");
  const char* const wait = getenv("SLOW_RENAME");
  const int status = real(from, to);
  /* A signal that comes here interrupts a sleep. */
  if (wait != NULL) usleep((useconds_t)atoi(wait));
  return status;
}
