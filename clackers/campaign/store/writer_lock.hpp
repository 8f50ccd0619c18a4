#pragma once

#include <string>

namespace clackers::campaign {

/// One writer of a database at a time: a lock on the file "PATH.lock", which the system releases when
/// the process ends, however it ends.
class WriterLock {
 public:
  /// Throws InputError (database-busy) while another one holds it, FileError (cannot-write) where the
  /// file cannot be made.
  explicit WriterLock(const std::string& path);
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  std::string file_;
  int descriptor_ = -1;
};

}  // namespace clackers::campaign
