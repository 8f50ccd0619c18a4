#include <algorithm>
#include <cmath>

#include "clackers/diagnose/ladder/ladder_families.hpp"
#include "clackers/diagnose/ladder/located_causes.hpp"
#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::diagnose {
namespace {

// A share of the acceleration that steps lack or keep, one and the same in most of them.
std::optional<Diagnosis> one_share(const std::vector<double>& shares, std::size_t enough,
                                   const char* where, std::size_t files) {
  constexpr double least_share = 0.2, most_share = 1.1, same = 0.15;
  if (files < 2 || shares.size() < enough) return {};
  const double share = measure::median(shares);
  const auto alike =
      std::ranges::count_if(shares, [&](double x) { return std::abs(x - share) < same * share; });
  if (share < least_share || share > most_share || 4 * alike < 3 * std::ssize(shares)) return {};
  auto found = diagnosis_of(Code("acceleration-not-renewed"), share, "1");
  found.confidence = 0.95;
  found.text = where;
  found.evidence = {{"files", double(files)}};
  return found;
}

}  // namespace

std::optional<Diagnosis> not_renewed(const std::vector<LocatedImpacts>& files) {
  std::vector<double> shares;
  for (const auto& file : files)
    for (const auto& impact : file.impacts)
      if (std::isfinite(impact.stale_share)) shares.push_back(impact.stale_share);
  return one_share(shares, 6, "after impacts", files.size());
}

std::optional<Diagnosis> not_started(const DiagnosisInput& question) {
  // Velocities of half steps lack as much of it in every step, rows of half steps a part of the
  // displacement as well.
  constexpr double least_step = 1e-5, largest_rest = 0.1, largest_way = 0.6;
  const measure::FreeMotion motion(question.problem.system);
  const auto& start = question.problem.start;
  std::vector<double> shares;
  for (const auto& seen : question.histories) {
    const auto& rows = seen.opening.v.empty() ? seen.sample : seen.opening;
    if (rows.v.empty() || rows.t.size() < 3) continue;
    const double s = rows.t[1] - start.t;
    if (!(s > 0.0) || s > 1.5 * seen.facts.step || rows.t[0] != start.t) continue;
    if (rows.impacts && !rows.impacts->empty() && rows.impacts->front().t < rows.t[2]) continue;
    const auto one = measure::row_state(rows, 1), two = measure::row_state(rows, 2);
    const auto first = motion.moved(start, s), second = motion.moved(one, two.t - one.t);
    const Eigen::VectorXd gained = first.v - start.v, lack = first.v - one.v;
    if (gained.norm() < least_step * first.v.norm()) continue;
    const double rest = (second.v - two.v).norm() + (second.u - two.u).norm() / (two.t - one.t);
    const bool is_of_start = rest < largest_rest * lack.norm() &&
                             (first.u - one.u).norm() < largest_way * s * gained.norm();
    shares.push_back(is_of_start ? lack.dot(gained) / gained.squaredNorm() : 0.0);
  }
  return one_share(shares, 2, "at the start", shares.size());
}

}  // namespace clackers::diagnose
