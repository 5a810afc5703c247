// SPDX-License-Identifier: BSD-3-Clause
#include "check/mesh_report.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "check/triangle_shape.h"

namespace command {
namespace {

Point middle(const Point& a, const Point& b) { return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}; }
double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
Point normal(const Point& a, const Point& b, const Point& c) {
  const Point p = minus(b, a), q = minus(c, a);
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// A side of a triangle.
struct Side {
  std::int32_t low = 0, high = 0;
  std::uint32_t triangle = 0;
  bool forward = false;  ///< the triangle runs from low to high

  bool operator<(const Side& other) const { return std::tie(high, triangle) < std::tie(other.high, other.triangle); }
};

template <typename Put>
void for_each_side(const MeshArrays& mesh, const Put& put) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = mesh.triangles[i][k], b = mesh.triangles[i][(k + 1) % 3];
      put(Side{std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(i), a < b});
    }
}

/// Calls visit(first, last) for the sides of each edge, ordered by its vertices; sides of an edge are sorted by
/// triangle. Each pass over the triangles takes some of the vertices: all sides together would take 48 bytes a
/// triangle.
template <typename Visit>
void for_each_edge(const MeshArrays& mesh, const Visit& visit) {
  constexpr std::size_t least = std::size_t{1} << 22, passes = 8;  // sides in memory, and parts of more than that
  const std::size_t vertices = mesh.vertices.size(), room = std::max(least, 3 * mesh.triangles.size() / passes);
  std::vector<std::uint32_t> count(vertices, 0);
  for_each_side(mesh, [&](const Side& side) { ++count[static_cast<std::size_t>(side.low)]; });
  std::vector<Side> sides;
  std::vector<std::size_t> next;  // of each vertex of a pass: the end of its sides so far
  for (std::size_t begin = 0, end = 0; begin < vertices; begin = end) {
    next.clear();
    std::size_t n = 0;
    for (end = begin; end < vertices && (end == begin || n + count[end] <= room); n += count[end++]) next.push_back(n);
    sides.resize(n);
    for_each_side(mesh, [&](const Side& side) {
      const auto v = static_cast<std::size_t>(side.low);
      if (v >= begin && v < end) sides[next[v - begin]++] = side;
    });
    for (std::size_t v = begin, i = 0; v < end; ++v) {
      const std::size_t last = next[v - begin];
      std::sort(sides.begin() + static_cast<std::ptrdiff_t>(i), sides.begin() + static_cast<std::ptrdiff_t>(last));
      for (std::size_t j = i; i < last; i = j) {
        while (j < last && sides[j].high == sides[i].high) ++j;
        visit(sides.data() + i, sides.data() + j);
      }
    }
  }
}

/// Sets that are merged, each with a flag against its representative.
class Components {
 public:
  explicit Components(std::size_t n) : parent_(n), turned_(n, 0) { std::iota(parent_.begin(), parent_.end(), 0u); }

  struct Root {
    std::uint32_t at;
    bool turned;
  };
  Root root(std::uint32_t i) {
    std::uint32_t top = i;
    bool turned = false;
    while (parent_[top] != top) turned ^= turned_[top] != 0, top = parent_[top];
    // Paths are made short on the way back.
    bool left = turned;
    while (parent_[i] != top && i != top) {
      const std::uint32_t next = parent_[i];
      const bool own = turned_[i] != 0;
      parent_[i] = top, turned_[i] = left ? 1 : 0;
      left ^= own, i = next;
    }
    return {top, turned};
  }
  /// `against`: a and b are turned against each other.
  void merge(std::uint32_t a, std::uint32_t b, bool against) {
    const Root p = root(a), q = root(b);
    if (p.at == q.at) return;
    parent_[q.at] = p.at;
    turned_[q.at] = (p.turned != q.turned) != against ? 1 : 0;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<char> turned_;
};

void add_place(std::vector<Point>& places, const Point& place, std::size_t listed) {
  if (places.size() < listed) places.push_back(place);
}

Point centre_of(const MeshArrays& mesh, std::size_t i) {
  const auto& t = mesh.triangles[i];
  Point centre{};
  for (int x = 0; x < 3; ++x)
    centre[x] = (mesh.vertices[t[0]][x] + mesh.vertices[t[1]][x] + mesh.vertices[t[2]][x]) / 3;
  return centre;
}

/// Q1 = 2 sqrt(3) inradius / longest side (HDR eq. 1.5).
double inscribed_quality(double area, const std::array<double, 3>& sides) {
  const double longest = std::max({sides[0], sides[1], sides[2]}), around = sides[0] + sides[1] + sides[2];
  return longest > 0 ? 4 * std::sqrt(3.0) * area / (around * longest) : 0;
}

/// The lowest few of many.
class Lowest {
 public:
  using Ranked = std::pair<double, std::uint32_t>;
  explicit Lowest(std::size_t few) : few_(few) {}

