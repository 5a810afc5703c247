// SPDX-License-Identifier: BSD-3-Clause
// Exceptions that a host throws although it must not.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <utility>

#include "support/error.h"

namespace carreau {

/// Result of `call`, which calls a host. Another exception than the engine's own (a stop, a status of the host) becomes
/// a CallbackError with its text. So the author of a C++ host learns where an exception escapes. std::bad_alloc passes.
template <typename Call>
decltype(auto) ask_host(const Where& where, const char* routine, Call&& call) {
  try {
    return std::forward<Call>(call)();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw CallbackError(where, std::string(routine) + " has thrown an exception: " + error.what());
  } catch (...) {
    throw CallbackError(where, std::string(routine) + " has thrown an exception");
  }
}

}  // namespace carreau
