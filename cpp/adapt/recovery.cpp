// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/recovery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "adapt/thresholds.h"
#include "metric/least_squares.h"
#include "metric/metric2_algebra.h"
#include "support/error.h"
#include "support/work_sizes.h"

namespace carreau {
namespace {

using namespace thresholds::adapt;

constexpr std::size_t unknowns = 5;

VertexFrame frame_of(const Vec3& normal) {
  const double length = norm(normal);
  if (!(length > 0)) return {};
  VertexFrame f;
  // Upwards, so that the frame of a mesh in the plane is (x, y) for both orientations of its triangles.
  f.normal = (normal.z() < 0 ? -1 / length : 1 / length) * normal;
  // The axis that is least along the normal; in the plane (x, y) this gives the coordinates themselves.
  const Vec3 n = f.normal;
  const bool y_last = std::abs(n.x()) <= 0.9;
  const Vec3 axis = y_last ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  f.e1 = axis - dot(axis, n) * n;
  f.e1 = (1 / norm(f.e1)) * f.e1;
  f.e2 = cross(n, f.e1);
  return f;
}

std::vector<VertexFrame> frames_of(const ScalarField& field) {
  std::vector<Vec3> normals(field.vertices.size());
  for (const auto& t : field.triangles) {
    const Vec3 p = field.vertices[static_cast<std::size_t>(t[0])];
    const Vec3 n =
        cross(field.vertices[static_cast<std::size_t>(t[1])] - p, field.vertices[static_cast<std::size_t>(t[2])] - p);
    for (const std::int32_t v : t) normals[static_cast<std::size_t>(v)] = normals[static_cast<std::size_t>(v)] + n;
  }
  std::vector<VertexFrame> frames;
  frames.reserve(normals.size());
  for (const Vec3& n : normals) frames.push_back(frame_of(n));
  return frames;
}

/// Coordinates in which the neighbours lie evenly around the vertex, along their principal axes. So stretched meshes are
/// fitted as well as others, and the fit turns with the mesh.
struct Whitening {
  Vec2 first, second;  // coordinates are the products with these
  [[nodiscard]] Vec2 of(const Vec2& d) const noexcept { return {dot(first, d), dot(second, d)}; }
  [[nodiscard]] Vec2 gradient(double x, double y) const noexcept { return x * first + y * second; }
  [[nodiscard]] Metric2 hessian(double xx, double xy, double yy) const noexcept {
    const Vec2 p = xx * first + xy * second, q = xy * first + yy * second;
    return {p.x() * first.x() + q.x() * second.x(), p.x() * first.y() + q.x() * second.y(),
            p.y() * first.y() + q.y() * second.y()};
  }
};

std::optional<Whitening> whitening(const std::vector<Vec2>& offsets) {
  Metric2 covariance{0, 0, 0};
  for (const Vec2& d : offsets) covariance = covariance + Metric2{d.x() * d.x(), d.x() * d.y(), d.y() * d.y()};
  const Eigen2 e = eigen((2 / static_cast<double>(offsets.size())) * covariance);
  if (!(e.minor > 1e-14 * e.major)) return {};
  return Whitening{(1 / std::sqrt(e.major)) * e.direction,
                   (1 / std::sqrt(e.minor)) * Vec2{-e.direction.y(), e.direction.x()}};
}

/// Fits one vertex after the other; keeps its memory, and references.
class Fitter {
 public:
  Fitter(const ScalarField& field, const Neighbours& neighbours)
      : field_(field), neighbours_(neighbours), mark_(field.vertices.size(), -1) {}

  LocalDerivatives fit(std::int32_t v, const VertexFrame& frame) {
    LocalDerivatives result;
    result.frame = frame;
    around_.assign(1, v);
    mark_[static_cast<std::size_t>(v)] = v;
    std::size_t from = 0;
    for (int ring = 1; ring <= max_rings; ++ring) {
      const std::size_t to = around_.size();
      for (; from < to; ++from)
        for (const std::int32_t w : neighbours_.of(around_[from]))
          if (mark_[static_cast<std::size_t>(w)] != v) {
            mark_[static_cast<std::size_t>(w)] = v;
            around_.push_back(w);
          }
      if (fit_around(v, result)) return result;
      if (around_.size() == to) break;
    }
    result.reliable = false;
    return result;
  }

