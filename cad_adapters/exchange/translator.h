// SPDX-License-Identifier: BSD-3-Clause
// The translators of STEP and IGES files, each of which needs libraries of OpenCASCADE that the others do not.
#pragma once

#include <Message_ProgressRange.hxx>
#include <fstream>
#include <stdexcept>
#include <string>

#include "shape_file.h"

namespace carreau_occ {

/// Shape, labels and losses of the file. Throws std::runtime_error with a sentence that names the file, or
/// Standard_Failure.
using Translator = void(const std::string& path, const Message_ProgressRange& progress, ShapeFile& file);

/// The translator of this program, or of a library that is loaded for it. Throws std::runtime_error when both are
/// missing.
Translator& step_translator();
Translator& iges_translator();

[[noreturn]] inline void refuse(const std::string& path, const std::string& why) {
  throw std::runtime_error(path + ": " + why);
}

/// Throws when a STEP file without other faces has tessellated faces: OpenCASCADE 7.6 does not translate these.
inline void refuse_tessellated(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  for (std::string line; std::getline(stream, line);)
    if (line.find("TRIANGULATED_FACE") != std::string::npos)
      refuse(path, "holds no faces but tessellated ones (TRIANGULATED_FACE), which this library does not read; carreau "
                   "mesh reads them in files of AP242, and carreau_add_triangles takes triangles");
}

[[noreturn]] inline void refuse_untranslated(const std::string& path, const char* kind, const ShapeFile& file) {
  refuse(path, std::string("the ") + kind + " file holds no shape that can be translated" +
                   (file.losses.empty() ? "" : " (" + file.losses.front() + ")"));
}

}  // namespace carreau_occ

/// The exports of the libraries of translators.
#define CARREAU_TRANSLATOR extern "C" __attribute__((visibility("default"))) void
CARREAU_TRANSLATOR carreau_translate_step(const std::string& path, const Message_ProgressRange& progress,
                                          carreau_occ::ShapeFile& file);
CARREAU_TRANSLATOR carreau_translate_iges(const std::string& path, const Message_ProgressRange& progress,
                                          carreau_occ::ShapeFile& file);
