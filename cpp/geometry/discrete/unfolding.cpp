// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/unfolding.h"

#include <cmath>
#include <numeric>

namespace carreau::discrete {

namespace {


/// Edges around a vertex in one region, counterclockwise about the normal.
struct Fan {
  std::vector<std::int32_t> edges;
  bool closed = false;
};

class Unfolder {
 public:
  Unfolder(const Triangulation& mesh, const SharpLines& lines, const Frames& frames, std::vector<Cubic>& curves)
      : mesh_(mesh), lines_(lines), frames_(frames), curves_(curves) {}

  Unfolding run() {
    std::vector<char> met(3 * mesh_.triangles.size(), 0);
    for (std::size_t c = 0; c < met.size(); ++c) {
      if (met[c] != 0) continue;
      const auto t = static_cast<std::int32_t>(c / 3);
      const Fan fan = fan_of(t, static_cast<int>(c % 3), met);
      vertex_ = mesh_.corner(t, static_cast<int>(c % 3));
      normal_ = frames_.normal[c];
      if (folds(fan) == 0) continue;
      // Unfolding a window can uncover a further one.
      for (int round = 0; round < static_cast<int>(fan.edges.size()) && mend(fan); ++round) {
      }
      result_.folded += folds(fan);
    }
    return result_;
  }

 private:
  [[nodiscard]] bool is_sharp(std::int32_t t, int side) const { return lines_.sharp[index(mesh_.edge(t, side))] != 0; }

  Fan fan_of(std::int32_t t, int k, std::vector<char>& met) const {
    const std::int32_t first = t;
    for (;;) {  // back, over the side that starts at the vertex
      if (is_sharp(t, k)) break;
      const Side u = mesh_.beyond(t, k);
      t = u.triangle, k = (u.side + 1) % 3;
      if (t == first) break;
    }
    Fan fan;
    const std::int32_t begin = t;
    for (;;) {
      met[3 * index(t) + static_cast<std::size_t>(k)] = 1;
      fan.edges.push_back(mesh_.edge(t, k));
      const int last = (k + 2) % 3;
      if (is_sharp(t, last)) {
        fan.edges.push_back(mesh_.edge(t, last));
        return fan;
      }
      const Side u = mesh_.beyond(t, last);
      t = u.triangle, k = u.side;
      if (t == begin) {
        fan.closed = true;
        return fan;
      }
    }
  }

  [[nodiscard]] Vec3& control(std::int32_t e) const {
    Cubic& z = curves_[index(e)];
    return mesh_.edges[index(e)][0] == vertex_ ? z[1] : z[2];
  }
  [[nodiscard]] Vec3 tangent(std::int32_t e) const {
    const Vec3 d = control(e) - mesh_.at(vertex_);
    return d - dot(d, normal_) * normal_;
  }
  [[nodiscard]] double turn(std::int32_t e, std::int32_t f) const {
    const Vec3 p = tangent(e), q = tangent(f);
    return std::atan2(dot(cross(p, q), normal_), dot(p, q));
  }
  [[nodiscard]] std::vector<double> turns(const Fan& fan) const {
    std::vector<double> beta;
    const std::size_t n = fan.edges.size();
    for (std::size_t j = 0; j + (fan.closed ? 0 : 1) < n; ++j)
      beta.push_back(turn(fan.edges[j], fan.edges[(j + 1) % n]));
    return beta;
  }
  // Turns below 0.
  [[nodiscard]] std::int64_t folds(const Fan& fan) const {
    std::int64_t folded = 0;
    const std::size_t n = fan.edges.size();
    Vec3 p = tangent(fan.edges[0]);
    for (std::size_t j = 0; j + (fan.closed ? 0 : 1) < n; ++j) {
      const Vec3 q = tangent(fan.edges[(j + 1) % n]);
      folded += dot(cross(p, q), normal_) < 0 ? 1 : 0;
      p = q;
    }
    return folded;
  }

  /// Distributes the sum of the angles of a window in the ratio of their sizes. Returns false if nothing is folded, or
  /// the window cannot be unfolded.
  bool mend(const Fan& fan) {
    const std::vector<double> beta = turns(fan);
    const std::size_t n = beta.size();
    std::size_t first = 0;
    while (first < n && !(beta[first] < 0)) ++first;
    if (first == n) return false;
    double sum = beta[first];
    std::size_t count = 1;
    while (sum <= 0 && count < n && (fan.closed || first + count < n)) sum += beta[(first + count++) % n];
    while (sum <= 0 && count < n) {  // at an end, the window grows backwards
      first = (first + n - 1) % n;
      sum += beta[first], ++count;
    }
    if (sum <= 0) return false;
    double all = 0;
    for (std::size_t k = 0; k < count; ++k) all += std::abs(beta[(first + k) % n]);
    const Vec3 d = tangent(fan.edges[first]), u = d / norm(d), w = cross(normal_, u);
    double gamma = 0;
    for (std::size_t k = 0; k + 1 < count; ++k) {
      gamma += sum / all * std::abs(beta[(first + k) % n]);
      const std::int32_t e = fan.edges[(first + k + 1) % fan.edges.size()];
      const Vec3 p = mesh_.at(vertex_);
      const double length = norm(control(e) - p);
      control(e) = p + length * (std::cos(gamma) * u + std::sin(gamma) * w);
    }
    for (std::size_t k = 0; k < count; ++k) result_.unfolded += beta[(first + k) % n] < 0 ? 1 : 0;
    return true;
  }

  const Triangulation& mesh_;
  const SharpLines& lines_;
  const Frames& frames_;
  std::vector<Cubic>& curves_;
  std::int32_t vertex_ = -1;
  Vec3 normal_;
  Unfolding result_;
};

}  // namespace

Unfolding unfold(const Triangulation& mesh, const SharpLines& lines, const Frames& frames, std::vector<Cubic>& curves) {
  return Unfolder(mesh, lines, frames, curves).run();
}

}  // namespace carreau::discrete
