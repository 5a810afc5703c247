// SPDX-License-Identifier: BSD-3-Clause
#include "changes/mirror.h"

#include <BOPAlgo_Splitter.hxx>
#include <BOPTools_AlgoTools.hxx>
#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepTools.hxx>
#include <BRepTools_ReShape.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <IntTools_Context.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeListOfShape.hxx>
#include <TopTools_DataMapOfShapeShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gp_Ax2.hxx>
#include <gp_Pln.hxx>
#include <gp_Trsf.hxx>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "changes/mirror_edges.h"
#include "changes/shape_images.h"
#include "thresholds.h"

namespace carreau_occ {
namespace {

/// Heights over the plane.
struct Extent {
  double low = Precision::Infinite(), high = -Precision::Infinite();
  void add(double height) { low = std::min(low, height), high = std::max(high, height); }
};

class Mirror {
 public:
  Mirror(const TopoDS_Shape& shape, const MirrorPlane& plane)
      : shape_(shape), plane_(gp_Pnt(plane.point[0], plane.point[1], plane.point[2]), gp_Dir(plane.normal[0], plane.normal[1], plane.normal[2])) {
    map_.SetMirror(gp_Ax2(plane_.Location(), plane_.Axis().Direction()));
    Bnd_Box box;
    BRepBndLib::Add(shape, box);
    const gp_Pnt low = box.CornerMin(), high = box.CornerMax();
    diagonal_ = low.Distance(high);
    reach_ = diagonal_ + plane_.Distance(low) + gp_Vec(plane_.Location(), low).Magnitude();
    near_ = std::max(thresholds::in_mirror * diagonal_, Precision::Confusion());
    TopExp::MapShapes(shape, TopAbs_FACE, faces_);
    for (int f = 1; f <= faces_.Extent(); ++f) heights_.push_back(height_of(TopoDS::Face(faces_(f))));
  }

  void run() {
    const EdgeHeights loose = heights_of_loose(shape_, plane_);
    const bool below = loose.low < -near_ || std::any_of(heights_.begin(), heights_.end(), [this](const Extent& e) { return e.low < -near_; });
    const bool above = loose.high > near_ || std::any_of(heights_.begin(), heights_.end(), [this](const Extent& e) { return e.high > near_; });
    if (!below && !above) throw std::runtime_error("the file has no face off the mirror plane");
    is_whole_ = below && above;
    cut();
    collect(above);
    add_images();
    if (is_whole_) match_other_half();
    MirroredEdges edges = mirror_loose(shape_, plane_, above, is_whole_, near_, std::max(thresholds::symmetric * diagonal_, near_));
    for (TopTools_DataMapOfShapeListOfShape::Iterator it(edges.images); it.More(); it.Next()) images_.Bind(it.Key(), it.Value());
    loose_ = std::move(edges.edges);
  }

  /// The edges of no face, with their images.
  [[nodiscard]] const TopTools_ListOfShape& loose() const { return loose_; }

  /// The shapes that a solid, shell, face, edge or vertex has become.
  [[nodiscard]] TopTools_ListOfShape images_of(const TopoDS_Shape& shape) const {
    if (const TopTools_ListOfShape* known = images_.Seek(shape)) return *known;
    TopTools_ListOfShape itself;
    if (shape.ShapeType() != TopAbs_FACE) itself.Append(shape);
    return itself;
  }

  /// Solids or shells of the pieces and their mirror images: one that the plane cut or closed, otherwise two, or none for a part of the
  /// other half.
  TopTools_ListOfShape rebuilt(const TopoDS_Shape& part) {
    const bool is_solid = part.ShapeType() == TopAbs_SOLID;
    const bool apart = is_apart(part);
    TopTools_ListOfShape made;
    for (const bool mirrored : {false, true}) {
      if (mirrored && !apart) break;
      const TopoDS_Shape one = is_solid ? solid_of(part, mirrored, apart) : shell_of(part, mirrored, apart);
      if (one.NbChildren() == 0) continue;
      made.Append(one);
      for (TopExp_Explorer e(one, TopAbs_FACE); e.More(); e.Next()) holder_.Bind(e.Current(), one);
    }
    TopTools_ListOfShape with_name;
    if (is_whole_ && made.Size() == 2)
      with_name.Append(made.First());
    else
      with_name = made;
    images_.Bind(part, with_name);
    return made;
  }

