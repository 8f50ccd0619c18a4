#include "clackers/study/check_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/assess/convergence/fit/error_ladder.hpp"
#include "clackers/assess/convergence/judge.hpp"
#include "clackers/assess/convergence/sentence.hpp"
#include "clackers/base/codes.hpp"

namespace clackers::study {
namespace {

// A first row after the start holds the method's error of some steps, which is a part of the
// motion only where it is another motion.
constexpr double far_start = 0.1;

/// A verdict with its sentence and code.
struct Found {
  Verdict verdict = Verdict::not_claimed;
  std::string sentence, reason;
};

// Why the history is of another motion than the case's; empty when it is not.
std::string other_motion(const CheckedFile& file) {
  if (file.first > 0.0 && file.start_error > far_start)
    return fmt::format("Its first row is {:.2g} of the envelope away from the true motion.",
                       file.start_error);
  if (!file.score.impacts || !file.rows_resolve_collisions) return {};
  const auto& found = *file.score.impacts;
  if (found.missed == 0 && found.extra == 0) return {};
  return fmt::format("It finds {} of {} collisions and {} that did not happen: another motion.",
                     found.matched, found.expected, found.extra);
}

// The fit with printed digits named where they are what stops it. The fitter knows them as the
// rounding of its levels: it calls `exact` what lies below them throughout and finds too few levels
// where they begin early.
void name_printed_digits(CheckRecord& record) {
  auto& fit = record.assessment.displacement;
  const auto& finest = record.files.back();
  const double arithmetic = 1e-15 * double(finest.rows);
  const bool printed = finest.printed_floor > arithmetic &&
                       finest.score.u_error <= assess::rounding_slack * finest.printed_floor;
  const bool stopped = fit.behaviour == Behaviour::exact ||
                       fit.behaviour == Behaviour::stagnating ||
                       (fit.behaviour == Behaviour::undecided && fit.reason == "too-few-levels");
  if (!printed || !stopped) return;
  fit.behaviour = Behaviour::stagnating;
  fit.reason = Code("printed-digits").name();
  fit.floor = finest.score.u_error;
  fit.has_line = false;
  record.assessment.sentence = fmt::format(
      "The displacement error of the finest history, {:.2g}, is within {:.0f} times what printing "
      "makes of it ({:.2g}).",
      finest.score.u_error, assess::rounding_slack, finest.printed_floor);
}

Found expected(CheckRecord& record, const assess::Ladder& ladder) {
  auto claim = *record.expect;
  const double contact = record.files.back().contact_time;
  record.assessment = assess::judge(ladder, claim, contact);
  // A floor without a stated reason agrees with any.
  if (claim.behaviour == Behaviour::stagnating && claim.reason.empty()) {
    claim.reason = record.assessment.displacement.reason;
    record.assessment = assess::judge(ladder, claim, contact);
  }
  name_printed_digits(record);
  auto& found = record.assessment;
  if (found.displacement.reason == "printed-digits") {
    found.verdict = claim.behaviour == Behaviour::stagnating ? Verdict::agrees : Verdict::undecided;
    found.sentence += fmt::format(" Expected: {}.", assess::describe(*record.expect));
  }
  return {found.verdict, found.sentence, found.displacement.reason};
}

Found within_tolerance(const CheckRecord& record) {
  const auto& finest = record.files.back();
  const double error = finest.score.u_error, limit = *record.tolerance;
  if (!(std::abs(error - limit) > finest.printed_floor))
    return {Verdict::undecided,
            fmt::format("The error in u, {:.3g}, is nearer to the tolerance {:.3g} than the {:.2g} "
                        "that printing makes.",
                        error, limit, finest.printed_floor),
            std::string(Code("printed-digits").name())};
  const bool good = error <= limit;
  return {good ? Verdict::agrees : Verdict::disagrees,
          fmt::format("The error in u, {:.3g}, is {} the tolerance {:.3g}.", error,
                      good ? "within" : "beyond", limit),
          {}};
}

int severity(Verdict verdict) {
  switch (verdict) {
    case Verdict::disagrees:
      return 3;
    case Verdict::undecided:
      return 2;
    case Verdict::agrees:
      return 1;
    case Verdict::not_claimed:
      break;
  }
  return 0;
}

void add(CheckRecord& record, const Found& found) {
  if (severity(found.verdict) > severity(record.verdict)) {
    record.verdict = found.verdict;
    record.reason = found.reason;
  }
  record.sentence += (record.sentence.empty() ? "" : " ") + found.sentence;
}

void add_nothing_claimed(CheckRecord& record) {
  const bool several = record.files.size() > 1;
  record.sentence = several ? record.assessment.sentence : "Nothing is claimed.";
  if (several) record.reason = record.assessment.displacement.reason;
  if (several && record.assessment.displacement.reason == "printed-digits")
    record.sentence += " Nothing is claimed.";
  const auto& finest = record.files.back();
  if (finest.score.impacts && !finest.rows_resolve_collisions) {
    record.sentence += " Its rows lie too far apart to tell whether it collides as it should.";
    record.reason = Code("sparse-rows").name();
  }
}

// The command that leads on; file names as a shell reads them are the caller's.
std::string next_of(const CheckRecord& record) {
  const auto& fit = record.assessment.displacement;
  const bool several = record.files.size() > 1;
  if (!record.reason.empty()) return "clackers explain " + record.reason;
  if (record.verdict == Verdict::disagrees)
    return fmt::format("clackers respond {} --collisions", record.problem.name);
  if (record.expect || record.tolerance) return "clackers verify";
  if (several && fit.has_line)
    return fmt::format("add --expect {}:{:.0f}", to_string(fit.behaviour),
                       std::max(1.0, std::round(fit.order)));
  return several ? "clackers check --help" : "check the same run at two steps or more";
}

}  // namespace

assess::Ladder levels_of(const std::vector<CheckedFile>& files) {
  constexpr double next_level = 1.3;
  assess::Ladder ladder;
  double last = 0.0;
  for (const auto& file : files) {
    const double h = file.score.step;
    // Of eight neighbours in the ratio 2^(1/8) the ninth begins the next level.
    const bool joins =
        !ladder.empty() && last / h < next_level && ladder.back().step / h < std::exp2(15.0 / 16.0);
    if (!joins) ladder.push_back({h, {}});
    ladder.back().runs.push_back(file.score);
    last = h;
  }
  return ladder;
}

void decide(CheckRecord& record) {
  const auto ladder = levels_of(record.files);
  const auto other = other_motion(record.files.back());
  if (record.expect) {
    add(record, expected(record, ladder));
  } else {
    record.assessment = assess::judge(ladder, {}, record.files.back().contact_time);
    name_printed_digits(record);
    record.assessment.verdict = Verdict::not_claimed;
  }
  if (record.tolerance) add(record, within_tolerance(record));
  if (!record.expect && !record.tolerance) add_nothing_claimed(record);
  // An expected divergence or floor may well lead to another motion.
  if (!other.empty() && !record.expect) add(record, {Verdict::disagrees, other, {}});
  record.next = next_of(record);
}

}  // namespace clackers::study
