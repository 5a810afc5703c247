// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/match_faces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "model/format_point.h"
#include "model/traces.h"
#include "periodic/closest.h"
#include "periodic/find_map.h"
#include "periodic/invalid_periodicity.h"
#include "periodic/thresholds.h"
#include "predicates/polygon_locator.h"
#include "support/error.h"
#include "support/format.h"
#include "support/infinity.h"
#include "support/shares.h"
#include "support/short_number.h"

namespace carreau {

namespace {

using namespace thresholds::periodic;

// Fraction of a curve beside whose point a place is sought, and its distance as a share of the curve's length in (u, v).
constexpr double beside = 0.43, step_beside = 0.02;

struct FaceShape {
  std::vector<int> curves;  // of the topology, ascending, each once
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  bool usable = false;
};

std::string format_digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", x);
  return text;
}

class Matcher {
 public:
  Matcher(const CurveModel& model, double diag) : model_(model), gap_(max_gap * diag) {
    for (int c = 0; c < std::ssize(model.topology.curves); ++c) shapes_.push_back(shape_of(model, c));
    for (std::size_t f = 0; f < model.model.faces.size(); ++f) faces_.push_back(face_shape(f));
  }

  std::vector<FacePair> run(std::vector<std::string>& remarks) {
    for (const Periodicity& given : model_.model.periodicities) add(given);
    remarks = std::move(remarks_);
    return std::move(pairs_);
  }

 private:
  [[nodiscard]] FaceShape face_shape(std::size_t f) const {
    const Face& face = model_.model.faces[f];
    FaceShape shape;
    shape.usable = !face.is_wire() && !face.discrete && face.left_out.empty() && !face.curves.empty();
    if (!shape.usable) return shape;
    shape.curves = model_.topology.curve_of[f];
    std::sort(shape.curves.begin(), shape.curves.end());
    shape.curves.erase(std::unique(shape.curves.begin(), shape.curves.end()), shape.curves.end());
    for (const int c : shape.curves) {
      shape.low = shape.low.cwiseMin(shapes_[c].low);
      shape.high = shape.high.cwiseMax(shapes_[c].high);
    }
    return shape;
  }

  [[nodiscard]] int ref(int face) const { return model_.model.faces[face].ref; }

  [[nodiscard]] int index_of(int reference) const {
    for (int f = 0; f < std::ssize(faces_); ++f)
      if (ref(f) == reference && faces_[f].usable) return f;
    const auto is_it = [reference](const Face& face) { return face.ref == reference && face.discrete; };
    if (std::any_of(model_.model.faces.begin(), model_.model.faces.end(), is_it))
      throw InvalidPeriodicity(Where{.face = reference}, "the face is given by triangles, and only faces with curves can be periodic");
    for (const Face& face : model_.model.faces)
      if (face.ref == reference && !face.left_out.empty()) throw InvalidPeriodicity(Where{.face = reference}, "the face is periodic, and it failed: " + face.left_out);
    throw InvalidPeriodicity(Where{.face = reference}, "the face is periodic, and the model has no such face with curves");
  }

  void add(const Periodicity& given) {
    if (given.slaves.size() != given.masters.size())
      throw InvalidPeriodicity("a periodicity has " + std::to_string(given.slaves.size()) + " slave faces and " +
                         std::to_string(given.masters.size()) + " master faces: they must be as many");
    if (given.map && !(given.map->distortion() <= isometry_tolerance))
      throw InvalidPeriodicity("the map of a periodicity changes lengths: R R^T differs from the identity by " +
                         short_number(given.map->distortion()));
    if (given.map && !is_finite(given.map->shift)) throw InvalidPeriodicity("the map of a periodicity is not finite");
    if (norm(given.direction) > 0)
      add_translation(given.direction);
    else if (given.slaves.empty())
      add_found(given);
    else
      add_given(given);
  }

  // ---- pairs of which both faces are given ----

