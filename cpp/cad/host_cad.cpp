// SPDX-License-Identifier: BSD-3-Clause
#include "cad/host_cad.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "cad/checked_cad.h"
#include "support/error.h"
#include "support/infinity.h"
#include "support/pieces.h"

namespace carreau {

namespace {

/// Points of one batch: bounds the memory of the arrays that cross.
constexpr std::size_t batch_size = 4096;

/// A value that a routine does not write must not pass for a result.
const Vec3 nan3{nan, nan, nan};

bool is_unset(const Vec2& v) { return std::isnan(v.x()) && std::isnan(v.y()); }
bool is_unset(const Vec3& v) { return std::isnan(v.x()) && std::isnan(v.y()) && std::isnan(v.z()); }

std::optional<double> answer_of(double value) {
  return value == no_answer ? std::nullopt : std::optional<double>(value);
}

// Other members of `out` may hold results of differences.
void merge(const SurfaceJet& jet, unsigned want, SurfaceJet& out) {
  if ((want & want_position) != 0) out.s = jet.s;
  if ((want & want_first) != 0) out.su = jet.su, out.sv = jet.sv;
  if ((want & want_second) != 0) out.suu = jet.suu, out.suv = jet.suv, out.svv = jet.svv;
}

/// Host by a module cad_m. Only its own routines are called: DifferenceCad ensures this.
class CadMHost : public Cad {
 public:
  explicit CadMHost(const CadMTable& table) : table_(table) {}

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    for (std::size_t i = 0; i < uv.size(); ++i) {
      SurfaceJet jet{nan3, nan3, nan3, nan3, nan3, nan3};
      const double p[2] = {uv[i].x(), uv[i].y()};
      if ((want & want_position) != 0) table_.surf0(&face, p, &jet.s.x());
      if ((want & want_first) != 0) table_.surf1(&face, p, &jet.su.x(), &jet.sv.x());
      if ((want & want_second) != 0) table_.surf2(&face, p, &jet.suu.x(), &jet.suv.x(), &jet.svv.x());
      merge(jet, want, out[i]);
    }
    counter_.add_surface(want, uv.size());
  }
  Interval curve_interval(int face, int ic) override {
    Interval interval{nan, nan};
    table_.curv_int(&face, &ic, &interval.a, &interval.b);
    return interval;
  }
  CurveJet curve(int face, int ic, unsigned want, double t) override {
    CurveJet jet{{nan, nan}, {nan, nan}, {nan, nan}};
    if ((want & want_position) != 0) table_.curv0(&face, &ic, &t, &jet.c.x());
    if ((want & want_first) != 0) table_.curv1(&face, &ic, &t, &jet.ct.x());
    if ((want & want_second) != 0) table_.curv2(&face, &ic, &t, &jet.ctt.x());
    counter_.add_curve(want);
    return jet;
  }
  std::optional<double> surface_size(int face, Vec2 uv) override { return on_surface(table_.cad_hphys, face, uv); }
  std::optional<double> curve_size(int face, int ic, double t) override {
    return on_curve(table_.cad_hphyc, face, ic, t);
  }
  std::optional<double> point_size(int point) override {
    if (table_.cad_hphyp == nullptr) return {};
    counter_.add_size();
    double h = no_answer;
    table_.cad_hphyp(&point, &h);
    return answer_of(h);
  }
  std::optional<double> surface_radius(int face, Vec2 uv) override { return on_surface(table_.cad_rads, face, uv); }
  std::optional<double> curve_radius(int face, int ic, double t) override {
    return on_curve(table_.cad_radc, face, ic, t);
  }
  [[nodiscard]] CallCounts counts() const noexcept override { return counter_.counts(); }

 private:
  std::optional<double> on_surface(decltype(CadMTable::cad_hphys) routine, int face, Vec2 uv) {
    if (routine == nullptr) return {};
    counter_.add_size();
    double value = no_answer;
    const double p[2] = {uv.x(), uv.y()};
    routine(&face, p, &value);
    return answer_of(value);
  }
  std::optional<double> on_curve(decltype(CadMTable::cad_hphyc) routine, int face, int ic, double t) {
    if (routine == nullptr) return {};
    counter_.add_size();
    double value = no_answer;
    routine(&face, &ic, &t, &value);
    return answer_of(value);
  }

