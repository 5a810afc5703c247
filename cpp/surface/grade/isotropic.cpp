// SPDX-License-Identifier: BSD-3-Clause
// One size at each vertex (h-correction).
#include <algorithm>
#include <cmath>

#include "support/infinity.h"
#include "support/shares.h"
#include "surface/grade/graph_sizes.h"
#include "surface/grade/thresholds.h"

namespace carreau::detail {

namespace {

using namespace thresholds::grade;

/// Marks the triangles of a face whose prescribed sizes violate the gradation. Such a triangle has a size that comes
/// from another vertex, or a sample that differs from the interpolation between the corners.
void find_rough(const GradingWork& work, const std::vector<double>& prescribed_h, std::size_t f, GradedFace& face) {
  const auto prescribed = [&](std::int32_t v) {
    return prescribed_h[work.graph.places[work.place_of[f] + v].vertex];
  };
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    for (const std::int32_t v : face.triangles[t])
      if (dot(face.front[v].line, face.front[v].line) > 0 || face.h[v] < (1 - shares::small) * prescribed(v))
        face.smooth[t] = 0;
  for (const GradingWork::Sample& s : work.samples[f]) {
    double linear = 0;
    for (int i = 0; i < 3; ++i) linear += s.promised[i] * face.h[face.triangles[s.triangle][i]];
    if (std::abs(linear - s.h) > shares::small * s.h) face.smooth[s.triangle] = 0;
  }
  widen_rough(face);
}

/// Finds vertices that are the sources of all their neighbours.
void find_size_minima(GradedFace& face) {
  std::vector<char> minimum(face.uv.size(), 1);
  for (const auto& t : face.triangles)
    for (int i = 0; i < 3; ++i)
      for (int k = 1; k < 3; ++k) {
        const std::int32_t v = t[i], w = t[(i + k) % 3];
        if (face.xyz[v] == face.xyz[w]) continue;  // a pole has several vertices
        const GradationFront& f = face.front[w];
        if (dot(f.line, f.line) == 0 || f.source_h != face.h[v]) minimum[v] = 0;
      }
  for (std::size_t v = 0; v < minimum.size(); ++v)
    if (minimum[v] != 0) face.size_minima.push_back(face.uv[v]);
}

class IsotropicSizes final : public GraphSizes {
 public:
  using GraphSizes::GraphSizes;

  [[nodiscard]] bool isotropic() const noexcept override { return true; }

  void keep_sample(Vec2 uv, const SurfaceJet& jet, Metric2 metric,
                   std::vector<GradingWork::Sample>& samples) const override {
    if (const double h = isotropic_size(jet, metric); h > 0) samples.push_back({uv, jet.s, h});
  }
  void keep_vertex(FaceMetric& /*prescribed*/, Vec2 /*uv*/, const SurfaceJet& jet, Metric2 metric,
                   FaceInGraph& face) const override {
    face.h.push_back(isotropic_size(jet, metric));
  }
  void add_face(const FaceInGraph& made, std::size_t first) override {
    for (std::size_t v = 0; v < made.h.size(); ++v)
      if (made.h[v] > 0) bound(static_cast<int>(first + v), made.h[v]);
  }
  void orient(std::size_t /*place*/) override {}
  void add_source(int place, const GradingWork::Sample& sample, const Vec3& way) override {
    sources_.push_back({place, {sample.h, -1 * way}});
  }
  void complete() override { prescribed_ = work_.h; }

  void bound_across(int vertex, const Vec3& /*across*/, double h) override {
    work_.h[vertex] = std::min(work_.h[vertex], h);
  }
  [[nodiscard]] double largest_at(int place) const override { return work_.h[work_.graph.places[place].vertex]; }
  void bound_facing(const FacingPlace& facing, double h) override {
    bound(facing.place, h);
    // The other face may have no vertex near the closest point.
    for (const int p : work_.graph.triangles[facing.triangle]) {
      const Vec3 way =
          step_on_surface(work_.graph.places[p].normal, facing.foot - work_.graph.xyz[work_.graph.places[p].vertex]);
      sources_.push_back({p, {h, -1 * way}});
    }
  }

  // The sizes of curves are known at their vertices already.
  void grade(const std::vector<SizeSamples>& /*raw*/, double slope) override {
    fronts_ = grade_fronts(work_.graph, work_.h, sources_, slope, work_.monitor);
  }
  [[nodiscard]] double along(int place, const Vec3& /*direction*/) const noexcept override {
    return fronts_.h[work_.graph.places[place].vertex];
  }
  void give_to_face(std::size_t f) override {
    GradedFace& face = work_.faces[f];
    for (std::size_t v = 0; v < face.uv.size(); ++v) {
      face.front.push_back(fronts_.front[work_.place_of[f] + v]);
      face.h.push_back(fronts_.h[work_.graph.places[work_.place_of[f] + v].vertex]);
    }
    find_rough(work_, prescribed_, f, face);
    find_size_minima(face);
  }
  [[nodiscard]] double at_node(std::size_t c, std::size_t node, const SizeSamples& /*raw*/) const override {
    return fronts_.h[work_.node_of[c][node]];
  }
  [[nodiscard]] double between_nodes(std::size_t c, std::size_t k, double w, double h, double /*known*/,
                                     const GradedField& field) const override {
    const DiscreteCurve& d = work_.curves[c];
    const std::vector<CurveUse>& uses = work_.model.topology.curves[c].uses;
    const Vec3 xyz = lerp(d.xyz[k], d.xyz[k + 1], w);
    for (std::size_t u = 0; u < uses.size(); ++u)
      h = std::min(h, field.size(uses[u].face, lerp(d.uv_of_use[u][k], d.uv_of_use[u][k + 1], w), xyz, infinity));
    return h;
  }

 private:
  void bound(int place, double h) {
    double& known = work_.h[work_.graph.places[place].vertex];
    known = std::min(known, h);
  }

  std::vector<GradationSource> sources_;
  std::vector<double> prescribed_;  // before any bound
  GradationFronts fronts_;
};

}  // namespace

std::unique_ptr<GraphSizes> isotropic_graph_sizes(GradingWork& work) { return std::make_unique<IsotropicSizes>(work); }

}  // namespace carreau::detail
