#include "plane/placement/filler.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "plane/placement/distances.h"

namespace carreau::plane {

namespace {

constexpr int insertions_between_checks = 4096;
constexpr double strain_limit_small = 0.9, strain_limit_large = 1.3;
constexpr double large_mesh = 10000;  // triangles

}  // namespace

Filler::Filler(Triangulation& mesh, const Field& field, std::int64_t max_triangles, Monitor& monitor)
    : mesh_(mesh),
      shapes_(mesh, field),
      field_(field),
      max_triangles_(max_triangles),
      monitor_(monitor),
      strain_limit_(field.measure() < large_mesh ? strain_limit_small : strain_limit_large) {
  if (field.bends()) mesh_.bends.resize(mesh_.vertices.size());
  for (int v = 0; v < static_cast<int>(mesh_.vertices.size()); ++v) shapes_.set_metric(v);
  const double expected = std::min(1.1 * std::max(field.measure(), 0.0) + static_cast<double>(mesh.triangles.size()),
                                   static_cast<double>(max_triangles));
  mesh_.triangles.reserve(static_cast<std::size_t>(expected) + 1000);
  mesh_.vertices.reserve(static_cast<std::size_t>(expected / 2) + 1000);
}

void Filler::tick() {
  if (++work_ % insertions_between_checks == 0) monitor_.checkpoint();
}

void Filler::check_limit() const {
  if (static_cast<std::int64_t>(mesh_.triangles.size()) > max_triangles_)
    throw LimitError("the mesh of the plane domain has reached the limit of " + std::to_string(max_triangles_) +
                     " triangles");
}

void Filler::judge(int t) {
  Triangle& T = mesh_.triangles[t];
  if (T.done != Done::frozen) T.done = shapes_.squared_radius(t) < done_radius * done_radius ? Done::yes : Done::no;
}

void Filler::judge_all() {
  for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) judge(t);
}

bool Filler::near_degenerate_edge(Vec2 p, Metric2 metric) const {
  for (const DegenerateEdge& edge : degenerate_) {
    if (edge.surrounded) continue;
    const Vec2 a = mesh_.at(edge.a) - p, d = mesh_.at(edge.b) - mesh_.at(edge.a);
    const double l2 = squared_length(metric, d);
    const double s = l2 > 0 ? std::clamp(-dot(metric, a, d) / l2, 0.0, 1.0) : 0;
    if (squared_length(metric, a + s * d) < degenerate_height * degenerate_height) return true;
  }
  return false;
}

bool Filler::try_insert(Vec2 p, int start, double distance, double height) {
  tick();
  const Metric2 metric = field_.at(p);
  if (near_degenerate_edge(p, metric)) return false;
  const InsertRules rules{distance * distance, height, degenerate_height, degenerate_ends_};
  Bend bend = Bend::none;
  if (field_.bends()) {
    const MetricSlopes slopes = field_.slopes(p);
    const Chart chart(p, slopes);
    bend = field_.bend(slopes, chart);
    if (!mesh_.dig(p, metric, start, rules, bend == Bend::smooth ? &chart : nullptr)) return false;
  } else if (!mesh_.dig(p, metric, start, rules)) {
    return false;
  }
  insert_at(p, metric, bend);
  return true;
}

// Fills the cavity and judges the new triangles by their circumradius: in the metric of the point, whose lengths are at
// hand, and, if small enough, in the mean of their vertices; in charts where the field bends.
void Filler::insert_at(Vec2 p, Metric2 metric, Bend bend) {
  constexpr double r2 = done_radius * done_radius;
  const auto v = static_cast<int>(mesh_.vertices.size());
  mesh_.vertices.emplace_back();
  mesh_.vertices.back().x = p.x(), mesh_.vertices.back().y = p.y();
  mesh_.vertices.back().set_metric(metric);
  if (field_.bends()) mesh_.bends.push_back(bend);
  mesh_.fill(v);
  check_limit();
  const double four_det = 4 * determinant(metric);
  const auto rim = mesh_.rim();
  const auto star = mesh_.star();
  const Vertex* const V = mesh_.vertices.data();
  const auto small = [](double a2, double b2, Vec2 a, Vec2 b, Metric2 m, double four_det_area2) {
    return a2 * b2 * squared_length(m, b - a) < r2 * four_det_area2;
  };
  for (std::size_t i = 0; i < star.size(); ++i) {
    const RimEdge& e = rim[i];
    const RimPoint &A = mesh_.rim_point(e.a), &B = mesh_.rim_point(e.b);
    touched_.push_back(star[i]);
    if (std::max(A.d2, B.d2) > 4 * r2) continue;
    if (mesh_.is_bent(v, A.v, B.v)) {
      judge(star[i]);
      continue;
    }
    const Vec2 a{A.x, A.y}, b{B.x, B.y};
    if (!small(A.d2, B.d2, a, b, metric, four_det * e.area * e.area)) continue;
    const Metric2 m = (1.0 / 3) * (metric + V[A.v].metric() + V[B.v].metric());
    if (small(squared_length(m, a), squared_length(m, b), a, b, m, 4 * determinant(m) * e.area * e.area))
      mesh_.triangles[star[i]].done = Done::yes;
  }
}

int Filler::start_of(const Candidate& candidate) const {
  const int t = candidate.edge >> 2, i = candidate.edge & 3;
  return mesh_.triangles[t].v[next3[i]] == candidate.a ? t : mesh_.vertices[candidate.a].triangle;
}

}  // namespace carreau::plane
