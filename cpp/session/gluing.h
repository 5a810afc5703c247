// SPDX-License-Identifier: BSD-3-Clause
// References found in space, for hosts that do not know them (RT-0232 sec. 3.2, HDR sec. 4.5.1).
#pragma once

#include <string>
#include <vector>

#include "cad/part_cad.h"
#include "model/model.h"
#include "support/monitor.h"
#include "surface/result.h"
#include "surface/supports.h"

namespace carreau {

/// The parts of curves that a model uses.
PartCad::Parts parts_of(const Model& model);

struct Gluing {
  double eps = 0;        ///< eps_glue, model length
  double eps_open = 0;   ///< eps_glue_open, model length; 0: none
  double eps_face = 0;   ///< eps_glue_face, model length; 0: a thousandth of eps
  double angle_smo = 1;  ///< of supports, degrees
};

/// A curve of space in a mesh, and the gap between its faces.
struct Interface {
  int ref = 0;
  int uses = 0;           ///< in all faces; 1: open when it is on a boundary
  Where first, farthest;  ///< face and rank of the vertices on the surface, and of the largest gap
  bool boundary = false;  ///< on one in a face at least
  bool glued = false;     ///< uses were found to be one by comparing them
  bool degenerate = false;
  bool loose = false;  ///< of wires alone
  double gap = 0;  ///< model length: of vertices from the surface of `farthest`, or between curves that were glued
};

/// Gives references to a model without any: cuts curves at the ends of curves of other faces, then glues
/// (model/splits.h, model/topology.h). A model with references keeps them; only the curves of curves_to_glue() are
/// compared. `supports` belong to the model, before and after. Reports its results: a summary, and in detail each pair
/// with its gap and each curve that stays open. `remarks`: as glue(). Throws the host's exceptions.
Model find_references(const Model& model, ModelSupports& supports, Cad& cad, const Gluing& options,
                      std::vector<std::string>& remarks, GlueReport& report, Monitor& monitor);

/// Finds the references of each geometry of a mixed model (model/geometries.h) that has none, one geometry at a time.
/// `report` receives the results for all of them.
void find_references_of_geometries(Model& model, ModelSupports& supports, Cad& cad, const Gluing& options,
                                   std::vector<std::string>& remarks, GlueReport& report, Monitor& monitor);

/// An imposed point at which a curve without a reference was cut.
struct PointOnCurve {
  std::size_t face = 0;  ///< index
  int curve = 0;         ///< the host's rank, from 1
  double t = 0;
  int ref = 0;  ///< of the point
};

/// Cuts curves at imposed points of their faces that lie on them (within 2e-5 of diag), in all uses of one reference, and
/// removes these points. A point at an end of a curve is the corner there. Prescribed edges are not cut: their points
/// stay, and the face fails. The cut of a model with references has the reference of the point, if no corner has it.
/// Otherwise results show it. Returns the points of curves whose references are sought. Throws the host's exceptions.
std::vector<PointOnCurve> put_points_on_curves(Model& model, ModelSupports& supports, Cad& host, const Gluing& options,
                                               Monitor& monitor);
/// Gives these points their references when the references of the model have been found.
void name_points_on_curves(Model& model, const std::vector<PointOnCurve>& points);
bool has_corner(const Model& model, int ref);

/// The curves of a mesh, in the order of the topology. `gaps` as CompositeResult has them.
std::vector<Interface> list_interfaces(const Model& model, const Topology& topology, const std::vector<CurveGap>& gaps,
                                       const GlueReport& report);
/// Reports the numbers of shared and open curves, and the widest gap.
void tell_interfaces(const std::vector<Interface>& interfaces, Monitor& monitor);

}  // namespace carreau