  void add_given(const Periodicity& given) {
    std::vector<int> slaves, masters;
    for (const int r : given.slaves) slaves.push_back(index_of(r));
    for (const int r : given.masters) masters.push_back(index_of(r));
    for (std::size_t i = 0; i < slaves.size(); ++i) {
      if (slaves[i] == masters[i]) {
        add_itself(slaves[i], given);
        continue;
      }
      const Isometry map = given.map ? *given.map : map_between(masters[i], slaves[i]);
      std::optional<FacePair> pair = pair_of(masters[i], slaves[i], map);
      if (!pair) throw InvalidPeriodicity(Where{.face = ref(slaves[i])}, why_not(masters[i], slaves[i], map));
      pairs_.push_back(std::move(*pair));
    }
  }

  // The curves of a face that is periodic with itself, like a tube whose borders meet or an annulus that turns.
  void add_itself(int face, const Periodicity& given) {
    const Where where{.face = ref(face)};
    if (!given.map) throw InvalidPeriodicity(where, "the face is periodic with itself: its map must be given");
    FacePair pair{-1, -1, *given.map};
    for (const int from : faces_[face].curves)
      for (const int to : faces_[face].curves)
        if (const std::optional<CurveImage> image = image_of(model_, shapes_[from], shapes_[to], *given.map, gap_); image && !is_identity(from, *image)) {
          pair.curves.emplace(from, *image);
          break;
        }
    if (pair.curves.empty()) throw InvalidPeriodicity(where, "the face is periodic with itself, and the map carries none of its curves onto another one or along itself");
    if (!turned_curves(face, *given.map).empty()) note_itself(face, pair.curves);
    pairs_.push_back(std::move(pair));
  }

  [[nodiscard]] bool is_identity(int from, const CurveImage& image) const {
    return image.curve == from && (shapes_[from].degenerate || (!image.reversed && wrapped(image.shift) == 0));
  }

  // The curves of a face that a map carries onto themselves or each other; seams apart, which need no image. Empty: it does not, or moves none.
  [[nodiscard]] std::map<int, CurveImage> turned_curves(int face, const Isometry& map) {
    std::map<int, CurveImage> images;
    bool moves = false;
    for (const int from : faces_[face].curves) {
      if (only_use(from, face) == nullptr || shapes_[from].degenerate) continue;
      const auto found = std::find_if(faces_[face].curves.begin(), faces_[face].curves.end(), [&](int to) {
        const std::optional<CurveImage> image = image_of(model_, shapes_[from], shapes_[to], map, gap_);
        if (image) images.emplace(from, *image);
        return image.has_value();
      });
      if (found == faces_[face].curves.end()) return {};
      moves = moves || !is_identity(from, images.at(from));
    }
    if (!moves || !has_image_inside({face, face, map, images})) return {};
    std::erase_if(images, [&](const auto& c) { return is_identity(c.first, c.second); });
    return images;
  }

  void note_itself(int face, const std::map<int, CurveImage>& images) {
    const std::vector<int>& all = model_.topology.curve_of[face];
    std::string curves;
    std::size_t listed = 0;
    for (const auto& [curve, image] : images) {
      curves += listed == 0 ? "" : listed + 1 == images.size() ? " and " : ", ";
      curves += std::to_string(std::find(all.begin(), all.end(), curve) - all.begin() + 1);
      ++listed;
    }
    remarks_.push_back(Where{.face = ref(face)}.prefix() + "the map of a periodicity carries the face onto itself: nodes on its " +
                       (images.size() == 1 ? "curve " : "curves ") + curves +
                       " have pairs; nodes inside have none unless the geometry has the sectors of the face");
  }

  // A map that carries a face onto itself makes its curves periodic.
  std::size_t add_turned(int face, const Isometry& map) {
    FacePair itself{-1, -1, map, turned_curves(face, map)};
    if (itself.curves.empty()) return 0;
    note_itself(face, itself.curves);
    pairs_.push_back(std::move(itself));
    return 1;
  }

  [[nodiscard]] std::vector<Vec3> corners_of(int face) const {
    std::set<int> corners;
    for (const int c : faces_[face].curves) corners.insert({model_.curve(c).end1, model_.curve(c).end2});
    std::vector<Vec3> points;
    for (const int p : corners) points.push_back(model_.topology.points[static_cast<std::size_t>(p)].position);
    return points;
  }

