#include "clackers/campaign/ranks/transport.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

namespace clackers::campaign {
namespace {

constexpr int yields = 50;
constexpr int first_sleep = 20, longest_sleep = 500;  // [us]

}  // namespace

void Pause::wait() {
  ++waits_;
  if (waits_ <= yields) {
    std::this_thread::yield();
    return;
  }
  const auto doublings = std::min(waits_ - yields - 1, 5);
  std::this_thread::sleep_for(
      std::chrono::microseconds(std::min(first_sleep << doublings, longest_sleep)));
}

Transport::Envelope receive(Transport& transport) {
  for (Pause pause;; pause.wait())
    if (auto envelope = transport.poll()) return *envelope;
}

}  // namespace clackers::campaign
