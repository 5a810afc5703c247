// SPDX-License-Identifier: BSD-3-Clause
// The callbacks of a BrepHost.
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Vec.hxx>
#include <gp_Vec2d.hxx>
#include <algorithm>
#include <array>
#include <utility>

#include "brep_state.h"
#include "faults.h"

namespace carreau_occ {

namespace {

void store(const gp_Pnt& p, double* to) { to[0] = p.X(), to[1] = p.Y(), to[2] = p.Z(); }
void store(const gp_Vec& v, double* to) { to[0] = v.X(), to[1] = v.Y(), to[2] = v.Z(); }

/// Calls use(i) for n points, some at a time. Points of a polynomial in such a set follow each other.
template <typename Use>
void for_each_by_patch(const Evaluators::Surface& surface, int64_t n, const double* uv, bool swapped, const Use& use) {
  if (!surface.has_patches()) {
    for (int64_t i = 0; i < n; ++i) use(i);
    return;
  }
  std::array<std::pair<std::size_t, int64_t>, 256> places;  // nothing that a jump out of a fault would lose
  for (int64_t first = 0; first < n; first += static_cast<int64_t>(places.size())) {
    const auto some = static_cast<std::size_t>(std::min(n - first, static_cast<int64_t>(places.size())));
    for (std::size_t k = 0; k < some; ++k) {
      const int64_t i = first + static_cast<int64_t>(k);
      places[k] = {surface.patch_of(uv[2 * i + (swapped ? 1 : 0)], uv[2 * i + (swapped ? 0 : 1)]), i};
    }
    std::sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(some));
    for (std::size_t k = 0; k < some; ++k) use(places[k].second);
  }
}

int32_t answer(double size, double* value) {
  if (!(size > 0)) return CARREAU_NO_ANSWER;
  *value = size;
  return 0;
}
}  // namespace

int32_t BrepHost::State::surface_size(int32_t face, double, double, double* value, void* user) noexcept {
  const auto& state = *static_cast<State*>(user);
  if (state.wire(face) != nullptr) return CARREAU_NO_ANSWER;
  return answer(state.host_faces[static_cast<std::size_t>(face - 1)].size, value);
}

int32_t BrepHost::State::curve_size(int32_t face, int32_t ic, double, double* value, void* user) noexcept {
  const auto& state = *static_cast<State*>(user);
  if (state.wire(face) != nullptr) return CARREAU_NO_ANSWER;
  const int edge = state.host_faces[static_cast<std::size_t>(face - 1)].curves[static_cast<std::size_t>(ic - 1)].edge;
  return answer(state.edge_size[static_cast<std::size_t>(edge - 1)], value);
}

int32_t BrepHost::State::point_size(int32_t point, double* value, void* user) noexcept {
  // Gluing numbers points where it cuts curves behind all others.
  const std::vector<double>& sizes = static_cast<State*>(user)->vertex_size;
  const auto index = static_cast<std::size_t>(point - 1);
  return index < sizes.size() ? answer(sizes[index], value) : CARREAU_NO_ANSWER;
}

int32_t BrepHost::State::fail(int32_t face, const Standard_Failure& why) noexcept {
  try {
    const std::scoped_lock lock(mutex);
    failures.try_emplace(face, sentence_of(why));  // the first stays: a host may hold its address
  } catch (...) {                                  // no memory for a sentence
  }
  return 1;
}

template <typename Evaluate>
int32_t BrepHost::State::answer_guarded(int32_t face, std::atomic<bool>& failed, const Evaluate& evaluate) noexcept {
  try {
    guarded(evaluate);
    return 0;
  } catch (const Standard_Failure& failure) {
    failed = true;
    return fail(face, failure);
  } catch (...) {
    return fail(face, Standard_Failure("out of memory"));
  }
}

void* BrepHost::State::hold() {
  const std::scoped_lock lock(mutex);
  if (sessions++ == 0) self = shared_from_this();
  return this;
}

void BrepHost::State::release(void* user) noexcept {
  auto& state = *static_cast<State*>(user);
  std::shared_ptr<State> last;  // perhaps; destroyed when the mutex is free
  {
    const std::scoped_lock lock(state.mutex);
    if (--state.sessions == 0) last = std::move(state.self);
  }
}

const char* BrepHost::State::failure(int32_t face, void* user) noexcept {
  auto& state = *static_cast<State*>(user);
  const std::scoped_lock lock(state.mutex);
  const auto found = state.failures.find(face);
  return found == state.failures.end() ? nullptr : found->second.c_str();
}

