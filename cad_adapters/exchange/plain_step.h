// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <StepSelect_WorkLibrary.hxx>
#include <string>
#include <vector>

namespace carreau_occ {

/// Reads STEP files of plain syntax (ISO 10303-21) by its own scanner, which takes a twentieth of the time.
/// OpenCASCADE's scanner reads all other files, and reports their errors. The model is the same.
class PlainStepLibrary final : public StepSelect_WorkLibrary {
 public:
  PlainStepLibrary() : StepSelect_WorkLibrary(Standard_False) {}

  Standard_Integer ReadFile(Standard_CString path, Handle(Interface_InterfaceModel) & model,
                            const Handle(Interface_Protocol) & protocol) const override;

  /// Reads plain files only. False: the file is not plain. With `mended`, names that are not texts become empty,
  /// missing names are added, and attributes behind the last known attribute are dropped; it gets the entities, "#12".
  [[nodiscard]] static bool read_plain(Standard_CString path, Handle(Interface_InterfaceModel) & model,
                                       const Handle(Interface_Protocol) & protocol,
                                       std::vector<std::string>* mended = nullptr);

  /// Returns a sentence about the repaired entities; "": none.
  [[nodiscard]] std::string note() const;

 private:
  mutable std::vector<std::string> mended_;  // the base class reads by a constant function
};

}  // namespace carreau_occ
