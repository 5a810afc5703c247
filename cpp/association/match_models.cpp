// SPDX-License-Identifier: BSD-3-Clause
#include "association/match_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "association/thresholds.h"
#include "support/error.h"
#include "support/infinity.h"
#include "support/shares.h"
#include "support/work_bounds.h"

namespace carreau {

namespace {

using namespace thresholds::association;

/// Places of a curve of the first use, in the box of the model.
constexpr std::array<double, 5> places_of_curve{0, 0.25, 0.5, 0.75, 1};

/// A model with the signatures of its entities.
struct Signed {
  const CurveModel& model;
  Vec3 low, size;
  std::vector<std::array<Vec3, 5>> curve;  // places
  std::vector<Vec3> face;                  // mean place
  std::vector<double> extent;              // of faces: length of the boundary over the diagonal

  explicit Signed(const CurveModel& of) : model(of), low(infinity, infinity, infinity), size(0, 0, 0) {
    Vec3 high = -low;
    for (const std::vector<CurveSupport>& supports : of.supports)
      for (const CurveSupport& support : supports)
        for (const Vec3& p : support.xyz) low = low.cwiseMin(p), high = high.cwiseMax(p);
    size = high - low;
    const double diagonal = norm(size);
    for (int i = 0; i < 3; ++i)
      if (!(size[i] > 1e-9 * diagonal)) size[i] = diagonal;
    for (const Curve& c : of.topology.curves) {
      const CurveUse& use = c.uses.front();
      const CurveSupport& support = of.support(use);
      std::array<Vec3, 5>& at = curve.emplace_back();
      for (std::size_t k = 0; k < at.size(); ++k) at[k] = scaled(support.point_at_arc(places_of_curve[k] * support.length()));
    }
    for (std::size_t f = 0; f < of.model.faces.size(); ++f) sign_face(f, diagonal);
  }

  [[nodiscard]] Vec3 scaled(const Vec3& p) const { return (p - low).cwiseQuotient(size); }

  // The mean of the boundary, and half of it a place inside: two faces may have one boundary.
  void sign_face(std::size_t f, double diagonal) {
    Vec3 sum(0, 0, 0);
    Vec2 uv(0, 0);
    double length = 0, count = 0;
    for (const CurveSupport& support : model.supports[f]) {
      for (std::size_t k = 0; k + 1 < support.xyz.size(); ++k) {
        const double weight = norm(support.xyz[k + 1] - support.xyz[k]);
        sum += weight / 2 * (support.xyz[k] + support.xyz[k + 1]), length += weight;
        const double share = norm(support.uv[k + 1] - support.uv[k]);
        uv += share / 2 * (support.uv[k] + support.uv[k + 1]), count += share;
      }
    }
    extent.push_back(length / diagonal);
    Vec3 mean = length > 0 ? scaled(sum / length) : Vec3(0, 0, 0);
    try {
      if (count > 0 && !model.model.faces[f].is_wire())
        mean = 0.5 * (mean + scaled(surface_at(model.cad, model.model.faces[f].ref, want_position, uv / count).s));
    } catch (const CallbackError&) {  // outside of the domain: the boundary alone counts
    }
    face.push_back(mean);
  }
};

double apart(const Signed& a, std::size_t i, const Signed& b, std::size_t k) {
  return norm(a.face[i] - b.face[k]) + std::abs(std::log((a.extent[i] + 1e-9) / (b.extent[k] + 1e-9))) / 4;
}

double apart(const std::array<Vec3, 5>& a, const std::array<Vec3, 5>& b, bool reversed) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += norm(a[k] - b[reversed ? a.size() - 1 - k : k]);
  return sum / static_cast<double>(a.size());
}

Where place_of(const CurveModel& model, std::size_t curve) { return {.curve = model.topology.curves[curve].ref}; }

// Uses of a curve: the matched faces, ascending; as a word.
std::vector<int> faces_of(const Curve& curve, const std::vector<int>* match) {
  std::vector<int> faces;
  for (const CurveUse& use : curve.uses) faces.push_back(match != nullptr ? (*match)[use.face] : use.face);
  std::sort(faces.begin(), faces.end());
  return faces;
}

class Matcher {
 public:
  Matcher(const CurveModel& from, const CurveModel& to) : a_(from), b_(to) {
    const auto check = [](std::size_t p, std::size_t q, const char* what) {
      if (p != q) throw InvalidModel("the topologies differ: the mesh has " + std::to_string(p) + " " + what + ", the new model " + std::to_string(q));
    };
    check(a_.face.size(), b_.face.size(), "faces");
    check(a_.curve.size(), b_.curve.size(), "curves");
  }