  CadMTable table_;
  CallCounter counter_;
};

/// Host by C callbacks.
class CHost : public Cad {
 public:
  explicit CHost(const HostTable& table) : table_(table) {}

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    counter_.add_surface(want, uv.size());
    if (table_.surface_batch != nullptr) {
      for_pieces(uv.size(), batch_size, [&](std::size_t first, std::size_t n) {
        batch(face, want, uv.subspan(first, n), out.subspan(first, n));
      });
      return;
    }
    for (std::size_t i = 0; i < uv.size(); ++i) {
      SurfaceJet jet{nan3, nan3, nan3, nan3, nan3, nan3};
      check_status(table_.surface(face, uv[i].x(), uv[i].y(), order_of(want), &jet.s.x(), &jet.su.x(), &jet.sv.x(), &jet.suu.x(),
                                  &jet.suv.x(), &jet.svv.x(), table_.user),
                   {.face = face, .uv = uv[i]}, "surface");
      check_written(jet, want, {.face = face, .uv = uv[i]}, "surface");
      merge(jet, want, out[i]);
    }
  }
  Interval curve_interval(int face, int ic) override {
    Interval interval{nan, nan};
    check_status(table_.curve_interval(face, ic, &interval.a, &interval.b, table_.user),
                 {.face = face, .curve_index = ic}, "curve_interval");
    return interval;
  }
  CurveJet curve(int face, int ic, unsigned want, double t) override {
    counter_.add_curve(want);
    CurveJet jet{{nan, nan}, {nan, nan}, {nan, nan}};
    check_status(table_.curve(face, ic, t, order_of(want), &jet.c.x(), &jet.ct.x(), &jet.ctt.x(), table_.user),
                 {.face = face, .curve_index = ic, .t = t}, "curve");
    if (!is_unset(jet.c)) {
      const Where where{.face = face, .curve_index = ic, .t = t};
      if ((want & want_first) != 0 && is_unset(jet.ct)) fail_order(where, "curve", 1);
      if ((want & want_second) != 0 && is_unset(jet.ctt)) fail_order(where, "curve", 2);
    }
    return jet;
  }
  std::optional<double> surface_size(int face, Vec2 uv) override {
    return on_surface(table_.surface_size, face, uv, "surface_size");
  }
  std::optional<double> curve_size(int face, int ic, double t) override {
    return on_curve(table_.curve_size, face, ic, t, "curve_size");
  }
  std::optional<double> point_size(int point) override {
    if (table_.point_size == nullptr) return {};
    counter_.add_size();
    double value = no_answer;
    const std::int32_t status = table_.point_size(point, &value, table_.user);
    return answer(status, value, {.point = point}, "point_size");
  }
  std::optional<double> surface_radius(int face, Vec2 uv) override {
    return on_surface(table_.surface_radius, face, uv, "surface_radius");
  }
  std::optional<double> curve_radius(int face, int ic, double t) override {
    return on_curve(table_.curve_radius, face, ic, t, "curve_radius");
  }
  [[nodiscard]] bool reentrant() const noexcept override { return table_.reentrant != 0; }
  [[nodiscard]] CallCounts counts() const noexcept override { return counter_.counts(); }

 private:
  static std::int32_t order_of(unsigned want) {
    return (want & want_second) != 0 ? 2 : (want & want_first) != 0 ? 1 : 0;
  }

  void batch(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
    const std::size_t n = uv.size();
    const std::int32_t order = order_of(want);
    const std::size_t arrays = order == 0 ? 1 : order == 1 ? 3 : 6;
    constexpr std::size_t few = 4;  // without memory of their own
    std::array<double, 20 * few> room;
    std::vector<double> large;
    if (n > few) large.resize((2 + 3 * arrays) * n);
    double* const points = n > few ? large.data() : room.data();
    double* const values = points + 2 * n;
    std::fill_n(values, 3 * n * arrays, nan);
    for (std::size_t i = 0; i < n; ++i) points[2 * i] = uv[i].x(), points[2 * i + 1] = uv[i].y();
    const auto array = [&](std::size_t k) { return k < arrays ? values + 3 * n * k : nullptr; };
    const std::int32_t status = table_.surface_batch(face, static_cast<std::int64_t>(n), points, order, array(0),
                                                     array(1), array(2), array(3), array(4), array(5), table_.user);
    if (status != 0)
      fail(status, {.face = face, .uv = uv.front()}, "surface_batch",
           " for " + std::to_string(n) + " points, of which this is the first");
    const auto vector = [&](std::size_t k, std::size_t i) {
      const double* const v = array(k);
      return v != nullptr ? Vec3{v[3 * i], v[3 * i + 1], v[3 * i + 2]} : Vec3{};
    };
    for (std::size_t i = 0; i < n; ++i) {
      const SurfaceJet jet{vector(0, i), vector(1, i), vector(2, i), vector(3, i), vector(4, i), vector(5, i)};
      check_written(jet, want, {.face = face, .uv = uv[i]}, "surface_batch");
      merge(jet, want, out[i]);
    }
  }

