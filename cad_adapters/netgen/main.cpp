// SPDX-License-Identifier: BSD-3-Clause
// carreau_netgen SURFACE.vol FILLED.vol LARGEST_SIZE: fills the domains of a surface by Netgen's library (nglib, LGPL). `carreau volume
// --engine netgen` runs it.
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace nglib {
#include <nglib.h>
}

int main(int argc, char** argv) {
  if (argc != 4) return std::fputs("usage: carreau_netgen SURFACE.vol FILLED.vol LARGEST_SIZE\n", stderr), 2;
  try {
    nglib::Ng_Init();
    nglib::Ng_Mesh* const mesh = nglib::Ng_LoadMesh(argv[1]);
    if (mesh == nullptr) return std::fprintf(stderr, "%s cannot be read\n", argv[1]), 1;
    nglib::Ng_Meshing_Parameters parameters;
    parameters.maxh = std::strtod(argv[3], nullptr);
    const nglib::Ng_Result result = nglib::Ng_GenerateVolumeMesh(mesh, &parameters);
    if (result != nglib::NG_OK) return std::fprintf(stderr, "Netgen reports error %d\n", static_cast<int>(result)), 1;
    nglib::Ng_SaveMesh(mesh, argv[2]);
    std::fflush(nullptr);
    std::_Exit(0);  // destructors of Debian's nglib 6.2.1905 free an invalid pointer
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
  return 0;
}
