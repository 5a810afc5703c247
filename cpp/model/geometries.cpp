// SPDX-License-Identifier: BSD-3-Clause
#include "model/geometries.h"

#include <algorithm>
#include <limits>

#include "model/topology.h"
#include "support/error.h"

namespace carreau {
namespace {

void raise(int& largest, int ref) { largest = std::max(largest, ref); }

void raise_by_curves(LargestReferences& largest, const Face& face) {
  for (const FaceCurve& curve : face.curves) {
    raise(largest.curve, curve.ref), raise(largest.curve, curve.shown_as);
    raise(largest.point, curve.end1), raise(largest.point, curve.end2);
  }
}

LargestReferences largest_of_faces(const Model& model) {
  LargestReferences largest;
  for (const Face& face : model.faces) {
    raise(largest.face, face.ref), raise(largest.face, face.part_of);
    raise_by_curves(largest, face);
    for (const FacePoint& point : face.points) raise(largest.point, point.ref);
  }
  for (const auto& [point, shown] : model.shown_points) raise(largest.point, point), raise(largest.point, shown);
  return largest;
}

/// References that were not known are found as 1, 2, ... by gluing: one a curve, two for its ends.
void keep_room(const Model& part, LargestReferences& largest) {
  if (!needs_gluing(part)) return;
  int curves = 0;
  for (const Face& face : part.faces) curves += static_cast<int>(face.curves.size());
  raise(largest.curve, curves), raise(largest.point, 2 * curves);
}

void refuse_negative(const Model& part) {
  if (part.faces.empty()) throw InvalidModel("the geometry has no face");
  for (const Face& face : part.faces) {
    bool good = face.ref > 0;
    for (const FaceCurve& c : face.curves) good = good && c.ref >= 0 && c.end1 >= 0 && c.end2 >= 0;
    for (const FacePoint& p : face.points) good = good && p.ref >= 0;
    if (!good)
      throw InvalidModel(Where{.face = face.ref},
                         "a reference of the face, of its curves or of its points is not positive");
  }
}

void refuse_overflow(int first, int second) {
  if (second > std::numeric_limits<int>::max() - first)
    throw InvalidModel("references of " + std::to_string(second) + " behind others of " + std::to_string(first) +
                       " are too large");
}

int moved(int ref, int offset) { return ref != 0 ? ref + offset : 0; }

int largest_solid(const EntityNames& names) {
  int largest = names.solids.empty() ? 0 : names.solids.rbegin()->first;
  for (const auto& [face, sides] : names.face_solids) raise(largest, sides[0]), raise(largest, sides[1]);
  return largest;
}

/// Solids have numbers of their own, which follow one another too.
void append_names(const EntityNames& part, const LargestReferences& before, EntityNames& names) {
  const int solid_offset = largest_solid(names);
  refuse_overflow(solid_offset, largest_solid(part));
  for (const auto& [ref, name] : part.points) names.points[moved(ref, before.point)] = name;
  for (const auto& [ref, name] : part.curves) names.curves[moved(ref, before.curve)] = name;
  for (const auto& [ref, name] : part.solids) names.solids[moved(ref, solid_offset)] = name;
  for (const auto& [face, sides] : part.face_solids)
    names.face_solids[moved(face, before.face)] = {moved(sides[0], solid_offset), moved(sides[1], solid_offset)};
}

void move_curves(Face& face, int curve_offset, int point_offset) {
  for (FaceCurve& curve : face.curves) {
    curve.ref = moved(curve.ref, curve_offset), curve.shown_as = moved(curve.shown_as, curve_offset);
    curve.end1 = moved(curve.end1, point_offset), curve.end2 = moved(curve.end2, point_offset);
  }
}

}  // namespace

LargestReferences largest_references(const Model& model) {
  LargestReferences largest = largest_of_faces(model);
  for (const GeometryRange& range : model.geometries)
    raise(largest.face, range.last_face), raise(largest.curve, range.last_curve),
        raise(largest.point, range.last_point);
  return largest;
}

GeometryRange append_geometry(Model& model, Model part) {
  refuse_negative(part);
  const LargestReferences before = largest_references(model);
  LargestReferences own = largest_of_faces(part);
  keep_room(part, own);
  refuse_overflow(before.face, own.face), refuse_overflow(before.curve, own.curve);
  refuse_overflow(before.point, own.point);
  model.plane = part.plane && model.faces.empty();
  model.geometries.push_back({.first_face = before.face + 1,
                              .last_face = before.face + own.face,
                              .first_curve = before.curve + 1,
                              .last_curve = before.curve + own.curve,
                              .first_point = before.point + 1,
                              .last_point = before.point + own.point});
  for (Face& face : part.faces) {
    face.ref += before.face, face.part_of = moved(face.part_of, before.face);
    face.geometry = static_cast<int>(model.geometries.size());
    face.line = 0;  // of a file that is not the model's
    move_curves(face, before.curve, before.point);
    for (FacePoint& point : face.points) point.ref = moved(point.ref, before.point);
    model.faces.push_back(std::move(face));
  }
  for (const auto& [point, shown] : part.shown_points)
    model.shown_points[moved(point, before.point)] = moved(shown, before.point);
  append_names(part.names, before, model.names);
  return model.geometries.back();
}

bool is_mixed(const Model& model) {
  return std::any_of(model.faces.begin(), model.faces.end(),
                     [&](const Face& face) { return face.geometry != model.faces.front().geometry; });
}

std::vector<int> geometries_to_glue(const Model& model) {
  std::vector<int> found;
  for (int g = 0; g <= static_cast<int>(model.geometries.size()); ++g)
    if (needs_gluing(part_of(model, g).model)) found.push_back(g);
  return found;
}

GeometryPart part_of(const Model& model, int geometry) {
  GeometryPart part;
  part.model.source = model.source;
  for (std::size_t f = 0; f < model.faces.size(); ++f)
    if (model.faces[f].geometry == geometry) part.model.faces.push_back(model.faces[f]), part.faces.push_back(f);
  return part;
}

void put_back(const GeometryPart& part, int geometry, Model& model) {
  const LargestReferences behind = largest_references(model);
  LargestReferences own;
  for (const Face& face : part.model.faces) raise_by_curves(own, face);
  int curve_offset = behind.curve, point_offset = behind.point;
  if (geometry > 0) {
    const GeometryRange& room = model.geometries[static_cast<std::size_t>(geometry - 1)];
    if (own.curve <= room.last_curve - room.first_curve + 1) curve_offset = room.first_curve - 1;
    if (own.point <= room.last_point - room.first_point + 1) point_offset = room.first_point - 1;
  }
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    Face face = part.model.faces[f];
    move_curves(face, curve_offset, point_offset);
    model.faces[part.faces[f]].curves = std::move(face.curves);
  }
}

}  // namespace carreau
