// SPDX-License-Identifier: BSD-3-Clause
// The structure of a STEP or IGES file: parts, assemblies of parts that are placed, and their names and
// colours.
#pragma once

#include <Quantity_ColorRGBA.hxx>
#include <TopLoc_Location.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shape_file.h"

namespace carreau_occ {

/// A tree of items with the meaning that OpenCASCADE's own documents (XDE) give to files; XDE requires a viewer and a
/// window system. An item is a shape, a part of a shape, an assembly, or a placed item. Edges and vertices with a name
/// are items of their parts.
class Document {
 public:
  static constexpr int none = -1;

  /// Returns the item of a shape, and makes it if necessary. A placed shape refers to the item of the shape at its
  /// origin.
  int add(const TopoDS_Shape& shape);
  /// Adds a compound with a component for each shape in it, and so on below.
  int add_expanded(const TopoDS_Shape& shape);
  int add_assembly();
  /// `part` at a place in an assembly.
  int add_component(int assembly, int part, const TopLoc_Location& place);
  /// The item of a solid, a shell or a face of an item, whatever its place in it: the same item at each call. none: the
  /// item does not hold such a shape.
  int add_inside(int item, const TopoDS_Shape& shape);

  /// The item of a shape: its own, the first component at its place, or, if `inside`, the result of add_inside().
  int find(const TopoDS_Shape& shape, bool inside);
  /// A component at the shape's place, or else its part; shapes inside parts are not searched.
  [[nodiscard]] int find_component_or_part(const TopoDS_Shape& shape) const;

  [[nodiscard]] TopoDS_Shape shape(int item) const;
  [[nodiscard]] bool is_assembly(int item) const { return at(item).assembly; }

  /// Names that programs write for entities without a name are ignored: "#197", "NONE".
  void set_name(int item, const std::string& name);
  /// The first layer stays.
  void set_layer(int item, const std::string& layer);
  /// The item of an edge or vertex of a part; none: no part has this shape.
  int find_small(const TopoDS_Shape& shape);
  /// The item of add_inside() has this shape.
  void set_shape(int item, const TopoDS_Shape& shape);
  enum class Colour { surface, general };
  void set_colour(int item, Colour kind, const Quantity_ColorRGBA& colour);
  /// A colour that the file has: later ones that differ from it by no more than a rounding error are this one.
  Quantity_Color known_colour(const Quantity_ColorRGBA& colour);
  /// Gives parts without a colour the colour of the assembly that holds them.
  void hand_down_colours();

  /// Writes all top shapes with their names and colours.
  void write(ShapeFile& file);

 private:
  struct Item {
    TopoDS_Shape shape;          // null where the part has it
    int part = none;             // the part of a placed item
    TopLoc_Location place;       // of the part
    int above = none;            // none: it is in no other item
    bool assembly = false;       // of the items below
    bool assembled = false;      // the shape holds all shapes below
    std::vector<int> below;      // in the order in which they were made
    std::vector<int> placed_as;  // items that refer to this one
    std::string name, layer;
    std::optional<Quantity_Color> surface, general;
  };
  struct Inside {
    TopTools_IndexedMapOfShape shapes;
    TopTools_DataMapOfShapeInteger items;
  };

  [[nodiscard]] Item& at(int item) { return items_[static_cast<std::size_t>(item)]; }
  [[nodiscard]] const Item& at(int item) const { return items_[static_cast<std::size_t>(item)]; }
  int make(const TopoDS_Shape& shape, int above);
  int add_below(const TopoDS_Shape& shape, bool expand);
  void place(int item, int part, const TopLoc_Location& place);
  void add_components_of(int assembly, const TopoDS_Shape& shape);
  void hold_insides(int item);
  void remember(const TopoDS_Shape& shape, int item);
  Inside& inside_of(int item);
  void hand_down_from(int item);
  void assemble(int item);
  void write_labels(int item, const TopLoc_Location& place, int depth, ShapeFile& file) const;

  std::vector<Item> items_;
  TopTools_DataMapOfShapeInteger tops_;     // items that are in no other, by the shape that they have
  TopTools_DataMapOfShapeInteger known_;    // items by added shape
  TopTools_DataMapOfShapeInteger holders_;  // the last item that holds a shape
  std::map<int, Inside> insides_;
  TopTools_DataMapOfShapeInteger small_;  // parts of edges and vertices; filled by the first find_small()
  bool knows_small_ = false;
  std::vector<Quantity_ColorRGBA> colours_;
};

}  // namespace carreau_occ