  void add(const Ranked& one) {
    if (kept_.size() == few_ && (few_ == 0 || !(one < kept_.front()))) return;
    kept_.push_back(one);
    std::push_heap(kept_.begin(), kept_.end());
    if (kept_.size() <= few_) return;
    std::pop_heap(kept_.begin(), kept_.end());
    kept_.pop_back();
  }
  /// Lowest first.
  std::vector<Ranked> take() {
    std::sort_heap(kept_.begin(), kept_.end());
    return std::move(kept_);
  }

 private:
  std::size_t few_;
  std::vector<Ranked> kept_;  // a heap: the highest first
};

void measure_shapes(const MeshArrays& mesh, std::size_t worst, MeshReport& report) {
  std::map<std::int32_t, FaceFigures> faces;
  Lowest lowest(worst);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const Point &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Point n = normal(a, b, c);
    const double area = std::sqrt(dot(n, n)) / 2, q2 = shape_quality(a, b, c);
    const std::array<double, 3> sides{distance(a, b), distance(b, c), distance(c, a)};
    const auto count = [](auto& histogram, double q) {
      ++histogram[static_cast<std::size_t>(std::clamp(static_cast<int>(q * quality_classes), 0, quality_classes - 1))];
    };
    count(report.q1, inscribed_quality(area, sides));
    count(report.q2, q2);
    lowest.add({q2, static_cast<std::uint32_t>(i)});
    FaceFigures& face = faces[mesh.triangle_refs[i]];
    if (face.triangles++ == 0) face.edge_min = sides[0];
    face.area += area, face.q2_mean += q2, face.q2_min = std::min(face.q2_min, q2);
    for (const double side : sides) {
      face.edge_min = std::min(face.edge_min, side), face.edge_max = std::max(face.edge_max, side);
      face.edge_mean += side / 3;
    }
  }
  for (auto& [ref, face] : faces) {
    face.ref = ref;
    face.q2_mean /= static_cast<double>(face.triangles), face.edge_mean /= static_cast<double>(face.triangles);
    report.faces.push_back(face);
  }
  std::map<std::int32_t, std::string> names;
  for (const FaceResult& face : mesh.faces) names.emplace(face.ref, face.name);
  for (FaceFigures& face : report.faces) face.name = names[face.ref];
  for (const auto& [quality, i] : lowest.take())
    report.worst.push_back({i, mesh.triangle_refs[i], quality, centre_of(mesh, i)});
}

/// Chains of edges with one triangle, by the vertices that they share.
void find_borders(const MeshArrays& mesh, const std::vector<std::array<std::int32_t, 2>>& open, MeshReport& report) {
  std::map<std::int32_t, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < open.size(); ++i)
    for (const std::int32_t v : open[i]) at[v].push_back(i);
  std::vector<char> seen(open.size(), 0);
  for (std::size_t start = 0; start < open.size(); ++start) {
    if (seen[start] != 0) continue;
    Border border{.closed = true, .place = mesh.vertices[open[start][0]]};
    std::vector<std::size_t> waiting{start};
    seen[start] = 1;
    while (!waiting.empty()) {
      const std::size_t i = waiting.back();
      waiting.pop_back();
      ++border.edges;
      border.length += distance(mesh.vertices[open[i][0]], mesh.vertices[open[i][1]]);
      for (const std::int32_t v : open[i]) {
        const auto& beside = at[v];
        border.closed = border.closed && beside.size() % 2 == 0;
        for (const std::size_t j : beside)
          if (seen[j] == 0) seen[j] = 1, waiting.push_back(j);
      }
    }
    report.borders.push_back(border);
  }
  std::stable_sort(report.borders.begin(), report.borders.end(),
                   [](const Border& p, const Border& q) { return p.length > q.length; });
}

/// Fewer of a part's triangles are turned than not: which way is right cannot be known.
void find_turned(const MeshArrays& mesh, Components& components, std::size_t listed, MeshReport& report) {
  std::map<std::uint32_t, std::array<std::int64_t, 2>> count;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto root = components.root(static_cast<std::uint32_t>(i));
    ++count[root.at][root.turned ? 1 : 0];
  }
  report.parts = static_cast<std::int64_t>(count.size());
  for (const auto& [root, n] : count) report.turned_triangles += std::min(n[0], n[1]);
  if (report.turned_triangles == 0) return;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto root = components.root(static_cast<std::uint32_t>(i));
    const auto& n = count[root.at];
    const bool fewer_are_turned = n[1] <= n[0];
    if (std::min(n[0], n[1]) > 0 && root.turned == fewer_are_turned)
      add_place(report.turned_at, centre_of(mesh, i), listed);
  }
}

