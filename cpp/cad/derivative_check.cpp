// SPDX-License-Identifier: BSD-3-Clause
#include "cad/derivative_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

// Steps, as shares of the parameter's range: the first one decides for a sound derivative.
constexpr double coarse = 1e-3, fine = 1e-4;
// Relative. Hosts that approximate their derivatives are not wrong; a missing factor, sign or term is.
constexpr double tolerance = 0.01;
// Derivatives below this share of extent / range are zero.
constexpr double negligible = 1e-3;
// Offset of the second check from a suspicious point; not along a parameter line or a diagonal.
const Vec2 nearby{0.0131, 0.0073};

/// Values along one parameter: up to two functions, each evaluated once at each offset.
class Line {
 public:
  using Values = std::array<Vec3, 2>;
  explicit Line(std::function<Values(double)> sample) : sample_(std::move(sample)) {}
  const Values& at(double offset) {
    const auto it = known_.find(offset);
    return it != known_.end() ? it->second : known_.emplace(offset, sample_(offset)).first->second;
  }

 private:
  std::function<Values(double)> sample_;
  std::map<double, Values> known_;
};

struct Claim {
  const char* name;
  Vec3 given;
  std::size_t slot;  // of Line::Values: the function whose derivative is `given`
};

/// Returns the finite difference if it contradicts the claim; empty if the claim is right or cannot be decided.
/// `scale`: the size that a derivative of this order has when it matters.
std::optional<Vec3> contradiction(const Claim& claim, Line& line, double range, double scale) {
  const auto value = [&](double offset) { return line.at(offset)[claim.slot]; };
  const auto central = [&](double h) -> Vec3 { return (0.5 / h) * (value(h) - value(-h)); };
  const Vec3 first = central(coarse * range);
  const auto off = [&](Vec3 difference, double uncertainty) {
    const double size = std::max({norm(claim.given), norm(difference), negligible * scale});
    // The comparison is written so that infinite and NaN values are not off.
    return norm(claim.given - difference) > std::max(tolerance * size, uncertainty);
  };
  if (!off(first, 0)) return {};
  const double h = fine * range;
  const Vec3 second = central(h);
  // The differences must converge to each other; otherwise they decide nothing.
  const double uncertainty = 5 * norm(first - second);
  if (!off(second, uncertainty)) return {};
  const Vec3 here = value(0);
  if (!off((1 / h) * (value(h) - here), uncertainty) || !off((1 / h) * (here - value(-h)), uncertainty)) return {};
  return second;
}

double shown(double value, double size) {
  if (std::abs(value) < 1e-9 * size || !std::isfinite(value)) return value == value ? 0 : value;
  const double unit = std::pow(10.0, 5 - std::floor(std::log10(std::abs(value))));
  return std::round(value * unit) / unit;
}

// `components`: 3 in space, 2 in the parameter plane. Six digits of a finite difference are enough.
std::string text(const Vec3& v, int components, bool rounded) {
  const double size = norm(v);
  const auto number = [&](double x) { return format_number(rounded ? shown(x, size) : x); };
  return "(" + number(v.x()) + ", " + number(v.y()) + (components == 3 ? ", " + number(v.z()) : "") + ")";
}

WrongDerivative wrong_at(const Where& where, const char* routine, const Claim& claim, const Vec3& found, int components) {
  return {where, std::string(routine) + " gives " + claim.name + " = " + text(claim.given, components, false) +
                     ", but finite differences give " + text(found, components, true)};
}

/// A claim and the criteria for it.
struct Test {
  Claim claim;
  Line& line;
  double range;
  double extent;  // of the function that is differentiated, over the range
};

std::optional<WrongDerivative> first_contradiction(std::span<const Test> tests, const Where& where, const char* routine,
                                                   int components) {
  for (const Test& test : tests)
    if (const std::optional<Vec3> found = contradiction(test.claim, test.line, test.range, test.extent / test.range))
      return wrong_at(where, routine, test.claim, *found, components);
  return {};
}

