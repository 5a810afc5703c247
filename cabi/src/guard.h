// SPDX-License-Identifier: BSD-3-Clause
// The only place where an exception becomes a status.
#pragma once

#include <cfenv>

#include "handles.h"
#include "support/error.h"

namespace carreau::abi {

/// An error whose status no class of the engine stands for.
struct StatusError : Error {
  StatusError(carreau_status status_of, const std::string& sentence) : Error(sentence), status(status_of) {}
  carreau_status status;
};

/// The engine computes in the default floating-point environment (round to nearest, no traps: a host may have set
/// others), and the caller gets his own back.
class FloatingPointScope {
 public:
  FloatingPointScope() noexcept {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~FloatingPointScope() { std::fesetenv(&saved_); }
  FloatingPointScope(const FloatingPointScope&) = delete;
  FloatingPointScope& operator=(const FloatingPointScope&) = delete;

 private:
  std::fenv_t saved_;
};

/// Marks a handle as busy; owned() is false when it was so already: the call comes from inside a callback.
class BusyScope {
 public:
  explicit BusyScope(std::atomic<bool>& busy) noexcept
      : busy_(busy), owned_(!busy.exchange(true, std::memory_order_acq_rel)) {}
  ~BusyScope() {
    if (owned_) busy_.store(false, std::memory_order_release);
  }
  BusyScope(const BusyScope&) = delete;
  BusyScope& operator=(const BusyScope&) = delete;
  [[nodiscard]] bool owned() const noexcept { return owned_; }

 private:
  std::atomic<bool>& busy_;
  bool owned_;
};

/// Returns the status of the exception that is being handled, and keeps its sentence in `slot` if there is one.
carreau_status status_of_exception(ErrorSlot* slot) noexcept;

/// Runs body() and returns the status of its exception.
template <typename Body>
carreau_status status_of(Body&& body, ErrorSlot* slot = nullptr) noexcept {
  try {
    body();
    return CARREAU_OK;
  } catch (...) {
    return status_of_exception(slot);
  }
}

/// The frame of every function of the interface that has a handle: rejects NULL and calls from inside a callback, runs
/// body(), keeps the error.
template <typename Handle, typename Body>
carreau_status guarded(Handle* handle, Body&& body) noexcept {
  if (handle == nullptr) return CARREAU_ERR_ARGUMENT;
  const BusyScope busy(handle->busy_flag());
  if (!busy.owned()) return CARREAU_ERR_BUSY;
  const FloatingPointScope floating_point;
  ErrorSlot& slot = handle->error;
  slot.clear();
  return status_of(body, &slot);
}

/// Faces of a mesh outside of sessions: references of triangles, and the known properties of faces.
std::vector<carreau_mesh::FaceOfFile> faces_of(const FlatMesh& flat);

/// A mesh that lacks faces is there, but the caller must know: throws CARREAU_ERR_PARTIAL then.
void report_failed_faces(const Session& session);

}  // namespace carreau::abi
