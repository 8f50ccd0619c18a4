#include "cli/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <utility>

namespace clackers::cli {
namespace {

std::atomic<bool> interrupted{false};
// A signal handler may neither lock nor allocate, hence plain pointers in a fixed table: --out and
// --report are two files.
std::array<std::atomic<const char*>, 4> doomed{};
static_assert(std::atomic<const char*>::is_always_lock_free);

extern "C" void on_signal(int) {
  if (!interrupted.exchange(true)) return;
  for (auto& entry : doomed)
    if (const char* path = entry.load()) ::unlink(path);
  ::_exit(130);
}

}  // namespace

void catch_signals() {
  struct sigaction ours {};
  ours.sa_handler = on_signal;
  ::sigemptyset(&ours.sa_mask);
  // No SA_RESTART: a read that waits for a person must wake up.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction inherited {};
    ::sigaction(signal, nullptr, &inherited);
    if (inherited.sa_handler != SIG_IGN) ::sigaction(signal, &ours, nullptr);
  }
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
}

const std::atomic<bool>& interrupt_flag() { return interrupted; }

RemovedOnExit::RemovedOnExit(std::string path) : path_(std::move(path)) {
  for (auto& entry : doomed) {
    const char* free = nullptr;
    if (entry.compare_exchange_strong(free, path_.c_str())) return;
  }
}

RemovedOnExit::~RemovedOnExit() {
  for (auto& entry : doomed) {
    const char* mine = path_.c_str();
    entry.compare_exchange_strong(mine, nullptr);
  }
}

}  // namespace clackers::cli