bool folds(const MeshArrays& mesh, const Side& p, const Side& q) {
  if (p.forward == q.forward || mesh.triangle_refs[p.triangle] != mesh.triangle_refs[q.triangle]) return false;
  const auto normal_of = [&](std::uint32_t i) {
    const auto& t = mesh.triangles[i];
    return normal(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
  };
  const Point m = normal_of(p.triangle), n = normal_of(q.triangle);
  static const double cosine = -std::cos(std::acos(-1.0) / 6);  // of 150 degrees
  return dot(m, n) < cosine * std::sqrt(dot(m, m) * dot(n, n));
}

void look_at_edges(const MeshArrays& mesh, std::size_t listed, MeshReport& report) {
  Components components(mesh.triangles.size());
  std::vector<std::array<std::int32_t, 2>> open;
  for_each_edge(mesh, [&](const Side* first, const Side* last) {
    ++report.edges;
    const Point place = middle(mesh.vertices[first->low], mesh.vertices[first->high]);
    if (last - first == 1) open.push_back({first->low, first->high});
    if (last - first > 2) ++report.shared_edges, add_place(report.shared_at, place, listed);
    if (last - first != 2) return;
    components.merge(first[0].triangle, first[1].triangle, first[0].forward == first[1].forward);
    if (folds(mesh, first[0], first[1])) ++report.folds, add_place(report.fold_at, place, listed);
  });
  report.open_edges = static_cast<std::int64_t>(open.size());
  report.loose_edges = std::ssize(loose_edges(mesh));
  find_borders(mesh, open, report);
  find_turned(mesh, components, listed, report);
}

/// Vertices at the place of an earlier one. They are sorted along one axis after the other, and divided where the next
/// is farther than the tolerance. This ends when they lie together along all three axes: most are alone after the
/// first.
class DoublePoints {
 public:
  DoublePoints(const std::vector<Point>& points, double tolerance) : points_(points), tolerance_(tolerance) {}

  /// The median of the vertices in `of`, whose order is lost. Ascending.
  std::vector<std::uint32_t> find(std::vector<std::uint32_t>& of) {
    part(of.data(), of.data() + of.size(), 0, 0);
    std::sort(found_.begin(), found_.end());
    return std::move(found_);
  }

 private:
  // `whole`: axes in a row along which nothing was parted.
  void part(std::uint32_t* first, std::uint32_t* last, std::size_t axis, int whole) {
    if (last - first < 2) return;
    if (whole == 3) return compare(first, last);
    std::sort(first, last, [&](std::uint32_t p, std::uint32_t q) { return points_[p][axis] < points_[q][axis]; });
    for (std::uint32_t *from = first, *to = first; from != last; from = to) {
      while (++to != last && points_[*to][axis] - points_[to[-1]][axis] <= tolerance_) {
      }
      part(from, to, (axis + 1) % 3, from == first && to == last ? whole + 1 : 1);
    }
  }
  void compare(std::uint32_t* first, std::uint32_t* last) {
    std::sort(first, last);
    for (const std::uint32_t* v = first + 1; v < last; ++v)
      if (std::any_of(static_cast<const std::uint32_t*>(first), v,
                      [&](std::uint32_t u) { return distance(points_[u], points_[*v]) <= tolerance_; }))
        found_.push_back(*v);
  }

  const std::vector<Point>& points_;
  double tolerance_;
  std::vector<std::uint32_t> found_;
};

void look_at_vertices(const MeshArrays& mesh, std::size_t listed, MeshReport& report) {
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles)
    for (const std::int32_t v : t) used[v] = 1;
  Point low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  std::int64_t count = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (used[v] == 0) continue;
    ++count;
    for (int x = 0; x < 3; ++x)
      low[x] = std::min(low[x], mesh.vertices[v][x]), high[x] = std::max(high[x], mesh.vertices[v][x]);
  }
  report.euler = count - report.edges + static_cast<std::int64_t>(mesh.triangles.size());
  if (count == 0) return;
  std::vector<std::uint32_t> vertices;
  vertices.reserve(static_cast<std::size_t>(count));
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v] != 0) vertices.push_back(static_cast<std::uint32_t>(v));
  for (const std::uint32_t v : DoublePoints(mesh.vertices, 1e-9 * distance(low, high)).find(vertices))
    ++report.double_points, add_place(report.double_at, mesh.vertices[v], listed);
}

}  // namespace

std::vector<std::array<std::int32_t, 2>> loose_edges(const MeshArrays& mesh) {
  using Edge = std::array<std::int32_t, 2>;
  const auto ordered = [](std::int32_t a, std::int32_t b) { return Edge{std::min(a, b), std::max(a, b)}; };
  std::vector<Edge> edges;  // few beside the triangles
  for (const Edge& edge : mesh.edges) edges.push_back(ordered(edge[0], edge[1]));
  std::sort(edges.begin(), edges.end());
  std::vector<char> has_triangle(edges.size(), 0);
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [first, last] = std::equal_range(edges.begin(), edges.end(), ordered(t[k], t[(k + 1) % 3]));
      std::fill(has_triangle.begin() + (first - edges.begin()), has_triangle.begin() + (last - edges.begin()), 1);
    }
  std::vector<Edge> loose;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (has_triangle[e] == 0) loose.push_back(edges[e]);
  return loose;
}

MeshReport report_of(const MeshArrays& mesh, std::size_t worst, std::size_t listed) {
  MeshReport report;
  measure_shapes(mesh, worst, report);
  look_at_edges(mesh, listed, report);
  look_at_vertices(mesh, listed, report);
  return report;
}

}  // namespace command
