// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/shared_curves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "curve/unit_discretisation.h"
#include "periodic/closest.h"
#include "model/format_point.h"
#include "periodic/invalid_periodicity.h"
#include "periodic/thresholds.h"
#include "support/error.h"
#include "support/rounding_of.h"
#include "support/short_number.h"

namespace carreau {

namespace {

using namespace thresholds::periodic;

bool is_closed(const CurveModel& model, int curve) {
  const Curve& shape = model.curve(curve);
  return shape.end1 == shape.end2 && !shape.degenerate;
}

// Fractions that the list has already, or nearly, stay.
void insert_fraction(std::vector<double>& sorted, double r) {
  const auto above = std::lower_bound(sorted.begin(), sorted.end(), r - rounding_of::places);
  if (above != sorted.end() && *above <= r + rounding_of::places) return;
  if (r > 0 && r < 1) sorted.insert(above, r);
}

double of_root(const CurveMember& member, bool closed, double r) {
  return closed ? wrapped(member.image.back(r)) : member.image.back(r);
}
double of_member(const CurveMember& member, bool closed, double r) {
  return closed ? wrapped(member.image.at(r)) : member.image.at(r);
}

SizeSamples least_of(const CurveClass& all, bool closed, const std::vector<SizeSamples>& sizes) {
  SizeSamples least;
  least.law = sizes[all.members.front().image.curve].law;
  least.r = sizes[all.members.front().image.curve].r;
  for (const CurveMember& member : all.members)
    for (const double r : sizes[member.image.curve].r) insert_fraction(least.r, of_root(member, closed, r));
  for (const double r : std::vector<double>(least.r))
    for (const double image : images_on_root(all, closed, r)) insert_fraction(least.r, image);
  for (const double at : least.r) {
    double h = INFINITY, physical = INFINITY;
    for (const CurveMember& member : all.members) {
      const SizeSamples& own = sizes[member.image.curve];
      for (const double r : images_on_root(all, closed, at)) {
        h = std::min(h, own.size_at(of_member(member, closed, r)));
        physical = std::min(physical, own.physical_at(of_member(member, closed, r)));
      }
    }
    least.h.push_back(h), least.physical.push_back(physical);
  }
  return least;
}

SizeSamples carried(const SizeSamples& of, const CurveMember& member, bool closed) {
  SizeSamples result;
  result.law = of.law;
  result.r = {0, 1};
  for (const double r : of.r) insert_fraction(result.r, of_member(member, closed, r));
  for (const double r : result.r) {
    result.h.push_back(of.size_at(of_root(member, closed, r)));
    result.physical.push_back(of.physical_at(of_root(member, closed, r)));
  }
  return result;
}

/// Vertices of `from` in the order of its image: fraction there and index here. Ends of open curves are both listed, of
/// closed ones the first.
std::vector<std::pair<double, int>> in_order(const DiscreteCurve& from, const CurveImage& image, bool closed) {
  std::vector<std::pair<double, int>> order;
  for (int k = 0; k < from.segments() + (closed ? 0 : 1); ++k)
    order.emplace_back(closed ? wrapped(image.at(from.r[k])) : image.at(from.r[k]), k);
  std::sort(order.begin(), order.end());
  return order;
}

void place_image(const DiscreteCurve& from, const CurveImage& image, const Isometry& map, const CurveModel& model, double exact,
                 DiscreteCurve& to) {
  if (to.indivisible) return;
  const bool closed = is_closed(model, image.curve);
  const CurveUse& use = model.curve(image.curve).uses[static_cast<std::size_t>(to.owner)];
  const CurveSupport& support = model.support(use);
  std::vector<double> r, t;
  std::vector<Vec3> targets;
  for (const auto& [at, k] : in_order(from, image, closed)) {
    if (!(at > 0 && at < 1)) continue;
    r.push_back(at);
    targets.push_back(map(from.xyz[k]));
    t.push_back(find_closest(model, use, parameter_at(model, use, at), support.t.front(), support.t.back(), targets.back()).t);
  }
  to.prescribed = from.prescribed;
  place_vertices_at(to, r, t, model);
  for (std::size_t i = 0; i < targets.size(); ++i)
    if (norm(to.xyz[i + 1] - targets[i]) <= exact) to.xyz[i + 1] = targets[i];
}

// The second half of a curve that a map turns is the image of the first one.
void make_symmetric(const Isometry& turn, const CurveModel& model, DiscreteCurve& d) {
  const std::size_t n = d.r.size() - 1;
  std::vector<double> r;
  for (std::size_t k = 1; k < n; ++k) r.push_back((d.r[k] + 1 - d.r[n - k]) / 2);
  place_vertices(d, r, model);
  const CurveUse& use = model.curve(d.curve).uses[static_cast<std::size_t>(d.owner)];
  const CurveSupport& support = model.support(use);
  std::vector<double> t(d.t_of_use[static_cast<std::size_t>(d.owner)].begin() + 1, d.t_of_use[static_cast<std::size_t>(d.owner)].end() - 1);
  for (std::size_t k = n / 2 + 1; k < n; ++k)
    t[k - 1] = find_closest(model, use, t[k - 1], support.t.front(), support.t.back(), turn(d.xyz[n - k])).t;
  place_vertices_at(d, r, t, model);
}

/// The group of a closed root carries its first arc, of length 1 / n, onto all others; a reversal carries parts of the arc onto each other.
class CycleImages {
 public:
  CycleImages(const CurveCycle& cycle, const CurveModel& model, double exact, DiscreteCurve& d) : cycle_(cycle), model_(model), exact_(exact), d_(d) {}