int32_t BrepHost::State::surface_batch(int32_t face, int64_t n, const double* uv, int32_t order, double* S, double* Su,
                                       double* Sv, double* Suu, double* Suv, double* Svv, void* user) noexcept {
  auto& state = *static_cast<State*>(user);
  if (state.wire(face) != nullptr) return state.wire_batch(face, n, uv, order, S, Su, Sv, Suu, Suv, Svv);
  std::atomic<bool>& failed = state.surface_failed[static_cast<std::size_t>(face - 1)];
  if (failed) return 1;
  const auto evaluate = [&] {
    const bool swapped = state.host_faces[static_cast<std::size_t>(face - 1)].swapped;
    const Evaluators::Surface surface = state.evaluators.surface(static_cast<std::size_t>(face - 1));
    if (swapped) std::swap(Su, Sv), std::swap(Suu, Svv);
    gp_Pnt p;
    gp_Vec d1u, d1v, d2u, d2v, d2uv;
    for_each_by_patch(surface, n, uv, swapped, [&](int64_t i) {
      const double u = uv[2 * i + (swapped ? 1 : 0)], v = uv[2 * i + (swapped ? 0 : 1)];
      if (order >= 2) {
        surface.d2(u, v, p, d1u, d1v, d2u, d2v, d2uv);
        store(d2u, Suu + 3 * i), store(d2uv, Suv + 3 * i), store(d2v, Svv + 3 * i);
      } else if (order == 1) {
        surface.d1(u, v, p, d1u, d1v);
      } else {
        surface.d0(u, v, p);
      }
      store(p, S + 3 * i);
      if (order >= 1) store(d1u, Su + 3 * i), store(d1v, Sv + 3 * i);
    });
  };
  if (state.evaluators.is_closed_form(static_cast<std::size_t>(face - 1))) return evaluate(), 0;
  return state.answer_guarded(face, failed, evaluate);
}

// S(u, v) is the edge at t = u, whatever v; its curve is (t, 0).
int32_t BrepHost::State::wire_batch(int32_t face, int64_t n, const double* uv, int32_t order, double* S, double* Su,
                                    double* Sv, double* Suu, double* Suv, double* Svv) noexcept {
  std::atomic<bool>& failed = surface_failed[static_cast<std::size_t>(face - 1)];
  if (failed) return 1;
  return answer_guarded(face, failed, [&] {
    const std::size_t edge = static_cast<std::size_t>(face - 1) - host_faces.size();
    const gp_Vec none(0, 0, 0);
    gp_Pnt p;
    gp_Vec d1, d2;
    for (int64_t i = 0; i < n; ++i) {
      wire_curves.evaluate(edge, uv[2 * i], order, p, d1, d2);
      store(p, S + 3 * i);
      if (order >= 1) store(d1, Su + 3 * i), store(none, Sv + 3 * i);
      if (order >= 2) store(d2, Suu + 3 * i), store(none, Suv + 3 * i), store(none, Svv + 3 * i);
    }
  });
}

int32_t BrepHost::State::interval(int32_t face, int32_t ic, double* a, double* b, void* user) noexcept {
  if (const LooseEdge* wire = static_cast<State*>(user)->wire(face); wire != nullptr)
    return *a = wire->first, *b = wire->last, 0;
  const HostCurve& curve = static_cast<State*>(user)
                               ->host_faces[static_cast<std::size_t>(face - 1)]
                               .curves[static_cast<std::size_t>(ic - 1)];
  *a = curve.first, *b = curve.last;
  return 0;
}

int32_t BrepHost::State::curve(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt,
                               void* user) noexcept {
  auto& state = *static_cast<State*>(user);
  if (state.wire(face) != nullptr) {
    C[0] = t, C[1] = 0;
    if (order >= 1) Ct[0] = 1, Ct[1] = 0;
    if (order >= 2) Ctt[0] = Ctt[1] = 0;
    return 0;
  }
  std::atomic<bool>& failed = state.curves_failed[static_cast<std::size_t>(face - 1)];
  if (failed) return 1;
  const auto evaluate = [&] {
    const Evaluators::Curve curve =
        state.evaluators.curve(static_cast<std::size_t>(face - 1), static_cast<std::size_t>(ic - 1));
    gp_Pnt2d p;
    gp_Vec2d d1, d2;
    if (order >= 2)
      curve.d2(t, p, d1, d2);
    else if (order == 1)
      curve.d1(t, p, d1);
    else
      curve.d0(t, p);
    const int x = state.host_faces[static_cast<std::size_t>(face - 1)].swapped ? 1 : 0, y = 1 - x;
    C[x] = p.X(), C[y] = p.Y();
    if (order >= 1) Ct[x] = d1.X(), Ct[y] = d1.Y();
    if (order >= 2) Ctt[x] = d2.X(), Ctt[y] = d2.Y();
  };
  if (state.evaluators.is_closed_form(static_cast<std::size_t>(face - 1), static_cast<std::size_t>(ic - 1)))
    return evaluate(), 0;
  return state.answer_guarded(face, failed, evaluate);
}

}  // namespace carreau_occ
