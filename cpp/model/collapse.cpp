// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <map>
#include <set>

#include "model/places.h"
#include "model/topology.h"
#include "model/traces.h"
#include "model/union_find.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

class Collapser {
 public:
  Collapser(const Model& model, const CurveTraces& traces, double eps, std::vector<std::string>* remarks)
      : model_(model), traces_(traces), eps_(eps), remarks_(remarks) {}

  Model run() {
    find_tiny();
    keep_internal_curves();
    keep_whole_loops();
    return collapsed();
  }

 private:
  struct Tiny {
    std::size_t face, curve;  // first appearance
    double length;
  };

  // The first curve of a reference represents all of them (RT-0232 sec. 3.2).
  void find_tiny() {
    std::set<int> seen;
    for_each_curve([&](std::size_t f, std::size_t c) {
      const FaceCurve& curve = model_.faces[f].curves[c];
      if (!seen.insert(curve.ref).second) return;
      const double length = trace_length(traces_[f][c]);
      if (length < eps_) tiny_.emplace(curve.ref, Tiny{f, c, length});
    });
  }

  // A curve that is one point cannot bound anything: an internal curve would tear a hole.
  void keep_internal_curves() {
    for_each_curve([&](std::size_t f, std::size_t c) {
      const FaceCurve& curve = model_.faces[f].curves[c];
      if (curve.type == CurveType::internal)
        keep(curve.ref, "it is inside face " + std::to_string(model_.faces[f].ref));
    });
  }

  // A loop all of whose curves are tiny would vanish, and its hole with it.
  void keep_whole_loops() {
    for (const Face& face : model_.faces) {
      std::map<int, std::vector<const FaceCurve*>> at_point;
      for (const FaceCurve& curve : face.curves)
        if (curve.type == CurveType::boundary) {
          at_point[curve.end1].push_back(&curve);
          at_point[curve.end2].push_back(&curve);
        }
      std::set<int> reached;
      for (const auto& [start, unused] : at_point) {
        if (!reached.insert(start).second) continue;
        std::vector<int> front{start};
        std::set<int> loop;  // references
        while (!front.empty()) {
          const int point = front.back();
          front.pop_back();
          for (const FaceCurve* curve : at_point[point]) {
            loop.insert(curve->ref);
            for (const int end : {curve->end1, curve->end2})
              if (reached.insert(end).second) front.push_back(end);
          }
        }
        bool vanishes = true;
        for (const int ref : loop) vanishes = vanishes && tiny_.count(ref) != 0;
        if (!vanishes) continue;
        for (const int ref : loop) keep(ref, "a whole loop of face " + std::to_string(face.ref) + " would vanish");
      }
    }
  }

  void keep(int ref, const std::string& why) {
    const auto it = tiny_.find(ref);
    if (it == tiny_.end()) return;
    if (it->second.length > 0)
      remark(it->second, "the curve is kept although its length " + format_number(it->second.length) +
                             " is below eps_collapse: " + why);
    tiny_.erase(it);
  }

  Model collapsed() {
    std::map<int, std::size_t> index;  // of point references, ascending
    for_each_curve([&](std::size_t f, std::size_t c) {
      index.emplace(model_.faces[f].curves[c].end1, 0);
      index.emplace(model_.faces[f].curves[c].end2, 0);
    });
    std::vector<int> ref_of;
    for (auto& [ref, i] : index) i = ref_of.size(), ref_of.push_back(ref);
    UnionFind points(ref_of.size());
    Model result = model_;
    for (Face& face : result.faces)
      for (FaceCurve& curve : face.curves)
        if (tiny_.count(curve.ref) != 0) {
          curve.collapsed = true;
          points.merge(index[curve.end1], index[curve.end2]);
        }
    for (const auto& [ref, tiny] : tiny_)
      if (tiny.length > 0)
        remark(tiny, "the curve is eliminated: its length " + format_number(tiny.length) + " is below eps_collapse");
    for (Face& face : result.faces)
      for (FaceCurve& curve : face.curves) {
        curve.end1 = ref_of[points.find(index[curve.end1])];
        curve.end2 = ref_of[points.find(index[curve.end2])];
      }
    return result;
  }

  void remark(const Tiny& tiny, const std::string& sentence) {
    if (remarks_ != nullptr) remarks_->push_back(place_of(model_, tiny.face, tiny.curve).prefix() + sentence);
  }

  template <typename Visit>
  void for_each_curve(Visit visit) const {
    for (std::size_t f = 0; f < model_.faces.size(); ++f)
      for (std::size_t c = 0; c < model_.faces[f].curves.size(); ++c) visit(f, c);
  }

  const Model& model_;
  const CurveTraces& traces_;
  double eps_;
  std::vector<std::string>* remarks_;
  std::map<int, Tiny> tiny_;  // by reference
};

}  // namespace

Model collapse_tiny_curves(const Model& model, const CurveTraces& traces, double eps_collapse,
                           std::vector<std::string>* remarks) {
  if (!(eps_collapse >= 0) || !std::isfinite(eps_collapse))
    throw InvalidArgument("eps_collapse must not be negative; it is " + format_number(eps_collapse));
  check_traces(model, traces);
  return Collapser(model, traces, eps_collapse, remarks).run();
}

}  // namespace carreau
