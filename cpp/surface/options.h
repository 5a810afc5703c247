// SPDX-License-Identifier: BSD-3-Clause
// Options of a mesh of a composite surface.
#pragma once

#include <cstdint>

#include "mesh/cells.h"
#include "size/size_rules.h"
#include "support/ranks/executor.h"

namespace carreau {

/// The treatment of faces whose two long sides are nearer to each other than a share of the prescribed size.
enum class NarrowFaces : int {
  keep,       ///< nothing special
  one_layer,  ///< vertices face to face on both sides, one layer of triangles between
  collapse    ///< the face vanishes: its two sides become one curve for all neighbours
};

/// The triangles that get bounds: none, triangles that the normals at their corners make suspect, or all.
enum class Certified : char { none = 0, suspects = 1, all = 2 };

struct CompositeOptions {
  SizeParameters size;
  Element element = Element::p1;
  double angle_smo = 1;  ///< degrees
  double lss = 0.5;
  double eps_ends = 0;  ///< model length; shorter curves are reported
  int check_close_edges = 0, check_adjacent_edges = 0, check_well_defined = 0;  ///< iterations
  double coef_rectangle = 0.25;
  double adjacent_ratio = 2;  ///< >= 2: largest of lengths of adjacent edges that check_adjacent_edges leaves
  /// The treatment of faces narrower than narrow_ratio times the size prescribed on their curves.
  NarrowFaces narrow_faces = NarrowFaces::keep;
  double narrow_ratio = 0.1;
  /// Largest ratio of sizes one unit edge apart (Borouchaki, Hecht, Frey): > 1; 0: no limit.
  double gradation = 0;
  /// Largest ratio of sizes inside a face from one edge to the next, > 1; 0: no limit. It acts away from boundary edges
  /// that are shorter than prescribed. For isotropic sizes only.
  double edge_gradation = 0;
  /// Vertices of one side of a strip of one layer go where they face the middles of the other side's edges
  /// (staggering.h).
  bool stagger_strips = false;
  bool cracks = false;  ///< vertices of internal curves are doubled
  /// Tests changes of the mesh at the worst triangles of each patch and keeps the best.
  bool shape_trials = false;
  /// Least number of layers of triangles between boundaries of a face that are near each other; 0: they are not looked
  /// for. A value > 0 needs a gradation. Faces that face each other and share no corner get sizes of the gap over this
  /// number.
  int proximity = 0;
  /// If the host fails on a face while its patch is meshed, only this face fails; false: the CallbackError is thrown.
  bool failing_faces_alone = false;
  /// Measures give upper bounds of A0 and A1.
  bool measure_bounds = true;
  /// Triangles of cross-patch meshes are edited if their bounds are beyond the tolerances
  /// (surface/remesh/certify).
  Certified certified = Certified::suspects;
  /// Times that a mesh is made again with smaller triangles at avoidable crossings; 0: crossings are not looked for.
  int crossing_rounds = 0;
  /// Largest work of all these rounds together over the work of the first mesh.
  double rounds_over_first_mesh = 1;
  /// Meshes are made again, with smaller sizes at invalid elements.
  bool refines_invalid_elements = true;
  bool frontal = true;
  /// Borders between patches whose normals differ by no more than sharp_angle (degrees) have no meaning: triangles
  /// cross them (surface/remesh).
  bool independent = false;
  double sharp_angle = 1;
  std::int64_t max_triangles = 0;  ///< 0: by memory
  /// Threads, including the caller's, and processes. The mesh does not depend on them. A host that is not re-entrant is called from the
  /// caller's thread only.
  Executor executor = {};
  /// Patches stay with the process that has meshed them: no process has the whole mesh (pipeline/parts), unless a step needs it.
  bool parts = false;
};

/// Returns whether several threads may call the host: it allows that, and sources of prescriptions are absent.
inline bool asks_from_threads(const CompositeOptions& options, const Cad& cad) noexcept {
  return options.executor.threads > 1 && cad.reentrant() && options.size.sources.empty();
}

/// Throws LimitError for a mesh beyond CompositeOptions::max_triangles.
[[noreturn]] void refuse_triangles(const Where& where, double expected, std::int64_t most);

}  // namespace carreau
