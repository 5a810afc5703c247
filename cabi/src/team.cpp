// SPDX-License-Identifier: BSD-3-Clause
// Processes that make one mesh together: the host's callbacks as the engine's link.
#include "support/ranks/team.h"

#include "arguments.h"
#include "carreau.h"
#include "guard.h"

using namespace carreau::abi;

namespace {

class HostLink final : public carreau::TeamLink {
 public:
  explicit HostLink(const carreau_team& team) : team_(team) {}
  ~HostLink() override {
    if (team_.release != nullptr) team_.release(team_.user);
  }
  HostLink(const HostLink&) = delete;
  HostLink& operator=(const HostLink&) = delete;

  [[nodiscard]] int rank() const noexcept override { return team_.rank; }
  [[nodiscard]] int size() const noexcept override { return team_.size; }
  [[nodiscard]] bool takes_from_any_thread() const noexcept override { return team_.any_thread != 0; }

  std::int64_t take(std::int64_t count) override {
    std::int64_t before = 0;
    check("take", team_.take(count, &before, team_.user));
    return before;
  }

  std::vector<std::string> exchange(std::string_view mine) override {
    std::vector<std::int64_t> sizes(static_cast<std::size_t>(team_.size), 0);
    const void* bytes = nullptr;
    check("exchange", team_.exchange(static_cast<std::int64_t>(mine.size()), mine.data(), sizes.data(), &bytes, team_.user));
    std::vector<std::string> all;
    const char* from = static_cast<const char*>(bytes);
    for (const std::int64_t size : sizes) {
      if (size < 0 || (size > 0 && from == nullptr))
        throw carreau::CallbackError("the callback exchange of the team has given no bytes");
      all.emplace_back(from, static_cast<std::size_t>(size));
      from += size;
    }
    return all;
  }

 private:
  void check(const char* callback, std::int32_t returned) const {
    if (returned == CARREAU_ERR_MEMORY)
      throw carreau::LimitError("a rank has not enough memory for the messages between ranks");
    if (returned != 0)
      throw carreau::CallbackError(std::string("the callback ") + callback + " of the team has returned " +
                                   std::to_string(returned) + " on rank " + std::to_string(team_.rank));
  }

  carreau_team team_;
};

}  // namespace

carreau_status carreau_set_team(carreau_session* session, const carreau_team* team) {
  return guarded(session, [&] {
    if (team == nullptr) return session->session.set_team(nullptr);
    const carreau_team known = read_struct(team, "team");
    if (known.take == nullptr || known.exchange == nullptr)
      throw carreau::InvalidArgument("team->take and team->exchange are needed");
    if (known.size < 1 || known.rank < 0 || known.rank >= known.size)
      throw carreau::InvalidArgument("team->rank is " + std::to_string(known.rank) + " and team->size " +
                                     std::to_string(known.size) + "; ranks are from 0 to size - 1");
    session->session.set_team(std::make_shared<HostLink>(known));
  });
}
