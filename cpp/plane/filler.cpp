#include "plane/filler.h"

#include <algorithm>
#include <cmath>

#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

constexpr double done_radius = 0.70;     // circumradius of a triangle that is small enough (equilateral: 0.577)
constexpr double row_distance = 0.75;    // least distance of a row's point to other vertices
constexpr double imposed_height = 0.40;  // least height over an imposed edge
constexpr double degenerate_height = 0.70;
constexpr double leftover_radius = 0.88;
constexpr double merge_gap = 0.55, extend_gap = 1.5, widest_gap = 2.6;
constexpr double shortest_in_strain = 0.6;
constexpr int strain_window = 5;
constexpr int first_stride = 64;
constexpr int insertions_between_checks = 4096;

}  // namespace

Filler::Filler(Triangulation& mesh, const ControlSpace& space, std::int64_t max_triangles, Monitor& monitor)
    : mesh_(mesh),
      space_(space),
      max_triangles_(max_triangles),
      monitor_(monitor),
      strain_limit_(space.measure() < 10000 ? 0.9 : 1.3) {
  const double expected =
      std::min(1.1 * space.measure() + static_cast<double>(mesh.triangles.size()), static_cast<double>(max_triangles));
  mesh_.triangles.reserve(static_cast<std::size_t>(expected) + 1000);
  mesh_.vertices.reserve(static_cast<std::size_t>(expected / 2) + 1000);
}

void Filler::check_limit() {
  if (++work_ % insertions_between_checks == 0) monitor_.checkpoint();
  if (static_cast<std::int64_t>(mesh_.triangles.size()) > max_triangles_)
    throw LimitError("the mesh has reached the limit of " + std::to_string(max_triangles_) +
                     " triangles (parameter max_triangles)");
}

void Filler::judge(int t) {
  Triangle& T = mesh_.triangles[t];
  const double r2 = mesh_.squared_radius(t);
  T.radius2 = static_cast<float>(r2);
  T.done = r2 < done_radius * done_radius ? 1 : 0;
}

bool Filler::try_insert(Vec2 uv, Metric2 metric, int start, double distance, double height) {
  check_limit();
  const InsertRules rules{distance * distance, height, degenerate_height};
  if (!mesh_.insert(uv, metric, start, rules)) return false;
  for (const std::int32_t t : mesh_.star()) {
    judge(t);
    touched_.push_back(t);
  }
  return true;
}

// --- rows ---------------------------------------------------------------------------------------------------------

void Filler::add_front_edge(HalfEdge he) {
  const Triangle& T = mesh_.triangles[he >> 2];
  const int i = he & 3;
  if ((T.degenerate >> i & 1) != 0) return;  // one point in space: no row starts there
  const std::int32_t a = T.v[next3[i]], b = T.v[prev3[i]];
  if (leaving_[a] >= 0 && front_[leaving_[a]].b == b) return;
  const auto id = static_cast<std::int32_t>(front_.size());
  front_.push_back({he, a, b});
  if (leaving_[a] < 0) leaving_[a] = id;
  if (arriving_[b] < 0) arriving_[b] = id;
}

void Filler::find_front(bool first) {
  for (const FrontEdge& e : front_) leaving_[e.a] = arriving_[e.b] = -1;
  front_.clear();
  leaving_.resize(mesh_.vertices.size(), -1);
  arriving_.resize(mesh_.vertices.size(), -1);
  const auto visit = [&](int t) {
    const Triangle& T = mesh_.triangles[t];
    for (int i = 0; i < 3; ++i) {
      const HalfEdge other = T.n[i];
      const bool imposed = (T.imposed >> i & 1) != 0;
      if (T.done == 0) {
        if (other == no_edge || imposed || mesh_.triangles[other >> 2].done != 0) add_front_edge(4 * t + i);
      } else if (other != no_edge && mesh_.triangles[other >> 2].done == 0) {
        add_front_edge(other);
      }
    }
  };
  if (first) {
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) visit(t);
  } else {
    for (const std::int32_t t : touched_) {
      if (mesh_.triangles[t].mark != 0) continue;
      mesh_.triangles[t].mark = 1;
      visit(t);
    }
    for (const std::int32_t t : touched_) mesh_.triangles[t].mark = 0;
  }
  touched_.clear();
  for (FrontEdge& e : front_) e.next = leaving_[e.b];
}