  /// `fixed`: fractions of vertices that must be there. The arcs between them are cut by the sizes of the curve.
  void cut(const std::vector<double>& fixed) {
    std::vector<double> ends{0, arc()};
    const auto add = [&](double r) {
      for (const double at : {in_arc(r), cycle_.turn ? in_arc(cycle_.turned_at - r) : 0.}) {
        const auto near = [at](double e) { return std::abs(e - at) <= rounding_of::places; };
        if (std::none_of(ends.begin(), ends.end(), near)) ends.push_back(at);
      }
    };
    add(0);
    for (const double r : fixed) add(r);
    std::sort(ends.begin(), ends.end());
    const double length = model_.length(d_.curve);
    const int at_least = cycle_.n * (static_cast<int>(ends.size()) - 1) >= 3 ? 1 : 3;
    std::vector<double> first;  // of the arc
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (i > 0) first.push_back(ends[i]);
      const std::vector<double> inside = cuts_between(ends[i], ends[i + 1], length, at_least);
      first.insert(first.end(), inside.begin(), inside.end());
    }
    if (cycle_.turn) first = symmetric(first, ends);
    place(first);
  }

  /// Moves the vertices, whose fractions nearly repeat, to the images of the vertices of the first arc.
  void repeat() {
    std::vector<double> first;
    for (const double r : d_.r)
      if (r > rounding_of::places && r < arc() - rounding_of::sizes) first.push_back(r);
    if (cycle_.turn) {
      std::vector<double> ends{0, arc()};
      if (const double at = in_arc(cycle_.turned_at); at > 0) ends.insert(ends.begin() + 1, at);
      first = symmetric(first, ends);
    }
    place(first);
  }

 private:
  [[nodiscard]] double arc() const { return 1. / cycle_.n; }
  [[nodiscard]] double in_arc(double r) const {
    const double rest = r - std::floor(r / arc()) * arc();
    return rest < rounding_of::places || rest > arc() - rounding_of::places ? 0 : rest;
  }

  [[nodiscard]] std::vector<double> cuts_between(double from, double to, double length, int at_least) const {
    std::vector<double> s{from * length}, h{d_.sizes.size_at(from)};
    for (std::size_t k = 0; k < d_.sizes.r.size(); ++k)
      if (d_.sizes.r[k] > from && d_.sizes.r[k] < to) s.push_back(d_.sizes.r[k] * length), h.push_back(d_.sizes.h[k]);
    s.push_back(to * length), h.push_back(d_.sizes.size_at(to));
    std::vector<double> cuts = split_by_sizes(s, h, d_.sizes.law, at_least);
    for (double& cut : cuts) cut /= length;
    return {cuts.begin() + 1, cuts.end() - 1};
  }

