// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/periodic_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "model/format_point.h"
#include "periodic/invalid_periodicity.h"
#include "periodic/thresholds.h"
#include "support/error.h"
#include "support/format.h"
#include "support/shares.h"
#include "support/short_number.h"

namespace carreau {

namespace {

using namespace thresholds::periodic;

// Chains add the gaps of their maps.
constexpr double gaps_of_chain = 10;

// Turns of a closed curve after which a map must have brought it back.
constexpr int max_order = 720;

std::vector<CurveImage> images_at(const std::map<int, CurveImage>& curves) {
  std::vector<CurveImage> images;
  for (const auto& [from, image] : curves) images.push_back(image);
  return images;
}

bool same_way(const CurveImage& a, const CurveImage& b) {
  if (a.curve != b.curve || a.reversed != b.reversed) return false;
  const double apart = std::abs(a.shift - b.shift);
  return std::abs(apart - std::round(apart)) < shares::of_polylines;
}

class Classes {
 public:
  Classes(const CurveModel& model, std::vector<FacePair> given, double gap) : model_(model), given_(std::move(given)) {
    result_.gap = gap;
  }

  PeriodicModel run() {
    collect_faces();
    collect_curves();
    collect_corners();
    return std::move(result_);
  }

 private:
  [[nodiscard]] int ref(int face) const { return model_.model.faces[face].ref; }

  // One step of a chain.
  struct Step {
    int from = -1, to = -1;
    const FacePair* pair = nullptr;
    bool back = false;  // against the map of the pair
    CurveImage image;   // of curves
    [[nodiscard]] Isometry map() const { return back ? pair->map.inverse() : pair->map; }
  };
  using Steps = std::vector<std::vector<Step>>;

  // ---- faces ----

  static FacePair inverse_of(const FacePair& pair) {
    FacePair back{pair.slave, pair.master, pair.map.inverse()};
    for (const auto& [curve, image] : pair.curves) back.curves.emplace(image.curve, inverse(curve, image));
    return back;
  }

  static FacePair composed_pair(const FacePair& first, const FacePair& second) {
    FacePair all{first.master, second.slave, second.map.after(first.map)};
    for (const auto& [curve, image] : first.curves)
      all.curves.emplace(curve, composed(image, second.curves.at(image.curve)));
    return all;
  }

  void collect_faces() {
    const auto n = model_.model.faces.size();
    std::vector<std::vector<FacePair>> steps(n);
    for (const FacePair& pair : given_) {
      if (pair.master < 0) continue;
      steps[pair.master].push_back(pair);
      steps[pair.slave].push_back(inverse_of(pair));
    }
    result_.pair_of_slave.assign(n, -1);
    result_.is_periodic.assign(n, 0);
    std::vector<FacePair> found;
    std::vector<int> parent(n, -1), known(n, -1);  // `known`: index in `found`
    for (int root = 0; root < static_cast<int>(n); ++root) {
      if (steps[root].empty() || known[root] >= 0) continue;
      FacePair itself{root, root, {}};
      for (const int c : model_.topology.curve_of[root]) itself.curves.emplace(c, CurveImage{c});
      known[root] = static_cast<int>(found.size());
      found.push_back(itself);
      std::vector<int> queue{root};
      for (std::size_t i = 0; i < queue.size(); ++i) {
        const int at = queue[i];
        for (const FacePair& step : steps[at]) {
          FacePair reached = composed_pair(found[known[at]], step);
          if (known[step.slave] < 0) {
            known[step.slave] = static_cast<int>(found.size());
            found.push_back(std::move(reached));
            parent[step.slave] = at;
            queue.push_back(step.slave);
          } else {
            require_same(found[known[step.slave]], reached, parent, at);
          }
        }
      }
    }
    for (int f = 0; f < static_cast<int>(n); ++f) {
      if (known[f] < 0) continue;
      result_.is_periodic[f] = 1;
      FacePair& pair = found[known[f]];
      if (pair.master == f) continue;
      result_.pair_of_slave[f] = static_cast<int>(result_.pairs.size());
      result_.pairs.push_back(std::move(pair));
    }
  }

  [[nodiscard]] std::string path_of(const std::vector<int>& parent, int face) const {
    std::string path = std::to_string(ref(face));
    for (int f = parent[face]; f >= 0; f = parent[f]) path = std::to_string(ref(f)) + ", " + path;
    return path;
  }

  void require_same(const FacePair& known, const FacePair& other, const std::vector<int>& parent, int by) const {
    Miss worst;
    for (const auto& [curve, image] : known.curves) {
      const Miss miss = miss_on(curve, known.map, other.map);
      if (miss.distance > worst.distance) worst = miss;
    }
    const std::vector<CurveImage> a = images_at(known.curves), b = images_at(other.curves);
    const bool same = std::equal(a.begin(), a.end(), b.begin(), b.end(), same_way);
    if (same && worst.distance <= gaps_of_chain * result_.gap) return;
    throw InvalidPeriodicity(Where{.face = ref(known.slave)},
                       "two chains of periodicities carry face " + std::to_string(ref(known.master)) + " onto the face, " +
                           worst.text() + ": by faces " + path_of(parent, known.slave) + " and by faces " +
                           path_of(parent, by) + ", " + std::to_string(ref(known.slave)));
  }

