// SPDX-License-Identifier: BSD-3-Clause
// Requests for smaller triangles at triangles that cross although their faces are apart. Private to pipeline/.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "gradation/edge_sizes.h"
#include "mesh/crossings/intersections.h"
#include "pipeline/base/run.h"

namespace carreau {

/// The triangles of a mesh that cross.
class Crossings {
 public:
  /// Looks for them in the mesh of the run. Throws Cancelled.
  explicit Crossings(const CompositeRun& run);

  /// The mesh of the run; if processes keep it in parts, the triangles that cross.
  [[nodiscard]] const SurfaceMesh& mesh() const noexcept { return *mesh_; }
  [[nodiscard]] const std::array<std::int32_t, 3>& corners(std::int32_t triangle) const {
    return triangles_[static_cast<std::size_t>(triangle)];
  }
  /// Face of a triangle, and its number there.
  [[nodiscard]] std::pair<int, int> origin(std::int32_t triangle) const;

  Intersections found;

 private:
  std::unique_ptr<SurfaceMesh> crossing_;  // null: the mesh of the run
  const SurfaceMesh* mesh_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
  std::vector<std::int32_t> first_;  // by face, and one more: its first triangle
};

/// Pairs of faces, by index, ascending.
using FacePairs = std::set<std::pair<int, int>>;

/// A request to mesh two faces finer at their crossing triangles.
struct CrossingRequest {
  std::pair<int, int> faces;
  std::map<std::int32_t, double> triangles;               ///< by number: the share that its edges are to have
  std::set<std::pair<std::int32_t, std::int32_t>> edges;  ///< of these triangles, by vertices
  std::int64_t pairs = 0;                                 ///< of triangles that cross
};

/// One request for each pair of faces that are apart. Adds the pairs of faces that meet to `meeting`: no triangles part
/// them, so they are passed over here and later. `avoidable`: pairs of triangles that smaller triangles would part.
struct CrossingRequests {
  std::vector<CrossingRequest> requests;  ///< by faces, ascending
  std::int64_t avoidable = 0;
};
CrossingRequests find_requests(const CompositeRun& run, const Crossings& crossings, FacePairs& meeting);

/// A part of the requests, by faces and curves.
struct RefinementPlan {
  std::vector<std::vector<EdgeSizes::Source>> sources;    ///< by face
  std::set<std::pair<std::int32_t, std::int32_t>> edges;  ///< to be halved if they lie on curves, by vertices
  std::set<int> faces;                                    ///< that are meshed again
  double work = 0;                                        ///< expected
  [[nodiscard]] bool empty() const noexcept { return edges.empty(); }
};

/// Work that the meshes of faces took, in triangles. A face costs its triangles and a constant.
double work_of_mesh(const CompositeRun& run);
double work_of_faces(const CompositeRun& run, const std::set<int>& faces);

/// The cheapest requests whose work together is within the budget.
RefinementPlan plan_requests(const CompositeRun& run, const Crossings& crossings, const CrossingRequests& requests,
                             double budget);

}  // namespace carreau