  // The reversal carries each arc between fixed ends onto itself or onto a second one, which takes the images of the first one's cuts.
  [[nodiscard]] std::vector<double> symmetric(const std::vector<double>& cuts, const std::vector<double>& ends) const {
    std::vector<double> result(ends.begin() + 1, ends.end() - 1);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const double middle = (ends[i] + ends[i + 1]) / 2, image = mirrored(middle);
      if (image < middle - rounding_of::places) continue;
      const bool itself = image <= middle + rounding_of::places;
      std::vector<double> inside;
      for (const double r : cuts)
        if (r > ends[i] + rounding_of::places && r < ends[i + 1] - rounding_of::places) inside.push_back(r);
      for (std::size_t k = 0; k < inside.size(); ++k)
        if (itself)
          result.push_back((inside[k] + mirrored(inside[inside.size() - 1 - k])) / 2);
        else
          result.insert(result.end(), {inside[k], mirrored(inside[k])});
    }
    std::sort(result.begin(), result.end());
    return result;
  }
  [[nodiscard]] double mirrored(double r) const { return in_arc(cycle_.turned_at - r); }

  void place(const std::vector<double>& first) {
    std::vector<double> r;
    for (int k = 0; k < cycle_.n; ++k) {
      const double begin = static_cast<double>(k) / cycle_.n;
      if (k > 0) r.push_back(begin);
      for (const double at : first) r.push_back(begin + at);
    }
    place_vertices(d_, r, model_);
    const auto owner = static_cast<std::size_t>(d_.owner);
    const CurveUse& use = model_.curve(d_.curve).uses[owner];
    const CurveSupport& support = model_.support(use);
    std::vector<double> t(d_.t_of_use[owner].begin() + 1, d_.t_of_use[owner].end() - 1);
    std::vector<Vec3> target(d_.xyz.begin(), d_.xyz.end());
    const std::size_t per_arc = first.size() + 1;
    const auto move = [&](std::size_t to, const Vec3& where) {
      if (to == 0 || to >= target.size() - 1) return;
      target[to] = where;
      const CurvePoint found = find_closest(model_, use, t[to - 1], support.t.front(), support.t.back(), target[to]);
      t[to - 1] = found.t;
      if (found.distance > exact_) target[to] = found.xyz;
    };
    if (cycle_.turn) {
      for (std::size_t k = 0; k < per_arc; ++k) {
        const double at = k == 0 ? 0 : first[k - 1], image = mirrored(at);
        if (image < at - rounding_of::sizes) continue;
        const auto found = std::lower_bound(first.begin(), first.end(), image - rounding_of::sizes);
        if (found == first.end() || *found > image + rounding_of::sizes) continue;
        const auto to = static_cast<std::size_t>(found - first.begin()) + 1;
        const int turns = static_cast<int>(std::lround((*found - (cycle_.turned_at - at)) * cycle_.n));
        const Isometry map = cycle_.power((turns % cycle_.n + cycle_.n) % cycle_.n).after(*cycle_.turn);
        move(to, to == k ? Vec3(0.5 * (target[k] + map(target[k]))) : map(target[k]));
      }
    }
    Isometry map;
    for (int k = 1; k < cycle_.n; ++k) {
      map = cycle_.step.after(map);
      for (std::size_t i = 0; i < per_arc; ++i) move(static_cast<std::size_t>(k) * per_arc + i, map(target[i]));
    }
    place_vertices_at(d_, r, t, model_);
    for (std::size_t i = 1; i + 1 < d_.xyz.size(); ++i)
      if (norm(d_.xyz[i] - target[i]) <= exact_) d_.xyz[i] = target[i];
  }

  const CurveCycle& cycle_;
  const CurveModel& model_;
  double exact_;
  DiscreteCurve& d_;
};

// Vertices in mirror planes are their own images.
void keep_on_planes(const CurveClass& all, double gap, DiscreteCurve& d) {
  for (std::size_t k = 1; !all.mirrors.empty() && k + 1 < d.xyz.size(); ++k) d.xyz[k] = on_planes(d.xyz[k], all.mirrors, gap);
}

// Vertices where closed members begin; the arcs between them are cut by sizes.
void cut_at(std::vector<double> fixed, const CurveModel& model, DiscreteCurve& d) {
  fixed.insert(fixed.begin(), 0);
  fixed.push_back(1);
  const double length = model.length(d.curve);
  const int at_least = fixed.size() > 3 ? 1 : 2;
  std::vector<double> r;
  for (std::size_t i = 0; i + 1 < fixed.size(); ++i) {
    std::vector<double> s{fixed[i] * length}, h{d.sizes.size_at(fixed[i])};
    for (std::size_t k = 0; k < d.sizes.r.size(); ++k)
      if (d.sizes.r[k] > fixed[i] && d.sizes.r[k] < fixed[i + 1]) s.push_back(d.sizes.r[k] * length), h.push_back(d.sizes.h[k]);
    s.push_back(fixed[i + 1] * length), h.push_back(d.sizes.size_at(fixed[i + 1]));
    const std::vector<double> cuts = split_by_sizes(s, h, d.sizes.law, at_least);
    if (i > 0) r.push_back(fixed[i]);
    for (std::size_t k = 1; k + 1 < cuts.size(); ++k) r.push_back(cuts[k] / length);
  }
  place_vertices(d, r, model);
}

