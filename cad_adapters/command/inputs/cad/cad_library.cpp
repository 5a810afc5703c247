// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/cad/cad_library.h"

#if defined(CARREAU_CAD_LOADED)
#include <dlfcn.h>

#include <string>

#include "base/failure.h"
#endif

namespace command {
namespace {

#if defined(CARREAU_CAD_LOADED)
void* function(void* library, const char* name) {
  if (void* const found = dlsym(library, name)) return found;
  throw Failure(std::string("libcarreau_cad is of another version: it has no ") + name + ".");
}

CadLibrary load() {
  void* const library = dlopen(CARREAU_CAD_LOADED, RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) throw Failure(std::string("CAD files need libcarreau_cad, which cannot be loaded: ") + dlerror() + ".");
  CadLibrary functions;
#define CARREAU_CAD_FUNCTION(name) \
  functions.name = reinterpret_cast<decltype(functions.name)>(function(library, "carreau_cad_" #name));
#include "inputs/cad/cad_functions.h"
#undef CARREAU_CAD_FUNCTION
  return functions;
}
#else
CadLibrary load() {
  CadLibrary functions;
#define CARREAU_CAD_FUNCTION(name) functions.name = &carreau_cad_##name;
#include "inputs/cad/cad_functions.h"
#undef CARREAU_CAD_FUNCTION
  return functions;
}
#endif

}  // namespace

const CadLibrary& cad_library() {
  static const CadLibrary library = load();
  return library;
}

}  // namespace command
