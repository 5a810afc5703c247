#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "model/topology.h"
#include "support/error.h"

namespace carreau {

namespace {

class ModelChecker {
 public:
  explicit ModelChecker(const Model& model) : model_(model) {}

  std::vector<std::string> run() {
    if (model_.faces.empty()) add({}, 0, "there is no surface");
    const bool zero = needs_gluing(model_);
    for (const Face& face : model_.faces) {
      check_face(face);
      for (std::size_t c = 0; c < face.curves.size(); ++c) check_curve(face, static_cast<int>(c), zero);
      if (!zero) check_loops(face);
    }
    return std::move(defects_);
  }

 private:
  void add(Where where, int line, const std::string& sentence) {
    if (line > 0) where.file = model_.source, where.line = line;
    defects_.push_back(where.prefix() + sentence);
  }
  static std::string of_line(int line) { return line > 0 ? " (line " + std::to_string(line) + ")" : ""; }

  void check_face(const Face& face) {
    const Where where{.face = face.ref};
    const auto [it, added] = faces_.try_emplace(face.ref, &face);
    if (!added) add(where, face.line, "another surface has the same reference" + of_line(it->second->line));
    if (face.ref == 0) add(where, face.line, "the reference of a surface cannot be zero");
    if (face.curves.empty()) add(where, face.line, "the surface has no curve");
    const int ic = std::abs(face.orientation);
    if (ic < 1 || static_cast<std::size_t>(ic) > face.curves.size())
      add(where, face.line,
          "orientation " + std::to_string(face.orientation) + " names no curve of the surface (it has " +
              std::to_string(face.curves.size()) + ")");
    else if (face.curves[ic - 1].type != CurveType::boundary)
      add(where, face.line,
          "orientation names curve " + std::to_string(ic) + ", which is not of the boundary type (typc 1)");
  }

  void check_curve(const Face& face, int c, bool zero) {
    const FaceCurve& curve = face.curves[c];
    const Where where{.face = face.ref, .curve_index = c + 1, .curve = curve.ref};
    if (curve.type != CurveType::boundary && curve.type != CurveType::internal)
      add(where, curve.line, "typc must be 1 (boundary) or 2 (internal)");
    if (zero) return;  // references are found later, whatever stands here
    if (curve.ref <= 0 || curve.end1 <= 0 || curve.end2 <= 0) {
      add(where, curve.line,
          "references must be positive (refc " + std::to_string(curve.ref) + ", refp1 " + std::to_string(curve.end1) +
              ", refp2 " + std::to_string(curve.end2) +
              "); to have them found, the very first curve must have the reference 0");
      return;
    }
    const auto [it, first] = ends_.try_emplace(curve.ref, &curve);
    if (!first && std::minmax(curve.end1, curve.end2) != std::minmax(it->second->end1, it->second->end2))
      add(where, curve.line,
          "its ends " + std::to_string(curve.end1) + " and " + std::to_string(curve.end2) +
              " are not those of the first curve of this reference, " + std::to_string(it->second->end1) + " and " +
              std::to_string(it->second->end2) + of_line(it->second->line));
    if (curve.type == CurveType::boundary && ++uses_[{face.ref, curve.ref}] == 3)
      add(where, curve.line, "the curve bounds this surface more than twice (twice is a seam)");
    if (curve.type == CurveType::internal && ++internal_uses_[{face.ref, curve.ref}] == 2)
      add(where, curve.line, "the internal curve stands twice in this surface");
  }

  // Whatever the order of the curves, an even number of boundary ends meets at each point of the boundary.
  void check_loops(const Face& face) {
    std::map<int, int> ends;
    for (const FaceCurve& curve : face.curves)
      if (curve.type == CurveType::boundary) ++ends[curve.end1], ++ends[curve.end2];
    for (const auto& [point, count] : ends)
      if (count % 2 != 0)
        add({.face = face.ref, .point = point}, face.line,
            "the boundary does not close: " + std::to_string(count) + " boundary curve" +
                (count == 1 ? " ends" : "s end") + " there");
  }

  const Model& model_;
  std::vector<std::string> defects_;
  std::map<int, const Face*> faces_;
  std::map<int, const FaceCurve*> ends_;
  std::map<std::pair<int, int>, int> uses_, internal_uses_;
};

}  // namespace

std::vector<std::string> find_model_defects(const Model& model) { return ModelChecker(model).run(); }

}  // namespace carreau
