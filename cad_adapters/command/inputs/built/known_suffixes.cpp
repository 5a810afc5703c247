// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/built/known_suffixes.h"

#include <iterator>

#include "base/text_file.h"
#include "inputs/built/grid_input.h"
#include "inputs/built/molecule_input.h"
#include "inputs/built/plane_input.h"
#include "inputs/built/triangles_input.h"

namespace command {
namespace {

template <typename List>
std::string listed(const List& suffixes) {
  std::string text;
  for (const char* suffix : suffixes) text.append(text.empty() ? "" : ", ").append(suffix);
  return text;
}

std::string beginning(const std::string& path) {
  const std::string suffix = suffix_of(path);
  return "'" + path + "' cannot be read: " + (suffix.empty() ? "it has no suffix. " : "the suffix " + suffix + " is not known. ");
}

}  // namespace

std::string unknown_geometry(const std::string& path) {
  const char* const cad[] = {".step", ".stp", ".iges", ".igs", ".brep", ".brp"};
  std::string text = beginning(path) + "These are read: " + listed(cad) + " (CAD); " + listed(triangles_suffixes) +
                     " (triangles); " + listed(molecule_suffixes) + " (molecules); " + listed(grid_suffixes) +
                     " (grids); .bpt (Bezier patches); .pardom (with --host).";
  if (is_plane_file(path)) text += " The command plane reads " + suffix_of(path) + ".";
  return text;
}

std::string unknown_triangles(const std::string& path) {
  return beginning(path) + "These are read as triangles: " + listed(triangles_suffixes) + ".";
}

}  // namespace command
