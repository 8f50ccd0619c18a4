#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

#include "clackers/base/codes.hpp"
#include "clackers/judge/convergence/ladder_fit.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

void add(std::string& text, std::string_view sentence) {
  if (sentence.empty()) return;
  if (!text.empty()) text += ' ';
  text += sentence;
}

// "2.7", "32", "270", "4e5".
std::string rounded_factor(double factor) {
  return factor >= 10.0 && factor < 1e4 ? fmt::format("{:.0f}", factor) : short_number(factor, 2);
}

std::string meaning_of(std::string_view code) {
  const auto* entry = find_code(code);
  return entry == nullptr ? std::string() : std::string(entry->meaning);
}

// The steps of the runs that the line was fitted to.
std::string range_text(const record::Subject& subject, const judge::LadderFit& fit) {
  const auto nominal = [&](int level) {
    const auto i = std::size_t(level);
    return i < fit.steps.size() ? fit.steps[i] : std::nan("");
  };
  const bool is_known = fit.largest_step > 0.0;
  const double from = is_known ? fit.largest_step : nominal(fit.first_level);
  const double to = is_known ? fit.smallest_step : nominal(fit.last_level);
  if (from == to) return resolution_text(subject, from);
  const bool is_step = subject.refined_by == record::RefinementParameter::step;
  return fmt::format("{} to {}{}", resolution_text(subject, from), short_number(to, 3),
                     is_step ? " s" : "");
}

// Of a line that ends at a floor: where and at which error.
std::string floor_part(const record::Subject& subject, const judge::LadderFit& fit) {
  if (!(fit.floor > 0.0 && fit.floor_step > 0.0)) return {};
  return fmt::format("; from {} on a floor of {}{}", resolution_text(subject, fit.floor_step),
                     scientific(fit.floor),
                     fit.floor_scatter > 2.0
                         ? fmt::format(", rough by a factor {}", short_number(fit.floor_scatter, 2))
                         : "");
}

std::string tolerance_sentence(const record::Subject& subject, const judge::LadderFit& fit) {
  if (subject.refined_by != record::RefinementParameter::tolerance || !fit.has_line) return {};
  const bool is_proportional = std::abs(fit.order - 1.0) <= judge::tolerance_proportional;
  return fmt::format("The error is {}proportional to the tolerance.",
                     is_proportional ? "" : "not ");
}

// Reasons that leave open what is wrong; a shown cause says more.
constexpr auto open_reasons = std::to_array<Code>(
    {"wrong-limit", "contact-stiffness", "larger-than-motion", "energy-growth", "noise-floor"});

bool is_one_of(std::span<const Code> codes, std::string_view code) {
  return std::ranges::any_of(codes, [&](Code known) { return known.name() == code; });
}

bool is_explained(const record::Subject& subject) {
  const auto& reason = subject.assessment.displacement.reason;
  if (is_shown_cause(subject, reason)) return true;
  if (subject.diagnoses.empty()) return false;
  const auto* cause = diagnose::find_cause(subject.diagnoses.front().code);
  return reason == Code("unexplained-floor").name() ||
         (is_one_of(open_reasons, reason) &&
          (cause == nullptr || (cause->effect != diagnose::CauseEffect::method &&
                                cause->effect != diagnose::CauseEffect::noise)));
}

std::string behaviour_sentence(const record::Subject& subject) {
  const auto& fit = subject.assessment.displacement;
  const auto order = [&] {
    return fmt::format("{} ({}{})", order_text(fit), range_text(subject, fit),
                       floor_part(subject, fit));
  };
  std::string text;
  switch (fit.behaviour) {
    case Behaviour::exact:
      return "Exact: the error in u is at the rounding floor at every level.";
    case Behaviour::proper:
      text = fmt::format("Converges with order {}.", order());
      break;
    case Behaviour::reduced:
      text = fmt::format("Converges with the reduced order {}.", order());
      break;
    case Behaviour::irregular:
      text = fmt::format(
          "Converges irregularly: the upper envelope has order {}, errors scatter by up to a factor {}.",
          order(), rounded_factor(fit.scatter));
      break;
    case Behaviour::stagnating:
      text = fit.has_line && fit.spread < fit.order
                 ? fmt::format("Converges with order {}, then stagnates at an error in u of {}.",
                               order(), scientific(fit.floor))
                 : fmt::format(
                       "Stagnates at an error in u of {}{}.", scientific(fit.floor),
                       fit.first_level == fit.last_level && fit.largest_step == fit.smallest_step
                           ? std::string()
                           : fmt::format(" ({})", range_text(subject, fit)));
      break;
    case Behaviour::divergent:
      text = "Diverges.";
      break;
    case Behaviour::undecided:
      text = "The behaviour is undecided.";
      break;
  }
  add(text, tolerance_sentence(subject, fit));
  // What to add is said with its steps instead.
  if (hint_text(subject).empty() && !is_explained(subject)) add(text, meaning_of(fit.reason));
  return text;
}

