// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/faces/face_job.h"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "gradation/gradation.h"
#include "pipeline/base/thresholds.h"
#include "pipeline/faces/same_hosts.h"
#include "plane/plane_mesher.h"
#include "support/format.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "support/shares.h"
#include "support/work_bounds.h"
#include "surface/domain/domain_check.h"
#include "surface/improve/refinement.h"
#include "surface/improve/shape_in_space.h"
#include "surface/lift/lift.h"
#include "surface/lift/steep_places.h"
#include "surface/lift/verification.h"
#include "surface/reparametrise/even_parameters.h"
#include "surface/sample/edge_growth.h"
#include "surface/sample/thresholds.h"

namespace carreau {
namespace {

using namespace thresholds::patches;

/// True if the surface jumps between two places. Halves the edge repeatedly, taking the longer half: on a continuous
/// surface the chord shrinks, even if derivatives vanish at the ends (cusps of offset surfaces).
bool jumps(Cad& cad, int face, Vec2 from, Vec2 to) {
  Vec3 p = surface_at(cad, face, want_position, from).s, q = surface_at(cad, face, want_position, to).s;
  const double whole = norm(q - p);
  for (int i = 0; i < rounding_of::halvings; ++i) {
    const Vec2 middle = 0.5 * (from + to);
    const Vec3 m = surface_at(cad, face, want_position, middle).s;
    if (norm(m - p) > norm(q - m))
      to = middle, q = m;
    else
      from = middle, p = m;
  }
  return norm(q - p) > shares::notable * whole + rounding_of::places * std::max(norm(p), norm(q));
}

/// Adds the time of its life.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

void FaceJob::step(Monitor& monitor) {
  try {
    switch (next_) {
      case Step::sample:
        sample(monitor);
        break;
      case Step::mesh:
        mesh(monitor);
        break;
      case Step::lift:
        lift(monitor);
        break;
      case Step::none:
        break;
    }
  } catch (const LimitError& error) {  // the run continues with other faces, as for a DomainError
    if (take_best(monitor)) return;
    beyond_limit_ = error.where().face != 0 ? error : LimitError(Where{.face = input_.ref}, error.what());
    fail(beyond_limit_->what());
  } catch (const DomainError& error) {
    if (!take_best(monitor)) fail(error.what());
  } catch (const CallbackError& error) {
    if (!options_.failing_faces_alone || error.where().face != input_.ref) throw;
    fail(error.what());
  }
}

std::unique_ptr<FaceJob> FaceJob::shared() const {
  auto job = std::make_unique<FaceJob>(given_, even_ ? *even_->host_cad : *cad_, even_ ? *even_->host_rules : *rules_, layers_, options_,
                                       reentrant_);
  job->given_.executor = job->input_.executor = options_.executor;
  return job;
}

FaceOutcome FaceJob::take_outcome() {
  FaceOutcome outcome{.patch = {},
                      .layers = rows_ && failure_.empty() ? std::move(rows_->cells) : std::vector<LayerCell>{},
                      .turned = std::move(turned_),
                      .space = std::move(space_),
                      .failure = std::move(failure_),
                      .remark = std::move(remark_),
                      .beyond_limit = std::move(beyond_limit_),
                      .seconds_sampling = report_.seconds_sampling,
                      .seconds_plane = report_.seconds_plane,
                      .seconds_lift = report_.seconds_lift,
                      .corrections = report_.corrections};
  if (outcome.failure.empty()) outcome.patch = std::move(mesh_);
  return outcome;
}

void FaceJob::fail(const std::string& what) {
  failure_ = what.starts_with("face ") ? what : Where{.face = input_.ref}.prefix() + what;
  next_ = Step::none;
}

// The rows stay as they are made: no later step of this face knows their cells.
void FaceJob::set_rows_apart() {
  if (rows_known_) return;  // the step is repeated
  rows_known_ = true;
  if (layers_.empty()) return;
  std::vector<RowLimit> limits;
  for (const RowLimit& limit : layers_.limits())
    if (limit.face == input_.face) limits.push_back(limit);
  rows_ = make_layer_rows(input_, layers_, *cad_, has_quads_only(options_.element), limits);
  if (!rows_) return;
  input_.domain = &rows_->rest;
  input_.curve_xyz = rows_->rest_xyz;
}

void FaceJob::sample(Monitor& monitor) {
  const Stopwatch watch(report_.seconds_sampling);
  set_rows_apart();
  probe_points_ = rules_->steep_places(input_.face);
  if (input_.limits.field != nullptr) {
    const std::vector<Vec2>& minima = input_.limits.field->size_minima(input_.face);
    probe_points_.insert(probe_points_.end(), minima.begin(), minima.end());
  }
  SampledFacts facts{.normals = options_.shape_trials ? &normals_ : nullptr,
                     .usual_speed = even_ ? 1. : 0.,
                     .max_uneven = max_uneven()};
  try {
    space_ = sampled(monitor, &facts);
  } catch (const UnevenSpeed& speed) {
    even_out(speed, monitor);
    return;  // and repeats the step
  }
  input_.one_size = facts.isotropic;
  bound_growth_from_edges(monitor);
  refuse_beyond_limit(space_->measure());
  normals_.index(*space_);
  next_ = Step::mesh;
}

// A plane domain costs no more to evaluate than to receive from another process.
ControlSpace FaceJob::sampled(Monitor& monitor, SampledFacts* facts) const {
  return sample_face(input_, *cad_, *rules_, probe_points_, monitor, facts);
}

void FaceJob::bound_growth_from_edges(Monitor& monitor) {
  std::optional<EdgeSizes> bounded = bound_growth(input_, *cad_, *rules_, probe_points_, monitor, *space_);
  if (!bounded) return;
  const double asked = input_.limits.edges->smallest();
  bounded_edges_ = std::move(*bounded);
  input_.limits.edges = bounded_edges_.empty() ? nullptr : &bounded_edges_;
  add_remark("sizes cannot grow from edges as short as " + format_number(asked) + " in these (u, v)" +
             (bounded_edges_.empty() ? "" : "; they grow from " + format_number(bounded_edges_.smallest())));
}

void FaceJob::mesh(Monitor& monitor) {
  const Stopwatch watch(report_.seconds_plane);
  if (!input_.executor.is_alone()) require_same_samples(*input_.executor.team, input_.ref, *space_);
  mesh_.emplace();
  mesh_->plane = mesh_plane(input_.domain->plane, *space_,
                            {.frontal = options_.frontal,
                             .squares = squares_,
                             .shape_trials = options_.shape_trials,
                             .normals = normals_.differ() ? &normals_ : nullptr,
                             .max_triangles = options_.max_triangles,
                             .undersampled = undersampled_,
                             .executor = input_.executor},
                            monitor);
  next_ = Step::lift;
}

void FaceJob::lift(Monitor& monitor) {
  std::vector<Vec2> places;
  std::optional<std::vector<std::int32_t>> bad;  // triangles, if known
  {
    const Stopwatch watch(report_.seconds_lift);
    lift_patch(input_, *cad_, *mesh_, monitor);
    bad = swap_poor_edges(input_, *mesh_, monitor);
    places = verify_lift(input_, *space_, *cad_, *rules_, *mesh_, monitor);
    if (corrections_ < max_corrections) {
      const std::vector<Vec2> steep = missed_steep_places(input_, *space_, *cad_, *rules_, *mesh_, monitor);
      places.insert(places.end(), steep.begin(), steep.end());
    }
  }
  // Samples at a jump require triangles without end.
  // Checks so many edges before the patch is corrected, later all. [BadModels.SurfaceThatJumpsInManyPlaces]
  refuse_jumps(30, monitor);
  const bool again = refill_undersampled(places, monitor);
  if ((!places.empty() && corrections_ < max_corrections && sample_again(places, monitor)) || again) {
    next_ = Step::mesh;
    return;
  }
  refuse_unsound(monitor);
  const Stopwatch watch(report_.seconds_lift);
  if (!squares_) shape_in_space(input_, *cad_, *rules_, *mesh_, std::move(bad), monitor);
  const bool kept = options_.size.geo_guarantee && (!input_.isotropic || options_.size.guarantee_triangles);
  const std::vector<int> doubtful = refine_in_space(
      input_, *cad_, *rules_, kept ? geometric_limits(options_.size) : GeometricLimits{}, *mesh_, monitor);
  check_agreement(doubtful, monitor);
}

// If triangles lean, the patch is meshed again in bounded rounds, and the best mesh stays.
void FaceJob::check_agreement(const std::vector<int>& doubtful, Monitor& monitor) {
  const SurfaceAgreement agreement = measure_agreement(input_, *cad_, doubtful, *mesh_, monitor);
  if (bounded_rounds_ == 0) prescribed_ = agreement;
  if (!best_ || agreement.better_than(best_->agreement))
    best_.emplace(Attempt{std::move(*mesh_), std::move(*space_), agreement, bounded_rounds_ > 0});
  if (best_->agreement.wrong() && squares_) {  // equilateral triangles may follow the surface if halves of squares do not
    squares_ = false;
    space_.emplace(best_->space);
    next_ = Step::mesh;
    return;
  }
  const bool again = best_->agreement.wrong() && !input_.isotropic && !input_.one_size && sample_bounded(monitor);
  if (again)
    next_ = Step::mesh;
  else
    take_best(monitor);
}

// First bounds long sizes by the curvature along them; then also bounds their growth: at lines of zero curvature they
// would jump. Returns false if no more bounds are left.
bool FaceJob::sample_bounded(Monitor& monitor) {
  if (++bounded_rounds_ > (given_slope_ > 0 ? 1 : 2)) return false;
  input_.limits.lean = max_lean;
  if (bounded_rounds_ == 2) input_.slope = slope_of_gradation(gentle);
  const Stopwatch watch(report_.seconds_sampling);
  space_ = sampled(monitor, nullptr);
  const double most = max_growth_bounded * static_cast<double>(best_->mesh.plane.triangles.size());
  return space_->measure() <= std::min(most, static_cast<double>(options_.max_triangles));
}

// Returns false if there is none.
bool FaceJob::take_best(Monitor& monitor) {
  if (!best_) return false;
  const SurfaceAgreement agreement = best_->agreement;
  const bool bounded = best_->bounded;
  mesh_ = std::move(best_->mesh);
  space_ = std::move(best_->space);
  best_.reset();
  next_ = Step::none;
  if (bounded)
    add_remark("with the sizes prescribed: " + prescribed_.text() + "; long sizes are bounded by the curvature" +
               (agreement.wrong() ? ", and still " + agreement.text() : ""));
  else if (agreement.wrong())
    add_remark(agreement.text());
  if (rows_)
    for (const int t : agreement.turned_triangles) {
      const auto& [a, b, c] = mesh_->plane.triangles[static_cast<std::size_t>(t)];
      turned_.push_back({mesh_->xyz[static_cast<std::size_t>(a)], mesh_->xyz[static_cast<std::size_t>(b)], mesh_->xyz[static_cast<std::size_t>(c)]});
    }
  if (even_) return_to_host(monitor);
  if (rows_) mesh_ = with_rows(*rows_, *given_.domain, given_.curve_xyz, std::move(*mesh_));
  return true;
}

void FaceJob::add_remark(const std::string& what) {
  remark_ += (remark_.empty() ? Where{.face = input_.ref}.prefix() : "; ") + what;
}

// Sources know the host's parameters only.
double FaceJob::max_uneven() const noexcept {
  if (rules_->asks_sources()) return infinity;
  return evened_out_ && !even_ ? thresholds::sample::hopeless_speed : thresholds::sample::uneven_speed;
}

void FaceJob::even_out(const UnevenSpeed& speed, Monitor& monitor) {
  normals_ = {};
  if (even_) {  // in vain
    input_.domain = even_->host_domain, cad_ = even_->host_cad, rules_ = even_->host_rules;
    even_.reset();
    return;
  }
  if (evened_out_)
    throw DomainError(
        Where{.face = input_.ref, .uv = speed.uv},
        "the parametrisation is " + format_number(speed.times) +
            " times as fast as elsewhere in the face, and not so along lines of one parameter; no mesh can follow it");
  evened_out_ = true;
  auto map = even_parameters(input_.ref, *cad_, sampled_domain(input_.domain->plane), speed.uv, monitor);
  if (!map) return;
  auto even = std::make_unique<Even>();
  even->map = std::move(*map);
  even->domain = reparametrised(*input_.domain, even->map);
  if (find_a_crossing(even->domain.plane)) return;
  even->cad = reparametrised(*cad_, input_.ref, even->map);
  even->rules.emplace(rules_->asking(*even->cad));
  even->host_domain = input_.domain, even->host_cad = cad_, even->host_rules = rules_;
  input_.limits.field = nullptr;  // the field does not know such faces, or depends on (u, v) only
  input_.domain = &even->domain, cad_ = even->cad.get(), rules_ = &*even->rules;
  even_ = std::move(even);
}

void FaceJob::return_to_host(Monitor& monitor) {
  const PlaneDomain& host = even_->host_domain->plane;
  const std::size_t turned = carreau::return_to_host(host, even_->map, *mesh_, monitor);
  if (input_.slope > 0)
    space_.reset();  // sizes along edges are compared with the field that governed them
  else
    space_ = returned_to_host(host, even_->map, *space_, monitor);
  if (turned > 0)
    add_remark("the parametrisation changes its speed a thousand times and more within next to nothing: " +
               std::to_string(turned) + (turned == 1 ? " triangle is" : " triangles are") +
               " turned over in (u, v), not in space");
}

// True if the mesh has missed places that the control space knows correctly. Adds other places to `places`.
bool FaceJob::refill_undersampled(std::vector<Vec2>& places, Monitor& monitor) {
  const std::size_t vertices = mesh_->plane.vertices.size();
  if (refills_ == work_bounds::rounds || vertices <= vertices_when_refilled_ || input_.constant_size) return false;
  if (space_->measure() > max_growth * static_cast<double>(mesh_->plane.triangles.size())) return false;
  const Stopwatch watch(report_.seconds_lift);
  UndersampledRegions found = find_undersampled(input_, *space_, *cad_, *rules_, *mesh_, monitor);
  places.insert(places.end(), found.mistaken.begin(), found.mistaken.end());
  if (found.confirmed.empty()) return false;
  ++refills_;
  vertices_when_refilled_ = vertices;  // regions that cannot be refilled are left alone
  std::move(found.confirmed.begin(), found.confirmed.end(), std::back_inserter(undersampled_));
  return true;
}

// Samples the places that the vertices have found. True if the control space changes.
bool FaceJob::sample_again(const std::vector<Vec2>& places, Monitor& monitor) {
  const Stopwatch watch(report_.seconds_sampling);
  probe_points_.insert(probe_points_.end(), places.begin(), places.end());
  SampledFacts facts;
  ControlSpace finer = sampled(monitor, &facts);
  if (!differ_at(places, *space_, finer)) return false;
  input_.one_size = facts.isotropic;
  refuse_beyond_limit(finer.measure());
  space_ = std::move(finer);
  report_.corrections = ++corrections_;
  return true;
}

void FaceJob::refuse_unsound(Monitor& monitor) const {
  double area = 0, extent2 = 0;
  const std::vector<Vec3>& p = mesh_->xyz;
  for (const Vec3& q : p) extent2 = std::max(extent2, dot(q - p.front(), q - p.front()));
  for (const auto& [a, b, c] : mesh_->plane.triangles) {
    area += norm(cross(p[b] - p[a], p[c] - p[a])) / 2;
    if (area > rounding_of::digits * extent2) break;  // a few triangles suffice
  }
  if (!(area > rounding_of::digits * extent2)) {
    const auto& sides = input_.domain->plane.edges;
    const bool tiny =
        std::all_of(sides.begin(), sides.end(), [](const PlaneEdge& e) { return e.kind == PlaneEdgeKind::degenerate; });
    throw DomainError(Where{.face = input_.ref},
                      tiny ? "each side of the face is so short beside the model (a hundred-thousandth) that it counts "
                             "as a point of space"
                           : "the surface has no area: it is a line or a point of space");
  }
  refuse_jumps(mesh_->excesses.size(), monitor);
}

// Looks at some of the edges that are far longer than promised.
void FaceJob::refuse_jumps(std::size_t most, Monitor& monitor) const {
  const std::vector<EdgeExcess>& edges = mesh_->excesses;
  const std::size_t n = std::min(edges.size(), most);
  for (std::size_t k = 0; k < n; ++k) {
    const EdgeExcess& edge = edges[k * edges.size() / n];
    monitor.checkpoint();
    if (jumps(*cad_, input_.ref, edge.from, edge.to))
      throw DomainError(Where{.face = input_.ref, .uv = host_uv(0.5 * (edge.from + edge.to))},
                        "the surface jumps: an edge of its mesh is " + format_number(edge.ratio) +
                            " times as long as by the derivatives; it is not continuous there");
  }
}

void FaceJob::refuse_beyond_limit(double expected) const {
  // Twice the expectation: an estimate must not reject a mesh that would have fitted.
  if (expected > 2 * static_cast<double>(options_.max_triangles))
    refuse_triangles(Where{.face = input_.ref}, expected, options_.max_triangles);
}

}  // namespace carreau
