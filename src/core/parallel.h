// Parallel loops. Results never depend on the number of threads: work items write to their own slots.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace moire {

// Calls body(i) for i = 0..count-1, in any order and from several threads at once. `grain` items go together.
// An exception from a body is rethrown in the caller after the running items have ended.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body, std::size_t grain = 1);

// Limits the threads of all parallel loops while it lives; 0 = as many as the machine has cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Threads that parallel loops use now.
int thread_count();

}  // namespace moire
