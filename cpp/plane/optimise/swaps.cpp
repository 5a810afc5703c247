// Swaps over the whole mesh: to the Delaunay criterion in the metric, and towards degree six.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "metric/field_length.h"
#include "plane/kernel/metric_delaunay.h"
#include "plane/optimise/optimiser.h"

namespace carreau::plane {

namespace {

constexpr int passes = 10;
constexpr std::int32_t triangles_at_once = 256;
constexpr int triangles_between_checks = 1 << 16;
constexpr int edges_between_checks = 256;
// Nearly cocircular vertices keep their diagonal.
constexpr double cocircular = 1e-9;
// A swap for the sake of degrees leaves no triangle worse than this.
constexpr double swap_quality = 0.6;
constexpr int degree_passes = 2;
// Units, and shortest edges of the triangle: longer than any edge that points a unit apart leave.
constexpr double long_edge = 3;

}  // namespace

namespace {

// Opposite angles, at c and d, that sum to more than pi: their sines are areas over lengths.
bool sum_exceeds_pi(double dot_c, double area_c, double dot_d, double area_d) noexcept {
  const double s = dot_c * area_d + dot_d * area_c, scale = std::abs(dot_c) * area_d + std::abs(dot_d) * area_c;
  return s < -cocircular * scale;
}

}  // namespace

// By Simpson's rule: on an edge of several units sizes may change manifold, as beside a waist.
double Optimiser::squared_length_along(int u, int v) const {
  const Vertex &U = mesh_.vertices[u], &V = mesh_.vertices[v];
  const Vec2 d = V.point() - U.point();
  const double sum =
      length(U.metric(), d) + 4 * length(field_.at(0.5 * (U.point() + V.point())), d) + length(V.metric(), d);
  return sum * sum / 36;
}

// Cosines by the lengths of the edges. What is long is swapped if that makes it shorter: over more than about two units
// straight lines say little.
bool Optimiser::wants_bent_swap(int a, int b, int c, int d) const {
  const double ab = shapes_.squared_length(a, b);
  if (ab > longest_bent2) return squared_length_along(c, d) < squared_length_along(a, b) * (1 - cocircular);
  const Lengths abc{shapes_.squared_length(b, c), shapes_.squared_length(c, a), ab},
      abd{shapes_.squared_length(b, d), shapes_.squared_length(d, a), ab};
  return sum_exceeds_pi(abc.a + abc.b - ab, std::sqrt(abc.area2()), abd.a + abd.b - ab, std::sqrt(abd.area2()));
}

// Delaunay in the mean metric of the four vertices, or by lengths where the field bends.
bool Optimiser::wants_swap(int t, int i) const {
  const Triangle& A = mesh_.triangles[t];
  const HalfEdge o = A.n[i];
  if (o == no_edge || (A.imposed >> i & 1) != 0) return false;
  const Triangle& B = mesh_.triangles[o >> 2];
  const Vertex &c = mesh_.vertices[A.v[i]], &a = mesh_.vertices[A.v[next3[i]]], &b = mesh_.vertices[A.v[prev3[i]]],
               &d = mesh_.vertices[B.v[o & 3]];
  if (shapes_.is_bent(A) || shapes_.is_bent(B))
    return wants_bent_swap(A.v[next3[i]], A.v[prev3[i]], A.v[i], B.v[o & 3]) && mesh_.can_swap(t, i);
  const Metric2 m = a.metric() + b.metric() + c.metric() + d.metric();
  const Vec2 ca = a.point() - c.point(), cb = b.point() - c.point(), da = a.point() - d.point(),
             db = b.point() - d.point();
  return sum_exceeds_pi(dot(m, ca, cb), cross(ca, cb), dot(m, da, db), cross(db, da)) && mesh_.can_swap(t, i);
}

// Half-edges of the triangles from `first` to before `end` whose neighbour has a larger number, without a branch that a
// processor could not predict.
void Optimiser::collect_edges(std::int32_t first, std::int32_t end) {
  edges_.resize(static_cast<std::size_t>(3) * triangles_at_once);
  HalfEdge* to = edges_.data();
  for (std::int32_t t = first; t < end; ++t) {
    const Triangle& T = mesh_.triangles[t];
    for (int i = 0; i < 3; ++i) {
      *to = 4 * t + i;
      to += (T.n[i] >> 2) > t ? 1 : 0;
    }
  }
  edges_.resize(static_cast<std::size_t>(to - edges_.data()));
}

inline void Optimiser::prefetch_beyond(std::size_t k) const {
  constexpr std::size_t far = 24, near = 12;
  if (k + far < edges_.size()) {
    const HalfEdge he = edges_[k + far];
    const Triangle& T = mesh_.triangles[he >> 2];
    prefetch(&mesh_.triangles[T.n[he & 3] >> 2]);
    for (const std::int32_t v : T.v) prefetch(&mesh_.vertices[v]);
  }
  if (k + near < edges_.size()) {
    const HalfEdge o = mesh_.triangles[edges_[k + near] >> 2].n[edges_[k + near] & 3];
    if (o >= 0) prefetch(&mesh_.vertices[mesh_.triangles[o >> 2].v[o & 3]]);
  }
}

void Optimiser::swap_to_delaunay() {
  const auto total = static_cast<std::int32_t>(mesh_.triangles.size());
  work_.clear();
  for (std::int32_t first = 0; first < total; first += triangles_at_once) {
    if (first % triangles_between_checks == 0) monitor_.checkpoint();
    collect_edges(first, std::min(total, first + triangles_at_once));
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      const HalfEdge he = edges_[k];
      prefetch_beyond(k);
      const int t = he >> 2, i = he & 3;
      if (!wants_swap(t, i)) continue;
      work_.push_back(t);
      work_.push_back(mesh_.triangles[t].n[i] >> 2);
      mesh_.swap_edge(t, i);
    }
  }
  // A bounded number of passes: in a metric that varies swaps can run in circles. Then both triangles of each swap come
  // back, and the list doubles with each pass.
  const std::size_t most_work = 2 * static_cast<std::size_t>(total);
  for (int pass = 0; pass < passes && !work_.empty() && work_.size() <= most_work; ++pass) {
    monitor_.checkpoint();
    next_.clear();
    for (const std::int32_t t : work_)
      for (int i = 0; i < 3; ++i) {
        if (!wants_swap(t, i)) continue;
        next_.push_back(t);
        next_.push_back(mesh_.triangles[t].n[i] >> 2);
        mesh_.swap_edge(t, i);
        break;
      }
    work_.swap(next_);
  }
  // The two sides of a long strip that are fans of hundreds of triangles in the frame take as many passes. Where no
  // edge is long, swaps run in circles between triangles that are as good as each other.
  if (!mesh_.bends.empty()) return;
  std::erase_if(work_, [this](std::int32_t t) { return !has_long_edge(mesh_.triangles[t]); });
  shorten_long_edges();
  make_delaunay_in_metric(mesh_, work_, monitor_);
}