  ModelMatch by_references() const {
    ModelMatch match{MatchBy::reference, {}, {}, {}};
    std::map<int, int> faces, curves;
    for (std::size_t f = 0; f < b_.face.size(); ++f) faces[b_.model.model.faces[f].ref] = static_cast<int>(f);
    for (std::size_t c = 0; c < b_.curve.size(); ++c) curves[b_.model.topology.curves[c].ref] = static_cast<int>(c);
    for (const Face& face : a_.model.model.faces) {
      const auto found = faces.find(face.ref);
      if (found == faces.end()) throw InvalidModel({.face = face.ref}, "the topologies differ: the new model has no such face");
      match.face.push_back(found->second);
    }
    for (std::size_t c = 0; c < a_.curve.size(); ++c) {
      const auto found = curves.find(a_.model.topology.curves[c].ref);
      if (found == curves.end()) throw InvalidModel(place_of(a_.model, c), "the topologies differ: the new model has no such curve");
      match.curve.push_back(found->second);
    }
    finish(match);
    return match;
  }

  ModelMatch by_names() const {
    ModelMatch match{MatchBy::name, {}, {}, {}};
    std::map<std::string, int> faces;
    for (std::size_t f = 0; f < b_.face.size(); ++f)
      if (const std::string& name = b_.model.model.faces[f].name; !name.empty() && !faces.emplace(name, static_cast<int>(f)).second)
        throw InvalidModel("faces cannot be matched by names: \"" + name + "\" is the name of two faces");
    for (const Face& face : a_.model.model.faces) {
      const auto found = faces.find(face.name);
      if (found == faces.end()) throw InvalidModel({.face = face.ref}, "the new model has no face of the name \"" + face.name + "\"");
      if (found->second < 0) throw InvalidModel({.face = face.ref}, "faces cannot be matched by names: \"" + face.name + "\" is the name of two faces");
      match.face.push_back(std::exchange(found->second, -1));
    }
    match_curves(match);
    finish(match);
    return match;
  }

