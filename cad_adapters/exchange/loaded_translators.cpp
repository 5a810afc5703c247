// SPDX-License-Identifier: BSD-3-Clause
// Translators in libraries beside this one, loaded when a file needs one: OpenCASCADE's toolkits for STEP take longer
// to load than many a BREP file to mesh.
#include <dlfcn.h>

#include "translator.h"

namespace carreau_occ {
namespace {

Translator* load(const char* file, const char* function, const char* kind) {
  void* const library = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
  void* const found = library != nullptr ? dlsym(library, function) : nullptr;
  if (found == nullptr)
    throw std::runtime_error(std::string(kind) + " files need " + file + ", which cannot be loaded: " + dlerror());
  return reinterpret_cast<Translator*>(found);
}

}  // namespace

Translator& step_translator() {
  static Translator* const translator = load(CARREAU_STEP_LIBRARY, "carreau_translate_step", "STEP");
  return *translator;
}

Translator& iges_translator() {
  static Translator* const translator = load(CARREAU_IGES_LIBRARY, "carreau_translate_iges", "IGES");
  return *translator;
}

}  // namespace carreau_occ
