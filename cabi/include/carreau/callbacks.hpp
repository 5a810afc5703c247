// SPDX-License-Identifier: BSD-3-Clause
/// Geometry, sizes and metrics by std::function: see carreau.hpp.
#ifndef CARREAU_CALLBACKS_HPP
#define CARREAU_CALLBACKS_HPP

#include "error.hpp"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>

namespace carreau {

// ---- Geometry, sizes and metrics by callbacks ----

/// S(u, v) and its derivatives, model length. A callback fills them up to the requested order.
struct SurfacePoint {
  Point3 s{}, su{}, sv{}, suu{}, suv{}, svv{};
};
/// S(u, v) and its derivatives at the points of a batch, a row for each (u, v); spans above the order are empty.
struct SurfaceRows {
  std::span<Point3> s, su, sv, suu, suv, svv;
};
/// C(t) in the parameter plane and its derivatives.
struct CurvePoint {
  Point2 c{}, ct{}, ctt{};
};
/// The parameters of a curve, a < b.
struct Interval {
  double a, b;
};

/// The callbacks of carreau_cad. `face` is the reference of a face, `ic` the rank of a curve in it, from 1. An exception ends the
/// run; std::nullopt does not answer. Data that callbacks use must live as long as the session and its meshes.
struct Geometry {
  int surface_order = 0;  ///< order that `surface` and `surface_batch` can give: 0, 1 or 2; the rest is found by finite
                          ///< differences
  int curve_order = 0;    ///< order that `curve` can give
  bool reentrant = false; ///< true: callbacks may come from several threads at a time
  std::function<SurfacePoint(int face, double u, double v, int order)> surface{}; ///< needed, unless surface_batch is given
  std::function<void(int face, std::span<const Point2> uv, int order, const SurfaceRows& out)> surface_batch{};
  std::function<Interval(int face, int ic)> curve_interval{};                      ///< needed
  std::function<CurvePoint(int face, int ic, double t, int order)> curve{};        ///< needed
  std::function<std::optional<double>(int face, double u, double v)> surface_size{}; ///< model length; with hphy_flag = 2
  std::function<std::optional<double>(int face, int ic, double t)> curve_size{};
  std::function<std::optional<double>(int point)> point_size{};
  std::function<std::optional<double>(int face, double u, double v)> surface_radius{}; ///< model length; with hgeo_flag = 2
  std::function<std::optional<double>(int face, int ic, double t)> curve_radius{};
};

/// The answer of a metric callback: one of CARREAU_METRIC_... and its values.
struct Prescription {
  std::int32_t kind = CARREAU_METRIC_NONE;
  std::array<double, 6> value{};

  /// No answer.
  static Prescription none() { return {}; }
  /// The same size in all directions, a model length.
  static Prescription size(double h) { return {CARREAU_METRIC_SIZE, {h}}; }
  /// A positive definite tensor.
  static Prescription space(const Tensor3& metric) { return {CARREAU_METRIC_SPACE, metric}; }
  /// h1 along the direction, h2 across it.
  static Prescription tangent(double h1, double h2, const Point3& along) {
    return {CARREAU_METRIC_TANGENT, {h1, h2, along[0], along[1], along[2]}};
  }
};

/// The callbacks of carreau_metric_callbacks. surface_batch is used in place of surface when it is given: places in the parameter plane and in
/// space, and an answer for each.
struct Metrics {
  std::function<Prescription(int face, double u, double v)> surface{};
  std::function<void(int face, std::span<const Point2> uv, std::span<const Point3> xyz, std::span<Prescription> out)> surface_batch{};
  std::function<Prescription(int face, int ic, double t)> curve{};
  std::function<Prescription(int point)> point{};
};

namespace detail {

/// The first exception of callbacks in a call; they may run on several threads.
class Faults {
 public:
  /// Runs a callback: 0, its own answer, or 1 when it has thrown.
  template <typename Callback>
  std::int32_t guarded(Callback&& callback) noexcept {
    try {
      if constexpr (std::is_void_v<std::invoke_result_t<Callback>>) {
        callback();
        return 0;
      } else {
        return callback();
      }
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!first_) first_ = std::current_exception();
      return 1;
    }
  }
  std::exception_ptr take() { return std::exchange(first_, nullptr); }
  /// The text of the exception, for the sentence of the error; lives until the next call.
  const char* text() {
    const std::scoped_lock lock(mutex_);
    text_.clear();
    try {
      if (first_) std::rethrow_exception(first_);
    } catch (const std::exception& error) {
      text_ = error.what();
    } catch (...) {
    }
    return text_.c_str();
  }