int prescribed_member(const CurveClass& all, const CurveModel& model, const std::vector<DiscreteCurve>& curves) {
  int found = -1;
  for (int i = 0; i < std::ssize(all.members); ++i) {
    if (!curves[all.members[i].image.curve].prescribed) continue;
    if (found < 0) {
      found = i;
      continue;
    }
    const CurveMember &a = all.members[found], &b = all.members[i];
    const bool closed = is_closed(model, a.image.curve);
    const DiscreteCurve &p = curves[a.image.curve], &q = curves[b.image.curve];
    const CurveImage between = composed(inverse(all.members.front().image.curve, a.image), b.image);
    const auto reject = [&](const std::string& how) {
      throw InvalidPeriodicity(Where{.curve = model.curve(b.image.curve).ref},
                               "edges are prescribed on the curve and on curve " + std::to_string(model.curve(a.image.curve).ref) +
                                   ", which are periodic: they differ, " + how);
    };
    if (p.segments() != q.segments()) reject("there are " + std::to_string(q.segments()) + " and " + std::to_string(p.segments()));
    const auto order = in_order(p, between, closed);
    for (std::size_t k = 0; k < order.size(); ++k)
      if (const double apart = std::abs(order[k].first - q.r[k]); !(apart < rounding_of::sizes))
        reject("by " + short_number(apart * model.length(b.image.curve)) + " at " + format_point(q.xyz[k]));
  }
  return found;
}

void require_repeated(const CurveClass& all, const DiscreteCurve& d, const CurveModel& model) {
  if (all.cycle.is_trivial()) return;
  const auto& member = *std::find_if(all.members.begin(), all.members.end(), [&](const CurveMember& m) { return m.image.curve == d.curve; });
  for (const double at : d.r)
    for (const double r : images_on_root(all, true, of_root(member, true, at))) {
      const double image = of_member(member, true, r);
      const auto near = [image](double known) { return std::abs(known - image) <= rounding_of::sizes; };
      if (std::none_of(d.r.begin(), d.r.end(), near))
        throw InvalidPeriodicity(Where{.curve = model.curve(d.curve).ref},
                           "the edges that are prescribed on the curve do not repeat under the map that carries it onto itself, first at " + format_point(support_point(model, d.curve, at)));
    }
}

// Fractions of lengths are known by tables: vertices of the root where closed members begin go to the images of these beginnings.
void meet_beginnings(const CurveClass& all, const CurveModel& model, DiscreteCurve& root) {
  const auto owner = static_cast<std::size_t>(root.owner);
  const CurveUse& use = model.curve(root.curve).uses[owner];
  const CurveSupport& support = model.support(use);
  const std::vector<double>& known = root.t_of_use[owner];
  std::vector<double> t(known.begin() + 1, known.end() - 1);
  bool any = false;
  for (const CurveMember& member : all.members) {
    const double at = wrapped(member.image.back(0));
    for (std::size_t k = 1; at > 0 && k + 1 < root.r.size(); ++k) {
      if (std::abs(root.r[k] - at) > rounding_of::places) continue;
      const Vec3 begin = model.topology.points[static_cast<std::size_t>(model.curve(member.image.curve).end1)].position;
      t[k - 1] = find_closest(model, use, t[k - 1], support.t.front(), support.t.back(), member.map.inverse()(begin)).t;
      any = true;
    }
  }
  if (any) place_vertices_at(root, std::vector<double>(root.r.begin() + 1, root.r.end() - 1), t, model);
}

void carry_from(const CurveClass& all, std::size_t source, const CurveModel& model, double gap, std::vector<DiscreteCurve>& curves) {
  const CurveMember& from = all.members[source];
  const int root = all.members.front().image.curve;
  const CurveImage to_root = inverse(root, from.image);
  const Isometry back = from.map.inverse();
  if (source == 0 && is_closed(model, root)) meet_beginnings(all, model, curves[root]);
  if (source == 0) keep_on_planes(all, gap, curves[root]);
  for (std::size_t i = 0; i < all.members.size(); ++i) {
    if (i == source) continue;
    const CurveMember& to = all.members[i];
    const bool of_root = source == 0;
    place_image(curves[from.image.curve], of_root ? to.image : composed(to_root, to.image), of_root ? to.map : to.map.after(back),
                model, rounding_of::places * gap, curves[to.image.curve]);
  }
}

}  // namespace