  /// Faces of no shell: first their pieces, then the images.
  void add_free(const TopTools_ListOfShape& faces, TopTools_ListOfShape& result) const {
    for (const bool images : {false, true})
      for (const TopoDS_Shape& face : faces)
        for (const TopoDS_Shape& piece : pieces_of_.Find(face)) result.Append(images ? mirrored_.Find(piece) : piece);
  }

  /// Names of the other half's parts go to the mirror images.
  void name_other_half(const TopTools_ListOfShape& parts) {
    for (const TopoDS_Shape& part : parts) {
      if (!images_.IsBound(part) || !images_.Find(part).IsEmpty()) continue;
      for (TopExp_Explorer e(part, TopAbs_FACE); e.More() && images_.Find(part).IsEmpty(); e.Next())
        for (const TopoDS_Shape& image : images_of(e.Current()))
          if (holder_.IsBound(image) && images_.Find(part).IsEmpty()) images_.ChangeFind(part).Append(holder_.Find(image));
    }
  }

 private:
  [[nodiscard]] double height_of(const gp_Pnt& p) const { return gp_Vec(plane_.Location(), p).Dot(gp_Vec(plane_.Axis().Direction())); }

  [[nodiscard]] Extent height_of(const TopoDS_Edge& edge) const {
    constexpr int places = 16;
    Extent extent;
    if (BRep_Tool::Degenerated(edge)) return extent;
    const BRepAdaptor_Curve curve(edge);
    for (int i = 0; i <= places; ++i)
      extent.add(height_of(curve.Value(curve.FirstParameter() + (curve.LastParameter() - curve.FirstParameter()) * i / places)));
    return extent;
  }

  // Looks at places inside, too: all edges may lie in the plane.
  [[nodiscard]] Extent height_of(const TopoDS_Face& face) const {
    constexpr int places = 12;
    Extent extent;
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      const Extent of_edge = height_of(TopoDS::Edge(e.Current()));
      extent.low = std::min(extent.low, of_edge.low), extent.high = std::max(extent.high, of_edge.high);
    }
    double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
    BRepTools::UVBounds(face, u0, u1, v0, v1);
    const BRepAdaptor_Surface surface(face, Standard_False);
    BRepTopAdaptor_FClass2d inside(face, Precision::PConfusion());
    for (int i = 1; i < places; ++i)
      for (int k = 1; k < places; ++k) {
        const gp_Pnt2d uv(u0 + (u1 - u0) * i / places, v0 + (v1 - v0) * k / places);
        if (inside.Perform(uv) == TopAbs_IN) extent.add(height_of(surface.Value(uv.X(), uv.Y())));
      }
    return extent;
  }

  [[nodiscard]] bool is_in_plane(const TopoDS_Edge& edge) const {
    const Extent extent = height_of(edge);
    if (extent.low > extent.high)
      return std::abs(height_of(BRep_Tool::Pnt(TopExp::FirstVertex(edge)))) <= near_;
    return extent.low >= -near_ && extent.high <= near_;
  }

  // The edge becomes an edge of the mirrored face, too: with the curves that its image has there.
  static void take_curves(const TopoDS_Edge& edge, const TopoDS_Edge& image, const TopoDS_Face& face) {
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(image, face, first, last);
    if (curve.IsNull()) return;
    const BRep_Builder builder;
    const double tolerance = std::max(BRep_Tool::Tolerance(edge), BRep_Tool::Tolerance(image));
    if (BRep_Tool::IsClosed(image, face)) {
      const TopoDS_Edge back = TopoDS::Edge(image.Reversed());
      builder.UpdateEdge(edge, curve, BRep_Tool::CurveOnSurface(back, face, first, last), face, tolerance);
    } else {
      builder.UpdateEdge(edge, curve, face, tolerance);
    }
    builder.Range(edge, face, first, last);
  }

  [[nodiscard]] std::string named(int face) const { return "face " + std::to_string(face); }

  // ---- pieces: the faces on the side that stays ----

  [[nodiscard]] bool is_across(int f) const { return heights_[f - 1].low < -near_ && heights_[f - 1].high > near_; }
  [[nodiscard]] bool is_in_plane(int f) const { return heights_[f - 1].low >= -near_ && heights_[f - 1].high <= near_; }

