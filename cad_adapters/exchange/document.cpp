// SPDX-License-Identifier: BSD-3-Clause
#include "document.h"

#include <BRep_Builder.hxx>
#include <TopExp.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <algorithm>
#include <array>
#include <cctype>

namespace carreau_occ {
namespace {

TopoDS_Shape at_origin(const TopoDS_Shape& shape) { return shape.Located(TopLoc_Location()); }

TopoDS_Compound empty_compound() {
  TopoDS_Compound compound;
  const BRep_Builder builder;
  builder.MakeCompound(compound);
  return compound;
}

/// A shape and all in it down to faces.
void map_down_to_faces(const TopoDS_Shape& shape, TopTools_IndexedMapOfShape& map) {
  const int before = map.Extent();
  if (map.Add(shape) <= before || shape.ShapeType() >= TopAbs_FACE) return;
  for (TopoDS_Iterator it(shape); it.More(); it.Next())
    if (it.Value().ShapeType() <= TopAbs_FACE) map_down_to_faces(it.Value(), map);
}

/// Names that programs give to entities without a name of their own.
bool is_automatic(const std::string& name) {
  constexpr std::array<const char*, 7> words{"none", "advanced face", "edge curve", "vertex point",
                                             "trim region", "trimming point", "manifold solid brep"};
  if (name.size() > 1 && name[0] == '#' && name.find_first_not_of("0123456789", 1) == std::string::npos) return true;
  std::string small = name;
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(words.begin(), words.end(), small) != words.end();
}

}  // namespace

int Document::make(const TopoDS_Shape& shape, int above) {
  const int item = static_cast<int>(items_.size());
  items_.emplace_back().shape = shape;
  at(item).above = above;
  if (above != none)
    at(above).below.push_back(item);
  else if (!shape.IsNull())
    tops_.Bind(shape, item);
  return item;
}

void Document::place(int item, int part, const TopLoc_Location& where) {
  at(item).part = part;
  at(item).place = where;
  at(part).placed_as.push_back(item);
}

void Document::remember(const TopoDS_Shape& shape, int item) {
  if (!known_.IsBound(shape)) known_.Bind(shape, item);
}

int Document::add(const TopoDS_Shape& shape) {
  const int item = add_below(shape, false);
  remember(shape, item);
  return item;
}

int Document::add_expanded(const TopoDS_Shape& shape) {
  const int item = add_below(shape, true);
  remember(shape, item);
  return item;
}

int Document::add_below(const TopoDS_Shape& shape, bool expand) {
  if (int found = none; tops_.Find(shape, found)) return found;
  if (!shape.Location().IsIdentity()) {
    const int placed = make({}, none);
    const int part = add_below(at_origin(shape), expand);
    place(placed, part, shape.Location());
    return placed;
  }
  const int item = make(shape, none);
  if (expand && shape.ShapeType() == TopAbs_COMPOUND)
    add_components_of(item, shape);
  else
    hold_insides(item);
  return item;
}

void Document::add_components_of(int assembly, const TopoDS_Shape& shape) {
  at(assembly).assembly = true;
  for (TopoDS_Iterator it(shape); it.More(); it.Next()) {
    const int part = add_below(at_origin(it.Value()), true);
    place(make({}, assembly), part, it.Value().Location());
  }
}

void Document::hold_insides(int item) {
  const TopTools_IndexedMapOfShape& shapes = inside_of(item).shapes;
  for (int i = 1; i <= shapes.Extent(); ++i) {
    holders_.Bind(shapes(i), item);
    if (!shapes(i).Location().IsIdentity()) holders_.Bind(at_origin(shapes(i)), item);
  }
}

Document::Inside& Document::inside_of(int item) {
  const auto [found, fresh] = insides_.try_emplace(item);
  if (fresh) map_down_to_faces(at(item).shape, found->second.shapes);
  return found->second;
}

int Document::add_assembly() {
  const int item = make(empty_compound(), none);
  at(item).assembly = true;
  return item;
}

int Document::add_component(int assembly, int part, const TopLoc_Location& where) {
  const int item = make({}, assembly);
  at(assembly).assembly = true;
  place(item, part, where);
  remember(shape(item), item);
  return item;
}

int Document::add_inside(int item, const TopoDS_Shape& shape) {
  if (at(item).above != none || at(item).assembly || at(item).part != none) return none;
  Inside& inside = inside_of(item);
  TopoDS_Shape held = shape;
  if (!inside.shapes.Contains(shape)) {
    held.Nullify();
    for (TopoDS_Iterator it(at(item).shape); it.More() && held.IsNull(); it.Next())
      if (shape.IsSame(at_origin(it.Value()))) held = it.Value();
    if (held.IsNull()) return none;
  }
  if (int found = none; inside.items.Find(held, found)) return found;
  const int made = make(held, item);
  inside.items.Bind(held, made);
  return made;
}

void Document::set_name(int item, const std::string& name) {
  if (!is_automatic(name)) at(item).name = name;
}

void Document::set_layer(int item, const std::string& layer) {
  if (at(item).layer.empty()) at(item).layer = layer;
}

int Document::find_small(const TopoDS_Shape& wanted) {
  if (!knows_small_)
    for (std::size_t i = 0; i < items_.size(); ++i) {
      if (items_[i].above != none || items_[i].assembly || items_[i].part != none || items_[i].shape.IsNull()) continue;
      TopTools_IndexedMapOfShape shapes;
      TopExp::MapShapes(items_[i].shape, TopAbs_EDGE, shapes);
      TopExp::MapShapes(items_[i].shape, TopAbs_VERTEX, shapes);
      for (int k = 1; k <= shapes.Extent(); ++k) small_.Bind(shapes(k), static_cast<int>(i));
    }
  knows_small_ = true;
  int part = none;
  if (!small_.Find(wanted, part)) return none;
  if (int found = none; inside_of(part).items.Find(wanted, found)) return found;
  const int made = make(wanted, part);
  inside_of(part).items.Bind(wanted, made);
  return made;
}

void Document::set_shape(int item, const TopoDS_Shape& shape) {
  at(item).shape = shape;
  remember(shape, item);
}

int Document::find(const TopoDS_Shape& wanted, bool inside) {
  int found = none;
  if (known_.Find(wanted, found)) return found;
  if (known_.Find(at_origin(wanted), found))
    for (const int placed : at(found).placed_as)
      if (shape(placed).IsSame(wanted)) return placed;
  if (!inside || !holders_.Find(wanted, found)) return none;
  return add_inside(found, wanted);
}

int Document::find_component_or_part(const TopoDS_Shape& wanted) const {
  if (!wanted.Location().IsIdentity())
    for (std::size_t i = 0; i < items_.size(); ++i) {
      if (items_[i].above != none || !items_[i].assembly) continue;
      for (const int component : items_[i].below)
        if (at(component).part != none && shape(component).IsSame(wanted)) return component;
    }
  int found = none;
  return tops_.Find(at_origin(wanted), found) ? found : none;
}

TopoDS_Shape Document::shape(int item) const {
  if (at(item).part == none) return at(item).shape;
  TopoDS_Shape placed = shape(at(item).part);
  if (!placed.IsNull()) placed.Move(at(item).place, Standard_False);
  return placed;
}

Quantity_Color Document::known_colour(const Quantity_ColorRGBA& colour) {
  for (const Quantity_ColorRGBA& each : colours_)
    if (each.IsEqual(colour)) return each.GetRGB();
  colours_.push_back(colour);
  return colour.GetRGB();
}

void Document::set_colour(int item, Colour kind, const Quantity_ColorRGBA& colour) {
  (kind == Colour::surface ? at(item).surface : at(item).general) = known_colour(colour);
}

void Document::hand_down_colours() {
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (items_[i].above != none || !items_[i].placed_as.empty()) continue;
    const int item = items_[i].part != none ? items_[i].part : static_cast<int>(i);
    if (at(item).assembly) hand_down_from(item);
  }
}

