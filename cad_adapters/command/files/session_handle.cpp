// SPDX-License-Identifier: BSD-3-Clause
#include "files/session_handle.h"

#include <cstdio>

namespace command {

namespace {

void print(std::int32_t level, const char* text, void*) {
  if (level <= CARREAU_LEVEL_WARNING) std::fprintf(stderr, "carreau: %s\n", text);
}

}  // namespace

SessionHandle make_session() {
  carreau_session* session = nullptr;
  if (carreau_session_create(&session) != CARREAU_OK) throw Failure("There is no memory for a session.");
  SessionHandle handle(session);
  require(session, carreau_set_message_callback(session, print, nullptr));
  return handle;
}

void require(carreau_session* session, carreau_status status) {
  if (status == CARREAU_OK) return;
  const std::string sentence = carreau_last_error(session);
  throw Failure(sentence.empty() ? carreau_status_meaning(status) : sentence);
}

}  // namespace command
