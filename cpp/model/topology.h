// SPDX-License-Identifier: BSD-3-Clause
// Finds curves and points that are one in space.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"
#include "support/error.h"
#include "support/vec.h"

namespace carreau {

/// One appearance of a curve in a face. Indices from 0; ic = curve + 1.
struct CurveUse {
  int face = 0;   ///< index in Model::faces
  int curve = 0;  ///< index in Face::curves
  /// Runs against the first use of the same curve (its end1 is the first use's end2; closed curves: found in space).
  bool reversed = false;
};

/// A curve of space: all FaceCurves of one reference. The first use (in file order) defines its shape (RT-0232
/// sec. 3.2).
struct Curve {
  int ref = 0;
  std::vector<CurveUse> uses;  ///< two uses in one face: a seam
  int end1 = 0, end2 = 0;      ///< indices in Topology::points, in the direction of the first use
  bool degenerate = false;     ///< maps to one point of space (HDR sec. 4.5.4)
};

/// A point of space at ends of curves.
struct CornerPoint {
  int ref = 0;
  Vec3 position;            ///< from the first curve end that has this reference
  std::vector<int> curves;  ///< indices of the curves that end here, ascending, each once
};

struct Topology {
  std::vector<Curve> curves;        ///< in order of first appearance
  std::vector<CornerPoint> points;  ///< in order of first appearance
  /// curve_of[face][curve] = index in `curves`.
  std::vector<std::vector<int>> curve_of;
};

/// Checks every rule of RT-0232 sec. 3.2 that needs no geometry. One sentence a violation, with file and line when the
/// model was read from a file; empty when the model is sound. Before gluing (needs_gluing) references of curves and ends are arbitrary.
/// Afterwards all are positive, ends agree between the curves of one reference, and every boundary closes by its references. Seams (a
/// boundary reference twice in one face) and curves that return to their starting point (closed, degenerate) are legal, although the manual
/// forbade them. Only the references of omitted faces are checked.
std::vector<std::string> find_model_defects(const Model& model);
/// The defects with their places, to leave a face out.
struct ModelDefect {
  Where where;
  std::string sentence;  ///< without the place
  [[nodiscard]] std::string text() const { return where.prefix() + sentence; }
};
std::vector<ModelDefect> list_model_defects(const Model& model);

/// Polylines that approximate the curves in space, from t = a to t = b: traces[face][curve], at least two points each.
using CurveTraces = std::vector<std::vector<std::vector<Vec3>>>;

/// The first curve of the first face that is not left out; nullptr: it has no curve. It decides whether references are
/// known.
const FaceCurve* first_curve(const Model& model);
/// True when references are to be found by gluing: the very first curve has reference 0.
bool needs_gluing(const Model& model);
/// Number of curves that have references although gluing will find them again.
std::size_t references_to_forget(const Model& model);

/// [face][curve]: whether gluing compares the curve with others: all curves, or, when the model has references already,
/// the boundary curves that one face has, once.
std::vector<std::vector<char>> curves_to_glue(const Model& model);

/// The results of gluing. Indices of faces and of curves in them.
struct GlueReport {
  struct Place {
    std::size_t face = 0, curve = 0;
  };
  /// Two curves that became one, and their two-sided Hausdorff distance beyond the deviation of their traces.
  struct Pair {
    Place a, b;
    double gap = 0;
  };
  std::vector<Pair> pairs;
  std::vector<Place> open;  ///< boundary curves that no other one shares and that are not points
};

/// Gives references to all curves and points by comparing them in space (RT-0232 sec. 3.2, HDR sec. 4.5.1). Points
/// nearer than eps_glue (model length) are one. Curves are one when their ends are one and their two-sided Hausdorff
/// distance is below eps_glue plus the deviation of their traces. Two sides of one face become a seam when they agree
/// within eps_face, up to the deviation of their traces (HDR's eps_1; 0: eps_glue / 1000). A curve that lies within
/// eps_glue of a point keeps a separate reference; its ends become one. Internal points keep their references. Ends are
/// numbered 2k - 1 and 2k for the k-th curve of the model, curves k; merged ends or curves take the smallest number
/// (the numbering of RT-0232 sec. 6.1, HDR fig. 4.18). `remarks` (may be null) receives a sentence for each curve whose
/// ends are merged although they differ by more than rounding; `report` (may be null) receives the results. Curves that
/// overlap in part only are one when they have been cut first (model/splits.h). References that the model has are kept:
/// only the curves of curves_to_glue() are compared, and merged curves or ends take the reference of the first. Throws
/// InvalidArgument when eps_glue is not positive or traces are missing.
///
/// With `eps_open` (model length) above eps_glue, curves that are open then are one with the nearest matching open
/// curve of another face. Their ends and their two-sided distance must lie within eps_open and a tenth of the lengths
/// of both. Their ends become one, unless both ends of some curve would become one point; pieces that such a gap has
/// cut off may. Short curves elsewhere limit eps_glue, not this.
Model glue(const Model& model, const CurveTraces& traces, double eps_glue, std::vector<std::string>* remarks = nullptr,
           GlueReport* report = nullptr, double eps_open = 0, double eps_face = 0);

/// Marks curves shorter than eps_collapse (model length) as collapsed, in all faces, and gives their two ends one
/// reference, the smallest (RT-0232 sec. 3.3). The first curve of a reference decides. Internal curves are kept, and so
/// are loops that would vanish. The model must have no defect. A sentence a curve in `remarks` (may be null).
/// Throws InvalidArgument when eps_collapse is negative or traces are missing.
Model collapse_tiny_curves(const Model& model, const CurveTraces& traces, double eps_collapse,
                           std::vector<std::string>* remarks = nullptr);

/// Collects curves and points. Finds directions; closed curves are compared at equal lengths. Finds degenerate curves:
/// collapsed curves, traces within eps / 1000 of a point, and open curves within `eps` of a point that have one
/// reference at both ends. The end references of a short trace become one corner; if a whole loop would vanish, the
/// limit is a thousandth of its longest side. `eps` (model length) is the largest distance of curves and ends of one
/// reference, or `eps_match` if that is more: `remarks` (may be null) receives a sentence when some are farther apart
/// than eps. The model must have no defect. Throws InvalidModel, naming faces, curves, references and the gap: curves
/// of one reference that are farther apart, ends away from the end of their reference (exchanged ends are named), refp1
/// = refp2 on a curve that does not return, a closed curve of undetermined direction. Throws InvalidArgument when eps
/// is not positive or traces are missing.
Topology build_topology(const Model& model, const CurveTraces& traces, double eps, double eps_match = 0,
                        std::vector<std::string>* remarks = nullptr);

}  // namespace carreau