 private:
  std::mutex mutex_;
  std::exception_ptr first_;
  std::string text_;
};

/// Copies rows of a callback into the arrays of the library, NULL above the order.
inline void store(double* out, const Point3& row) { out[0] = row[0], out[1] = row[1], out[2] = row[2]; }
inline void store(double* out, const Point2& row) { out[0] = row[0], out[1] = row[1]; }
inline std::span<Point3> rows3(double* out, std::int64_t n) {
  return out == nullptr ? std::span<Point3>{} : std::span(reinterpret_cast<Point3*>(out), static_cast<std::size_t>(n));
}

/// Callbacks of a geometry on the C side: `user` is an object of this type, which `released` frees.
struct HeldGeometry {
  Geometry callbacks;
  std::shared_ptr<Faults> faults;
  std::shared_ptr<HeldGeometry> self; ///< itself, as long as the library has it

  static HeldGeometry& of(void* user) { return *static_cast<HeldGeometry*>(user); }

  static std::int32_t surface(std::int32_t face, double u, double v, std::int32_t order, double* s, double* su, double* sv,
                              double* suu, double* suv, double* svv, void* user) {
    HeldGeometry& held = of(user);
    return held.faults->guarded([&] {
      const SurfacePoint p = held.callbacks.surface(face, u, v, order);
      store(s, p.s);
      if (order >= 1) store(su, p.su), store(sv, p.sv);
      if (order >= 2) store(suu, p.suu), store(suv, p.suv), store(svv, p.svv);
    });
  }
  static std::int32_t surface_batch(std::int32_t face, std::int64_t n, const double* uv, std::int32_t order, double* s, double* su,
                                    double* sv, double* suu, double* suv, double* svv, void* user) {
    HeldGeometry& held = of(user);
    return held.faults->guarded([&] {
      const std::span places(reinterpret_cast<const Point2*>(uv), static_cast<std::size_t>(n));
      held.callbacks.surface_batch(face, places, order,
                                   {rows3(s, n), rows3(su, n), rows3(sv, n), rows3(suu, n), rows3(suv, n), rows3(svv, n)});
    });
  }
  static std::int32_t interval(std::int32_t face, std::int32_t ic, double* a, double* b, void* user) {
    HeldGeometry& held = of(user);
    return held.faults->guarded([&] {
      const Interval interval = held.callbacks.curve_interval(face, ic);
      *a = interval.a, *b = interval.b;
    });
  }
  static std::int32_t curve(std::int32_t face, std::int32_t ic, double t, std::int32_t order, double* c, double* ct, double* ctt,
                            void* user) {
    HeldGeometry& held = of(user);
    return held.faults->guarded([&] {
      const CurvePoint p = held.callbacks.curve(face, ic, t, order);
      store(c, p.c);
      if (order >= 1) store(ct, p.ct);
      if (order >= 2) store(ctt, p.ctt);
    });
  }
  template <auto Member>
  static std::int32_t on_surface(std::int32_t face, double u, double v, double* value, void* user) {
    return answer(user, value, [&] { return (of(user).callbacks.*Member)(face, u, v); });
  }
  template <auto Member>
  static std::int32_t on_curve(std::int32_t face, std::int32_t ic, double t, double* value, void* user) {
    return answer(user, value, [&] { return (of(user).callbacks.*Member)(face, ic, t); });
  }
  static std::int32_t at_point(std::int32_t point, double* value, void* user) {
    return answer(user, value, [&] { return of(user).callbacks.point_size(point); });
  }
  static const char* failure(std::int32_t, void* user) { return of(user).faults->text(); }
  static void released(void* user) { const auto last = std::move(of(user).self); }

