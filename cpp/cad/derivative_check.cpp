#include "cad/derivative_check.h"

#include <algorithm>
#include <functional>

#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr double steps[] = {1e-3, 1e-4};  // of the parameter's range
constexpr double disagreement = 0.02;     // relative: far above truncation and rounding, far below a factor or a sign
constexpr double agreement = 0.004;       // of the two differences with each other

std::string text(Vec3 v) {
  return "(" + format_number(v.x) + ", " + format_number(v.y) + ", " + format_number(v.z) + ")";
}

// `value(step)` is a central difference with that step; `scale` the size of what is differentiated over the whole
// range.
bool is_wrong(Vec3 given, double range, double scale, const std::function<Vec3(double)>& difference, Vec3& found) {
  const Vec3 coarse = difference(steps[0] * range), fine = difference(steps[1] * range);
  const double size = std::max({norm(fine), norm(given), 1e-6 * scale / range});
  if (norm(coarse - fine) > agreement * size) return false;
  found = fine;
  return norm(given - fine) > disagreement * size;
}

}  // namespace

std::vector<std::string> find_wrong_surface_derivatives(Cad& cad, int face, std::span<const Vec2> uv, Vec2 low,
                                                        Vec2 high, bool second) {
  std::vector<std::string> wrong;
  const Vec2 range = high - low;
  bool alarmed[2] = {false, false};
  for (const Vec2 p : uv) {
    // Points whose stencil would leave the box say nothing.
    if (p.x - steps[0] * range.x < low.x || p.x + steps[0] * range.x > high.x || p.y - steps[0] * range.y < low.y ||
        p.y + steps[0] * range.y > high.y)
      continue;
    const SurfaceJet jet = surface_at(cad, face, want_position | want_first | (second ? want_second : 0U), p);
    const auto at = [&](double du, double dv, unsigned want) {
      return surface_at(cad, face, want, {p.x + du, p.y + dv});
    };
    const double scale = norm(jet.su) * range.x + norm(jet.sv) * range.y;
    const auto test = [&](int order, const char* routine, const char* name, Vec3 given, double width,
                          const std::function<Vec3(double)>& difference) {
      Vec3 found;
      if (alarmed[order - 1] ||
          !is_wrong(given, width, order == 1 ? scale : scale / std::min(range.x, range.y), difference, found))
        return;
      alarmed[order - 1] = true;
      wrong.push_back(Where{.face = face, .uv = p}.prefix() + routine + " gives " + name + " = " + text(given) +
                      ", finite differences give " + text(found));
    };
    test(1, "surf1", "Su", jet.su, range.x,
         [&](double h) { return (0.5 / h) * (at(h, 0, want_position).s - at(-h, 0, want_position).s); });
    test(1, "surf1", "Sv", jet.sv, range.y,
         [&](double h) { return (0.5 / h) * (at(0, h, want_position).s - at(0, -h, want_position).s); });
    if (!second || alarmed[0]) continue;
    test(2, "surf2", "Suu", jet.suu, range.x,
         [&](double h) { return (0.5 / h) * (at(h, 0, want_first).su - at(-h, 0, want_first).su); });
    test(2, "surf2", "Suv", jet.suv, range.y,
         [&](double h) { return (0.5 / h) * (at(0, h, want_first).su - at(0, -h, want_first).su); });
    test(2, "surf2", "Svv", jet.svv, range.y,
         [&](double h) { return (0.5 / h) * (at(0, h, want_first).sv - at(0, -h, want_first).sv); });
  }
  return wrong;
}

std::vector<std::string> find_wrong_curve_derivatives(Cad& cad, int face, int ic, std::span<const double> t,
                                                      Interval range, bool second) {
  std::vector<std::string> wrong;
  const double width = range.b - range.a;
  const auto lift = [](Vec2 p) { return Vec3{p.x, p.y, 0}; };
  bool alarmed = false;
  for (const double at : t) {
    if (at - steps[0] * width < range.a || at + steps[0] * width > range.b || alarmed) continue;
    const CurveJet jet = cad.curve(face, ic, want_position | want_first | (second ? want_second : 0U), at);
    const double scale = norm(jet.ct) * width;
    const auto test = [&](const char* routine, const char* name, Vec2 given, double size,
                          const std::function<Vec3(double)>& difference) {
      Vec3 found;
      if (alarmed || !is_wrong(lift(given), width, size, difference, found)) return;
      alarmed = true;
      wrong.push_back(Where{.face = face, .curve_index = ic, .t = at}.prefix() + routine + " gives " + name + " = (" +
                      format_number(given.x) + ", " + format_number(given.y) + "), finite differences give (" +
                      format_number(found.x) + ", " + format_number(found.y) + ")");
    };
    test("curv1", "Ct", jet.ct, scale, [&](double h) {
      return lift((0.5 / h) *
                  (cad.curve(face, ic, want_position, at + h).c - cad.curve(face, ic, want_position, at - h).c));
    });
    if (second)
      test("curv2", "Ctt", jet.ctt, scale / width, [&](double h) {
        return lift((0.5 / h) *
                    (cad.curve(face, ic, want_first, at + h).ct - cad.curve(face, ic, want_first, at - h).ct));
      });
  }
  return wrong;
}

}  // namespace carreau
