// SPDX-License-Identifier: BSD-3-Clause
#include "association/periodic_refinement.h"

#include <algorithm>
#include <array>

#include "periodic/closest.h"
#include "periodic/root_maps.h"
#include "periodic/shared_curves.h"
#include "support/rounding_of.h"
#include "surface/carry/carry_faces.h"
#include "surface/carry/carry_patch.h"

namespace carreau::refining {

namespace {

bool is_closed(const Curve& curve) { return curve.end1 == curve.end2; }

}  // namespace

PeriodicRefinement::PeriodicRefinement(const CurveModel& model, double diag, SurfaceMesh& mesh)
    : curve_model_(model), mesh_(mesh), periodic_(find_periodic(model, diag)) {
  for (FacePair& pair : periodic_.pairs) pair.flipped = is_flipped(pair);
}

// Images of the corners of a triangle by the links.
bool PeriodicRefinement::is_flipped(const FacePair& pair) const {
  const FaceMesh &from = mesh_.faces[pair.master], &to = mesh_.faces[pair.slave];
  std::map<std::int32_t, std::int32_t> image;
  for (const PeriodicLink& link : mesh_.periodic)
    if (link.dimension == 2 && link.master == from.shown_ref() && link.slave == to.shown_ref())
      for (const auto& [slave, master] : link.nodes) image.emplace(master, slave);
  for (std::size_t t = 0; t < from.triangles.size() && from.triangles.size() == to.triangles.size(); ++t) {
    std::array<std::int32_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found = image.find(from.vertex[from.triangles[t][i]]);
      corners[i] = found == image.end() ? -1 : found->second;
    }
    const auto fits = [&](bool flipped) {
      const auto& u = to.triangles[image_triangle(from, t, flipped)];
      for (std::size_t i = 0; i < 3; ++i)
        if (to.vertex[u[flipped ? (3 - i) % 3 : i]] != corners[i]) return false;
      return true;
    };
    if (fits(false) != fits(true)) return fits(true);
  }
  return false;
}

bool PeriodicRefinement::spread(const std::vector<DiscreteCurve>& curves, EdgeMarks& marks) const {
  std::vector<Key> more;
  const auto join = [&](const Key& a, const Key& b) {
    if (a[0] == a[1] || marks.edges().find(a[0], a[1]) < 0 || marks.edges().find(b[0], b[1]) < 0 || marks.has(a[0], a[1]) == marks.has(b[0], b[1])) return;
    more.push_back(marks.has(a[0], a[1]) ? b : a);
  };
  for (const CurveClass& all : periodic_.curves) {
    const int root = all.members.front().image.curve;
    const std::vector<std::int32_t>& chain = mesh_.curves[root].vertices;
    const bool closed = is_closed(curve_model_.curve(root));
    if (curve_model_.curve(root).degenerate || chain.size() < 2) continue;
    const auto join_by = [&](const CurveImage& image) {
      const std::vector<std::int32_t>& there = mesh_.curves[image.curve].vertices;
      const int n = static_cast<int>(there.size()) - 1;
      for (int k = 0; k + 1 < static_cast<int>(chain.size()); ++k) {
        const int i = vertex_image(curves[root], curves[image.curve], image, closed, k), j = vertex_image(curves[root], curves[image.curve], image, closed, k + 1);
        if (i < 0 || j < 0 || n < 1) continue;
        const auto at = [&](int v) { return there[closed ? v % n : v]; };
        join({chain[k], chain[k + 1]}, {at(i), at(j)});
      }
    };
    for (const CurveMember& member : all.members) join_by(member.image);
    for (const CurveMember& each : maps_of_root(all)) join_by(each.image);
  }
  for (const FacePair& pair : periodic_.pairs) {
    const FaceMesh &from = mesh_.faces[pair.master], &to = mesh_.faces[pair.slave];
    const std::vector<std::int32_t> image = local_images(from, to, pair.flipped);
    for_sides(from, [&](std::int32_t a, std::int32_t b) {
      if (image[a] >= 0 && image[b] >= 0) join({from.vertex[a], from.vertex[b]}, {to.vertex[image[a]], to.vertex[image[b]]});
    });
  }
  marks.mark_edges(more);
  return !more.empty();
}

void PeriodicRefinement::begin() {
  image_.clear();
  for (const FacePair& pair : periodic_.pairs) image_.push_back(local_images(mesh_.faces[pair.master], mesh_.faces[pair.slave], pair.flipped));
  before_ = mesh_.vertices;
}

void PeriodicRefinement::finish(const std::vector<AddedVertices>& added) {
  std::vector<char> on_curve(mesh_.vertices.size(), 0);
  for (const CurveMesh& curve : mesh_.curves)
    for (const std::int32_t v : curve.vertices) on_curve[v] = 1;
  for (std::size_t p = 0; p < image_.size(); ++p) {
    const FacePair& pair = periodic_.pairs[p];
    const FaceMesh& from = mesh_.faces[pair.master];
    FaceMesh& to = mesh_.faces[pair.slave];
    std::vector<std::int32_t>& image = image_[p];
    image.resize(from.uv.size(), -1);
    const AddedVertices &of_master = added[pair.master], &of_slave = added[pair.slave];
    for (const auto& [edge, middle] : of_master.middles)
      if (image[edge[0]] >= 0 && image[edge[1]] >= 0)
        if (const auto found = of_slave.middles.find(ordered(image[edge[0]], image[edge[1]])); found != of_slave.middles.end()) image[middle] = found->second;
    for (std::size_t k = 0; k < of_master.centres.size() && k < of_slave.centres.size(); ++k) image[of_master.centres[k]] = of_slave.centres[k];
    carry_elements(from, image, pair.flipped, to);
    std::vector<char> fixed(to.uv.size(), 0);
    for (std::size_t v = 0; v < image.size(); ++v) {
      if (image[v] < 0) continue;
      const std::int32_t here = from.vertex[v], there = to.vertex[image[v]];
      const auto old = static_cast<std::int32_t>(before_.size());
      fixed[image[v]] = static_cast<char>(on_curve[there] != 0 || mesh_.vertex_ref[there] != 0 || (here < old && mesh_.vertices[here] == before_[here]));
    }
    follow_master(curve_model_.cad, pair, fixed, {}, rounding_of::places * periodic_.gap, mesh_);
  }
}

}  // namespace carreau::refining
