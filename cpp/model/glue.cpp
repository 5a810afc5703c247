// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "model/near_points.h"
#include "model/places.h"
#include "model/topology.h"
#include "model/traces.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

// Tolerance inside one face (eps_glue_face) against tolerance between faces: HDR sec. 4.5.1 recommends eps_1 = 1e-5 and
// eps_2 = 1e-2. The opposite sides of a narrow face must not become one; a seam is exact.
constexpr double inside_share = 1e-3;
// ... in the precision of files: numbers of ten digits, as a share of the model's diagonal.
constexpr double rounding_of_files = 1e-9;
// Ends farther apart than this share of eps_glue are not one by rounding only.
constexpr double rounding_share = 1e-3;
// Open curves that are one may be apart by this share of their length. A smaller share would miss the gaps of a file's
// coarse edges beside its shortest ones; a larger share would close slits.
constexpr double open_share = 0.1;

struct Entry {
  std::size_t face, curve;
  std::span<const Vec3> trace;
};

class Gluer {
 public:
  Gluer(const Model& model, const CurveTraces& traces, double eps, double eps_open, double eps_face,
        std::vector<std::string>* remarks, GlueReport* report)
      : model_(model),
        eps_(eps),
        eps_open_(eps_open),
        remarks_(remarks),
        report_(report),
        entries_(entries_of(model, traces)),
        known_(!needs_gluing(model)),
        points_(2 * entries_.size()),
        curves_(entries_.size()),
        eps_inside_(eps_face > 0
                        ? eps_face
                        : std::max(inside_share * eps, std::min(eps, rounding_of_files * traces_diagonal(traces)))) {
    const std::vector<std::vector<char>> free = curves_to_glue(model);
    for (const Entry& entry : entries_) takes_part_.push_back(free[entry.face][entry.curve]);
  }

  Model run() {
    if (known_) merge_what_is_known();
    merge_near_ends();
    for (std::size_t k = 0; k < entries_.size(); ++k)
      if (takes_part_[k] != 0) merge_ends(k);
    for (const auto& [ends, same_ends] : by_ends_) merge_nearest_first(same_ends);
    if (eps_open_ > eps_) merge_what_is_open();
    if (report_ != nullptr) sort_pairs();
    if (report_ != nullptr) list_open_curves();
    return numbered();
  }

 private:
  static std::vector<Entry> entries_of(const Model& model, const CurveTraces& traces) {
    std::vector<Entry> entries;
    for (std::size_t f = 0; f < model.faces.size(); ++f)
      for (std::size_t c = 0; c < model.faces[f].curves.size(); ++c) entries.push_back({f, c, traces[f][c]});
    return entries;
  }

  [[nodiscard]] const FaceCurve& given(std::size_t k) const {
    return model_.faces[entries_[k].face].curves[entries_[k].curve];
  }
  /// Given reference of end 2 k or 2 k + 1 of entry k.
  [[nodiscard]] int given_end(std::size_t end) const {
    return end % 2 == 0 ? given(end / 2).end1 : given(end / 2).end2;
  }

