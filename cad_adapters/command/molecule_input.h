// SPDX-License-Identifier: BSD-3-Clause
// Molecules as geometry, and their areas.
#pragma once

#include <memory>
#include <string>

#include "session_handle.h"

namespace command {

class CadInput;

/// Which surface of a molecule.
struct MoleculeChoice {
  std::string surface = "vws";  ///< one of molecule_surfaces
  double probe = 1.4;
  bool drop_cavities = false;
  std::string radii = {};  ///< file of radii; empty: none
};

inline constexpr const char* molecule_suffixes[] = {".xyzr", ".xyz", ".pdb", ".ent", ".cif", ".mmcif"};
inline constexpr const char* molecule_surfaces[] = {"vws", "sas", "ses"};

/// Whether the suffix is that of a molecule.
bool is_molecule(const std::string& path);

/// Throws Failure with the library's sentence.
void load_molecule(carreau_session* session, const std::string& path, const MoleculeChoice& choice);

/// Throws Failure.
std::unique_ptr<CadInput> open_molecule(const std::string& path, const MoleculeChoice& choice);

}  // namespace command
