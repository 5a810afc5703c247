#include "surface/delivered.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

#include "cad/fundamental_forms.h"
#include "mesh/quality.h"
#include "surface/gauss.h"
#include "surface/triangle_distance.h"

namespace carreau {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// Points to evaluate at a time.
constexpr std::size_t batch = 2048;

struct Barycentric {
  double a, b, c, weight;
};

// Radon's rule of seven points, exact up to degree 5. Its centre is where a near equilateral triangle is farthest from
// a surface.
std::array<Barycentric, 7> triangle_rule() {
  const double root = std::sqrt(15.0);
  const double near = (6 - root) / 21, far = (6 + root) / 21;
  const double near_weight = (155 - root) / 1200, far_weight = (155 + root) / 1200;
  std::array<Barycentric, 7> rule{};
  rule[0] = {1.0 / 3, 1.0 / 3, 1.0 / 3, 9.0 / 40};
  std::size_t k = 1;
  for (const auto& [x, w] : {std::pair{near, near_weight}, std::pair{far, far_weight}}) {
    rule[k++] = {1 - 2 * x, x, x, w};
    rule[k++] = {x, 1 - 2 * x, x, w};
    rule[k++] = {x, x, 1 - 2 * x, w};
  }
  return rule;
}

double degrees(double radians) noexcept { return radians * 180 / std::numbers::pi; }
double angle_between(Vec3 p, Vec3 q) noexcept { return std::atan2(norm(cross(p, q)), dot(p, q)); }

std::uint64_t key_of(std::int32_t a, std::int32_t b) noexcept {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(std::min(a, b))) << 32 |
         static_cast<std::uint32_t>(std::max(a, b));
}

/// Evaluates jets and metrics at points of a face, a batch at a time, in the order in which they were added.
class Sampler {
 public:
  Sampler(Cad& cad, const PrescribedMetric& prescribed, Monitor& monitor)
      : cad_(cad), prescribed_(prescribed), monitor_(monitor) {}

  /// use(rank, jet, metric) for each point; metrics are computed when `with_metric`, else default ones are handed over.
  template <typename Use>
  void run(int face, int ref, unsigned want, bool with_metric, std::span<const Vec2> uv, const Use& use) {
    jets_.resize(batch);
    metrics_.resize(batch);
    if (with_metric) want |= prescribed_.wants | want_first;
    for (std::size_t i = 0; i < uv.size(); i += batch) {
      monitor_.checkpoint();
      const std::size_t n = std::min(batch, uv.size() - i);
      const std::span<SurfaceJet> jets = std::span(jets_).first(n);
      cad_.surface(ref, want, uv.subspan(i, n), jets);
      if (with_metric) prescribed_.at(face, uv.subspan(i, n), jets, std::span(metrics_).first(n));
      for (std::size_t k = 0; k < n; ++k) use(i + k, jets_[k], metrics_[k]);
    }
  }

 private:
  Cad& cad_;
  const PrescribedMetric& prescribed_;
  Monitor& monitor_;
  std::vector<SurfaceJet> jets_;
  std::vector<Metric2> metrics_;
};

/// A corner of a triangle, and the edge that leaves it.
struct Side {
  std::uint64_t key;
  std::int64_t corner;  // 3 * triangle + i
};

class Measure {
 public:
  Measure(const SurfaceMesh& mesh, Cad& cad, const PrescribedMetric& prescribed, const DeliveredOptions& options,
          Monitor& monitor)
      : mesh_(mesh),
        options_(options),
        gauss_(gauss_rule(options.gauss_points)),
        sampler_(cad, prescribed, monitor),
        edges_(result_.edges),
        triangles_(result_.triangles) {}

  Delivered run() {
    number_edges();
    const std::size_t m = mesh_.triangle_count();
    triangles_.q1.reserve(m), triangles_.q2.reserve(m);
    triangles_.metric_quality.assign(m, 0);
    triangles_.deviation.assign(m, 0);
    triangles_.angle.assign(m, 0);
    std::size_t first = 0;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      face_index_ = static_cast<int>(f);
      face_ = &mesh_.faces[f];
      first_ = first;
      if (!face_->triangles.empty()) measure_face();
      first += face_->triangles.size();
    }
    share_deviations();
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::size_t corner(std::size_t t, std::size_t i) const { return 3 * (first_ + t) + i; }
  [[nodiscard]] Vec3 position(std::int32_t local) const { return mesh_.vertices[face_->vertex[local]]; }
  [[nodiscard]] std::array<Vec3, 3> corners(std::size_t t) const {
    const auto& c = face_->triangles[t];
    return {position(c[0]), position(c[1]), position(c[2])};
  }

