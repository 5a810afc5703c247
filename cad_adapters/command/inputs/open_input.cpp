// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/open_input.h"
#include "base/failure.h"
#include "base/text_file.h"
#include "inputs/base/cad_input.h"
#include "inputs/base/model_input.h"
#include "inputs/built/atlas_input.h"
#include "inputs/built/bezier_input.h"
#include "inputs/built/formula_input.h"
#include "inputs/built/grid_input.h"
#include "inputs/built/molecule_input.h"
#include "inputs/built/triangles_input.h"
#include "inputs/cad/open_cad.h"
#include "inputs/host/pardom_input.h"

namespace command {

bool needs_host(const std::string& path) { return suffix_of(path) == ".pardom"; }

void check_geometry_name(const std::string& path) {
  if (path.empty()) throw Failure("The name of the input is empty.");
}

std::unique_ptr<CadInput> open_input(const std::string& path, const InputChoice& choice,
                                     const ReadingProgress& progress) {
  if (is_formula(path)) return open_formula(path, choice.domain);
  if (choice.molecule.surface == atlas_surface) return open_atlas(path, choice.atlas);
  check_geometry_name(path);
  if (needs_host(path)) {
    if (choice.host.empty()) throw Failure("'" + path + "' has no geometry: --host names the shared library that has.");
    return open_pardom(path, choice.host);
  }
  if (is_grid(path, choice.grid)) return open_grid(path, choice.grid);
  if (is_triangles(path)) return open_triangles(path, choice.triangles);
  if (is_molecule(path)) return open_molecule(path, choice.molecule);
  return suffix_of(path) == ".bpt" ? open_bezier(path) : open_cad(path, choice.cad, progress);
}

}  // namespace command