  [[nodiscard]] Isometry map_between(int master, int slave) {
    const auto accepted = [&](const Isometry& map) { return pair_of(master, slave, map).has_value(); };
    const std::vector<Vec3> from = corners_of(master), to = corners_of(slave);
    if (const std::optional<Isometry> map = find_map(from, to, gap_, accepted)) return *map;
    Isometry translation;
    translation.shift = 0.5 * (faces_[slave].low + faces_[slave].high - faces_[master].low - faces_[master].high);
    throw InvalidPeriodicity(Where{.face = ref(slave)}, "no map carries face " + std::to_string(ref(master)) +
                                                      " onto the face; by the translation between their middles " +
                                                      why_not(master, slave, translation));
  }

  // ---- pairs that a map finds ----

  void add_found(const Periodicity& given) {
    if (!given.map)
      throw InvalidPeriodicity("a periodicity needs faces, a map or a direction: it has none of them");
    if (add_pairs(*given.map) == 0) throw InvalidPeriodicity("the map of a periodicity carries no face onto another one; " + nearest_miss(*given.map));
  }

  void add_translation(const Vec3& direction) {
    const Vec3 along = direction / norm(direction);
    double low = infinity, high = -infinity;
    const auto add = [&](int c) {
      for (const Vec3& p : model_.support(model_.curve(c).uses.front()).xyz) low = std::min(low, dot(p, along)), high = std::max(high, dot(p, along));
    };
    for (const FaceShape& face : faces_) std::for_each(face.curves.begin(), face.curves.end(), add);
    for (int c = 0; c < std::ssize(shapes_); ++c)
      if (is_of_wires(c)) add(c);
    // Files give lengths with noise: an extent of 1.0000000000002 is 1.
    const double rounded = std::strtod(format_digits(high - low).c_str(), nullptr);
    Isometry map;
    map.shift = rounded * along;
    for (int i = 0; i < 3; ++i)
      if (along[i] == 0) map.shift[i] = 0;
    if (add_pairs(map) > 0) return;
    throw InvalidPeriodicity("the model is not periodic along (" + format_number(direction.x()) + ", " + format_number(direction.y()) + ", " +
                       format_number(direction.z()) + "): the translation by its extent, " + format_point(map.shift) +
                       ", carries no face onto another one; " + nearest_miss(map));
  }

  // The image of a box, as a box.
  [[nodiscard]] std::pair<Vec3, Vec3> image_box(int face, const Isometry& map) const {
    Vec3 low{infinity, infinity, infinity}, high = -low;
    for (const int c : faces_[face].curves)
      for (const Vec3& p : model_.support(model_.curve(c).uses.front()).xyz) {
        const Vec3 q = map(p);
        low = low.cwiseMin(q), high = high.cwiseMax(q);
      }
    return {low, high};
  }

  [[nodiscard]] static double apart(const std::pair<Vec3, Vec3>& a, const FaceShape& b) {
    return std::max(norm(a.first - b.low), norm(a.second - b.high));
  }

  // The curves of a plane domain, which is one face, the open borders of sheets, and free curves.
  [[nodiscard]] bool may_be_alone(int curve) const { return model_.model.plane || model_.curve(curve).uses.size() == 1 || is_of_wires(curve); }

  [[nodiscard]] bool is_of_wires(int curve) const {
    const std::vector<CurveUse>& uses = model_.curve(curve).uses;
    return std::all_of(uses.begin(), uses.end(), [this](const CurveUse& use) { return model_.model.faces[use.face].is_wire(); });
  }

  template <typename Eligible>
  std::size_t add_curves(const Isometry& map, const Eligible& is_eligible) {
    const std::size_t before = pairs_.size();
    for (const CurveShape& from : shapes_)
      for (const CurveShape& to : shapes_) {
        if (from.degenerate || !is_eligible(from.curve) || !is_eligible(to.curve)) continue;
        if (from.curve == to.curve && !from.closed) continue;
        const std::optional<CurveImage> image = image_of(model_, from, to, map, gap_);
        if (!image || is_identity(from.curve, *image)) continue;
        pairs_.push_back({-1, -1, map, {{from.curve, *image}}});
        break;
      }
    return pairs_.size() - before;
  }

