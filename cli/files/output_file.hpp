#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "clackers/base/files/files.hpp"
#include "cli/files/output_stream.hpp"
#include "cli/interrupt.hpp"

namespace clackers::cli {

/// A file that appears whole or not at all: what is written goes to a temporary file in the same
/// folder, which replaces `path` in commit(). Without commit() nothing remains, however the process
/// ends: the temporary file has no name. Where the file system knows no such files, it has a random
/// one, which is removed unless the process is killed (SIGKILL).
/// A device or pipe (/dev/full, /dev/stdout, a fifo) is written directly; a link is followed, also
/// one to a file that does not exist yet.
class OutputFile {
 public:
  /// Throws FileError at once when `path` cannot be written, before anything is computed.
  explicit OutputFile(std::string path, OnInterrupt on_interrupt);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ostream& stream() { return *stream_; }
  const std::string& path() const { return path_; }
  /// Puts the file in its place. Throws FileError when the disk did not take all of it.
  void commit();

 private:
  void open_device();
  void open_temporary();
  int open_named();
  void give_name();

  std::string path_;              ///< as given
  std::filesystem::path target_;  ///< with links followed
  bool is_device_ = false;
  std::optional<RemovedOnExit> temporary_;  ///< while the temporary file has a name
  Descriptor descriptor_;
  std::unique_ptr<OutputStream> stream_;
};

}  // namespace clackers::cli