  // The faces across the plane, in parts.
  void cut() {
    TopTools_ListOfShape across;
    for (int f = 1; f <= faces_.Extent(); ++f)
      if (is_across(f)) across.Append(faces_(f));
    if (across.IsEmpty()) return;
    BOPAlgo_Splitter splitter;
    splitter.AddArgument(compound_of(across));
    splitter.AddTool(BRepBuilderAPI_MakeFace(plane_, -reach_, reach_, -reach_, reach_).Shape());
    splitter.SetNonDestructive(Standard_True);
    splitter.Perform();
    if (splitter.HasErrors()) throw std::runtime_error("OpenCASCADE cannot cut the faces that lie across the mirror plane");
    const Handle(IntTools_Context) context = new IntTools_Context;
    for (const TopoDS_Shape& face : across) {
      TopTools_ListOfShape parts;
      for (TopoDS_Shape part : splitter.Modified(face)) {
        part.Orientation(face.Orientation());
        if (BOPTools_AlgoTools::IsSplitToReverse(part, face, context)) part.Reverse();
        parts.Append(part);
      }
      if (parts.Size() < 2) throw std::runtime_error("OpenCASCADE cannot cut " + named(faces_.FindIndex(face)) + " by the mirror plane");
      parts_.Bind(face, parts);
    }
    for (const TopAbs_ShapeEnum kind : {TopAbs_EDGE, TopAbs_VERTEX})
      for (TopExp_Explorer e(compound_of(across), kind); e.More(); e.Next())
        if (!images_.IsBound(e.Current()) && !splitter.Modified(e.Current()).IsEmpty()) images_.Bind(e.Current(), splitter.Modified(e.Current()));
  }

  void collect(bool above) {
    for (int f = 1; f <= faces_.Extent(); ++f) {
      TopTools_ListOfShape pieces;
      const auto stays = [&](const Extent& e) { return above ? e.low >= -near_ && e.high > near_ : e.high <= near_ && e.low < -near_; };
      if (const TopTools_ListOfShape* parts = parts_.Seek(faces_(f))) {
        for (const TopoDS_Shape& part : *parts)
          if (stays(height_of(TopoDS::Face(part)))) pieces.Append(part);
        if (pieces.IsEmpty() || pieces.Size() == parts->Size())
          throw std::runtime_error("OpenCASCADE cuts " + named(f) + " by the mirror plane into parts on one side alone");
      } else if (stays(heights_[f - 1]) || (is_whole_ && is_in_plane(f))) {
        pieces.Append(faces_(f));
      }
      for (const TopoDS_Shape& piece : pieces) pieces_.Append(piece);
      pieces_of_.Bind(faces_(f), pieces);
    }
  }

  // ---- their mirror images ----

  void add_images() {
    if (pieces_.IsEmpty()) return;
    BRepBuilderAPI_Transform mirrored(compound_of(pieces_), map_, Standard_True);
    const Handle(BRepTools_ReShape) join = new BRepTools_ReShape;
    TopTools_MapOfShape seen;
    for (const TopoDS_Shape& face : pieces_) {
      const TopoDS_Face image = TopoDS::Face(mirrored.ModifiedShape(face));
      for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
        const TopoDS_Edge edge = TopoDS::Edge(e.Current().Oriented(TopAbs_FORWARD));
        if (!is_in_plane(edge)) continue;
        const TopoDS_Edge other = TopoDS::Edge(mirrored.ModifiedShape(edge).Oriented(TopAbs_FORWARD));
        take_curves(edge, other, image);
        if (seen.Add(edge)) join->Replace(other, edge);
      }
      for (TopExp_Explorer e(face, TopAbs_VERTEX); e.More(); e.Next()) {
        const TopoDS_Shape vertex = e.Current().Oriented(TopAbs_FORWARD);
        if (std::abs(height_of(BRep_Tool::Pnt(TopoDS::Vertex(vertex)))) > near_) continue;
        if (seen.Add(vertex)) join->Replace(mirrored.ModifiedShape(vertex).Oriented(TopAbs_FORWARD), vertex);
      }
    }
    for (const TopoDS_Shape& face : pieces_) {
      const Extent extent = height_of(TopoDS::Face(face));
      TopoDS_Shape image = extent.low >= -near_ && extent.high <= near_ ? face : join->Apply(mirrored.ModifiedShape(face));
      // The image of the surface has the image of its normal, turned round.
      image.Orientation(TopAbs::Reverse(face.Orientation()));
      mirrored_.Bind(face, image);
    }
    for (int f = 1; f <= faces_.Extent(); ++f) {
      TopTools_ListOfShape all;
      for (const TopoDS_Shape& piece : pieces_of_.Find(faces_(f))) {
        all.Append(piece);
        if (!is_whole_ || is_across(f)) all.Append(mirrored_.Find(piece));
      }
      images_.Bind(faces_(f), all);
    }
  }

