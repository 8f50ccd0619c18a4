#pragma once

#include <array>
#include <optional>
#include <string>

namespace clackers::campaign {

/// What ranks write to each other. All messages go to rank 0 or come from it.
struct Message {
  enum class Kind {
    hello,     ///< to rank 0: a rank has started and asks for the campaign
    request,   ///< to rank 0: a rank has finished its last block and asks for another
    done,      ///< to rank 0: a rank has finished; numbers: tasks, runs, whether interrupted;
               ///< text: a failure and its code, separated by a zero, or nothing
    campaign,  ///< text: what a rank must know to begin
    block,     ///< numbers: first and last of a block of tasks
    stop       ///< no more blocks
  };
  Kind kind = Kind::stop;
  std::array<long long, 3> numbers{};
  std::string text{};
};

/// Messages between ranks. The functions are called by one thread at a time.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  virtual void send(int to, const Message& message) = 0;

  struct Envelope {
    int from = 0;
    Message message;
  };
  /// A message that has arrived; nothing if there is none.
  virtual std::optional<Envelope> poll() = 0;
};

/// Waits between polls: yields at first, then sleeps longer and longer, so that a rank that waits
/// leaves its core to those that compute.
class Pause {
 public:
  void wait();
  void reset() { waits_ = 0; }

 private:
  int waits_ = 0;
};

/// The next message, waited for.
Transport::Envelope receive(Transport& transport);

}  // namespace clackers::campaign
