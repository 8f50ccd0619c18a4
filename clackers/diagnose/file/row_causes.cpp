#include <algorithm>
#include <cmath>

#include "clackers/diagnose/file/file_sample.hpp"
#include "clackers/diagnose/file/interpolation.hpp"
#include "clackers/diagnose/file/reading.hpp"
#include "clackers/diagnose/file/start/first_row.hpp"

namespace clackers::diagnose {
namespace {

std::optional<Diagnosis> ends_early(const std::vector<FileSample>& files, bool by_tolerance) {
  const auto missing = [&](const FileSample& file) {
    const auto& facts = file.history().facts;
    const double row = by_tolerance ? facts.spacing : std::max(facts.spacing, facts.step);
    return file.motion().end() - file.history().last > 1.5 * row;
  };
  if (!missing(files.front())) return {};
  const auto& finest = files.front();
  Diagnosis cause;
  cause.code = "ends-early";
  cause.value = finest.history().last;
  cause.unit = "s";
  cause.confidence = 0.95;
  cause.evidence = {{"expected", finest.motion().end()},
                    {"share", finest.history().last / finest.motion().end()},
                    {"files", double(std::ranges::count_if(files, missing))}};
  return cause;
}

// Whether the history is far better at the nodes than between them, so that interpolation makes its
// error. With few rows between nodes none is near enough to one.
bool better_at_nodes(const FileSample& file, const Interpolation& found) {
  constexpr double least_parts = 8.0, least_ratio = 2.0;
  const auto& opening = file.history().opening;
  if (found.spacing < least_parts * file.history().facts.spacing) return true;
  const auto reference = reference_rows(file.motion(), opening.t, false);
  const auto masses = std::size_t(opening.dof);
  const auto error = [&](std::size_t row) {
    const auto at = row * masses + std::size_t(found.mass);
    return std::abs(opening.u[at] - reference.u[at]);
  };
  std::vector<double> at_nodes, between;
  for (std::size_t i = 0; i + 1 < found.nodes.size(); ++i) {
    at_nodes.push_back(error(found.nodes[i]));
    between.push_back(error((found.nodes[i] + found.nodes[i + 1]) / 2));
  }
  std::ranges::sort(at_nodes);
  std::ranges::sort(between);
  const auto middle = at_nodes.size() / 2;
  return between[middle] > least_ratio * at_nodes[middle];
}

// Rows between the nodes of a straight or cubic interpolation, where its error is at least that of
// half of the rows. The interpolants of an adaptive solver are as good as its tolerance: there the
// finest history decides.
std::optional<Diagnosis> resampled(const std::vector<FileSample>& files, bool by_tolerance) {
  std::optional<Diagnosis> first;
  double count = 0.0;
  for (const auto& file : files) {
    if (by_tolerance && &file != &files.front()) break;
    const auto nodes = interpolation_of(file.history(), file.scale());
    if (!nodes || !(nodes->error > file.median_error()) || !better_at_nodes(file, *nodes)) continue;
    ++count;
    if (first) continue;
    first.emplace();
    first->code = "output-resampled";
    first->value = file.history().facts.spacing;
    first->unit = "s";
    first->text = nodes->degree == 1 ? "linear" : "cubic";
    first->confidence = 0.9;
    first->evidence = {{"step", nodes->spacing}, {"floor", nodes->error}};
  }
  if (first) first->evidence.push_back({"files", count});
  return first;
}

// A start with v = 0 that was accepted, since the velocities of the case are small.
std::optional<Diagnosis> starts_at_rest(const FileSample& file, const DiagnosisInput& question) {
  const auto& history = file.history();
  if (history.opening.v.empty() || history.first != 0.0) return {};
  constexpr double visible = 1e-9, agreeing = 0.3;
  const auto masses = std::size_t(history.opening.dof);
  const auto start = file.motion().at(0.0, model::Side::right);
  double largest = 0.0, expected = 0.0;
  for (std::size_t mass = 0; mass < masses; ++mass) {
    const auto at = Eigen::Index(mass);
    if (history.opening.v[mass] != 0.0) return {};
    if (std::abs(start.v[at]) > std::abs(expected)) expected = start.v[at];
    largest = std::max(largest, std::abs(start.v[at]) / file.scale().v[at]);
  }
  if (!(largest > visible + 2.0 * history.facts.floor)) return {};
  FirstRows opening;
  opening.rows = history.opening;
  opening.has_u.assign(masses, true);
  const FirstRow row(opening, question.problem, question.motion);
  const double own = row.own_flight_distance(), other = row.flight_distance(question.motion);
  if (!(own < agreeing * other)) return {};
  Diagnosis cause;
  cause.code = "starts-at-rest";
  cause.value = 0.0;
  cause.unit = "m/s";
  cause.confidence = 0.9;
  cause.evidence = {{"gain", other / std::max(own, 1e-300)}, {"expected", expected}};
  return cause;
}

}  // namespace

std::vector<Diagnosis> row_causes(const std::vector<FileSample>& files,
                                  const DiagnosisInput& question) {
  std::vector<Diagnosis> all;
  if (auto cause = ends_early(files, question.by_tolerance)) all.push_back(*cause);
  if (auto cause = starts_at_rest(files.front(), question)) all.push_back(*cause);
  if (auto cause = resampled(files, question.by_tolerance)) all.push_back(*cause);
  return all;
}

}  // namespace clackers::diagnose