void Document::hand_down_from(int item) {
  for (const int component : at(item).below) {
    const int part = at(component).part;
    if (part == none) continue;
    if (!at(part).surface) at(part).surface = at(item).surface;
    if (!at(part).general) at(part).general = at(item).general;
    if (at(part).assembly) hand_down_from(part);
  }
}

/// An assembly gets the shapes of all that is in it.
void Document::assemble(int item) {
  if (at(item).part != none) return assemble(at(item).part);
  if (!at(item).assembly || at(item).assembled) return;
  at(item).assembled = true;
  TopoDS_Compound all = empty_compound();
  const BRep_Builder builder;
  for (const int component : at(item).below) {
    if (at(component).part == none) continue;
    assemble(component);
    if (const TopoDS_Shape part = shape(component); !part.IsNull()) builder.Add(all, part);
  }
  at(item).shape = all;
}

void Document::write_labels(int item, const TopLoc_Location& where, int depth, ShapeFile& file) const {
  const Item& here = at(item);
  const std::optional<Quantity_Color>& colour = here.surface ? here.surface : here.general;
  using Kind = ShapeFile::Label::Kind;
  const Kind kind = here.part != none ? Kind::use : here.assembly ? Kind::assembly : here.above == none ? Kind::part : Kind::inside;
  const TopoDS_Shape held = shape(item);
  if (!held.IsNull() && (kind != Kind::inside || !here.name.empty() || !here.layer.empty() || colour)) {
    ShapeFile::Label label{.part = held.Moved(where, Standard_False), .name = here.name, .layer = here.layer, .kind = kind, .depth = depth};
    label.has_colour = colour.has_value();
    if (colour) colour->Values(label.red, label.green, label.blue, Quantity_TOC_sRGB);
    file.labels.push_back(label);
  }
  if (here.part != none) return write_labels(here.part, where * here.place, depth, file);
  for (const int below : here.below) write_labels(below, where, here.assembly ? depth + 1 : depth, file);
}

void Document::write(ShapeFile& file) {
  TopoDS_Compound all = empty_compound();
  const BRep_Builder builder;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (items_[i].above != none || !items_[i].placed_as.empty()) continue;
    const auto item = static_cast<int>(i);
    assemble(item);
    if (const TopoDS_Shape whole = shape(item); !whole.IsNull()) builder.Add(all, whole);
    write_labels(item, {}, 0, file);
  }
  file.shape = all;
}

}  // namespace carreau_occ
