#include "clackers/base/jobs/work_queue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "clackers/base/error.hpp"

namespace clackers {

int thread_count(int jobs) {
  constexpr int most = 1024;
  if (jobs < 0 || jobs > most)
    refuse("verify", "jobs", fmt::format("{}", jobs), fmt::format("0 <= jobs <= {}", most),
           "0 takes one thread per processor.");
  if (jobs > 0) return jobs;
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, most);
}

void run_all(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> failed = false;
  std::exception_ptr first;
  std::mutex first_guard;
  const auto serve = [&] {
    for (auto i = next++; i < count && !failed; i = next++) try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(first_guard);
        if (!first) first = std::current_exception();
        failed = true;
      }
  };
  {
    // This thread serves as well: one thread needs no other.
    std::vector<std::jthread> others;
    const auto wanted = std::min(count, static_cast<std::size_t>(threads));
    try {
      others.reserve(wanted);
      for (std::size_t i = 1; i < wanted; ++i) others.emplace_back(serve);
    } catch (const std::system_error&) {
      // A limit on threads, as in containers: the work goes on with those that there are.
    }
    serve();
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace clackers
