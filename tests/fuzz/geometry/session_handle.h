// SPDX-License-Identifier: BSD-3-Clause
// A session that frees itself.
#pragma once

#include <carreau.h>

#include <stdexcept>

namespace geometry_fuzz {

class SessionHandle {
 public:
  SessionHandle() {
    if (carreau_session_create(&session_) != CARREAU_OK) throw std::runtime_error("no session");
  }
  ~SessionHandle() { carreau_session_free(session_); }
  SessionHandle(const SessionHandle&) = delete;
  SessionHandle& operator=(const SessionHandle&) = delete;
  operator carreau_session*() const noexcept { return session_; }  // NOLINT: for the functions of the interface

 private:
  carreau_session* session_ = nullptr;
};

template <typename Struct>
Struct sized() {
  Struct value{};
  value.struct_size = sizeof value;
  return value;
}

}  // namespace geometry_fuzz
