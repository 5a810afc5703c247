// Rows of points marched from the boundary: the front between triangles that are done and those that are not.
#include <algorithm>
#include <cmath>

#include "plane/placement/distances.h"
#include "plane/placement/filler.h"

namespace carreau::plane {

namespace {

constexpr int first_stride = 64;
constexpr std::int32_t none = -1, several = -2;
// Over a long base the apex keeps at least this height, squared.
constexpr double least_height2 = 0.3;

}  // namespace

void Filler::add_front_edge(HalfEdge he) {
  const Triangle& T = mesh_.triangles[he >> 2];
  const int i = he & 3;
  if ((T.degenerate >> i & 1) != 0) return;  // one point in space: no row starts there
  const std::int32_t a = T.v[next3[i]], b = T.v[prev3[i]];
  const auto id = static_cast<std::int32_t>(front_.size());
  if (leaving_[a] == none) {
    leaving_[a] = id;
  } else {
    if (leaving_[a] >= 0) {
      if (front_[leaving_[a]].edge == he) return;
      several_.push_back(leaving_[a]);
      leaving_[a] = several;
    } else {
      for (const std::int32_t other : several_)
        if (front_[other].edge == he) return;
    }
    several_.push_back(id);
  }
  front_.push_back({he, a, b});
}

void Filler::find_front(bool first) {
  for (const FrontEdge& e : front_) leaving_[e.a] = none;
  front_.clear();
  several_.clear();
  leaving_.resize(mesh_.vertices.size(), none);
  const auto visit = [&](int t) {
    const Triangle& T = mesh_.triangles[t];
    for (int i = 0; i < 3; ++i) {
      const HalfEdge other = T.n[i];
      if (T.done == Done::no) {
        if (other == no_edge || (T.imposed >> i & 1) != 0 || mesh_.triangles[other >> 2].done != Done::no)
          add_front_edge(4 * t + i);
      } else if (other != no_edge && mesh_.triangles[other >> 2].done == Done::no) {
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
  link_front();
}

void Filler::link_front() {
  for (FrontEdge& e : front_) {
    const std::int32_t next = leaving_[e.b];
    e.next = next == several ? next_around(e) : next;
    if (e.next >= 0) front_[e.next].has_previous = true;
  }
}

// Where several front edges leave a vertex (loops that touch, the end of an internal curve), the next one is the first
// met by turning round the vertex through triangles that are not done.
std::int32_t Filler::next_around(const FrontEdge& edge) const {
  int t = edge.edge >> 2, i = edge.edge & 3;
  for (std::size_t turn = 0; turn < mesh_.triangles.size(); ++turn) {
    const int j = next3[i];
    const Triangle& T = mesh_.triangles[t];
    const HalfEdge other = T.n[j];
    if (other == no_edge || (T.imposed >> j & 1) != 0 || mesh_.triangles[other >> 2].done != Done::no) {
      for (const std::int32_t id : several_)
        if (front_[id].edge == 4 * t + j) return id;
      return none;
    }
    t = other >> 2;
    i = other & 3;
  }
  return none;
}

// Apex of the unit isosceles triangle on an edge, on the metric's normal, the metric being corrected once by that at
// the apex.
Filler::Candidate Filler::apex(const FrontEdge& edge) const {
  const Vertex &A = mesh_.vertices[edge.a], &B = mesh_.vertices[edge.b];
  const double ex = B.x - A.x, ey = B.y - A.y;
  const Vec2 middle{0.5 * (A.x + B.x), 0.5 * (A.y + B.y)};
  const auto place = [&](Metric2 m) {
    const double l2 = m.a * ex * ex + 2 * m.b * ex * ey + m.c * ey * ey;
    const double height2 = std::max(1 - 0.25 * l2, least_height2);
    const double k = std::sqrt(height2 / (std::max(determinant(m), 1e-300) * l2));
    return Vec2{middle.x() - k * (m.b * ex + m.c * ey), middle.y() + k * (m.a * ex + m.b * ey)};
  };
  const Metric2 at_ends = 0.5 * (A.metric() + B.metric());
  const Metric2 at_apex = field_.at(place(at_ends));
  if (mesh_.is_bent(edge.a, edge.b)) return apex_in_charts(edge, place(field_.at(middle)));
  return {place(0.5 * (at_ends + at_apex)), at_apex, edge.edge, edge.a};
}

// Where the field bends, the triangle is isosceles in the chart about its own centroid, which is found in turns with
// it.
Filler::Candidate Filler::apex_in_charts(const FrontEdge& edge, Vec2 first) const {
  constexpr int turns = 2;
  const Vec2 a = mesh_.at(edge.a), b = mesh_.at(edge.b);
  Vec2 top = first;
  for (int k = 0; k < turns; ++k) {
    const ChartedTriangle y(field_, a, b, top, !mesh_.is_kinked(edge.a, edge.b));
    const Vec2 e = y.b - y.a;
    const double l2 = dot(e, e), height = std::sqrt(std::max(1 - 0.25 * l2, least_height2) / l2);
    top = y.chart.point(0.5 * (y.a + y.b) + height * Vec2{-e.y(), e.x()}, top);
  }
  return {top, field_.at(top), edge.edge, edge.a};
}

void Filler::chain_up() {
  row_.clear();
  for (int pass = 0; pass < 2; ++pass)  // open chains first, then closed ones
    for (std::size_t k = 0; k < front_.size(); ++k) {
      if (front_[k].chained || (pass == 0 && front_[k].has_previous)) continue;
      chain_.clear();
      auto id = static_cast<std::int32_t>(k);
      for (; id >= 0 && !front_[id].chained; id = front_[id].next) {
        front_[id].chained = true;
        chain_.push_back(apex(front_[id]));
      }
      respace(id == static_cast<std::int32_t>(k));
    }
}

// In strides, coarse ones first: one after the other along a curved front, each point would swallow the fan of all
// before it.
void Filler::insert_row() {
  const auto n = static_cast<int>(row_.size());
  for (int stride = first_stride; stride >= 1; stride /= 2) {
    const int step = stride == first_stride ? stride : 2 * stride;
    for (int k = stride == first_stride ? 0 : stride; k < n; k += step) {
      const Candidate& candidate = row_[k];
      const int t = mesh_.locate(candidate.p, start_of(candidate));
      if (t >= 0) try_insert(candidate.p, t, row_distance, imposed_height);
    }
  }
}

void Filler::march() {
  judge_all();
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

}  // namespace carreau::plane