  // ---- the half that the images replace ----

  using BoxedFaces = std::vector<std::pair<Bnd_Box, TopoDS_Face>>;

  [[nodiscard]] std::vector<gp_Pnt> places_inside(const TopoDS_Face& face) const {
    constexpr int places = 4;
    std::vector<gp_Pnt> points;
    double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
    BRepTools::UVBounds(face, u0, u1, v0, v1);
    const BRepAdaptor_Surface surface(face, Standard_False);
    BRepTopAdaptor_FClass2d inside(face, Precision::PConfusion());
    for (int i = 1; i < places; ++i)
      for (int k = 1; k < places; ++k) {
        const gp_Pnt2d uv(u0 + (u1 - u0) * i / places, v0 + (v1 - v0) * k / places);
        if (inside.Perform(uv) == TopAbs_IN) points.push_back(surface.Value(uv.X(), uv.Y()));
      }
    return points;
  }

  // The other half must be the image of the pieces: places in its faces lie on images, and both have one area.
  void match_other_half() {
    const double within = std::max(thresholds::symmetric * diagonal_, near_);
    const auto boxed = [within](const TopoDS_Shape& face) {
      Bnd_Box box;
      BRepBndLib::Add(face, box);
      box.Enlarge(within);
      return std::pair(box, TopoDS::Face(face));
    };
    BoxedFaces pieces, other_faces;
    double area = 0, other_area = 0;
    for (const TopoDS_Shape& piece : pieces_) {
      pieces.push_back(boxed(piece));
      if (const Extent e = height_of(TopoDS::Face(piece)); e.low < -near_ || e.high > near_) area += area_of(piece);
    }
    for (int f = 1; f <= faces_.Extent(); ++f) {
      if (is_in_plane(f)) continue;
      TopTools_ListOfShape others;
      if (const TopTools_ListOfShape* parts = parts_.Seek(faces_(f)))
        for (const TopoDS_Shape& part : *parts)
          if (!pieces_of_.Find(faces_(f)).Contains(part)) others.Append(part);
      if (pieces_of_.Find(faces_(f)).IsEmpty()) others.Append(faces_(f));
      for (const TopoDS_Shape& other : others) {
        other_area += area_of(other);
        other_faces.push_back(boxed(other));
        for (const TopoDS_Face& piece : faces_under(f, TopoDS::Face(other), pieces, within)) {
          TopTools_ListOfShape& images = images_.ChangeFind(faces_(f));
          if (!images.Contains(mirrored_.Find(piece))) images.Append(mirrored_.Find(piece));
        }
      }
    }
    if (std::abs(area - other_area) <= thresholds::imprint_volume * area) return;
    for (int f = 1; f <= faces_.Extent(); ++f)
      for (const TopoDS_Shape& piece : pieces_of_.Find(faces_(f)))
        if (!is_in_plane(f)) (void)faces_under(f, TopoDS::Face(piece), other_faces, within);
    throw std::runtime_error("the body is not symmetric about the mirror plane: its halves have areas of " + text_of(area) + " and " + text_of(other_area));
  }

  // The faces on which the images of places in a face lie. Throws when one lies on none.
  [[nodiscard]] std::vector<TopoDS_Face> faces_under(int f, const TopoDS_Face& face, const BoxedFaces& candidates, double within) const {
    std::vector<TopoDS_Face> found;
    for (const gp_Pnt& place : places_inside(face)) {
      const gp_Pnt image = place.Transformed(map_);
      const TopoDS_Vertex vertex = BRepBuilderAPI_MakeVertex(image);
      double nearest = Precision::Infinite();
      for (const auto& [box, candidate] : candidates) {
        if (box.IsOut(image)) continue;
        const BRepExtrema_DistShapeShape distance(vertex, candidate);
        if (!distance.IsDone()) continue;
        nearest = std::min(nearest, distance.Value());
        if (distance.Value() > within) continue;
        found.push_back(candidate);
        break;
      }
      if (nearest > within)
        throw std::runtime_error("the body is not symmetric about the mirror plane: the image of " + named(f) + " at (" + text_of(image.X()) + ", " +
                                 text_of(image.Y()) + ", " + text_of(image.Z()) + ") is on no face" +
                                 (nearest < Precision::Infinite() ? ", " + text_of(nearest) + " away from the nearest one" : ""));
    }
    return found;
  }

