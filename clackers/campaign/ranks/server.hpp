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
struct RankResult {
  int rank = 0;
  RunSummary summary;
  std::string failure, code;  ///< a sentence and its code; empty: none
};

/// Answers the other ranks until all are done; returns their results in the order of arrival.
/// `hello` is answered with `campaign`; an empty text means that there is nothing to do. Once
/// `interrupt` is true, no more blocks are given out. `progress` is called after each message and at
/// least every half millisecond.
std::vector<RankResult> serve(Transport& transport, Dispatcher& dispatcher,
                              const std::string& campaign, const std::atomic<bool>& interrupt,
                              const std::function<void()>& progress = {});

/// Answers every rank with `stop`; returns when all ranks are done.
void stop_all_ranks(Transport& transport);

/// Seconds of a steady clock, as Dispatcher::take() needs them.
double steady_seconds();

}  // namespace clackers::campaign
