// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>

#include "model/geometries.h"
#include "model/places.h"
#include "model/topology.h"

namespace carreau {

namespace {

class ModelChecker {
 public:
  explicit ModelChecker(const Model& model) : model_(model), gluing_(model.geometries.size() + 1, needs_gluing(model)) {
    if (!is_mixed(model)) return;
    gluing_.assign(gluing_.size(), false);
    for (const int geometry : geometries_to_glue(model)) gluing_[static_cast<std::size_t>(geometry)] = true;
  }

  std::vector<ModelDefect> run() {
    if (model_.faces.empty()) add({.file = model_.source}, "the model has no face");
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
      check_face(f);
      if (!model_.faces[f].left_out.empty() || model_.faces[f].discrete) continue;
      if (model_.faces[f].is_wire())
        check_wire(f);
      else
        check_orientation(f);
      const bool gluing = gluing_[static_cast<std::size_t>(model_.faces[f].geometry)];
      for (std::size_t c = 0; c < model_.faces[f].curves.size(); ++c) {
        check_type(f, c);
        // The very first curve decides (RT-0232 sec. 3.2); the references of other curves are ignored.
        if (!gluing && check_positive(f, c)) check_uses(f, c);
      }
      if (!gluing) check_loops(f);
      check_points(f);
    }
    return std::move(defects_);
  }

 private:
  void add(const Where& where, const std::string& sentence) { defects_.push_back({where, sentence}); }

  [[nodiscard]] Where place(std::size_t f, int line) const {
    Where where{.face = model_.faces[f].ref};
    if (line > 0) where.file = model_.source, where.line = line;
    return where;
  }
  [[nodiscard]] Where face_place(std::size_t f) const { return place(f, model_.faces[f].line); }
  // As in "face number 3": ranks distinguish faces with equal references.
  static std::string rank(std::size_t index) { return std::to_string(index + 1); }

  void check_face(std::size_t f) {
    const Face& face = model_.faces[f];
    if (face.ref <= 0)
      add(face_place(f), "the reference of a face must be positive; face number " + rank(f) + " has " +
                             std::to_string(face.ref));
    const auto [it, added] = faces_.try_emplace(face.ref, f);
    if (!added)
      add(face_place(f), "face number " + rank(f) + " has the same reference as face number " + rank(it->second) +
                             of_line(model_.faces[it->second].line));
  }

  void check_orientation(std::size_t f) {
    const Face& face = model_.faces[f];
    const bool bounded = std::any_of(face.curves.begin(), face.curves.end(),
                                     [](const FaceCurve& c) { return c.type == CurveType::boundary; });
    if (!bounded) {
      add(face_place(f), face.curves.empty() ? "the face has no curve" : "the face has no curve of type 1 (boundary)");
      return;  // no orientation could be right
    }
    // Not std::abs, which overflows for the least int.
    const long long ic = std::llabs(static_cast<long long>(face.orientation));
    const std::string name = "orientation " + std::to_string(face.orientation);
    if (ic < 1 || ic > static_cast<long long>(face.curves.size()))
      add(face_place(f), name + " names no curve of the face, which has " + std::to_string(face.curves.size()));
    else if (const FaceCurve& curve = face.curves[static_cast<std::size_t>(ic) - 1]; curve.type != CurveType::boundary)
      add(face_place(f),
          name + " names curve " + std::to_string(ic) + of_line(curve.line) + ", which is not of type 1 (boundary)");
  }

  // Curves of space: nothing lies beside them.
  void check_wire(std::size_t f) {
    const Face& face = model_.faces[f];
    if (face.curves.empty()) add(face_place(f), "the wire (orientation 0) has no curve");
    if (!face.points.empty())
      add(face_place(f),
          "a wire (orientation 0) has no area that points could lie in; its points are ends of its curves");
    for (std::size_t c = 0; c < face.curves.size(); ++c)
      if (face.curves[c].type == CurveType::boundary)
        add(place_of(model_, f, c), "a wire (orientation 0) bounds nothing: its curves have type 2 (internal), not 1");
  }

  void check_type(std::size_t f, std::size_t c) {
    const CurveType type = model_.faces[f].curves[c].type;
    if (type != CurveType::boundary && type != CurveType::internal)
      add(place_of(model_, f, c),
          "the type of a curve must be 1 (boundary) or 2 (internal); it is " + std::to_string(static_cast<int>(type)));
  }

  static std::string references(const FaceCurve& c) {
    return "refc " + std::to_string(c.ref) + ", refp1 " + std::to_string(c.end1) + ", refp2 " + std::to_string(c.end2);
  }

