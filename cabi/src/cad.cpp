// SPDX-License-Identifier: BSD-3-Clause
#include <type_traits>

#include "arguments.h"
#include "cad/host_cad.h"
#include "cad/host_metrics.h"
#include "guard.h"

using carreau::CadMTable;
using carreau::CurveJet;
using carreau::HostCad;
using carreau::HostMetricKind;
using carreau::HostMetrics;
using carreau::HostMetricTable;
using carreau::HostTable;
using carreau::Interval;
using carreau::Monitor;
using carreau::Prescription;
using carreau::SurfaceJet;
using carreau::Vec2;
using carreau::Vec3;
using namespace carreau::abi;

static_assert(std::is_same_v<int, std::int32_t>, "a default integer of Fortran is an int32_t and an int");
static_assert(carreau::no_answer == CARREAU_HVIDE);
static_assert(carreau::no_answer_status == CARREAU_NO_ANSWER);
static_assert(static_cast<int>(HostMetricKind::none) == CARREAU_METRIC_NONE &&
              static_cast<int>(HostMetricKind::size) == CARREAU_METRIC_SIZE &&
              static_cast<int>(HostMetricKind::space) == CARREAU_METRIC_SPACE &&
              static_cast<int>(HostMetricKind::tangent) == CARREAU_METRIC_TANGENT);

namespace {

void obey(const Monitor& monitor) {
  if (monitor.stop_requested()) throw carreau::Cancelled("stopped by the host");
}

CadMTable table_of(const carreau_cad_m& routines) {
  return {.surf0 = routines.surf0,
          .surf1 = routines.surf1,
          .surf2 = routines.surf2,
          .curv_int = routines.curv_int,
          .curv0 = routines.curv0,
          .curv1 = routines.curv1,
          .curv2 = routines.curv2,
          .cad_hphys = routines.cad_hphys,
          .cad_hphyc = routines.cad_hphyc,
          .cad_hphyp = routines.cad_hphyp,
          .cad_rads = routines.cad_rads,
          .cad_radc = routines.cad_radc};
}

HostTable table_of(const carreau_cad& callbacks) {
  return {.user = callbacks.user,
          .surface_order = callbacks.surface_order,
          .curve_order = callbacks.curve_order,
          .reentrant = callbacks.reentrant,
          .surface = callbacks.surface,
          .surface_batch = callbacks.surface_batch,
          .curve_interval = callbacks.curve_interval,
          .curve = callbacks.curve,
          .surface_size = callbacks.surface_size,
          .curve_size = callbacks.curve_size,
          .point_size = callbacks.point_size,
          .surface_radius = callbacks.surface_radius,
          .curve_radius = callbacks.curve_radius,
          .failure = callbacks.failure};
}

/// Obeys a stop after each callback: a host may be slow, and the engine requests many points at a time.
class StoppableCad : public HostCad {
 public:
  StoppableCad(const carreau_cad_m& routines, const Monitor& monitor)
      : HostCad(table_of(routines)), batched_(false), monitor_(monitor) {}
  StoppableCad(const carreau_cad& callbacks, const Monitor& monitor)
      : HostCad(table_of(callbacks)), batched_(callbacks.surface_batch != nullptr), monitor_(monitor) {}

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    const std::size_t together = batched_ ? uv.size() : 1;
    for (std::size_t from = 0; from < uv.size(); from += together) {
      HostCad::surface(face, want, uv.subspan(from, together), out.subspan(from, together));
      obey(monitor_);
    }
  }
  Interval curve_interval(int face, int ic) override { return obeyed(HostCad::curve_interval(face, ic)); }
  CurveJet curve(int face, int ic, unsigned want, double t) override {
    return obeyed(HostCad::curve(face, ic, want, t));
  }
  std::optional<double> surface_size(int face, Vec2 uv) override { return obeyed(HostCad::surface_size(face, uv)); }
  std::optional<double> curve_size(int face, int ic, double t) override {
    return obeyed(HostCad::curve_size(face, ic, t));
  }
  std::optional<double> point_size(int point) override { return obeyed(HostCad::point_size(point)); }
  std::optional<double> surface_radius(int face, Vec2 uv) override { return obeyed(HostCad::surface_radius(face, uv)); }
  std::optional<double> curve_radius(int face, int ic, double t) override {
    return obeyed(HostCad::curve_radius(face, ic, t));
  }

