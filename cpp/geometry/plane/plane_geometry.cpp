// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/plane_geometry.h"

#include <algorithm>
#include <limits>
#include <map>

#include "geometry/plane/plane_cad.h"
#include "geometry/plane/plane_faces.h"
#include "geometry/plane/point_sizes.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

/// References of the model for entities that have references of the user. The first entity of each reference keeps it;
/// the others and entities without reference get numbers behind the largest.
class References {
 public:
  template <typename Range>
  explicit References(const Range& of_user) {
    int largest = 0;
    for (const int ref : of_user) largest = std::max(largest, ref);
    if (largest > std::numeric_limits<int>::max() - static_cast<int>(of_user.size()) - 1)
      throw InvalidModel("the reference " + std::to_string(largest) + " leaves no numbers for entities without one");
    for (const int ref : of_user) {
      const bool own = ref > 0 && first_.emplace(ref, 0).second;
      model_.push_back(own ? ref : ++largest);
    }
  }
  [[nodiscard]] int operator[](std::size_t i) const { return model_[i]; }

 private:
  std::map<int, int> first_;
  std::vector<int> model_;
};

class Builder {
 public:
  Builder(const PlaneDomainInput& input, double eps) : input_(input), eps_(eps) {}

  PlaneGeometry run() {
    arcs_ = cut_into_arcs(input_, eps_, geometry_.warnings);
    separate();
    const PlaneGraph graph(input_, arcs_);
    const std::vector<Subdomain> subdomains = find_subdomains(input_, arcs_, graph);
    number(subdomains);
    Model& model = geometry_.built.model;
    model.source = input_.source;
    model.plane = true;
    face_of_.assign(graph.faces().size(), -1);
    for (std::size_t i = 0; i < subdomains.size(); ++i) {
      face_of_[subdomains[i].face] = static_cast<int>(i);
      add_face(graph, subdomains, i);
    }
    add_points(graph);
    measure();
    const auto cad = std::make_shared<PlaneCad>(std::move(arcs_), std::move(of_face_));
    geometry_.built.cad = cad;
    const bool sized =
        std::any_of(input_.points.begin(), input_.points.end(), [](const PlanePoint& p) { return p.size || p.metric; });
    if (sized) geometry_.sizes = std::make_shared<PointSizes>(input_, cad, std::move(index_of_point_));
    return std::move(geometry_);
  }

 private:
  [[nodiscard]] Where where(int line) const {
    Where place;
    place.file = input_.source, place.line = line;
    return place;
  }

  void separate() {
    constexpr int trials = 3;
    constexpr double finer = 0.1;
    auto conflict = PlaneGraph::find_conflict(input_, arcs_);
    const bool curved =
        std::any_of(arcs_.begin(), arcs_.end(), [](const PlaneArc& arc) { return arc.polyline.size() > 2; });
    for (int i = 0; conflict && curved && i < trials; ++i) {
      refine_polylines(input_, arcs_, eps_ *= finer);
      conflict = PlaneGraph::find_conflict(input_, arcs_);
    }
    if (!conflict) return;
    const int first = arcs_[conflict->first].curve, second = arcs_[conflict->second].curve;
    const std::string at = " at (" + format_number(conflict->at.x()) + ", " + format_number(conflict->at.y()) + ")";
    Where place = where(input_.curves[second].line);
    place.uv = conflict->at;
    throw InvalidModel(where(input_.curves[second].line),
                       first == second ? name_of_curve(input_, first) + " crosses or touches itself" + at
                                       : name_of_curve(input_, first) + " and " + name_of_curve(input_, second) +
                                             " cross or touch" + at + ", where neither has a point");
  }

