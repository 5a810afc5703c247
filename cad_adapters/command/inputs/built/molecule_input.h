// SPDX-License-Identifier: BSD-3-Clause
// Molecules as geometry, and their areas.
#pragma once

#include <memory>
#include <string>

#include "files/session_handle.h"
#include "inputs/base/input_choice.h"

namespace command {

class CadInput;

inline constexpr const char* molecule_suffixes[] = {".xyzr", ".xyz", ".pdb", ".ent", ".cif", ".mmcif"};
inline constexpr const char* molecule_surfaces[] = {"vws", "sas", "ses"};

/// True if the suffix belongs to molecules.
bool is_molecule(const std::string& path);

/// Throws Failure with the library's sentence.
void load_molecule(carreau_session* session, const std::string& path, const MoleculeChoice& choice);

/// Throws Failure.
std::unique_ptr<CadInput> open_molecule(const std::string& path, const MoleculeChoice& choice);

}  // namespace command
