// A host's geometry given by plain function pointers, as the C ABI registers it.
#pragma once

#include <cstdint>
#include <map>

#include "cad/cad.h"

namespace carreau {

/// The routines of a cad_m module (RT-0232 sec. 3.1), every argument by reference. nullptr: not there. surf0, curv_int
/// and curv0 must be.
struct CadMTable {
  void (*surf0)(const int* refs, const double uv[2], double s[3]) = nullptr;
  void (*surf1)(const int* refs, const double uv[2], double su[3], double sv[3]) = nullptr;
  void (*surf2)(const int* refs, const double uv[2], double suu[3], double suv[3], double svv[3]) = nullptr;
  void (*curv_int)(const int* refs, const int* ic, double* a, double* b) = nullptr;
  void (*curv0)(const int* refs, const int* ic, const double* t, double c[2]) = nullptr;
  void (*curv1)(const int* refs, const int* ic, const double* t, double ct[2]) = nullptr;
  void (*curv2)(const int* refs, const int* ic, const double* t, double ctt[2]) = nullptr;
  void (*cad_hphys)(const int* refs, const double uv[2], double* h) = nullptr;
  void (*cad_hphyc)(const int* refs, const int* ic, const double* t, double* h) = nullptr;
  void (*cad_hphyp)(const int* refp, double* h) = nullptr;
  void (*cad_rads)(const int* refs, const double uv[2], double* rhos) = nullptr;
  void (*cad_radc)(const int* refs, const int* ic, const double* t, double* rhoc) = nullptr;
};

/// The routines of a C host: values by value, `user` last, a status returned: 0 fine, anything else stops the run.
/// `order` is the highest order of derivative wanted (0, 1, 2); entries above it may be left untouched. `order` is
/// never above the table's own `surface_order` or `curve_order`.
struct HostTable {
  void* user = nullptr;
  std::int32_t surface_order = 2;  ///< highest order that `surface` gives
  std::int32_t curve_order = 2;
  std::int32_t reentrant = 0;
  std::int32_t (*surface)(std::int32_t face, double u, double v, std::int32_t order, double s[3], double su[3],
                          double sv[3], double suu[3], double suv[3], double svv[3], void* user) = nullptr;
  /// Many points at once; arrays of 2 n (uv) and 3 n numbers, those above `order` are null. May be missing.
  std::int32_t (*surface_batch)(std::int32_t face, std::int64_t n, const double* uv, std::int32_t order, double* s,
                                double* su, double* sv, double* suu, double* suv, double* svv, void* user) = nullptr;
  std::int32_t (*curve_interval)(std::int32_t face, std::int32_t ic, double* a, double* b, void* user) = nullptr;
  std::int32_t (*curve)(std::int32_t face, std::int32_t ic, double t, std::int32_t order, double c[2], double ct[2],
                        double ctt[2], void* user) = nullptr;
  /// Sizes and radii: *h holds no_answer before the call; leaving it there is "no answer". May be missing.
  std::int32_t (*surface_size)(std::int32_t face, double u, double v, double* h, void* user) = nullptr;
  std::int32_t (*curve_size)(std::int32_t face, std::int32_t ic, double t, double* h, void* user) = nullptr;
  std::int32_t (*point_size)(std::int32_t point, double* h, void* user) = nullptr;
  std::int32_t (*surface_radius)(std::int32_t face, double u, double v, double* rho, void* user) = nullptr;
  std::int32_t (*curve_radius)(std::int32_t face, std::int32_t ic, double t, double* rho, void* user) = nullptr;
};

/// What a size holds before the host is asked (`hvide`, RT-0232 sec. 3.1.3): a host that leaves it does not answer.
inline constexpr double no_answer = -1e38;

/// Derivatives that the host does not give are found by finite differences of those of the order below: central ones
/// with a step relative to the parameter's magnitude and range, one-sided at the border of the face's parameter box
/// when that is known.
class HostCad : public Cad {
 public:
  /// Throw InvalidArgument when a routine that must be there is missing.
  explicit HostCad(const CadMTable& table);
  explicit HostCad(const HostTable& table);

  /// The box of a face's parameter domain: finite differences stay inside.
  void set_parameter_box(int face, Vec2 low, Vec2 high);

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override;
  Interval curve_interval(int face, int ic) override;
  CurveJet curve(int face, int ic, unsigned want, double t) override;
  std::optional<double> surface_size(int face, Vec2 uv) override;
  std::optional<double> curve_size(int face, int ic, double t) override;
  std::optional<double> point_size(int point) override;
  std::optional<double> surface_radius(int face, Vec2 uv) override;
  std::optional<double> curve_radius(int face, int ic, double t) override;
  [[nodiscard]] bool reentrant() const noexcept override { return is_c_ && host_.reentrant != 0; }
  /// Whether the host itself gives derivatives of this order (1 or 2).
  [[nodiscard]] bool gives_surface_order(int order) const noexcept;
  [[nodiscard]] bool gives_curve_order(int order) const noexcept;

 private:
  struct Box {
    Vec2 low, high;
  };
  void raw_surface(int face, int order, Vec2 uv, unsigned want, SurfaceJet& jet);
  void raw_batch(int face, int order, std::span<const Vec2> uv, std::span<SurfaceJet> out);
  CurveJet raw_curve(int face, int ic, int order, unsigned want, double t);
  void difference_surface(int face, unsigned missing, Vec2 uv, SurfaceJet& jet);
  [[nodiscard]] std::pair<double, double> steps(int face, double at, bool second_parameter, double relative) const;

  bool is_c_;
  CadMTable cad_m_{};
  HostTable host_{};
  std::map<int, Box> boxes_;
};

}  // namespace carreau
