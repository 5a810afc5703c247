// SPDX-License-Identifier: BSD-3-Clause
// A value for each thread, of an object.
#pragma once

#ifdef CARREAU_WITH_TBB
#include <tbb/enumerable_thread_specific.h>
#else
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <thread>
#include <unordered_map>
#endif

namespace carreau_occ {

#ifdef CARREAU_WITH_TBB
template <typename T>
using ThreadValues = tbb::enumerable_thread_specific<T>;
#else
template <typename T>
class ThreadValues {
 public:
  /// The value of the calling thread; made by T() at the first call. A thread may find the value of one that has ended.
  T& local() {
    const std::thread::id me = std::this_thread::get_id();
    {
      const std::shared_lock lock(mutex_);
      if (const auto found = values_.find(me); found != values_.end()) return *found->second;
    }
    const std::unique_lock lock(mutex_);
    std::unique_ptr<T>& value = values_[me];
    if (!value) value = std::make_unique<T>();
    return *value;
  }

 private:
  std::shared_mutex mutex_;
  std::unordered_map<std::thread::id, std::unique_ptr<T> > values_;
};
#endif

}  // namespace carreau_occ
