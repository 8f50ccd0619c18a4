#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "clackers/base/jobs/progress.hpp"

namespace clackers::python {

namespace py = pybind11;

/// Runs a study in threads of its own and meanwhile serves them in the thread of the caller, the only
/// one that touches Python: calls of Python, one at a time, progress, Ctrl-C, and the release of
/// objects. The threads of the study never take the GIL.
class CallerThread {
 public:
  using Work = std::function<void(const Progress& progress)>;

  CallerThread();
  ~CallerThread();
  CallerThread(const CallerThread&) = delete;
  CallerThread& operator=(const CallerThread&) = delete;

  /// Becomes true when the study shall stop.
  const std::atomic<bool>* interrupt() const { return &interrupt_; }

  /// With the GIL: starts `work` in a thread, serves it until it ends, and throws what it throws.
  /// `progress` is a callable that gets the share, or None. After an exception of Python (Ctrl-C, or of
  /// a call or of `progress`) `interrupt` is true and no call is made any more; stopped_by() has it.
  void run(const py::object& progress, const Work& work);

  /// The first exception of Python, as an object; None without one.
  py::object stopped_by() const { return stopped_by_; }

  /// From the study, without the GIL: makes `call` in the caller's thread, with the GIL, and waits for
  /// its end. False where the study shall stop: the call was not made, or it threw an exception of
  /// Python. Throws what else the call throws.
  bool call(const std::function<void()>& call);

  /// From any thread: the caller's thread will release a reference.
  void release(PyObject* object);

  /// At the end of the interpreter: stops the studies of all other threads and waits for them, for a
  /// while. These threads do not return to Python.
  static void stop_all();

 private:
  struct Job {
    const std::function<void()>* call;
    bool was_made = false, is_done = false;
    std::exception_ptr thrown{};
  };
  struct Events {
    Job* job = nullptr;
    std::optional<double> share;
    std::vector<PyObject*> released;
    bool has_ended = false;
  };

  Events wait();
  [[noreturn]] void end_without_python(std::unique_lock<std::mutex>& lock);
  void serve(const py::object& progress);
  void make(Job& job);
  void stop(py::error_already_set& error);

  std::atomic<bool> interrupt_{false};
  py::object stopped_by_ = py::none();

  std::mutex guard_;  // of what follows
  std::condition_variable wake_, done_;
  std::deque<Job*> jobs_;
  std::optional<double> share_;
  std::vector<PyObject*> released_;
  std::exception_ptr thrown_;
  bool has_ended_ = false;
};

}  // namespace clackers::python
