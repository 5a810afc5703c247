// SPDX-License-Identifier: BSD-3-Clause
#include "curve/prescribed_edges.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "curve/exact_arc.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

/// Fewest edges of a curve that returns to its start: two would lie on each other.
constexpr int min_edges_closed = 3;
/// Share. Ratios of the two uses of a curve that differ by less are equal.
constexpr double same_ratio = 1e-12;

const FaceCurve& face_curve(const CurveModel& model, const CurveUse& use) {
  return model.model.faces[static_cast<std::size_t>(use.face)].curves[static_cast<std::size_t>(use.curve)];
}

// The error does not name the face, because the face would be left out where faces may fail; the curve can be meshed.
[[noreturn]] void refuse(const CurveModel& model, const CurveUse& use, const std::string& why) {
  const Face& face = model.model.faces[static_cast<std::size_t>(use.face)];
  throw InvalidModel(Where{.curve = face_curve(model, use).ref},
                     "the edges prescribed on curve " +
                         std::to_string(host_rank(face, static_cast<std::size_t>(use.curve))) + " of face " +
                         std::to_string(face.ref) + " cannot be made: " + why);
}

double ratio_along_first(const CurveModel& model, const CurveUse& use) {
  const PrescribedEdges& told = *face_curve(model, use).edges;
  if (told.progression == Progression::equal) return 1;
  return use.reversed ? 1 / told.ratio : told.ratio;
}

bool say_the_same(const CurveModel& model, const CurveUse& a, const CurveUse& b) {
  const PrescribedEdges &p = *face_curve(model, a).edges, &q = *face_curve(model, b).edges;
  if (p.progression != q.progression || p.edges != q.edges || p.progression == Progression::given) return false;
  const double r = ratio_along_first(model, a), s = ratio_along_first(model, b);
  return std::abs(r - s) <= same_ratio * r;
}

int prescribing_use(const CurveModel& model, const Curve& curve) {
  int found = -1;
  for (std::size_t u = 0; u < curve.uses.size(); ++u) {
    if (!face_curve(model, curve.uses[u]).edges) continue;
    if (found < 0) {
      found = static_cast<int>(u);
    } else if (const CurveUse& first = curve.uses[static_cast<std::size_t>(found)];
               !say_the_same(model, first, curve.uses[u])) {
      refuse(model, curve.uses[u],
             "others are prescribed on curve " + std::to_string(first.curve + 1) + " of face " +
                 std::to_string(model.face_ref(first)) + ", which is the same curve of space");
    }
  }
  return found;
}

/// The parameters of `given`; on a part of a curve, the parameters inside it.
std::vector<double> given_parameters(const CurveModel& model, const CurveUse& use) {
  const FaceCurve& curve = face_curve(model, use);
  const CurveSupport& support = model.support(use);
  const double a = support.t.front(), b = support.t.back();
  std::vector<double> t{a};
  for (const double at : curve.edges->t) {
    if (curve.part_of != 0 && (at <= a || at >= b)) continue;  // of another part, or its end
    if (!(at > t.back() && at < b))
      refuse(model, use,
             "its parameter " + format_number(at) + " does not lie between " + format_number(t.back()) + " and " +
                 format_number(b));
    t.push_back(at);
  }
  t.push_back(b);
  return t;
}

std::vector<double> parameters_of_progression(const CurveModel& model, const CurveUse& use) {
  const FaceCurve& curve = face_curve(model, use);
  if (curve.part_of != 0)
    refuse(model, use, "curves of other faces end on it and cut it; give all parameters of its vertices");
  const ExactArc arc(model.cad, model.face_ref(use), use.curve + 1, model.support(use).t);
  std::vector<double> t;
  for (const double share : progression_shares(*curve.edges)) t.push_back(arc.t_at(share * arc.length()));
  for (std::size_t k = 1; k < t.size(); ++k)
    if (!(t[k - 1] < t[k])) refuse(model, use, "an edge would be too short for floating-point numbers");
  return t;
}

}  // namespace

std::vector<double> progression_shares(const PrescribedEdges& told) {
  const double n = told.edges, q = told.ratio;
  if (told.edges < 1) throw InvalidArgument("a curve has one edge or more; " + std::to_string(told.edges) + " is not");
  if (!(q > 0) || !std::isfinite(q))
    throw InvalidArgument("the ratio of a progression of edges must be positive; " + format_number(q) + " is not");
  const double l = std::log(q);
  const auto share = [&](double k) {
    if (told.progression == Progression::equal || q == 1 || told.edges == 1) return k / n;
    // Lengths 1 + (q - 1) i / (n - 1), i < n: the sum of k of them over the sum of all.
    if (told.progression == Progression::arithmetic) return (2 * k + (q - 1) * k * (k - 1) / (n - 1)) / (n * (1 + q));
    // (q^k - 1) / (q^n - 1), without overflow.
    if (q > 1) return std::exp((k - n) * l) * (std::expm1(-k * l) / std::expm1(-n * l));
    return std::expm1(k * l) / std::expm1(n * l);
  };
  std::vector<double> shares;
  for (int k = 0; k <= told.edges; ++k) {
    shares.push_back(k == told.edges ? 1 : share(k));
    if (k > 0 && !(shares[static_cast<std::size_t>(k) - 1] < shares.back()))
      throw InvalidArgument("an edge of a progression of ratio " + format_number(q) +
                            " would be too short for floating-point numbers");
  }
  return shares;
}

CurvePrescription prescription_of(const CurveModel& model, int index) {
  const Curve& curve = model.curve(index);
  const int found = prescribing_use(model, curve);
  if (found < 0) return {};
  const CurveUse& use = curve.uses[static_cast<std::size_t>(found)];
  if (curve.degenerate || !(model.length(index) > 0)) refuse(model, use, "the curve is one point of space");
  CurvePrescription result{.use = found, .t = {}};
  result.t = face_curve(model, use).edges->progression == Progression::given ? given_parameters(model, use)
                                                                             : parameters_of_progression(model, use);
  if (curve.end1 == curve.end2 && std::ssize(result.t) <= min_edges_closed)
    refuse(model, use, "a closed curve needs three edges or more");
  if (use.reversed) std::reverse(result.t.begin(), result.t.end());
  return result;
}

}  // namespace carreau
