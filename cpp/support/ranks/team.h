// SPDX-License-Identifier: BSD-3-Clause
// Processes that make one mesh together: each holds all that is small, and the jobs are dealt out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "support/error.h"
#include "support/vec.h"

namespace carreau {

/// How the processes of a team reach each other: one class a communication library.
class TeamLink {
 public:
  virtual ~TeamLink() = default;
  /// Of this process, from 0; the same as long as the object lives.
  [[nodiscard]] virtual int rank() const noexcept = 0;
  [[nodiscard]] virtual int size() const noexcept = 0;
  /// take() may be called from several threads at a time; false: only from the thread that runs.
  [[nodiscard]] virtual bool takes_from_any_thread() const noexcept = 0;
  /// Adds `count` to a number that all processes share, and gives what it was before. exchange() makes it 0. Throws Error.
  virtual std::int64_t take(std::int64_t count) = 0;
  /// Waits for all processes, and gives what each has given, by rank. Throws Error when it has failed, which it does in
  /// all processes or in none, and std::bad_alloc in one that has no memory for the answer.
  virtual std::vector<std::string> exchange(std::string_view mine) = 0;
};

/// The error of one process, to be thrown in all of them.
struct SharedError {
  std::string bytes;  ///< empty: none, or no memory to tell it

  /// Of an exception.
  static SharedError of(const std::exception_ptr& error);
  [[nodiscard]] bool any() const noexcept { return !bytes.empty(); }
  /// Throws one of the class, sentence and place of the first; `teller` comes before the sentence ("rank 2: ").
  /// Another process's lack of memory is a LimitError.
  [[noreturn]] void raise(const std::string& teller = "") const;
};

/// What a run of a team keeps to: all processes take part in the same exchanges in the same order, and one that leaves
/// the run by an error tells the others at their next exchange. Used by the thread that runs, but for take().
class Team {
 public:
  /// Keeps a reference to `link`.
  explicit Team(TeamLink& link) : link_(link) {}

  [[nodiscard]] int rank() const noexcept { return link_.rank(); }
  [[nodiscard]] int size() const noexcept { return link_.size(); }
  [[nodiscard]] bool takes_from_any_thread() const noexcept { return link_.takes_from_any_thread(); }

  /// The next job of `n` that no process has taken since the last exchange; empty: there is none left.
  std::optional<std::size_t> take(std::size_t n);
  /// No process takes a job any more until the next exchange.
  void stop_taking();
  /// What all processes give for `step`, by rank. Throws the error of a process that has left the run, and Error where
  /// processes are at different steps.
  std::vector<std::string> exchange(std::string_view step, std::string_view mine);
  /// The same of what mine() gives, which may throw: the error of the first process that has one comes out of all, with its class
  /// and sentence. A stop, and what is no Error, are thrown at once: the process leaves the run.
  std::vector<std::string> exchange_results(std::string_view step, const std::function<std::string()>& mine);
  /// The same of much: use(rank, what it gives) for one process after another, so that none ever holds what all give.
  void exchange_in_turn(std::string_view step, std::string mine, const std::function<void(int, const std::string&)>& use);
  /// Throws Failure with `sentence(rank)` of the first process whose value is another one than that of rank 0.
  template <typename Failure = Error>
  void require_same(std::string_view step, std::string_view mine, const std::function<std::string(int)>& sentence) {
    if (const int rank = first_other(step, mine); rank > 0) throw Failure(sentence(rank));
  }

  /// Calls body(), a whole run, in all processes: what it throws in one of them reaches all. All must call it.
  void run(const std::function<void()>& body);

 private:
  int first_other(std::string_view step, std::string_view mine);  // 0: there is none
  void refuse_leavers(const std::vector<std::string>& all);
  void leave(const SharedError& error) noexcept;
  [[nodiscard]] std::string teller(int rank) const;

  TeamLink& link_;
  std::int64_t step_ = 0;
  bool over_ = false;  // some process has left the run: none waits for another one any more
};

/// Sums up values that are too many to be copied for checksum(): FNV-1a of words of 64 bits, with their halves folded,
/// since a product carries upwards only. All processes must add the same arrays in the same order.
class LongChecksum {
 public:
  template <typename T>
  void add(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3>);
    add(values.size());
    add(values.data(), values.size() * sizeof(T));
  }
  void add(std::uint64_t word) noexcept {
    hash_ = (hash_ ^ word) * 0x100000001b3U;
    hash_ ^= hash_ >> 32;
  }
  /// As 16 digits.
  [[nodiscard]] std::string text() const;

 private:
  void add(const void* from, std::size_t size) noexcept;

  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

/// 64 bits of FNV-1a (Fowler, Noll, Vo), as 16 digits.
std::string checksum(std::string_view bytes);

}  // namespace carreau
