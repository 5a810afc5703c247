// SPDX-License-Identifier: BSD-3-Clause
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Interface_InterfaceModel.hxx>
#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepBasic_ProductDefinitionRelationship.hxx>
#include <StepBasic_ProductDefinitionWithAssociatedDocuments.hxx>
#include <StepRepr_CharacterizedDefinition.hxx>
#include <StepRepr_HArray1OfRepresentationItem.hxx>
#include <StepRepr_NextAssemblyUsageOccurrence.hxx>
#include <StepRepr_ProductDefinitionShape.hxx>
#include <StepRepr_RepresentationRelationship.hxx>
#include <StepShape_ClosedShell.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_Face.hxx>
#include <StepShape_HArray1OfFace.hxx>
#include <StepShape_HArray1OfShell.hxx>
#include <StepShape_ManifoldSolidBrep.hxx>
#include <StepShape_OpenShell.hxx>
#include <StepShape_ShapeDefinitionRepresentation.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <StepShape_Shell.hxx>
#include <StepShape_ShellBasedSurfaceModel.hxx>
#include <StepShape_VertexPoint.hxx>
#include <StepVisual_LayeredItem.hxx>
#include <StepVisual_PresentationLayerAssignment.hxx>
#include <StepVisual_StyledItem.hxx>
#include <StepVisual_StyledItemTarget.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Iterator.hxx>
#include <TransferBRep.hxx>
#include <initializer_list>
#include <set>

#include "entity_kinds.h"
#include "step_parts.h"
#include "text_of_file.h"

namespace carreau_occ {
namespace {

using Text = Handle(TCollection_HAsciiString);

/// The first text with a content, or else the last text.
std::string first_of(std::initializer_list<Text> texts) {
  for (const Text& text : texts)
    if (!text.IsNull() && text->UsefullLength() > 0) return utf8(text->String());
  const Text& last = *(texts.end() - 1);
  return last.IsNull() ? "" : utf8(last->String());
}

std::string name_of(const StepBasic_ProductDefinition& definition) {
  if (definition.Formation().IsNull()) return "";
  const Handle(StepBasic_Product) product = definition.Formation()->OfProduct();
  return product.IsNull() ? "" : first_of({product->Name(), product->Id()});
}

std::string name_of(const Handle(StepRepr_NextAssemblyUsageOccurrence) & use, const StepParts& parts) {
  std::string name;
  for (Interface_EntityIterator up = parts.session->Graph().Sharings(use); up.More(); up.Next()) {
    const auto shape = Handle(StepRepr_ProductDefinitionShape)::DownCast(up.Value());
    if (shape.IsNull()) continue;
    const Handle(StepBasic_ProductDefinitionRelationship) relation =
        shape->Definition().ProductDefinitionRelationship();
    if (relation.IsNull()) continue;
    const Text description = relation->HasDescription() ? relation->Description() : Text();
    name = first_of({description, relation->Name(), relation->Id()});
  }
  return name;
}

/// The representation of a product's own shape.
Handle(StepShape_ShapeRepresentation) representation_of(const StepParts::Product& product, const StepParts& parts) {
  Interface_EntityIterator up =
      parts.session->Graph().TypedSharings(product.definition, STANDARD_TYPE(StepShape_ShapeDefinitionRepresentation));
  for (; up.More(); up.Next())
    if (const auto definition = Handle(StepShape_ShapeDefinitionRepresentation)::DownCast(up.Value());
        !definition.IsNull())
      return Handle(StepShape_ShapeRepresentation)::DownCast(definition->UsedRepresentation());
  return nullptr;
}

/// Names the shapes in the item of one product.
class Inside {
 public:
  Inside(const StepParts& parts, int item) : parts_(parts), item_(item) {}

  /// Takes its items, and the items of representations that the file calls a part of it.
  void take(const Handle(StepShape_ShapeRepresentation) & representation) {
    if (!seen_.insert(representation.get()).second) return;
    if (const auto items = representation->Items(); !items.IsNull())
      for (const Handle(StepRepr_RepresentationItem) & item : *items) {
        if (const auto solid = Handle(StepShape_ManifoldSolidBrep)::DownCast(item); !solid.IsNull())
          solids_.push_back(solid);
        if (const auto model = Handle(StepShape_ShellBasedSurfaceModel)::DownCast(item); !model.IsNull())
          models_.push_back(model);
      }
    Interface_EntityIterator up =
        parts_.session->Graph().TypedSharings(representation, STANDARD_TYPE(StepRepr_RepresentationRelationship));
    for (; up.More(); up.Next()) {
      const auto relation = Handle(StepRepr_RepresentationRelationship)::DownCast(up.Value());
      if (relation.IsNull() || relation->Rep1() != representation) continue;
      const auto other = Handle(StepShape_ShapeRepresentation)::DownCast(relation->Rep2());
      if (!other.IsNull()) take(other);
    }
  }

  void name() const {
    for (const Handle(StepShape_ManifoldSolidBrep) & solid : solids_) {
      if (solids_.size() > 1) name(solid);  // a lone one is the product
      name_shell(solid->Outer());
    }
    for (const Handle(StepShape_ShellBasedSurfaceModel) & model : models_) {
      if (model->SbsmBoundary().IsNull()) continue;
      for (const StepShape_Shell& shell : *model->SbsmBoundary())
        if (!shell.OpenShell().IsNull())
          name_shell(shell.OpenShell());
        else
          name_shell(shell.ClosedShell());
    }
  }

