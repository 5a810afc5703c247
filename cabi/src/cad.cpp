#include <type_traits>

#include "arguments.h"
#include "cad/host_cad.h"
#include "guard.h"

using carreau::CadMTable;
using carreau::HostCad;
using carreau::HostTable;
using carreau::InvalidArgument;
using namespace carreau::abi;

static_assert(std::is_same_v<int, std::int32_t>, "a default integer of Fortran is an int32_t and an int");
static_assert(carreau::no_answer == CARREAU_HVIDE);

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

/// Calls the callbacks of a carreau_cad for the engine, whose `user` is that struct.
struct Thunks {
  static const carreau_cad& of(void* user) { return *static_cast<const carreau_cad*>(user); }

  /// CARREAU_NO_ANSWER leaves what means "no answer" to the engine.
  static std::int32_t answered(std::int32_t status, double* value) {
    if (status != CARREAU_NO_ANSWER) return status;
    *value = CARREAU_HVIDE;
    return 0;
  }

  static std::int32_t surface(std::int32_t face, double u, double v, std::int32_t order, double* s, double* su,
                              double* sv, double* suu, double* suv, double* svv, void* user) {
    const carreau_cad& cad = of(user);
    if (cad.surface != nullptr) return cad.surface(face, u, v, order, s, su, sv, suu, suv, svv, cad.user);
    const double uv[2] = {u, v};
    return cad.surface_batch(face, 1, uv, order, s, order >= 1 ? su : nullptr, order >= 1 ? sv : nullptr,
                             order == 2 ? suu : nullptr, order == 2 ? suv : nullptr, order == 2 ? svv : nullptr,
                             cad.user);
  }
  static std::int32_t surface_batch(std::int32_t face, std::int64_t n, const double* uv, std::int32_t order, double* s,
                                    double* su, double* sv, double* suu, double* suv, double* svv, void* user) {
    const carreau_cad& cad = of(user);
    return n == 0 ? 0 : cad.surface_batch(face, n, uv, order, s, su, sv, suu, suv, svv, cad.user);
  }
  static std::int32_t curve_interval(std::int32_t face, std::int32_t ic, double* a, double* b, void* user) {
    return of(user).curve_interval(face, ic, a, b, of(user).user);
  }
  static std::int32_t curve(std::int32_t face, std::int32_t ic, double t, std::int32_t order, double* c, double* ct,
                            double* ctt, void* user) {
    return of(user).curve(face, ic, t, order, c, ct, ctt, of(user).user);
  }
  static std::int32_t surface_size(std::int32_t face, double u, double v, double* h, void* user) {
    return answered(of(user).surface_size(face, u, v, h, of(user).user), h);
  }
  static std::int32_t curve_size(std::int32_t face, std::int32_t ic, double t, double* h, void* user) {
    return answered(of(user).curve_size(face, ic, t, h, of(user).user), h);
  }
  static std::int32_t point_size(std::int32_t point, double* h, void* user) {
    return answered(of(user).point_size(point, h, of(user).user), h);
  }
  static std::int32_t surface_radius(std::int32_t face, double u, double v, double* rho, void* user) {
    return answered(of(user).surface_radius(face, u, v, rho, of(user).user), rho);
  }
  static std::int32_t curve_radius(std::int32_t face, std::int32_t ic, double t, double* rho, void* user) {
    return answered(of(user).curve_radius(face, ic, t, rho, of(user).user), rho);
  }
};

template <typename Callback, typename Thunk>
Thunk when_given(Callback callback, Thunk thunk) {
  return callback != nullptr ? thunk : nullptr;
}

struct CallbackStore {
  carreau_cad callbacks;
};

/// The store is a base, so that it is there when HostCad is made.
class CallbackCad final : private CallbackStore, public HostCad {
 public:
  explicit CallbackCad(const carreau_cad& given) : CallbackStore{given}, HostCad(table_of(CallbackStore::callbacks)) {}

 private:
  static HostTable table_of(carreau_cad& c) {
    HostTable table;
    table.user = &c;
    table.surface_order = c.surface_order;
    table.curve_order = c.curve_order;
    table.reentrant = c.reentrant;
    if (c.surface != nullptr || c.surface_batch != nullptr) table.surface = Thunks::surface;
    table.surface_batch = when_given(c.surface_batch, &Thunks::surface_batch);
    table.curve_interval = when_given(c.curve_interval, &Thunks::curve_interval);
    table.curve = when_given(c.curve, &Thunks::curve);
    table.surface_size = when_given(c.surface_size, &Thunks::surface_size);
    table.curve_size = when_given(c.curve_size, &Thunks::curve_size);
    table.point_size = when_given(c.point_size, &Thunks::point_size);
    table.surface_radius = when_given(c.surface_radius, &Thunks::surface_radius);
    table.curve_radius = when_given(c.curve_radius, &Thunks::curve_radius);
    return table;
  }
};

}  // namespace

carreau_status carreau_set_cad_m(carreau_session* session, const carreau_cad_m* routines) {
  return guarded(session, [&] {
    const carreau_cad_m known = read_struct(routines, "carreau_cad_m");
    auto cad = std::make_shared<HostCad>(table_of(known));
    if (known.cad_init != nullptr) known.cad_init();
    session->session.set_cad(std::move(cad));
    session->has_cad = true;
  });
}

carreau_status carreau_set_cad(carreau_session* session, const carreau_cad* callbacks) {
  return guarded(session, [&] {
    const carreau_cad known = read_struct(callbacks, "carreau_cad");
    session->session.set_cad(std::make_shared<CallbackCad>(known));
    session->has_cad = true;
  });
}
