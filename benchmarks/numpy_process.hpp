#pragma once

#include <cstdio>
#include <string>

namespace clackers::benchmarks {

/// A Python process that times NumPy on Eq. (26) in turns with what is timed here (numpy_pair.py).
class NumpyProcess {
 public:
  /// Runs $CLACKERS_PYTHON, by default Debian's Python, which Debian's NumPy belongs to.
  explicit NumpyProcess(const std::string& script);
  ~NumpyProcess();
  NumpyProcess(const NumpyProcess&) = delete;
  NumpyProcess& operator=(const NumpyProcess&) = delete;

  /// NumPy's version; empty if there is none.
  const std::string& version() const { return version_; }
  /// The answer to one line of the script's language; empty when the process has ended.
  std::string ask(const std::string& line);

 private:
  std::FILE *to_ = nullptr, *from_ = nullptr;
  int process_ = -1;
  std::string version_;
};

}  // namespace clackers::benchmarks