  // Such a face must be cut along the plane for its mesh to be symmetric.
  void note_across(int face, const Isometry& map) {
    if (!map.reflects()) return;
    const std::optional<FacePair> itself = pair_of(face, face, map);
    if (itself && !is_in_plane(*itself))
      remarks_.push_back(Where{.face = ref(face)}.prefix() +
                         "the face lies across the plane of a reflection: its own mesh is not symmetric unless the geometry has its halves");
  }

  // Places beside the curves of a face are their own images.
  [[nodiscard]] bool is_in_plane(const FacePair& itself) {
    for (const auto& [curve, image] : itself.curves) {
      const CurveUse* use = only_use(curve, itself.master);
      const std::optional<Vec2> inside = use != nullptr && !model_.curve(curve).degenerate ? place_beside(*use) : std::nullopt;
      if (!inside) continue;
      const Vec3 p = surface_at(model_.cad, ref(itself.master), want_position, *inside).s;
      return norm(itself.map(p) - p) <= gap_;
    }
    return false;
  }

  std::size_t add_pairs(const Isometry& map) {
    if (model_.model.plane) return add_curves(map, [this](int c) { return may_be_alone(c); });
    std::size_t found = 0;
    for (int m = 0; m < std::ssize(faces_); ++m) {
      if (!faces_[m].usable) continue;
      const std::pair<Vec3, Vec3> box = image_box(m, map);
      const double reach = shares::of_polylines * norm(box.second - box.first) + gap_;
      note_across(m, map);
      for (int s = 0; s < std::ssize(faces_); ++s) {
        if (s == m || !faces_[s].usable || apart(box, faces_[s]) > reach) continue;
        std::optional<FacePair> pair = pair_of(m, s, map);
        if (!pair) continue;
        pairs_.push_back(std::move(*pair));
        ++found;
        break;
      }
    }
    found += found == 0 ? add_curves(map, [this](int c) { return may_be_alone(c); }) : add_curves(map, [this](int c) { return is_of_wires(c); });
    for (int f = 0; f < std::ssize(faces_); ++f)
      if (faces_[f].usable && !map.reflects()) found += add_turned(f, map);
    return found;
  }

  [[nodiscard]] std::string nearest_miss(const Isometry& map) const {
    double nearest = infinity;
    int master = -1, slave = -1;
    for (int m = 0; m < std::ssize(faces_); ++m)
      for (int s = 0; s < std::ssize(faces_); ++s) {
        if (s == m || !faces_[m].usable || !faces_[s].usable) continue;
        const double miss = apart(image_box(m, map), faces_[s]);
        if (miss < nearest) nearest = miss, master = m, slave = s;
      }
    if (master < 0 && has_discrete(model_.model)) return "faces given by triangles have no curves, and cannot be periodic";
    if (master < 0) return nearest_curves(map);
    return "nearest is face " + std::to_string(ref(slave)) + ": " + why_not(master, slave, map);
  }

  // The curves of a plane domain or of one sheet.
  [[nodiscard]] std::string nearest_curves(const Isometry& map) const {
    double nearest = infinity;
    Vec3 where(0, 0, 0);
    int master = -1, slave = -1;
    for (int m = 0; m < std::ssize(shapes_); ++m)
      for (int s = 0; s < std::ssize(shapes_); ++s) {
        if (s == m || shapes_[m].degenerate || shapes_[s].degenerate) continue;
        const std::vector<Vec3>& trace = model_.support(model_.curve(m).uses.front()).xyz;
        const Vec3 first = map(trace.front());
        if (norm(first - first.cwiseMax(shapes_[s].low).cwiseMin(shapes_[s].high)) >= nearest) continue;
        double worst = 0;
        Vec3 at(0, 0, 0);
        for (const Vec3& p : trace)
          if (const double apart = nearest_on_trace(model_.support(model_.curve(s).uses.front()).xyz, map(p)).distance; apart > worst) worst = apart, at = map(p);
        if (worst < nearest) nearest = worst, where = at, master = m, slave = s;
      }
    if (master < 0) return "it has no two faces";
    return "nearest is curve " + std::to_string(model_.curve(slave).ref) + ": the image of curve " + std::to_string(model_.curve(master).ref) + " is " +
           short_number(nearest) + " away from it at " + format_point(where);
  }

