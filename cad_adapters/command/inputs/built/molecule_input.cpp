// SPDX-License-Identifier: BSD-3-Clause
// Molecules, whose surfaces the library evaluates itself.
#include "inputs/built/molecule_input.h"

#include <carreau_geometry.h>

#include <algorithm>

#include "base/failure.h"
#include "base/text_file.h"
#include "inputs/base/built_input.h"

namespace command {
namespace {

carreau_molecule_options options_of(const MoleculeChoice& choice) {
  carreau_molecule_options options{};
  options.struct_size = sizeof options;
  options.surface = choice.surface == "vws" ? CARREAU_VWS : choice.surface == "sas" ? CARREAU_SAS : CARREAU_SES;
  options.drop_cavities = choice.drop_cavities ? 1 : 0;
  options.probe = choice.probe;
  options.radii = choice.radii.empty() ? nullptr : choice.radii.c_str();
  return options;
}

class MoleculeInput final : public BuiltInput {
 public:
  MoleculeInput(SessionHandle session, const std::string& path, const MoleculeChoice& choice)
      : BuiltInput(std::move(session), path), path_(path), choice_(choice) {}

  carreau_status give_to(carreau_session* session) override {
    const carreau_molecule_options options = options_of(choice_);
    return carreau_load_molecule(session, &options, path_.c_str());
  }

  [[nodiscard]] std::string summary() const override {
    carreau_molecule_measures measures{};
    measures.struct_size = sizeof measures;
    ask([&](carreau_session* session) { require(session, carreau_molecule_measure(session, &measures)); });
    return std::to_string(measures.atoms) + " atoms, " + std::to_string(measures.exposed_atoms) + " exposed, " +
           ModelInput::summary();
  }

  [[nodiscard]] bool closed() const override { return true; }

  /// Short arcs are exact, and no mistake of a file.
  [[nodiscard]] double ends_tolerance() const override { return 1e-9 * diagonal(); }

 private:
  [[nodiscard]] std::string kind(std::int32_t) const override { return "sphere"; }

  std::string path_;
  MoleculeChoice choice_;
};

}  // namespace

bool is_molecule(const std::string& path) {
  const std::string suffix = suffix_of(path);
  return std::any_of(std::begin(molecule_suffixes), std::end(molecule_suffixes),
                     [&](const char* known) { return suffix == known; });
}

void load_molecule(carreau_session* session, const std::string& path, const MoleculeChoice& choice) {
  const carreau_molecule_options options = options_of(choice);
  require(session, carreau_load_molecule(session, &options, path.c_str()));
}

std::unique_ptr<CadInput> open_molecule(const std::string& path, const MoleculeChoice& choice) {
  SessionHandle session = make_silent_session();
  load_molecule(session.get(), path, choice);
  return std::make_unique<MoleculeInput>(std::move(session), path, choice);
}

}  // namespace command
