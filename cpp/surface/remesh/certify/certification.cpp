// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/certify/certification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "mesh/shape_levels.h"
#include "support/shares.h"
#include "support/stepped_tasks.h"
#include "surface/remesh/base/thresholds.h"
#include "surface/remesh/certify/edit_bounds.h"
#include "surface/remesh/certify/thresholds.h"
#include "surface/remesh/edits/judgement.h"
#include "surface/remesh/edits/worst_first.h"

namespace carreau {

using namespace thresholds::certify;

class Certifier::Work {
 public:
  Work(CrossPatchMesh& mesh, bool all, const RemeshingWorkers& workers, Monitor& monitor)
      : mesh_(mesh),
        all_(all),
        workers_(workers),
        monitor_(monitor),
        bounds_(mesh, mesh.cad()),
        trial_(mesh),
        upright_(1 / (1 - std::cos(mesh.tolerances().angle_deg * std::numbers::pi / 180))) {}

  Certification run() {
    report_ = {};
    std::vector<Beyond> beyond = find();
    report_.beyond_before = static_cast<std::int64_t>(beyond.size());
    const double mean = beyond.empty() ? 0 : shapes_mean();
    const std::int64_t end = bounds_.evaluations() + std::max(always_evaluations, max_evaluations * static_cast<std::int64_t>(mesh_.triangles().size()));
    std::vector<std::int32_t> worked;
    constexpr int max_rounds_of_groups = 3;  // a group may leave two
    for (int round = 0; round < max_rounds_of_groups && !beyond.empty(); ++round) {
      const std::int64_t before = edits();
      for (const std::vector<std::int32_t>& group : groups(beyond)) {
        const std::int64_t before_group = edits();
        std::vector<Corners> corners;
        for (const std::int32_t t : group) corners.push_back(mesh_.triangles()[t]);
        if (failed_.contains(corners)) continue;
        end_ = std::min(end, bounds_.evaluations() + max_evaluations_of_group * static_cast<std::int64_t>(group.size()));
        // Groups far beyond the tolerances first allow splits that degrade triangles.
        const bool boldly = std::ranges::any_of(group, [&](std::int32_t t) { return share_of(t) > max_moved; });
        if (!work_at(group, boldly)) (void)work_at(group, !boldly);
        if (edits() == before_group) failed_.insert(std::move(corners));
        worked.insert(worked.end(), changed_.begin(), changed_.end());
      }
      beyond = find();
      if (edits() == before) break;
    }
    if (report_.has_edits()) {
      tidy_all(std::move(worked));
      beyond = find();
    }
    report_.beyond = static_cast<std::int64_t>(beyond.size());
    if (report_.has_edits() && costs_too_much(mean)) {
      const std::int64_t before = report_.beyond_before;
      undo();
      report_.beyond = report_.beyond_before = before;
    }
    return report_;
  }

  void undo() {
    (void)trial_.undo();
    report_ = {};
    share_.clear(), failed_.clear();
  }
  void accept() { trial_.accept(); }

 private:
  using Corners = EditableMesh::Triangle;
  using Place = CrossPatchMesh::Place;
  using Quad = CrossPatchMesh::Quad;
  struct Beyond {
    double share;
    Corners corners;
    std::int32_t index;
  };

  // Undoes edits of a group. Nothing is known of triangles that come back.
  void undo(Trial<CrossPatchMesh>& trial, const Certification& report) {
    if (!trial.undo()) return;
    for (const std::int32_t t : touched_) share_[t] = unknown;
    share_.resize(mesh_.triangles().size(), unknown);
    std::erase_if(touched_, [&](std::int32_t t) { return t >= static_cast<std::int32_t>(mesh_.triangles().size()); });
    std::erase_if(changed_, [&](std::int32_t v) { return v >= static_cast<std::int32_t>(mesh_.vertices()); });
    report_ = report;
  }