// Where hundreds of edges lean over dozens of units one swap gains less than the metrics of neighbouring triangles
// differ by, and angles taken in these do not tell which diagonal is better; lengths measured along them do. Their sum
// falls, so that there is an end. Starts with the triangles of `work_`, and adds those that it has changed.
void Optimiser::shorten_long_edges() {
  const auto length_along = [this](int p, int q) {
    return field_length([this](Vec2 at) { return field_.at(at); }, mesh_.at(p), mesh_.at(q));
  };
  std::vector<HalfEdge>& open = edges_;
  open.clear();
  for (const std::int32_t t : work_)
    for (int i = 0; i < 3; ++i) open.push_back(4 * t + i);
  const std::size_t seeds = work_.size();
  long measured = 0;
  while (!open.empty()) {
    const int t = open.back() >> 2, i = open.back() & 3;
    open.pop_back();
    const Triangle& A = mesh_.triangles[t];
    if (A.n[i] == no_edge || mesh_.is_imposed(t, i)) continue;
    const int u = A.n[i] >> 2, c = A.v[i], a = A.v[next3[i]], b = A.v[prev3[i]], d = mesh_.triangles[u].v[A.n[i] & 3];
    if (!(mesh_.squared_length(a, b) > long_edge * long_edge) || !mesh_.can_swap(t, i)) continue;
    if (++measured % edges_between_checks == 0) monitor_.checkpoint();
    if (!(length_along(c, d) < (1 - cocircular) * length_along(a, b))) continue;
    mesh_.swap_edge(t, i);
    work_.insert(work_.end(), {t, u});
    open.insert(open.end(), {4 * t, 4 * t + 2, 4 * u, 4 * u + 1});
  }
  if (work_.size() == seeds) return;
  std::sort(work_.begin(), work_.end());
  work_.erase(std::unique(work_.begin(), work_.end()), work_.end());
}

