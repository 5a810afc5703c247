// SPDX-License-Identifier: BSD-3-Clause
#include <BRep_Builder.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <IGESBasic_SubfigureDef.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESGraph_Color.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <UnitsMethods.hxx>
#include <XSAlgo.hxx>
#include <XSAlgo_AlgoContainer.hxx>
#include <XSControl_TransferReader.hxx>
#include <algorithm>

#include "document.h"
#include "entity_check.h"
#include "iges_entities.h"
#include "quick_healing.h"
#include "text_of_file.h"
#include "translator.h"
#include "changes/units.h"

namespace carreau_occ {
namespace {

/// OpenCASCADE takes details below the resolution of an IGES file for points: holes vanish silently. Some writers give
/// absurd resolutions (OpenCASCADE 7.6 writes 1e43, for instance, for several shapes).
void mend_resolution(IGESData_IGESModel& model) {
  constexpr double largest = 1e-3, usual = 1e-5;  // shares of the largest coordinate; the latter is HDR's eps1
  IGESData_GlobalSection header = model.GlobalSection();
  const double extent = header.HasMaxCoord() ? header.MaxCoord() : 0;
  if (!(extent > 0) || header.Resolution() <= largest * extent) return;
  header.SetResolution(usual * extent);
  model.SetGlobalSection(header);
}

/// A compound with compounds in it that are placed.
bool is_composite(const TopoDS_Shape& shape) {
  if (shape.ShapeType() != TopAbs_COMPOUND) return false;
  if (!shape.Location().IsIdentity()) return true;
  for (TopoDS_Iterator it(shape, Standard_False, Standard_False); it.More(); it.Next())
    if (is_composite(it.Value())) return true;
  return false;
}

/// Adds composite shapes from below: those without others in them are parts, all others are assemblies.
class Composites {
 public:
  explicit Composites(Document& document) : document_(document) {}

  void add(const TopoDS_Shape& shape, bool outermost) {
    const TopoDS_Shape kept = outermost ? shape : shape.Located(TopLoc_Location());
    if (!seen_.Add(kept)) return;
    const BRep_Builder builder;
    TopoDS_Compound plain, composite;
    builder.MakeCompound(plain);
    builder.MakeCompound(composite);
    for (TopoDS_Iterator it(shape, Standard_False, Standard_False); it.More(); it.Next())
      if (is_composite(it.Value())) {
        add(it.Value(), false);
        builder.Add(composite, it.Value());
      } else {
        builder.Add(plain, it.Value());
      }
    if (composite.NbChildren() == 0)
      document_.add(kept);
    else if (plain.NbChildren() == 0)
      document_.add_expanded(kept);
    else
      document_.add_expanded(of_both(plain, composite, shape));
  }

 private:
  TopoDS_Shape of_both(const TopoDS_Shape& plain, const TopoDS_Shape& composite, const TopoDS_Shape& like) {
    document_.add(plain);
    const BRep_Builder builder;
    TopoDS_Compound both;
    builder.MakeCompound(both);
    builder.Add(both, plain);
    builder.Add(both, composite);
    both.Location(like.Location(), Standard_False);
    both.Orientation(like.Orientation());
    return both;
  }

