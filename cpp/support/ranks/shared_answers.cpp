// SPDX-License-Identifier: BSD-3-Clause
#include "support/ranks/shared_answers.h"

#include <algorithm>
#include <exception>
#include <string>

#include "support/error.h"
#include "support/ranks/packet.h"
#include "support/work_sizes.h"

namespace carreau {

namespace {

/// The answers of this process's host at some places, or its error.
struct OwnAnswers {
  LongChecksum sum;
  SharedError error;
};

OwnAnswers own_answers(const HostQuestion& question, std::span<const Vec2> uv, Monitor& monitor) {
  std::vector<Vec2> some;
  for (std::size_t k = 0; k < uv.size(); k += work_sizes::places_of_one_compared) some.push_back(uv[k]);
  OwnAnswers own;
  std::vector<double> answers(question.width * some.size());
  try {
    question.ask(some, answers.data(), monitor);
    own.sum.add(some), own.sum.add(answers);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {
    own.error = SharedError::of(std::current_exception());
  }
  return own;
}

void require_same_answers(Team& team, int ref, const HostQuestion& question, std::span<const Vec2> uv, Monitor& monitor) {
  const OwnAnswers own = own_answers(question, uv, monitor);
  PacketWriter packet;
  packet.put(std::string_view(own.error.bytes));
  packet.put(std::string_view(own.sum.text()));
  const std::vector<std::string> all = team.exchange(question.step, packet.bytes());
  std::vector<SharedError> errors;
  for (const std::string& of_rank : all) errors.push_back({PacketReader(of_rank).text()});
  if (std::all_of(errors.begin(), errors.end(), [](const SharedError& e) { return e.any(); })) return;
  for (std::size_t r = 0; r < errors.size(); ++r)
    if (errors[r].any()) errors[r].raise("rank " + std::to_string(r) + ": ");
  for (std::size_t r = 1; r < all.size(); ++r)
    if (all[r] != all[0]) refuse_other_face(ref, r);
}

}  // namespace

void refuse_other_face(int ref, std::size_t rank) {
  throw InvalidModel("face " + std::to_string(ref) + " differs on rank " + std::to_string(rank) +
                     " from rank 0: its callbacks or prescribed sizes differ; all ranks must mesh the same model");
}

bool is_shared(const Executor& executor, std::size_t n) noexcept { return !executor.is_alone() && n >= work_sizes::fewest_shared_places; }

std::vector<double> shared_answers(const Executor& executor, int ref, const HostQuestion& question, std::span<const Vec2> uv,
                                   Monitor& monitor) {
  if (!is_shared(executor, uv.size())) {
    std::vector<double> answers(question.width * uv.size());
    question.ask(uv, answers.data(), monitor);
    return answers;
  }
  require_same_answers(*executor.team, ref, question, uv, monitor);
  const auto ask = [&](std::size_t first, std::size_t last, double* out, Monitor& of_piece) {
    question.ask(uv.subspan(first, last - first), out, of_piece);
  };
  return shared_rows(executor.with(question.threads), question.step,
                     {.count = uv.size(),
                      .width = question.width,
                      .at_once = work_sizes::piece_of(uv.size()),
                      .bound = question.threads == 1},
                     ask, monitor);
}

}  // namespace carreau