std::optional<WrongDerivative> test_surface(Cad& cad, int face, Vec2 p, Vec2 range, int order) {
  const auto sample = [&](Vec2 at) {
    const SurfaceJet jet = surface_at(cad, face, order == 1 ? want_position : want_first, at);
    return order == 1 ? Line::Values{jet.s, {}} : Line::Values{jet.su, jet.sv};
  };
  Line along_u([&](double d) { return sample({p.x() + d, p.y()}); });
  Line along_v([&](double d) { return sample({p.x(), p.y() + d}); });
  const SurfaceJet jet = surface_at(cad, face, order == 1 ? want_first : want_second, p);
  const Where where{.face = face, .uv = p};
  if (order == 1) {
    const double extent = norm(jet.su) * range.x() + norm(jet.sv) * range.y();
    const std::array tests{Test{{"Su", jet.su, 0}, along_u, range.x(), extent},
                           Test{{"Sv", jet.sv, 0}, along_v, range.y(), extent}};
    return first_contradiction(tests, where, "surf1", 3);
  }
  const auto size = [](Line& line, double r, std::size_t slot) { return norm(line.at(coarse * r)[slot]); };
  const std::array tests{Test{{"Suu", jet.suu, 0}, along_u, range.x(), size(along_u, range.x(), 0)},
                         Test{{"Suv", jet.suv, 1}, along_u, range.x(), size(along_u, range.x(), 1)},
                         Test{{"Svv", jet.svv, 1}, along_v, range.y(), size(along_v, range.y(), 1)}};
  return first_contradiction(tests, where, "surf2", 3);
}

std::optional<WrongDerivative> test_curve(Cad& cad, int face, int ic, double t, double range, int order) {
  const auto lift = [](Vec2 p) { return Vec3{p.x(), p.y(), 0}; };
  Line line([&](double d) {
    const CurveJet jet = cad.curve(face, ic, order == 1 ? want_position : want_first, t + d);
    return Line::Values{lift(order == 1 ? jet.c : jet.ct), {}};
  });
  const CurveJet jet = cad.curve(face, ic, order == 1 ? want_first : want_second, t);
  const Where where{.face = face, .curve_index = ic, .t = t};
  if (order == 1) {
    const std::array tests{Test{{"Ct", lift(jet.ct), 0}, line, range, norm(jet.ct) * range}};
    return first_contradiction(tests, where, "curv1", 2);
  }
  const std::array tests{Test{{"Ctt", lift(jet.ctt), 0}, line, range, norm(line.at(coarse * range)[0])}};
  return first_contradiction(tests, where, "curv2", 2);
}

/// A host may fail at a single point: the claim is not decided there.
std::optional<WrongDerivative> where_defined(const std::function<std::optional<WrongDerivative>()>& test) {
  try {
    return test();
  } catch (const CallbackError&) {
    return {};
  }
}

/// x moved by `shift` towards the middle of [low, high], then away from the ends by the widest stencil.
double inside(double x, double shift, double low, double high) {
  const double margin = 2 * coarse * (high - low);
  return std::clamp(x < (low + high) / 2 ? x + shift : x - shift, low + margin, high - margin);
}

/// Wrong claims of each order, each also wrong at a place beside: moved(place, beside) is a place inside, test(place, order) the claim there.
template <typename Place, typename Moved, typename Test>
std::vector<WrongDerivative> find_wrong(unsigned gives, bool second, std::span<const Place> places, const Moved& moved, const Test& test) {
  std::vector<WrongDerivative> wrong;
  for (const int order : {1, 2}) {
    const unsigned bit = order == 1 ? want_first : want_second;
    if ((gives & bit) == 0 || (order == 2 && (!second || !wrong.empty()))) continue;
    for (const Place& given : places) {
      const Place p = moved(given, false), other = moved(p, true);
      std::optional<WrongDerivative> found = where_defined([&] { return test(p, order); });
      if (!found || !where_defined([&] { return test(other, order); })) continue;
      wrong.push_back(std::move(*found));
      break;
    }
  }
  return wrong;
}

}  // namespace

std::vector<WrongDerivative> find_wrong_surface_derivatives(Cad& cad, int face, std::span<const Vec2> uv, Vec2 low,
                                                            Vec2 high, bool second) {
  const Vec2 range = high - low;
  const auto moved = [&](const Vec2& p, bool beside) {
    const Vec2 by = beside ? Vec2(nearby.cwiseProduct(range)) : Vec2{0, 0};
    return Vec2{inside(p.x(), by.x(), low.x(), high.x()), inside(p.y(), by.y(), low.y(), high.y())};
  };
  return find_wrong(cad.surface_gives(), second, uv, moved, [&](const Vec2& p, int order) { return test_surface(cad, face, p, range, order); });
}

std::vector<WrongDerivative> find_wrong_curve_derivatives(Cad& cad, int face, int ic, std::span<const double> t,
                                                          Interval range, bool second) {
  const double width = range.b - range.a;
  const auto moved = [&](double p, bool beside) { return inside(p, beside ? nearby.x() * width : 0, range.a, range.b); };
  return find_wrong(cad.curve_gives(), second, t, moved, [&](double p, int order) { return test_curve(cad, face, ic, p, width, order); });
}

}  // namespace carreau