  [[nodiscard]] bool costs_too_much(double mean_before) const {
    const double mean = shapes_mean();
    constexpr double good_mean = thresholds::remesh::good_shape;
    return mean < std::min(good_mean, mean_before) && (mean_before >= good_mean || mean < mean_before - max_mean_lost);
  }

  // Triangles that share a vertex. The worst group is last: no edit may help it.
  [[nodiscard]] std::vector<std::vector<std::int32_t>> groups(const std::vector<Beyond>& beyond) const {
    std::map<std::int32_t, std::vector<std::int32_t>> at;  // by vertex: triangles
    for (const Beyond& b : beyond)
      for (const std::int32_t v : b.corners) at[v].push_back(b.index);
    std::set<std::int32_t> done;
    std::vector<std::vector<std::int32_t>> found;
    for (const Beyond& b : beyond) {
      if (!done.insert(b.index).second) continue;
      std::vector<std::int32_t>& group = found.emplace_back(1, b.index);
      for (std::size_t k = 0; k < group.size(); ++k)
        for (const std::int32_t v : mesh_.triangles()[group[k]])
          for (const std::int32_t t : at[v])
            if (done.insert(t).second) group.push_back(t);
    }
    std::ranges::reverse(found);
    return found;
  }

  /// The excess of some triangles: the largest share, and the sum of the excesses over 1.
  struct Excess {
    double most = 0, sum = 0;
  };
  // Returns the excess of the present triangles of the group.
  Excess excess() {
    std::ranges::sort(touched_);
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    Excess all;
    for (const std::int32_t t : touched_) all.most = std::max(all.most, share_of(t)), all.sum += std::max(0.0, share_of(t) - 1);
    return all;
  }

  // Returns whether the whole group is within tolerances. `boldly` allows degradation by splits that later splits repair. The best state of
  // all rounds counts.
  bool work_at(const std::vector<std::int32_t>& group, bool boldly) {
    touched_ = group, changed_.clear(), boldly_ = boldly;
    std::erase_if(touched_, [&](std::int32_t t) { return share_of(t) <= 1; });
    if (touched_.empty()) return true;
    const double most = std::max(1.0, excess().most * max_growth);
    Trial whole(mesh_), best(mesh_);
    const Certification before_group = report_;
    Certification report_of_best = report_;
    const double first = excess().sum;
    double least = first;
    // A round halves edges once. If splits help, two rounds show an improvement.
    constexpr int max_rounds = 6, rounds_without_success = 3;
    for (int round = 0; round < max_rounds && least > 0; ++round) {
      const std::int64_t before = edits();
      const std::vector<std::int32_t> here = touched_;
      for (const std::int32_t t : here) {
        monitor_.checkpoint();
        if (bounds_.evaluations() < end_ && share_of(t) > 1) mend(t);
      }
      for (int pass = 0; pass < tidy_passes; ++pass) tidy();
      if (edits() == before) break;
      if (const Excess now = excess(); now.most <= most && now.sum < least - shares::negligible) least = now.sum, best.accept(), report_of_best = report_;
      if (round + 1 >= rounds_without_success && least == first) break;
    }
    undo(best, report_of_best);
    // Rejects edits that bring edges out of range for a small gain.
    if (least > min_success * first)
      undo(whole, before_group), least = first;
    else
      whole.accept();
    return least == 0;
  }

  [[nodiscard]] std::int64_t edits() const { return report_.swaps + report_.moves + report_.splits; }

  double share_of(std::int32_t triangle) {
    share_.resize(mesh_.triangles().size(), unknown);
    double& known = share_[triangle];
    if (known == unknown) known = bounds_.share(mesh_.triangles()[triangle]);
    return known;
  }
  void forget(Place p) {
    share_.resize(mesh_.triangles().size(), unknown);
    share_[p.triangle] = unknown;
    touched_.push_back(p.triangle);
  }
  [[nodiscard]] bool is_guarded(std::initializer_list<std::int32_t> vertices) const {
    return std::ranges::any_of(vertices, [&](std::int32_t v) { return mesh_.charts().is_guarded(mesh_.place(v).foot); });
  }

