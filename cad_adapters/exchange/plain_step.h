// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <StepSelect_WorkLibrary.hxx>

namespace carreau_occ {

/// Reads STEP files of plain syntax (ISO 10303-21) by a scanner of its own, which takes a twentieth of the time, and
/// leaves all others to OpenCASCADE's, with what that says of their errors. The model is the same.
class PlainStepLibrary final : public StepSelect_WorkLibrary {
 public:
  PlainStepLibrary() : StepSelect_WorkLibrary(Standard_False) {}

  Standard_Integer ReadFile(Standard_CString path, Handle(Interface_InterfaceModel) & model,
                            const Handle(Interface_Protocol) & protocol) const override;

  /// The same without what OpenCASCADE reads. False: the file is not plain.
  [[nodiscard]] static bool read_plain(Standard_CString path, Handle(Interface_InterfaceModel) & model,
                                       const Handle(Interface_Protocol) & protocol);
};

}  // namespace carreau_occ
