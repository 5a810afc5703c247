// SPDX-License-Identifier: BSD-3-Clause
// Translators and changes of shapes in libraries beside this one, loaded when a file needs one: OpenCASCADE's toolkits
// for them take longer to load than many a BREP file to mesh.
#include <dlfcn.h>

#include "changes/shape_changes.h"
#include "translator.h"

namespace carreau_occ {
namespace {

void* load(const char* file, const char* function, const char* needed_by) {
  void* const library = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
  void* const found = library != nullptr ? dlsym(library, function) : nullptr;
  if (found == nullptr)
    throw std::runtime_error(std::string(needed_by) + " need " + file + ", which cannot be loaded: " + dlerror());
  return found;
}

Translator* load_translator(const char* file, const char* function, const char* needed_by) {
  return reinterpret_cast<Translator*>(load(file, function, needed_by));
}

}  // namespace

Translator& step_translator() {
  static Translator* const translator = load_translator(CARREAU_STEP_LIBRARY, "carreau_translate_step", "STEP files");
  return *translator;
}

Translator& iges_translator() {
  static Translator* const translator = load_translator(CARREAU_IGES_LIBRARY, "carreau_translate_iges", "IGES files");
  return *translator;
}

const ShapeChanges& shape_changes() {
  static const ShapeChanges* const changes = reinterpret_cast<decltype(&carreau_shape_changes)>(
      load(CARREAU_CHANGES_LIBRARY, "carreau_shape_changes", "Imprints, mirrors and small features"))();
  return *changes;
}

}  // namespace carreau_occ