 private:
  template <typename Value>
  Value obeyed(Value value) const {
    obey(monitor_);
    return value;
  }

  bool batched_;
  const Monitor& monitor_;
};

/// Notifies the host when its callbacks are no longer of use.
class ReleasedCad final : public StoppableCad {
 public:
  ReleasedCad(const carreau_cad& callbacks, const Monitor& monitor)
      : StoppableCad(callbacks, monitor), release_(callbacks.release), user_(callbacks.user) {}
  ReleasedCad(const ReleasedCad&) = delete;
  ReleasedCad& operator=(const ReleasedCad&) = delete;
  ~ReleasedCad() override {
    if (release_ != nullptr) release_(user_);
  }

 private:
  void (*release_)(void*);
  void* user_;
};

class StoppableMetrics final : public HostMetrics {
 public:
  StoppableMetrics(const carreau_metric_callbacks& callbacks, const Monitor& monitor)
      : HostMetrics(HostMetricTable{.user = callbacks.user,
                                    .surface_metric = callbacks.surface_metric,
                                    .surface_metric_batch = callbacks.surface_metric_batch,
                                    .curve_metric = callbacks.curve_metric,
                                    .point_metric = callbacks.point_metric}),
        monitor_(monitor) {}

  Prescription on_surface(int face, Vec2 uv, Vec3 xyz) override {
    return obeyed(HostMetrics::on_surface(face, uv, xyz));
  }
  void on_surface_points(int face, std::span<const Vec2> uv, std::span<const Vec3> xyz,
                         std::span<Prescription> out) override {
    HostMetrics::on_surface_points(face, uv, xyz, out);
    obey(monitor_);
  }
  Prescription on_curve(int face, int ic, double t, Vec2 uv, Vec3 xyz) override {
    return obeyed(HostMetrics::on_curve(face, ic, t, uv, xyz));
  }
  Prescription at_point(int point, Vec3 xyz) override { return obeyed(HostMetrics::at_point(point, xyz)); }

 private:
  Prescription obeyed(const Prescription& answer) const {
    obey(monitor_);
    return answer;
  }

  const Monitor& monitor_;
};

}  // namespace

namespace {

void set_host(carreau_session& session, std::shared_ptr<carreau::Cad> cad) {
  session.host = std::move(cad);
  session.update_cad();
  if (session.added.empty()) session.session.set_prescription_source(nullptr);
}

}  // namespace

std::shared_ptr<carreau::Cad> carreau::abi::cad_of(const carreau_cad* callbacks, const Monitor& monitor) {
  return std::make_shared<ReleasedCad>(read_struct(callbacks, "carreau_cad"), monitor);
}

carreau_status carreau_set_cad_m(carreau_session* session, const carreau_cad_m* routines) {
  return guarded(session, [&] {
    const carreau_cad_m known = read_struct(routines, "carreau_cad_m");
    auto cad = std::make_shared<StoppableCad>(known, session->monitor);
    if (known.cad_init != nullptr) known.cad_init();
    set_host(*session, std::move(cad));
  });
}

carreau_status carreau_set_cad(carreau_session* session, const carreau_cad* callbacks) {
  return guarded(session, [&] { set_host(*session, cad_of(callbacks, session->monitor)); });
}

carreau_status carreau_set_metric_callbacks(carreau_session* session, const carreau_metric_callbacks* callbacks) {
  return guarded(session, [&] {
    const carreau_metric_callbacks known = read_struct(callbacks, "carreau_metric_callbacks");
    const bool any = known.surface_metric != nullptr || known.surface_metric_batch != nullptr ||
                     known.curve_metric != nullptr || known.point_metric != nullptr;
    session->session.set_metric_callbacks(any ? std::make_shared<StoppableMetrics>(known, session->monitor) : nullptr);
  });
}
