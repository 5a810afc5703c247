// SPDX-License-Identifier: BSD-3-Clause
// bl2d: meshes of plane domains as BL2D-V2 made them, step by step of an adaptation. Exit codes: 0 done, 2 not.
#include <cstdio>
#include <exception>
#include <string>

#include "bl2d_run.h"

int main(int argc, char** argv) {
  const std::string path = argc > 1 ? argv[1] : "bl2d.env";
  if (argc > 2 || path.starts_with("-")) {
    std::fputs("usage: bl2d [ENV]\nENV: pairs of a name and a value; bl2d.env by default. Manual: man bl2d\n", stderr);
    return 2;
  }
  try {
    bl2d::run(bl2d::read_env(path));
    return std::fflush(stdout) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bl2d: %s\n", error.what());
  }
  return 2;
}
