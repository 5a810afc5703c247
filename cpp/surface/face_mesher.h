// One patch: sample, mesh, lift.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "plane/plane_mesher.h"
#include "size/graded_field.h"
#include "size/size_rules.h"
#include "surface/composite.h"
#include "surface/domain_builder.h"

namespace carreau {

/// An edge inside a patch: its length in space over what the control space promises, and its ends in (u, v).
struct EdgeExcess {
  double ratio = 0;
  Vec2 from, to;
};

/// A meshed patch. Vertices are those of the domain first, unmoved, then new ones.
struct PatchMesh {
  PlaneMesh plane;
  std::vector<Vec3> xyz;     ///< position in space of every vertex of `plane`
  std::vector<double> size;  ///< prescribed size at every vertex
  /// Edges that exceed their promise a thousand times: where derivatives vanish, or the surface jumps.
  std::vector<EdgeExcess> excesses;
  /// Where metrics govern: unit normal of the surface at every vertex that is not imposed, zero at singular ones.
  std::vector<Vec3> normal;
};

/// What meshing a patch needs to know.
struct PatchInput {
  int face = 0;  ///< index in Model::faces
  int ref = 0;   ///< its reference
  const FaceDomain* domain = nullptr;
  /// Position in space of each vertex of the domain that lies on a curve; imposed points are evaluated.
  std::vector<Vec3> curve_xyz;
  /// Set when one size is prescribed everywhere (SizeRules::constant).
  std::optional<double> constant_size = {};
  /// Sizes do not differ by direction: triangles may be judged by their shape in space.
  bool isotropic = true;
  /// Metrics that govern may turn out to be sizes: as far as samples have shown (SampledFacts).
  bool one_size = true;
  /// What becomes of the prescribed sizes.
  SizeLimits limits = {};
  /// Largest derivative of sizes along the surface, kept in the control space too; 0: any.
  double slope = 0;
  /// Largest relative error of lengths in the control space.
  double tolerance = ControlSpaceOptions{}.tolerance;
};

/// The boundary of a domain.
SampledDomain sampled_domain(const PlaneDomain& domain);

/// What samples of a face tell beside its metric.
struct SampledFacts {
  SampledNormals* normals = nullptr;  ///< gets those at the samples, where given
  bool isotropic = true;              ///< sizes do not differ by direction at any of them
  /// Stops with UnevenSpeed where a derivative is so many times as long as it is usual: as `usual_speed`; 0: as it is
  /// along that parameter at the first samples.
  double usual_speed = 0;
  double most_uneven = std::numeric_limits<double>::infinity();
};

/// A place where the parametrisation is far faster than elsewhere. Not an error: sampling starts again in others.
struct UnevenSpeed {
  Vec2 uv;
  double times;  ///< as fast
};

/// How many times faster than usual a parametrisation may be somewhere: else other parameters are looked for; and where
/// there are none.
inline constexpr double uneven_speed = 1000, hopeless_speed = 30'000;

/// Lengths of derivatives at the first samples, all over the domain, and at those that follow.
class SpeedWatch {
 public:
  /// As SampledFacts::most_uneven and usual_speed.
  SpeedWatch(double most, double usual) : most2_(most * most), usual_u2_(usual * usual), usual_v2_(usual_u2_) {}
  /// Throws UnevenSpeed.
  void look(std::span<const Vec2> uv, std::span<const SurfaceJet> jets);

 private:
  void find_usual(std::span<const SurfaceJet> jets);

  double most2_, usual_u2_, usual_v2_;
};

/// Samples the metric of a face (FaceMetric) over its domain, within input.limits. `suspects`: see ControlSpaceOptions.
ControlSpace sample_face(const PatchInput& input, Cad& cad, const SizeRules& rules, std::span<const Vec2> suspects,
                         Monitor& monitor, SampledFacts* facts = nullptr);

/// Plane mesh in the sampled metric; asks no host.
PatchMesh mesh_patch(const PatchInput& input, const ControlSpace& space, const PlaneMesherOptions& options,
                     Monitor& monitor);

/// surf0 once for each vertex, then edges of the worst triangles are swapped where sizes are isotropic.
void lift_patch(const PatchInput& input, Cad& cad, PatchMesh& mesh, Monitor& monitor);

/// Sizes in the mean, sqrt(h1 h2), that FaceMetric prescribes within input.limits.
std::vector<double> prescribed_sizes(const PatchInput& input, Cad& cad, const SizeRules& rules,
                                     std::span<const Vec2> uv, Monitor& monitor);

/// Where sizes are isotropic: vertices and edges of bad triangles (BadRegion) are moved and swapped for their shapes in
/// space. Of a lifted mesh whose sizes are known; keeps them up to date. Asks nothing where no triangle is bad.
void shape_in_space(const PatchInput& input, Cad& cad, const SizeRules& rules, PatchMesh& mesh, Monitor& monitor);

}  // namespace carreau