  Document& document_;
  TopTools_MapOfShape seen_;
};

/// Colours by number (IGES 5.3, section 2.2.4.4.13).
Quantity_Color colour_of_number(int number) {
  constexpr Quantity_NameOfColor colours[] = {Quantity_NOC_BLACK, Quantity_NOC_RED,    Quantity_NOC_GREEN,
                                              Quantity_NOC_BLUE1, Quantity_NOC_YELLOW, Quantity_NOC_MAGENTA1,
                                              Quantity_NOC_CYAN1, Quantity_NOC_WHITE};
  return number >= 1 && number <= 8 ? colours[number - 1] : Quantity_NOC_WHITE;
}

std::optional<Quantity_Color> colour_of(const IGESData_IGESEntity& entity) {
  if (entity.DefColor() == IGESData_DefValue) return colour_of_number(entity.RankColor());
  if (entity.DefColor() != IGESData_DefReference) return std::nullopt;
  const auto colour = Handle(IGESGraph_Color)::DownCast(entity.Color());
  if (colour.IsNull()) return std::nullopt;
  double percent[3];
  colour->RGBIntensity(percent[0], percent[1], percent[2]);
  const auto share = [](double each) { return 0.01 * std::clamp(each, 0.0, 100.0); };
  return Quantity_Color(share(percent[0]), share(percent[1]), share(percent[2]), Quantity_TOC_sRGB);
}

std::string trimmed(TCollection_AsciiString text) {
  text.LeftAdjust();
  text.RightAdjust();
  return utf8(text);
}

void read_labels(const Handle(IGESData_IGESEntity) & entity, const TopoDS_Shape& shape, Document& document) {
  const std::optional<Quantity_Color> colour = colour_of(*entity);
  const auto set = [&](int item) {
    if (item != Document::none && colour)
      document.set_colour(item, Document::Colour::general, Quantity_ColorRGBA(*colour));
  };
  if (colour) document.known_colour(Quantity_ColorRGBA(*colour));
  const auto name = [&](int item) {
    if (item == Document::none) return;
    if (entity->HasName()) document.set_name(item, trimmed(entity->NameValue()->String()));
    if (entity->Level() > 0) document.set_layer(item, std::to_string(entity->Level()));
  };
  if (shape.ShapeType() > TopAbs_FACE && entity->HasName()) name(document.find_small(shape));
  if (shape.ShapeType() <= TopAbs_FACE) {  // edges have no colour in a mesh
    const int item = document.find(shape, colour.has_value() || entity->Level() > 0);
    set(item);
    name(item);
    if (item == Document::none && colour)
      for (TopoDS_Iterator it(shape); it.More(); it.Next())
        if (it.Value().ShapeType() <= TopAbs_FACE) set(document.find(it.Value(), true));
  }
  if (const auto figure = Handle(IGESBasic_SubfigureDef)::DownCast(entity); !figure.IsNull()) {
    const int item = document.find_component_or_part(shape);
    if (item != Document::none && !figure->Name().IsNull()) document.set_name(item, trimmed(figure->Name()->String()));
  }
}

bool translate(IGESControl_Reader& reader, const Message_ProgressRange& progress, Document& document) {
  const auto model = Handle(IGESData_IGESModel)::DownCast(reader.WS()->Model());
  XSAlgo::AlgoContainer()->PrepareForTransfer();  // the unit of shapes, once more
  model->ChangeGlobalSection().SetCascadeUnit(UnitsMethods::GetCasCadeLengthUnit());
  reader.TransferRoots(progress);
  if (reader.NbShapes() <= 0) return false;
  for (int i = 1; i <= reader.NbShapes(); ++i)
    if (const TopoDS_Shape shape = reader.Shape(i); is_composite(shape))
      Composites(document).add(shape, true);
    else
      document.add(shape);
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto entity = Handle(IGESData_IGESEntity)::DownCast(model->Value(i));
    const TopoDS_Shape shape = entity.IsNull() ? TopoDS_Shape() : TransferBRep::ShapeResult(process->Find(entity));
    if (!shape.IsNull()) read_labels(entity, shape, document);
  }
  return true;
}

}  // namespace
}  // namespace carreau_occ

using namespace carreau_occ;

void carreau_translate_iges(const std::string& path, const Message_ProgressRange& progress, ShapeFile& file) {
  IGESControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) refuse(path, "is not a readable IGES file");
  if (const Handle(IGESData_IGESModel) model = reader.IGESModel(); !model.IsNull()) mend_resolution(*model);
  const IgesEntities kinds;
  const EntityCheck check(reader.WS(), kinds);
  const QuickHealing quick;
  Document document;
  const bool translated = translate(reader, progress, document);
  file.losses = check.losses();
  if (const std::string note = check.passed_over(); !note.empty()) file.notes.push_back(note);
  if (!translated) refuse_untranslated(path, "IGES", file);
  file.doubtful = check.doubtful();
  document.write(file);
  file.unit = "mm";
  if (const Handle(TCollection_HAsciiString) unit = reader.IGESModel()->GlobalSection().UnitName(); !unit.IsNull())
    file.file_unit = unit_sign(unit->ToCString());
}
