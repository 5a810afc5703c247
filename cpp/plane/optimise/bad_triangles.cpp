// SPDX-License-Identifier: BSD-3-Clause
#include "plane/optimise/bad_triangles.h"

#include <algorithm>

#include "mesh/shape_levels.h"
#include "plane/kernel/thresholds.h"
#include "plane/optimise/mending.h"
#include "support/work_sizes.h"

namespace carreau::plane {

namespace {

/// Triangles that are helped.
enum class Helped : std::uint8_t { crowded, crowded_or_bad };

// True if a triangle is neither crowded nor doubtful, beyond rounding: one test that nearly all triangles pass.
bool is_good(const Triangulation& mesh, const Triangle& T) {
  constexpr double sure = 1 + 1e-9, quality2 = sure * doubtful_quality * doubtful_quality / 12;
  const Vertex &P = mesh.vertices[T.v[0]], &Q = mesh.vertices[T.v[1]], &R = mesh.vertices[T.v[2]];
  const Metric2 mp = P.metric(), mq = Q.metric(), mr = R.metric(), pq = mp + mq, m = pq + mr;
  const Vec2 u = Q.point() - P.point(), v = R.point() - P.point(), w = v - u;
  const double shortest2 = std::min({squared_length(pq, u), squared_length(mq + mr, w), squared_length(mr + mp, v)});
  const double area = cross(u, v), sum = squared_length(m, u) + squared_length(m, v) + squared_length(m, w);
  return shortest2 > sure * 2 * crowded_length2 && area > 0 && area * area * determinant(m) > quality2 * sum * sum;
}

bool needs_help(const PlaneWork& work, Helped helped, int t) {
  const Triangle& T = work.mesh.triangles[t];
  if (T.v[0] < 0 || T.done == Done::frozen || (work.mesh.bends.empty() && is_good(work.mesh, T))) return false;
  if (is_crowded(work, t)) return true;
  if (helped == Helped::crowded) return false;
  // Lengths of bent triangles may imply an area that they do not have.
  const bool doubtful = work.shapes.is_bent(T) || work.shapes.quality(T.v[0], T.v[1], T.v[2]) < doubtful_quality;
  return doubtful && work.shapes.quality_at_centroid(T.v[0], T.v[1], T.v[2]) < shape_level::good;
}

// Returns the tested triangles, some of them several times.
std::vector<std::int32_t> help(PlaneWork& work, Helped helped, Settled& settled) {
  const auto total = static_cast<std::int32_t>(work.mesh.triangles.size());
  std::vector<std::int32_t> open, looked_at;
  for (std::int32_t t = 0; t < total; ++t) {
    if (t % work_sizes::steps == 0) work.monitor.checkpoint();
    if (!settled.is_good(t) && needs_help(work, helped, t)) open.push_back(t);
  }
  // Work is bounded by a multiple of the mesh: a boundary without any relation to the sizes leaves nothing but bad triangles. It is counted
  // in shapes, since a fine boundary far from all other vertices gives stars of thousands. The minimum is a few tenths of a second. [time only; 2 million: coarse swirl at 51 : 1 is cut off]
  const std::int64_t budget = std::max<std::int64_t>(4'000'000, 24 * total);
  std::int64_t checked = 0;
  Mending mending{work};
  if (!open.empty()) mending.failed_moves.clear(), mending.failed_points.clear();
  for (int pass = 0; pass < mending_passes && !open.empty() && mending.shapes_asked <= budget; ++pass) {
    looked_at.insert(looked_at.end(), open.begin(), open.end());
    mending.changed.clear(), mending.nudged.clear();
    for (const std::int32_t t : open) {
      if (mending.shapes_asked > budget) break;
      if (mending.shapes_asked > checked) {
        work.monitor.checkpoint();
        checked = mending.shapes_asked + work_sizes::steps;
      }
      if (needs_help(work, helped, t)) helped == Helped::crowded ? remove_crowded_vertex(mending, t) : mend(mending, t);
    }
    std::sort(mending.changed.begin(), mending.changed.end());
    mending.changed.erase(std::unique(mending.changed.begin(), mending.changed.end()), mending.changed.end());
    settled.forget(mending.changed, work.mesh.triangles.size());
    settled.forget(mending.nudged, work.mesh.triangles.size());
    open.swap(mending.changed);
  }
  looked_at.insert(looked_at.end(), open.begin(), open.end());
  return looked_at;
}

}  // namespace

void remove_crowded_vertices(PlaneWork& work) {
  Settled settled;
  find_settled(work, settled);
  help(work, Helped::crowded, settled);
}

std::vector<std::int32_t> mend_bad_triangles(PlaneWork& work, Settled& settled) {
  return help(work, Helped::crowded_or_bad, settled);
}

}  // namespace carreau::plane
