// SPDX-License-Identifier: BSD-3-Clause
// The only place where an exception becomes a status.
#pragma once

#include <cfenv>
#include <new>

#include "handles.h"
#include "place_in_sentence.h"
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

/// Runs body() and returns the status of its exception. `on_error(sentence, where)` keeps the sentence; it may throw.
template <typename Body, typename OnError>
carreau_status status_of(Body&& body, OnError&& on_error) noexcept {
  const auto fail = [&](carreau_status status, const char* sentence, const Where& where) noexcept {
    try {
      on_error(sentence, where);
    } catch (...) {  // no memory for the sentence: the status alone must do
    }
    return status;
  };
  try {
    body();
    return CARREAU_OK;
  } catch (const StatusError& error) {
    return fail(error.status, error.what(), error.where());
  } catch (const InvalidArgument& error) {
    return fail(CARREAU_ERR_ARGUMENT, error.what(), error.where());
  } catch (const InvalidModel& error) {
    return fail(CARREAU_ERR_MODEL, error.what(), error.where());
  } catch (const FileError& error) {
    return fail(CARREAU_ERR_FILE, error.what(), error.where());
  } catch (const CallbackError& error) {
    return fail(CARREAU_ERR_CALLBACK, error.what(), error.where());
  } catch (const DomainError& error) {
    // When no face could be meshed, the sentence quotes the reason of the first one.
    return fail(CARREAU_ERR_DOMAIN, error.what(),
                error.where().face != 0 ? error.where() : place_in_sentence(error.what()));
  } catch (const LimitError& error) {
    return fail(CARREAU_ERR_LIMIT, error.what(), error.where());
  } catch (const Cancelled& error) {
    return fail(CARREAU_ERR_CANCELLED, error.what(), error.where());
  } catch (const std::bad_alloc&) {
    return fail(CARREAU_ERR_MEMORY, "out of memory", {});
  } catch (const std::exception& error) {
    return fail(CARREAU_ERR_INTERNAL, error.what(), {});
  } catch (...) {
    return fail(CARREAU_ERR_INTERNAL, "unknown exception", {});
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
  return status_of(body, [&slot](const char* sentence, const Where& where) { slot.keep(sentence, where); });
}

/// Faces of a mesh outside of sessions: references of triangles, and the known properties of faces.
std::vector<carreau_mesh::FaceOfFile> faces_of(const FlatMesh& flat);

/// A mesh that lacks faces is there, but the caller must know: throws CARREAU_ERR_PARTIAL then.
void report_failed_faces(const Session& session);

}  // namespace carreau::abi