Vec2 Filler::apex(const FrontEdge& edge) const {
  const Vertex &A = mesh_.vertices[edge.a], &B = mesh_.vertices[edge.b];
  const double ex = B.x - A.x, ey = B.y - A.y;
  const Vec2 middle{0.5 * (A.x + B.x), 0.5 * (A.y + B.y)};
  const auto place = [&](Metric2 m) {
    const double l2 = m.a * ex * ex + 2 * m.b * ex * ey + m.c * ey * ey;
    // Both new edges have unit length, unless the base is so long that the apex would fall flat.
    const double height = std::sqrt(std::max(1 - 0.25 * l2, 0.3));
    const double k = height / std::sqrt(determinant(m) * l2);
    return Vec2{middle.x - k * (m.b * ex + m.c * ey), middle.y + k * (m.a * ex + m.b * ey)};
  };
  const Metric2 at_ends = 0.5 * (A.metric() + B.metric());
  const Vec2 guess = place(at_ends);
  return place(0.5 * (at_ends + space_.at(guess)));
}

double Filler::distance(const Candidate& p, const Candidate& q) const {
  return length(space_.at(0.5 * (p.uv + q.uv)), q.uv - p.uv);
}

void Filler::chain_up() {
  row_.clear();
  for (int pass = 0; pass < 2; ++pass)  // open chains first, then closed ones
    for (std::size_t k = 0; k < front_.size(); ++k) {
      if (front_[k].chained || (pass == 0 && arriving_[front_[k].a] >= 0)) continue;
      chain_.clear();
      for (auto id = static_cast<std::int32_t>(k); id >= 0 && !front_[id].chained; id = front_[id].next) {
        front_[id].chained = true;
        chain_.push_back({apex(front_[id]), front_[id].edge, front_[id].a});
      }
      respace();
    }
}

void Filler::merge_and_extend() {
  spaced_.clear();
  for (std::size_t i = 0; i < chain_.size(); ++i) {
    spaced_.push_back(chain_[i]);
    if (i + 1 == chain_.size()) break;
    const double gap = distance(chain_[i], chain_[i + 1]);
    const Vec2 middle = 0.5 * (chain_[i].uv + chain_[i + 1].uv);
    if (gap < merge_gap) {
      spaced_.back().uv = middle;
      ++i;
    } else if (gap > extend_gap && gap < widest_gap) {
      spaced_.push_back({middle, chain_[i].edge, chain_[i].a});
    }
  }
  chain_.swap(spaced_);
}

// A row keeps the number of points of the one before; where the metric wants more or fewer, the misfit is summed up
// along the row, and when it makes a whole edge the last few intervals share one point more or less.
void Filler::respace() {
  if (chain_.size() >= 3) merge_and_extend();
  const int n = static_cast<int>(chain_.size());
  if (n < 3) {
    row_.insert(row_.end(), chain_.begin(), chain_.end());
    return;
  }
  gaps_.resize(chain_.size());
  for (int i = 0; i + 1 < n; ++i) gaps_[i] = distance(chain_[i], chain_[i + 1]);
  double strain = 0;
  int sent = 0;  // candidates before this one are in the row
  for (int i = 0; i + 1 < n; ++i) {
    if (gaps_[i] > extend_gap || gaps_[i] < shortest_in_strain) {
      strain = 0;
      while (sent <= i) row_.push_back(chain_[sent++]);
      continue;
    }
    strain += gaps_[i] - 1;
    if (std::abs(strain) <= strain_limit_) continue;
    const int low = std::max(sent, i - 2 * strain_window + 1), high = i + 1, intervals = high - low;
    if (intervals < 3) continue;
    const int wanted = intervals + (strain > 0 ? 1 : -1);
    while (sent <= low) row_.push_back(chain_[sent++]);
    double total = 0;
    for (int k = low; k < high; ++k) total += gaps_[k];
    int k = low;
    double before = 0;
    for (int q = 1; q < wanted; ++q) {
      const double target = total * q / wanted;
      while (k + 1 < high && before + gaps_[k] < target) before += gaps_[k++];
      const double w = (target - before) / gaps_[k];
      const Candidate& near = w < 0.5 ? chain_[k] : chain_[k + 1];
      row_.push_back({lerp(chain_[k].uv, chain_[k + 1].uv, w), near.edge, near.a});
    }
    sent = high;
    strain -= strain > 0 ? 1 : -1;
  }
  while (sent < n) row_.push_back(chain_[sent++]);
}

