// SPDX-License-Identifier: BSD-3-Clause
// Triangles of faces that are close to each other: chords that cross although the surfaces do not.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "cad/fundamental_forms.h"
#include "mesh/intersections.h"
#include "surface/attempts.h"
#include "surface/run.h"
#include "surface/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::crossings;

/// A triangle of the whole mesh, by its face.
struct MeshTriangle {
  int face = 0, local = 0;
};

struct WholeMesh {
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<MeshTriangle> origin;
};

WholeMesh whole(const SurfaceMesh& mesh) {
  WholeMesh all;
  for (int f = 0; f < static_cast<int>(mesh.faces.size()); ++f) {
    const FaceMesh& face = mesh.faces[static_cast<std::size_t>(f)];
    for (int t = 0; t < static_cast<int>(face.triangles.size()); ++t) {
      const auto& [a, b, c] = face.triangles[static_cast<std::size_t>(t)];
      all.triangles.push_back({face.vertex[a], face.vertex[b], face.vertex[c]});
      all.origin.push_back({f, t});
    }
  }
  return all;
}

/// The surface over a place of a triangle.
struct Above {
  Vec3 point, normal;  // unit; zero at singular points
  double longest = 0;  // edge of the triangle
};

Above surface_over(const CompositeRun& run, const MeshTriangle& which, const Vec3& place) {
  const SurfaceMesh& mesh = run.result.mesh;
  const FaceMesh& face = mesh.faces[static_cast<std::size_t>(which.face)];
  const auto& [i, j, k] = face.triangles[static_cast<std::size_t>(which.local)];
  const Vec3 a = mesh.vertices[face.vertex[i]], ab = mesh.vertices[face.vertex[j]] - a,
             ac = mesh.vertices[face.vertex[k]] - a, n = cross(ab, ac), ap = place - a;
  const double n2 = dot(n, n), s = dot(cross(ap, ac), n) / n2, t = dot(cross(ab, ap), n) / n2;
  const Vec2 uv = (1 - s - t) * face.uv[i] + s * face.uv[j] + t * face.uv[k];
  const SurfaceJet jet = surface_at(run.cad, face.ref, want_position | want_first, uv);
  return {jet.s, unit_normal(jet).value_or(Vec3{}), std::max({norm(ab), norm(ac), norm(ac - ab)})};
}

/// How far the surfaces are apart where two triangles cross; 0: not at all, seen from there, and smaller triangles do
/// not part them. And by what edges are to be multiplied.
struct Gap {
  double width = 0, share = 1;
};

Gap gap_at(const CompositeRun& run, const MeshTriangle& s, const MeshTriangle& t, const Vec3& place) {
  const Above p = surface_over(run, s, place), q = surface_over(run, t, place);
  const double on_s = norm(p.point - place), on_t = norm(q.point - place), width = norm(p.point - q.point);
  const double slope = norm(cross(p.normal, q.normal));
  if (!(std::max(on_s, on_t) > no_sagitta * run.supports.diag && width >= least_gap * std::max(on_s, on_t))) return {};
  if (width < least_width * slope * std::max(p.longest, q.longest)) return {};
  return {width, std::clamp(std::sqrt(sagitta_share * width / (on_s + on_t)), least_share, most_share)};
}

using Edge = std::pair<std::int32_t, std::int32_t>;

/// What is to be finer: edges of triangles that cross, by face, and those of them that lie on curves.
struct FinerPlaces {
  std::vector<std::vector<EdgeSizes::Source>> sources;
  std::set<Edge> edges;
  double gap = 0;  ///< between the surfaces at crossings, the median
};

void add(const SurfaceMesh& mesh, const WholeMesh& all, std::int32_t triangle, double share, FinerPlaces& places) {
  const std::array<std::int32_t, 3>& corners = all.triangles[static_cast<std::size_t>(triangle)];
  const int face = all.origin[static_cast<std::size_t>(triangle)].face;
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, norm(mesh.vertices[corners[(k + 1) % 3]] - mesh.vertices[corners[k]]));
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t v = corners[k], w = corners[(k + 1) % 3];
    places.sources[static_cast<std::size_t>(face)].push_back({mesh.vertices[v], mesh.vertices[w], share * longest});
    places.edges.insert(std::minmax(v, w));
  }
}

