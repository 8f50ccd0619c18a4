#include "clackers/study/driver.hpp"

#include <algorithm>
#include <chrono>

#include "clackers/base/jobs/work_queue.hpp"

namespace clackers::study {
namespace {

struct Task {
  SubjectStudy* study;
  RunTask run;
};

// What a ladder lacks.
struct Round {
  SubjectStudy* study;
  record::RefinementPlan steps;
  std::vector<RunTask> missing;
  double seconds = 0.0;  // expected
};

class Driver {
 public:
  Driver(std::vector<CaseStudy>& cases, int threads, const Progress& progress,
         const std::atomic<bool>* interrupt)
      : threads_(threads), progress_(progress), interrupt_(interrupt) {
    for (auto& problem : cases)
      for (auto& study : problem.subjects) studies_.push_back(study.get());
  }

  bool run(double budget) {
    std::vector<Round> rounds;
    for (auto* study : studies_)
      rounds.push_back({study, study->plan(), study->missing(study->plan())});
    run_rounds(rounds);
    for (const auto& round : rounds) round.study->assess(round.steps);
    if (budget > 0.0 && !is_interrupted() && !refine(budget)) return false;
    if (!is_interrupted()) explain();
    return true;
  }

 private:
  bool is_interrupted() const { return interrupt_ != nullptr && *interrupt_; }

  // In their order, but those of serial candidates one after another, by the first thread.
  void run_tasks(const std::vector<Task>& tasks) const {
    double cost = 0.0;
    std::vector<std::vector<const Task*>> queue;
    std::vector<const Task*> serial;
    for (const auto& task : tasks) {
      cost += task.study->cost(task.run);
      if (task.study->is_serial())
        serial.push_back(&task);
      else
        queue.push_back({&task});
    }
    if (!serial.empty()) queue.insert(queue.begin(), serial);
    ProgressMeter meter(cost, progress_);
    run_all(queue.size(), threads_, [&](std::size_t i) {
      for (const auto* task : queue[i]) {
        TaskShare share(meter, task->study->cost(task->run));
        task->study->make(task->run, share, interrupt_);
      }
    });
    if (!is_interrupted()) meter.finish();
  }

  // Case after case and subject after subject, so that an interrupt leaves whole rows.
  void run_rounds(const std::vector<Round>& rounds) const {
    std::vector<Task> tasks;
    for (const auto& round : rounds) {
      round.study->expect(round.missing);
      for (const auto& task : round.missing) tasks.push_back({round.study, task});
    }
    run_tasks(tasks);
  }

  // The next rounds of all open studies, those that end removed.
  std::vector<Round> next_rounds() const {
    std::vector<Round> rounds;
    for (auto* study : studies_) {
      if (study->is_closed()) continue;
      const auto next = study->next();
      if (!next.plan) {
        study->close(next.end);
        continue;
      }
      auto missing = study->missing(*next.plan);
      const double seconds = study->expected_seconds(missing, std::min(threads_, thread_count(0)));
      rounds.push_back({study, *next.plan, std::move(missing), seconds});
    }
    return rounds;
  }

  // Those that fit together into the time left, the shortest ones; what does not fit alone ends.
  static std::vector<Round> affordable(std::vector<Round> rounds, double left) {
    std::ranges::stable_sort(rounds, {}, &Round::seconds);
    double sum = 0.0;
    std::erase_if(rounds, [&](const Round& round) {
      if (!(round.seconds <= left))
        round.study->close(record::RefinementEnd::budget, round.seconds);
      sum += round.seconds;
      return !(sum <= left);
    });
    return rounds;
  }

  // False when interrupted: the last round is left out.
  bool refine(double budget) const {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    for (;;) {
      const double used = std::chrono::duration<double>(Clock::now() - start).count();
      const auto rounds = affordable(next_rounds(), budget - used);
      if (rounds.empty()) return true;
      run_rounds(rounds);
      if (is_interrupted()) {
        for (const auto& round : rounds) round.study->close(record::RefinementEnd::interrupted);
        return false;
      }
      for (const auto& round : rounds) round.study->assess(round.steps);
    }
  }

  // Causes of what the methods' runs show; one stored run a thread fills no memory.
  void explain() const {
    std::vector<Task> tasks;
    std::vector<SubjectStudy*> observed;
    for (auto* study : studies_) {
      const auto runs = study->to_observe();
      if (!runs.empty()) observed.push_back(study);
      for (const auto& run : runs) tasks.push_back({study, run});
    }
    if (tasks.empty()) return;
    run_tasks(tasks);
    run_all(observed.size(), threads_, [&](std::size_t i) { observed[i]->explain(); });
  }

  std::vector<SubjectStudy*> studies_;
  int threads_;
  const Progress& progress_;
  const std::atomic<bool>* interrupt_;
};

}  // namespace

bool run_studies(std::vector<CaseStudy>& cases, double budget, int threads,
                 const Progress& progress, const std::atomic<bool>* interrupt) {
  return Driver(cases, threads, progress, interrupt).run(budget);
}

}  // namespace clackers::study