  // ---- curves ----

  void collect_curves() {
    const std::size_t n = model_.topology.curves.size();
    Steps steps(n);
    for (const FacePair& pair : given_)
      for (const auto& [curve, image] : pair.curves) {
        steps[curve].push_back({curve, image.curve, &pair, false, image});
        steps[image.curve].push_back({image.curve, curve, &pair, true, inverse(curve, image)});
      }
    result_.has_class.assign(n, 0);
    std::vector<std::size_t> place(n, 0);
    std::vector<int> parent(n, -1);
    for (int root = 0; root < static_cast<int>(n); ++root) {
      if (steps[root].empty() || result_.has_class[root] != 0) continue;
      CurveClass all;
      all.members.push_back({{root}, {}});
      result_.has_class[root] = 1;
      for (std::size_t i = 0; i < all.members.size(); ++i) {
        const CurveMember from = all.members[i];
        for (const Step& step : steps[from.image.curve]) {
          CurveMember reached{composed(from.image, step.image), step.map().after(from.map)};
          if (result_.has_class[step.to] == 0) {
            result_.has_class[step.to] = 1;
            parent[step.to] = from.image.curve;
            place[step.to] = all.members.size();
            all.members.push_back(std::move(reached));
          } else {
            close(all, all.members[place[step.to]], reached, parent);
          }
        }
      }
      result_.place.resize(n);
      for (std::size_t i = 0; i < all.members.size(); ++i)
        result_.place[all.members[i].image.curve] = {static_cast<int>(result_.curves.size()), static_cast<int>(i)};
      result_.curves.push_back(std::move(all));
    }
  }

  [[nodiscard]] std::string curve_path(const std::vector<int>& parent, int curve) const {
    std::string path = std::to_string(model_.curve(curve).ref);
    for (int c = parent[curve]; c >= 0; c = parent[c]) path = std::to_string(model_.curve(c).ref) + ", " + path;
    return path;
  }

  struct Miss {
    double distance = 0;
    Vec3 where{0, 0, 0};
    [[nodiscard]] std::string text() const { return short_number(distance) + " apart at " + format_point(where); }
  };
  // The largest distance between the images of a curve under two maps.
  [[nodiscard]] Miss miss_on(int curve, const Isometry& a, const Isometry& b) const {
    Miss worst;
    for (const double r : {0.2, 0.7}) {
      const Vec3 p = support_point(model_, curve, r), image = a(p);
      if (const double apart = norm(image - b(p)); apart > worst.distance) worst = {apart, image};
    }
    return worst;
  }

  // A map of a closed root onto itself joins the group of its maps.
  void add_to_cycle(CurveClass& all, const CurveImage& image, const Isometry& map) const {
    CurveCycle& cycle = all.cycle;
    const int root = all.members.front().image.curve;
    if (image.reversed) {
      if (!cycle.turn) {
        cycle.turn = map, cycle.turned_at = image.shift - std::floor(image.shift);
        return;
      }
      const CurveImage known{root, true, cycle.turned_at};
      if (const CurveImage between = composed(image, known); !same_way(between, {root})) add_shift(all, between.shift, cycle.turn->after(map));
      return;
    }
    add_shift(all, image.shift, map);
  }

  void add_shift(CurveClass& all, double shift, const Isometry& map) const {
    CurveCycle& cycle = all.cycle;
    const int root = all.members.front().image.curve;
    int order = 1;
    Isometry power = map;
    while (order <= max_order && miss_on(root, power, {}).distance > shares::negligible * result_.gap) power = map.after(power), ++order;
    if (order > max_order)
      throw InvalidPeriodicity(Where{.curve = model_.curve(root).ref},
                         "a periodicity carries the closed curve onto itself by " + format_number(shift - std::floor(shift)) +
                             " of its length, and no whole number of edges can be repeated so");
    const int n = std::lcm(cycle.n, order);
    if (n == cycle.n) return;
    // The product of both maps that goes on by 1 / n.
    const auto parts = [](double r) { return r - std::floor(r); };
    const double first = 1. / cycle.n, second = std::round(parts(shift) * order) / order;
    for (int a = 0; a < cycle.n; ++a)
      for (int b = 0; b < order; ++b) {
        if (std::abs(parts(a * first + b * second + 0.5 / n) - 1.5 / n) > 0.25 / n) continue;
        CurveCycle factor{order, map};
        const Isometry step = factor.power(b).after(cycle.power(a));
        cycle.n = n, cycle.step = step;
        return;
      }
  }

