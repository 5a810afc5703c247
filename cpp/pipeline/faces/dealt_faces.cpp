// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/faces/dealt_faces.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>

#include "support/error.h"
#include "support/ranks/packet.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

constexpr std::int64_t packet_version = 4;

using Message = std::pair<Level, std::string>;

/// Keeps the messages of one face.
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

/// Packets that this process sends. Several threads use it.
class Sent {
 public:
  explicit Sent(const DealtFaces& faces) : parts_(faces.parts), rank_(faces.team.rank()) {}
  void add(std::size_t job, const std::vector<Message>& messages, FaceOutcome& outcome) {
    PacketWriter packet = begun(job, messages);
    packet.put(false);
    (parts_ ? outcome.without_patch(rank_) : outcome).put(packet);
    keep(packet);
    if (!parts_ || !outcome.patch) return;
    const std::scoped_lock lock(mutex_);
    outcome.space.reset();
    kept_.emplace(job, std::move(*outcome.patch));
  }
  /// Takes the outcome of a job that this process has done and has sent to the others; once.
  void give_kept(std::size_t job, FaceOutcome& outcome) {
    const auto found = kept_.find(job);
    if (found == kept_.end()) return;
    outcome.patch = std::move(found->second);
    kept_.erase(found);
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
  /// It is too large for one process.
  void put_aside(std::size_t job) {
    const std::scoped_lock lock(mutex_);
    aside_.push_back(static_cast<std::int32_t>(job));
  }
  /// Jobs behind it need not be done.
  [[nodiscard]] std::size_t first_failed() const noexcept { return first_failed_.load(); }

  /// `error`: of the process itself, or none.
  std::string packed(const SharedError& error) {
    PacketWriter packet;
    packet.put(packet_version);
    packet.put(std::string_view(error.bytes));
    packet.put(aside_);
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

  bool parts_;
  int rank_;
  std::mutex mutex_;
  std::vector<std::string> faces_;
  std::map<std::size_t, PatchMesh> kept_;  // by job; if patches stay
  std::vector<std::int32_t> aside_;
  std::atomic<std::size_t> first_failed_{static_cast<std::size_t>(-1)};
};

/// Expected triangles by the samples of this process, beside the estimates by boundaries. Several threads use it.
class Promises {
 public:
  explicit Promises(const DealtFaces& faces)
      : faces_(faces), all_(std::accumulate(faces.expected.begin(), faces.expected.end(), 0.0)) {}
  /// True if the job is more than a process's share of all, by the estimates so far.
  bool too_large(std::size_t job, double promised) {
    const std::scoped_lock lock(mutex_);
    promised_ += promised, expected_ += faces_.expected[job];
    return promised > faces_.least_shared && promised * expected_ * faces_.team.size() > all_ * promised_;
  }

 private:
  const DealtFaces& faces_;
  const double all_;
  std::mutex mutex_;
  double promised_ = 0, expected_ = 0;
};

/// Takes faces and meshes them, one after another, until no process has any left: as many as there are threads.
class Taker final : public SteppedTask {
 public:
  Taker(const DealtFaces& faces, Sent& sent, Promises& promises) : faces_(faces), sent_(sent), promises_(promises) {}

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
      if (put_aside()) return;
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

  // It has been sampled, and is the next step's of all.
  bool put_aside() {
    const double promised = job_->promised();
    if (promised == 0 || !promises_.too_large(i_, promised)) return false;
    sent_.put_aside(i_);
    job_ = nullptr;
    return true;
  }

  const DealtFaces& faces_;
  Sent& sent_;
  Promises& promises_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::vector<Message> messages_;
  FaceMonitor monitor_{messages_};
  FaceJob* job_ = nullptr;
  std::size_t i_ = 0;
  bool done_ = false;
};

// The error of this process alone; none if all faces ended.
SharedError mesh_own_share(const DealtFaces& faces, Sent& sent, Monitor& monitor) {
  try {
    Promises promises(faces);
    std::vector<std::unique_ptr<SteppedTask>> takers;
    for (int i = 0; i < std::max(faces.threads, 1); ++i) takers.push_back(std::make_unique<Taker>(faces, sent, promises));
    run_stepped(takers, {.threads = faces.threads}, monitor);
  } catch (...) {
    faces.team.stop_taking();
    return SharedError::of(std::current_exception());
  }
  return {};
}

/// A face that one process has made.
struct ReceivedFace {
  std::vector<Message> messages;
  SharedError error;
  std::optional<FaceOutcome> outcome;  ///< none with an error
};

/// Packets that all processes have sent.
struct Received {
  std::vector<std::optional<ReceivedFace>> faces;  ///< by job; none if no process has meshed it
  std::vector<std::size_t> aside;                  ///< jobs that all are to make together
};

ReceivedFace face_of(PacketReader& packet) {
  ReceivedFace face;
  for (std::size_t k = packet.count(2 * sizeof(std::int64_t)); k > 0; --k) {
    const auto level = static_cast<Level>(packet.integer());
    face.messages.emplace_back(level, packet.text());
  }
  if (packet.flag())
    face.error.bytes = packet.text();
  else
    face.outcome = FaceOutcome::from(packet);
  return face;
}

/// Throws the error of a process itself.
void read(const std::string& packet, const std::string& teller, Received& received) {
  PacketReader reader(packet);
  const auto known = [&](std::int64_t i) {
    if (static_cast<std::uint64_t>(i) >= received.faces.size()) throw Error(teller + " has sent an unknown face");
    return static_cast<std::size_t>(i);
  };
  if (reader.integer() != packet_version) throw Error(teller + " runs another version of the library");
  if (const SharedError error{reader.text()}; error.any()) error.raise(teller + ": ");
  for (const std::int32_t i : reader.integers()) received.aside.push_back(known(i));
  for (std::size_t k = reader.count(sizeof(std::int64_t)); k > 0; --k) {
    const std::string face = reader.text();
    PacketReader of_face(face);
    const std::size_t i = known(of_face.integer());
    received.faces[i] = face_of(of_face);
  }
}

/// A face that all have made.
struct SharedFace {
  std::vector<Message> messages;
  std::optional<FaceOutcome> outcome;
};
using SharedFaces = std::map<std::size_t, SharedFace>;  // by job

// All have made the patch: one of them keeps it.
void keep_by_one(const Team& team, std::size_t job, FaceOutcome& outcome) {
  if (!outcome.patch) return;
  const int rank = static_cast<int>(job % static_cast<std::size_t>(team.size()));
  if (rank != team.rank()) {
    outcome = outcome.without_patch(rank);
    return;
  }
  outcome.elsewhere = PatchElsewhere{rank, static_cast<std::int64_t>(outcome.patch->plane.triangles.size())};
  outcome.space.reset();
}

// One after the other, and each with all threads of all processes; from the beginning, although one of them may have sampled it.
void make_together(const DealtFaces& faces, std::span<const std::size_t> jobs, std::size_t begun, SharedFaces& made, Monitor& monitor) {
  for (const std::size_t i : jobs) {
    faces.on_begun(i, begun++);
    const std::unique_ptr<FaceJob> shared = static_cast<FaceJob&>(*faces.jobs[i]).shared();
    faces.jobs[i].reset();
    FaceJob& job = *shared;
    SharedFace& face = made[i];
    FaceMonitor of_face(face.messages);
    of_face.listen(monitor);
    while (!job.finished()) {
      monitor.checkpoint();
      job.step(of_face);
    }
    face.outcome = job.take_outcome();
    if (faces.parts) keep_by_one(faces.team, i, *face.outcome);
  }
}

void report(const std::vector<Message>& messages, Monitor& monitor) {
  for (const auto& [level, text] : messages) monitor.message(level, text);
}

}  // namespace

void mesh_dealt(const DealtFaces& faces, Monitor& monitor) {
  SharedFaces shared;
  make_together(faces, faces.shared, 0, shared, monitor);
  Sent sent(faces);
  const SharedError error = mesh_own_share(faces, sent, monitor);
  Received all{std::vector<std::optional<ReceivedFace>>(faces.jobs.size()), {}};
  faces.team.exchange_in_turn("patches", sent.packed(error), [&](int rank, const std::string& packet) {
    read(packet, "rank " + std::to_string(rank), all);
    monitor.checkpoint();
  });
  std::sort(all.aside.begin(), all.aside.end());
  make_together(faces, all.aside, faces.jobs.size() - all.aside.size(), shared, monitor);
  for (std::size_t i = 0; i < all.faces.size(); ++i) {
    if (const auto found = shared.find(i); found != shared.end()) {
      report(found->second.messages, monitor);
      faces.on_finished(i, *std::exchange(found->second.outcome, std::nullopt));
      continue;
    }
    if (!all.faces[i]) throw Error("no process has meshed a distributed face");  // a process has stopped
    ReceivedFace face = *std::exchange(all.faces[i], std::nullopt);
    report(face.messages, monitor);
    if (!face.outcome) face.error.raise();
    sent.give_kept(i, *face.outcome);
    faces.on_finished(i, std::move(*face.outcome));
  }
}

}  // namespace carreau