int Filler::start_of(const Candidate& candidate) const {
  const int t = candidate.edge >> 2, i = candidate.edge & 3;
  return mesh_.triangles[t].v[next3[i]] == candidate.a ? t : mesh_.vertices[candidate.a].triangle;
}

// In strides, coarse ones first: one after the other along a curved front, each point would swallow the fan of all
// before it.
void Filler::insert_row() {
  const auto n = static_cast<int>(row_.size());
  for (int stride = first_stride; stride >= 1; stride /= 2) {
    const int step = stride == first_stride ? stride : 2 * stride;
    for (int k = stride == first_stride ? 0 : stride; k < n; k += step) {
      const int t = mesh_.locate(row_[k].uv, start_of(row_[k]));
      if (t >= 0) try_insert(row_[k].uv, space_.at(row_[k].uv), t, row_distance, imposed_height);
    }
  }
}

void Filler::march() {
  for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) judge(t);
  find_front(true);
  while (!front_.empty()) {
    monitor_.checkpoint();
    chain_up();
    insert_row();
    find_front(false);
  }
  fill_leftovers(leftover_radius, 0.7);
  fill_leftovers(leftover_radius, 0.6);
}

// --- leftovers ----------------------------------------------------------------------------------------------------

void Filler::fill_leftovers(double radius, double distance) {
  const double radius2 = radius * radius;
  for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t)
    for (int attempt = 0; attempt < 4; ++attempt) {
      if (!(mesh_.squared_radius(t) > radius2)) break;
      const Triangle& T = mesh_.triangles[t];
      const Vertex &A = mesh_.vertices[T.v[0]], &B = mesh_.vertices[T.v[1]], &C = mesh_.vertices[T.v[2]];
      const Metric2 m = (1.0 / 3) * (A.metric() + B.metric() + C.metric());
      const Vec2 u = B.point() - A.point(), v = C.point() - A.point();
      const double uu = dot(m, u, u), vv = dot(m, v, v), uv = dot(m, u, v), det = 2 * (uu * vv - uv * uv);
      if (!(det > 0)) break;
      const double s = vv * (uu - uv) / det, w = uu * (vv - uv) / det;
      const Vec2 centre = A.point() + s * u + w * v;
      const int start = mesh_.locate(centre, t);
      if (start < 0 || !try_insert(centre, space_.at(centre), start, distance, imposed_height)) break;
    }
  touched_.clear();
}

// --- algebraic ----------------------------------------------------------------------------------------------------

void Filler::split_long_edges() {
  constexpr double long2 = 1.4142135623730951 * 1.4142135623730951;
  for (;;) {
    row_.clear();
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
      const Triangle& T = mesh_.triangles[t];
      for (int i = 0; i < 3; ++i) {
        const HalfEdge other = T.n[i];
        if (other == no_edge || (other >> 2) < t || (T.imposed >> i & 1) != 0) continue;
        const int a = T.v[next3[i]], b = T.v[prev3[i]];
        const Vec2 p = mesh_.at(a), q = mesh_.at(b);
        const double l =
            (length(space_.at(p), q - p) + 4 * length(space_.at(0.5 * (p + q)), q - p) + length(space_.at(q), q - p)) /
            6;
        if (l * l < long2) continue;
        const int pieces = std::min(static_cast<int>(l + 0.5), 1 << 12);
        for (int k = 1; k < pieces; ++k)
          row_.push_back({lerp(p, q, static_cast<double>(k) / pieces), 4 * t + i, static_cast<std::int32_t>(a)});
        if (pieces < 2) row_.push_back({0.5 * (p + q), 4 * t + i, static_cast<std::int32_t>(a)});
      }
    }
    const std::size_t before = mesh_.vertices.size();
    for (const Candidate& c : row_) {
      const int t = mesh_.locate(c.uv, start_of(c));
      if (t >= 0) try_insert(c.uv, space_.at(c.uv), t, 0.7, imposed_height);
    }
    touched_.clear();
    if (mesh_.vertices.size() == before) break;
  }
}

}  // namespace carreau::plane
