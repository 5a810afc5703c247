// SPDX-License-Identifier: BSD-3-Clause
#include "carreau.h"

#include <new>

#include "guard.h"
#include "place_in_sentence.h"

namespace carreau::abi {

carreau_status status_of_exception(ErrorSlot* slot) noexcept {
  const auto fail = [slot](carreau_status status, const char* sentence, const Where& where) noexcept {
    try {
      if (slot != nullptr) slot->keep(sentence, where);
    } catch (...) {  // no memory for the sentence: the status alone must do
    }
    return status;
  };
  try {
    throw;
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

}  // namespace carreau::abi

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
