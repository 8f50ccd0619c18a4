#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <deque>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/study/program.hpp"
#include "clackers/study/program/program_study.hpp"
#include "clackers/study/provenance.hpp"
#include "clackers/study/reduced_curve.hpp"
#include "clackers/study/respond.hpp"
#include "clackers/study/verify/verify_plan.hpp"
#include "clackers/study/verify/work_queue.hpp"

namespace clackers::study {
namespace {

// A start costs a program about as much as this many steps.
constexpr double start_steps = 5000.0;

// Studies of one case; a deque, since they do not move.
using CaseStudies = std::deque<ProgramStudy>;

struct Task {
  ProgramStudy* study;
  ProgramRun run;
  double cost() const { return start_steps + double(run.steps); }
};

std::vector<std::string> case_names(const VerifyRequest& request) {
  if (!request.cases.empty()) return request.cases;
  return {std::string(cases::default_case())};
}

// A record of the cases, without subjects.
Record empty_record(const VerifyRequest& request, bool has_steps) {
  Record record;
  record.provenance = provenance(request.command);
  for (const auto& name : case_names(request)) {
    if (std::ranges::count(case_names(request), name) > 1)
      refuse("verify", "case", name, "each case once", {}, "bad-syntax");
    const auto problem = cases::make(name, request.settings);
    CaseRecord one;
    one.problem = summary_of(problem);
    one.plan = has_steps ? plan_for(request.plan, one.problem) : no_refinement;
    one.response = reduced(response_curve(problem, response_points));
    record.cases.push_back(std::move(one));
  }
  return record;
}

std::vector<double> default_tolerances() { return tolerances_from("1e-3:1e-10"); }

class ProgramStudies {
 public:
  ProgramStudies(const VerifyRequest& request, const ProgramRequest& programs, Record& record,
                 const std::atomic<bool>* interrupt)
      : request_(request),
        programs_(programs),
        record_(record),
        interrupt_(interrupt),
        folder_(programs.work),
        threads_(thread_count(request.jobs)) {
    for (auto& one : record.cases) add_case(one);
  }

  void run(const Progress& progress) {
    std::vector<Task> tasks;
    for (auto& studies : cases_)
      for (auto& study : studies)
        for (const auto& run : study.missing(study.plan())) tasks.push_back({&study, run});
    make(tasks, progress);
    for (auto& studies : cases_)
      for (auto& study : studies) study.assess(study.plan());
    if (request_.budget > 0.0)
      for (auto& studies : cases_)
        for (auto& study : studies) refine(study, progress);
    for (std::size_t c = 0; c < cases_.size(); ++c)
      for (auto& study : cases_[c]) {
        record_.cases[c].subjects.push_back(study.finish());
        record_.interrupted = record_.interrupted || is_interrupted();
      }
  }

 private:
  bool is_interrupted() const { return interrupt_ != nullptr && *interrupt_; }

  void add_case(CaseRecord& one) {
    const auto problem = cases::make(one.problem.name, request_.settings);
    auto& studies = cases_.emplace_back();
    std::vector<std::string> names = request_.methods;
    for (const auto& program : programs_.programs) {
      CommandTemplate command(program.command);
      const auto name = program.name.empty() ? command.name() : program.name;
      if (std::ranges::find(names, name) != names.end())
        refuse("verify", "name of a program", name, "each name once", "Give every --exec a --name.",
               "bad-syntax");
      names.push_back(name);
      const bool by_tolerance = command.uses("tolerance");
      ProgramRunner runner(std::move(command), name, one.problem.name, problem.problem,
                           programs_.timeout, programs_.fresh, folder_);
      studies.emplace_back(std::move(runner), name, problem, one.problem,
                           plan_for(request_.plan, one.problem),
                           by_tolerance ? tolerances() : std::vector<double>(),
                           programs_.expect.value_or(Claim{}), interrupt_);
    }
  }

  std::vector<double> tolerances() const {
    return programs_.tolerances.empty() ? default_tolerances() : programs_.tolerances;
  }

