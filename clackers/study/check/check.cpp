#include "clackers/study/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/study/check/check_file.hpp"
#include "clackers/study/check/check_verdict.hpp"
#include "clackers/study/provenance.hpp"
#include "clackers/study/reduced_curve.hpp"
#include "clackers/study/respond.hpp"
#include "clackers/study/verify/verify_plan.hpp"

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
  require_one_each("--events", request.events.size(), request.files.size());
  require_one_each("--steps", request.steps.size(), request.files.size());
  for (const double step : request.steps) require_step("check --steps", step);
  if (request.tolerance) require_positive("check", "--tolerance", *request.tolerance);
}

void require_levels(const std::vector<CheckedFile>& files) {
  if (files.size() < 2 || files.front().score.step > 1.001 * files.back().score.step) return;
  refuse("check", "step of every history", files.front().score.step,
         "different steps, since several histories are levels of one method",
         "Name the steps with --steps h1,h2,... in the order of the files.");
}

}  // namespace

CheckRecord check(const CheckRequest& request, const std::atomic<bool>* interrupt) {
  validate(request);
  const auto which = cases::make(
      request.case_name.empty() ? cases::default_case() : request.case_name, request.settings);
  CheckRecord record;
  record.provenance = provenance(request.command);
  record.problem = summary_of(which);
  record.response = reduced(response_curve(which, response_points));
  record.expect = request.expect;
  record.tolerance = request.tolerance;
  for (std::size_t i = 0; i < request.files.size(); ++i) {
    CheckTask task{.file = request.files[i], .events = {}, .step = 0.0};
    if (!request.events.empty()) task.events = request.events[i];
    if (!request.steps.empty()) task.step = request.steps[i];
    record.files.push_back(check_file(task, request.columns, which, record.problem, interrupt));
  }
  std::ranges::stable_sort(record.files, std::greater{},
                           [](const CheckedFile& file) { return file.score.step; });
  require_levels(record.files);
  decide(record);
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
  const auto [stop, error] =
      std::from_chars(order.data(), order.data() + order.size(), claim.order);
  if (error != std::errc() || stop != order.data() + order.size() ||
      !(claim.order > 0.0 && claim.order <= 20.0))
    refuse("check", "order of --expect", order, "0 < order <= 20");
  return claim;
}

int exit_code(const CheckRecord& record) {
  if (record.verdict == Verdict::disagrees) return 1;
  return record.verdict == Verdict::undecided ? 3 : 0;
}

std::string_view to_string(StepSource source) {
  constexpr std::string_view names[] = {"data", "name", "option"};
  return names[static_cast<std::size_t>(source)];
}

std::string_view to_string(CollisionSource source) {
  constexpr std::string_view names[] = {"events", "history", "unknown"};
  return names[static_cast<std::size_t>(source)];
}

}  // namespace clackers::study
