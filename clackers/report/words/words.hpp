#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/record/record.hpp"
#include "clackers/record/require.hpp"
#include "clackers/study/baseline.hpp"

// Every sentence of a report, made of the codes and numbers of a record.
namespace clackers::report {

/// A sentence and the code that `clackers explain` knows; the code may be empty.
struct Finding {
  std::string sentence, code;
};
/// "Sentence. [code]".
std::string text_of(const Finding& finding);

/// "1 method", "7 methods", "2 histories".
std::string counted(long long count, std::string_view noun);

/// "2.00 ±0.01", never less than 0.01; empty where there is no line.
std::string order_text(const judge::LadderFit& fit, std::string_view space = " ");
/// "proper, order 2.00 ±0.01", "stagnating at 3.1e-3 [contact-stiffness]".
std::string fit_text(const judge::LadderFit& fit);
/// "proper, order 2", "stagnating [contact-stiffness]", "nothing".
std::string claim_text(const Claim& claim);

/// "three-parameter (N = 2, xi1 = 0.05, a_t = 1 m)"; `space` stands around "=" and before units.
std::string case_text(const record::CaseSummary& problem, std::string_view space = " ");
/// "20 s with 6 impacts; fast period 1.258 s".
std::string length_text(const record::CaseSummary& problem);
/// "8 levels of 8 steps, h = 0.05 s to 0.00039 s, 13 to 1625 steps per fast period", of adaptive
/// methods "8 levels, tolerance 0.001 to 1e-10"; empty for histories.
std::string plan_text(const record::CaseRecord& problem);

/// What was measured of a subject, what decided the verdict, and how it compares with the claim.
std::string assessment_text(const record::Subject& subject);
/// The histories to add so that more can be said, with their steps: of one or a few levels the
/// finer ones, of one step a level those between. Empty for methods and programs, whose steps verify chooses, and where enough are there.
std::string hint_text(const record::Subject& subject);
/// Finer levels that a study added on its own, and what kept it from more; empty for none.
std::string refinement_text(const record::Subject& subject);
/// What a reader must know of a subject beside its numbers; nothing for a method that is as it
/// claims to be.
std::optional<Finding> finding(const record::Subject& subject);
/// Where the differences between runs show convergence and the errors do not.
std::optional<Finding> false_convergence(const record::Subject& subject);
/// What the differences between runs show, beside what the errors of the same runs show.
std::string self_convergence_text(const record::SelfResult& result);

/// A cause with its value, its uncertainty, how much closer to the history it comes, and the cure:
/// "Restitution looks like 0.9900 ±0.0001 instead of 1 (9e7 times closer): check
/// the impact law and its coefficient."
Finding diagnosis_text(const diagnose::Diagnosis& cause);
/// The cause that a headline names: the strongest; nullptr where there is none or failed runs decide.
const diagnose::Diagnosis* deciding_cause(const record::Subject& subject);
/// Of the strongest causes of a subject, `most_shown_diagnoses` at most.
std::vector<Finding> diagnosis_texts(const record::Subject& subject);
inline constexpr std::size_t most_shown_diagnoses = 3;

/// The notes on the histories of a subject, one for each code; the finest history stands for
/// others with the same.
std::vector<std::string> note_texts(const record::Subject& subject);
std::string note_text(const Note& note);

/// Of a program, for each kind of failure, three at most, how many runs failed, the first of them, and
/// what it printed last; then how many runs are those of an earlier call. Empty for other subjects.
std::vector<std::string> failure_texts(const record::Subject& subject);
/// The end of what a program printed on one line, lines separated by " / "; 400 characters at most.
std::string printed_text(std::string_view printed);

/// What errors are relative to, in every caption of errors in u, v and energy.
inline constexpr auto error_scale_text = "relative to the largest envelope and energy";

/// The first line of a report: the verdict and what decided it. `cause` and `finding` say which text
/// of the only subject it holds already.
struct OpeningLine {
  std::string text;  ///< "Agrees: converges with order 4.00 ±0.01, as claimed."
  bool has_cause = false, has_finding = false;
};
OpeningLine opening_line(const record::Record& record);

/// The last line of a report.
struct VerdictLine {
  std::string word;           ///< "agrees", "disagrees", "undecided", "not claimed", "interrupted"
  std::string counts;         ///< "Of 8 methods: 5 agree, 1 disagrees."; empty for one subject
  std::string next;           ///< the command to type next
  std::string next_in_words;  ///< the same where a long command does not fit
};
VerdictLine verdict_line(const record::Record& record);

/// "Required: order:2. Not met by 1 of 7: moreau-jean (order 0.99)."; of subjects that do not meet it.
std::string requirement_text(const record::Record& record, const record::Requirement& requirement,
                             const std::vector<record::Unmet>& unmet);

/// "Against the baseline of 2025-11-21T09:43:00Z (clackers 0.1.0): 2 of 7 methods changed."
std::string change_summary(const study::BaselineComparison& changes);
/// What changed of a subject, a sentence each.
std::vector<std::string> change_texts(const study::SubjectChange& change);

/// "h = 0.01 s", or "tolerance 1e-5" of a solver that is given one.
std::string resolution_text(const record::Subject& subject, double step, int digits = 3);
/// Of several solvers of others: which of them leaves the exact motion first, and which stays how
/// close. Empty where none leaves it.
std::string departure_text(const record::CaseRecord& problem);
/// Whether a cause of that code is among those shown, so that nothing else need say it.
bool is_shown_cause(const record::Subject& subject, std::string_view code);

/// A path without its folder.
std::string short_path(std::string_view path);
/// What a sentence calls the history of a run: its file, or the solver and the step or tolerance.
std::string history_name(const record::Subject& subject, const record::Run& run);

}  // namespace clackers::report
