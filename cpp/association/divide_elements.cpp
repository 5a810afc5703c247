// SPDX-License-Identifier: BSD-3-Clause
#include "association/divide_elements.h"

#include "mesh/quality.h"
#include "predicates/convex_quad.h"
#include "predicates/predicates.h"
#include "surface/elements/quads/quad_shape.h"

namespace carreau::refining {

namespace {

class Division {
 public:
  Division(FaceMesh& face, const EdgeList& edges, std::span<const std::int32_t> middle, const std::vector<Vec3>& vertices)
      : face_(face), edges_(edges), middle_(middle), vertices_(vertices) {}

  std::vector<float> run(const std::function<std::int32_t(const Vec2&)>& add_centre,
                         const std::function<void(std::span<const std::int32_t>)>& place_centres) {
    triangles_.reserve(4 * face_.triangles.size()), before_.reserve(4 * face_.triangles.size());
    for (std::size_t k = 0; k < static_cast<std::size_t>(face_.quads); ++k) divide_quad(face_.quad(k), add_centre);
    place_centres(centres_);
    before_.assign(triangles_.size(), 0);  // triangles of quadrilaterals have no shape to keep
    for (std::size_t t = 2 * static_cast<std::size_t>(face_.quads); t < face_.triangles.size(); ++t) {
      divide_triangle(face_.triangles[t]);
      before_.resize(triangles_.size(), static_cast<float>(shape(face_.triangles[t])));
    }
    std::vector<Triangle> flattened;
    for (const Triangle& t : face_.flattened) divide_flattened(t, flattened);
    face_.flattened = std::move(flattened);
    face_.mid.clear(), face_.mid_uv.clear(), face_.mid_vertex.clear();
    if (quads_.empty()) {
      face_.quads = 0, face_.triangles = std::move(triangles_);
    } else {
      set_cells(face_, quads_, triangles_, vertices_);
      before_.insert(before_.begin(), of_quads_.begin(), of_quads_.end());
    }
    return std::move(before_);
  }

 private:
  [[nodiscard]] std::int32_t middle(std::int32_t a, std::int32_t b) const {
    const std::int32_t e = edges_.find(a, b);
    return e < 0 ? -1 : middle_[e];
  }
  [[nodiscard]] double shape(const Triangle& t) const { return shape_of(face_, t, vertices_); }

  [[nodiscard]] float quad_shape(const std::array<std::int32_t, 4>& q) const {
    std::array<Vec3, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = vertices_[face_.vertex[q[i]]];
    return static_cast<float>(min_shape(p));
  }

  // The blend of the sides (Coons 1967): a side that bends moves it by half of its bulge, the mean of middles by a quarter. A corner at a
  // pole has any place of its side, for which the blend may not fit.
  [[nodiscard]] Vec2 centre_of(const std::array<std::int32_t, 4>& q, const std::array<std::int32_t, 4>& m) const {
    Vec2 mean{0, 0}, blend{0, 0};
    for (std::size_t i = 0; i < 4; ++i) mean += 0.25 * face_.uv[m[i]], blend += 0.5 * face_.uv[m[i]] - 0.25 * face_.uv[q[i]];
    for (std::size_t i = 0; i < 4; ++i)
      if (!is_convex_quad(face_.uv[q[i]], face_.uv[m[i]], blend, face_.uv[m[(i + 3) % 4]])) return mean;
    return blend;
  }

  void divide_quad(const std::array<std::int32_t, 4>& q, const std::function<std::int32_t(const Vec2&)>& add_centre) {
    std::array<std::int32_t, 4> m{};
    std::vector<std::int32_t> polygon;
    for (std::size_t i = 0; i < 4; ++i) {
      m[i] = middle(q[i], q[(i + 1) % 4]);
      polygon.push_back(q[i]);
      if (m[i] >= 0) polygon.push_back(m[i]);
    }
    if (polygon.size() == 4) {
      quads_.push_back(q);
      of_quads_.insert(of_quads_.end(), 2, quad_shape(q));
    } else if (polygon.size() == 8) {
      const std::int32_t centre = add_centre(centre_of(q, m));
      of_quads_.insert(of_quads_.end(), 8, quad_shape(q));
      centres_.push_back(centre);
      for (std::size_t i = 0; i < 4; ++i) quads_.push_back({q[i], m[i], centre, m[(i + 3) % 4]});
    } else {
      triangulate(std::move(polygon));
    }
  }

