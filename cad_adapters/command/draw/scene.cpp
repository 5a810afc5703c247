// SPDX-License-Identifier: BSD-3-Clause
#include "draw/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_set>

#include "check/mesh_report.h"
#include "check/triangle_shape.h"
#include "draw/colour_scale.h"
#include "draw/drawn_elements.h"
#include "draw/face_colours.h"

namespace command {
namespace {

/// Two lamps and some light from everywhere; both sides of a triangle are lit. `normal` is a unit vector in the frame
/// of the camera.
Colour shaded(Colour colour, Point normal) {
  if (normal[2] < 0) normal = {-normal[0], -normal[1], -normal[2]};
  static constexpr Point key{-0.42, 0.63, 0.653}, fill{0.78, -0.1, 0.618}, half{-0.231, 0.3465, 0.9092};
  const double k = std::max(0.0, dot(normal, key)), f = std::max(0.0, dot(normal, fill));
  const double light = 0.21 + 0.75 * k + 0.16 * f;
  const double shine = 0.10 * std::pow(std::max(0.0, dot(normal, half)), 40);
  for (float& c : colour) c = static_cast<float>(c * light + shine);
  return colour;
}

/// Lines fade where triangles are a few pixels wide, or a fine mesh would be black.
Line line_on(double pixels, bool curve, bool edges) {
  if (curve) return {0.95f, 0.95f};
  if (!edges) return {};
  return {0.42f, static_cast<float>(0.75 * std::clamp((pixels - 2) / 8, 0.0, 1.0))};
}

/// Too dark for dark lines and for shades.
bool is_dark(const Colour& colour) {
  constexpr float darkest = 0.03f;
  return 0.2126f * colour[0] + 0.7152f * colour[1] + 0.0722f * colour[2] < darkest;
}

using Edges = std::vector<std::array<std::int32_t, 2>>;

/// Edges that no triangle has, such as the domain of a face that failed, or curves of space, as narrow rectangles.
std::vector<ScreenTriangle> lines_of(const MeshArrays& mesh, const Edges& edges, const Projection& projection) {
  constexpr double half_width = 0.8;  // pixels
  const Colour dark = srgb(0x202830);
  std::vector<ScreenTriangle> triangles;
  for (const auto& [i, j] : edges) {
    const Point a = projection(mesh.vertices.at(i)), b = projection(mesh.vertices.at(j));
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (!(length > 0) || !std::isfinite(length)) continue;
    const double x = -(b[1] - a[1]) / length * half_width, y = (b[0] - a[0]) / length * half_width;
    const Point a1{a[0] + x, a[1] + y, a[2]}, a2{a[0] - x, a[1] - y, a[2]};
    const Point b1{b[0] + x, b[1] + y, b[2]}, b2{b[0] - x, b[1] - y, b[2]};
    triangles.push_back({{a1, a2, b2}, dark, {}, 0, false});
    triangles.push_back({{a1, b2, b1}, dark, {}, 0, false});
  }
  return triangles;
}

bool finite(const Point& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

/// From elements to triangles on the picture.
class Painter {
 public:
  /// Keeps references.
  Painter(const MeshArrays& mesh, const Projection& projection, const SceneOptions& options)
      : mesh_(mesh),
        projection_(projection),
        options_(options),
        curves_(sides_on_curves(mesh)),
        colours_(options.paint == Paint::reference ? colours_of_references(mesh) : colours_of_faces(mesh)),
        sizes_(mesh) {}

  void add(const Element& element, std::vector<ScreenTriangle>& triangles) const {
    std::array<Point, 8> x{};
    const int nodes = element.corners() * (element.is_curved() ? 2 : 1);
    for (int i = 0; i < nodes; ++i) {
      x[i] = mesh_.vertices.at(element.nodes[i]);
      if (!finite(x[i])) return;
    }
    Colour colour = colour_of(element, x);
    const bool dark = is_dark(colour);
    if (dark)
      for (float& c : colour) c += 0.02f;  // black has no shades
    std::array<Line, 4> lines;
    const double pixels = side_in_pixels(element, x);
    for (int k = 0; k < element.corners(); ++k)
      lines[k] = line_on(pixels, is_on_curve(element, k), options_.edges);
    for (const DrawnTriangle& piece : drawn(element, x)) add(piece, colour, lines, {element.ref, dark}, triangles);
  }

 private:
  struct Of {
    std::int32_t ref;
    bool dark;
  };

  [[nodiscard]] Colour colour_of(const Element& element, const std::array<Point, 8>& x) const {
    if (options_.paint == Paint::face || options_.paint == Paint::reference) return colours_.at(element.ref);
    if (options_.paint == Paint::size) return scale_colour(sizes_.share(x[0], x[1], x[2]));
    if (options_.paint != Paint::quality) return srgb(grey);
    return scale_colour(element.corners() == 4 ? shape_of_quad(x) : shape_quality(x[0], x[1], x[2]));
  }

  [[nodiscard]] bool is_on_curve(const Element& element, int k) const {
    return curves_.contains(side_key(element.nodes[k], element.nodes[(k + 1) % element.corners()]));
  }

  [[nodiscard]] double side_in_pixels(const Element& element, const std::array<Point, 8>& x) const {
    const int n = element.corners();
    double pixels = 0;
    for (int k = 0; k < n; ++k) {
      const Point a = projection_(x[k]), b = projection_(x[(k + 1) % n]);
      pixels += std::hypot(a[0] - b[0], a[1] - b[1]) / n;
    }
    return pixels;
  }

  void add(const DrawnTriangle& piece, const Colour& colour, const std::array<Line, 4>& lines, Of of,
           std::vector<ScreenTriangle>& triangles) const {
    const auto& p = piece.corners;
    const Point a = projection_.in_camera(p[0]);
    Point normal = cross(minus(projection_.in_camera(p[1]), a), minus(projection_.in_camera(p[2]), a));
    const double length = std::sqrt(dot(normal, normal));
    if (!(length > 0)) return;
    if (!std::all_of(p.begin(), p.end(), [&](const Point& each) { return projection_.is_before_eye(each); })) return;
    for (double& c : normal) c /= length;
    ScreenTriangle s{
        {projection_(p[0]), projection_(p[1]), projection_(p[2])}, shaded(colour, normal), {}, of.ref, of.dark};
    for (int k = 0; k < 3; ++k)  // side k is opposite to the corner before it
      if (piece.side[k] >= 0) s.lines[(k + 2) % 3] = lines[piece.side[k]];
    triangles.push_back(s);
  }

  const MeshArrays& mesh_;
  const Projection& projection_;
  const SceneOptions& options_;
  std::unordered_set<std::uint64_t> curves_;
  std::map<std::int32_t, Colour> colours_;
  SizeScale sizes_;
};

}  // namespace

Colour scale_colour(double x) { return srgb(scale_rgb(x)); }

SizeScale::SizeScale(const MeshArrays& mesh) {
  for (const auto& t : mesh.triangles) {
    const double size = size_of(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    if (!(size > 0) || !std::isfinite(size)) continue;
    smallest = largest > 0 ? std::min(smallest, size) : size;
    largest = std::max(largest, size);
  }
}

double SizeScale::share(const Point& a, const Point& b, const Point& c) const {
  const double size = size_of(a, b, c);
  if (!(size > 0) || !(largest > smallest)) return 0.5;
  return std::log(size / smallest) / std::log(largest / smallest);
}

namespace {

/// The content of the picture: the ends of the axes of a ball, or the mesh.
std::vector<Point> shown_points(const MeshArrays& mesh, const Edges& loose, const View& view,
                                const SceneOptions& options) {
  std::vector<Point> used;
  if (options.around) {
    const auto& [x, y, z, radius] = *options.around;
    for (const Point& axis : {view.right, view.up})
      for (const double sign : {-radius, radius})
        used.push_back({x + sign * axis[0], y + sign * axis[1], z + sign * axis[2]});
    return used;
  }
  for (const auto& t : mesh.triangles)
    for (const std::int32_t v : t)
      if (finite(mesh.vertices.at(v))) used.push_back(mesh.vertices[v]);
  for (const auto& edge : loose)
    for (const std::int32_t v : edge)
      if (finite(mesh.vertices.at(v))) used.push_back(mesh.vertices[v]);
  return used;
}

}  // namespace

std::vector<ScreenTriangle> project(const MeshArrays& mesh, const View& view, const SceneOptions& options, double x0,
                                    double y0, double width, double height) {
  const Edges loose = loose_edges(mesh);
  const Projection projection(view, shown_points(mesh, loose, view, options), x0, y0, width, height);
  const Painter painter(mesh, projection, options);
  std::vector<ScreenTriangle> triangles = lines_of(mesh, loose, projection);
  triangles.reserve(triangles.size() + mesh.triangles.size());
  for (const Element& element : mesh.elements) painter.add(element, triangles);
  if (mesh.elements.empty())
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Element element{.kind = CARREAU_CELL_TRIANGLE3, .ref = mesh.triangle_refs[i], .nodes = {}};
      std::copy(mesh.triangles[i].begin(), mesh.triangles[i].end(), element.nodes.begin());
      painter.add(element, triangles);
    }
  if (!options.metrics.empty()) add_ellipses(mesh, options.metrics, options.ellipse_scale, projection, triangles);
  return triangles;
}

}  // namespace command
