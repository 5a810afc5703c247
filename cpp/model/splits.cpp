// SPDX-License-Identifier: BSD-3-Clause
#include "model/splits.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "model/near_points.h"
#include "model/places.h"
#include "model/traces.h"
#include "support/format.h"

namespace carreau {
namespace {

struct Box {
  Vec3 low, high;

  [[nodiscard]] bool holds(const Vec3& p, double margin) const noexcept {
    return p.x() >= low.x() - margin && p.x() <= high.x() + margin && p.y() >= low.y() - margin && p.y() <= high.y() + margin &&
           p.z() >= low.z() - margin && p.z() <= high.z() + margin;
  }
};

Box box_of(std::span<const Vec3> trace) {
  Box box{trace.front(), trace.front()};
  for (const Vec3& p : trace) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

struct UnjoinedCurve {
  std::size_t face, curve;
  std::span<const Vec3> trace;
};

class Splitter {
 public:
  Splitter(const Model& model, const CurveTraces& traces, double eps) : eps_(eps), points_(0) {
    const std::vector<std::vector<char>> free = curves_to_glue(model);
    std::vector<Vec3> ends;
    for (std::size_t f = 0; f < model.faces.size(); ++f)
      for (std::size_t c = 0; c < model.faces[f].curves.size(); ++c) {
        if (free[f][c] == 0) continue;
        entries_.push_back({f, c, traces[f][c]});
        ends.push_back(traces[f][c].front());
        ends.push_back(traces[f][c].back());
      }
    points_ = UnionFind(ends.size());
    merge_near_points(ends, eps, points_);
    for (std::size_t i = 0; i < ends.size(); ++i) by_x_.emplace_back(ends[i].x(), i);
    std::sort(by_x_.begin(), by_x_.end());
  }

  std::vector<CurveSplit> run() {
    std::vector<CurveSplit> splits;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      if (trace_extent(entries_[k].trace) < eps_) continue;  // a point
      const std::vector<CurveSplit> of_curve = splits_of(k);
      splits.insert(splits.end(), of_curve.begin(), of_curve.end());
    }
    return splits;
  }

 private:
  /// The nearest end of each set of ends that lies inside curve k.
  std::vector<CurveSplit> splits_of(std::size_t k) {
    const UnjoinedCurve& entry = entries_[k];
    const Box box = box_of(entry.trace);
    const double length = trace_length(entry.trace);
    const double reach = eps_ + trace_deviation(entry.trace);  // an arc may deviate from its trace by more than eps
    std::map<std::size_t, CurveSplit> by_set;
    std::vector<std::size_t> near;
    const auto from = std::lower_bound(by_x_.begin(), by_x_.end(), std::pair{box.low.x() - reach, std::size_t{0}});
    for (auto it = from; it != by_x_.end() && it->first <= box.high.x() + reach; ++it) near.push_back(it->second);
    std::sort(near.begin(), near.end());  // of several ends as near as one another the first one cuts
    for (const std::size_t i : near) {
      const UnjoinedCurve& other = entries_[i / 2];
      const Vec3 end = i % 2 == 0 ? other.trace.front() : other.trace.back();
      if (other.face == entry.face || !box.holds(end, reach)) continue;
      const std::size_t set = points_.find(i);
      if (set == points_.find(2 * k) || set == points_.find(2 * k + 1)) continue;
      const TracePlace foot = nearest_on_trace(entry.trace, end);
      if (foot.distance > reach || foot.arc <= eps_ || foot.arc >= length - eps_) continue;
      const auto [place, is_new] =
          by_set.try_emplace(set, CurveSplit{entry.face, entry.curve, foot.arc, end, foot.distance});
      if (!is_new && foot.distance < place->second.gap)
        place->second = {entry.face, entry.curve, foot.arc, end, foot.distance};
    }
    std::vector<CurveSplit> splits;
    for (const auto& [set, split] : by_set) splits.push_back(split);
    std::sort(splits.begin(), splits.end(), [](const CurveSplit& a, const CurveSplit& b) { return a.arc < b.arc; });
    // Two sets that are nearer to each other along the curve than eps would be one point of it.
    const auto too_near = [this](const CurveSplit& a, const CurveSplit& b) { return b.arc - a.arc <= eps_; };
    splits.erase(std::unique(splits.begin(), splits.end(), too_near), splits.end());
    return splits;
  }

  double eps_;
  std::vector<UnjoinedCurve> entries_;
  UnionFind points_;  // ends 2 k and 2 k + 1 of entry k
  std::vector<std::pair<double, std::size_t>> by_x_;
};

}  // namespace

std::vector<CurveSplit> find_splits(const Model& model, const CurveTraces& traces, double eps) {
  if (!(eps > 0) || !std::isfinite(eps))
    throw InvalidArgument("eps_glue must be positive to find references; it is " + format_number(eps));
  check_traces(model, traces);
  return Splitter(model, traces, eps).run();
}

namespace {

/// Numbers that no curve or point of a model has.
class FreshReferences {
 public:
  explicit FreshReferences(const Model& model) : known_(!needs_gluing(model)) {
    for (const Face& face : model.faces) {
      for (const FaceCurve& curve : face.curves) {
        curve_ = std::max(curve_, curve.ref);
        point_ = std::max({point_, curve.end1, curve.end2});
      }
      for (const FacePoint& point : face.points) point_ = std::max(point_, point.ref);
    }
  }
  /// 0 if references are unknown.
  int curve() { return known_ ? ++curve_ : 0; }
  int point() { return known_ ? ++point_ : 0; }

 private:
  bool known_;
  int curve_ = 0, point_ = 0;
};

}  // namespace

Model cut_curves(const Model& model, std::span<const CurveCut> cuts) {
  Model result = model;
  FreshReferences fresh(model);
  for (const CurveCut& cut : cuts) {
    std::vector<FaceCurve>& curves = result.faces[cut.face].curves;
    const int whole = host_rank(result.faces[cut.face], cut.curve);
    std::vector<double> ends = cut.t;
    ends.insert(ends.begin(), cut.a);
    ends.push_back(cut.b);
    int inner = 0;  // reference of the end between two parts
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (!(ends[i] < ends[i + 1]))
        throw InvalidArgument(place_of(model, cut.face, cut.curve),
                              "the parameters at which the curve is cut must ascend inside its interval");
      FaceCurve part = model.faces[cut.face].curves[cut.curve];
      part.part_of = whole;
      part.part_a = ends[i];
      part.part_b = ends[i + 1];
      if (i > 0) part.ref = fresh.curve(), part.end1 = inner;
      if (i + 2 < ends.size()) part.end2 = inner = fresh.point();
      if (i == 0) {
        curves[cut.curve] = part;
      } else {
        curves.push_back(part);
      }
    }
  }
  return result;
}

}  // namespace carreau
