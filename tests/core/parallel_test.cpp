// Parallel loops visit everything once and hand exceptions on.
#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "core/parallel.h"

TEST_SUITE("unit") {
  TEST_CASE("every index is visited exactly once, whatever the grain and the number of threads") {
    for (const int threads : {1, 2, 4}) {
      const moire::ThreadLimit limit(threads);
      CHECK(moire::thread_count() == threads);
      for (const std::size_t count : {0u, 1u, 7u, 1000u}) {
        for (const std::size_t grain : {1u, 16u}) {
          std::vector<std::atomic<int>> visits(count);
          moire::parallel_for(
              count, [&](std::size_t i) { ++visits[i]; }, grain);
          for (const auto& v : visits) CHECK(v == 1);
        }
      }
    }
  }

  TEST_CASE("an exception in a body reaches the caller") {
    CHECK_THROWS_AS(moire::parallel_for(100,
                                        [](std::size_t i) {
                                          if (i == 37) throw std::runtime_error("x");
                                        }),
                    std::runtime_error);
  }
}
