// SPDX-License-Identifier: BSD-3-Clause
// A STEP, IGES or BREP file of carreau_cad.h for as long as a command needs it.
#pragma once

#include <carreau_cad.h>

#include <memory>
#include <string>
#include <vector>

#include "inputs/base/cad_input.h"
#include "inputs/cad/cad_library.h"

namespace command {

struct CloseCadFile {
  void operator()(carreau_cad_file* file) const noexcept { cad_library().close(file); }
};
using CadFileHandle = std::unique_ptr<carreau_cad_file, CloseCadFile>;

/// Throws Failure with the sentence of the last call on `file` when `status` is an error.
void require(carreau_cad_file* file, carreau_status status);

/// Faults of OpenCASCADE are errors of faces. Throws Failure.
CadFileHandle read_cad(const std::string& path, const CadChoice& choice, const ReadingProgress& progress = {});

carreau_cad_content content_of(carreau_cad_file* file);
std::vector<FaceLook> faces_of(carreau_cad_file* file);
std::vector<std::string> losses_of(carreau_cad_file* file);
std::vector<std::string> notes_of(carreau_cad_file* file);
/// The features that --min-feature found: a line each.
std::vector<std::string> small_features_of(carreau_cad_file* file);
/// Solids whose faces lie on each other.
std::vector<carreau_cad_contact> contacts_of(carreau_cad_file* file);
/// Assemblies, parts, solids, and entities with a name, a colour or a layer of their own.
std::vector<carreau_cad_tree_row> tree_of(carreau_cad_file* file);
/// Looks for dangers; they are in the order of the report.
carreau_cad_report inspect(carreau_cad_file* file);
std::vector<carreau_cad_danger> dangers_of(carreau_cad_file* file, const carreau_cad_report& report);

}  // namespace command
