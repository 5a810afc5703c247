// SPDX-License-Identifier: BSD-3-Clause
#include "cli/option_scope.h"

#include <algorithm>
#include <cstdint>
#include "base/failure.h"
#include "base/text_file.h"
#include "inputs/base/cad_input.h"
#include "inputs/built/atlas_input.h"
#include "inputs/built/formula_input.h"
#include "inputs/built/grid_input.h"
#include "inputs/built/molecule_input.h"
#include "inputs/built/triangles_input.h"
#include "inputs/open_input.h"

namespace command {
namespace {

enum Kind : std::uint8_t { cad, bezier, pardom, molecule, grid, triangles, atlas, formula, plane };

struct Scope {
  const char* option;
  std::vector<Kind> kinds;
  const char* words;  ///< after "goes with"
};

const std::vector<Scope>& scopes() {
  static const std::vector<Scope> all = {
      {"--imprint", {cad}, "a CAD file"},
      {"--imprint-tolerance", {cad}, "a CAD file"},
      {"--unit", {cad}, "a CAD file"},
      {"--min-feature", {cad}, "a CAD file"},
      {"--scale", {cad}, "a CAD file"},
      {"--loose-edges", {cad}, "a CAD file"},
      {"--embed-wires", {cad}, "a CAD file"},
      {"--host", {pardom}, "a .pardom file"},
      {"--probe", {molecule}, "a molecule"},
      {"--radii", {molecule}, "a molecule"},
      {"--drop-cavities", {molecule}, "a molecule"},
      {"--surface", {molecule, atlas}, "a molecule, or with triangles as --surface atlas"},
      {"--reach", {atlas}, "--surface atlas"},
      {"--border", {atlas}, "--surface atlas"},
      {"--smooth", {grid}, "a grid"},
      {"--lengths", {grid}, "a grid"},
      {"--join", {grid}, "a grid"},
      {"--fill", {grid}, "a grid"},
      {"--step", {grid}, "a grid"},
      {"--continuity", {grid}, "a grid"},
      {"--ridges", {grid}, "a grid"},
      {"--join-nodes", {grid}, "a grid"},
      {"--domain", {formula}, "a surface by formulas"},
      {"--sharp", {triangles}, "triangles"},
      {"--corner", {triangles}, "triangles"},
      {"--given-edges", {triangles}, "triangles"},
      {"--ignore-references", {triangles}, "triangles"},
  };
  return all;
}

Kind kind_of(const std::string& input, const InputChoice& choice, bool is_plane) {
  if (is_plane) return plane;
  if (is_formula(input)) return formula;
  if (needs_host(input)) return pardom;
  if (is_grid(input, choice.grid)) return grid;
  if (is_triangles(input)) return choice.molecule.surface == atlas_surface ? atlas : triangles;
  if (is_molecule(input)) return molecule;
  return suffix_of(input) == ".bpt" ? bezier : cad;
}

/// Files of `carreau fields` may be .env, and an atlas names the missing option itself.
bool is_checked_elsewhere(const CLI::App& sub, const Scope& scope, const InputChoice& choice) {
  const std::string option = scope.option;
  return (option == "--host" && sub.get_name() == "fields") ||
         (option == "--surface" && choice.molecule.surface == atlas_surface);
}

bool is_given(const CLI::App& sub, const char* name) {
  const CLI::Option* option = sub.get_option_no_throw(name);
  return option != nullptr && option->count() > 0;
}

}  // namespace

void check_scope(const CLI::App& sub, const std::vector<std::string>& inputs, const InputChoice& choice, bool is_plane) {
  for (const Scope& scope : scopes()) {
    if (!is_given(sub, scope.option) || is_checked_elsewhere(sub, scope, choice)) continue;
    // --smooth of a plane domain makes splines; `carreau adapt` knows no other.
    const bool splines = std::string("--smooth") == scope.option && (sub.get_name() == "adapt" || sub.get_name() == "plane");
    const auto fits = [&](const std::string& input) {
      const Kind kind = kind_of(input, choice, is_plane);
      return splines ? kind == plane : std::find(scope.kinds.begin(), scope.kinds.end(), kind) != scope.kinds.end();
    };
    if (std::any_of(inputs.begin(), inputs.end(), fits)) continue;
    throw Failure(std::string(scope.option) + " goes with " + (splines ? "a plane domain" : scope.words) + ", not with '" +
                  inputs.front() + "'.");
  }
}

}  // namespace command
