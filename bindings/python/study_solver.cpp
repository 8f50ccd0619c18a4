#include "bindings/python/study_solver.hpp"

#include "bindings/python/bind.hpp"
#include "bindings/python/problem.hpp"
#include "clackers/base/codes.hpp"
#include "clackers/cases/case.hpp"

namespace clackers::python {
namespace {

// Of a failed run: whether the callable returned, the sentence, the end of the traceback, and whether
// smaller steps fail likewise.
using Failure = std::tuple<bool, std::string, std::string, bool>;

class CallableSolver : public solvers::Solver {
 public:
  CallableSolver(const CallableSubject& callable, cases::Case problem, CallerThread& caller)
      : callable_(callable),
        case_(std::make_shared<const cases::Case>(std::move(problem))),
        caller_(caller) {}
  ~CallableSolver() override {
    if (problem_) caller_.release(problem_.release().ptr());
  }
  CallableSolver(const CallableSolver&) = delete;
  CallableSolver& operator=(const CallableSolver&) = delete;

  solvers::SolverOutput run(const solvers::SolverRun& run, const std::atomic<bool>*) override {
    solvers::SolverOutput output;
    const double resolution = run.tolerance > 0.0 ? run.tolerance : run.step;
    output.interrupted = !caller_.call([&] { take(result_of(resolution), output); });
    return output;
  }

 private:
  py::tuple result_of(double resolution) {
    if (!problem_) problem_ = py::cast(Problem({case_, &case_->problem}));
    return callable_.run(problem_, resolution);
  }

  void take(py::tuple result, solvers::SolverOutput& output) {
    if (py::len(result) == 4) {
      const auto [has_returned, sentence, printed, would_repeat] = result.cast<Failure>();
      output.failure_code =
          (has_returned ? Code("callable-output") : Code("callable-failed")).name();
      output.failure = sentence;
      output.printed = printed;
      output.would_repeat = would_repeat;
      return;
    }
    output.history = columns_of(callable_.name, result[0]);
    if (!result[1].is_none()) output.events = columns_of("impacts of " + callable_.name, result[1]);
    auto* const caller = &caller_;
    output.memory = {result.release().ptr(),
                     [caller](PyObject* arrays) { caller->release(arrays); }};
  }

  const CallableSubject& callable_;
  std::shared_ptr<const cases::Case> case_;
  CallerThread& caller_;
  py::object problem_;  // for the callable; made and released in the caller's thread
};

}  // namespace

solvers::SolverSubject solver_subject(const CallableSubject& callable, CallerThread& caller) {
  solvers::SolverSubject subject;
  subject.kind = record::SubjectKind::callable;
  subject.name = callable.name;
  subject.claim = callable.expect.value_or(Claim{});
  subject.steps = callable.steps;
  subject.tolerances = callable.tolerances;
  subject.prepare = [&callable, &caller](const cases::Case& problem) {
    return std::make_unique<CallableSolver>(callable, problem, caller);
  };
  return subject;
}

}  // namespace clackers::python
