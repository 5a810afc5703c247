// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/division/divided_remeshing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "metric/metric2.h"
#include "support/error.h"
#include "support/ranks/executor.h"
#include "support/stepped_tasks.h"
#include "surface/remesh/base/thresholds.h"
#include "surface/remesh/division/cuts.h"
#include "surface/remesh/division/mesh_part.h"

namespace carreau {

namespace {

using namespace thresholds::remesh;

using Vertices = std::vector<std::int32_t>;

/// Triangles of prescribed size: least work of a triangle, so that each triangle is in some part.
constexpr double min_work = 1e-3;

// Marks the starting vertices of remesh() if it does not work everywhere: corners of triangles that violate the
// prescription.
std::vector<char> bad_corners(const CrossPatchMesh& mesh, const RemeshingWorkers& workers, Monitor& monitor) {
  const auto& all = mesh.triangles();
  std::vector<char> bad(all.size(), 0);
  constexpr std::size_t at_once = 4096;
  const auto look = [&](std::size_t k, Monitor&) {
    for (std::size_t t = k * at_once; t < std::min(all.size(), (k + 1) * at_once); ++t)
      if (all[t][0] >= 0 && is_bad(mesh, all[t])) bad[t] = 1;
  };
  run_each((all.size() + at_once - 1) / at_once, false, workers.threads, look, monitor);
  std::vector<char> corner(mesh.vertices(), 0);
  for (std::size_t t = 0; t < all.size(); ++t)
    for (int i = 0; bad[t] != 0 && i < 3; ++i) corner[all[t][i]] = 1;
  return corner;
}

Vertices numbers_of(const std::vector<char>& marked) {
  Vertices numbers;
  for (std::size_t v = 0; v < marked.size(); ++v)
    if (marked[v] != 0) numbers.push_back(static_cast<std::int32_t>(v));
  return numbers;
}

/// The work for each triangle of the mesh, in triangles of the prescribed size. Parts of many small triangles that become few would have
/// few triangles inside, and irregular vertices along their borders. Finer meshes that are made of a coarse one would keep these vertices.
std::vector<float> work_everywhere(const CrossPatchMesh& mesh) {
  std::vector<float> work(mesh.triangles().size(), 0);
  for (std::size_t t = 0; t < work.size(); ++t)
    if (mesh.triangles()[t][0] >= 0) {
      const double wanted = mesh.double_area(mesh.triangles()[t]) / half_root3;
      work[t] = static_cast<float>(std::isfinite(wanted) ? std::max(wanted, min_work) : 1);
    }
  return work;
}

std::vector<float> work_around(const CrossPatchMesh& mesh, const Vertices& bad) {
  std::vector<float> work(mesh.triangles().size(), 0);
  for (const std::int32_t t : triangles_at(mesh, near_vertices(mesh, bad, rings_at_work))) work[t] = 1;
  return work;
}

class DividedRemeshing {
 public:
  DividedRemeshing(CrossPatchMesh& mesh, const RemeshingWorkers& workers, Monitor& monitor, bool everywhere, bool thorough)
      : mesh_(mesh), workers_(workers), monitor_(monitor), everywhere_(everywhere), thorough_(thorough) {}

  RemeshingReport run(const std::vector<float>& work) {
    require_same_mesh();
    Vertices worked;
    for (std::size_t t = 0; t < work.size(); ++t)
      if (work[t] > 0) worked.push_back(static_cast<std::int32_t>(t));
    Vertices cuts = remesh_parts(cut_across(mesh_, std::move(worked), work, triangles_of_part), {});
    cuts = remesh_parts(cut_across(mesh_, zone(cuts), std::vector<float>(mesh_.triangles().size(), 1), triangles_of_part), cuts);
    remesh_parts(connected(mesh_, zone(cuts)), cuts);
    return report_;
  }