  // Cuts ears of a polygon, the best shape first.
  void triangulate(std::vector<std::int32_t> polygon) {
    while (polygon.size() > 3) {
      const std::size_t n = polygon.size();
      std::size_t best = 0;
      double found = -2;
      for (std::size_t i = 0; i < n; ++i) {
        double now = shape({polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]});
        if (n == 4) now = std::min(now, shape({polygon[(i + 1) % n], polygon[(i + 2) % n], polygon[(i + 3) % n]}));
        if (now > found) found = now, best = i;
      }
      triangles_.push_back({polygon[(best + n - 1) % n], polygon[best], polygon[(best + 1) % n]});
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(best));
    }
    triangles_.push_back({polygon[0], polygon[1], polygon[2]});
  }

  void divide_triangle(const Triangle& t) {
    const Triangle m{middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
    std::vector<Triangle>& out = triangles_;
    const auto cuts = std::count_if(m.begin(), m.end(), [](std::int32_t v) { return v >= 0; });
    if (cuts == 0) {
      out.push_back(t);
    } else if (cuts == 3) {
      out.insert(out.end(), {{t[0], m[0], m[2]}, {m[0], t[1], m[1]}, {m[2], m[1], t[2]}, {m[0], m[1], m[2]}});
    } else if (cuts == 1) {
      const std::size_t i = static_cast<std::size_t>(std::find_if(m.begin(), m.end(), [](std::int32_t v) { return v >= 0; }) - m.begin());
      out.insert(out.end(), {{t[i], m[i], t[(i + 2) % 3]}, {m[i], t[(i + 1) % 3], t[(i + 2) % 3]}});
    } else {  // the corner between both cuts, then the better diagonal of the rest
      std::size_t i = 0;
      while (m[i] < 0 || m[(i + 2) % 3] < 0) ++i;
      const std::int32_t a = t[i], p = m[i], q = m[(i + 2) % 3], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      out.push_back({a, p, q});
      const double first = std::min(shape({p, b, c}), shape({p, c, q})), second = std::min(shape({p, b, q}), shape({b, c, q}));
      if (first >= second)
        out.insert(out.end(), {{p, b, c}, {p, c, q}});
      else
        out.insert(out.end(), {{p, b, q}, {b, c, q}});
    }
  }

  // The two sides that meet at the apex are one in space, and so are their middles: only the part at the pole stays.
  void divide_flattened(const Triangle& t, std::vector<Triangle>& flattened) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      if (face_.vertex[a] != face_.vertex[b]) continue;
      const std::int32_t m = middle(b, c), n = middle(c, a);
      if (m < 0 && n < 0) break;
      if (m == n) {
        flattened.push_back({a, b, m});
      } else {  // sides of a seam, which have two places
        flattened.insert(flattened.end(), {{a, b, m}, {a, m, n}});
        flattened.push_back({n, m, c});
      }
      return;
    }
    flattened.push_back(t);
  }

  FaceMesh& face_;
  const EdgeList& edges_;
  std::span<const std::int32_t> middle_;
  const std::vector<Vec3>& vertices_;
  std::vector<std::array<std::int32_t, 4>> quads_;
  std::vector<Triangle> triangles_;
  std::vector<float> before_;  // of triangles_
  std::vector<float> of_quads_;  // two for each of quads_
  std::vector<std::int32_t> centres_;
};

}  // namespace

double shape_of(const FaceMesh& face, const Triangle& t, const std::vector<Vec3>& vertices) {
  if (orientation(face.uv[t[0]], face.uv[t[1]], face.uv[t[2]]) <= 0) return -1;
  return quality_q2(vertices[face.vertex[t[0]]], vertices[face.vertex[t[1]]], vertices[face.vertex[t[2]]]);
}

std::vector<float> divide_elements(FaceMesh& face, const EdgeList& edges, std::span<const std::int32_t> middle, const std::vector<Vec3>& vertices,
                                   const std::function<std::int32_t(const Vec2&)>& add_centre,
                                   const std::function<void(std::span<const std::int32_t>)>& place_centres) {
  return Division(face, edges, middle, vertices).run(add_centre, place_centres);
}

}  // namespace carreau::refining
