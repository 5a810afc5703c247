// SPDX-License-Identifier: BSD-3-Clause
#include "surface/carry/image_vertices.h"

#include <cstddef>

#include "periodic/closest.h"
#include "periodic/parameter_map.h"
#include "support/infinity.h"

namespace carreau {

namespace {

class Placing {
 public:
  Placing(const ImageVertices& vertices, double exact, std::vector<Vec2>& uv, std::vector<Vec3>& xyz)
      : given_(vertices), exact_(exact), uv_(uv), xyz_(xyz) {}

  void place(std::span<const std::size_t> which, std::span<const Vec2> guesses) {
    std::vector<Vec3> targets;
    std::vector<ClosestPoint> points;
    for (std::size_t i = 0; i < which.size(); ++i) {
      targets.push_back(given_.target[which[i]]);
      points.push_back({guesses[i], {}, 0});
    }
    find_closest(given_.cad, given_.face, targets, points);
    for (std::size_t i = 0; i < which.size(); ++i) {
      uv_[which[i]] = points[i].uv;
      xyz_[which[i]] = points[i].distance <= exact_ ? targets[i] : points[i].xyz;
      if (points[i].distance > missed_.distance) missed_ = {which[i], points[i].distance};
    }
  }

  [[nodiscard]] MissedVertex missed() const noexcept { return missed_; }

 private:
  const ImageVertices& given_;
  double exact_;
  std::vector<Vec2>& uv_;
  std::vector<Vec3>& xyz_;
  MissedVertex missed_;
};

// Layer by layer, each vertex from its nearest neighbour that is known.
void place_by_layers(const ImageVertices& given, std::span<const std::array<std::int32_t, 3>> triangles, const std::vector<Vec2>& uv,
                     Placing& placing) {
  const std::size_t n = given.target.size();
  std::vector<std::vector<std::int32_t>> beside(n);
  for (const auto& t : triangles)
    for (int i = 0; i < 3; ++i)
      if (given.known[t[i]] == 0) beside[t[i]].insert(beside[t[i]].end(), {t[(i + 1) % 3], t[(i + 2) % 3]});
  std::vector<char> known = given.known;
  for (;;) {
    std::vector<std::size_t> layer;
    std::vector<Vec2> guesses;
    for (std::size_t v = 0; v < n; ++v) {
      if (known[v] != 0) continue;
      double nearest = infinity;
      Vec2 guess(0, 0);
      for (const std::int32_t w : beside[v])
        if (const double d = norm(given.target[w] - given.target[v]); known[w] != 0 && d < nearest) nearest = d, guess = uv[w];
      if (nearest < infinity) layer.push_back(v), guesses.push_back(guess);
    }
    if (layer.empty()) return;
    placing.place(layer, guesses);
    for (const std::size_t v : layer) known[v] = 1;
  }
}

}  // namespace

MissedVertex place_images(const ImageVertices& given, std::span<const std::array<std::int32_t, 3>> triangles, double exact,
                          std::vector<Vec2>& uv, std::vector<Vec3>& xyz) {
  Placing placing(given, exact, uv, xyz);
  std::vector<Vec2> from, to, guesses;
  std::vector<std::size_t> sought;
  for (std::size_t v = 0; v < given.known.size(); ++v)
    if (given.known[v] != 0)
      from.push_back(given.from_uv[v]), to.push_back(uv[v]);
    else
      sought.push_back(v);
  const ParameterMap parameters(from, to);
  if (!parameters.is_affine()) {
    place_by_layers(given, triangles, uv, placing);
    return placing.missed();
  }
  for (const std::size_t v : sought) guesses.push_back(parameters.guess(given.from_uv[v]));
  placing.place(sought, guesses);
  return placing.missed();
}

}  // namespace carreau
