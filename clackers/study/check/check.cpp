#include "clackers/study/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/number.hpp"
#include "clackers/record/provenance.hpp"
#include "clackers/record/reduced_curve.hpp"
#include "clackers/study/check/history_set.hpp"
#include "clackers/study/verify/verify_plan.hpp"
#include "clackers/tables/respond.hpp"

namespace clackers::study {
namespace {

void require_one_each(const char* option, std::size_t given, std::size_t files) {
  if (given == 0 || given == files) return;
  refuse("check", option, fmt::format("{} of them", given),
         fmt::format("one a history, {} here, in the same order", files), {}, "wrong-size");
}

void validate(const CheckRequest& request) {
  if (request.files.empty())
    throw InputError("check needs a FILE with a time history.", "bad-syntax");
  const auto is_input = [](const input::Source& source) { return path_of(source) == "-"; };
  if (std::ranges::count_if(request.files, is_input) +
          std::ranges::count_if(request.events, is_input) >
      1)
    throw InputError("check: - stands more than once; allowed: standard input for one file.",
                     "bad-syntax");
  require_one_each("--events", request.events.size(), request.files.size());
  require_one_each("--steps", request.steps.size(), request.files.size());
  require_one_each("--tolerances", request.tolerances.size(), request.files.size());
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

void read_all(const CheckRequest& request, HistorySet& histories, const Progress& progress) {
  double total = 0.0;
  for (const auto& file : request.files) total += cost_of(file);
  ProgressMeter meter(total, progress);
  for (std::size_t i = 0; i < request.files.size(); ++i) {
    HistoryTask task;
    task.file = request.files[i];
    if (!request.events.empty()) task.events = request.events[i];
    if (!request.steps.empty()) task.step = request.steps[i];
    if (!request.tolerances.empty()) task.step = request.tolerances[i];
    task.step_is_tolerance = !request.tolerances.empty();
    const double cost = cost_of(task.file);
    TaskShare share(meter, cost);
    double done = 0.0;
    histories.read(task, [&](double part) {
      share.add(cost * (part - done));
      done = part;
    });
  }
  meter.finish();
}

}  // namespace

record::Record check(const CheckRequest& request, const Progress& progress,
                     const std::atomic<bool>* interrupt) {
  validate(request);
  const auto problem = cases::make(
      request.case_name.empty() ? cases::default_case() : request.case_name, request.settings);
  record::CaseRecord one;
  one.problem = summary_of(problem);
  one.plan = no_refinement;
  one.response = reduced(tables::response_curve(problem, tables::response_points));
  HistorySet histories(problem, one.problem, request.columns, interrupt);
  read_all(request, histories, progress);
  one.subjects.push_back(histories.assess(record::SubjectKind::histories, "histories",
                                          request.expect.value_or(Claim{}), request.tolerance,
                                          !request.tolerances.empty()));
  record::Record record;
  record.command = "check";
  record.provenance = record::provenance(request.command);
  record.cases.push_back(std::move(one));
  return record;
}

Claim claim_from(std::string_view text) {
  const auto colon = text.find(':');
  Claim claim;
  claim.behaviour = behaviour_from(text.substr(0, colon));
  const bool has_line = claim.behaviour == Behaviour::proper ||
                        claim.behaviour == Behaviour::reduced ||
                        claim.behaviour == Behaviour::irregular;
  if (claim.behaviour == Behaviour::undecided)
    refuse("check", "--expect", text, "proper, reduced, irregular, exact, stagnating or divergent",
           "Nothing to expect: leave --expect out.", "bad-syntax");
  if (has_line != (colon != std::string_view::npos))
    refuse("check", "--expect", text,
           has_line ? "a behaviour with its order, as in proper:2"
                    : fmt::format("{} without an order", to_string(claim.behaviour)),
           {}, "bad-syntax");
  if (!has_line) return claim;
  const auto order = text.substr(colon + 1);
  claim.order = finite_number(order).value_or(0.0);
  if (!(claim.order > 0.0 && claim.order <= 20.0))
    refuse("check", "order of --expect", order, "0 < order <= 20");
  return claim;
}

}  // namespace clackers::study
