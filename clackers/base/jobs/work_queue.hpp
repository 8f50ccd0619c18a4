#pragma once

#include <cstddef>
#include <functional>

namespace clackers {

/// Number of threads meant by `jobs`: itself, or one per processor for 0. Throws InputError for a
/// negative number or one beyond 1024.
int thread_count(int jobs);

/// Calls work(0) ... work(count - 1) on `threads` threads, or on as many as the system allows, each
/// index once, started in order. After an exception nothing more is started; the first one is thrown here when all threads have ended.
void run_all(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

}  // namespace clackers