  void merge_what_is_known() {
    std::map<int, std::size_t> first_curve, first_end;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      curves_.merge(first_curve.try_emplace(given(k).ref, k).first->second, k);
      for (const std::size_t end : {2 * k, 2 * k + 1})
        points_.merge(first_end.try_emplace(given_end(end), end).first->second, end);
    }
  }

  void merge_near_ends() {
    std::vector<Vec3> ends;
    std::vector<std::size_t> number;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      if (takes_part_[k] == 0) continue;
      ends.push_back(entries_[k].trace.front());
      ends.push_back(entries_[k].trace.back());
      number.push_back(2 * k);
      number.push_back(2 * k + 1);
    }
    UnionFind near(ends.size());
    merge_near_points(ends, eps_, near);
    for (std::size_t i = 0; i < ends.size(); ++i) points_.merge(number[near.find(i)], number[i]);
  }

  void merge_ends(std::size_t k) {
    const Entry& entry = entries_[k];
    const double gap = norm(entry.trace.back() - entry.trace.front());
    if (trace_extent(entry.trace) < eps_) {
      // One point of space, but a separate curve: it is not subdivided, and each face has its own copy (HDR sec.
      // 4.5.4).
      points_.merge(2 * k, 2 * k + 1);
      if (const double length = trace_length(entry.trace); length > rounding_share * eps_)
        remark(k, "the whole curve, " + format_number(length) +
                      " long, is nearer to a point than eps_glue = " + format_number(eps_) + " and becomes one");
      return;
    }
    const std::size_t p = points_.find(2 * k), q = points_.find(2 * k + 1);
    const bool said = known_ && given(k).end1 == given(k).end2;
    if (p == q && !said && gap > rounding_share * eps_)
      remark(k, "its ends are " + format_number(gap) + " apart, which is less than eps_glue = " + format_number(eps_) +
                    " or bridged by other points, and become one point");
    by_ends_[std::minmax(p, q)].push_back(k);
  }

  /// Two curves that may be one.
  struct Candidate {
    double gap;
    std::size_t first, second;  // entries
    auto operator<=>(const Candidate&) const = default;
  };

  // The nearest first, so that neither the order of the faces decides nor one side of a narrow face takes the place of
  // the other. A near B and B near C makes one curve of the three.
  void merge_nearest_first(const std::vector<std::size_t>& same_ends) {
    std::vector<Candidate> pairs;
    for (std::size_t i = 0; i < same_ends.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (const std::optional<double> gap = gap_if_one(entries_[same_ends[j]], entries_[same_ends[i]]))
          pairs.push_back({*gap, same_ends[j], same_ends[i]});
    std::sort(pairs.begin(), pairs.end());
    for (const Candidate& pair : pairs) {
      if (curves_.find(pair.first) == curves_.find(pair.second) || sides_are_apart(pair, same_ends)) continue;
      curves_.merge(pair.first, pair.second);
      const Entry &o = entries_[pair.first], &e = entries_[pair.second];
      if (report_ != nullptr) report_->pairs.push_back({{o.face, o.curve}, {e.face, e.curve}, pair.gap});
    }
  }

  /// True if a pair would unite two sides of one face that are not a seam.
  [[nodiscard]] bool sides_are_apart(const Candidate& pair, const std::vector<std::size_t>& same_ends) {
    const std::size_t p = curves_.find(pair.first), q = curves_.find(pair.second);
    for (const std::size_t a : same_ends)
      for (const std::size_t b : same_ends)
        if (entries_[a].face == entries_[b].face && curves_.find(a) == p && curves_.find(b) == q &&
            !gap_if_one(entries_[a], entries_[b]))
          return true;
    return false;
  }

  [[nodiscard]] bool is_boundary(const Entry& e) const {
    return model_.faces[e.face].curves[e.curve].type == CurveType::boundary;
  }

  /// The distance of two curves that are one, less the distances of their polylines from the curves.
  [[nodiscard]] std::optional<double> gap_if_one(const Entry& a, const Entry& b) const {
    const bool sides = a.face == b.face;
    if (sides && (!is_boundary(a) || !is_boundary(b))) return {};  // a seam is made of two sides
    const double loose = trace_deviation(a.trace) + trace_deviation(b.trace);
    const double tolerance = (sides ? eps_inside_ : eps_) + loose;
    const double gap = hausdorff_distance(a.trace, b.trace, tolerance);
    return gap < tolerance ? std::optional(std::max(gap - loose, 0.0)) : std::nullopt;
  }

  /// Entries that are boundary curves, no points, and that no other entry is one with.
  [[nodiscard]] std::vector<std::size_t> open_entries() {
    std::vector<int> uses(entries_.size(), 0);
    for (std::size_t k = 0; k < entries_.size(); ++k) ++uses[curves_.find(k)];
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < entries_.size(); ++k)
      if (uses[curves_.find(k)] == 1 && is_boundary(entries_[k]) && !(trace_extent(entries_[k].trace) < eps_) &&
          !(is_cut_off(k) && points_.find(2 * k) == points_.find(2 * k + 1)))
        open.push_back(k);
    return open;
  }

  // The nearest first, and each of them once.
  void merge_what_is_open() {
    std::vector<std::pair<double, std::size_t>> by_x;  // smallest x of both ends
    for (const std::size_t k : open_entries())
      if (takes_part_[k] != 0) by_x.emplace_back(std::min(entries_[k].trace.front().x(), entries_[k].trace.back().x()), k);
    std::sort(by_x.begin(), by_x.end());
    std::vector<Candidate> pairs;
    for (std::size_t i = 0; i < by_x.size(); ++i)
      for (std::size_t j = i + 1; j < by_x.size() && by_x[j].first - by_x[i].first < eps_open_; ++j) {
        const auto [first, second] = std::minmax(by_x[i].second, by_x[j].second);
        if (const std::optional<double> gap = gap_if_open_ones_meet(entries_[first], entries_[second]))
          pairs.push_back({*gap, first, second});
      }
    std::sort(pairs.begin(), pairs.end());
    if (!pairs.empty()) list_curves_at_points();
    std::vector<char> taken(entries_.size(), 0);
    for (const Candidate& pair : pairs) {
      const auto [gap, first, second] = pair;
      if (taken[first] != 0 || taken[second] != 0 || !merge_ends_of(pair)) continue;
      taken[first] = taken[second] = 1;
      curves_.merge(first, second);
      const Entry &o = entries_[first], &e = entries_[second];
      if (report_ != nullptr) report_->pairs.push_back({{o.face, o.curve}, {e.face, e.curve}, gap});
    }
  }

  /// True if the curves have opposite directions: the end of a is at the start of b.
  static bool runs_against(const Entry& a, const Entry& b) {
    const Vec3 p = a.trace.front(), q = a.trace.back(), r = b.trace.front(), s = b.trace.back();
    return std::max(norm(p - s), norm(q - r)) < std::max(norm(p - r), norm(q - s));
  }

  /// The distance of two open curves of different faces, if their own distance and the distance of their ends are
  /// within eps_open and a share of their lengths.
  [[nodiscard]] std::optional<double> gap_if_open_ones_meet(const Entry& a, const Entry& b) const {
    if (a.face == b.face) return {};  // a slit
    const double limit = std::min(eps_open_, open_share * std::min(trace_length(a.trace), trace_length(b.trace)));
    const bool against = runs_against(a, b);
    const double at_ends = std::max(norm(a.trace.front() - (against ? b.trace.back() : b.trace.front())),
                                    norm(a.trace.back() - (against ? b.trace.front() : b.trace.back())));
    if (!(at_ends < limit)) return {};
    const double loose = trace_deviation(a.trace) + trace_deviation(b.trace);
    const double gap = hausdorff_distance(a.trace, b.trace, limit + loose);
    return gap < limit + loose ? std::optional(std::max({gap - loose, at_ends, 0.0})) : std::nullopt;
  }

  /// A piece of a curve that is no longer than the tolerance of ends: a gap along the curve has cut it off.
  [[nodiscard]] bool is_cut_off(std::size_t k) const {
    return given(k).part_of != 0 && trace_length(entries_[k].trace) < eps_open_;
  }

  /// Lists, for each set of points, the curves that join it to another set and may not become loops.
  void list_curves_at_points() {
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      const std::size_t p = points_.find(2 * k), q = points_.find(2 * k + 1);
      if (p == q || is_cut_off(k)) continue;
      at_point_[p].push_back(k);
      at_point_[q].push_back(k);
    }
  }

  /// Merges the ends of two curves, unless the two ends of a curve of the host would become one.
  bool merge_ends_of(const Candidate& pair) {
    const std::size_t against = runs_against(entries_[pair.first], entries_[pair.second]) ? 1 : 0;
    const std::array<std::array<std::size_t, 2>, 2> ends{
        {{points_.find(2 * pair.first), points_.find(2 * pair.second + against)},
         {points_.find(2 * pair.first + 1), points_.find(2 * pair.second + 1 - against)}}};
    const auto is_of = [&](std::size_t point, std::size_t one) {
      return point == ends[one][0] || point == ends[one][1];
    };
    const bool all_one = is_of(ends[0][0], 1) || is_of(ends[0][1], 1);
    const auto become_one = [&](std::size_t p, std::size_t q) {
      if (all_one) return (is_of(p, 0) || is_of(p, 1)) && (is_of(q, 0) || is_of(q, 1));
      return (is_of(p, 0) && is_of(q, 0)) || (is_of(p, 1) && is_of(q, 1));
    };
    for (const auto& two : ends)
      for (const std::size_t point : two)
        for (const std::size_t k : at_point_[point]) {
          const std::size_t p = points_.find(2 * k), q = points_.find(2 * k + 1);
          if (p != q && become_one(p, q)) return false;
        }
    for (const auto& [p, q] : ends) merge_points(p, q);
    return true;
  }

  void merge_points(std::size_t p, std::size_t q) {
    p = points_.find(p), q = points_.find(q);
    if (p == q) return;
    std::vector<std::size_t> of_p = std::move(at_point_[p]), of_q = std::move(at_point_[q]);
    if (of_p.size() < of_q.size()) of_p.swap(of_q);
    of_p.insert(of_p.end(), of_q.begin(), of_q.end());
    points_.merge(p, q);
    at_point_[points_.find(p)] = std::move(of_p);
  }

  void sort_pairs() {
    std::sort(report_->pairs.begin(), report_->pairs.end(), [](const GlueReport::Pair& p, const GlueReport::Pair& q) {
      return std::tie(p.b.face, p.b.curve, p.a.face, p.a.curve) < std::tie(q.b.face, q.b.curve, q.a.face, q.a.curve);
    });
  }

  void list_open_curves() {
    for (const std::size_t k : open_entries()) report_->open.push_back({entries_[k].face, entries_[k].curve});
  }

  // The numbering of HDR fig. 4.18: curve k (from 1) has the ends 2 k - 1 and 2 k; sets take their smallest number.
  // A set with references takes the reference of its first member.
  Model numbered() {
    Model glued = model_;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      FaceCurve& curve = glued.faces[entries_[k].face].curves[entries_[k].curve];
      const std::size_t same = curves_.find(k), end1 = points_.find(2 * k), end2 = points_.find(2 * k + 1);
      curve.ref = known_ ? given(same).ref : static_cast<int>(same) + 1;
      curve.end1 = known_ ? given_end(end1) : static_cast<int>(end1) + 1;
      curve.end2 = known_ ? given_end(end2) : static_cast<int>(end2) + 1;
    }
    return glued;
  }

  void remark(std::size_t k, const std::string& sentence) {
    if (remarks_ == nullptr) return;
    const Entry& entry = entries_[k];
    remarks_->push_back(place_of(model_, entry.face, entry.curve).prefix() + sentence);
  }

  const Model& model_;
  double eps_, eps_open_;
  std::vector<std::string>* remarks_;
  GlueReport* report_;
  std::vector<Entry> entries_;
  bool known_;  // the model has references
  std::vector<char> takes_part_;
  UnionFind points_, curves_;
  std::map<std::size_t, std::vector<std::size_t>> at_point_;
  double eps_inside_;  // between two sides of one face
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> by_ends_;
};

}  // namespace