  // The bounds are not far within the tolerances.
  [[nodiscard]] bool is_suspect(const Corners& t) const {
    if (all_) return true;
    TriangleShapes shapes;
    mesh_.judge_agreement(t[0], t[1], t[2], shapes);
    return shapes.share > suspect_share * suspect_share;
  }

  [[nodiscard]] double shapes_mean() const { return summarise_shapes(mesh_, workers_.threads, monitor_).mean; }

  // Bounds all suspect triangles, and keeps their shares. A part is a fixed number of them.
  std::vector<char> bound_suspects() {
    const auto& all = mesh_.triangles();
    share_.resize(all.size(), unknown);
    std::vector<char> suspect(all.size(), 0);
    static constexpr std::size_t bounded_at_once = 512;  // [time only]
    const std::size_t parts = (all.size() + bounded_at_once - 1) / bounded_at_once;
    std::vector<std::int64_t> evaluations(parts, 0);
    const auto look = [&](std::size_t part, Monitor& own) {
      EditBounds bounds(mesh_, mesh_.cad());
      for (std::size_t t = part * bounded_at_once; t < std::min(all.size(), (part + 1) * bounded_at_once); ++t) {
        if (t % 64 == 0) own.checkpoint();
        if (all[t][0] < 0 || !is_suspect(all[t])) continue;
        suspect[t] = 1;
        if (share_[t] == unknown) share_[t] = bounds.share(all[t]);
      }
      evaluations[part] = bounds.evaluations();
    };
    run_each(parts, !workers_.hosts_threads, workers_.threads, look, monitor_);
    for (const std::int64_t n : evaluations) bounds_.count(n);
    return suspect;
  }

  // Worst first.
  std::vector<Beyond> find() {
    std::vector<Beyond> found;
    const std::vector<char> suspect = bound_suspects();
    for (std::size_t t = 0; t < suspect.size(); ++t)
      if (suspect[t] != 0 && share_[t] > 1) found.push_back({share_[t], mesh_.triangles()[t], static_cast<std::int32_t>(t)});
    std::ranges::sort(found, [](const Beyond& p, const Beyond& q) { return p.share != q.share ? p.share > q.share : p.corners < q.corners; });
    return found;
  }

  // Tests of shapes and of agreement at corners are cheap, and reject most edits.
  [[nodiscard]] bool is_fair(const Change& change, double least) const {
    return change.keeps_shapes(least) && change.keeps_surface(upright_);
  }

  void mend(std::int32_t triangle) {
    const Corners corners = mesh_.triangles()[triangle];
    std::array<std::optional<Quad>, 3> quads;
    for (int i = 0; i < 3; ++i) quads[i] = mesh_.mesh().quad_between({0, corners[i]}, corners[(i + 1) % 3]);
    std::array<double, 3> swapped{infinity, infinity, infinity};
    for (int i = 0; i < 3; ++i)
      if (quads[i]) swapped[i] = when_swapped(*quads[i], std::max(1.0, before(*quads[i])));
    const auto best = std::ranges::min_element(swapped) - swapped.begin();
    if (swapped[best] <= 1 && swap(*quads[best])) return;
    for (const std::int32_t v : corners)
      if (share_of(triangle) < max_moved && mesh_.is_free(v) && move(v)) return;
    if (split(quads)) return;
    if (swapped[best] < infinity && swapped[best] < before(*quads[best]) - shares::negligible) swap(*quads[best]);
  }

  double before(const Quad& q) { return std::max(share_of(q.t), share_of(q.u)); }

  /// The share after a swap, or a part of it above `most`; infinity: the swap is not fair.
  double when_swapped(const Quad& q, double most) {
    if (is_guarded({q.a, q.b, q.c, q.d}) || is_too_long(q)) return infinity;
    Change change;
    judge_swap(mesh_, q, &CrossPatchMesh::judge, change);
    if (!is_fair(change, min_shape) || !mesh_.mesh().can_swap(q)) return infinity;
    const auto [first, second] = EditableMesh::swapped(q);
    const double share = bounds_.share_roughly(first, most);
    return share > most ? share : std::max(share, bounds_.share_roughly(second, most));
  }
  [[nodiscard]] bool is_too_long(const Quad& q) const {
    const double length = mesh_.length(q.c, q.d);
    return length > thresholds::remesh::never_longer && length > mesh_.length(q.a, q.b);
  }

