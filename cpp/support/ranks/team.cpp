// SPDX-License-Identifier: BSD-3-Clause
#include "support/ranks/team.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>

#include "support/error.h"
#include "support/ranks/packet.h"

namespace carreau {

namespace {

/// Codes in messages; a value never means another class. `other`: no class of ours.
enum class ErrorKind : int { other, argument, model, file, callback, domain, limit, cancelled, plain, memory };

std::string packed(ErrorKind kind, const char* sentence, const Where& where) {
  PacketWriter packet;
  packet.put(static_cast<std::int64_t>(kind));
  packet.put(where);
  packet.put(std::string_view(sentence));
  return packet.take();
}

template <typename E>
[[noreturn]] void raise_as(const Where& where, const std::string& teller, const std::string& rest) {
  if (teller.empty()) throw E(where, rest);
  // The place is in the sentence once, behind the teller.
  throw E(teller + where.prefix() + rest);
}

std::string digits_of(std::uint64_t hash) {
  std::string digits(16, '0');
  for (auto d = digits.rbegin(); d != digits.rend(); ++d, hash >>= 4) *d = "0123456789abcdef"[hash & 15U];
  return digits;
}

constexpr std::int64_t none_left = std::int64_t{1} << 40;  // more than jobs, and far from overflow for any number of ranks

}  // namespace

SharedError SharedError::of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const InvalidArgument& e) {
    return {packed(ErrorKind::argument, e.what(), e.where())};
  } catch (const InvalidModel& e) {
    return {packed(ErrorKind::model, e.what(), e.where())};
  } catch (const FileError& e) {
    return {packed(ErrorKind::file, e.what(), e.where())};
  } catch (const CallbackError& e) {
    return {packed(ErrorKind::callback, e.what(), e.where())};
  } catch (const DomainError& e) {
    return {packed(ErrorKind::domain, e.what(), e.where())};
  } catch (const LimitError& e) {
    return {packed(ErrorKind::limit, e.what(), e.where())};
  } catch (const Cancelled& e) {
    return {packed(ErrorKind::cancelled, e.what(), e.where())};
  } catch (const Error& e) {
    return {packed(ErrorKind::plain, e.what(), e.where())};
  } catch (const std::bad_alloc&) {
    return {packed(ErrorKind::memory, "there is not enough memory", {})};
  } catch (const std::exception& e) {
    return {packed(ErrorKind::other, e.what(), {})};
  } catch (...) {
    return {packed(ErrorKind::other, "unknown exception", {})};
  }
}

void SharedError::raise(const std::string& teller) const {
  if (!any()) throw LimitError(teller + "there is not enough memory");
  PacketReader packet(bytes);
  const auto kind = static_cast<ErrorKind>(packet.integer());
  const Where where = packet.where();
  std::string sentence = packet.text();
  const std::string prefix = where.prefix();
  if (sentence.starts_with(prefix)) sentence.erase(0, prefix.size());
  switch (kind) {
    case ErrorKind::argument:
      raise_as<InvalidArgument>(where, teller, sentence);
    case ErrorKind::model:
      raise_as<InvalidModel>(where, teller, sentence);
    case ErrorKind::file:
      raise_as<FileError>(where, teller, sentence);
    case ErrorKind::callback:
      raise_as<CallbackError>(where, teller, sentence);
    case ErrorKind::domain:
      raise_as<DomainError>(where, teller, sentence);
    case ErrorKind::limit:
    case ErrorKind::memory:
      raise_as<LimitError>(where, teller, sentence);
    case ErrorKind::cancelled:
      raise_as<Cancelled>(where, teller, sentence);
    case ErrorKind::plain:
      raise_as<Error>(where, teller, sentence);
    case ErrorKind::other:
      break;
  }
  throw std::runtime_error(teller + sentence);
}

std::optional<std::size_t> Team::take(std::size_t n) {
  const std::int64_t next = link_.take(1);
  if (next < 0 || static_cast<std::uint64_t>(next) >= n) return std::nullopt;
  return static_cast<std::size_t>(next);
}

void Team::stop_taking() { link_.take(none_left); }

std::string Team::teller(int rank) const {
  return "rank " + std::to_string(rank) + " of " + std::to_string(size()) + ": ";
}

