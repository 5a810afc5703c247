// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <StepSelect_WorkLibrary.hxx>
#include <string>
#include <vector>

namespace carreau_occ {

/// Reads STEP files of plain syntax (ISO 10303-21) by a scanner of its own, which takes a twentieth of the time, and
/// leaves all others to OpenCASCADE's, with what that says of their errors. The model is the same.
class PlainStepLibrary final : public StepSelect_WorkLibrary {
 public:
  PlainStepLibrary() : StepSelect_WorkLibrary(Standard_False) {}

  Standard_Integer ReadFile(Standard_CString path, Handle(Interface_InterfaceModel) & model,
                            const Handle(Interface_Protocol) & protocol) const override;

  /// The same without what OpenCASCADE reads. False: the file is not plain. With `mended`, names
  /// that are no text become empty, missing names are added, and attributes behind the last known one are dropped; it gets
  /// the entities, "#12".
  [[nodiscard]] static bool read_plain(Standard_CString path, Handle(Interface_InterfaceModel) & model,
                                       const Handle(Interface_Protocol) & protocol,
                                       std::vector<std::string>* mended = nullptr);

  /// Returns a sentence about the entities that were mended; "": none was.
  [[nodiscard]] std::string note() const;

 private:
  mutable std::vector<std::string> mended_;  // the base class reads by a constant function
};

}  // namespace carreau_occ
