#include <algorithm>
#include <cmath>

#include "clackers/diagnose/file/file_sample.hpp"
#include "clackers/diagnose/file/reading.hpp"

namespace clackers::diagnose {
namespace {

// v of a file against the reference at t + delay.
struct Delay {
  double steps = 0.0;  ///< of the velocities, fitted
  double gain = 0.0;   ///< of a whole half step of that sign over none
};

// Rows of the first flight, row 0 left out: in it no error has grown yet, and no velocity jumps.
model::Trajectory early_rows(const FileSample& file) {
  constexpr double part = 0.9;
  constexpr std::size_t most = 200;
  const auto& opening = file.history().opening;
  const auto& motion = file.motion();
  // Two time scales of the fastest mass, but a few rows.
  double end = std::max(2.0 * file.scale().u.cwiseQuotient(file.scale().v).minCoeff(),
                        8.0 * file.history().facts.spacing);
  if (motion.impact_count(motion.end()) > 0) end = std::min(end, part * motion.impact(1).t);
  std::size_t count = 0;
  while (count < opening.t.size() && opening.t[count] <= end) ++count;
  const auto stride = std::max<std::size_t>(1, count / most);
  const auto masses = std::ptrdiff_t(opening.dof);
  model::Trajectory rows;
  rows.dof = opening.dof;
  for (std::size_t row = 1; row < count; row += stride) {
    const auto at = std::ptrdiff_t(row) * masses;
    rows.t.push_back(opening.t[row]);
    rows.u.insert(rows.u.end(), opening.u.begin() + at, opening.u.begin() + at + masses);
    rows.v.insert(rows.v.end(), opening.v.begin() + at, opening.v.begin() + at + masses);
  }
  return rows;
}

// Velocities of half a step away lie a h/2 off from the first row on. They are told from a method
// whose velocities err by O(h) by three facts: with this delay they fit far better, the fitted delay
// is half a step, and displacements fit no better with it. Velocities of the semi-implicit Euler
// method, which start from the true one, keep the distance a(0) h/2 under the delay: a gain of about
// 1.
constexpr double least_velocity_gain = 8.0, sure_gain = 30.0, delay_tolerance = 0.05;

std::optional<Delay> delay_of(const FileSample& file) {
  constexpr std::size_t least_rows = 6;
  const double h = file.history().facts.step;
  if (!file.has_v() || !(h > 0.0)) return {};
  const auto rows = early_rows(file);
  if (rows.t.size() < least_rows) return {};
  const auto fits = [&](double steps) {
    auto times = rows.t;
    for (double& t : times) t += steps * h;
    return file.distance_between(rows, reference_rows(file.motion(), times));
  };
  const auto plain = fits(0.0);
  Delay delay{0.5, 0.0};
  auto best = fits(0.5);
  if (const auto early = fits(-0.5); early.v < best.v) {
    delay.steps = -0.5;
    best = early;
  }
  if (!(plain.u < best.u)) return {};
  // A parabola through the squares at 0.8, 1 and 1.2 of it has its least value at the true delay.
  const double sign = delay.steps, d = 0.2;
  const double a = std::pow(fits((1.0 - d) * sign).v, 2), b = std::pow(best.v, 2),
               c = std::pow(fits((1.0 + d) * sign).v, 2);
  const double bend = a - 2.0 * b + c;
  if (!(bend > 0.0)) return {};
  delay.steps = sign * (1.0 + d * 0.5 * (a - c) / bend);
  delay.gain = plain.v / std::max(best.v, 1e-300);
  if (!(delay.gain > least_velocity_gain) || std::abs(delay.steps - sign) > delay_tolerance)
    return {};
  return delay;
}

std::optional<Diagnosis> at_half_steps(const std::vector<FileSample>& files, bool by_tolerance) {
  if (by_tolerance) return {};
  std::optional<Delay> best;
  double count = 0.0;
  for (const auto& file : files) {
    const auto delay = delay_of(file);
    if (!delay) continue;
    if (best && std::signbit(best->steps) != std::signbit(delay->steps)) return {};
    ++count;
    if (!best || delay->gain > best->gain) best = delay;
  }
  // One file needs the larger gain; several of one sign confirm each other.
  if (!best || (count < 2.0 && best->gain < sure_gain)) return {};
  Diagnosis cause;
  cause.code = "velocity-at-half-steps";
  cause.value = best->steps > 0.0 ? 0.5 : -0.5;
  cause.unit = "steps";
  cause.confidence = best->gain > sure_gain ? 0.95 : 0.8;
  cause.evidence = {{"gain", best->gain},
                    {"uncertainty", std::abs(best->steps - cause.value)},
                    {"files", count},
                    {"step", files.front().history().facts.step}};
  return cause;
}

// u and v both on lines, that of v by more than half an order lower.
std::optional<Diagnosis> of_lower_order(const DiagnosisInput& question) {
  constexpr double least_difference = 0.6, whole = 0.25;
  const auto& u = question.displacement;
  const auto& v = question.velocity;
  const auto has_order = [](const judge::LadderFit& fit) {
    return fit.has_line && !fit.on_envelope &&
           (fit.behaviour == Behaviour::proper || fit.behaviour == Behaviour::reduced);
  };
  const bool is_exact = u.behaviour == Behaviour::exact;
  if (!has_order(v) || question.by_tolerance || !(is_exact || has_order(u))) return {};
  const double difference = u.order - v.order;
  if (!is_exact && !(difference > least_difference + u.spread + v.spread)) return {};
  if (std::abs(v.order - std::round(v.order)) > whole + v.spread) return {};
  Diagnosis cause;
  cause.code = "velocity-order-lower";
  cause.value = v.order;
  cause.confidence = 0.85;
  cause.evidence = {{"order", v.order}, {"uncertainty", v.spread}};
  if (!is_exact) cause.evidence.push_back({"expected", u.order});
  return cause;
}

// v that stays away from the true one, by the same in files of other steps, where u comes near it.
std::optional<Diagnosis> of_no_order(const std::vector<FileSample>& files) {
  constexpr double visible = 1e-4, small_part = 0.05, other_step = 1.9, same = 0.2;
  std::vector<const FileSample*> near;
  for (const auto& file : files) {
    const auto& off = file.distance();
    if (file.has_v() && off.v > visible && off.u < small_part * off.v) near.push_back(&file);
  }
  if (near.empty() || near.front() != &files.front()) return {};
  const auto &finest = files.front(), &coarsest = *near.back();
  const double v = finest.distance().v;
  if (!(coarsest.history().facts.step > other_step * finest.history().facts.step) ||
      std::abs(coarsest.distance().v / v - 1.0) > same)
    return {};
  auto cause = diagnosis_of(Code("velocities-differ"), NAN, "");
  cause.confidence = 0.95;
  cause.evidence = {{"files", double(near.size())}};
  const auto& rows = finest.rows();
  const double factor =
      factor_of(rows.v, reference_rows(finest.motion(), rows.t, finest.has_v()).v);
  auto scaled = Reading::plain(2 * std::size_t(rows.dof));
  std::fill(scaled.factor.begin() + rows.dof, scaled.factor.end(), factor);
  if (finest.distance_of(read_as(scaled, rows)).v < same * v) {
    cause.value = factor;
    cause.unit = "1";
  }
  return cause;
}

}  // namespace

std::vector<Diagnosis> velocity_causes(const std::vector<FileSample>& files,
                                       const DiagnosisInput& question) {
  if (auto cause = at_half_steps(files, question.by_tolerance)) return {*cause};
  if (auto cause = of_lower_order(question)) return {*cause};
  if (auto cause = of_no_order(files)) return {*cause};
  return {};
}

}  // namespace clackers::diagnose
