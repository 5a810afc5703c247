// SPDX-License-Identifier: BSD-3-Clause
#include "carreau.h"

namespace {

#define CARREAU_TEXT_OF(x) #x
#define CARREAU_EXPANDED_TEXT_OF(x) CARREAU_TEXT_OF(x)

}  // namespace

const char* carreau_status_name(carreau_status status) {
  switch (status) {
#define CARREAU_NAME_CASE(symbol, value, meaning) \
  case value:                                     \
    return #symbol;
    CARREAU_STATUS_TABLE(CARREAU_NAME_CASE)
#undef CARREAU_NAME_CASE
    default:
      return "CARREAU_UNKNOWN_STATUS";
  }
}

const char* carreau_status_meaning(carreau_status status) {
  switch (status) {
#define CARREAU_MEANING_CASE(symbol, value, meaning) \
  case value:                                        \
    return meaning;
    CARREAU_STATUS_TABLE(CARREAU_MEANING_CASE)
#undef CARREAU_MEANING_CASE
    default:
      return "unknown status";
  }
}

const char* carreau_version(void) {
  return CARREAU_EXPANDED_TEXT_OF(CARREAU_VERSION_MAJOR) "." CARREAU_EXPANDED_TEXT_OF(
      CARREAU_VERSION_MINOR) "." CARREAU_EXPANDED_TEXT_OF(CARREAU_VERSION_PATCH);
}

int32_t carreau_version_number(void) {
  return CARREAU_VERSION_MAJOR * 10000 + CARREAU_VERSION_MINOR * 100 + CARREAU_VERSION_PATCH;
}
