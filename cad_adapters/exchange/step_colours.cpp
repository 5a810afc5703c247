// SPDX-License-Identifier: BSD-3-Clause
#include <Interface_EntityIterator.hxx>
#include <STEPConstruct_Styles.hxx>
#include <StepRepr_CharacterizedDefinition.hxx>
#include <StepRepr_NextAssemblyUsageOccurrence.hxx>
#include <StepRepr_ProductDefinitionShape.hxx>
#include <StepRepr_RepresentedDefinition.hxx>
#include <StepRepr_SpecifiedHigherUsageOccurrence.hxx>
#include <StepShape_ShapeDefinitionRepresentation.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <StepVisual_Colour.hxx>
#include <StepVisual_PresentationStyleByContext.hxx>
#include <StepVisual_StyleContextSelect.hxx>
#include <StepVisual_StyledItem.hxx>
#include <StepVisual_StyledItemTarget.hxx>
#include <TopoDS_Iterator.hxx>
#include <TransferBRep.hxx>

#include "step_parts.h"

namespace carreau_occ {
namespace {

struct Style {
  Handle(StepVisual_Colour) surface, boundary, curve, rendered;
  double transparency = 0;
  bool of_component = false;

  Style(const STEPConstruct_Styles& styles, const Handle(StepVisual_StyledItem) & item) {
    found = styles.GetColors(item, surface, boundary, curve, rendered, transparency, of_component);
  }
  bool found = false;

  /// The colour of rendering, or else the colour of the surface.
  [[nodiscard]] std::optional<Quantity_ColorRGBA> of_surface() const {
    if (!rendered.IsNull()) return decoded(rendered, static_cast<float>(1 - transparency));
    if (!surface.IsNull()) return decoded(surface, 1);
    return std::nullopt;
  }
  [[nodiscard]] static Quantity_ColorRGBA decoded(const Handle(StepVisual_Colour) & colour, float opacity) {
    Quantity_Color rgb;
    STEPConstruct_Styles::DecodeColor(colour, rgb);
    return {rgb, opacity};
  }
};

/// The representation that is the scope of a style.
Handle(StepShape_ShapeRepresentation) context_of(const StepVisual_StyledItem& item) {
  for (int i = 1; i <= item.NbStyles(); ++i) {
    const auto style = Handle(StepVisual_PresentationStyleByContext)::DownCast(item.StylesValue(i));
    if (style.IsNull()) continue;
    const auto context = Handle(StepShape_ShapeRepresentation)::DownCast(style->StyleContext().Representation());
    if (!context.IsNull()) return context;
  }
  return nullptr;
}

/// The use of a part that a representation stands for.
Handle(StepRepr_AssemblyComponentUsage) use_of(const Handle(Standard_Transient) & entity) {
  const auto definition = Handle(StepShape_ShapeDefinitionRepresentation)::DownCast(entity);
  if (definition.IsNull()) return nullptr;
  const StepRepr_RepresentedDefinition represented = definition->Definition();
  const auto shape = Handle(StepRepr_ProductDefinitionShape)::DownCast(represented.PropertyDefinition());
  if (shape.IsNull()) return nullptr;
  return Handle(StepRepr_AssemblyComponentUsage)::DownCast(shape->Definition().ProductDefinitionRelationship());
}

/// The scope of a style of a component. False: one place of a part that is in several assemblies; its style is ignored
/// silently.
bool find_component(const StepVisual_StyledItem& item, const StepParts& parts, TopoDS_Shape& shape) {
  const Handle(StepShape_ShapeRepresentation) context = context_of(item);
  if (context.IsNull()) return true;
  for (Interface_EntityIterator up = parts.session->HGraph()->Graph().Sharings(context); up.More(); up.Next()) {
    const Handle(StepRepr_AssemblyComponentUsage) use = use_of(up.Value());
    if (use.IsNull()) continue;
    if (use->IsKind(STANDARD_TYPE(StepRepr_SpecifiedHigherUsageOccurrence))) return false;
    if (!use->IsKind(STANDARD_TYPE(StepRepr_NextAssemblyUsageOccurrence))) continue;
    const int component = parts.item_of(use);
    const TopoDS_Shape placed = component != Document::none ? parts.document.shape(component) : TopoDS_Shape();
    if (placed.IsNull()) continue;
    shape = placed;
    break;
  }
  return true;
}

void colour(const TopoDS_Shape& shape, const Quantity_ColorRGBA& colour, Document& document) {
  const auto set = [&](const TopoDS_Shape& part) {
    if (part.ShapeType() > TopAbs_FACE) return true;  // edges have no colour in a mesh
    const int item = document.find(part, true);
    if (item != Document::none) document.set_colour(item, Document::Colour::surface, colour);
    return item != Document::none;
  };
  if (set(shape)) return;
  for (TopoDS_Iterator it(shape); it.More(); it.Next()) set(it.Value());
}

void apply(const STEPConstruct_Styles& styles, const Handle(StepVisual_StyledItem) & item, const StepParts& parts) {
  const Style style(styles, item);
  if (!style.found) return;
  const Handle(Standard_Transient) target = item->ItemAP242().Value();
  if (target.IsNull()) return;
  TopoDS_Shape shape;
  if (const int index = parts.process->MapIndex(target); index > 0)
    shape = TransferBRep::ShapeResult(parts.process->MapItem(index));
  if (style.of_component && !find_component(*item, parts, shape)) return;
  if (shape.IsNull()) return;
  if (const auto of_surface = style.of_surface()) colour(shape, *of_surface, parts.document);
  for (const Handle(StepVisual_Colour) & line : {style.boundary, style.curve})
    if (!line.IsNull()) parts.document.known_colour(Style::decoded(line, 1));
}

}  // namespace

void read_step_colours(const StepParts& parts) {
  STEPConstruct_Styles styles(parts.session);
  if (!styles.LoadStyles()) return;
  for (int i = 1; i <= styles.NbStyles(); ++i)
    if (const Handle(StepVisual_StyledItem) item = styles.Style(i); !item.IsNull()) apply(styles, item, parts);
  parts.document.hand_down_colours();
}

}  // namespace carreau_occ