 private:
  bool fit_around(std::int32_t v, LocalDerivatives& result) {
    const auto at = static_cast<std::size_t>(v);
    offset_.clear();
    for (std::size_t k = 1; k < around_.size(); ++k)
      offset_.push_back(
          result.frame.in_plane(field_.vertices[static_cast<std::size_t>(around_[k])] - field_.vertices[at]));
    if (offset_.size() < unknowns) return false;
    const std::optional<Whitening> white = whitening(offset_);
    if (!white) return false;
    equations_.reset(offset_.size(), unknowns), right_.resize(offset_.size());
    for (std::size_t k = 0; k < offset_.size(); ++k) {
      const Vec2 d = white->of(offset_[k]);
      const double weight = 1 / std::max(norm(d), 1e-3);
      const double rise = field_.values[static_cast<std::size_t>(around_[k + 1])] - field_.values[at];
      const std::array<double, unknowns> row{d.x(), d.y(), d.x() * d.x() / 2, d.x() * d.y(), d.y() * d.y() / 2};
      for (std::size_t c = 0; c < unknowns; ++c) equations_.at(k, c) = weight * row[c];
      right_[k] = weight * rise;
    }
    if (!equations_.factorise(ColumnOrder::given, min_pivot)) return false;
    equations_.solve(right_);
    result.gradient = white->gradient(right_[0], right_[1]);
    result.hessian = white->hessian(right_[2], right_[3], right_[4]);
    return true;
  }

  const ScalarField& field_;
  const Neighbours& neighbours_;
  std::vector<std::int32_t> mark_, around_;
  std::vector<Vec2> offset_;
  LeastSquares equations_;
  std::vector<double> right_;
};

/// Gradient in (x, y) of the linear interpolation of `values` in a triangle, times its doubled area.
Vec2 gradient_times_area(const ScalarField& field, const std::array<std::int32_t, 3>& t, const auto& value_at,
                         double& doubled_area) {
  std::array<Vec2, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 q = field.vertices[static_cast<std::size_t>(t[i])];
    p[i] = {q.x(), q.y()};
  }
  doubled_area = std::abs(cross(p[1] - p[0], p[2] - p[0]));
  const double sign = cross(p[1] - p[0], p[2] - p[0]) < 0 ? -1 : 1;
  Vec2 sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 edge = p[(i + 2) % 3] - p[(i + 1) % 3];
    sum = sum + sign * value_at(static_cast<std::size_t>(t[i])) * Vec2{-edge.y(), edge.x()};
  }
  return sum;
}

std::vector<Vec2> projected_gradients(const ScalarField& field, const auto& value_at) {
  std::vector<Vec2> gradient(field.vertices.size());
  std::vector<double> weight(field.vertices.size(), 0);
  for (const auto& t : field.triangles) {
    double area = 0;
    const Vec2 g = gradient_times_area(field, t, value_at, area);
    for (const std::int32_t v : t) {
      gradient[static_cast<std::size_t>(v)] = gradient[static_cast<std::size_t>(v)] + g;
      weight[static_cast<std::size_t>(v)] += area;
    }
  }
  for (std::size_t v = 0; v < gradient.size(); ++v)
    if (weight[v] > 0) gradient[v] = (1 / weight[v]) * gradient[v];
  return gradient;
}

/// A row of numbers: gradient, Hessian, and a flag whether it is reliable. Each process has the frames.
constexpr std::size_t row_width = 6;

void put_row(const LocalDerivatives& d, double* row) {
  row[0] = d.gradient.x(), row[1] = d.gradient.y();
  row[2] = d.hessian.a, row[3] = d.hessian.b, row[4] = d.hessian.c;
  row[5] = d.reliable ? 1 : 0;
}

LocalDerivatives of_row(const VertexFrame& frame, const double* row) {
  return {frame, {row[0], row[1]}, {row[2], row[3], row[4]}, row[5] != 0};
}

void require_plane(const ScalarField& field, const char* sentence) {
  for (const Vec3& p : field.vertices)
    if (p.z() != field.vertices.front().z()) throw InvalidArgument(sentence);
}

Vec3 on_graph(const ScalarField& field, std::int32_t v) {
  const auto at = static_cast<std::size_t>(v);
  return {field.vertices[at].x(), field.vertices[at].y(), field.values[at]};
}

/// Upward normals of the graph at the vertices; 0 at vertices of no triangle.
std::vector<Vec3> graph_normals(const ScalarField& field) {
  std::vector<Vec3> normals(field.vertices.size(), Vec3(0, 0, 0));
  for (const auto& t : field.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = on_graph(field, t[k]);
      const Vec3 a = on_graph(field, t[(k + 1) % 3]) - p, b = on_graph(field, t[(k + 2) % 3]) - p;
      const Vec3 n = cross(a, b);
      const double size = norm(n);
      if (!(size > 0)) continue;
      const double angle = std::atan2(size, dot(a, b));
      normals[static_cast<std::size_t>(t[k])] += ((n.z() < 0 ? -angle : angle) / size) * n;
    }
  return normals;
}