  static std::string text_of(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", x);
    return text;
  }

  // ---- shells and solids ----

  [[nodiscard]] bool is_apart(const TopoDS_Shape& part) const {
    const bool is_solid = part.ShapeType() == TopAbs_SOLID;
    for (TopExp_Explorer e(part, TopAbs_FACE); e.More(); e.Next()) {
      const int f = faces_.FindIndex(e.Current());
      if (is_across(f) || (!is_whole_ && is_in_plane(f))) return false;
    }
    if (is_solid || is_whole_) return true;
    for (TopExp_Explorer e(part, TopAbs_EDGE); e.More(); e.Next())
      if (is_in_plane(TopoDS::Edge(e.Current()))) return false;
    return true;
  }

  // The pieces, or their images, or both: first all pieces, then the images in their order.
  [[nodiscard]] TopoDS_Shape shell_of(const TopoDS_Shape& shell, bool mirrored, bool apart) const {
    const BRep_Builder builder;
    TopoDS_Shell made;
    builder.MakeShell(made);
    for (const bool images : {false, true}) {
      if (apart && images != mirrored) continue;
      for (TopoDS_Iterator it(shell); it.More(); it.Next()) {
        if (it.Value().ShapeType() != TopAbs_FACE) continue;
        // Pieces are of the face as the shape's map has it; this use may be turned.
        const bool turned = faces_(faces_.FindIndex(it.Value())).Orientation() != it.Value().Orientation();
        for (const TopoDS_Shape& piece : pieces_of_.Find(it.Value())) {
          const TopoDS_Shape use = images ? mirrored_.Find(piece) : piece;
          builder.Add(made, turned ? use.Reversed() : use);
        }
      }
    }
    made.Closed(BRep_Tool::IsClosed(made));
    return made.Oriented(shell.Orientation());
  }

  [[nodiscard]] TopoDS_Shape solid_of(const TopoDS_Shape& solid, bool mirrored, bool apart) const {
    const BRep_Builder builder;
    TopoDS_Solid made;
    builder.MakeSolid(made);
    for (TopoDS_Iterator it(solid); it.More(); it.Next())
      if (it.Value().ShapeType() == TopAbs_SHELL)
        if (const TopoDS_Shape shell = shell_of(it.Value(), mirrored, apart); shell.NbChildren() > 0) builder.Add(made, shell);
    return made.Oriented(solid.Orientation());
  }

  TopoDS_Shape shape_;
  gp_Pln plane_;
  gp_Trsf map_;
  TopTools_ListOfShape loose_;
  double diagonal_ = 0, reach_ = 0, near_ = 0;
  bool is_whole_ = false;
  TopTools_IndexedMapOfShape faces_;
  std::vector<Extent> heights_;
  TopTools_DataMapOfShapeListOfShape parts_;      // of faces across the plane
  TopTools_DataMapOfShapeListOfShape pieces_of_;  // by face
  TopTools_ListOfShape pieces_;
  TopTools_DataMapOfShapeShape mirrored_;         // by piece
  TopTools_DataMapOfShapeShape holder_;           // by face of the result
  TopTools_DataMapOfShapeListOfShape images_;
};

}  // namespace

void mirror(ShapeFile& file, const MirrorPlane& plane) {
  Mirror work(file.shape, plane);
  work.run();
  TopTools_ListOfShape parts, result;
  add_parts(file.shape, TopAbs_SOLID, TopAbs_SHAPE, parts);
  add_parts(file.shape, TopAbs_SHELL, TopAbs_SOLID, parts);
  for (const TopoDS_Shape& part : parts) {
    TopTools_ListOfShape made = work.rebuilt(part);
    result.Append(made);
  }
  work.name_other_half(parts);
  TopTools_ListOfShape faces;
  add_parts(file.shape, TopAbs_FACE, TopAbs_SHELL, faces);
  work.add_free(faces, result);
  file = with_images(file, compound_of(result), [&work](const TopoDS_Shape& shape) { return work.images_of(shape); }, &work.loose());
}

}  // namespace carreau_occ
