// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/part_tree.h"

#include <TopExp.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <array>
#include <set>

namespace carreau_occ {
namespace {

using Label = ShapeFile::Label;

class TreeMaker {
 public:
  TreeMaker(const ShapeFile& file, const Solids& solids) : file_(file), names_(solids.names) {
    for (const auto kind : {TopAbs_VERTEX, TopAbs_EDGE, TopAbs_FACE, TopAbs_SOLID}) TopExp::MapShapes(file.shape, kind, map(kind));
    for (std::size_t i = 0; i < file.labels.size(); ++i)
      if (file.labels[i].kind == Label::Kind::inside) own_.Bind(file.labels[i].part, static_cast<int>(i));
  }

  std::vector<TreeRow> run() {
    std::string use;
    for (const Label& label : file_.labels) {
      if (label.kind == Label::Kind::use) use = label.name;
      if (label.kind != Label::Kind::part && label.kind != Label::Kind::assembly) continue;
      TreeRow row = row_of(label, label.depth, label.kind == Label::Kind::part ? "part" : "assembly");
      if (row.name.empty()) row.name = use;
      use.clear();
      row.faces = count(label.part, TopAbs_FACE);
      rows_.push_back(row);
      if (label.kind == Label::Kind::part) add_inside(label.part, label.depth + 1);
    }
    add_inside(file_.shape, 0);  // no part has these
    return std::move(rows_);
  }

 private:
  TopTools_IndexedMapOfShape& map(TopAbs_ShapeEnum kind) {
    return maps_[kind == TopAbs_SOLID ? 3 : kind == TopAbs_FACE ? 2 : kind == TopAbs_EDGE ? 1 : 0];
  }

  static int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
    TopTools_IndexedMapOfShape shapes;
    TopExp::MapShapes(shape, kind, shapes);
    return shapes.Extent();
  }

  static TreeRow row_of(const Label& label, int depth, const char* kind) {
    return {.depth = depth, .kind = kind, .name = label.name, .rgb = label.rgb(), .layer = label.layer};
  }

  /// The row of a solid, face, edge or vertex; false: it has no label and is no solid.
  bool add(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind, const char* word, int depth) {
    int index = -1;
    const bool has_label = own_.Find(shape, index);
    if (kind != TopAbs_SOLID && !has_label) return false;
    const int number = map(kind).FindIndex(shape);
    if (number == 0 || !seen_.insert({kind, number}).second) return false;
    TreeRow row = has_label ? row_of(file_.labels[static_cast<std::size_t>(index)], depth, word) : TreeRow{.depth = depth, .kind = word, .name = {}, .layer = {}};
    row.number = number;
    if (kind == TopAbs_SOLID) {
      row.name = names_[static_cast<std::size_t>(number - 1)];
      row.faces = count(shape, TopAbs_FACE);
    }
    rows_.push_back(row);
    return true;
  }

  void add_small(const TopoDS_Shape& holder, int depth) {
    constexpr std::array kinds{std::pair{TopAbs_FACE, "face"}, std::pair{TopAbs_EDGE, "edge"}, std::pair{TopAbs_VERTEX, "vertex"}};
    if (own_.IsEmpty()) return;
    for (const auto& [kind, word] : kinds) {
      TopTools_IndexedMapOfShape shapes;
      TopExp::MapShapes(holder, kind, shapes);
      for (int k = 1; k <= shapes.Extent(); ++k) add(shapes(k), kind, word, depth);
    }
  }

  void add_inside(const TopoDS_Shape& part, int depth) {
    TopTools_IndexedMapOfShape solids;
    TopExp::MapShapes(part, TopAbs_SOLID, solids);
    for (int s = 1; s <= solids.Extent(); ++s)
      if (add(solids(s), TopAbs_SOLID, "solid", depth)) add_small(solids(s), depth + 1);
    add_small(part, depth);  // of no solid
  }

  const ShapeFile& file_;
  const std::vector<std::string>& names_;
  std::array<TopTools_IndexedMapOfShape, 4> maps_;
  TopTools_DataMapOfShapeInteger own_;  // labels of solids, shells, faces, edges and vertices
  std::set<std::pair<int, int>> seen_;
  std::vector<TreeRow> rows_;
};

}  // namespace

std::vector<TreeRow> part_tree(const ShapeFile& file, const Solids& solids) { return TreeMaker(file, solids).run(); }

}  // namespace carreau_occ