  bool check_positive(std::size_t f, std::size_t c) {
    const FaceCurve& curve = model_.faces[f].curves[c];
    if (curve.ref > 0 && curve.end1 > 0 && curve.end2 > 0) return true;
    const bool negative = curve.ref < 0 || curve.end1 < 0 || curve.end2 < 0;
    add(place_of(model_, f, c), negative ? "references must be positive (" + references(curve) + ")"
                                         : "zero references are mixed with others (" + references(curve) +
                                               "): to find references, the references of all curves must be 0");
    return false;
  }

  void check_uses(std::size_t f, std::size_t c) {
    const FaceCurve& curve = model_.faces[f].curves[c];
    const auto [it, first] = curves_.try_emplace(curve.ref, &curve);
    if (!first && std::minmax(curve.end1, curve.end2) != std::minmax(it->second->end1, it->second->end2))
      add(place_of(model_, f, c), "its ends " + std::to_string(curve.end1) + " and " + std::to_string(curve.end2) +
                                      " differ from the ends of the first curve of this reference, " +
                                      std::to_string(it->second->end1) + " and " + std::to_string(it->second->end2) +
                                      of_line(it->second->line));
    std::vector<std::size_t>& uses = uses_[{f, curve.ref, curve.type}];
    uses.push_back(c);
    std::string others;  // those before
    for (std::size_t i = 0; i + 1 < uses.size(); ++i)
      others += (i == 0 ? "" : " and ") + std::to_string(uses[i] + 1) + of_line(model_.faces[f].curves[uses[i]].line);
    if (curve.type == CurveType::boundary && uses.size() > 2)
      add(place_of(model_, f, c), "the reference belongs to boundary curves " + others +
                                      " of the face already; twice is a seam, more is not possible");
    if (curve.type == CurveType::internal && uses.size() > 1)
      add(place_of(model_, f, c), "the reference belongs to internal curve " + others + " of the face already");
  }

  // Loops close whatever the order of the curves: at each point of the boundary an even number of ends meets. Curves
  // whose references are wrong have their own sentence.
  void check_loops(std::size_t f) {
    std::map<int, std::vector<std::size_t>> ends;
    for (std::size_t c = 0; c < model_.faces[f].curves.size(); ++c) {
      const FaceCurve& curve = model_.faces[f].curves[c];
      if (curve.type != CurveType::boundary) continue;
      if (curve.ref <= 0 || curve.end1 <= 0 || curve.end2 <= 0) return;
      ends[curve.end1].push_back(c);
      ends[curve.end2].push_back(c);
    }
    for (const auto& [point, curves] : ends) {
      if (curves.size() % 2 == 0) continue;
      Where where = place_of(model_, f, curves.front());
      where.curve_index = where.curve = 0;
      where.point = point;
      std::string names;
      for (std::size_t i = 0; i < curves.size(); ++i)
        names += (i == 0 ? "" : i + 1 == curves.size() ? " and " : ", ") + std::to_string(curves[i] + 1);
      add(where, "the boundary of the face does not close: boundary curve" +
                     (curves.size() == 1 ? " " + names + " ends there alone"
                                         : "s " + names + " end there, which is an odd number of ends"));
    }
  }

  void check_points(std::size_t f) {
    std::map<std::pair<double, double>, std::size_t> known;
    const std::vector<FacePoint>& points = model_.faces[f].points;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const FacePoint& point = points[p];
      const std::string name = "internal point " + rank(p);
      if (point.ref < 0)
        add(place(f, point.line),
            "the reference of " + name + " must not be negative; it is " + std::to_string(point.ref));
      if (!is_finite(point.uv)) {
        add(place(f, point.line), "the coordinates of " + name + " are not finite");
        continue;
      }
      // + 0.0: no negative zero.
      const auto [it, added] = known.try_emplace({point.uv.x() + 0.0, point.uv.y() + 0.0}, p);
      if (added) continue;
      Where where = place(f, point.line);
      where.uv = point.uv;
      add(where,
          name + " is at the same place as internal point " + rank(it->second) + of_line(points[it->second].line));
    }
  }

  struct UseKey {
    std::size_t face;
    int ref;
    CurveType type;
    auto operator<=>(const UseKey&) const = default;
  };

  const Model& model_;
  std::vector<bool> gluing_;  // by geometry: all references are to be found
  std::vector<ModelDefect> defects_;
  std::map<int, std::size_t> faces_;        // by reference
  std::map<int, const FaceCurve*> curves_;  // first of each reference
  std::map<UseKey, std::vector<std::size_t>> uses_;
};

}  // namespace

std::vector<ModelDefect> list_model_defects(const Model& model) { return ModelChecker(model).run(); }

std::vector<std::string> find_model_defects(const Model& model) {
  std::vector<std::string> sentences;
  for (const ModelDefect& defect : list_model_defects(model)) sentences.push_back(defect.text());
  return sentences;
}

}  // namespace carreau