  // A second chain to a curve carries it like the first one, or the other way round, or, if it is closed, shifted.
  void close(CurveClass& all, const CurveMember& known, const CurveMember& reached, const std::vector<int>& parent) const {
    const int root = all.members.front().image.curve;
    const Curve& shape = model_.curve(root);
    if (shape.degenerate) return;
    const bool closed = shape.end1 == shape.end2;
    if (!closed && known.image.reversed != reached.image.reversed) {
      if (!all.turn) all.turn = known.map.inverse().after(reached.map);
      return;
    }
    const Miss worst = miss_on(root, known.map, reached.map);
    if (closed && !same_way(known.image, reached.image)) {
      add_to_cycle(all, composed(reached.image, inverse(root, known.image)), known.map.inverse().after(reached.map));
      return;
    }
    if (same_way(known.image, reached.image) && worst.distance <= gaps_of_chain * result_.gap) {
      if (const Isometry between = known.map.inverse().after(reached.map); between.reflects()) all.mirrors.push_back(between);
      return;
    }
    throw InvalidPeriodicity(Where{.curve = model_.curve(known.image.curve).ref},
                       "two chains of periodicities carry curve " + std::to_string(shape.ref) + " onto the curve, " +
                           worst.text() + "; one chain is by curves " + curve_path(parent, known.image.curve));
  }

  // ---- corners ----

  struct CornerStep {
    int to = -1;
    Isometry map;
  };

  [[nodiscard]] std::vector<std::vector<CornerStep>> corner_steps() const {
    std::vector<std::vector<CornerStep>> steps(model_.topology.points.size());
    const auto join = [&](int a, int b, const Isometry& map) {
      steps[static_cast<std::size_t>(a)].push_back({b, map});
      steps[static_cast<std::size_t>(b)].push_back({a, map.inverse()});
    };
    for (const FacePair& pair : given_)
      for (const auto& [curve, image] : pair.curves) {
        const Curve &a = model_.curve(curve), &b = model_.curve(image.curve);
        const bool closed = a.end1 == a.end2;
        if (closed && image.shift != 0 && !a.degenerate) continue;
        const bool turned = !closed && image.reversed;
        join(a.end1, turned ? b.end2 : b.end1, pair.map);
        join(a.end2, turned ? b.end1 : b.end2, pair.map);
      }
    return steps;
  }

  [[nodiscard]] Vec3 position(int corner) const { return model_.topology.points[static_cast<std::size_t>(corner)].position; }

  void collect_corners() {
    const std::vector<std::vector<CornerStep>> steps = corner_steps();
    std::vector<char> known(steps.size(), 0);
    for (int root = 0; root < std::ssize(steps); ++root) {
      if (steps[root].empty() || known[root] != 0) continue;
      std::map<int, Isometry> maps{{root, {}}};
      std::vector<Isometry> mirrors;
      std::vector<int> queue{root};
      known[root] = 1;
      for (std::size_t i = 0; i < queue.size(); ++i)
        for (const CornerStep& step : steps[queue[i]]) {
          const Isometry reached = step.map.after(maps.at(queue[i]));
          if (known[step.to] == 0) {
            known[step.to] = 1;
            maps.emplace(step.to, reached);
            queue.push_back(step.to);
          } else if (const Isometry between = maps.at(step.to).inverse().after(reached); between.reflects()) {
            mirrors.push_back(between);
          }
        }
      place_corners(maps, on_planes(position(root), mirrors, result_.gap));
      if (maps.size() < 2) continue;
      std::vector<int>& corners = result_.corners.emplace_back();
      std::vector<Isometry>& onto = result_.corner_maps.emplace_back();
      for (const auto& [corner, map] : maps) corners.push_back(corner), onto.push_back(map);
    }
  }

  void place_corners(const std::map<int, Isometry>& maps, const Vec3& first) {
    for (const auto& [corner, map] : maps) {
      const Vec3 place = map(first);
      if (place != position(corner) && norm(place - position(corner)) <= shares::negligible * result_.gap) result_.placed.emplace_back(corner, place);
    }
  }

  const CurveModel& model_;
  const std::vector<FacePair> given_;
  PeriodicModel result_;
};

}  // namespace

Isometry CurveCycle::power(int k) const noexcept {
  Isometry product;
  for (int i = 0; i < k; ++i) product = step.after(product);
  return product;
}

std::vector<double> images_on_root(const CurveClass& all, bool closed, double r) {
  std::vector<double> images{r};
  if (!closed) {
    if (all.turn) images.push_back(1 - r);
    return images;
  }
  for (int k = 0; k < all.cycle.n; ++k) {
    const double shift = static_cast<double>(k) / all.cycle.n;
    if (k > 0) images.push_back(wrapped(r + shift));
    if (all.cycle.turn) images.push_back(wrapped(all.cycle.turned_at - r + shift));
  }
  return images;
}

Vec3 on_planes(Vec3 p, const std::vector<Isometry>& mirrors, double gap) {
  for (const Isometry& mirror : mirrors)
    if (const Vec3 image = mirror(p); norm(image - p) <= shares::negligible * gap) p = 0.5 * (p + image);
  return p;
}

PeriodicModel find_periodic(const CurveModel& model, double diag) {
  if (model.model.periodicities.empty()) return {};
  std::vector<std::string> remarks;
  PeriodicModel periodic = Classes(model, match_faces(model, diag, remarks), max_gap * diag).run();
  periodic.remarks = std::move(remarks);
  return periodic;
}

}  // namespace carreau