  [[noreturn]] void fail(std::int32_t status, const Where& where, const char* callback, const std::string& more) const {
    const char* const why =
        table_.failure != nullptr && where.face != 0 ? table_.failure(where.face, table_.user) : nullptr;
    throw CallbackError(where, std::string("the callback ") + callback + " returned the status " +
                                   std::to_string(status) + more +
                                   (why != nullptr && *why != '\0' ? " (" + std::string(why) + ")" : ""));
  }
  /// A host with points alone often does not declare it: a registration may have other orders by default.
  static void check_written(const SurfaceJet& jet, unsigned want, const Where& where, const char* callback) {
    if ((want & want_position) != 0 && is_unset(jet.s)) return;  // nothing was written at all
    if ((want & want_first) != 0 && is_unset(jet.su) && is_unset(jet.sv)) fail_order(where, callback, 1);
    if ((want & want_second) != 0 && is_unset(jet.suu) && is_unset(jet.suv) && is_unset(jet.svv))
      fail_order(where, callback, 2);
  }
  [[noreturn]] static void fail_order(const Where& where, const char* callback, int order) {
    const std::string name = std::string(callback).starts_with("surface") ? "surface_order" : "curve_order";
    throw CallbackError(where, std::string("the callback ") + callback + " gave no " +
                                   (order == 1 ? "first" : "second") + " derivatives: if it has none, " + name +
                                   " must be " + std::to_string(order - 1));
  }
  void check_status(std::int32_t status, const Where& where, const char* callback) const {
    if (status != 0) fail(status, where, callback, "");
  }

  std::optional<double> answer(std::int32_t status, double value, const Where& where, const char* callback) const {
    if (status == no_answer_status) return {};
    check_status(status, where, callback);
    return answer_of(value);
  }
  std::optional<double> on_surface(decltype(HostTable::surface_size) callback, int face, Vec2 uv, const char* name) {
    if (callback == nullptr) return {};
    counter_.add_size();
    double value = no_answer;
    const std::int32_t status = callback(face, uv.x(), uv.y(), &value, table_.user);
    return answer(status, value, {.face = face, .uv = uv}, name);
  }
  std::optional<double> on_curve(decltype(HostTable::curve_size) callback, int face, int ic, double t,
                                 const char* name) {
    if (callback == nullptr) return {};
    counter_.add_size();
    double value = no_answer;
    const std::int32_t status = callback(face, ic, t, &value, table_.user);
    return answer(status, value, {.face = face, .curve_index = ic, .t = t}, name);
  }

  HostTable table_;
  CallCounter counter_;
};

constexpr unsigned bits_up_to(std::int32_t order) {
  return want_position | (order >= 1 ? want_first : 0U) | (order >= 2 ? want_second : 0U);
}

void require(bool given, const char* name) {
  if (!given) throw InvalidArgument(std::string("the routine ") + name + " is missing: geometry needs it");
}

std::unique_ptr<Cad> host_of(const CadMTable& table) {
  require(table.surf0 != nullptr, "surf0");
  require(table.curv_int != nullptr, "curv_int");
  require(table.curv0 != nullptr, "curv0");
  return std::make_unique<CadMHost>(table);
}

void check_order(std::int32_t order, const char* name) {
  if (order < 0 || order > 2)
    throw InvalidArgument(std::string(name) + " must be 0, 1 or 2; it is " + std::to_string(order));
}

std::unique_ptr<Cad> host_of(const HostTable& table) {
  require(table.surface != nullptr || table.surface_batch != nullptr, "surface (or surface_batch)");
  require(table.curve_interval != nullptr, "curve_interval");
  require(table.curve != nullptr, "curve");
  check_order(table.surface_order, "surface_order");
  check_order(table.curve_order, "curve_order");
  return std::make_unique<CHost>(table);
}

}  // namespace

HostCad::HostCad(const CadMTable& table)
    : DifferenceCad(
          host_of(table),
          want_position | (table.surf1 != nullptr ? want_first : 0U) | (table.surf2 != nullptr ? want_second : 0U),
          want_position | (table.curv1 != nullptr ? want_first : 0U) | (table.curv2 != nullptr ? want_second : 0U)) {}

HostCad::HostCad(const HostTable& table)
    : DifferenceCad(host_of(table), bits_up_to(table.surface_order), bits_up_to(table.curve_order)) {}

}  // namespace carreau