  void number_edges() {
    std::vector<Side> sides;
    sides.reserve(3 * mesh_.triangle_count());
    for (const FaceMesh& face : mesh_.faces)
      for (const auto& t : face.triangles)
        for (int i = 0; i < 3; ++i) {
          const std::int32_t a = face.vertex[t[i]], b = face.vertex[t[(i + 1) % 3]];
          sides.push_back({key_of(a, b), static_cast<std::int64_t>(sides.size())});
        }
    edge_of_.assign(sides.size(), -1);
    std::sort(sides.begin(), sides.end(),
              [](const Side& p, const Side& q) { return p.key != q.key ? p.key < q.key : p.corner < q.corner; });
    // The first corner of an edge numbers it.
    std::vector<char> is_first(sides.size(), 0);
    for (std::size_t i = 0; i < sides.size(); ++i)
      if (i == 0 || sides[i].key != sides[i - 1].key) is_first[sides[i].corner] = 1;
    std::int32_t count = 0;
    for (std::size_t c = 0; c < is_first.size(); ++c)
      if (is_first[c] != 0) edge_of_[c] = count++;
    edges_.vertices.resize(count);
    std::int32_t edge = -1;
    for (const Side& side : sides) {
      if (is_first[side.corner] != 0) {
        edge = edge_of_[side.corner];
        edges_.vertices[edge] = {static_cast<std::int32_t>(side.key >> 32),
                                 static_cast<std::int32_t>(side.key & 0xffffffffU)};
      }
      edge_of_[side.corner] = edge;
    }
    is_first_ = std::move(is_first);
    mark_curves(sides);
    edges_.length.assign(count, 0);
    edges_.angle.assign(count, nan);
    edges_.gradation.assign(count, nan);
    above_.resize(static_cast<std::size_t>(count) * gauss_.node.size());
  }

  void mark_curves(const std::vector<Side>& sides) {
    edges_.on_curve.assign(edges_.vertices.size(), 0);
    for (const CurveMesh& curve : mesh_.curves)
      for (std::size_t i = 1; i < curve.vertices.size(); ++i) {
        const std::uint64_t key = key_of(curve.vertices[i - 1], curve.vertices[i]);
        const auto it =
            std::lower_bound(sides.begin(), sides.end(), key, [](const Side& s, std::uint64_t k) { return s.key < k; });
        if (it != sides.end() && it->key == key) edges_.on_curve[edge_of_[it->corner]] = 1;
      }
  }

  void measure_face() {
    measure_vertices();
    measure_edges();
    measure_triangles();
  }

  // Normals at the vertices, and metrics along edges that end there.
  void measure_vertices() {
    const std::vector<Vec2>& uv = face_->uv;
    normal_.assign(uv.size(), std::nullopt);
    at_vertex_.resize(uv.size());
    sampler_.run(face_index_, face_->ref, want_first, true, uv,
                 [&](std::size_t v, const SurfaceJet& jet, const Metric2& metric) {
                   normal_[v] = unit_normal(jet);
                   at_vertex_[v] = {jet.su, jet.sv, metric};
                 });
  }

  // The size that is prescribed along d at a vertex; NaN at a singular one.
  [[nodiscard]] double size_along(std::int32_t v, Vec2 d) const {
    if (!normal_[v]) return nan;
    const AtVertex& place = at_vertex_[v];
    return norm(d.x * place.su + d.y * place.sv) / length(place.metric, d);
  }

  // Sizes at the ends of an edge that lies on a curve, when they are known.
  [[nodiscard]] std::optional<std::array<double, 2>> curve_sizes(std::int32_t edge, std::int32_t a,
                                                                 std::int32_t b) const {
    if (edges_.on_curve[edge] == 0 || options_.curve_size.empty()) return {};
    const double p = options_.curve_size[face_->vertex[a]], q = options_.curve_size[face_->vertex[b]];
    if (!(p > 0) || !(q > 0)) return {};
    return std::array{p, q};
  }