 private:
  void name(const Handle(StepRepr_RepresentationItem) & entity) const {
    if (entity.IsNull() || entity->Name().IsNull() || entity->Name()->IsEmpty()) return;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(parts_.process->Find(entity));
    if (shape.IsNull()) return;
    const int inside = parts_.document.add_inside(item_, shape);
    if (inside == Document::none) return;
    parts_.document.set_name(inside, utf8(entity->Name()->String()));
    parts_.document.set_shape(inside, shape);
  }

  void name_shell(const Handle(StepShape_ConnectedFaceSet) & shell) const {
    if (shell.IsNull()) return;
    name(shell);
    if (shell->CfsFaces().IsNull()) return;
    for (const Handle(StepShape_Face) & face : *shell->CfsFaces()) name(face);
  }

  const StepParts& parts_;
  int item_;
  std::set<const void*> seen_;
  std::vector<Handle(StepShape_ManifoldSolidBrep)> solids_;
  std::vector<Handle(StepShape_ShellBasedSurfaceModel)> models_;
};

void name_edges_and_vertices(const StepParts& parts) {
  const Handle(Interface_InterfaceModel) model = parts.session->Model();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = model->Value(i);
    if (!entity->IsKind(STANDARD_TYPE(StepShape_EdgeCurve)) && !entity->IsKind(STANDARD_TYPE(StepShape_VertexPoint))) continue;
    const auto named = Handle(StepRepr_RepresentationItem)::DownCast(entity);
    if (named->Name().IsNull() || named->Name()->IsEmpty()) continue;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(parts.process->Find(entity));
    const int item = shape.IsNull() ? Document::none : parts.document.find_small(shape);
    if (item != Document::none) parts.document.set_name(item, utf8(named->Name()->String()));
  }
}

/// A style stands for the entity that it styles.
void set_layer(const Handle(Standard_Transient) & entity, const std::string& layer, const StepParts& parts) {
  if (entity.IsNull()) return;
  if (const auto style = Handle(StepVisual_StyledItem)::DownCast(entity); !style.IsNull())
    return set_layer(style->ItemAP242().Value(), layer, parts);
  const TopoDS_Shape shape = TransferBRep::ShapeResult(parts.process->Find(entity));
  if (shape.IsNull() || shape.ShapeType() > TopAbs_FACE) return;
  if (const int item = parts.document.find(shape, true); item != Document::none) return parts.document.set_layer(item, layer);
  for (TopoDS_Iterator it(shape); it.More(); it.Next())
    if (const int item = it.Value().ShapeType() > TopAbs_FACE ? Document::none : parts.document.find(it.Value(), true); item != Document::none)
      parts.document.set_layer(item, layer);
}

}  // namespace

void read_step_names(const StepParts& parts) {
  const Handle(Interface_InterfaceModel) model = parts.session->Model();
  const auto set = [&](int item, const std::string& name) {
    if (item != Document::none) parts.document.set_name(item, name);
  };
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = model->Value(i);
    if (entity->IsInstance(STANDARD_TYPE(StepRepr_NextAssemblyUsageOccurrence))) {
      const auto use = Handle(StepRepr_NextAssemblyUsageOccurrence)::DownCast(entity);
      set(parts.item_of(use), name_of(use, parts));
    } else if (entity->IsInstance(STANDARD_TYPE(StepBasic_ProductDefinition)) ||
               entity->IsInstance(STANDARD_TYPE(StepBasic_ProductDefinitionWithAssociatedDocuments))) {
      const auto definition = Handle(StepBasic_ProductDefinition)::DownCast(entity);
      const auto found = parts.numbers.find(definition.get());
      const int elsewhere = found != parts.numbers.end() ? parts.products[found->second].elsewhere : Document::none;
      set(elsewhere != Document::none ? elsewhere : parts.item_of(definition), name_of(*definition));
    }
  }
}

void read_step_names_inside(const StepParts& parts) {
  for (const StepParts::Product& product : parts.products) {
    const Handle(StepShape_ShapeRepresentation) representation = representation_of(product, parts);
    int item = Document::none;
    if (representation.IsNull() || !parts.items.Find(product.shape, item) || parts.document.is_assembly(item)) continue;
    Inside inside(parts, item);
    inside.take(representation);
    inside.name();
  }
  name_edges_and_vertices(parts);
}

void read_step_layers(const StepParts& parts) {
  const Handle(Interface_InterfaceModel) model = parts.session->Model();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto layer = as<StepVisual_PresentationLayerAssignment>(model->Value(i));
    if (layer.IsNull() || layer->Name().IsNull() || layer->AssignedItems().IsNull()) continue;
    const std::string name = utf8(layer->Name()->String());
    for (int k = 1; k <= layer->NbAssignedItems() && !name.empty(); ++k) set_layer(layer->AssignedItemsValue(k).Value(), name, parts);
  }
}

}  // namespace carreau_occ