const FaceCurve* first_curve(const Model& model) {
  for (const Face& face : model.faces)
    if (face.left_out.empty()) return face.curves.empty() ? nullptr : &face.curves.front();
  return nullptr;
}

bool needs_gluing(const Model& model) {
  const FaceCurve* const first = first_curve(model);
  return first != nullptr && first->ref == 0;
}

std::size_t references_to_forget(const Model& model) {
  if (!needs_gluing(model)) return 0;
  std::size_t count = 0;
  for (const Face& face : model.faces)
    count += static_cast<std::size_t>(std::ranges::count_if(
        face.curves, [](const FaceCurve& c) { return c.ref != 0 || c.end1 != 0 || c.end2 != 0; }));
  return count;
}

std::vector<std::vector<char>> curves_to_glue(const Model& model) {
  const bool known = !needs_gluing(model);
  std::map<int, int> uses;
  for (const Face& face : model.faces)
    for (const FaceCurve& curve : face.curves) ++uses[curve.ref];
  std::vector<std::vector<char>> free;
  for (const Face& face : model.faces) {
    auto& of_face = free.emplace_back();
    for (const FaceCurve& curve : face.curves)
      of_face.push_back(!known || (curve.type == CurveType::boundary && uses[curve.ref] == 1) ? 1 : 0);
  }
  return free;
}

Model glue(const Model& model, const CurveTraces& traces, double eps_glue, std::vector<std::string>* remarks,
           GlueReport* report, double eps_open, double eps_face) {
  if (!(eps_glue > 0) || !std::isfinite(eps_glue))
    throw InvalidArgument("eps_glue must be positive to find references; it is " + format_number(eps_glue));
  if (!(eps_open >= 0) || !std::isfinite(eps_open))
    throw InvalidArgument("eps_glue_open must not be negative; it is " + format_number(eps_open));
  if (!(eps_face >= 0) || !std::isfinite(eps_face))
    throw InvalidArgument("eps_glue_face must not be negative; it is " + format_number(eps_face));
  check_traces(model, traces);
  return Gluer(model, traces, eps_glue, eps_open, eps_face, remarks, report).run();
}

}  // namespace carreau
