#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "clackers/campaign/ranks/transport.hpp"
#include "clackers/campaign/run.hpp"
#include "clackers/campaign/task_source.hpp"

namespace clackers::campaign {

/// The side of a rank other than 0: blocks of tasks that rank 0 gives out.
class Client : public TaskSource {
 public:
  explicit Client(Transport& transport) : transport_(transport) {}

  /// What rank 0 says about the campaign; nothing if there is none to compute.
  std::optional<std::string> greet();
  std::optional<TaskBlock> next() override;
  /// Zero: rank 0 alone knows.
  long long remaining() const override { return 0; }
  /// The last message of a rank: what it did, and its failure with its code, if there was one.
  void leave(const RunSummary& summary, const std::string& failure = {},
             const std::string& code = {});

 private:
  Message ask(Message::Kind kind);

  Transport& transport_;
  std::mutex mutex_;
  bool stopped_ = false;
};

}  // namespace clackers::campaign
