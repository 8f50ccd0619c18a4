#include "clackers/campaign/ranks/server.hpp"

#include <chrono>

namespace clackers::campaign {
namespace {

using Kind = Message::Kind;

Message answer(const Transport::Envelope& envelope, Dispatcher& dispatcher,
               const std::string& campaign) {
  if (envelope.message.kind == Kind::hello)
    return {campaign.empty() ? Kind::stop : Kind::campaign, {}, campaign};
  const auto block = dispatcher.take(envelope.from, steady_seconds());
  if (!block) return {Kind::stop, {}, {}};
  return {Kind::block, {block->first, block->last}, {}};
}

RankResult result_of(const Transport::Envelope& envelope) {
  const auto& numbers = envelope.message.numbers;
  const auto& text = envelope.message.text;
  const auto end = text.find('\0');
  return {envelope.from,
          {numbers[0], numbers[1], numbers[2] != 0},
          text.substr(0, end),
          end == std::string::npos ? "" : text.substr(end + 1)};
}

}  // namespace

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<RankResult> serve(Transport& transport, Dispatcher& dispatcher,
                              const std::string& campaign, const std::atomic<bool>& interrupt,
                              const std::function<void()>& progress) {
  std::vector<RankResult> results;
  Pause pause;
  while (static_cast<int>(results.size()) < transport.size() - 1) {
    if (interrupt) dispatcher.stop();
    if (progress) progress();
    const auto envelope = transport.poll();
    if (!envelope) {
      pause.wait();
      continue;
    }
    pause.reset();
    const auto& message = envelope->message;
    if (message.kind == Kind::done)
      results.push_back(result_of(*envelope));
    else
      transport.send(envelope->from, answer(*envelope, dispatcher, campaign));
  }
  return results;
}

void stop_all_ranks(Transport& transport) {
  Dispatcher none({}, {.ranks = transport.size()});
  serve(transport, none, {}, false);
}

}  // namespace clackers::campaign