 private:
  // Parts fit together only where all processes have the same mesh.
  void require_same_mesh() const {
    const auto sum_of_mesh = [&] {
      LongChecksum sum;
      for (const auto& t : mesh_.triangles())
        for (const std::int32_t v : t) sum.add(static_cast<std::uint64_t>(v));
      std::vector<Vec3> places;
      std::vector<double> sizes;
      for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh_.vertices()); ++v)
        places.push_back(mesh_.position(v)), places.push_back(mesh_.place(v).normal), sizes.push_back(mesh_.size(v));
      sum.add(places), sum.add(sizes);
      return sum.text();
    };
    workers_.require_same("cross-patch mesh", sum_of_mesh, [](int rank) {
      return "the mesh of rank " + std::to_string(rank) +
             " differs from the mesh of rank 0 before cross-patch remeshing: its callbacks or parameters differ";
    });
  }

  Vertices zone(const Vertices& cuts) const { return triangles_at(mesh_, near_vertices(mesh_, cuts, rings_of_zone)); }

  /// Remeshes all parts and returns the vertices where parts have met. `around`: vertices that work starts from; empty: the start of
  /// remesh(). Returns nothing without parts.
  Vertices remesh_parts(std::vector<Vertices> parts, const Vertices& around) {
    if (parts.empty()) return {};
    const Division division(std::move(parts), mesh_.triangles().size());
    Vertices cuts = division.meeting(mesh_);
    std::vector<EditedPart> edited = edit(division, around);
    for (const EditedPart& part : edited) report_ += part.report, mesh_.budget.pay(part.cost);
    mesh_.take(division, std::move(edited));
    monitor_.checkpoint();
    if (!everywhere_) {
      const std::vector<char> bad = bad_corners(mesh_, workers_, monitor_);
      std::erase_if(cuts, [&](std::int32_t v) { return bad[v] == 0; });
    }
    return cuts;
  }

  EditedPart edit_part(const Division& division, std::size_t p, const Vertices& around, Monitor& monitor) const {
    const MeshPart part(mesh_, division, static_cast<std::int32_t>(p));
    CrossPatchMesh own(mesh_, part);
    // A part cannot spend gains of the other parts before the next round, since parts work independently.
    if (own.budget.is_limited()) own.budget.left /= static_cast<double>(division.parts.size());
    const Vertices start = everywhere_ ? part.local(around) : Vertices{};
    if (everywhere_ && start.empty() && !around.empty()) return {mesh_, part, own, {}};
    const double left = own.budget.left;
    const RemeshingReport report = remesh(own, monitor, everywhere_, thorough_, start);
    EditedPart edited(mesh_, part, own, report);
    if (own.budget.is_limited()) edited.cost = left - own.budget.left;
    return edited;
  }

  std::vector<EditedPart> edit(const Division& division, const Vertices& around) {
    return shared_work<EditedPart>(
        workers_, "parts of a cross-patch mesh", division.parts.size(), !workers_.hosts_threads,
        [&](std::size_t p, Monitor& of_part) { return edit_part(division, p, around, of_part); },
        [](PacketWriter& packet, const EditedPart& part) { part.put(packet); }, &EditedPart::from, monitor_);
  }

  CrossPatchMesh& mesh_;
  const RemeshingWorkers& workers_;
  Monitor& monitor_;
  bool everywhere_, thorough_;
  RemeshingReport report_;
};

}  // namespace

RemeshingReport remesh_divided(CrossPatchMesh& mesh, const RemeshingWorkers& workers, Monitor& monitor, bool everywhere, bool thorough,
                               std::span<const std::int32_t> around) {
  if (!around.empty()) return remesh(mesh, monitor, everywhere, thorough, around);
  Vertices bad;
  if (!everywhere) {
    bad = numbers_of(bad_corners(mesh, workers, monitor));
    if (bad.empty()) return {};
  }
  const std::vector<float> work = everywhere ? work_everywhere(mesh) : work_around(mesh, bad);
  if (std::accumulate(work.begin(), work.end(), 0.0) < min_divided) return remesh(mesh, monitor, everywhere, thorough, bad);
  return DividedRemeshing(mesh, workers, monitor, everywhere, thorough).run(work);
}

}  // namespace carreau
