#include "clackers/base/jobs/removed_on_exit.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace clackers {
namespace {

// A signal handler may neither lock nor allocate, hence plain pointers in a fixed table. A study has
// a folder a thread, and some files.
std::array<std::atomic<const char*>, 2048> paths_to_remove{};
static_assert(std::atomic<const char*>::is_always_lock_free);

std::atomic<bool> is_ending = false;

// Where an entry of a folder has its length and its name, as getdents64 gives it; readdir allocates.
constexpr std::size_t length_offset = 16, name_offset = 19;

void remove_at(int parent, const char* name, int depth) {
  if (::unlinkat(parent, name, 0) == 0 || (errno != EISDIR && errno != EPERM) || depth > 200)
    return;
  constexpr int flags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
  int folder = ::openat(parent, name, flags);
  if (folder < 0) {  // without permission; or a lack of descriptors that has passed
    if (errno == EACCES) ::fchmodat(parent, name, S_IRWXU, 0);
    folder = ::openat(parent, name, flags);
  }
  if (folder < 0) return;
  ::fchmod(folder, S_IRWXU);
  std::array<char, 4096> entries;
  while (true) {
    const long size = ::syscall(SYS_getdents64, folder, entries.data(), entries.size());
    if (size <= 0) break;
    for (const char* at = entries.data(); at < entries.data() + size;) {
      std::uint16_t length = 0;
      std::memcpy(&length, at + length_offset, sizeof length);
      const std::string_view entry = at + name_offset;
      if (entry != "." && entry != "..") remove_at(folder, entry.data(), depth + 1);
      at += length;
    }
  }
  ::close(folder);
  ::unlinkat(parent, name, AT_REMOVEDIR);
}

}  // namespace

RemovedOnExit::RemovedOnExit(std::string path) : path_(std::move(path)) {
  while (is_ending) ::pause();
  for (auto& entry : paths_to_remove) {
    const char* free = nullptr;
    if (entry.compare_exchange_strong(free, path_.c_str())) return;
  }
  throw std::length_error("too many temporary files");
}

RemovedOnExit::~RemovedOnExit() {
  for (auto& entry : paths_to_remove) {
    const char* mine = path_.c_str();
    if (entry.compare_exchange_strong(mine, nullptr)) return;
  }
}

void make_none_on_exit() noexcept { is_ending = true; }

void remove_on_exit() noexcept {
  for (auto& entry : paths_to_remove)
    if (const char* path = entry.exchange(nullptr)) remove_path(path);
}

void remove_path(const char* path) noexcept { remove_at(AT_FDCWD, path, 0); }

}  // namespace clackers