/// The mesh of the run with its crossings.
struct Crossings {
  explicit Crossings(const CompositeRun& run)
      : all(whole(run.result.mesh)),
        found(find_intersections(run.result.mesh.vertices, all.triangles,
                                 {.limit = most_pairs, .threads = run.options.threads}, run.monitor)) {}

  WholeMesh all;
  Intersections found;
};

FinerPlaces places_to_refine(const CompositeRun& run, const Crossings& crossings) {
  const WholeMesh& all = crossings.all;
  FinerPlaces places;
  places.sources.resize(run.model.faces.size());
  std::vector<double> gaps;
  for (const TriangleIntersection& pair : crossings.found.pairs) {
    const auto [s, t] = pair.triangles;
    const auto at = [&](std::int32_t i) { return all.origin[static_cast<std::size_t>(i)]; };
    const Gap gap = gap_at(run, at(s), at(t), pair.place);
    if (gap.width == 0) continue;
    gaps.push_back(gap.width);
    add(run.result.mesh, all, s, gap.share, places);
    add(run.result.mesh, all, t, gap.share, places);
  }
  if (gaps.empty()) return places;
  const auto middle = gaps.begin() + std::ssize(gaps) / 2;
  std::nth_element(gaps.begin(), middle, gaps.end());
  places.gap = *middle;
  return places;
}

// Segments of curves that are edges of such triangles.
void split_curves(const CompositeRun& run, const std::set<Edge>& edges, std::vector<DiscreteCurve>& curves) {
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const std::vector<std::int32_t>& v = run.result.mesh.curves[c].vertices;
    if (static_cast<int>(v.size()) != curves[c].segments() + 1) continue;  // it has vanished
    for (int k = curves[c].segments() - 1; k >= 0; --k) {
      const auto i = static_cast<std::size_t>(k);
      if (edges.contains(std::minmax(v[i], v[i + 1]))) split_segment(curves[c], k, run.curve_model);
    }
  }
  if (!run.narrow.strips.empty()) complete_sides(run.curve_model, run.narrow.strips, curves);
}

void make_finer(CompositeRun& run, const FinerPlaces& places) {
  run.curves = run.cut_curves;
  split_curves(run, places.edges, run.curves);
  run.finer.resize(places.sources.size());
  for (std::size_t f = 0; f < places.sources.size(); ++f)
    run.finer[f].insert(run.finer[f].end(), places.sources[f].begin(), places.sources[f].end());
}

// Of surfaces that cross, gaps between points over crossings are sagittas, which fall by four when edges are halved.
bool surfaces_cross(const FinerPlaces& before, const FinerPlaces& now) {
  return now.gap < most_fall_of_gap * before.gap;
}

// The faces of a plane domain lie beside one another, and the triangles of each are turned the same way.
bool covers_a_plane_once(const CompositeRun& run) {
  const std::vector<FaceMesh>& faces = run.result.mesh.faces;
  return run.model.plane && std::all_of(faces.begin(), faces.end(),
                                        [](const FaceMesh& face) { return face.status == FaceStatus::meshed; });
}

}  // namespace

void part_crossing_triangles(CompositeRun& run, const std::function<void()>& mesh_again) {
  if (run.options.crossing_rounds == 0) return;
  if (covers_a_plane_once(run)) {
    run.result.report.crossings = 0;
    return;
  }
  Crossings now(run);
  Intersections fewest = now.found;
  const std::size_t first = now.all.triangles.size();
  Attempts attempts(run, mesh_again);
  FinerPlaces places = places_to_refine(run, now);
  for (int round = 0; round < run.options.crossing_rounds && !places.edges.empty(); ++round) {
    if (!attempts.again([&] { make_finer(run, places); })) break;
    now = Crossings(run);
    const bool best = attempts.keep_if(now.found.count < fewest.count);
    if (best) fewest = now.found;
    if (now.all.triangles.size() > most_growth * first) break;
    FinerPlaces next = places_to_refine(run, now);
    if (!best && surfaces_cross(places, next)) break;
    places = std::move(next);
  }
  attempts.finish();
  run.result.report.crossings = fewest.count;
  run.result.crossings = std::move(fewest.pairs);
}

}  // namespace carreau
