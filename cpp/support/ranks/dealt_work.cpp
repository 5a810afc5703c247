// SPDX-License-Identifier: BSD-3-Clause
#include "support/ranks/dealt_work.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <utility>

#include "support/error.h"
#include "support/ranks/packet.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

using Work = std::function<std::string(std::size_t, Monitor&)>;

/// The completed work of this process. Used by several threads.
class Done {
 public:
  void add(std::size_t i, std::string result, SharedError error) {
    const std::scoped_lock lock(mutex_);
    pieces_.push_back({i, std::move(result), std::move(error)});
  }
  /// `error`: of the process itself, or none.
  std::string packed(const SharedError& error) {
    PacketWriter packet;
    packet.put(std::string_view(error.bytes));
    packet.put(static_cast<std::int64_t>(pieces_.size()));
    for (Piece& piece : pieces_) {
      packet.put(static_cast<std::int64_t>(piece.i));
      packet.put(std::string_view(piece.error.bytes));
      packet.put(std::string_view(std::exchange(piece.result, {})));
    }
    return packet.take();
  }

 private:
  struct Piece {
    std::size_t i;
    std::string result;
    SharedError error;
  };
  std::mutex mutex_;
  std::vector<Piece> pieces_;
};

/// Takes work until none is left. If only the calling thread may take, other threads do the work that it took.
class Taker final : public SteppedTask {
 public:
  Taker(Team& team, std::size_t n, const Work& work, Done& all) : team_(team), n_(n), work_(work), all_(all) {}

  [[nodiscard]] bool finished() const override { return finished_; }
  [[nodiscard]] bool bound() const override { return !next_ && !team_.takes_from_any_thread(); }
  void step(Monitor& monitor) override {
    if (!next_) {
      next_ = team_.take(n_);
      finished_ = !next_;
      return;
    }
    const std::size_t i = *std::exchange(next_, std::nullopt);
    try {
      all_.add(i, work_(i, monitor), {});
    } catch (const Cancelled&) {  // of the process
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (...) {
      all_.add(i, {}, SharedError::of(std::current_exception()));
    }
  }

 private:
  Team& team_;
  std::size_t n_;
  const Work& work_;
  Done& all_;
  std::optional<std::size_t> next_;
  bool finished_ = false;
};

// An error that only this process has; empty if all work has ended.
SharedError do_own_share(Team& team, std::size_t n, int threads, const Work& work, Done& done, Monitor& monitor) {
  try {
    std::vector<std::unique_ptr<SteppedTask>> takers;
    for (int t = 0; t < std::max(threads, 1); ++t) takers.push_back(std::make_unique<Taker>(team, n, work, done));
    run_stepped(takers, {.threads = threads}, monitor);
  } catch (...) {
    team.stop_taking();
    return SharedError::of(std::current_exception());
  }
  return {};
}

/// One piece of work as all processes get it.
struct Result {
  std::string bytes;
  SharedError error;
  bool known = false;
};

void read(std::string_view packet, const std::string& teller, std::vector<Result>& results) {
  PacketReader reader(packet);
  if (const SharedError error{reader.text()}; error.any()) error.raise(teller);
  for (std::size_t k = reader.count(sizeof(std::int64_t)); k > 0; --k) {
    const auto i = static_cast<std::uint64_t>(reader.integer());
    if (i >= results.size()) throw Error(teller + "has sent unknown work");
    results[i].error.bytes = reader.text();
    results[i].bytes = reader.text();
    results[i].known = true;
  }
}

}  // namespace

std::vector<std::string> deal_out(Team& team, std::string_view step, std::size_t n, int threads, const Work& work,
                                  Monitor& monitor) {
  Done done;
  const SharedError own = do_own_share(team, n, threads, work, done, monitor);
  std::vector<Result> results(n);
  team.exchange_in_turn(step, done.packed(own), [&](int rank, const std::string& packet) {
    read(packet, "rank " + std::to_string(rank) + ": ", results);
  });
  std::vector<std::string> bytes;
  bytes.reserve(n);
  for (Result& result : results) {
    if (result.error.any()) result.error.raise();
    if (!result.known) throw Error("no process has done a distributed piece of work");  // a process has stopped
    bytes.push_back(std::move(result.bytes));
  }
  return bytes;
}

}  // namespace carreau