  void make(const std::vector<Task>& tasks, const Progress& progress) const {
    double cost = 0.0;
    for (const auto& task : tasks) cost += task.cost();
    ProgressMeter meter(cost, progress);
    run_all(tasks.size(), threads_, [&](std::size_t i) {
      const TaskShare share(meter, tasks[i].cost());
      tasks[i].study->make(tasks[i].run);
    });
    if (!is_interrupted()) meter.finish();
  }

  // One program after the other, each while it is open and the time lasts.
  void refine(ProgramStudy& study, const Progress& progress) {
    using Clock = std::chrono::steady_clock;
    for (;;) {
      if (is_interrupted()) return study.close(RefinementEnd::interrupted);
      const auto next = study.next();
      if (!next.plan) return study.close(next.end);
      const auto runs = study.missing(*next.plan);
      const int parallel = std::min(threads_, thread_count(0));
      const double expected = study.expected_seconds(runs) / parallel;
      if (!(used_ + expected <= request_.budget))
        return study.close(RefinementEnd::budget, expected);
      const auto start = Clock::now();
      std::vector<Task> tasks;
      for (const auto& run : runs) tasks.push_back({&study, run});
      make(tasks, progress);
      study.assess(*next.plan);
      used_ += std::chrono::duration<double>(Clock::now() - start).count();
    }
  }

  const VerifyRequest& request_;
  const ProgramRequest& programs_;
  Record& record_;
  const std::atomic<bool>* interrupt_;
  WorkFolder folder_;
  int threads_;
  std::deque<CaseStudies> cases_;
  double used_ = 0.0;  // of the budget [s]
};

double tolerance_in(std::string_view whole, std::string_view text) {
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || !(value > 0.0 && value <= 1.0))
    refuse("verify", "--tolerances", whole,
           "1e-3:1e-12, one a decade, or a list 1e-3,1e-5, above 0 and at most 1", {},
           "bad-syntax");
  return value;
}

}  // namespace

Record verify(const VerifyRequest& request, const ProgramRequest& programs,
              const Progress& progress, const std::atomic<bool>* interrupt) {
  require_positive("verify", "timeout", programs.timeout);
  const bool has_steps =
      !request.methods.empty() || std::ranges::any_of(programs.programs, [](const Program& one) {
        return !CommandTemplate(one.command).uses("tolerance");
      });
  auto record = empty_record(request, has_steps);
  ProgramStudies studies(request, programs, record, interrupt);
  // Progress of either comes in rounds of its own.
  if (!request.methods.empty()) record = verify(request, progress, interrupt);
  studies.run(progress);
  return record;
}

const Run* failure_of_all(const Record& record) {
  const Run* first = nullptr;
  for (const auto& one : record.cases)
    for (const auto& subject : one.subjects)
      for (const auto& level : subject.levels)
        for (const auto& run : level.runs) {
          if (run.score.finished) return nullptr;
          if (first == nullptr && subject.kind == SubjectKind::program) first = &run;
        }
  return first;
}

std::vector<double> tolerances_from(std::string_view text) {
  std::vector<double> tolerances;
  if (const auto colon = text.find(':'); colon != std::string_view::npos) {
    const double first = tolerance_in(text, text.substr(0, colon));
    const double last = tolerance_in(text, text.substr(colon + 1));
    // Powers of ten are the doubles that one would type.
    const double decades = std::log10(first / last);
    for (int i = 0; i <= int(std::floor(decades + 1e-9)); ++i)
      tolerances.push_back(tolerance_in(text, fmt::format("{:.6g}", first * std::pow(10.0, -i))));
    if (!(first > last)) tolerance_in(text, {});
    return tolerances;
  }
  for (auto rest = text;;) {
    const auto comma = rest.find(',');
    tolerances.push_back(tolerance_in(text, rest.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  std::ranges::sort(tolerances, std::greater{});
  if (std::ranges::adjacent_find(tolerances) != tolerances.end())
    refuse("verify", "--tolerances", text, "each tolerance once", {}, "bad-syntax");
  return tolerances;
}

}  // namespace clackers::study
