// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/inspect/crossing_requests.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "mesh/crossings/shared_search.h"
#include "pipeline/base/thresholds.h"
#include "pipeline/inspect/face_gap.h"
#include "pipeline/inspect/face_triangle.h"
#include "pipeline/parts/part_crossings.h"
#include "support/rounding_of.h"
#include "surface/elements/quads/quadrilaterals.h"

namespace carreau {

namespace {

using namespace thresholds::crossings;

/// Vertices that two faces have in common. Near them the faces meet without crossing.
class SharedVertices {
 public:
  SharedVertices(const SurfaceMesh& mesh, std::pair<int, int> faces) {
    const std::vector<std::int32_t> a = sorted(mesh, faces.first), b = sorted(mesh, faces.second);
    std::vector<std::int32_t> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    for (const std::int32_t v : both) places_.push_back(mesh.vertices[v]);
  }
  [[nodiscard]] bool any_within(double distance, const Vec3& place) const {
    return std::any_of(places_.begin(), places_.end(), [&](const Vec3& v) { return norm(v - place) <= distance; });
  }

 private:
  static std::vector<std::int32_t> sorted(const SurfaceMesh& mesh, int face) {
    std::vector<std::int32_t> all = mesh.faces[static_cast<std::size_t>(face)].vertex;
    std::sort(all.begin(), all.end());
    return all;
  }
  std::vector<Vec3> places_;
};

/// Looks at the pairs of triangles of two faces.
class RequestFinder {
 public:
  RequestFinder(const CompositeRun& run, const Crossings& crossings)
      : run_(run), crossings_(crossings), edges_(crossings.mesh(), run.curves) {}

  /// Empty: the faces meet.
  std::optional<CrossingRequest> find(std::pair<int, int> faces, const std::vector<std::size_t>& pairs) const {
    const SharedVertices shared(crossings_.mesh(), faces);
    CrossingRequest request{faces, {}, {}, 0};
    std::unordered_map<std::int32_t, FaceTriangle> known;
    const auto triangle = [&](std::int32_t number) -> const FaceTriangle& {
      const auto found = known.find(number);
      return found != known.end() ? found->second : known.emplace(number, make_triangle(number)).first->second;
    };
    for (const std::size_t k : pairs) {
      const TriangleIntersection& pair = crossings_.found.pairs[k];
      const FaceTriangle &s = triangle(pair.triangles[0]), &t = triangle(pair.triangles[1]);
      if (!s.is_sound() || !t.is_sound()) continue;
      const FaceGap gap = measure_gap(run_.cad, s, t, pair.place);
      const double share = share_of(gap), longest = std::max(s.longest_edge(), t.longest_edge());
      if (share >= min_share && gap.width >= min_width * gap.slope * longest)
        add(pair, std::min(share, max_share), request);
      else if (faces.first != faces.second && !shared.any_within(longest, gap.place))
        return {};
    }
    return request;
  }

 private:
  [[nodiscard]] FaceTriangle make_triangle(std::int32_t number) const {
    const auto [face, local] = crossings_.origin(number);
    return {crossings_.mesh(), face, local, edges_, run_.curves, run_.curve_model};
  }
  /// Share of edges whose sagittas fill a part of the gap: they are as the squares of lengths.
  [[nodiscard]] double share_of(const FaceGap& gap) const {
    if (!(gap.sagitta > rounding_of::heights * run_.supports.diag)) return 0;
    return std::sqrt(sagitta_share * gap.width / gap.sagitta);
  }
  void add(const TriangleIntersection& pair, double share, CrossingRequest& request) const {
    ++request.pairs;
    for (const std::int32_t t : pair.triangles) {
      double& least = request.triangles.try_emplace(t, share).first->second;
      least = std::min(least, share);
      const std::array<std::int32_t, 3>& v = crossings_.corners(t);
      for (std::size_t k = 0; k < 3; ++k) request.edges.insert(std::minmax(v[k], v[(k + 1) % 3]));
    }
  }

  const CompositeRun& run_;
  const Crossings& crossings_;
  CurveEdges edges_;
};

std::int64_t triangles_of(const CompositeRun& run, std::size_t face) {
  if (run.result.shares) return run.result.shares->of_face[face].triangles;
  return std::ssize(run.result.mesh.faces[face].triangles);
}

double work_of_face(const CompositeRun& run, std::size_t face) {
  return work_per_face + static_cast<double>(triangles_of(run, face));
}

/// Requests with the work that they bring.
class Planner {
 public:
  Planner(const CompositeRun& run, const Crossings& crossings)
      : run_(run), crossings_(crossings), edges_(crossings.mesh(), run.curves) {}