  // ---- one pair ----

  [[nodiscard]] std::optional<FacePair> pair_of(int master, int slave, const Isometry& map) {
    const FaceShape &from = faces_[master], &to = faces_[slave];
    if (from.curves.size() != to.curves.size()) return {};
    FacePair pair{master, slave, map};
    std::set<int> taken;
    for (const int c : from.curves) {
      bool found = false;
      for (const int d : to.curves) {
        if (taken.contains(d)) continue;
        const std::optional<CurveImage> image = image_of(model_, shapes_[c], shapes_[d], map, gap_);
        if (!image) continue;
        pair.curves.emplace(c, *image);
        taken.insert(d);
        found = true;
        break;
      }
      if (!found) return {};
    }
    return has_image_inside(pair) ? std::optional(std::move(pair)) : std::nullopt;
  }

  // Two faces may have one boundary, like both halves of a sphere: places beside it decide. True if no place can.
  [[nodiscard]] bool has_image_inside(const FacePair& pair) {
    for (const auto& [curve, image] : pair.curves) {
      const CurveUse *from = only_use(curve, pair.master), *to = only_use(image.curve, pair.slave);
      if (from == nullptr || to == nullptr || model_.curve(curve).degenerate) continue;
      const std::optional<Vec2> inside = place_beside(*from);
      if (!inside) continue;
      const Vec3 target = pair.map(surface_at(model_.cad, ref(pair.master), want_position, *inside).s);
      const Curve& shape = model_.curve(curve);
      const double r = shape.end1 == shape.end2 ? wrapped(image.at(beside)) : image.at(beside);
      const Vec2 start = model_.cad.curve(ref(pair.slave), to->curve + 1, want_position, parameter_at(model_, *to, r)).c;
      ClosestPoint point{start, {}, 0};
      find_closest(model_.cad, ref(pair.slave), {&target, 1}, {&point, 1});
      const bool is_in = is_inside(pair.slave, point.uv);
      if (point.distance <= gap_ && is_in) return true;
      beside_[{pair.master, pair.slave}] = "the place " + format_point(target) + " beside it is " + (is_in ? short_number(point.distance) + " away from the face" : "outside the face");
      return false;
    }
    return true;
  }

  [[nodiscard]] const CurveUse* only_use(int curve, int face) const {
    const CurveUse* found = nullptr;
    for (const CurveUse& use : model_.curve(curve).uses) {
      if (use.face != face) continue;
      if (found != nullptr || model_.model.faces[face].curves[use.curve].type != CurveType::boundary) return nullptr;
      found = &use;
    }
    return found;
  }

  // A place of the face a little way from the curve; empty: none, or both sides are inside.
  [[nodiscard]] std::optional<Vec2> place_beside(const CurveUse& use) {
    const CurveSupport& support = model_.support(use);
    double length = 0;
    for (std::size_t i = 1; i < support.uv.size(); ++i) length += norm(support.uv[i] - support.uv[i - 1]);
    const CurveJet jet =
        model_.cad.curve(model_.face_ref(use), use.curve + 1, want_position | want_first, parameter_at(model_, use, beside));
    const double speed = norm(jet.ct);
    if (!(speed > 0)) return {};
    const double step = step_beside * length / speed;
    const Vec2 left(jet.c.x() - step * jet.ct.y(), jet.c.y() + step * jet.ct.x());
    const Vec2 right(jet.c.x() + step * jet.ct.y(), jet.c.y() - step * jet.ct.x());
    const bool is_left = is_inside(use.face, left), is_right = is_inside(use.face, right);
    if (is_left == is_right) return {};
    return is_left ? left : right;
  }