  void measure_edges() {
    struct Own {
      std::int32_t edge, a, b;
    };
    std::vector<Own> own;  // measured in this face
    for (std::size_t t = 0; t < face_->triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t a = face_->triangles[t][i], b = face_->triangles[t][(i + 1) % 3];
        const std::int32_t edge = edge_of_[corner(t, i)];
        raise_edge_angle(edge, a, b);
        if (is_first_[corner(t, i)] != 0) own.push_back({edge, a, b});
      }
    const std::size_t n = gauss_.node.size();
    std::vector<Vec2> uv;
    uv.reserve(n * own.size());
    for (const Own& o : own)
      for (const double s : gauss_.node) uv.push_back(lerp(face_->uv[o.a], face_->uv[o.b], s));
    sampler_.run(face_index_, face_->ref, want_position | want_first, true, uv,
                 [&](std::size_t k, const SurfaceJet& jet, const Metric2& metric) {
                   const Own& o = own[k / n];
                   const Vec2 d = face_->uv[o.b] - face_->uv[o.a];
                   double speed = length(metric, d);
                   if (const auto h = curve_sizes(o.edge, o.a, o.b))
                     speed = norm(d.x * jet.su + d.y * jet.sv) /
                             interpolate_size(options_.law, (*h)[0], (*h)[1], gauss_.node[k % n]);
                   edges_.length[o.edge] += gauss_.weight[k % n] * speed;
                   above_[static_cast<std::size_t>(o.edge) * n + k % n] = jet.s;
                 });
    for (const Own& o : own) set_gradation(o.edge, o.a, o.b);
  }

  void raise_edge_angle(std::int32_t edge, std::int32_t a, std::int32_t b) {
    const Vec3 d = position(b) - position(a);
    const double l = norm(d);
    double& angle = edges_.angle[edge];
    for (const std::int32_t v : {a, b}) {
      if (!normal_[v] || !(l > 0)) continue;
      const double here = degrees(std::asin(std::min(1.0, std::abs(dot(d, *normal_[v])) / l)));
      if (!(angle >= here)) angle = here;
    }
  }

  void set_gradation(std::int32_t edge, std::int32_t a, std::int32_t b) {
    const Vec2 d = face_->uv[b] - face_->uv[a];
    double p = size_along(a, d), q = size_along(b, d);
    if (const auto h = curve_sizes(edge, a, b)) p = (*h)[0], q = (*h)[1];
    const double l = edges_.length[edge];
    if (!(p > 0) || !(q > 0) || !(l > 0)) return;
    edges_.gradation[edge] = std::pow(std::max(p / q, q / p), 1 / l);
  }

  void measure_triangles() {
    static const std::array<Barycentric, 7> rule = triangle_rule();
    std::vector<Vec2> uv;
    uv.reserve(rule.size() * face_->triangles.size());
    for (const auto& t : face_->triangles)
      for (const Barycentric& w : rule)
        uv.push_back(w.a * face_->uv[t[0]] + w.b * face_->uv[t[1]] + w.c * face_->uv[t[2]]);
    for (std::size_t t = 0; t < face_->triangles.size(); ++t) start_triangle(t);
    sampler_.run(face_index_, face_->ref, want_position | want_first, true, uv,
                 [&](std::size_t k, const SurfaceJet& jet, const Metric2& metric) {
                   const std::size_t t = k / rule.size(), place = first_ + t;
                   const std::array<Vec3, 3> p = corners(t);
                   triangles_.deviation[place] =
                       std::max(triangles_.deviation[place], distance_to_triangle(jet.s, p[0], p[1], p[2]));
                   raise_angle(place, p, unit_normal(jet));
                   // Area in the metric, in units of the triangle of (u, v).
                   triangles_.metric_quality[place] +=
                       rule[k % rule.size()].weight * std::sqrt(std::max(determinant(metric), 0.0));
                 });
    for (std::size_t t = 0; t < face_->triangles.size(); ++t) finish_quality(t);
  }

  void raise_angle(std::size_t place, const std::array<Vec3, 3>& p, const std::optional<Vec3>& normal) {
    if (!normal) return;
    const Vec3 own = cross(p[1] - p[0], p[2] - p[0]);
    triangles_.angle[place] = std::max(triangles_.angle[place], degrees(angle_between(own, *normal)));
  }

  void start_triangle(std::size_t t) {
    const std::array<Vec3, 3> p = corners(t);
    triangles_.q1.push_back(quality_q1(p[0], p[1], p[2]));
    triangles_.q2.push_back(quality_q2(p[0], p[1], p[2]));
    for (const std::int32_t v : face_->triangles[t]) raise_angle(first_ + t, p, normal_[v]);
  }

