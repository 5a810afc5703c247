// SPDX-License-Identifier: BSD-3-Clause
// Parts of STEP files: the items of translated shapes in a document, with names and colours of the file.
#pragma once

#include <StepBasic_ProductDefinition.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_WorkSession.hxx>
#include <map>
#include <vector>

#include "document.h"

namespace carreau_occ {

/// A file that was translated, and the items of its shapes.
struct StepParts {
  Handle(XSControl_WorkSession) session;
  Handle(Transfer_TransientProcess) process;
  Document& document;
  TopTools_DataMapOfShapeInteger& items;
  struct Product {
    TopoDS_Shape shape;
    Handle(StepBasic_ProductDefinition) definition;
    int elsewhere = Document::none;  // its item, when another file holds it
  };
  std::vector<Product> products{};                                      // that have shapes
  std::map<const StepBasic_ProductDefinition*, std::size_t> numbers{};  // of them

  /// The shapes of an entity; none: nothing.
  [[nodiscard]] int item_of(const Handle(Standard_Transient) & entity) const;
};

/// Surfaces get the colours of the styles that the file gives to faces, solids, parts and parts in assemblies.
void read_step_colours(const StepParts& parts);
/// Names of products, and of where they are used.
void read_step_names(const StepParts& parts);
/// Names of solids, shells, faces, edges and vertices.
void read_step_names_inside(const StepParts& parts);
/// Layers of parts, solids, shells and faces.
void read_step_layers(const StepParts& parts);

}  // namespace carreau_occ