  bool swap(const Quad& q) {
    if (!mesh_.swap(q)) return false;
    for (const Place p : q.places()) forget(p);
    changed_.insert(changed_.end(), {q.a, q.b, q.c, q.d});
    ++report_.swaps;
    return true;
  }

  // Moves a vertex to a place where all triangles around are within tolerances.
  bool move(std::int32_t v) {
    const SurfacePlace from = mesh_.place(v);
    if (!from.regular) return false;
    const double h = mesh_.size(v);
    const double fair = std::min(mesh_.judge_shapes_around(v).worst, shape_level::bad);
    for (const double step : steps)
      for (int k = 0; k < directions; ++k)
        if (put(v, beside(from, step * h, k, directions), 1, fair)) return true;
    return false;
  }

  /// Moves the vertex if no share around exceeds `most`, and no shape is below `least`.
  bool put(std::int32_t v, const Vec3& target, double most, double least) {
    const TriangleShapes before = mesh_.judge_around(v);
    const int out = out_of_range(mesh_, v);
    const auto to = is_guarded({v}) ? std::nullopt : mesh_.near(v, mesh_.place(v).normal, target);
    if (!to) return false;
    Trial trial(mesh_);
    mesh_.put(v, *to, mesh_.wanted_at(*to));
    const Change change{before, mesh_.judge_around(v)};
    bool good = change.after.worst >= least && is_fair(change, 0) && out_of_range(mesh_, v) <= out;
    // Triangles that were beyond come first: most moves fail there.
    std::vector<Place> fan(mesh_.mesh().fan(v).begin(), mesh_.mesh().fan(v).end());
    share_.resize(mesh_.triangles().size(), unknown);
    std::ranges::stable_sort(fan, std::greater<>{}, [&](Place p) { return share_[p.triangle]; });
    std::vector<double> shares;
    for (const Place p : fan) {
      if (!good) break;
      shares.push_back(bounds_.share_roughly(mesh_.mesh().at(p), most));
      good = shares.back() <= most;
    }
    if (!good) return false;
    trial.accept();
    for (std::size_t k = 0; k < fan.size(); ++k) forget(fan[k]), share_[fan[k].triangle] = shares[k];
    ++report_.moves;
    return true;
  }

  /// The share after a split, or a part of it above `most`; infinity: the split is not fair.
  double when_split(const Quad& q, const SurfacePlace& at, double most) {
    const std::int32_t m = mesh_.try_vertex(at);
    double share = infinity;
    if (is_fair(judge_split(mesh_, q, m), min_shape)) {
      share = 1;
      if (!boldly_)
        for (const Corners& t : split_parts(q, m))
          if (share <= most) share = std::max(share, bounds_.share_roughly(t, most));
    }
    mesh_.forget_vertex();
    return share;
  }

  // Splits the edge whose parts come nearest. If no split helps it takes the longest edge, unless something becomes
  // worse.
  bool split(const std::array<std::optional<Quad>, 3>& quads) {
    int best = -1;
    std::pair<double, double> least{infinity, 0};
    std::array<std::optional<SurfacePlace>, 3> at;
    for (int i = 0; i < 3; ++i) {
      if (!quads[i]) continue;
      const Quad& q = *quads[i];
      const double length = mesh_.length(q.a, q.b);
      if (length < shortest_split || is_guarded({q.a, q.b, q.c, q.d})) continue;
      at[i] = middle_of(mesh_, q);
      if (!at[i]) continue;
      const double share = when_split(q, *at[i], before(q));
      if (share > before(q) && !boldly_) continue;
      if (share < infinity && std::pair(boldly_ ? 1.0 : std::max(share, 1.0), -length) < least)
        least = {boldly_ ? 1.0 : std::max(share, 1.0), -length}, best = i;
    }
    if (best < 0) return false;
    const Quad& q = *quads[best];
    const std::int32_t m = mesh_.split(q, *at[best]);
    for (const Place p : mesh_.mesh().fan(m)) forget(p);
    changed_.insert(changed_.end(), {q.a, q.b, q.c, q.d, m});
    ++report_.splits;
    return true;
  }

