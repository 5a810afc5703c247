// SPDX-License-Identifier: BSD-3-Clause
#include "surface/lift/surface_agreement.h"

#include <array>
#include <cmath>

#include "support/angles.h"
#include "support/format.h"
#include "support/infinity.h"
#include "surface/lift/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::lift;

/// The surface over a triangle of (u, v), by the middles of its parts.
struct Piece {
  Vec3 vector;      ///< integral of the normal: the normal of a triangle that has the same border, times its area
  double area = 0;  ///< integral of 1
};
class Pieces {
 public:
  Pieces(const PatchInput& input, Cad& cad, const PatchMesh& mesh) : input_(input), cad_(cad), mesh_(mesh) {}

  Piece over(int t) {
    const auto& [a, b, c] = mesh_.plane.triangles[t];
    const Vec2 p = mesh_.plane.vertices[a], q = mesh_.plane.vertices[b] - p, r = mesh_.plane.vertices[c] - p;
    std::size_t n = 0;
    const auto add = [&](double i, double j) { uv_[n++] = p + (i / parts) * q + (j / parts) * r; };
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j) {
        add(i + 1. / 3, j + 1. / 3);
        if (i + j + 1 < parts) add(i + 2. / 3, j + 2. / 3);
      }
    cad_.surface(input_.ref, want_first, uv_, jets_);
    const double share = (q.x() * r.y() - q.y() * r.x()) / 2 / static_cast<double>(n);
    Piece piece;
    for (const SurfaceJet& jet : jets_) {
      const Vec3 normal = share * cross(jet.su, jet.sv);
      piece.vector = piece.vector + normal;
      piece.area += norm(normal);
    }
    return piece;
  }

 private:
  const PatchInput& input_;
  Cad& cad_;
  const PatchMesh& mesh_;
  std::array<Vec2, parts * parts> uv_;
  std::array<SurfaceJet, parts * parts> jets_;
};

/// Twice the area, along the normal.
Vec3 normal_of(const PatchMesh& mesh, std::size_t t) noexcept {
  const auto& [a, b, c] = mesh.plane.triangles[t];
  return cross(mesh.xyz[b] - mesh.xyz[a], mesh.xyz[c] - mesh.xyz[a]);
}

/// Sum of areas over sum of their projections along the mean normal of the corners, less 1.
double excess_by_corners(const PatchMesh& mesh) noexcept {
  if (mesh.normal.size() != mesh.xyz.size()) return 0;
  double area = 0, below = 0;
  for (std::size_t t = 0; t < mesh.plane.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.plane.triangles[t];
    const Vec3 n = normal_of(mesh, t), m = mesh.normal[a] + mesh.normal[b] + mesh.normal[c];
    const double whole = norm(m);
    if (!(whole > 0)) continue;  // at a pole the normal is unknown
    area += norm(n);
    below += dot(n, m) / whole;
  }
  if (!(area > 0)) return 0;
  return below > 0 ? area / below - 1 : infinity;
}

}  // namespace

bool SurfaceAgreement::leans() const noexcept { return excess > notable_area; }

bool SurfaceAgreement::better_than(const SurfaceAgreement& other) const noexcept {
  if (leans() != other.leans()) return other.leans();
  return turned < other.turned || (turned == other.turned && other.leans() && excess < other.excess);
}

std::string SurfaceAgreement::text() const {
  std::string text;
  if (turned > 0)
    text = std::to_string(turned) +
           (turned == 1 ? " triangle is turned over or stands" : " triangles are turned over or stand") + " upright on the surface";
  if (!leans()) return text;
  return text + (text.empty() ? "" : ", and ") + "triangles lean: they have " +
         (excess < infinity ? format_number(std::round(100 * (1 + excess)) / 100) + " times " : "far more than ") +
         "the area of the surface";
}

SurfaceAgreement measure_agreement(const PatchInput& input, Cad& cad, const std::vector<int>& doubtful,
                                   const PatchMesh& mesh, Monitor& monitor) {
  SurfaceAgreement agreement;
  Pieces pieces(input, cad, mesh);
  for (const int t : doubtful) {
    const Vec3 n = normal_of(mesh, static_cast<std::size_t>(t)), m = pieces.over(t).vector;
    if (dot(n, m) >= angles::cosine_of_85 * norm(n) * norm(m)) continue;
    ++agreement.turned;
    agreement.turned_triangles.push_back(t);
  }
  if (!(excess_by_corners(mesh) > notable_area)) return agreement;
  double area = 0, of_surface = 0;
  for (std::size_t t = 0; t < mesh.plane.triangles.size(); ++t) {
    if (t % 256 == 0) monitor.checkpoint();
    area += norm(normal_of(mesh, t)) / 2;
    of_surface += pieces.over(static_cast<int>(t)).area;
  }
  agreement.excess = of_surface > 0 ? area / of_surface - 1 : 0;
  return agreement;
}

}  // namespace carreau
