#include "clackers/study/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/number.hpp"
#include "clackers/record/notes.hpp"
#include "clackers/record/record.hpp"
#include "clackers/record/reduced_curve.hpp"
#include "clackers/study/check/history/history_run.hpp"
#include "clackers/study/check/named_resolution.hpp"
#include "clackers/study/subject_study.hpp"
#include "clackers/study/verify.hpp"
#include "clackers/tables/respond.hpp"

namespace clackers::study {
namespace {

void require_one_each(const char* option, std::size_t given, std::size_t files) {
  if (given == 0 || given == files) return;
  refuse("check", option, fmt::format("{} of them", given),
         fmt::format("one a history, {} here, in the same order", files), {}, "wrong-size");
}

// The histories of all subjects.
std::vector<input::Source> files_of(const CheckRequest& request) {
  std::vector<input::Source> files;
  for (const auto& subject : request.subjects)
    files.insert(files.end(), subject.files.begin(), subject.files.end());
  return files;
}

void validate_subjects(const std::vector<NamedHistories>& subjects) {
  if (subjects.empty() || (subjects.size() == 1 && subjects[0].files.empty()))
    throw InputError("check needs a FILE with a time history.", "bad-syntax");
  for (const auto& [files, name] : subjects) {
    if (std::ranges::count(subjects, name, &NamedHistories::name) > 1)
      refuse("check", "--name", name, "each name once, with all its files behind it", {},
             "bad-syntax");
    if (files.empty())
      refuse("check", "--name", name, "a name with one FILE or more behind it", {}, "bad-syntax");
  }
}

void validate(const CheckRequest& request) {
  validate_subjects(request.subjects);
  const auto files = files_of(request);
  const auto is_input = [](const input::Source& source) { return path_of(source) == "-"; };
  if (std::ranges::count_if(files, is_input) + std::ranges::count_if(request.events, is_input) > 1)
    throw InputError("check: - is given more than once; allowed: standard input for one file.",
                     "bad-syntax");
  require_one_each("--events", request.events.size(), files.size());
  require_one_each("--steps", request.steps.size(), files.size());
  require_one_each("--tolerances", request.tolerances.size(), files.size());
  if (!request.steps.empty() && !request.tolerances.empty())
    throw InputError("check: --steps and --tolerances; allowed: one of them.", "bad-syntax");
  for (const double step : request.steps) require_step("check --steps", step);
  for (const double t : request.tolerances)
    if (!(t > 0.0 && t < 1.0)) refuse("check", "--tolerances", t, "0 < tolerance < 1");
  if (request.tolerance) require_positive("check", "--tolerance", *request.tolerance);
}

// Work to expect of a history: its bytes. Of standard input nothing is known.
double cost_of(const input::Source& source) {
  if (const auto* columns = std::get_if<input::NumberColumns>(&source))
    return 1.0 + double(columns->rows * columns->columns.size() * sizeof(double));
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path_of(source), error);
  return error ? 1.0 : 1.0 + double(bytes);
}

// A history that was read, before its step is chosen.
struct Entry {
  Measured measured;
  NamedResolution named;
  bool step_is_given = false;
};

std::vector<Entry> read_all(const CheckRequest& request, const StudyCase& problem,
                            const Progress& progress, const std::atomic<bool>* interrupt) {
  const auto files = files_of(request);
  double total = 0.0;
  for (const auto& file : files) total += cost_of(file);
  ProgressMeter meter(total, progress);
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < files.size(); ++i) {
    HistoryTask task;
    task.file = files[i];
    if (!request.events.empty()) task.events = request.events[i];
    if (!request.steps.empty()) task.step = request.steps[i];
    if (!request.tolerances.empty()) task.step = request.tolerances[i];
    task.step_is_tolerance = !request.tolerances.empty();
    task.results = request.results;
    const double cost = cost_of(task.file);
    TaskShare share(meter, cost);
    double done = 0.0;
    const auto report = [&](double part) {
      share.add(cost * (part - done));
      done = part;
    };
    auto found =
        history_run(task, request.columns, problem.problem, problem.summary, report, interrupt);
    auto& entry = entries.emplace_back();
    entry.measured.run = std::move(found.run);
    entry.measured.observation = std::move(found.observation);
    entry.named = named_resolution(input::name_of(task.file));
    entry.step_is_given = task.step > 0.0;
  }
  meter.finish();
  return entries;
}

// Steps or tolerances of all runs of a subject; those that were given count before names and rows.
// True for tolerances that are found in the names.
bool choose_steps(std::span<Entry> entries, const StudyCase& problem) {
  std::vector<NamedHistory> set;
  for (const auto& entry : entries)
    if (!entry.step_is_given) set.push_back({entry.named, entry.measured.run.file->spacing});
  const auto names = named_steps(set, problem.summary.fast_period, problem.summary.end);
  const bool by_tolerance = names.by_tolerance && set.size() == entries.size();
  std::size_t next = 0;
  for (auto& entry : entries) {
    if (entry.step_is_given) continue;
    const auto& step = names.steps[next++];
    auto& run = entry.measured.run;
    auto& file = *run.file;
    const double spacing = file.spacing, named = entry.named.step.value_or(spacing);
    file.step_source = step ? record::StepSource::name : record::StepSource::data;
    run.score.step = step.value_or(spacing);
    if (!step && named > spacing)
      file.notes.push_back(record::note("step-in-name-ignored", {named, spacing}));
    if (step && !by_tolerance && *step > 1.01 * spacing)
      file.notes.push_back(record::note("rows-closer-than-step", {*step, spacing}));
  }
  return by_tolerance;
}

