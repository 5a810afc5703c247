// SPDX-License-Identifier: BSD-3-Clause
// Processes that make one mesh together: each holds all small data, and the jobs are distributed.
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

/// The link between the processes of a team: one class a communication library.
class TeamLink {
 public:
  virtual ~TeamLink() = default;
  /// Rank of this process, from 0; constant while the object lives.
  [[nodiscard]] virtual int rank() const noexcept = 0;
  [[nodiscard]] virtual int size() const noexcept = 0;
  /// take() may be called from several threads at a time; false: only from the thread that runs.
  [[nodiscard]] virtual bool takes_from_any_thread() const noexcept = 0;
  /// Adds `count` to a number that all processes share, and returns its previous value. exchange() makes it 0. Throws
  /// Error.
  virtual std::int64_t take(std::int64_t count) = 0;
  /// Waits for all processes, and returns the values that they gave, by rank. Throws Error when it has failed, which it
  /// does in all processes or in none, and std::bad_alloc in one that has no memory for the answer.
  virtual std::vector<std::string> exchange(std::string_view mine) = 0;
};

/// The error of one process, to be thrown in all of them.
struct SharedError {
  std::string bytes;  ///< empty: no error, or no memory to describe it

  /// Describes an exception.
  static SharedError of(const std::exception_ptr& error);
  [[nodiscard]] bool any() const noexcept { return !bytes.empty(); }
  /// Throws one of the class, sentence and place of the first; `teller` comes before the sentence ("rank 2: ").
  /// Another process's lack of memory is a LimitError.
  [[noreturn]] void raise(const std::string& teller = "") const;
};

/// All processes take part in equal exchanges in equal order. A process that leaves the run by an error informs the
/// others at their next exchange. The running thread uses it, except for take().
class Team {
 public:
  /// Keeps a reference to `link`.
  explicit Team(TeamLink& link) : link_(link) {}

  [[nodiscard]] int rank() const noexcept { return link_.rank(); }
  [[nodiscard]] int size() const noexcept { return link_.size(); }
  [[nodiscard]] bool takes_from_any_thread() const noexcept { return link_.takes_from_any_thread(); }

  /// The next job of `n` that no process has taken since the last exchange; empty: all jobs are taken.
  std::optional<std::size_t> take(std::size_t n);
  /// No process takes a job any more until the next exchange.
  void stop_taking();
  /// Returns the values of all processes for `step`, by rank. Throws the error of a process that has left the run, and
  /// Error if processes are at different steps.
  std::vector<std::string> exchange(std::string_view step, std::string_view mine);
  /// exchange() of the results of mine(), which may throw: all processes throw the error of the first process that has one, with
  /// its class and sentence. Throws stops, and exceptions that are not Errors, at once: the process leaves the run.
  std::vector<std::string> exchange_results(std::string_view step, const std::function<std::string()>& mine);
  /// Like exchange_results() for large values: calls use(rank, value) for one process after another, so that no process
  /// ever holds all values.
  void exchange_in_turn(std::string_view step, std::string mine, const std::function<void(int, const std::string&)>& use);
  /// Throws Failure with `sentence(rank)` of the first process whose value differs from the value of rank 0.
  template <typename Failure = Error>
  void require_same(std::string_view step, std::string_view mine, const std::function<std::string(int)>& sentence) {
    if (const int rank = first_other(step, mine); rank > 0) throw Failure(sentence(rank));
  }

  /// Calls body(), a whole run, in all processes: an exception in one of them reaches all. All must call it.
  void run(const std::function<void()>& body);

 private:
  int first_other(std::string_view step, std::string_view mine);  // 0: all values agree
  void refuse_leavers(const std::vector<std::string>& all);
  void leave(const SharedError& error) noexcept;
  [[nodiscard]] std::string teller(int rank) const;

  TeamLink& link_;
  std::int64_t step_ = 0;
  bool over_ = false;  // a process has left the run: no process waits for others any more
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
