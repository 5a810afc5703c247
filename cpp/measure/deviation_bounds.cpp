// SPDX-License-Identifier: BSD-3-Clause
#include "measure/deviation_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/base/spread_samples.h"
#include "measure/bounds/bounded_triangles.h"
#include "measure/bounds/charted_places.h"
#include "support/infinity.h"
#include "support/shares.h"
#include "support/work_sizes.h"
#include "surface/remesh/bounds/spread_places.h"
#include "surface/remesh/bounds/thresholds.h"

namespace carreau {

namespace {


constexpr double degree = std::numbers::pi / 180;

class Bounds {
 public:
  Bounds(const SurfaceMesh& mesh, Cad& cad, const EvaluationOptions& options, Monitor& monitor, MeshEvaluation& delivered)
      : mesh_(mesh), cad_(cad), options_(options), monitor_(monitor), delivered_(delivered), triangles_(mesh, delivered.edges), shared_(delivered.edges.vertices.size()) {}

  void run() {
    for (const EvaluationKind kind :
         {EvaluationKind::deviation_bound, EvaluationKind::angle_bound, EvaluationKind::bound_share})
      delivered_[kind].values.assign(triangles_.size(), nan);
    std::size_t first = 0;
    for (std::size_t f = 0; f < mesh_.faces.size(); first += mesh_.faces[f++].triangles.size())
      bound_face(static_cast<std::int32_t>(f), first);
  }

 private:
  void bound_face(std::int32_t f, std::size_t first) {
    const FaceMesh& face = mesh_.faces[static_cast<std::size_t>(f)];
    if (!face.mid.empty()) return;
    std::vector<std::int32_t> charted;
    ChartedPlaces places(mesh_, f, first, delivered_.edges, shared_, cad_, monitor_);
    for (std::size_t t = 2 * static_cast<std::size_t>(face.quads); t < face.triangles.size(); ++t) {
      if (face.is_spread(t)) {
        bound_spread(f, t, first);
      } else {
        charted.push_back(static_cast<std::int32_t>(t));
      }
      if (charted.size() == work_sizes::triangles) bound_charted(places, charted, first), charted.clear();
    }
    bound_charted(places, charted, first);
  }

  struct Open {
    std::int32_t triangle;  // of the face
    TriangleBound bound;
  };

  void bound_charted(ChartedPlaces& places, std::span<const std::int32_t> charted, std::size_t first) {
    places.see(charted);
    std::vector<Open> open;
    for (std::size_t k = 0; k < charted.size(); ++k) {
      if (k % 256 == 0) monitor_.checkpoint();
      const std::size_t t = first + static_cast<std::size_t>(charted[k]);
      const BoundedTriangle triangle = wanted(t);
      if (triangle.is_flat()) continue;
      TriangleBound bound(triangle, places.lattice(k));
      if (bound.wanted().empty())
        tell(t, bound);
      else
        open.push_back({charted[k], std::move(bound)});
    }
    while (!open.empty()) {
      std::vector<ChartedPlace> more;
      for (const Open& o : open)
        for (const PlaceInTriangle& at : o.bound.wanted()) more.push_back({o.triangle, at});
      const std::vector<BoundPlace> seen = places.see(more);
      std::size_t from = 0;
      for (Open& o : open) {
        const std::size_t n = o.bound.wanted().size();
        o.bound.take(std::span(seen).subspan(from, n));
        from += n;
        if (o.bound.wanted().empty()) tell(first + static_cast<std::size_t>(o.triangle), o.bound);
      }
      std::erase_if(open, [](const Open& o) { return o.bound.wanted().empty(); });
    }
  }

  void bound_spread(std::int32_t f, std::size_t t, std::size_t first) {
    monitor_.checkpoint();
    const BoundedTriangle triangle = wanted(first + t);
    if (triangle.is_flat()) return;
    SpreadPlaces places(spread_triangle(mesh_, options_.atlas, cad_, static_cast<std::size_t>(f), t), triangle);
    const auto see = [&](std::span<const PlaceInTriangle> at) {
      std::vector<BoundPlace> seen;
      seen.reserve(at.size());
      for (const PlaceInTriangle& p : at) seen.push_back(places.at(p));
      return seen;
    };
    TriangleBound bound(triangle, places.lattice());
    while (!bound.wanted().empty()) bound.take(see(bound.wanted()));
    tell(first + t, bound, places.has_normals());
  }

  // The mean size at its corners.
  [[nodiscard]] double deviation_tolerance(std::size_t t) const {
    if (std::isfinite(options_.deviation_tolerance)) return options_.deviation_tolerance;
    if (options_.vertex_size.empty()) return nan;
    double sum = 0;
    for (const std::int32_t v : triangles_.vertices(t)) sum += options_.vertex_size[static_cast<std::size_t>(v)];
    return options_.deviation_share * sum / 3;
  }

  [[nodiscard]] BoundedTriangle wanted(std::size_t t) const {
    BoundedTriangle triangle = triangles_.at(t);
    const double tolerance = deviation_tolerance(t);
    triangle.deviation_floor = shares::negligible * (tolerance > 0 ? tolerance : options_.deviation_share * triangle.longest);
    if (tolerance > 0) triangle.deviation_tolerance = tolerance;
    triangle.angle_tolerance = options_.angle_tolerance * degree;
    triangle.angle_floor = shares::small * options_.angle_tolerance * degree;
    return triangle;
  }

  void tell(std::size_t t, const TriangleBound& bound, bool has_normals = true) {
    const double deviation = std::max(bound.deviation(), delivered_[EvaluationKind::deviation].values[t]);
    const double angle = std::max(bound.angle() / degree, delivered_[EvaluationKind::angle].values[t]);
    delivered_[EvaluationKind::deviation_bound].values[t] = deviation;
    if (!has_normals) return;
    delivered_[EvaluationKind::angle_bound].values[t] = angle;
    const double tolerance = deviation_tolerance(t);
    if (tolerance > 0)
      delivered_[EvaluationKind::bound_share].values[t] = std::max(deviation / tolerance, angle / options_.angle_tolerance);
  }

  const SurfaceMesh& mesh_;
  Cad& cad_;
  const EvaluationOptions& options_;
  Monitor& monitor_;
  MeshEvaluation& delivered_;
  BoundedTriangles triangles_;
  std::vector<SharedEdge> shared_;
};

}  // namespace

void bound_deviations(const SurfaceMesh& mesh, Cad& cad, const EvaluationOptions& options, Monitor& monitor,
                      MeshEvaluation& delivered) {
  Bounds(mesh, cad, options, monitor, delivered).run();
}

}  // namespace carreau