void require_different_steps(const std::string& who, std::span<const Entry> entries) {
  const auto step = [](const Entry& entry) { return entry.measured.run.score.step; };
  const auto [least, most] = std::ranges::minmax_element(entries, {}, step);
  if (entries.size() < 2 || step(*most) > 1.001 * step(*least)) return;
  refuse(who, "step of every history", step(*most),
         "different steps, since several histories are levels of one method",
         "Name the steps with --steps h1,h2,... in the order of the files.");
}

// Not one of the histories is finite: the finest says why.
void require_finite(std::span<const Entry> entries) {
  const auto is_finished = [](const Entry& entry) { return entry.measured.run.score.finished; };
  if (std::ranges::any_of(entries, is_finished)) return;
  const auto finest = std::ranges::min_element(
      entries, {}, [](const Entry& entry) { return entry.measured.run.score.step; });
  throw InputError(finest->measured.run.score.failure, "not-finite");
}

record::Subject assessed(const CheckRequest& request, const std::string& name,
                         std::span<Entry> entries, const StudyCase& problem) {
  const bool is_alone = request.subjects.size() == 1;
  record::Subject subject;
  subject.kind = record::SubjectKind::histories;
  subject.name = name;
  subject.labels = request.labels;
  subject.claim = request.expect.value_or(Claim{});
  subject.tolerance = request.tolerance;
  const bool by_tolerance = choose_steps(entries, problem) || !request.tolerances.empty();
  if (by_tolerance) subject.refined_by = record::RefinementParameter::tolerance;
  require_finite(entries);
  require_different_steps(is_alone ? "check" : "check --name " + name, entries);
  SubjectStudy study(problem, std::move(subject));
  for (auto& entry : entries) {
    auto& score = entry.measured.run.score;
    const double step = score.step;
    // Their only cost that can be compared.
    if (!is_alone && !by_tolerance && score.work.steps == 0)
      score.work.steps = std::max(1LL, std::llround(entry.measured.run.file->last / step));
    study.take({{step, 0, by_tolerance ? step : 0.0}}, std::move(entry.measured));
  }
  study.assess(no_refinement);
  return study.finish();
}

}  // namespace

record::Record check(const CheckRequest& request, const Progress& progress,
                     const std::atomic<bool>* interrupt) {
  validate(request);
  const auto problem = study_case(cases::make(
      request.case_name.empty() ? cases::default_case() : request.case_name, request.settings));
  auto entries = read_all(request, problem, progress, interrupt);
  record::CaseRecord result;
  std::span<Entry> rest = entries;
  for (const auto& [files, name] : request.subjects) {
    result.subjects.push_back(assessed(request, name, rest.first(files.size()), problem));
    rest = rest.subspan(files.size());
  }
  result.problem = problem.summary;
  result.plan = no_refinement;
  result.response = reduced(tables::response_curve(problem.problem, tables::response_points));
  if (result.subjects.size() > 1) result.profiles = record::profiles_of({&result, 1});
  record::Record record;
  record.command = "check";
  record.provenance = record::provenance(request.command);
  record.cases.push_back(std::move(result));
  return record;
}

Claim claim_from(std::string_view text) {
  constexpr std::string_view velocity = "velocity:";
  const auto order_of = [](std::string_view order) {
    const double value = finite_number(order).value_or(0.0);
    if (!(value > 0.0 && value <= 20.0)) refuse("expect", "order", order, "0 < order <= 20");
    return value;
  };
  Claim claim;
  if (const auto at = text.find(velocity); at == 0 || (at < text.size() && text[at - 1] == ',')) {
    if (at > 0) claim = claim_from(text.substr(0, at - 1));
    claim.velocity_order = order_of(text.substr(at + velocity.size()));
    return claim;
  }
  const auto colon = text.find(':');
  claim.behaviour = behaviour_from(text.substr(0, colon));
  const bool has_line = claim.behaviour == Behaviour::proper ||
                        claim.behaviour == Behaviour::reduced ||
                        claim.behaviour == Behaviour::irregular;
  if (!claim.is_made())
    refuse("clackers", "expect", text,
           "proper, reduced, irregular, exact, stagnating, divergent or velocity",
           "Nothing to expect: leave it out.", "bad-syntax");
  if (claim.behaviour == Behaviour::stagnating && colon != std::string_view::npos) {
    claim.reason = text.substr(colon + 1);
    constexpr auto reasons =
        std::to_array<Code>({"contact-stiffness", "tolerance-floor", "noise-floor",
                             "printed-digits", "simultaneous-impacts", "unexplained-floor"});
    if (std::ranges::find(reasons, claim.reason, &Code::name) == reasons.end())
      refuse("expect", "reason", claim.reason,
             "contact-stiffness, tolerance-floor, noise-floor, printed-digits, "
             "simultaneous-impacts or unexplained-floor",
             {}, "unknown-name");
    return claim;
  }
  if (has_line != (colon != std::string_view::npos))
    refuse("clackers", "expect", text,
           has_line ? "a behaviour with its order, as in proper:2"
                    : fmt::format("{} without an order", to_string(claim.behaviour)),
           {}, "bad-syntax");
  if (!has_line) return claim;
  claim.order = order_of(text.substr(colon + 1));
  return claim;
}

}  // namespace clackers::study
