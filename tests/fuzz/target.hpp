#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace clackers::fuzz {

/// Code that takes any bytes. It throws std::logic_error where the code under test breaks a promise.
struct Target {
  std::string_view name;
  void (*run)(std::string_view bytes);
  /// Changes text in place, at most `room` bytes long, and returns its new length; nullptr: libFuzzer's
  /// own mutations.
  std::size_t (*mutate)(char* text, std::size_t size, std::size_t room, unsigned seed);
};

std::span<const Target> targets();
/// The target of a name; ends the program with exit code 2 and the list of names for any other.
const Target& target(std::string_view name);

/// Runs one input: refusals (Error) are fine, anything else ends the program. False for a refusal.
bool run_input(const Target& target, std::string_view bytes);

/// Whether an input goes through every output, as in a replay. Else its length chooses one of them: all
/// take most of the time of an input.
inline bool every_output = true;

/// Throws std::logic_error unless `kept`.
void require(bool kept, const char* promise);

/// A file in memory, with a path, for code that reads files.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  int descriptor_;
  std::string path_;
};

void read_history(std::string_view bytes);
void read_npy(std::string_view bytes);
void read_events(std::string_view bytes);
void read_specification(std::string_view bytes);
void read_settings(std::string_view bytes);
void read_times(std::string_view bytes);
void read_command(std::string_view bytes);
void read_record(std::string_view bytes);
void check_and_report(std::string_view bytes);
void read_problem(std::string_view bytes);
void read_campaign(std::string_view bytes);
void show_results(std::string_view bytes);
void query_database(std::string_view bytes);

/// Puts an extreme number in the place of one in the text, or repeats or drops a line.
std::size_t mutate_numbers(char* text, std::size_t size, std::size_t room, unsigned seed);

}  // namespace clackers::fuzz
