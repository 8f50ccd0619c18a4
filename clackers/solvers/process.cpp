#include "clackers/solvers/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/base/files/files.hpp"
#include "clackers/solvers/process_tree.hpp"

namespace clackers::solvers {
namespace {

using Clock = std::chrono::steady_clock;
using End = ProcessResult::End;

// Takes what a process writes until it ends.
class Reader {
 public:
  Reader(const ProcessTask& task, const std::atomic<bool>* interrupt)
      : task_(task), interrupt_(interrupt) {}

  ProcessResult run() {
    if (!task_.output.empty()) {
      file_ =
          Descriptor(::open(task_.output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
      if (!file_.is_open()) fail_to_write();
    }
    Pipe output, error;
    if (!output.make() || !error.make()) return not_started(errno);
    ProcessTree tree;
    if (const int problem = tree.start(task_, output.write.number(), error.write.number()))
      return not_started(problem);
    output.write.close();
    error.write.close();
    output_ = std::move(output.read);
    error_ = std::move(error.read);
    const auto limit = Clock::now() + std::chrono::duration<double>(task_.timeout);
    while (result_.end == End::exited) {
      const bool ended = tree.has_ended();
      wait(ended ? 0 : pause_);
      const bool heard = take(output_, true) + take(error_, false) > 0;
      const bool late = Clock::now() >= limit;
      if (ended && (!heard || late)) break;
      if (interrupt_ != nullptr && *interrupt_) result_.end = End::interrupted;
      if (late) result_.end = End::timed_out;
    }
    tree.end(result_);
    return std::move(result_);
  }

 private:
  ProcessResult not_started(int problem) {
    result_.end = End::not_started;
    result_.status = problem;
    return std::move(result_);
  }

  // Until something was written, closed, or the time has passed [ms].
  void wait(int time) {
    std::array<pollfd, 2> watched{pollfd{output_.number(), POLLIN, 0},
                                  pollfd{error_.number(), POLLIN, 0}};
    ::poll(watched.data(), watched.size(), time);
    // A process that closed both and goes on is looked at less and less often.
    const bool closed = !output_.is_open() && !error_.is_open();
    pause_ = closed ? std::min(2 * pause_, longest_pause) : longest_pause;
  }

  // Reads once; returns the number of bytes.
  std::size_t take(Descriptor& from, bool is_output) {
    if (!from.is_open()) return 0;
    const auto count = ::read(from.number(), buffer_.data(), buffer_.size());
    if (count == 0) {
      from.close();
      pause_ = 1;
    }
    if (count <= 0) return 0;
    const auto size = static_cast<std::size_t>(count);
    if (is_output && file_.is_open() && (taken_ += size) > task_.most_output)
      result_.end = End::flooded;
    if (is_output && file_.is_open())
      write(size);
    else
      keep({buffer_.data(), size});
    return size;
  }

  void write(std::size_t size) {
    for (std::size_t done = 0; done < size;) {
      const auto count = ::write(file_.number(), buffer_.data() + done, size - done);
      if (count < 0 && errno != EINTR) fail_to_write();
      if (count > 0) done += static_cast<std::size_t>(count);
    }
  }

  void keep(std::string_view text) {
    result_.printed += text;
    if (result_.printed.size() > most_printed)
      result_.printed.erase(0, result_.printed.size() - most_printed);
  }

  [[noreturn]] void fail_to_write() const {
    throw FileError(task_.output + ": " + std::generic_category().message(errno) + '.',
                    "cannot-write");
  }

  static constexpr int longest_pause = 20;  // [ms]

  const ProcessTask& task_;
  const std::atomic<bool>* interrupt_;
  Descriptor file_, output_, error_;
  std::array<char, 65536> buffer_{};
  std::size_t taken_ = 0;
  int pause_ = longest_pause;
  ProcessResult result_;
};

}  // namespace

ProcessResult run_process(const ProcessTask& task, const std::atomic<bool>* interrupt) {
  return Reader(task, interrupt).run();
}

}  // namespace clackers::solvers