  /// Work that a request adds to the plan.
  [[nodiscard]] double work_of(const CrossingRequest& request, const RefinementPlan& plan) const {
    double work = 0;
    for (const int f : faces_of(request))
      if (!plan.faces.contains(f)) work += work_of_face(run_, static_cast<std::size_t>(f));
    for (const auto& [triangle, share] : request.triangles) work += 1 / (share * share);
    return work;
  }
  void add(const CrossingRequest& request, RefinementPlan& plan) {
    plan.work += work_of(request, plan);
    plan.faces.merge(faces_of(request));
    plan.edges.insert(request.edges.begin(), request.edges.end());
    for (const auto& [triangle, share] : request.triangles) {
      const std::array<std::int32_t, 3>& v = crossings_.corners(triangle);
      const auto edge = [&](std::size_t k) {
        return std::pair<Vec3, Vec3>{crossings_.mesh().vertices[v[k]], crossings_.mesh().vertices[v[(k + 1) % 3]]};
      };
      double longest = 0;
      for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, norm(edge(k).second - edge(k).first));
      auto& sources = plan.sources[static_cast<std::size_t>(crossings_.origin(triangle).first)];
      for (std::size_t k = 0; k < 3; ++k) sources.push_back({edge(k).first, edge(k).second, share * longest});
    }
  }

 private:
  /// Faces that are meshed again for a request: its own, and the neighbours at curves that are cut.
  [[nodiscard]] std::set<int> faces_of(const CrossingRequest& request) const {
    std::set<int> faces{request.faces.first, request.faces.second};
    for (const auto& [v, w] : request.edges)
      if (const SegmentOfCurve* segment = edges_.find(v, w))
        for (const CurveUse& use : run_.curve_model.curve(segment->curve).uses) faces.insert(use.face);
    return faces;
  }

  const CompositeRun& run_;
  const Crossings& crossings_;
  CurveEdges edges_;
};

}  // namespace

namespace {

// They come first (assemble()).
std::int32_t vertices_on_curves(const SurfaceMesh& mesh) {
  std::int32_t last = -1;
  for (const CurveMesh& curve : mesh.curves)
    for (const std::int32_t v : curve.vertices) last = std::max(last, v);
  return last + 1;
}

}  // namespace

Crossings::Crossings(const CompositeRun& run) : mesh_(&run.result.mesh) {
  if (run.result.shares) {
    PartCrossings parts = find_part_crossings(run, max_pairs);
    crossing_ = std::make_unique<SurfaceMesh>(std::move(parts.mesh));
    mesh_ = crossing_.get();
    found = std::move(parts.found);
  }
  first_.push_back(0);
  triangles_.reserve(mesh().triangle_count());
  for (const FaceMesh& face : mesh().faces) {
    for (const auto& [a, b, c] : face.triangles) triangles_.push_back({face.vertex[a], face.vertex[b], face.vertex[c]});
    first_.push_back(static_cast<std::int32_t>(triangles_.size()));
  }
  if (!run.result.shares)
    found = find_intersections(mesh().vertices, triangles_, max_pairs, run.options.executor,
                               run.monitor, {first_, vertices_on_curves(mesh())});
}

std::pair<int, int> Crossings::origin(std::int32_t triangle) const {
  const auto next = std::upper_bound(first_.begin(), first_.end(), triangle);  // passes over faces without triangles
  return {static_cast<int>(next - first_.begin()) - 1, triangle - *(next - 1)};
}

CrossingRequests find_requests(const CompositeRun& run, const Crossings& crossings, FacePairs& meeting) {
  std::map<std::pair<int, int>, std::vector<std::size_t>> pairs;
  for (std::size_t k = 0; k < crossings.found.pairs.size(); ++k) {
    const auto [s, t] = crossings.found.pairs[k].triangles;
    const std::pair<int, int> faces = std::minmax(crossings.origin(s).first, crossings.origin(t).first);
    if (!meeting.contains(faces)) pairs[faces].push_back(k);
  }
  CrossingRequests found;
  const RequestFinder finder(run, crossings);
  for (const auto& [faces, of] : pairs) {
    std::optional<CrossingRequest> request = finder.find(faces, of);
    if (!request) {
      meeting.insert(faces);
    } else if (!request->triangles.empty()) {
      found.avoidable += request->pairs;
      found.requests.push_back(std::move(*request));
    }
  }
  return found;
}

double work_of_mesh(const CompositeRun& run) {
  double work = 0;
  for (std::size_t f = 0; f < run.model.faces.size(); ++f) work += work_of_face(run, f);
  return work;
}

double work_of_faces(const CompositeRun& run, const std::set<int>& faces) {
  double work = 0;
  for (const int f : faces) work += work_of_face(run, static_cast<std::size_t>(f));
  return work;
}

RefinementPlan plan_requests(const CompositeRun& run, const Crossings& crossings, const CrossingRequests& requests,
                             double budget) {
  Planner planner(run, crossings);
  RefinementPlan plan;
  plan.sources.resize(run.model.faces.size());
  std::vector<std::pair<double, const CrossingRequest*>> order;
  for (const CrossingRequest& request : requests.requests) order.emplace_back(planner.work_of(request, plan), &request);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [work, request] : order)
    if (plan.work + planner.work_of(*request, plan) <= budget) planner.add(*request, plan);
  return plan;
}

}  // namespace carreau