  [[nodiscard]] bool is_inside(int face, const Vec2& p) {
    const auto known = polygons_.find(face);
    if (known != polygons_.end()) return known->second.contains(p);
    std::vector<Vec2> vertices;
    std::vector<std::pair<int, int>> edges;
    for (std::size_t c = 0; c < model_.model.faces[face].curves.size(); ++c) {
      if (model_.model.faces[face].curves[c].type != CurveType::boundary) continue;
      const std::vector<Vec2>& uv = model_.supports[static_cast<std::size_t>(face)][c].uv;
      for (std::size_t i = 0; i < uv.size(); ++i) {
        vertices.push_back(uv[i]);
        if (i > 0) edges.emplace_back(static_cast<int>(vertices.size()) - 2, static_cast<int>(vertices.size()) - 1);
      }
    }
    return polygons_.emplace(face, PolygonLocator(vertices, edges)).first->second.contains(p);
  }

  // Describes the largest distance between the image of a face's boundary and the other boundary, with its place.
  [[nodiscard]] std::string why_not(int master, int slave, const Isometry& map) const {
    double worst = 0;
    Vec3 where(0, 0, 0);
    const auto look = [&](int from, int to, const Isometry& by, bool there) {
      for (const int c : faces_[from].curves)
        for (const Vec3& p : model_.support(model_.curve(c).uses.front()).xyz) {
          const Vec3 image = by(p);
          double nearest = infinity;
          for (const int d : faces_[to].curves)
            nearest = std::min(nearest, nearest_on_trace(model_.support(model_.curve(d).uses.front()).xyz, image).distance);
          if (nearest > worst) worst = nearest, where = there ? image : p;
        }
    };
    look(master, slave, map, true);
    look(slave, master, map.inverse(), false);
    const std::string names = "the image of face " + std::to_string(ref(master)) + " and face " + std::to_string(ref(slave));
    if (worst > gap_)
      return names + " do not match: their boundaries are " + short_number(worst) + " apart at " + format_point(where);
    double corner = 0;
    Vec3 at(0, 0, 0);
    const auto look_at_corners = [&](const std::vector<Vec3>& from, const std::vector<Vec3>& to, const Isometry& by, bool there) {
      for (const Vec3& p : from) {
        double nearest = infinity;
        for (const Vec3& q : to) nearest = std::min(nearest, norm(q - by(p)));
        if (nearest > corner) corner = nearest, at = there ? by(p) : p;
      }
    };
    look_at_corners(corners_of(master), corners_of(slave), map, true);
    look_at_corners(corners_of(slave), corners_of(master), map.inverse(), false);
    if (corner > gap_)
      return names + " do not match: their boundaries are one, but a corner at " + format_point(at) + " has no partner within " +
             short_number(corner);
    if (faces_[master].curves.size() == faces_[slave].curves.size())
      return names + " do not match: they have one boundary, and lie on different sides of it or curve differently" +
             (beside_.contains({master, slave}) ? ": " + beside_.at({master, slave}) : "");
    return names + " do not match: they have " + std::to_string(faces_[master].curves.size()) + " and " +
           std::to_string(faces_[slave].curves.size()) + " curves, which differ by up to " + short_number(worst);
  }

  const CurveModel& model_;
  double gap_;
  std::vector<CurveShape> shapes_;
  std::vector<FaceShape> faces_;
  std::vector<FacePair> pairs_;
  std::map<int, PolygonLocator> polygons_;  // of boundaries, by face
  std::map<std::pair<int, int>, std::string> beside_;  // by master and slave with one boundary: where they differ
  std::vector<std::string> remarks_;
};

}  // namespace

std::vector<FacePair> match_faces(const CurveModel& model, double diag, std::vector<std::string>& remarks) {
  if (model.model.periodicities.empty()) return {};
  return Matcher(model, diag).run(remarks);
}

std::string pair_name(const CurveModel& model, const FacePair& pair) {
  return "faces " + std::to_string(model.model.faces[pair.master].ref) + " and " + std::to_string(model.model.faces[pair.slave].ref);
}

}  // namespace carreau
