#pragma once

#include <string>

namespace clackers {

/// While it lives, the file or folder is removed when a signal ends the process.
class RemovedOnExit {
 public:
  explicit RemovedOnExit(std::string path);
  ~RemovedOnExit();
  RemovedOnExit(const RemovedOnExit&) = delete;
  RemovedOnExit& operator=(const RemovedOnExit&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// For a signal handler that ends the program: from here on other threads wait for that before they
/// make anything that would have to be removed.
void make_none_on_exit() noexcept;
/// For the same: removes what RemovedOnExit holds.
void remove_on_exit() noexcept;

/// Removes a file, or a folder with all that it holds, without following links. It calls nothing
/// that a signal handler may not call.
void remove_path(const char* path) noexcept;

}  // namespace clackers
