// Parallel loops by oneTBB; the only file that knows it.
#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <typeinfo>
#include <vector>

#include "core/error.h"

namespace moire {
namespace {

#if defined(__SANITIZE_THREAD__)
// ThreadSanitizer does not see into oneTBB, which is not instrumented, and takes its tasks for races. Under it plain
// threads take the loop over, so that what it reports is about the bodies, and nothing needs to be suppressed.
void run_loop(std::size_t count, const std::function<void(std::size_t)>& body, std::size_t grain) {
  std::atomic<std::size_t> next = 0;
  std::mutex failing;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t begin; (begin = next.fetch_add(grain)) < count;) {
      try {
        for (std::size_t i = begin; i < std::min(count, begin + grain); ++i) body(i);
      } catch (...) {
        const std::lock_guard lock(failing);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> others;  // joined at the end
    for (int i = 1; i < thread_count(); ++i) others.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}
#else
void run_loop(std::size_t count, const std::function<void(std::size_t)>& body, std::size_t grain) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const tbb::blocked_range<std::size_t>& r) {
    for (std::size_t i = r.begin(); i != r.end(); ++i) body(i);
  });
}
#endif

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body, std::size_t grain) {
  const std::size_t g = std::max<std::size_t>(grain, 1);
  if (count <= g) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  try {
    run_loop(count, body, g);
  } catch (const std::runtime_error& e) {
    // What oneTBB throws where the system allows no more threads: "pthread_create has failed: ...".
    if (typeid(e) != typeid(std::runtime_error) || !std::string_view(e.what()).starts_with("pthread_")) throw;
    throw Error("threads", std::string(e.what()) + "; allow more threads or memory, or give fewer --threads", Exit::io);
  }
}

struct ThreadLimit::Impl {
  explicit Impl(std::size_t n) : control(tbb::global_control::max_allowed_parallelism, n) {}
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : impl_(std::make_unique<Impl>(
          static_cast<std::size_t>(threads > 0 ? threads : std::max(1, tbb::info::default_concurrency())))) {}

ThreadLimit::~ThreadLimit() = default;

int thread_count() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace moire
