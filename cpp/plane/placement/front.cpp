// SPDX-License-Identifier: BSD-3-Clause
#include "plane/placement/front.h"

namespace carreau::plane {

namespace {

constexpr std::int32_t none = -1, more_than_one = -2;

// True if no triangle beyond edge i of T remains to be processed.
bool ends_at(const Triangulation& mesh, const Triangle& T, int i) {
  const HalfEdge other = T.n[i];
  return other == no_edge || (T.imposed >> i & 1) != 0 || mesh.triangles[other >> 2].done != Done::no;
}

}  // namespace

void Front::find(const Placement& placement) {
  const Triangulation& mesh = placement.mesh;
  resting = placement.resting;
  clear(mesh);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) visit(mesh, t);
  connect(mesh);
}

void Front::find_again(Placement& placement) {
  const Triangulation& mesh = placement.mesh;
  clear(mesh);
  for (const std::int32_t t : placement.touched) visit(mesh, t);
  placement.forget_touched();
  connect(mesh);
}

void Front::clear(const Triangulation& mesh) {
  for (const FrontEdge& e : edges) leaving[e.a] = none;
  edges.clear();
  several.clear();
  leaving.resize(mesh.vertices.size(), none);
}

void Front::visit(const Triangulation& mesh, int t) {
  const Triangle& T = mesh.triangles[t];
  for (int i = 0; i < 3; ++i) {
    const HalfEdge other = T.n[i];
    if (T.done == Done::no) {
      if (ends_at(mesh, T, i)) add(mesh, 4 * t + i);
    } else if (other != no_edge && mesh.triangles[other >> 2].done == Done::no) {
      add(mesh, other);
    }
  }
}

void Front::add(const Triangulation& mesh, HalfEdge he) {
  const Triangle& T = mesh.triangles[he >> 2];
  const int i = he & 3;
  if ((T.degenerate >> i & 1) != 0) return;
  const std::int32_t a = T.v[next3[i]], b = T.v[prev3[i]];
  const auto rests = [&](std::int32_t v) { return static_cast<std::size_t>(v) < resting.size() && resting[v] != 0; };
  if (rests(a) || rests(b)) return;
  const auto id = static_cast<std::int32_t>(edges.size());
  if (leaving[a] == none) {
    leaving[a] = id;
  } else {
    if (leaving[a] >= 0) {
      if (edges[leaving[a]].edge == he) return;
      several.push_back(leaving[a]);
      leaving[a] = more_than_one;
    } else {
      for (const std::int32_t other : several)
        if (edges[other].edge == he) return;
    }
    several.push_back(id);
  }
  edges.push_back({he, a, b});
}

void Front::connect(const Triangulation& mesh) {
  for (FrontEdge& e : edges) {
    const std::int32_t next = leaving[e.b];
    e.next = next == more_than_one ? next_around(mesh, e) : next;
    if (e.next >= 0) edges[e.next].has_previous = true;
  }
}

// If several edges leave a vertex (loops that touch, the end of an internal curve), the next one is the first found by
// turning round the vertex through triangles that are not done.
std::int32_t Front::next_around(const Triangulation& mesh, const FrontEdge& edge) const {
  int t = edge.edge >> 2, i = edge.edge & 3;
  for (std::size_t turn = 0; turn < mesh.triangles.size(); ++turn) {
    const int j = next3[i];
    const Triangle& T = mesh.triangles[t];
    if (ends_at(mesh, T, j)) {
      for (const std::int32_t id : several)
        if (edges[id].edge == 4 * t + j) return id;
      return none;
    }
    t = T.n[j] >> 2;
    i = T.n[j] & 3;
  }
  return none;
}

}  // namespace carreau::plane
