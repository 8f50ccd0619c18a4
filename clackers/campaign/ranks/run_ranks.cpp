#include "clackers/campaign/ranks/run_ranks.hpp"

#include <exception>
#include <filesystem>
#include <system_error>
#include <thread>

#include "clackers/base/error.hpp"
#include "clackers/campaign/ranks/client.hpp"

namespace clackers::campaign {
namespace {

// The tasks that rank 0 computes itself.
class OwnTasks : public TaskSource {
 public:
  explicit OwnTasks(Dispatcher& dispatcher) : dispatcher_(dispatcher) {}
  std::optional<TaskBlock> next() override { return dispatcher_.take(0, steady_seconds()); }
  long long remaining() const override { return dispatcher_.left(); }

 private:
  Dispatcher& dispatcher_;
};

// What ranks must know: the path of the database, then the specification; they read no file.
std::string announcement(const Specification& specification, const Store& store) {
  return std::filesystem::absolute(store.path()).string() + '\0' + specification.text();
}

struct Announced {
  std::string database;
  Specification specification;
};

Announced announced(const std::string& text) {
  const auto end = text.find('\0');
  return {text.substr(0, end), Specification::from_toml(text.substr(end + 1), "specification")};
}

RunSummary compute(Client& client, const std::string& text, int rank, const RunOptions& options,
                   const std::atomic<bool>& interrupt) {
  const auto campaign = announced(text);
  auto shard = Store::create_or_open(rank_path(campaign.database, rank), campaign.specification);
  return run_campaign(campaign.specification, shard, client, options, &interrupt);
}

std::string code_of(const std::exception& error) {
  const auto* ours = dynamic_cast<const Error*>(&error);
  if (ours != nullptr) return std::string(ours->code().name());
  return dynamic_cast<const std::system_error*>(&error) ? "system-failed" : "internal-error";
}

// Rank 0's own share, on a thread beside the one that answers. Where there is no thread, the other ranks
// are answered, and the failure is thrown in the end.
class OwnRun {
 public:
  template <class Work>
  explicit OwnRun(Work work) {
    const auto keep_failure = [this](const auto& call) {
      try {
        call();
      } catch (...) {
        failure_ = std::current_exception();
      }
    };
    keep_failure(
        [&] { thread_ = std::thread([=, this] { keep_failure([&] { summary_ = work(); }); }); });
  }
  ~OwnRun() {
    if (thread_.joinable()) thread_.join();
  }
  OwnRun(const OwnRun&) = delete;
  OwnRun& operator=(const OwnRun&) = delete;

  RunSummary result() {
    if (thread_.joinable()) thread_.join();
    if (failure_) std::rethrow_exception(failure_);
    return summary_;
  }

 private:
  RunSummary summary_;
  std::exception_ptr failure_;
  std::thread thread_;  // last: uses the others
};

void add(RanksSummary& sum, const RunSummary& part) {
  sum.tasks += part.tasks;
  sum.runs += part.runs;
  sum.interrupted = sum.interrupted || part.interrupted;
}

}  // namespace

RanksSummary run_first_rank(Transport& transport, const Specification& specification, Store& store,
                            const RunOptions& options, const std::atomic<bool>& interrupt,
                            const RanksProgress& progress) {
  Dispatcher dispatcher(unfinished_tasks(store.finished(), specification.tasks()),
                        {.ranks = transport.size(),
                         .grain = static_cast<long long>(specification.methods().size()),
                         .block_seconds = block_seconds(transport.size())});
  const auto all = dispatcher.left();
  OwnTasks tasks(dispatcher);
  OwnRun own([&] { return run_campaign(specification, store, tasks, options, &interrupt); });
  const auto results =
      serve(transport, dispatcher, announcement(specification, store), interrupt, [&] {
        if (progress) progress(dispatcher.finished(), all);
      });
  RanksSummary sum;
  add(sum, own.result());
  for (const auto& result : results) {
    add(sum, result.summary);
    if (!result.failure.empty()) sum.failures.push_back(result);
  }
  adopt_ranks(store);
  return sum;
}

void run_other_rank(Transport& transport, const RunOptions& options,
                    const std::atomic<bool>& interrupt) {
  Client client(transport);
  const auto text = client.greet();
  RunSummary summary;
  std::string failure, code;
  try {
    if (text) summary = compute(client, *text, transport.rank(), options, interrupt);
  } catch (const std::exception& error) {
    failure = error.what();
    code = code_of(error);
  }
  client.leave(summary, failure, code);
}

}  // namespace clackers::campaign