 private:
  template <typename Ask>
  static std::int32_t answer(void* user, double* value, Ask&& ask) {
    return of(user).faults->guarded([&]() -> std::int32_t {
      const std::optional<double> found = ask();
      if (!found) return CARREAU_NO_ANSWER;
      *value = *found;
      return 0;
    });
  }
};

/// The struct of the C interface for callbacks that are held.
inline carreau_cad table_of(HeldGeometry& held) {
  const Geometry& has = held.callbacks;
  auto cad = sized<carreau_cad>();
  cad.user = &held;
  cad.surface_order = has.surface_order;
  cad.curve_order = has.curve_order;
  cad.reentrant = has.reentrant ? 1 : 0;
  if (has.surface) cad.surface = HeldGeometry::surface;
  if (has.surface_batch) cad.surface_batch = HeldGeometry::surface_batch;
  if (has.curve_interval) cad.curve_interval = HeldGeometry::interval;
  if (has.curve) cad.curve = HeldGeometry::curve;
  if (has.surface_size) cad.surface_size = HeldGeometry::on_surface<&Geometry::surface_size>;
  if (has.curve_size) cad.curve_size = HeldGeometry::on_curve<&Geometry::curve_size>;
  if (has.point_size) cad.point_size = HeldGeometry::at_point;
  if (has.surface_radius) cad.surface_radius = HeldGeometry::on_surface<&Geometry::surface_radius>;
  if (has.curve_radius) cad.curve_radius = HeldGeometry::on_curve<&Geometry::curve_radius>;
  cad.failure = HeldGeometry::failure;
  cad.release = HeldGeometry::released;
  return cad;
}

/// Callbacks of metrics on the C side.
struct HeldMetrics {
  Metrics callbacks;
  std::shared_ptr<Faults> faults;

  static HeldMetrics& of(void* user) { return *static_cast<HeldMetrics*>(user); }
  static std::int32_t surface(std::int32_t face, double u, double v, std::int32_t* kind, double* value, void* user) {
    return answer(user, kind, value, [&] { return of(user).callbacks.surface(face, u, v); });
  }
  static std::int32_t surface_batch(std::int32_t face, std::int64_t n, const double* uv, const double* xyz, std::int32_t* kind,
                                    double* value, void* user) {
    return of(user).faults->guarded([&] {
      const auto size = static_cast<std::size_t>(n);
      std::vector<Prescription> found(size);
      of(user).callbacks.surface_batch(face, {reinterpret_cast<const Point2*>(uv), size}, {reinterpret_cast<const Point3*>(xyz), size}, found);
      for (std::size_t i = 0; i < size; ++i) store(found[i], kind + i, value + 6 * i);
    });
  }
  static std::int32_t curve(std::int32_t face, std::int32_t ic, double t, std::int32_t* kind, double* value, void* user) {
    return answer(user, kind, value, [&] { return of(user).callbacks.curve(face, ic, t); });
  }
  static std::int32_t point(std::int32_t point, std::int32_t* kind, double* value, void* user) {
    return answer(user, kind, value, [&] { return of(user).callbacks.point(point); });
  }

 private:
  template <typename Ask>
  static std::int32_t answer(void* user, std::int32_t* kind, double* value, Ask&& ask) {
    return of(user).faults->guarded([&] { store(ask(), kind, value); });
  }
  static void store(const Prescription& found, std::int32_t* kind, double* value) {
    *kind = found.kind;
    for (std::size_t i = 0; i < found.value.size(); ++i) value[i] = found.value[i];
  }
};

inline carreau_metric_callbacks table_of(HeldMetrics& held) {
  auto table = sized<carreau_metric_callbacks>();
  table.user = &held;
  if (held.callbacks.surface) table.surface_metric = HeldMetrics::surface;
  if (held.callbacks.surface_batch) table.surface_metric_batch = HeldMetrics::surface_batch;
  if (held.callbacks.curve) table.curve_metric = HeldMetrics::curve;
  if (held.callbacks.point) table.point_metric = HeldMetrics::point;
  return table;
}

} // namespace detail

} // namespace carreau

#endif
