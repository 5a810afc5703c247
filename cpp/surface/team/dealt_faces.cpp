// SPDX-License-Identifier: BSD-3-Clause
#include "surface/team/dealt_faces.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>
#include <utility>

#include "support/error.h"
#include "support/ranks/packet.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

constexpr std::int64_t packet_version = 2;

using Message = std::pair<Level, std::string>;

/// Keeps what one face says.
class FaceMonitor final : public Monitor {
 public:
  explicit FaceMonitor(std::vector<Message>& messages) : messages_(messages) {}
  /// The monitor of the step that runs now.
  void listen(Monitor& of_step) noexcept { of_step_ = &of_step; }
  void message(Level level, std::string_view text) override { messages_.emplace_back(level, text); }
  void checkpoint() override { of_step_->checkpoint(); }

 private:
  std::vector<Message>& messages_;
  Monitor* of_step_ = nullptr;
};

/// What this process sends. Used by several threads.
class Sent {
 public:
  void add(std::size_t job, const std::vector<Message>& messages, FaceOutcome& outcome) {
    PacketWriter packet = begun(job, messages);
    packet.put(false);
    outcome.put(packet);
    keep(packet);
  }
  void add_error(std::size_t job, const std::vector<Message>& messages, const SharedError& error) {
    PacketWriter packet = begun(job, messages);
    packet.put(true);
    packet.put(std::string_view(error.bytes));
    keep(packet);
    std::size_t first = first_failed_.load();
    while (job < first && !first_failed_.compare_exchange_weak(first, job)) {
    }
  }
  /// Jobs behind it need not be done.
  [[nodiscard]] std::size_t first_failed() const noexcept { return first_failed_.load(); }

  /// `error`: of the process itself, or none.
  std::string packed(const SharedError& error) {
    PacketWriter packet;
    packet.put(packet_version);
    packet.put(std::string_view(error.bytes));
    packet.put(static_cast<std::int64_t>(faces_.size()));
    for (std::string& face : faces_) packet.put(std::string_view(std::exchange(face, {})));
    return packet.take();
  }

 private:
  static PacketWriter begun(std::size_t job, const std::vector<Message>& messages) {
    PacketWriter packet;
    packet.put(static_cast<std::int64_t>(job));
    packet.put(static_cast<std::int64_t>(messages.size()));
    for (const auto& [level, text] : messages) packet.put(static_cast<std::int64_t>(level)), packet.put(std::string_view(text));
    return packet;
  }
  void keep(PacketWriter& packet) {
    const std::scoped_lock lock(mutex_);
    faces_.push_back(packet.take());
  }

  std::mutex mutex_;
  std::vector<std::string> faces_;
  std::atomic<std::size_t> first_failed_{static_cast<std::size_t>(-1)};
};

/// Takes faces and meshes them, one after another, until no process has any left: as many as there are threads.
class Taker final : public SteppedTask {
 public:
  Taker(const DealtFaces& faces, Sent& sent) : faces_(faces), sent_(sent) {}

  [[nodiscard]] bool finished() const override { return done_; }
  [[nodiscard]] bool bound() const override {
    return job_ != nullptr ? job_->bound() : !faces_.team.takes_from_any_thread();
  }
  void step(Monitor& monitor) override {
    if (job_ == nullptr)
      take();
    else
      work(monitor);
  }

 private:
  void take() {
    const std::optional<std::size_t> next = faces_.team.take(faces_.order.size());
    done_ = !next;
    if (done_) return;
    i_ = faces_.order[*next];
    if (i_ > sent_.first_failed()) return;
    job_ = static_cast<FaceJob*>(faces_.jobs[i_].get());
    messages_.clear();
    if (std::this_thread::get_id() == caller_) faces_.on_begun(i_, faces_.shared.size() + *next);
  }

