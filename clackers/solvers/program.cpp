#include "clackers/solvers/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/number.hpp"
#include "clackers/solvers/program_runner.hpp"

namespace clackers::solvers {
namespace {

double tolerance_in(std::string_view whole, std::string_view text) {
  const double value = finite_number(text).value_or(0.0);
  if (!(value > 0.0 && value <= 1.0))
    refuse("verify", "--tolerances", whole,
           "1e-3:1e-12, one a decade, or a list 1e-3,1e-5, above 0 and at most 1", {},
           "bad-syntax");
  return value;
}

}  // namespace

std::vector<SolverSubject> subjects_of(const ProgramRequest& request) {
  require_positive("verify", "timeout", request.timeout);
  const auto tolerances = tolerances_of(request);
  const auto folder = std::make_shared<WorkFolder>(request.work);
  std::vector<SolverSubject> subjects;
  for (const auto& program : request.programs) {
    CommandTemplate command(program.command);
    auto& subject = subjects.emplace_back();
    subject.kind = record::SubjectKind::program;
    subject.name = program.name.empty() ? command.name() : program.name;
    subject.claim = request.expect.value_or(Claim{});
    subject.labels = program.labels;
    if (command.by_tolerance()) subject.tolerances = tolerances;
    subject.prepare = ProgramRunner::maker(command, subject.name, request, folder);
  }
  return subjects;
}

std::vector<double> tolerances_of(const ProcessOptions& options) {
  return options.tolerances.empty() ? tolerances_from(default_tolerances) : options.tolerances;
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

}  // namespace clackers::solvers