// What explains a fit, behind its sentence: numbers as the table in assessment.hpp has them.
std::string remark(const record::Subject& subject, const judge::Evidence& evidence) {
  const auto is = [&](judge::EvidenceCode code) { return evidence.code == code.name(); };
  const auto number = [&](std::size_t i) {
    return i < evidence.numbers.size() ? evidence.numbers[i] : std::nan("");
  };
  const auto text = [&](std::size_t i) { return short_number(number(i), 3); };
  if (is("commensurate-steps"))
    return fmt::format(
        "{:.0f} % of the runs are at the rounding floor because their steps divide the time "
        "between impacts.",
        100.0 * number(0));
  if (is("errors-cancel"))
    return fmt::format("The signed error passes zero near {}.",
                       resolution_text(subject, number(0)));
  if (is("unstable-coarse-steps"))
    return fmt::format("Runs above {} fail or grow without bound.",
                       resolution_text(subject, number(0)));
  if (is("steps-per-contact"))
    return fmt::format("A contact, or a reversal of regular friction, has {} steps.", text(0));
  if (is("more-samples"))
    return fmt::format("The order is uncertain by ±{}: use more samples per level.", text(1));
  if (is("velocity-order-lower"))
    return fmt::format("Velocities converge with order {:.2f}.", number(0));
  if (is("error-over-tolerance"))
    return fmt::format("It is {} times the tolerance ({} to {}).", text(0), text(1), text(2));
  return {};
}

// The numbers of an Evidence as its table in assessment.hpp has them.
std::string evidence_sentence(const record::Subject& subject, const judge::Evidence& evidence) {
  const auto is = [&](judge::EvidenceCode code) { return evidence.code == code.name(); };
  const auto number = [&](std::size_t i) {
    return i < evidence.numbers.size() ? evidence.numbers[i] : std::nan("");
  };
  const auto text = [&](std::size_t i, int digits = 3) { return short_number(number(i), digits); };
  if (is("impacts-miscounted"))
    return fmt::format("Wrong impacts at {}: {} of {} matched, {} extra.",
                       resolution_text(subject, number(0)), text(1, 15), text(2, 15), text(3, 15));
  if (is("printed-digits"))
    return fmt::format(
        "Limited by the printed digits: the error in u of the finest history is {}, printing alone "
        "may make {}.",
        scientific(number(0)), scientific(number(1)));
  if (is("within-tolerance"))
    return fmt::format("Within the tolerance: the error in u is {}, the tolerance {}.", text(0),
                       text(1));
  if (is("beyond-tolerance"))
    return fmt::format("Beyond the tolerance: the error in u is {}, the tolerance {}.", text(0),
                       text(1));
  if (is("tolerance-not-resolved"))
    return fmt::format(
        "The printed digits are too few for this tolerance: the error in u is {}, the tolerance {}, "
        "printing alone may make {}.",
        text(0), text(1), scientific(number(2)));
  if (is("other-start"))
    return fmt::format("Another motion: the first row differs by {} of the envelope.", text(0, 2));
  if (is("other-impacts"))
    return fmt::format("Another motion: {} of {} impacts matched, {} extra.", text(0, 15),
                       text(1, 15), text(2, 15));
  if (is("velocity-order"))
    return fmt::format("Velocities converge with order {:.2f} ± {}, expected {}.", number(0),
                       text(1, 2), text(2));
  if (is("ends-early"))
    return fmt::format("The history ends at {} s of {} s, with {} of {} impacts.", text(0), text(1),
                       text(2, 15), text(3, 15));
  if (is("simultaneous-impacts"))
    return fmt::format(
        "At t = {} s, where {} contacts act at once, the error in u goes from {} to {}.", text(0),
        text(1), scientific(number(2)), scientific(number(3)));
  // A cause of another system says it with its number.
  if (is("wrong-limit"))
    return is_explained(subject) ? "" : "The histories converge to another motion.";
  if (is("sparse-rows")) return "The rows are too far apart to find the impacts in them.";
  return meaning_of(evidence.code);
}

const record::Run* first_failure(const record::Subject& subject) {
  for (const auto& level : subject.levels)
    for (const auto& run : level.runs)
      if (!run.score.failure.empty()) return &run;
  return nullptr;
}

