#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "clackers/campaign/ranks/dispatcher.hpp"
#include "clackers/campaign/ranks/transport.hpp"
#include "clackers/campaign/run.hpp"

namespace clackers::campaign {

/// How a rank other than 0 ended.
struct Departure {
  int rank = 0;
  RunSummary summary;
  std::string failure, code;  ///< a sentence and its code; empty: none
};

/// Answers of rank 0 until all other ranks have left, which it returns in their order of leaving.
/// Greetings are answered with `campaign`; an empty one means that there is nothing to do. Once
/// `interrupt` is true, no more blocks are given out. `progress` is called after each message and at
/// least every half millisecond.
std::vector<Departure> serve(Transport& transport, Dispatcher& dispatcher,
                             const std::string& campaign, const std::atomic<bool>& interrupt,
                             const std::function<void()>& progress = {});

/// serve() where there is nothing to give out: every rank is told to stop.
void dismiss(Transport& transport);

/// Seconds of a steady clock, as Dispatcher::take() needs them.
double steady_seconds();

}  // namespace clackers::campaign
