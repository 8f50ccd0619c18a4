#include "clackers/paper/process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "clackers/base/error.hpp"

namespace clackers::paper {
namespace {

// Where the three standard streams of the program go.
class Streams {
 public:
  explicit Streams(const std::string& messages) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions_, 1, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions_, 2, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                       0600);
  }
  ~Streams() { ::posix_spawn_file_actions_destroy(&actions_); }
  Streams(const Streams&) = delete;
  Streams& operator=(const Streams&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

}  // namespace

Ended run_program(const std::vector<std::string>& arguments, const std::string& messages) {
  std::vector<char*> argv;
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const Streams streams(messages);
  pid_t child = 0;
  const int error =
      ::posix_spawnp(&child, argv.front(), streams.get(), nullptr, argv.data(), environ);
  if (error == ENOENT || error == EACCES) return {.found = false, .code = 0, .messages = {}};
  if (error != 0)
    throw FileError("paper: cannot start " + arguments.front() + ": " + std::strerror(error) + ".",
                    "render-failed");
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR)
      throw FileError(
          "paper: cannot wait for " + arguments.front() + ": " + std::strerror(errno) + ".",
          "render-failed");
  Ended out{.found = true,
            .code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            .messages = {}};
  std::ifstream text(messages);
  out.messages.assign(std::istreambuf_iterator<char>(text), {});
  return out;
}

}  // namespace clackers::paper
