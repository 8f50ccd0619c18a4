#include "clackers/decks/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/error.hpp"
#include "clackers/base/number.hpp"
#include "clackers/base/text.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::decks {

std::string filled(std::string_view text, Words words) {
  std::string result(text);
  for (const auto& [name, value] : words) {
    const auto key = fmt::format("@{}@", name);
    for (auto at = result.find(key); at != result.npos; at = result.find(key, at + value.size()))
      result.replace(at, key.size(), value);
  }
  return result;
}

void refuse_deck(std::string_view format, const std::string& why) {
  throw InputError(fmt::format("export --to {}: {}.", format, why), "no-deck");
}

std::string head(const Subject& subject, std::string_view format, std::string_view comment) {
  const auto& row = format_of(format);
  auto text = fmt::format("{} Written by: {}\n", comment, printable(subject.command));
  if (row.needs.empty())
    text += fmt::format("{} Not run: {} was not at hand when this format was written.\n", comment,
                        row.program);
  return text + fmt::format("{0} For {1}. SI units: kg, m, s, N.\n{0} Contact: {2}.\n", comment,
                            row.program, row.contact);
}

std::vector<Level> tolerances() {
  std::vector<Level> levels;
  for (int k = 4; k <= 10; ++k)
    levels.push_back({fmt::format("rtol1e-{:02}", k), *finite_number(fmt::format("1e-{}", k))});
  return levels;
}

std::vector<Level> steps(const model::ImpactProblem<>& problem, double coarsest, int levels) {
  const double span = problem.end - problem.start.t;
  auto count = static_cast<long long>(std::ceil(span / coarsest));
  std::vector<Level> ladder;
  for (int level = 0; level < levels; ++level, count *= 2)
    ladder.push_back({fmt::format("N{}", count), span / double(count)});
  return ladder;
}

double shortest_period(const model::ImpactProblem<>& problem) {
  const auto& system = problem.system;
  const auto squares = numerics::eigenvalues(numerics::solved(system.mass, system.stiffness));
  const double highest = squares.real().maxCoeff();
  const double span = problem.end - problem.start.t;
  return highest > 0.0 ? std::min(span, 2.0 * std::numbers::pi / std::sqrt(highest)) : span;
}

DeckFile run_script(const Subject& subject, const std::vector<Level>& levels,
                    std::string_view solve, std::string_view ending, std::string_view options,
                    std::string_view prepare) {
  std::string text =
      "#!/bin/sh\n# Runs the model at each level, then judges the motions. CLACKERS: the command, where it is not "
      "on the PATH.\nset -eu\ncd \"$(dirname \"$0\")\"\n@needs@\n";
  if (!prepare.empty()) text += fmt::format("{}\n", prepare);
  text += fmt::format("solve() {{  # level, value\n  {}\n}}\n", solve);
  std::string files;
  for (const auto& level : levels) {
    text += fmt::format("solve {} {}\n", level.name, exact_number(level.value));
    files += fmt::format(" {}{}", level.name, ending);
  }
  const auto words =
      subject.check.empty() ? std::vector<std::string>{"--problem", "problem.json"} : subject.check;
  const auto* first = subject.check.empty() ? "" : " ";
  // A case stands first, --problem behind the files.
  text +=
      "\"${CLACKERS:-clackers}\" check" +
      (subject.check.empty() ? files + " " + shell_line(words) : first + shell_line(words) + files);
  return {"run", text + fmt::format(" {}\n", options), true};
}

}  // namespace clackers::decks