// A process that leaves reports this in place of a step.
std::vector<std::string> Team::exchange(std::string_view step, std::string_view mine) {
  if (over_) throw Cancelled("another process has left the run");
  PacketWriter packet;
  packet.put(false);
  packet.put(++step_);
  packet.put(step);
  packet.put(mine);
  std::vector<std::string> all;
  try {
    all = link_.exchange(packet.bytes());
    packet = {};
  } catch (const Error&) {  // in all processes
    over_ = true;
    throw;
  }
  refuse_leavers(all);
  std::vector<std::string> given;
  for (std::size_t r = 0; r < all.size(); ++r) {
    PacketReader reader(all[r]);
    reader.flag();
    const std::int64_t number = reader.integer();
    const std::string name = reader.text();
    if (number != step_ || name != step) {
      over_ = true;
      throw Error("the processes do not make the same mesh: rank " + std::to_string(r) + " is at \"" + name +
                  "\" (step " + std::to_string(number) + "), rank " + std::to_string(rank()) + " at \"" +
                  std::string(step) + "\" (step " + std::to_string(step_) + ")");
    }
    const std::size_t size = reader.count(1);
    all[r].erase(0, all[r].size() - size);  // the text before it
    given.push_back(std::move(all[r]));
  }
  return given;
}

std::vector<std::string> Team::exchange_results(std::string_view step, const std::function<std::string()>& mine) {
  PacketWriter packet;
  try {
    const std::string result = mine();
    packet.put(false);
    packet.put(std::string_view(result));
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {
    packet.put(true);
    packet.put(std::string_view(SharedError::of(std::current_exception()).bytes));
  }
  std::vector<std::string> all = exchange(step, packet.bytes());
  for (std::string& each : all) {
    PacketReader reader(each);
    const bool failed = reader.flag();
    std::string bytes = reader.text();
    if (failed) SharedError{std::move(bytes)}.raise();
    each = std::move(bytes);
  }
  return all;
}

void Team::exchange_in_turn(std::string_view step, std::string mine, const std::function<void(int, const std::string&)>& use) {
  for (int r = 0; r < size(); ++r) {
    const std::vector<std::string> all = exchange(step, r == rank() ? std::string_view(mine) : std::string_view());
    if (r == rank()) mine = {};
    use(r, all[static_cast<std::size_t>(r)]);
  }
}

void Team::refuse_leavers(const std::vector<std::string>& all) {
  for (std::size_t r = 0; r < all.size(); ++r) {
    PacketReader reader(all[r]);
    if (!reader.flag()) continue;
    over_ = true;
    SharedError{reader.at_end() ? "" : reader.text()}.raise(teller(static_cast<int>(r)));
  }
}

// The rest is an error in all processes.
int Team::first_other(std::string_view step, std::string_view mine) {
  const std::vector<std::string> all = exchange(step, mine);
  for (std::size_t r = 1; r < all.size(); ++r)
    if (all[r] != all[0]) {
      over_ = true;
      return static_cast<int>(r);
    }
  return 0;
}

// Others wait for this process at their next exchange.
void Team::leave(const SharedError& error) noexcept {
  if (over_) return;
  over_ = true;
  constexpr std::int64_t yes = 1;  // as PacketWriter puts it
  std::string_view told(reinterpret_cast<const char*>(&yes), sizeof yes);
  PacketWriter packet;
  try {
    packet.put(true);
    packet.put(std::string_view(error.bytes));
    told = packet.bytes();
  } catch (...) {  // no memory: that this process leaves must do
  }
  try {
    link_.exchange(told);
  } catch (...) {  // the other processes know, or the link has failed for them, too
  }
}

void Team::run(const std::function<void()>& body) {
  step_ = 0, over_ = false;
  try {
    body();
    exchange("end", "");
  } catch (...) {
    const std::exception_ptr error = std::current_exception();
    try {
      leave(SharedError::of(error));
    } catch (...) {  // no memory for the sentence
      leave({});
    }
    std::rethrow_exception(error);
  }
}

void LongChecksum::add(const void* from, std::size_t size) noexcept {
  const auto* bytes = static_cast<const unsigned char*>(from);
  for (; size > 0;) {
    std::uint64_t word = 0;
    const std::size_t n = std::min(size, sizeof word);
    std::memcpy(&word, bytes, n);
    add(word);
    bytes += n, size -= n;
  }
}

std::string LongChecksum::text() const { return digits_of(hash_); }

std::string checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return digits_of(hash);
}

}  // namespace carreau