  void work(Monitor& monitor) {
    monitor_.listen(monitor);
    try {
      job_->step(monitor_);
      if (!job_->finished()) return;
      FaceOutcome outcome = job_->take_outcome();
      sent_.add(i_, messages_, outcome);
    } catch (const Cancelled&) {  // of the process
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (...) {
      sent_.add_error(i_, messages_, SharedError::of(std::current_exception()));
    }
    job_ = nullptr;
    faces_.jobs[i_].reset();
  }

  const DealtFaces& faces_;
  Sent& sent_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::vector<Message> messages_;
  FaceMonitor monitor_{messages_};
  FaceJob* job_ = nullptr;
  std::size_t i_ = 0;
  bool done_ = false;
};

// The error that is nobody's but this process's; none when all went on to the end.
SharedError mesh_own_share(const DealtFaces& faces, Sent& sent, Monitor& monitor) {
  try {
    std::vector<std::unique_ptr<SteppedTask>> takers;
    for (int i = 0; i < std::max(faces.threads, 1); ++i) takers.push_back(std::make_unique<Taker>(faces, sent));
    run_stepped(takers, {.threads = faces.threads}, monitor);
  } catch (...) {
    faces.team.stop_taking();
    return SharedError::of(std::current_exception());
  }
  return {};
}

/// What all processes have sent, by job: empty where nobody has meshed it. Throws the error of a process itself.
std::vector<std::string> by_job(std::vector<std::string> packets, std::size_t n) {
  std::vector<std::string> faces(n);
  for (std::size_t r = 0; r < packets.size(); ++r) {
    PacketReader reader(packets[r]);
    const std::string teller = "rank " + std::to_string(r);
    if (reader.integer() != packet_version) throw Error(teller + " runs another version of the library");
    if (const SharedError error{reader.text()}; error.any()) error.raise(teller + ": ");
    for (std::size_t k = reader.count(sizeof(std::int64_t)); k > 0; --k) {
      std::string face = reader.text();
      const auto i = static_cast<std::uint64_t>(PacketReader(face).integer());
      if (i >= n) throw Error(teller + " has sent a face that nobody knows");
      faces[i] = std::move(face);
    }
    packets[r] = {};  // there may be little memory left
  }
  return faces;
}

/// A face that all have made.
struct SharedFace {
  std::vector<Message> messages;
  std::optional<FaceOutcome> outcome;
};

// One after the other, and each with all threads of all processes.
std::vector<SharedFace> make_together(const DealtFaces& faces, Monitor& monitor) {
  std::vector<SharedFace> made(faces.shared.size());
  for (std::size_t k = 0; k < made.size(); ++k) {
    const std::size_t i = faces.shared[k];
    faces.on_begun(i, k);
    auto& job = static_cast<FaceJob&>(*faces.jobs[i]);
    job.share();
    FaceMonitor of_face(made[k].messages);
    of_face.listen(monitor);
    while (!job.finished()) {
      monitor.checkpoint();
      job.step(of_face);
    }
    made[k].outcome = job.take_outcome();
    faces.jobs[i].reset();
  }
  return made;
}

void deliver(const DealtFaces& faces, std::size_t i, const std::string& bytes, Monitor& monitor) {
  PacketReader packet(bytes);
  packet.integer();
  for (std::size_t k = packet.count(2 * sizeof(std::int64_t)); k > 0; --k) {
    const auto level = static_cast<Level>(packet.integer());
    monitor.message(level, packet.text());
  }
  if (packet.flag()) SharedError{packet.text()}.raise();
  faces.on_finished(i, FaceOutcome::from(packet));
}

}  // namespace

void mesh_dealt(const DealtFaces& faces, Monitor& monitor) {
  std::vector<SharedFace> shared = make_together(faces, monitor);
  Sent sent;
  const SharedError error = mesh_own_share(faces, sent, monitor);
  std::vector<std::string> all = by_job(faces.team.exchange("patches", sent.packed(error)), faces.jobs.size());
  auto next = shared.begin();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (next != shared.end() && faces.shared[static_cast<std::size_t>(next - shared.begin())] == i) {
      for (const auto& [level, text] : next->messages) monitor.message(level, text);
      faces.on_finished(i, *std::exchange(next->outcome, std::nullopt));
      ++next;
      continue;
    }
    const std::string bytes = std::exchange(all[i], {});
    if (bytes.empty()) throw Error("no process has meshed a face that was dealt out");  // a process has stopped
    deliver(faces, i, bytes, monitor);
  }
}

}  // namespace carreau