  void finish_quality(std::size_t t) {
    const auto& c = face_->triangles[t];
    const double area = 0.5 * cross(face_->uv[c[1]] - face_->uv[c[0]], face_->uv[c[2]] - face_->uv[c[0]]);
    double squares = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double l = edges_.length[edge_of_[corner(t, i)]];
      squares += l * l;
    }
    double& quality = triangles_.metric_quality[first_ + t];
    // HDR eq. 1.6 with the metric's area and lengths; in a metric that varies they may be those of no flat triangle.
    quality = squares > 0 ? std::min(1.0, 4 * std::numbers::sqrt3 * area * quality / squares) : 0;
  }

  // What lies above an edge belongs to both triangles beside, and is as near as the nearer one.
  void share_deviations() {
    const std::size_t n = gauss_.node.size();
    std::vector<double> nearest(above_.size(), std::numeric_limits<double>::infinity());
    const auto for_sides = [&](const auto& use) {
      std::size_t first = 0;
      for (const FaceMesh& face : mesh_.faces) {
        for (std::size_t t = 0; t < face.triangles.size(); ++t)
          for (std::size_t i = 0; i < 3; ++i) use(face, t, first + t, edge_of_[3 * (first + t) + i]);
        first += face.triangles.size();
      }
    };
    for_sides([&](const FaceMesh& face, std::size_t t, std::size_t, std::int32_t edge) {
      const auto& c = face.triangles[t];
      for (std::size_t k = 0; k < n; ++k) {
        double& d = nearest[static_cast<std::size_t>(edge) * n + k];
        d = std::min(
            d, distance_to_triangle(above_[static_cast<std::size_t>(edge) * n + k], mesh_.vertices[face.vertex[c[0]]],
                                    mesh_.vertices[face.vertex[c[1]]], mesh_.vertices[face.vertex[c[2]]]));
      }
    });
    for_sides([&](const FaceMesh&, std::size_t, std::size_t place, std::int32_t edge) {
      for (std::size_t k = 0; k < n; ++k)
        triangles_.deviation[place] =
            std::max(triangles_.deviation[place], nearest[static_cast<std::size_t>(edge) * n + k]);
    });
  }

  struct AtVertex {
    Vec3 su, sv;
    Metric2 metric;
  };

  const SurfaceMesh& mesh_;
  const DeliveredOptions& options_;
  GaussRule gauss_;
  Sampler sampler_;
  Delivered result_;
  DeliveredEdges& edges_;
  DeliveredTriangles& triangles_;
  std::vector<std::int32_t> edge_of_;  // by corner of the mesh
  std::vector<char> is_first_;         // by corner: measures the edge
  std::vector<Vec3> above_;            // by edge and Gauss point
  // Of the face at work.
  int face_index_ = 0;
  const FaceMesh* face_ = nullptr;
  std::size_t first_ = 0;
  std::vector<std::optional<Vec3>> normal_;
  std::vector<AtVertex> at_vertex_;
};

CallCounts difference(const CallCounts& p, const CallCounts& q) {
  return {p.surf0 - q.surf0, p.surf1 - q.surf1, p.surf2 - q.surf2, p.curv0 - q.curv0,
          p.curv1 - q.curv1, p.curv2 - q.curv2, p.sizes - q.sizes};
}

}  // namespace

Delivered measure_delivered(const SurfaceMesh& mesh, Cad& cad, const PrescribedMetric& prescribed,
                            const DeliveredOptions& options, Monitor& monitor) {
  const auto start = std::chrono::steady_clock::now();
  const CallCounts before = cad.counts();
  Delivered d = Measure(mesh, cad, prescribed, options, monitor).run();
  d.edge_angle_limit = options.edge_angle_limit;
  d.deviation_limit = options.deviation_limit;
  for (const double l : d.edges.length) {
    d.short_edges += l < std::numbers::sqrt2 / 2;
    d.long_edges += l > std::numbers::sqrt2;
  }
  for (const double a : d.edges.angle) d.edges_over_angle += a > options.edge_angle_limit;
  for (const double a : d.triangles.deviation) d.triangles_over_deviation += a > options.deviation_limit;
  for (const double a : d.triangles.angle) d.folded_triangles += a > 90;
  summarise(d);
  d.calls = difference(cad.counts(), before);
  d.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return d;
}

}  // namespace carreau