void share_sizes(const PeriodicModel& periodic, const CurveModel& model, std::vector<SizeSamples>& sizes) {
  for (const CurveClass& all : periodic.curves) {
    const int root = all.members.front().image.curve;
    if (model.curve(root).degenerate) continue;
    const bool closed = is_closed(model, root);
    const SizeSamples least = least_of(all, closed, sizes);
    for (const CurveMember& member : all.members) sizes[member.image.curve] = carried(least, member, closed);
  }
}

void share_vertices(const PeriodicModel& periodic, const CurveModel& model, std::vector<DiscreteCurve>& curves) {
  for (const CurveClass& all : periodic.curves) {
    DiscreteCurve& root = curves[all.members.front().image.curve];
    if (root.indivisible) continue;
    const int prescribed = prescribed_member(all, model, curves);
    if (prescribed >= 0) require_repeated(all, curves[all.members[prescribed].image.curve], model);
    if (prescribed < 0) {
      std::vector<double> fixed;
      if (is_closed(model, root.curve))
        for (const CurveMember& member : all.members) insert_fraction(fixed, wrapped(member.image.back(0)));
      if (!all.cycle.is_trivial())
        CycleImages(all.cycle, model, rounding_of::places * periodic.gap, root).cut(fixed);
      else if (!fixed.empty())
        cut_at(fixed, model, root);
      if (all.turn) make_symmetric(*all.turn, model, root);
    }
    carry_from(all, static_cast<std::size_t>(std::max(prescribed, 0)), model, periodic.gap, curves);
  }
}

void carry_vertices(const PeriodicModel& periodic, const CurveModel& model, std::vector<DiscreteCurve>& curves) {
  for (const CurveClass& all : periodic.curves) {
    DiscreteCurve& root = curves[all.members.front().image.curve];
    if (root.indivisible || root.prescribed) continue;
    if (all.turn) make_symmetric(*all.turn, model, root);
    if (!all.cycle.is_trivial()) CycleImages(all.cycle, model, rounding_of::places * periodic.gap, root).repeat();
    carry_from(all, 0, model, periodic.gap, curves);
  }
}

std::vector<int> complete_classes(const PeriodicModel& periodic, const CurveModel& model, std::vector<DiscreteCurve>& curves) {
  std::vector<int> changed;
  for (const CurveClass& all : periodic.curves) {
    DiscreteCurve& root = curves[all.members.front().image.curve];
    if (root.indivisible || root.prescribed) continue;
    const bool closed = is_closed(model, root.curve);
    std::vector<double> r(root.r.begin() + 1, root.r.end() - 1);
    for (const CurveMember& member : all.members)
      for (const double at : curves[member.image.curve].r) insert_fraction(r, of_root(member, closed, at));
    for (const double at : std::vector<double>(r))
      for (const double image : images_on_root(all, closed, at)) insert_fraction(r, image);
    const auto has_all = [&](const CurveMember& member) { return curves[member.image.curve].r.size() == r.size() + 2; };
    if (std::all_of(all.members.begin(), all.members.end(), has_all)) continue;
    place_vertices(root, r, model);
    if (all.turn) make_symmetric(*all.turn, model, root);
    if (!all.cycle.is_trivial()) CycleImages(all.cycle, model, rounding_of::places * periodic.gap, root).repeat();
    carry_from(all, 0, model, periodic.gap, curves);
    for (const CurveMember& member : all.members) changed.push_back(member.image.curve);
  }
  std::sort(changed.begin(), changed.end());
  return changed;
}

int vertex_image(const DiscreteCurve& from, const DiscreteCurve& to, const CurveImage& image, bool closed, int k) {
  if (to.segments() != from.segments()) return -1;
  const int n = from.segments();
  const bool shifted = closed && image.shift != 0 && image.shift != 1;
  if (!shifted) return image.reversed ? n - k : k;
  const double r = wrapped(image.at(from.r[k]));
  const auto above = std::lower_bound(to.r.begin(), to.r.end(), r - 1e-6);
  if (above == to.r.end() || *above > r + 1e-6) return -1;
  return static_cast<int>(above - to.r.begin());
}

}  // namespace carreau
