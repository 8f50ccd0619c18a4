#include "bindings/python/caller_thread.hpp"

#include <chrono>
#include <map>
#include <thread>
#include <utility>

namespace clackers::python {
namespace {

using namespace std::chrono_literals;

// Time between two looks at Ctrl-C.
constexpr auto longest_wait = 50ms;

// How long the end of the interpreter waits for studies in other threads.
constexpr auto shutdown_timeout = 5s;

// The studies that run, with their callers' threads, and the thread that ends the interpreter.
struct Running {
  std::mutex guard;
  std::condition_variable changed;
  std::map<const CallerThread*, unsigned long> all;
  std::optional<unsigned long> ended_by;
};

// Never destroyed: threads may outlive the objects of the process.
Running& running() {
  static auto* const studies = new Running;
  return *studies;
}

// Whether the interpreter is ended by another thread: Python is not to be touched from here any more.
bool has_python_ended() {
  const std::lock_guard lock(running().guard);
  return running().ended_by && *running().ended_by != PyThread_get_thread_ident();
}

// Sleeps until the process ends. A thread that returned to an interpreter that ends could print its
// exception meanwhile, and the interpreter aborts where a thread holds its standard error.
[[noreturn]] void park() {
  {
    const std::lock_guard lock(running().guard);
    const auto self = PyThread_get_thread_ident();
    std::erase_if(running().all, [&](const auto& study) { return study.second == self; });
    running().changed.notify_all();
  }
  for (;;) std::this_thread::sleep_for(1h);
}

}  // namespace

CallerThread::CallerThread() {
  const std::lock_guard lock(running().guard);
  running().all.emplace(this, PyThread_get_thread_ident());
}

CallerThread::~CallerThread() {
  for (auto* object : released_) Py_DECREF(object);
  const std::lock_guard lock(running().guard);
  running().all.erase(this);
  running().changed.notify_all();
}

void CallerThread::stop_all() {
  {
    const std::lock_guard lock(running().guard);
    running().ended_by = PyThread_get_thread_ident();
    // A callable ends at its next instruction.
    for (const auto& [study, thread] : running().all)
      PyThreadState_SetAsyncExc(thread, PyExc_SystemExit);
  }
  const py::gil_scoped_release without_gil;
  std::unique_lock lock(running().guard);
  running().changed.wait_for(lock, shutdown_timeout, [] { return running().all.empty(); });
}

void CallerThread::run(const py::object& progress, const Work& work) {
  std::thread study([&] {
    try {
      work([&](double share) {
        const std::lock_guard lock(guard_);
        share_ = share;
      });
    } catch (...) {
      thrown_ = std::current_exception();
    }
    const std::lock_guard lock(guard_);
    has_ended_ = true;
    wake_.notify_one();
  });
  serve(progress);
  study.join();
  if (thrown_) std::rethrow_exception(thrown_);
}

bool CallerThread::call(const std::function<void()>& call) {
  Job job{&call};
  std::unique_lock lock(guard_);
  if (interrupt_) return false;
  jobs_.push_back(&job);
  wake_.notify_one();
  done_.wait(lock, [&] { return job.is_done; });
  if (job.thrown) std::rethrow_exception(job.thrown);
  return job.was_made;
}

void CallerThread::release(PyObject* object) {
  const std::lock_guard lock(guard_);
  released_.push_back(object);
}

CallerThread::Events CallerThread::wait() {
  const py::gil_scoped_release without_gil;
  std::unique_lock lock(guard_);
  wake_.wait_for(lock, longest_wait, [&] { return !jobs_.empty() || has_ended_; });
  if (has_python_ended()) end_without_python(lock);
  Events events;
  events.has_ended = has_ended_;
  events.share = std::exchange(share_, {});
  events.released = std::exchange(released_, {});
  if (!jobs_.empty()) {
    events.job = jobs_.front();
    jobs_.pop_front();
  }
  return events;
}

void CallerThread::end_without_python(std::unique_lock<std::mutex>& lock) {
  interrupt_ = true;
  while (!has_ended_) {
    for (auto* job : std::exchange(jobs_, {})) job->is_done = true;
    done_.notify_all();
    wake_.wait(lock, [&] { return !jobs_.empty() || has_ended_; });
  }
  park();
}

void CallerThread::serve(const py::object& progress) {
  for (bool has_ended = false; !has_ended;) {
    const auto events = wait();
    has_ended = events.has_ended;
    for (auto* object : events.released) Py_DECREF(object);
    if (events.job != nullptr) make(*events.job);
    try {
      if (events.share && !progress.is_none() && !interrupt_) progress(*events.share);
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    } catch (py::error_already_set& error) {
      stop(error);
    }
  }
}

void CallerThread::stop(py::error_already_set& error) {
  interrupt_ = true;
  if (!stopped_by_.is_none()) return;
  stopped_by_ = error.value();
  if (error.trace()) PyException_SetTraceback(stopped_by_.ptr(), error.trace().ptr());
}

void CallerThread::make(Job& job) {
  if (!interrupt_) try {
      (*job.call)();
      job.was_made = true;
    } catch (py::error_already_set& error) {
      stop(error);
    } catch (...) {
      job.thrown = std::current_exception();
    }
  const std::lock_guard lock(guard_);
  job.is_done = true;
  done_.notify_all();
}

}  // namespace clackers::python
