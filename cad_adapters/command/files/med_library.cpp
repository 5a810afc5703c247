// SPDX-License-Identifier: BSD-3-Clause
#include "files/med_library.h"

#include <dlfcn.h>

#include <string>

#include "base/failure.h"
#include "files/med_file.h"

namespace command {
namespace {

void* function(void* library, const char* name) {
  if (void* const found = dlsym(library, name)) return found;
  throw Failure(std::string(CARREAU_MED_LOADED " is of another version: it has no ") + name + ".");
}

MedLibrary load() {
  void* const library = dlopen(CARREAU_MED_LOADED, RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr)
    throw Failure(std::string("Files .med need the MED library, which cannot be loaded: ") + dlerror() + ".");
  MedLibrary functions;
#define CARREAU_MED_FUNCTION(name) \
  functions.name = reinterpret_cast<decltype(functions.name)>(function(library, "MED" #name));
#include "files/med_functions.h"
#undef CARREAU_MED_FUNCTION
  return functions;
}

}  // namespace

const MedLibrary& med_library() {
  static const MedLibrary library = load();
  return library;
}

void require_med() { med_library(); }

}  // namespace command