std::string claim_sentence(const record::Subject& subject) {
  const auto& [claim, assessment] = std::tie(subject.claim, subject.assessment);
  if (!claim.is_made()) return subject.tolerance ? std::string() : "Nothing is claimed.";
  const auto& fit = assessment.displacement;
  using judge::Mismatch;
  const auto claimed =
      fmt::format("{}: {}", subject.kind == record::SubjectKind::method ? "Claimed" : "Expected",
                  claim_text(claim));
  if (assessment.verdict == Verdict::undecided && fit.behaviour == Behaviour::exact)
    return claimed + "; a larger coarsest step is needed to measure it.";
  if (assessment.verdict == Verdict::undecided && fit.behaviour == Behaviour::irregular)
    return claimed + "; more levels are needed.";
  if (assessment.verdict == Verdict::disagrees && assessment.mismatch == Mismatch::higher_order)
    return claimed +
           "; it converges faster than that: the claim is too low, or errors cancel here.";
  return claimed + ".";
}

long long run_count(const record::Subject& subject) {
  long long runs = 0;
  for (const auto& level : subject.levels) runs += static_cast<long long>(level.runs.size());
  return runs;
}

}  // namespace

std::string assessment_text(const record::Subject& subject) {
  const auto& assessment = subject.assessment;
  const auto& fit = assessment.displacement;
  std::string text;
  for (const auto& evidence : assessment.evidence)
    if (remark(subject, evidence).empty() && !is_shown_cause(subject, evidence.code))
      add(text, evidence_sentence(subject, evidence));
  const bool is_method = subject.kind == record::SubjectKind::method;
  const bool has_claim = subject.claim.is_made();
  const bool in_evidence = fit.reason == Code("printed-digits").name() && !text.empty();
  // One history without a claim has no levels to compare.
  if ((is_method || has_claim || run_count(subject) > 1) && !in_evidence)
    add(text, behaviour_sentence(subject));
  const auto* failed = first_failure(subject);
  if (failed != nullptr && fit.reason == Code("run-failed").name())
    add(text, fmt::format("First failure, {}: {}", resolution_text(subject, failed->score.step),
                          failed->score.failure));
  for (const auto& evidence : assessment.evidence)
    if (!is_shown_cause(subject, evidence.code)) add(text, remark(subject, evidence));
  add(text, hint_text(subject));
  add(text, refinement_text(subject));
  add(text, claim_sentence(subject));
  return text;
}

std::optional<Finding> finding(const record::Subject& subject) {
  if (!subject.refusal.empty()) return Finding{subject.refusal, subject.refusal_code};
  if (!subject.complete)
    return Finding{"Interrupted before the last level; only the finished levels are assessed.",
                   std::string(Code("interrupted").name())};
  const auto& assessment = subject.assessment;
  const auto& fit = assessment.displacement;
  const bool as_claimed = assessment.verdict == Verdict::agrees && fit.reason.empty() &&
                          (fit.behaviour == Behaviour::proper || fit.behaviour == Behaviour::exact);
  if (subject.kind != record::SubjectKind::method)
    return Finding{assessment_text(subject), assessment.reason};
  if (as_claimed) return {};
  auto code = assessment.reason;
  if (code.empty()) code = fit.reason.empty() ? to_string(fit.behaviour) : fit.reason;
  return Finding{assessment_text(subject), code};
}

std::optional<Finding> false_convergence(const record::Subject& subject) {
  if (!subject.self_convergence) return {};
  const auto& result = *subject.self_convergence;
  const auto& comparison = result.against_reference;
  if (!comparison.false_convergence) return {};
  const auto& errors = result.errors;
  if (comparison.reason == Code("wrong-limit").name())
    return Finding{
        fmt::format("False convergence: the runs converge to a limit {} away from the "
                    "reference solution.",
                    short_number(errors.errors.empty() ? errors.floor : errors.errors.back(), 2)),
        comparison.reason};
  if (result.self.proper && comparison.error_ratio > judge::trust_factor)
    return Finding{fmt::format("False convergence: the error is {} times the estimate from the "
                               "differences between runs.",
                               short_number(comparison.error_ratio, 2)),
                   comparison.reason};
  return Finding{"False convergence: the differences between runs shrink, the errors do not.",
                 comparison.reason};
}

std::string self_convergence_text(const record::SelfResult& result) {
  auto text = fmt::format("Differences between runs: {}. Errors of the same runs: {}.",
                          fit_text(result.self.differences), fit_text(result.errors));
  if (result.against_reference.false_convergence) return text;
  if (result.self.proper)
    add(text, fmt::format("The estimate is reliable: error / estimate = {}.",
                          short_number(result.against_reference.error_ratio, 2)));
  else
    add(text, "The differences give no error bound.");
  return text;
}

}  // namespace clackers::report