  ModelMatch by_shapes() const {
    ModelMatch match{MatchBy::shape, {}, {}, {}};
    const auto [ours, theirs] = colours();
    struct Pair {
      double apart;
      int a, b;
    };
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < ours.size(); ++i)
      for (std::size_t k = 0; k < theirs.size(); ++k)
        if (ours[i] == theirs[k]) pairs.push_back({carreau::apart(a_, i, b_, k), static_cast<int>(i), static_cast<int>(k)});
    std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) { return std::tie(p.apart, p.a, p.b) < std::tie(q.apart, q.a, q.b); });
    match.face.assign(ours.size(), -1);
    std::vector<char> taken(theirs.size(), 0);
    for (const Pair& pair : pairs)
      if (match.face[pair.a] < 0 && taken[pair.b] == 0) match.face[pair.a] = pair.b, taken[pair.b] = 1;
    for (std::size_t f = 0; f < ours.size(); ++f)
      if (match.face[f] < 0) throw InvalidModel({.face = a_.model.model.faces[f].ref}, "the topologies differ: the new model has no face of such neighbours");
    match_curves(match);
    finish(match);
    return match;
  }

  /// Mean distance of counterparts, in boxes of the models.
  [[nodiscard]] double distance(const ModelMatch& match) const {
    double sum = 0;
    for (std::size_t f = 0; f < match.face.size(); ++f) sum += carreau::apart(a_, f, b_, static_cast<std::size_t>(match.face[f]));
    for (std::size_t c = 0; c < match.curve.size(); ++c) sum += carreau::apart(a_.curve[c], b_.curve[match.curve[c]], match.reversed[c] != 0);
    return sum / static_cast<double>(std::max<std::size_t>(1, match.face.size() + match.curve.size()));
  }

 private:
  // Colours of the faces of both models that count neighbours of neighbours (Weisfeiler and Leman 1968).
  [[nodiscard]] std::array<std::vector<int>, 2> colours() const {
    using Word = std::vector<int>;
    std::array<std::vector<int>, 2> faces, curves;
    const std::array<const Signed*, 2> models{&a_, &b_};
    for (std::size_t m = 0; m < 2; ++m) {
      for (const Curve& c : models[m]->model.topology.curves)
        curves[m].push_back((c.degenerate ? 1 : 0) + (c.end1 == c.end2 ? 2 : 0) + 4 * static_cast<int>(c.uses.size()));
      faces[m].assign(models[m]->face.size(), 0);
    }
    for (int round = 0; round < work_bounds::passes; ++round) {
      const auto renumber = [](const std::array<std::vector<Word>, 2>& words, std::array<std::vector<int>, 2>& out) {
        std::map<Word, int> numbers;
        for (const auto& list : words)
          for (const Word& word : list) numbers.emplace(word, 0);
        int next = 0;
        for (auto& [word, number] : numbers) number = next++;
        for (std::size_t m = 0; m < 2; ++m)
          for (std::size_t i = 0; i < words[m].size(); ++i) out[m][i] = numbers.at(words[m][i]);
      };
      std::array<std::vector<Word>, 2> of_faces, of_curves;
      for (std::size_t m = 0; m < 2; ++m) {
        const Topology& topology = models[m]->model.topology;
        for (std::size_t f = 0; f < faces[m].size(); ++f) {
          Word word;
          for (const int c : topology.curve_of[f]) word.push_back(curves[m][c]);
          std::sort(word.begin(), word.end());
          word.push_back(faces[m][f]);
          of_faces[m].push_back(std::move(word));
        }
      }
      renumber(of_faces, faces);
      for (std::size_t m = 0; m < 2; ++m)
        for (std::size_t c = 0; c < curves[m].size(); ++c) {
          Word word = faces_of(models[m]->model.topology.curves[c], &faces[m]);
          word.push_back(curves[m][c]);
          of_curves[m].push_back(std::move(word));
        }
      renumber(of_curves, curves);
    }
    return faces;
  }

  // Curves between matched faces, the nearest first.
  void match_curves(ModelMatch& match) const {
    std::map<std::vector<int>, std::vector<int>> between;  // curves of the new model by their faces
    for (std::size_t c = 0; c < b_.curve.size(); ++c) between[faces_of(b_.model.topology.curves[c], nullptr)].push_back(static_cast<int>(c));
    std::map<std::vector<int>, std::vector<int>> ours;
    for (std::size_t c = 0; c < a_.curve.size(); ++c) ours[faces_of(a_.model.topology.curves[c], &match.face)].push_back(static_cast<int>(c));
    match.curve.assign(a_.curve.size(), -1);
    for (const auto& [faces, curves] : ours) {
      const auto found = between.find(faces);
      if (found == between.end() || found->second.size() != curves.size())
        throw InvalidModel(place_of(a_.model, static_cast<std::size_t>(curves.front())),
                           "the topologies differ: the new model has not as many curves between the faces beside it");
      std::vector<std::tuple<double, int, int>> pairs;
      for (const int c : curves)
        for (const int d : found->second) {
          const bool like = a_.model.topology.curves[c].degenerate == b_.model.topology.curves[d].degenerate;
          const double forward = carreau::apart(a_.curve[c], b_.curve[d], false), backward = carreau::apart(a_.curve[c], b_.curve[d], true);
          pairs.emplace_back(std::min(forward, backward) + (like ? 0 : 1e3), c, d);
        }
      std::sort(pairs.begin(), pairs.end());
      std::vector<char> taken(b_.curve.size(), 0);
      for (const auto& [distance, c, d] : pairs)
        if (match.curve[c] < 0 && taken[d] == 0) match.curve[c] = d, taken[d] = 1;
    }
  }

  // Checks the curves, and finds their directions.
  void finish(ModelMatch& match) const {
    match.reversed.clear();
    for (std::size_t c = 0; c < match.curve.size(); ++c) {
      const Curve &p = a_.model.topology.curves[c], &q = b_.model.topology.curves[match.curve[c]];
      if (faces_of(p, &match.face) != faces_of(q, nullptr))
        throw InvalidModel(place_of(a_.model, c), "the topologies differ: other faces hold its counterpart, curve " + std::to_string(q.ref));
      if (p.degenerate != q.degenerate)
        throw InvalidModel(place_of(a_.model, c), "the topologies differ: it is a point of space in one of the models");
      if ((p.end1 == p.end2) != (q.end1 == q.end2))
        throw InvalidModel(place_of(a_.model, c), "the topologies differ: it is closed in one of the models");
      match.reversed.push_back(carreau::apart(a_.curve[c], b_.curve[match.curve[c]], true) < carreau::apart(a_.curve[c], b_.curve[match.curve[c]], false) ? 1 : 0);
    }
    orient(match);
  }

  // Ends that are corners of several curves decide over places: corners are matched by majority.
  void orient(ModelMatch& match) const {
    std::map<int, std::map<int, int>> votes;
    const auto ends = [&](std::size_t c) {
      const Curve &p = a_.model.topology.curves[c], &q = b_.model.topology.curves[match.curve[c]];
      return std::array<int, 4>{p.end1, p.end2, match.reversed[c] != 0 ? q.end2 : q.end1, match.reversed[c] != 0 ? q.end1 : q.end2};
    };
    for (std::size_t c = 0; c < match.curve.size(); ++c) {
      const auto [p1, p2, q1, q2] = ends(c);
      ++votes[p1][q1], ++votes[p2][q2];
    }
    const auto best = [&](int p) {
      return std::max_element(votes[p].begin(), votes[p].end(), [](const auto& x, const auto& y) { return x.second < y.second; })->first;
    };
    for (std::size_t c = 0; c < match.curve.size(); ++c) {
      const auto [p1, p2, q1, q2] = ends(c);
      const bool stays = best(p1) == q1 && best(p2) == q2, turns = best(p1) == q2 && best(p2) == q1;
      if (!stays && turns) match.reversed[c] = match.reversed[c] != 0 ? 0 : 1;
      if (!stays && !turns) throw InvalidModel(place_of(a_.model, c), "the topologies differ: the ends of its counterpart, curve " +
                                                                      std::to_string(b_.model.topology.curves[match.curve[c]].ref) + ", are other corners");
    }
  }

  Signed a_, b_;
};

}  // namespace

ModelMatch match_models(const CurveModel& from, const CurveModel& to, MatchBy by) {
  const Matcher matcher(from, to);
  if (by == MatchBy::reference) return matcher.by_references();
  if (by == MatchBy::name) return matcher.by_names();
  if (by == MatchBy::shape) return matcher.by_shapes();
  std::optional<InvalidModel> first;
  std::optional<ModelMatch> best;
  const auto attempt = [&](const auto& make) {
    try {
      ModelMatch match = make();
      if (!best || matcher.distance(match) < matcher.distance(*best) / renumbered) best = std::move(match);
    } catch (const InvalidModel& error) {
      if (!first) first = error;
    }
  };
  attempt([&] { return matcher.by_references(); });
  if (best && matcher.distance(*best) < shares::notable) return *best;
  attempt([&] { return matcher.by_names(); });
  attempt([&] { return matcher.by_shapes(); });
  if (!best) throw InvalidModel(first.value());
  return *best;
}

}  // namespace carreau
