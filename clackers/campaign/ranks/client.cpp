#include "clackers/campaign/ranks/client.hpp"

namespace clackers::campaign {

using Kind = Message::Kind;

Message Client::ask(Kind kind) {
  transport_.send(0, {kind, {}, {}});
  return receive(transport_).message;
}

std::optional<std::string> Client::greet() {
  const std::lock_guard lock(mutex_);
  const auto answer = ask(Kind::hello);
  if (answer.kind == Kind::campaign) return answer.text;
  stopped_ = true;
  return std::nullopt;
}

std::optional<TaskBlock> Client::next() {
  const std::lock_guard lock(mutex_);
  if (stopped_) return std::nullopt;
  const auto answer = ask(Kind::request);
  if (answer.kind == Kind::block) return TaskBlock{answer.numbers[0], answer.numbers[1]};
  stopped_ = true;
  return std::nullopt;
}

void Client::leave(const RunSummary& summary, const std::string& failure, const std::string& code) {
  const std::lock_guard lock(mutex_);
  const auto text = failure.empty() ? failure : failure + '\0' + code;
  transport_.send(0, {Kind::done, {summary.tasks, summary.runs, summary.interrupted}, text});
}

}  // namespace clackers::campaign
