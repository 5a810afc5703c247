// SPDX-License-Identifier: BSD-3-Clause
// Seeds in processes of their own.
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "geometry_fuzz.h"

namespace geometry_fuzz {
namespace {

struct Options {
  std::string kind;
  std::uint64_t first = 1, count = 100;
  std::vector<std::uint64_t> seeds;  // run before the others
  unsigned seconds = 60;
  int jobs = 1;
};

/// The data that a killed process leaves behind.
struct Shared {
  std::uint64_t seed;
  std::uint64_t results[3];
  std::uint64_t faults;
  bool foreign;
};

Shared* of_process = nullptr;

constexpr std::uint64_t seeds_of_process = 1000;

// Time of the processor, which does not depend on other work of the machine; a run that waits for ever uses none.
void limit(unsigned seconds) {
  constexpr unsigned waiting = 20;
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  setitimer(ITIMER_PROF, &timer, nullptr);
  alarm(waiting * seconds);
}

[[noreturn]] void run_seeds(const Kind& kind, std::uint64_t first, std::uint64_t end, unsigned seconds, Shared& shared) {
  of_process = &shared;
  shared.foreign = false;
  for (std::uint64_t seed = first; seed < end; ++seed) {
    shared.seed = seed;
    limit(seconds);
    Outcome outcome;
    try {
      outcome = kind.run(seed);
    } catch (const std::exception& error) {
      outcome.fault = std::string("an exception: ") + error.what();
    } catch (...) {
      outcome.fault = "an exception";
    }
    limit(0);
    if (outcome.fault.empty()) {
      ++shared.results[static_cast<int>(outcome.result)];
    } else {
      ++shared.faults;
      std::printf("%s, seed %llu: %s\n", kind.name.c_str(), static_cast<unsigned long long>(seed), outcome.fault.c_str());
      std::fflush(stdout);
    }
  }
  std::fflush(stdout);
  _exit(0);
}

class Runner {
 public:
  Runner(const Kind& kind, const Options& options) : kind_(kind), options_(options), next_(options.first) {
    const auto bytes = sizeof(Shared) * static_cast<std::size_t>(options.jobs);
    void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    shared_ = new (memory) Shared[static_cast<std::size_t>(options.jobs)]{};
    jobs_.resize(static_cast<std::size_t>(options.jobs));
  }

  int run() {
    for (std::size_t j = 0; j < jobs_.size(); ++j) start(j);
    for (int status = 0;;) {
      const pid_t ended = wait(&status);
      if (ended < 0 && errno == EINTR) continue;
      if (ended < 0) break;
      for (std::size_t j = 0; j < jobs_.size(); ++j)
        if (jobs_[j].process == ended) finish(j, status);
    }
    return report();
  }

 private:
  struct Job {
    pid_t process = -1;
    std::uint64_t next = 0, end = 0;
  };

  void start(std::size_t j) {
    Job& job = jobs_[j];
    if (job.next >= job.end) {
      const std::uint64_t last = options_.first + options_.count;
      if (listed_ < options_.seeds.size())
        job.next = options_.seeds[listed_++], job.end = job.next + 1;
      else
        job.next = next_, job.end = next_ = std::min(last, next_ + seeds_of_process);
    }
    job.process = -1;
    if (job.next >= job.end) return;
    shared_[j].seed = job.next;
    std::fflush(stdout);
    job.process = fork();
    if (job.process == 0) run_seeds(kind_, job.next, job.end, options_.seconds, shared_[j]);
    if (job.process < 0) std::perror("fork"), std::exit(2);
  }

  // A process that was killed goes on behind the seed that killed it.
  void finish(std::size_t j, int status) {
    const unsigned long long seed = shared_[j].seed;
    Job& job = jobs_[j];
    job.next = job.end;
    if (WIFSIGNALED(status) || WEXITSTATUS(status) != 0) {
      job.next = seed + 1;
      ++(shared_[j].foreign ? shared_[j].results[static_cast<int>(Result::rejected)] : killed_);
      if (shared_[j].foreign)
        std::printf("%s, seed %llu: another library does not return\n", kind_.name.c_str(), seed);
      else if (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF)
        std::printf("%s, seed %llu: takes longer than %u s\n", kind_.name.c_str(), seed, options_.seconds);
      else if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
        std::printf("%s, seed %llu: waits without end\n", kind_.name.c_str(), seed);
      else if (WIFSIGNALED(status))
        std::printf("%s, seed %llu: signal %d (%s)\n", kind_.name.c_str(), seed, WTERMSIG(status), strsignal(WTERMSIG(status)));
      else
        std::printf("%s, seed %llu: the process ends with status %d\n", kind_.name.c_str(), seed, WEXITSTATUS(status));
      std::fflush(stdout);
    }
    start(j);
  }

  int report() const {
    Shared all{};
    for (std::size_t j = 0; j < jobs_.size(); ++j) {
      for (int k = 0; k < 3; ++k) all.results[k] += shared_[j].results[k];
      all.faults += shared_[j].faults;
    }
    const auto faults = static_cast<unsigned long long>(all.faults + killed_);
    const auto of = [&](Result r) { return static_cast<unsigned long long>(all.results[static_cast<int>(r)]); };
    std::printf("%s: %llu runs, %llu whole, %llu partial, %llu rejected, %llu faults\n", kind_.name.c_str(),
                static_cast<unsigned long long>(options_.count + options_.seeds.size()), of(Result::whole), of(Result::partial),
                of(Result::rejected), faults);
    return faults == 0 ? 0 : 1;
  }

  const Kind& kind_;
  const Options& options_;
  std::uint64_t next_, killed_ = 0;
  std::size_t listed_ = 0;  // seeds of the list that have begun
  Shared* shared_;
  std::vector<Job> jobs_;
};

std::vector<std::uint64_t> list_of(const char* text) {
  std::vector<std::uint64_t> list;
  for (char* end = nullptr; *text != '\0'; text = *end == ',' ? end + 1 : end) {
    list.push_back(std::strtoull(text, &end, 10));
    if (end == text) std::fputs("--seeds requires numbers with commas between them\n", stderr), std::exit(2);
  }
  return list;
}

int usage(const std::vector<Kind>& kinds) {
  std::fputs("KIND [--first SEED] [--count N] [--seeds SEED,SEED,...] [--seconds-per-run S] [--jobs N], with a KIND of:", stderr);
  for (const Kind& kind : kinds) std::fprintf(stderr, " %s", kind.name.c_str());
  std::fputs("\n", stderr);
  return 2;
}

}  // namespace

Foreign::Foreign() {
  if (of_process != nullptr) of_process->foreign = true;
}

Foreign::~Foreign() {
  if (of_process != nullptr) of_process->foreign = false;
}

int main_of(const std::vector<Kind>& kinds, int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&]() -> std::uint64_t { return i + 1 < argc ? std::strtoull(argv[++i], nullptr, 10) : 0; };
    if (word == "--first")
      options.first = value();
    else if (word == "--count")
      options.count = value();
    else if (word == "--seeds")
      options.seeds = list_of(i + 1 < argc ? argv[++i] : "");
    else if (word == "--seconds-per-run")
      options.seconds = static_cast<unsigned>(value());
    else if (word == "--jobs")
      options.jobs = static_cast<int>(value());
    else
      options.kind = word;
  }
  for (const Kind& kind : kinds)
    if (kind.name == options.kind && options.jobs > 0) return Runner(kind, options).run();
  return usage(kinds);
}

}  // namespace geometry_fuzz