  // Improves shapes around edits, if all triangles stay within tolerances.
  void tidy() {
    std::ranges::sort(changed_);
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    const std::vector<std::int32_t> around = changed_;
    for (const std::int32_t v : around) {
      monitor_.checkpoint();
      if (!mesh_.is_alive(v)) continue;
      for (const std::int32_t w : mesh_.mesh().ring(v)) tidy_edge(v, w);
    }
    for (const std::int32_t v : around) {
      monitor_.checkpoint();
      if (mesh_.is_alive(v) && mesh_.is_free(v)) tidy_vertex(v);
    }
  }

  // Improves shapes around finished groups as far as possible.
  void tidy_all(std::vector<std::int32_t> worked) {
    std::erase_if(worked, [&](std::int32_t v) { return v >= static_cast<std::int32_t>(mesh_.vertices()); });
    changed_ = std::move(worked);
    good_ = thresholds::remesh::good_shape;
    for (int pass = 0; pass < tidy_passes_at_last; ++pass) tidy();
    good_ = thresholds::remesh::good_enough;
  }

  void tidy_edge(std::int32_t v, std::int32_t w) {
    const auto q = mesh_.mesh().quad_between({0, v}, w);
    if (!q) return;
    Change change;
    judge_swap(mesh_, *q, &CrossPatchMesh::judge_shape, change);
    if (change.before.worst >= good_ || change.after.worst < change.before.worst + min_shape_gain) return;
    const double most = std::max(1.0, before(*q));
    if (when_swapped(*q, most) <= most) swap(*q);
  }

  void tidy_vertex(std::int32_t v) {
    const TriangleShapes shapes = mesh_.judge_shapes_around(v);
    if (shapes.worst >= good_) return;
    Vec3 sum{0, 0, 0};
    const std::vector<std::int32_t> ring = mesh_.mesh().ring(v);
    for (const std::int32_t w : ring) sum += mesh_.position(w);
    const Vec3 target = sum / static_cast<double>(ring.size());
    double most = 1;
    for (const Place p : mesh_.mesh().fan(v)) most = std::max(most, share_of(p.triangle));
    for (const double part : {1.0, 0.5})
      if (put(v, lerp(mesh_.position(v), target, part), most, shapes.worst + min_shape_gain)) return;
  }

  static constexpr double unknown = -1;

  CrossPatchMesh& mesh_;
  const bool all_;
  const RemeshingWorkers workers_;
  Monitor& monitor_;
  EditBounds bounds_;
  Trial<CrossPatchMesh> trial_;                   // all edits
  const double upright_;       // CrossPatchMesh's share for upright triangles
  std::vector<double> share_;  // by triangle
  std::vector<std::int32_t> touched_, changed_;  // triangles and vertices, by edits of the group at work
  bool boldly_ = false;
  double good_ = thresholds::remesh::good_enough;  // shapes that are as good stay
  std::int64_t end_ = 0;  // evaluations after which the group at work is given up
  std::set<std::vector<Corners>> failed_;  // groups that nothing helps
  Certification report_;
};

Certifier::Certifier(CrossPatchMesh& mesh, bool all, const RemeshingWorkers& workers, Monitor& monitor)
    : work_(std::make_unique<Work>(mesh, all, workers, monitor)) {}

Certifier::~Certifier() = default;

Certification Certifier::run() { return work_->run(); }

void Certifier::undo() { work_->undo(); }

void Certifier::accept() { work_->accept(); }

}  // namespace carreau