// Beside a fine border sizes may be longer than a strip is wide: there edges are long that are none of three units.
bool Optimiser::has_long_edge(const Triangle& T) const {
  double shortest2 = 1, longest2 = 0;
  for (int i = 0; i < 3; ++i) {
    const double l2 = mesh_.squared_length(T.v[i], T.v[next3[i]]);
    shortest2 = std::min(shortest2, l2), longest2 = std::max(longest2, l2);
  }
  return longest2 > long_edge * long_edge * shortest2;
}

// Degrees are counted in triangles. On the border a vertex of angle w wants w / 60 degrees of them.
void Optimiser::count_degrees() {
  degree_.assign(mesh_.vertices.size(), 0);
  wanted_degree_.assign(mesh_.vertices.size(), 6);
  std::vector<float> angle(fixed_, 0);
  std::vector<std::uint8_t> open(fixed_, 0);
  for (const Triangle& T : mesh_.triangles)
    for (int i = 0; i < 3; ++i) {
      const int v = T.v[i];
      if (degree_[v] < 255) ++degree_[v];
      if (T.n[i] == no_edge) open[T.v[next3[i]]] = open[T.v[prev3[i]]] = 1;
      if (v >= fixed_) continue;
      const Vec2 p = mesh_.at(v), u = mesh_.at(T.v[next3[i]]) - p, w = mesh_.at(T.v[prev3[i]]) - p;
      const Metric2 m = mesh_.vertices[v].metric();
      angle[v] += static_cast<float>(std::atan2(std::sqrt(std::max(determinant(m), 0.0)) * cross(u, w), dot(m, u, w)));
    }
  for (int v = 0; v < fixed_; ++v)
    if (open[v] != 0)
      wanted_degree_[v] = static_cast<std::uint8_t>(std::max(1.0, std::floor(angle[v] / (std::numbers::pi / 3) + 0.5)));
}

void Optimiser::swap_to_degree_six() {
  count_degrees();
  for (int pass = 0; pass < degree_passes; ++pass) {
    bool any = false;
    const auto total = static_cast<std::int32_t>(mesh_.triangles.size());
    for (std::int32_t first = 0; first < total; first += triangles_at_once) {
      if (first % triangles_between_checks == 0) monitor_.checkpoint();
      collect_edges(first, std::min(total, first + triangles_at_once));
      for (std::size_t k = 0; k < edges_.size(); ++k) {
        const HalfEdge he = edges_[k];
        prefetch_beyond(k);
        const int t = he >> 2, i = he & 3;
        const Triangle& A = mesh_.triangles[t];
        const HalfEdge o = A.n[i];
        if (o == no_edge) continue;
        const int c = A.v[i], a = A.v[next3[i]], b = A.v[prev3[i]], d = mesh_.triangles[o >> 2].v[o & 3];
        // The sum of squares of the excesses changes by 2 (ec + ed - ea - eb) + 4.
        if (excess(c) + excess(d) - excess(a) - excess(b) + 2 >= 0 || (A.imposed >> i & 1) != 0) continue;
        if (shapes_.quality(c, a, d) <= swap_quality || shapes_.quality(c, d, b) <= swap_quality) continue;
        mesh_.swap_edge(t, i);
        --degree_[a], --degree_[b], ++degree_[c], ++degree_[d];
        any = true;
      }
    }
    if (!any) break;
  }
}

}  // namespace carreau::plane
