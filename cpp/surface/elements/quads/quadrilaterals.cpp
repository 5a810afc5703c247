// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/quads/quadrilaterals.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "support/stepped_tasks.h"
#include "surface/carry/carry_faces.h"
#include "surface/elements/quads/face_quads.h"
#include "surface/elements/quads/halving.h"
#include "surface/elements/quads/known_quads.h"
#include "surface/elements/quads/passes.h"
#include "surface/elements/quads/space_search.h"
#include "surface/elements/quads/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::quads;

void halve(std::vector<double>& sizes) {
  for (double& h : sizes) h /= 2;
}

class Quadrilaterals {
 public:
  Quadrilaterals(const ElementWork& work, KnownQuads* known) : work_(work), known_(known) {}

  QuadraticReport run() {
    for (std::size_t f = 0; f < work_.result.mesh.faces.size(); ++f)
      if (!work_.result.mesh.faces[f].triangles.empty()) faces_.emplace_back().face = f;
    for_each([&](FaceQuads& quads, Monitor& /*monitor*/) {
      quads = face_quads(work_, quads.face);
      if (work_.has_layers(quads.face)) set_rows_apart(quads, (*work_.layers)[quads.face]);
    });
    find_slaves();
    const bool cuts = has_quads_only(work_.options.element);
    const std::vector<std::vector<std::int32_t>> middles = cuts ? halve_curves(work_, faces_) : std::vector<std::vector<std::int32_t>>{};
    is_found_.assign(faces_.size(), 0);
    for_each([&](FaceQuads& quads, Monitor& monitor) {
      if (known_ != nullptr && known_->find(work_, middles, quads))
        is_found(quads) = 1;
      else if (!is_slave(quads))
        pair(quads, monitor);
    });
    if (cuts) cut(middles);
    const bool bound = !asks_from_threads(work_.options, work_.cad());
    for_each(
        [&](FaceQuads& quads, Monitor& monitor) {
          if (is_slave(quads) || is_found(quads) != 0) return;
          lift(work_, space(quads), quads, monitor);
          if (space(quads) != nullptr) improve_in_space(work_, *space(quads), quads, monitor);
          if (!has_quads_only(work_.options.element)) split_poor(
                quads.patch.cells, work_.isotropic() ? least_jacobian : 0, [&](std::int32_t v) -> const Vec3& { return quads.xyz[v]; },
                [](const MixedCell&) { return true; });
        },
        bound);
    for (SlaveQuads& quads : slaves_) {
      copy_cells(quads);
      place_cells(work_, quads);
    }
    QuadraticReport report;
    for (const FaceQuads& quads : faces_) report_turned(quads, report);
    if (known_ != nullptr)
      for (const FaceQuads& quads : faces_) known_->keep(work_, quads);
    put_back(faces_, work_.result);
    for (const FaceQuads& quads : faces_)
      if (work_.has_layers(quads.face))
        for (LayerCell& cell : (*work_.layers)[quads.face])
          for (std::int32_t& v : cell.corners) v = v < 0 ? v : quads.now[static_cast<std::size_t>(v)];
    for (const SlaveQuads& quads : slaves_) carry_back(quads, work_.result.mesh);
    return report;
  }

 private:
  [[nodiscard]] bool is_slave(const FaceQuads& quads) const {
    return work_.periodic != nullptr && work_.periodic->pair_of_slave[quads.face] >= 0;
  }

  void find_slaves() {
    if (work_.periodic == nullptr) return;
    const auto find = [&](int face) {
      const auto found = std::find_if(faces_.begin(), faces_.end(), [face](const FaceQuads& quads) { return quads.face == static_cast<std::size_t>(face); });
      return found != faces_.end() ? &*found : nullptr;
    };
    const std::vector<FaceMesh>& faces = work_.result.mesh.faces;
    for (const FacePair& pair : work_.periodic->pairs) {
      SlaveQuads quads{&pair, find(pair.master), find(pair.slave), {}};
      if (quads.master == nullptr || quads.slave == nullptr) continue;
      quads.image = local_images(faces[pair.master], faces[pair.slave], pair.flipped);
      slaves_.push_back(std::move(quads));
    }
  }

  template <typename Use>
  void for_each(const Use& use, bool bound = false) {
    run_each(
        faces_.size(), bound, work_.options.executor.threads, [&](std::size_t k, Monitor& monitor) { use(faces_[k], monitor); },
        work_.monitor);
  }

  [[nodiscard]] const ControlSpace* space(const FaceQuads& quads) const {
    const std::optional<ControlSpace>& space = work_.result.spaces[quads.face];
    return space ? &*space : nullptr;
  }

  void pair(FaceQuads& quads, Monitor& monitor) const {
    const PairRules rules = pair_rules(
        work_.options, work_.isotropic(), [&](std::int32_t a, std::int32_t b) { return quads.is_imposed(a, b); },
        [&](std::int32_t v) { return quads.xyz[v]; });
    PlaneQuads plain(quads.patch);
    turn_ears(plain, rules.is_imposed);
    if (space(quads) == nullptr) {
      pair_triangles(plain, rules, monitor);
      return;
    }
    const FaceCharts charts(*space(quads));
    PlaneQuads in_metric(quads.patch, charts);
    pair_triangles(in_metric, rules, monitor);
    improve_quads(in_metric, rules.is_imposed, monitor);
  }

  [[nodiscard]] char& is_found(const FaceQuads& quads) { return is_found_[static_cast<std::size_t>(&quads - faces_.data())]; }

