#include <type_traits>

#include "arguments.h"
#include "cad/host_cad.h"
#include "guard.h"

using carreau::CadMTable;
using carreau::CurveJet;
using carreau::HostCad;
using carreau::HostTable;
using carreau::Interval;
using carreau::Monitor;
using carreau::SurfaceJet;
using carreau::Vec2;
using namespace carreau::abi;

static_assert(std::is_same_v<int, std::int32_t>, "a default integer of Fortran is an int32_t and an int");
static_assert(carreau::no_answer == CARREAU_HVIDE);
static_assert(carreau::no_answer_status == CARREAU_NO_ANSWER);

namespace {

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
          .curve_radius = callbacks.curve_radius};
}

/// Obeys a stop after each callback: a host may be slow, and the engine asks for many points at a time.
class StoppableCad final : public HostCad {
 public:
  StoppableCad(const carreau_cad_m& routines, const Monitor& monitor)
      : HostCad(table_of(routines)), batched_(false), monitor_(monitor) {}
  StoppableCad(const carreau_cad& callbacks, const Monitor& monitor)
      : HostCad(table_of(callbacks)), batched_(callbacks.surface_batch != nullptr), monitor_(monitor) {}

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    const std::size_t together = batched_ ? uv.size() : 1;
    for (std::size_t from = 0; from < uv.size(); from += together) {
      HostCad::surface(face, want, uv.subspan(from, together), out.subspan(from, together));
      obey();
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
  void obey() const {
    if (monitor_.stop_requested()) throw carreau::Cancelled("stopped by the host");
  }
  template <typename Value>
  Value obeyed(Value value) const {
    obey();
    return value;
  }

  bool batched_;
  const Monitor& monitor_;
};

}  // namespace

carreau_status carreau_set_cad_m(carreau_session* session, const carreau_cad_m* routines) {
  return guarded(session, [&] {
    const carreau_cad_m known = read_struct(routines, "carreau_cad_m");
    auto cad = std::make_shared<StoppableCad>(known, session->monitor);
    if (known.cad_init != nullptr) known.cad_init();
    session->session.set_cad(std::move(cad));
    session->has_cad = true;
  });
}

carreau_status carreau_set_cad(carreau_session* session, const carreau_cad* callbacks) {
  return guarded(session, [&] {
    const carreau_cad known = read_struct(callbacks, "carreau_cad");
    session->session.set_cad(std::make_shared<StoppableCad>(known, session->monitor));
    session->has_cad = true;
  });
}
