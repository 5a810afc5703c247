// Mesh of a composite surface: supports, sizes, curves, domains, patches, assembly (design: "From input to mesh").
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "curve/support.h"
#include "mesh/surface_mesh.h"
#include "model/topology.h"
#include "size/control_space.h"
#include "size/graded_field.h"
#include "size/size_rules.h"
#include "support/monitor.h"
#include "surface/face_metric.h"

namespace carreau {

/// What becomes of faces whose two long sides are nearer to each other than a share of the prescribed size.
enum class NarrowFaces : int {
  keep,       ///< nothing special
  one_layer,  ///< vertices face to face on both sides, one layer of triangles between
  collapse    ///< the face vanishes: its two sides become one curve for all neighbours
};

struct CompositeOptions {
  SizeParameters size;
  double angle_smo = 1;  ///< degrees
  double lss = 0.5;
  double eps_ends = 0;  ///< model length; shorter curves are reported
  int check_close_edges = 0, check_adjacent_edges = 0, check_well_defined = 0;  ///< iterations
  double coef_rectangle = 0.25;
  /// What becomes of faces narrower than narrow_ratio times the size prescribed on their curves.
  NarrowFaces narrow_faces = NarrowFaces::keep;
  double narrow_ratio = 0.1;
  /// Largest ratio of sizes one unit edge apart (Borouchaki, Hecht, Frey): > 1; 0: none.
  double gradation = 0;
  /// Ratio by which sizes inside a face grow at most from one edge to the next, away from boundary edges that are
  /// shorter than prescribed: > 1; 0: they do not depend on them. Isotropic sizes alone.
  double edge_gradation = 0;
  /// Vertices of one side of a strip of one layer go where they face the middles of the other side's edges
  /// (staggering.h).
  bool stagger_strips = false;
  /// At the worst triangles of each patch changes of the mesh are tried, and the best is kept.
  bool shape_trials = false;
  /// Least number of layers of triangles between boundaries of a face that are near each other, and sizes of the gap
  /// over this number on faces that face each other and share no corner (> 0 needs a gradation); 0: they are not looked
  /// for.
  int proximity = 0;
  /// A face that the host fails on while its patch is meshed fails alone; false: its CallbackError comes out.
  bool failing_faces_alone = false;
  bool frontal = true;
  std::int64_t max_triangles = 0;  ///< 0: by memory
  /// Threads at work, the caller's among them. The mesh does not depend on it. A host that is not re-entrant is called
  /// from the caller's thread only.
  int threads = 1;
};

/// What a run did, besides the mesh.
struct CompositeReport {
  CallCounts calls;
  double diag = 0;
  /// Patches meshed again because their lengths in space were not those that the sampling promised.
  int corrections = 0;
  int gradation_rounds = 0;             ///< graphs that the gradation has made
  std::size_t gradation_triangles = 0;  ///< of the last one
  double seconds_gradation = 0, seconds_curves = 0;
  double seconds_sampling = 0, seconds_plane = 0, seconds_lift = 0;  ///< sums over all threads
  double seconds_total = 0;
};

/// How far the faces of a curve leave its vertices (DiscreteCurve::gap), and which use is farthest.
struct CurveGap {
  double gap = 0;
  int use = 0;
};

struct CompositeResult {
  SurfaceMesh mesh;
  std::vector<double> vertex_size;                  ///< prescribed size at each vertex
  std::vector<FaceInterfaces> interfaces;           ///< by face; empty where the domain could not be made
  std::vector<std::optional<ControlSpace>> spaces;  ///< by face: what the mesher used; empty: it was not sampled
  std::shared_ptr<const GradedField> graded;        ///< bounds the sizes inside faces; null without gradation
  /// [curve of mesh.curves][its vertex]: prescribed size along the curve; empty for a curve without edges.
  std::vector<std::vector<double>> curve_size;
  std::vector<CurveGap> gaps;  ///< by curve of the topology
  CompositeReport report;
};

/// Supports of every curve of every face, and the diagonal of their box (what RT-0232 calls diag).
struct ModelSupports {
  std::vector<std::vector<CurveSupport>> of_face;  ///< [face][curve]
  double diag = 0;
};
/// `threads`: at most; a host that is not re-entrant is called from the caller's thread only. `failures`: gets, by
/// face, why the host failed on its curves, which are then not complete, or ""; null: the CallbackError comes out.
ModelSupports build_supports(const Model& model, Cad& cad, double angle_smo, int threads, Monitor& monitor,
                             std::vector<std::string>* failures = nullptr);
CurveTraces traces_of(const ModelSupports& supports);

CompositeResult mesh_composite(const Model& model, const Topology& topology, const ModelSupports& supports, Cad& cad,
                               const CompositeOptions& options, Monitor& monitor);

}  // namespace carreau