  void cut(const std::vector<std::vector<std::int32_t>>& middles) {
    halve(work_.result.vertex_size);
    for (std::vector<double>& sizes : work_.result.curve_size) halve(sizes);
    halve_sizes(work_.result, work_.curves);
    std::vector<std::vector<int>> corners;
    for (SlaveQuads& quads : slaves_) {
      corners.emplace_back();
      for (const MixedCell& cell : quads.master->patch.cells) corners.back().push_back(corners_of(cell));
      copy_cells(quads);
    }
    for_each([&](FaceQuads& quads, Monitor&) {
      if (is_found(quads) == 0) halve_cells(work_, middles, quads);
    });
    for (std::size_t i = 0; i < slaves_.size(); ++i) match_halves(corners[i], slaves_[i]);
    for_each([&](FaceQuads& quads, Monitor& monitor) {
      if (is_slave(quads) || is_found(quads) != 0 || space(quads) == nullptr) return;
      const FaceCharts charts(*space(quads));
      PlaneQuads in_metric(quads.patch, charts);
      smooth_all(in_metric, monitor);
    });
  }

  static bool is_turned(const FaceQuads& quads, const MixedCell& c) {
    if (corners_of(c) == 3) return false;
    const auto at = [&](int k) -> const Vec3& { return quads.xyz[c[k]]; };
    return !is_convex(quads.patch, c) || is_turned_over({at(0), at(1), at(2), at(3)});
  }

  // Requests the present lengths, which are half of the lengths before the cut.
  static void report_turned(const FaceQuads& quads, QuadraticReport& report) {
    InvalidElements invalid{quads.face, 0, {}};
    std::vector<MixedCell> all = quads.patch.cells;
    all.insert(all.end(), quads.rows.begin(), quads.rows.end());
    for (const MixedCell& c : all) {
      if (!is_turned(quads, c)) continue;
      if (++invalid.count == 1)
        invalid.uv = 0.25 * (quads.patch.uv[c[0]] + quads.patch.uv[c[1]] + quads.patch.uv[c[2]] + quads.patch.uv[c[3]]);
      double longest = 0;
      for (int k = 0; k < 4; ++k) longest = std::max(longest, norm(quads.xyz[c[(k + 1) % 4]] - quads.xyz[c[k]]));
      InvalidElement element{.face = quads.face};
      for (int k = 0; k < 4; ++k) element.sides.push_back({quads.xyz[c[k]], quads.xyz[c[(k + 1) % 4]], longest});
      for (std::size_t s = 0; s < quads.middles.size(); ++s)
        if (std::find(c.begin(), c.end(), quads.middles[s]) != c.end())
          element.coarse.push_back({quads.sides[s].curve, 2 * quads.sides[s].segment});
      report.elements.push_back(std::move(element));
    }
    if (invalid.count > 0) report.invalid.push_back(invalid);
  }

  const ElementWork& work_;
  KnownQuads* known_;
  std::vector<FaceQuads> faces_;
  std::vector<char> is_found_;  // by rank in faces_: the cells are known
  std::vector<SlaveQuads> slaves_;
};

}  // namespace

void halve_sizes(CompositeResult& result, std::vector<DiscreteCurve>& curves) {
  for (FaceInterfaces& face : result.interfaces) halve(face.physical);
  for (DiscreteCurve& curve : curves) halve(curve.size), halve(curve.physical);
  for (std::optional<ControlSpace>& space : result.spaces)
    if (space) space->scale_lengths(2);
}

QuadraticReport make_quadrilaterals(const ElementWork& work, KnownQuads* known) {
  return Quadrilaterals(work, known).run();
}

bool KnownQuads::find(const ElementWork& work, const std::vector<std::vector<std::int32_t>>& middles, FaceQuads& quads) {
  const FaceMesh& mesh = work.result.mesh.faces[quads.face];
  Face& face = faces_[quads.face];
  const std::vector<LayerCell> rows = work.has_layers(quads.face) ? (*work.layers)[quads.face] : std::vector<LayerCell>{};
  const bool equal = is_known_[quads.face] != 0 && face.made && face.uv == mesh.uv && face.xyz == quads.xyz &&
                     face.triangles == mesh.triangles && face.rows == rows && face.made->sides == quads.sides;
  if (equal) {
    FaceQuads made = *face.made;
    std::copy(quads.vertex.begin(), quads.vertex.end(), made.vertex.begin());
    std::size_t cut = 0;
    bool holds = true;
    for (std::size_t s = 0; s < made.middles.size(); ++s) {
      const std::int32_t v = made.middles[s], now = v < 0 ? -1 : middles[made.sides[s].curve][made.sides[s].segment];
      if (v < 0) continue;
      ++cut;
      holds = holds && work.result.mesh.vertices[now] == made.xyz[v];
      made.vertex[v] = now;
    }
    for (std::size_t v = quads.vertex.size(); v < made.vertex.size(); ++v) cut -= made.vertex[v] >= 0 ? 1U : 0U;
    if (holds && cut == 0) {
      quads = std::move(made);
      if (work.has_layers(quads.face)) (*work.layers)[quads.face] = face.made_rows;
      return true;
    }
  }
  face = {.uv = mesh.uv, .xyz = quads.xyz, .triangles = mesh.triangles, .rows = rows};
  return false;
}

void KnownQuads::keep(const ElementWork& work, const FaceQuads& quads) {
  Face& face = faces_[quads.face];
  face.made = quads;
  if (work.has_layers(quads.face)) face.made_rows = (*work.layers)[quads.face];
}

}  // namespace carreau
