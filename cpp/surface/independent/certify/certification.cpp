// SPDX-License-Identifier: BSD-3-Clause
#include "surface/independent/certify/certification.h"

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

#include "support/stepped_tasks.h"
#include "surface/independent/certify/free_bounds.h"
#include "surface/independent/certify/thresholds.h"
#include "surface/independent/edits/edge_edits.h"
#include "surface/independent/edits/worst_first.h"

namespace carreau {

using namespace thresholds::certify;

class Certifier::Work {
 public:
  Work(FreeMesh& mesh, bool all, const RemeshingWorkers& workers, Monitor& monitor)
      : mesh_(mesh),
        all_(all),
        workers_(workers),
        monitor_(monitor),
        bounds_(mesh, mesh.cad()),
        edits_before_(mesh.edits()),
        upright_(1 / (1 - std::cos(mesh.tolerances().angle_deg * std::numbers::pi / 180))) {}

  Certification run() {
    report_ = {};
    std::vector<Beyond> beyond = find();
    report_.beyond_before = static_cast<std::int64_t>(beyond.size());
    const double mean = beyond.empty() ? 0 : shapes_mean();
    const std::int64_t end = bounds_.evaluations() + std::max(always_evaluations, most_evaluations * static_cast<std::int64_t>(mesh_.triangles().size()));
    std::vector<std::int32_t> worked;
    constexpr int most_rounds_of_groups = 3;  // a group may leave two
    for (int round = 0; round < most_rounds_of_groups && !beyond.empty(); ++round) {
      const std::int64_t before = edits();
      for (const std::vector<std::int32_t>& group : groups(beyond)) {
        const std::int64_t before_group = edits();
        std::vector<Corners> corners;
        for (const std::int32_t t : group) corners.push_back(mesh_.triangles()[t]);
        if (failed_.contains(corners)) continue;
        end_ = std::min(end, bounds_.evaluations() + most_evaluations_of_group * static_cast<std::int64_t>(group.size()));
        // Groups far beyond the tolerances first allow splits that degrade triangles.
        const bool boldly = std::ranges::any_of(group, [&](std::int32_t t) { return share_of(t) > most_moved; });
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
    undo({edits_before_, 0, {}});
    share_.clear(), failed_.clear();
  }

 private:
  using Corners = EditableMesh::Triangle;
  using Place = FreeMesh::Place;
  using Quad = FreeMesh::Quad;
  struct Beyond {
    double share;
    Corners corners;
    std::int32_t index;
  };
  /// The result of an edit.
  struct Outcome {
    double share = infinity;
    TriangleShapes shapes;
  };
  /// A moved vertex with its old place.
  struct Moved {
    std::int32_t vertex;
    SurfacePlace from;
    WantedSize size;
  };
  struct State {
    std::size_t edits, moves;
    Certification report;
  };

  [[nodiscard]] State state() const { return {mesh_.edits(), moved_.size(), report_}; }
  void undo(const State& to) {
    while (moved_.size() > to.moves) {
      const Moved& last = moved_.back();
      mesh_.put(last.vertex, last.from, last.size);
      for (const Place p : mesh_.mesh().fan(last.vertex)) forget(p);
      moved_.pop_back();
    }
    // Shares of triangles that come back are unknown.
    for (const std::int32_t t : touched_) share_[t] = unknown;
    mesh_.undo(to.edits);
    share_.resize(mesh_.triangles().size(), unknown);
    std::erase_if(touched_, [&](std::int32_t t) { return t >= static_cast<std::int32_t>(mesh_.triangles().size()); });
    std::erase_if(changed_, [&](std::int32_t v) { return v >= static_cast<std::int32_t>(mesh_.vertices()); });
    report_ = to.report;
  }

  [[nodiscard]] bool costs_too_much(double mean_before) const {
    const double mean = shapes_mean();
    return mean < std::min(least_mean, mean_before) && (mean_before >= least_mean || mean < mean_before - most_mean_lost);
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
    const double most = std::max(1.0, excess().most * most_growth);
    const State start = state();
    State best = start;
    const double first = excess().sum;
    double least = first;
    // A round halves edges once. If splits help, two rounds show an improvement.
    constexpr int most_rounds = 6, rounds_without_success = 3;
    for (int round = 0; round < most_rounds && least > 0; ++round) {
      const std::int64_t before = edits();
      const std::vector<std::int32_t> here = touched_;
      for (const std::int32_t t : here) {
        monitor_.checkpoint();
        if (bounds_.evaluations() < end_ && share_of(t) > 1) mend(t);
      }
      for (int pass = 0; pass < tidy_passes; ++pass) tidy();
      if (edits() == before) break;
      if (const Excess now = excess(); now.most <= most && now.sum < least - least_gain) least = now.sum, best = state();
      if (round + 1 >= rounds_without_success && least == first) break;
    }
    // Rejects edits that bring edges out of range for a small gain.
    if (least > least_success * first) best = start, least = first;
    if (mesh_.edits() > best.edits || moved_.size() > best.moves) undo(best);
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
      FreeBounds bounds(mesh_, mesh_.cad());
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
  [[nodiscard]] bool is_fair(const TriangleShapes& before, const TriangleShapes& after, double least) const {
    return after.worst >= std::min(before.worst, least) && after.share < infinity && after.share <= std::max(before.share, upright_);
  }

  void mend(std::int32_t triangle) {
    const Corners corners = mesh_.triangles()[triangle];
    std::array<std::optional<Quad>, 3> quads;
    for (int i = 0; i < 3; ++i) quads[i] = mesh_.mesh().quad_between({0, corners[i]}, corners[(i + 1) % 3]);
    std::array<Outcome, 3> swapped;
    for (int i = 0; i < 3; ++i)
      if (quads[i]) swapped[i] = when_swapped(*quads[i]);
    const auto best = std::ranges::min_element(swapped, {}, &Outcome::share) - swapped.begin();
    if (swapped[best].share <= 1 && swap(*quads[best])) return;
    for (const std::int32_t v : corners)
      if (share_of(triangle) < most_moved && mesh_.is_free(v) && move(v)) return;
    if (split(quads)) return;
    if (swapped[best].share < infinity && swapped[best].share < before(*quads[best]) - least_gain) swap(*quads[best]);
  }

  double before(const Quad& q) { return std::max(share_of(q.t), share_of(q.u)); }

  [[nodiscard]] TriangleShapes judge_pair(const Quad& q) const {
    TriangleShapes shapes;
    mesh_.judge(q.a, q.b, q.c, shapes), mesh_.judge(q.b, q.a, q.d, shapes);
    return shapes;
  }

  Outcome when_swapped(const Quad& q) {
    if (is_guarded({q.a, q.b, q.c, q.d})) return {};
    const double length = mesh_.length(q.c, q.d);
    if (length > longest_swapped && length > mesh_.length(q.a, q.b)) return {};
    Outcome outcome;
    mesh_.judge(q.a, q.d, q.c, outcome.shapes), mesh_.judge(q.d, q.b, q.c, outcome.shapes);
    if (!is_fair(judge_pair(q), outcome.shapes, least_shape) || !mesh_.mesh().can_swap(q)) return {};
    outcome.share = std::max(bounds_.share_roughly({q.a, q.d, q.c}), bounds_.share_roughly({q.d, q.b, q.c}));
    return outcome;
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
    const Vec3 least = std::abs(from.normal[0]) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 across = cross(from.normal, least), p = (1 / norm(across)) * across, q = cross(from.normal, p);
    const double fair = std::min(mesh_.judge_shapes_around(v).worst, least_shape_of_move);
    for (const double step : steps)
      for (int k = 0; k < directions; ++k) {
        const double angle = 2 * std::numbers::pi * k / directions;
        if (put(v, from.xyz + (step * h) * (std::cos(angle) * p + std::sin(angle) * q), 1, fair)) return true;
      }
    return false;
  }

  /// Moves the vertex if no share around exceeds `most`, and no shape is below `least`.
  bool put(std::int32_t v, const Vec3& target, double most, double least) {
    const SurfacePlace from = mesh_.place(v);
    const WantedSize size = mesh_.wanted(v);
    const TriangleShapes before = mesh_.judge_around(v);
    const int out = out_of_range(mesh_, v);
    const auto to = is_guarded({v}) ? std::nullopt : mesh_.near(v, from.normal, target);
    if (!to) return false;
    mesh_.put(v, *to, mesh_.wanted_at(*to));
    const TriangleShapes after = mesh_.judge_around(v);
    bool good = after.worst >= least && is_fair(before, after, 0) && out_of_range(mesh_, v) <= out;
    // Triangles that were beyond come first: most moves fail there.
    std::vector<Place> fan(mesh_.mesh().fan(v).begin(), mesh_.mesh().fan(v).end());
    share_.resize(mesh_.triangles().size(), unknown);
    std::ranges::stable_sort(fan, std::greater<>{}, [&](Place p) { return share_[p.triangle]; });
    std::vector<double> shares;
    for (const Place p : fan) {
      if (!good) break;
      shares.push_back(bounds_.share_roughly(mesh_.mesh().at(p)));
      good = shares.back() <= most;
    }
    if (!good) {
      mesh_.put(v, from, size);
      return false;
    }
    moved_.push_back({v, from, size});
    for (std::size_t k = 0; k < fan.size(); ++k) forget(fan[k]), share_[fan[k].triangle] = shares[k];
    ++report_.moves;
    return true;
  }

  [[nodiscard]] std::optional<SurfacePlace> middle(const Quad& q) {
    const Vec3 at = 0.5 * (mesh_.position(q.a) + mesh_.position(q.b)), normal = mesh_.mesh().mean_normal(q.places());
    auto found = mesh_.near(q.a, normal, at);
    return found ? found : mesh_.near(q.b, normal, at);
  }

  static std::array<Corners, 4> parts(const Quad& q, std::int32_t m) {
    return {Corners{q.a, m, q.c}, {m, q.b, q.c}, {m, q.a, q.d}, {q.b, m, q.d}};
  }

  Outcome when_split(const Quad& q, const SurfacePlace& at) {
    Outcome outcome;
    const std::int32_t m = mesh_.try_vertex(at);
    for (const Corners& t : parts(q, m)) mesh_.judge(t[0], t[1], t[2], outcome.shapes);
    if (is_fair(judge_pair(q), outcome.shapes, least_shape)) {
      outcome.share = 1;
      if (!boldly_)
        for (const Corners& t : parts(q, m)) outcome.share = std::max(outcome.share, bounds_.share_roughly(t));
    }
    mesh_.forget_vertex();
    return outcome;
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
      at[i] = middle(q);
      if (!at[i]) continue;
      const double share = when_split(q, *at[i]).share;
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
    good_ = good_shape_at_last;
    for (int pass = 0; pass < tidy_passes_at_last; ++pass) tidy();
    good_ = good_shape;
  }

  void tidy_edge(std::int32_t v, std::int32_t w) {
    const auto q = mesh_.mesh().quad_between({0, v}, w);
    if (!q) return;
    const TriangleShapes shapes = judge_pair(*q);
    if (shapes.worst >= good_) return;
    const double length = mesh_.length(q->c, q->d);
    TriangleShapes after;
    mesh_.judge(q->a, q->d, q->c, after), mesh_.judge(q->d, q->b, q->c, after);
    if (after.worst < shapes.worst + least_shape_gain || (length > longest_swapped && length > mesh_.length(q->a, q->b))) return;
    if (when_swapped(*q).share <= std::max(1.0, before(*q))) swap(*q);
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
      if (put(v, lerp(mesh_.position(v), target, part), most, shapes.worst + least_shape_gain)) return;
  }

  static constexpr double unknown = -1;

  FreeMesh& mesh_;
  const bool all_;
  const RemeshingWorkers workers_;
  Monitor& monitor_;
  FreeBounds bounds_;
  const std::size_t edits_before_;  // the mesh was made by them
  const double upright_;       // FreeMesh's share for upright triangles
  std::vector<double> share_;  // by triangle
  std::vector<std::int32_t> touched_, changed_;  // triangles and vertices, by edits of the group at work
  std::vector<Moved> moved_;
  bool boldly_ = false;
  double good_ = good_shape;  // shapes that are as good stay
  std::int64_t end_ = 0;  // evaluations after which the group at work is given up
  std::set<std::vector<Corners>> failed_;  // groups that nothing helps
  Certification report_;
};

Certifier::Certifier(FreeMesh& mesh, bool all, const RemeshingWorkers& workers, Monitor& monitor)
    : work_(std::make_unique<Work>(mesh, all, workers, monitor)) {}

Certifier::~Certifier() = default;

Certification Certifier::run() { return work_->run(); }

void Certifier::undo() { work_->undo(); }

}  // namespace carreau