/// The second fundamental form of the quadric at a vertex that is nearest to other vertices of the graph; empty if they
/// do not determine it.
std::optional<Metric2> quadric_through(const ScalarField& field, std::int32_t v, const std::vector<std::int32_t>& around,
                                       const VertexFrame& frame) {
  const std::size_t n = around.size();
  if (n < 3) return {};
  std::vector<Vec2> offsets;
  for (const std::int32_t w : around) offsets.push_back(frame.in_plane(on_graph(field, w) - on_graph(field, v)));
  const std::optional<Whitening> white = whitening(offsets);
  if (!white) return {};
  LeastSquares equations;
  equations.reset(n, 3);
  std::vector<double> right(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 d = white->of(offsets[k]);
    equations.at(k, 0) = d.x() * d.x() / 2, equations.at(k, 1) = d.x() * d.y(), equations.at(k, 2) = d.y() * d.y() / 2;
    right[k] = dot(on_graph(field, around[k]) - on_graph(field, v), frame.normal);
  }
  if (!equations.factorise(ColumnOrder::longest_first, min_quadric_pivot)) return {};
  equations.solve(right);
  return white->hessian(right[0], right[1], right[2]);
}

/// The Hessian in the plane of a graph whose second fundamental form is `bending` in the frame.
Metric2 hessian_of(const Metric2& bending, const VertexFrame& frame, const Vec2& gradient) {
  const Vec2 x = frame.in_plane({1, 0, gradient.x()}), y = frame.in_plane({0, 1, gradient.y()});
  const auto form = [&](const Vec2& p, const Vec2& q) {
    return bending.a * p.x() * q.x() + bending.b * (p.x() * q.y() + p.y() * q.x()) + bending.c * p.y() * q.y();
  };
  const double up = std::sqrt(1 + dot(gradient, gradient));
  return {up * form(x, x), up * form(x, y), up * form(y, y)};
}

}  // namespace

std::vector<LocalDerivatives> quadric_derivatives(const ScalarField& field) {
  check_field(field);
  require_plane(field, "quadrics on the graph of a field are for plane meshes only");
  const std::vector<Vec3> normals = graph_normals(field);
  const Neighbours neighbours = neighbours_of(field.vertices.size(), field.triangles);
  std::vector<LocalDerivatives> result(normals.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    LocalDerivatives& found = result[v];
    found.reliable = false;
    if (!(normals[v].z() > 0)) continue;
    const auto vertex = static_cast<std::int32_t>(v);
    const VertexFrame frame = frame_of(normals[v]);
    found.gradient = {-normals[v].x() / normals[v].z(), -normals[v].y() / normals[v].z()};
    const auto first = neighbours.of(vertex);
    std::vector<std::int32_t> around(first.begin(), first.end());
    std::optional<Metric2> bending = quadric_through(field, vertex, around, frame);
    if (!bending) {  // four neighbours in a cross, or a corner
      for (const std::int32_t w : first)
        for (const std::int32_t x : neighbours.of(w))
          if (x != vertex && std::find(around.begin(), around.end(), x) == around.end()) around.push_back(x);
      bending = quadric_through(field, vertex, around, frame);
    }
    if (!bending) continue;
    found.hessian = hessian_of(*bending, frame, found.gradient);
    found.reliable = true;
  }
  return result;
}

std::vector<LocalDerivatives> recover_derivatives(const ScalarField& field, const Executor& executor, Monitor* monitor) {
  check_field(field);
  const std::vector<VertexFrame> frames = frames_of(field);
  const Neighbours neighbours = neighbours_of(field.vertices.size(), field.triangles);
  const auto fit = [&](std::size_t first, std::size_t last, double* out, Monitor& of_task) {
    Fitter fitter(field, neighbours);
    for (std::size_t v = first; v < last; ++v, out += row_width) {
      if (v % work_sizes::evaluations == 0) of_task.checkpoint();
      put_row(fitter.fit(static_cast<std::int32_t>(v), frames[v]), out);
    }
  };
  Monitor silent;
  const std::vector<double> rows =
      shared_rows(executor, "derivatives of a field", {.count = frames.size(), .width = row_width, .at_once = work_sizes::piece_of(frames.size())}, fit,
                  monitor != nullptr ? *monitor : silent);
  std::vector<LocalDerivatives> result;
  result.reserve(frames.size());
  for (std::size_t v = 0; v < frames.size(); ++v) result.push_back(of_row(frames[v], rows.data() + row_width * v));
  return result;
}

std::vector<LocalDerivatives> project_derivatives(const ScalarField& field) {
  check_field(field);
  require_plane(field, "derivatives are projected on plane meshes only");
  const std::vector<Vec2> g = projected_gradients(field, [&](std::size_t v) { return field.values[v]; });
  const std::vector<Vec2> gx = projected_gradients(field, [&](std::size_t v) { return g[v].x(); });
  const std::vector<Vec2> gy = projected_gradients(field, [&](std::size_t v) { return g[v].y(); });
  std::vector<LocalDerivatives> result(g.size());
  for (std::size_t v = 0; v < g.size(); ++v) {
    result[v].gradient = g[v];
    result[v].hessian = {gx[v].x(), 0.5 * (gx[v].y() + gy[v].x()), gy[v].y()};
  }
  return result;
}

}  // namespace carreau