  void number(const std::vector<Subdomain>& subdomains) {
    std::vector<int> of_faces, of_arcs, of_points;
    for (const Subdomain& each : subdomains) of_faces.push_back(each.ref);
    for (const PlaneArc& arc : arcs_) of_arcs.push_back(input_.curves[arc.curve].ref);
    for (const PlanePoint& point : input_.points) of_points.push_back(point.ref);
    face_refs_.emplace(of_faces), arc_refs_.emplace(of_arcs), point_refs_.emplace(of_points);
  }

  int point_ref(int p) {
    const int ref = (*point_refs_)[p], own = input_.points[p].ref;
    index_of_point_[ref] = p;
    if (ref != own) geometry_.built.model.shown_points[ref] = own;
    return ref;
  }

  void add_face(const PlaneGraph& graph, const std::vector<Subdomain>& subdomains, std::size_t i) {
    const Subdomain& subdomain = subdomains[i];
    Face face;
    face.ref = (*face_refs_)[i];
    if (subdomain.ref != face.ref) face.part_of = subdomain.ref;
    std::vector<int>& arcs = of_face_[face.ref];
    bool turned = false;
    for (const int h : graph.faces()[subdomain.face].half_edges) {
      const bool internal = graph.face_of(h ^ 1) == subdomain.face;
      if (internal && (h & 1) != 0) continue;  // once
      const PlaneArc& arc = arcs_[h / 2];
      const PlaneCurve& curve = input_.curves[arc.curve];
      const int ref = (*arc_refs_)[h / 2];
      arcs.push_back(h / 2);
      face.curves.push_back({.type = internal ? CurveType::internal : CurveType::boundary,
                             .ref = ref,
                             .end1 = point_ref(arc.from),
                             .end2 = point_ref(arc.to),
                             .line = curve.line,
                             .shown_as = ref != curve.ref ? curve.ref : 0});
      if (internal || turned) continue;
      const int rank = static_cast<int>(face.curves.size());
      face.orientation = (h & 1) == 0 ? rank : -rank;
      turned = true;
    }
    geometry_.built.model.faces.push_back(std::move(face));
  }

  void add_points(const PlaneGraph& graph) {
    std::vector<char> on_curve(input_.points.size(), 0);
    for (const PlaneCurve& curve : input_.curves)
      for (const int p : curve.points) on_curve[p] = 1;
    for (std::size_t p = 0; p < input_.points.size(); ++p) {
      const PlanePoint& point = input_.points[p];
      if (on_curve[p] != 0 || !point.imposed) continue;
      const std::string name = name_of_point(input_, static_cast<int>(p));
      const int face = graph.face_at(point.xy);
      if (face == PlaneGraph::on_an_arc)
        throw InvalidModel(where(point.line), name + " lies on a curve that does not pass it");
      const int rank = face >= 0 ? face_of_[face] : -1;
      if (rank >= 0)
        geometry_.built.model.faces[rank].points.push_back(
            {.ref = point_ref(static_cast<int>(p)), .uv = point.xy, .line = point.line});
      else if (!point.may_drop)
        throw InvalidModel(where(point.line), "the imposed " + name + " lies outside of the domain");
    }
  }

  void measure() {
    constexpr double far = std::numeric_limits<double>::infinity();
    geometry_.low = {far, far}, geometry_.high = {-far, -far};
    for (const PlaneArc& arc : arcs_)
      for (const Vec2& p : arc.polyline) {
        geometry_.low = geometry_.low.cwiseMin(p);
        geometry_.high = geometry_.high.cwiseMax(p);
      }
  }

  const PlaneDomainInput& input_;
  double eps_;
  PlaneGeometry geometry_;
  std::vector<PlaneArc> arcs_;
  std::optional<References> face_refs_, arc_refs_, point_refs_;
  std::map<int, std::vector<int>> of_face_;
  std::map<int, int> index_of_point_;
  std::vector<int> face_of_;  // rank in the model of each face of the graph; -1: none
};

}  // namespace

PlaneGeometry build_plane_geometry(const PlaneDomainInput& input, double eps_smooth) {
  return Builder(input, eps_smooth).run();
}

}  // namespace carreau
