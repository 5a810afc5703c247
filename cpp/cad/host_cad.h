// SPDX-License-Identifier: BSD-3-Clause
// A host's geometry given by plain function pointers, as the C ABI registers it.
#pragma once

#include <cstdint>

#include "cad/difference_cad.h"

namespace carreau {

/// The routines of a cad_m module (RT-0232 sec. 3.1), every argument by reference; The registrar calls `cad_init`.
/// nullptr: the routine is missing. surf0, curv_int and curv0 are required.
struct CadMTable {
  void (*surf0)(const std::int32_t* refs, const double* uv, double* s) = nullptr;
  void (*surf1)(const std::int32_t* refs, const double* uv, double* su, double* sv) = nullptr;
  void (*surf2)(const std::int32_t* refs, const double* uv, double* suu, double* suv, double* svv) = nullptr;
  void (*curv_int)(const std::int32_t* refs, const std::int32_t* ic, double* a, double* b) = nullptr;
  void (*curv0)(const std::int32_t* refs, const std::int32_t* ic, const double* t, double* c) = nullptr;
  void (*curv1)(const std::int32_t* refs, const std::int32_t* ic, const double* t, double* ct) = nullptr;
  void (*curv2)(const std::int32_t* refs, const std::int32_t* ic, const double* t, double* ctt) = nullptr;
  void (*cad_hphys)(const std::int32_t* refs, const double* uv, double* h) = nullptr;
  void (*cad_hphyc)(const std::int32_t* refs, const std::int32_t* ic, const double* t, double* h) = nullptr;
  void (*cad_hphyp)(const std::int32_t* refp, double* h) = nullptr;
  void (*cad_rads)(const std::int32_t* refs, const double* uv, double* rhos) = nullptr;
  void (*cad_radc)(const std::int32_t* refs, const std::int32_t* ic, const double* t, double* rhoc) = nullptr;
};

/// The callbacks of a C host: values by value, `user` last. They return 0, or another status that becomes a
/// CallbackError; sizes and radii may also return no_answer_status. `order` is the highest requested derivative, never
/// above the table's own; entries above it may be left untouched. The same layout as carreau_cad in carreau.h.
struct HostTable {
  void* user = nullptr;
  std::int32_t surface_order = 2;  ///< highest order of `surface`: 0, 1 or 2
  std::int32_t curve_order = 2;    ///< highest order of `curve`
  std::int32_t reentrant = 0;
  /// S and its derivatives, [3] each. Must be given unless surface_batch is.
  std::int32_t (*surface)(std::int32_t face, double u, double v, std::int32_t order, double* s, double* su, double* sv,
                          double* suu, double* suv, double* svv, void* user) = nullptr;
  /// Evaluates at n points: uv is n x 2, results n x 3, row by row; results above `order` are null.
  /// Used in place of `surface` when given.
  std::int32_t (*surface_batch)(std::int32_t face, std::int64_t n, const double* uv, std::int32_t order, double* s,
                                double* su, double* sv, double* suu, double* suv, double* svv, void* user) = nullptr;
  std::int32_t (*curve_interval)(std::int32_t face, std::int32_t ic, double* a, double* b, void* user) = nullptr;
  /// C and its derivatives, [2] each.
  std::int32_t (*curve)(std::int32_t face, std::int32_t ic, double t, std::int32_t order, double* c, double* ct,
                        double* ctt, void* user) = nullptr;
  std::int32_t (*surface_size)(std::int32_t face, double u, double v, double* value, void* user) = nullptr;
  std::int32_t (*curve_size)(std::int32_t face, std::int32_t ic, double t, double* value, void* user) = nullptr;
  std::int32_t (*point_size)(std::int32_t point, double* value, void* user) = nullptr;
  std::int32_t (*surface_radius)(std::int32_t face, double u, double v, double* value, void* user) = nullptr;
  std::int32_t (*curve_radius)(std::int32_t face, std::int32_t ic, double t, double* value, void* user) = nullptr;
  /// Readable reason why a callback has just failed on the face; nullptr or "" without a reason.
  const char* (*failure)(std::int32_t face, void* user) = nullptr;
};

/// Value of a size or radius before the host is called (`hvide`, RT-0232 sec. 3.1.3); if the host leaves it, there is
/// no answer.
inline constexpr double no_answer = -1e38;
/// Status by which a callback for a size or radius of a C host does not answer.
inline constexpr std::int32_t no_answer_status = -1;

/// Counts calls: of each routine of a cad_m module. For a C host, whose one callback stands for several routines,
/// counts the requested orders. Finite differences (difference_cad.h) find missing derivatives, and their calls are
/// counted by their actual routine.
class HostCad : public DifferenceCad {
 public:
  /// Throw InvalidArgument when a required routine is missing or an order is not 0, 1 or 2.
  explicit HostCad(const CadMTable& table);
  explicit HostCad(const HostTable& table);
};

}  // namespace carreau
