#include <fmt/format.h>

#include <algorithm>

#include "clackers/base/text.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

constexpr std::size_t most_failures = 3, most_printed = 400;

struct Failures {
  const record::Run* first;
  int count = 0;
};

}  // namespace

std::string printed_text(std::string_view printed) {
  printed.remove_prefix(printed.size() - std::min(printed.size(), most_printed));
  std::string text;
  for (const char c : printed)
    if (c != '\n')
      text += c;
    else if (!text.empty() && !text.ends_with(" / "))
      text += " / ";
  if (text.ends_with(" / ")) text.resize(text.size() - 3);
  return printable(text);
}

std::vector<std::string> failure_texts(const record::Subject& subject) {
  if (subject.kind == record::SubjectKind::method) return {};
  std::vector<Failures> kinds;
  int runs = 0, reused = 0;
  for (const auto& level : subject.levels)
    for (const auto& run : level.runs) {
      ++runs;
      reused += run.file && std::ranges::count(run.file->notes, "reused", &Note::code) > 0 ? 1 : 0;
      if (run.score.finished) continue;
      const auto same = std::ranges::find_if(kinds, [&](const Failures& kind) {
        return kind.first->score.failure_code == run.score.failure_code;
      });
      auto& kind = same == kinds.end() ? kinds.emplace_back(Failures{&run}) : *same;
      ++kind.count;
    }
  if (kinds.size() > most_failures) kinds.resize(most_failures);
  std::vector<std::string> texts;
  for (const auto& [first, count] : kinds) {
    const auto& score = first->score;
    auto sentence = printable(score.failure);
    if (!sentence.ends_with('.')) sentence += '.';
    auto text = fmt::format("{} of {} runs failed, {} {}: {} [{}]", count, runs,
                            count > 1 ? "the first at" : "at", resolution_text(subject, score.step),
                            sentence, score.failure_code);
    if (const auto printed = printed_text(first->printed); !printed.empty())
      text += fmt::format(
          " {}: {}", subject.kind == record::SubjectKind::callable ? "Traceback" : "It printed",
          printed);
    texts.push_back(std::move(text));
  }
  if (reused > 0)
    texts.push_back(fmt::format("{} of {} runs are those of an earlier call; --fresh repeats them.",
                                reused, runs));
  return texts;
}

}  // namespace clackers::report
