#include "clackers/study/check/check_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/assess/errors/error_sink.hpp"

namespace clackers::study {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t block_rows = 4096;

bool all_finite(const std::vector<double>& values, std::size_t size) {
  return values.size() == size &&
         std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
}

class Feeder {
 public:
  Feeder(const model::Trajectory& history, const std::vector<bool>& has_u,
         const model::Motion& reference, assess::ErrorSink& sink)
      : h_(history),
        has_u_(has_u),
        whole_(!history.v.empty() && std::ranges::find(has_u, false) == has_u.end()),
        dof_(std::size_t(history.dof)),
        reference_(reference),
        envelope_(reference.envelope(0.0).u),
        sink_(sink) {}

  void run() {
    std::size_t from = 0;
    const auto list = reports();
    auto next = list.begin();
    for (std::size_t i = 0; i < h_.t.size(); ++i) {
      const bool jump = !h_.v.empty() && i + 1 < h_.t.size() && h_.t[i] == h_.t[i + 1];
      if (next == list.end() && !jump) continue;
      // An impact comes after the own times before it.
      for (; next != list.end() && (*next)->t <= h_.t[i]; ++next) {
        rows(from, i);
        from = i;
        if (!jump || (*next)->t < h_.t[i]) take(**next);
      }
      if (!jump) continue;
      rows(from, i);
      from = limits(i);
    }
    rows(from, h_.t.size());
  }

  /// The largest displacement errors at jumps: absolute [m] and relative to the envelope.
  double u_absolute() const { return u_absolute_; }
  double u_relative() const { return u_relative_; }

 private:
  // Impacts that say what the velocities were, within the rows.
  std::vector<const model::Impact*> reports() const {
    std::vector<const model::Impact*> list;
    if (!h_.impacts || h_.v.empty()) return list;
    for (const auto& impact : *h_.impacts)
      if (impact.t >= h_.t.front() && impact.t <= h_.t.back() &&
          all_finite(impact.v_before, dof_) && all_finite(impact.v_after, dof_))
        list.push_back(&impact);
    return list;
  }

  void take(const model::Impact& impact) {
    sink_.take(model::ReportedImpact{impact.t, impact.contact, impact.u, impact.v_before,
                                     impact.v_after, impact.impulse});
  }

  // Rows i and i + 1 as the limits of a jump. They are no states beside it: where the true impact is
  // a little later, the right limit would count as an error up to the next row. Returns the next row
  // that is a state.
  std::size_t limits(std::size_t i) {
    const auto row = [&](const std::vector<double>& x, std::size_t k) {
      return std::span(x).subspan(k * dof_, dof_);
    };
    sink_.take(
        model::ReportedImpact{h_.t[i], 0, row(h_.u, i), row(h_.v, i), row(h_.v, i + 1), unknown});
    const bool at_an_end = i == 0 || i + 2 == h_.t.size();
    if (at_an_end) return i + 1;
    const auto now = reference_.at(std::min(h_.t[i], reference_.end()), model::Side::right);
    for (const std::size_t k : {i, i + 1})
      for (std::size_t j = 0; j < dof_; ++j) {
        if (!has_u_[j]) continue;
        const double error = std::abs(h_.u[k * dof_ + j] - now.u[Eigen::Index(j)]);
        u_absolute_ = std::max(u_absolute_, error);
        u_relative_ = std::max(u_relative_, error / envelope_[Eigen::Index(j)]);
      }
    return i + 2;
  }

  void rows(std::size_t from, std::size_t to) {
    for (; from < to; from += block_rows) {
      const auto count = std::min(block_rows, to - from);
      const auto t = std::span(h_.t).subspan(from, count);
      const auto part = [&](const std::vector<double>& x) {
        return std::span(x).subspan(from * dof_, count * dof_);
      };
      if (whole_) {
        sink_.take(model::SampleBlock{h_.dof, t, part(h_.u), part(h_.v)});
        continue;
      }
      fill(t);
      if (!h_.v.empty()) std::ranges::copy(part(h_.v), v_.begin());
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < dof_; ++j)
          if (has_u_[j]) u_[i * dof_ + j] = h_.u[(from + i) * dof_ + j];
      sink_.take(model::SampleBlock{h_.dof, t, u_, v_});
    }
  }

  // The reference stands in for what is not known, so that it adds no error.
  void fill(std::span<const double> t) {
    u_.resize(t.size() * dof_);
    v_.resize(t.size() * dof_);
    times_.assign(t.begin(), t.end());
    for (double& time : times_) time = std::min(time, reference_.end());
    reference_.sample(times_, model::Side::right, {u_, v_, {}});
  }

  const model::Trajectory& h_;
  const std::vector<bool>& has_u_;
  bool whole_;
  std::size_t dof_;
  const model::Motion& reference_;
  Eigen::VectorXd envelope_;
  double u_absolute_ = 0.0, u_relative_ = 0.0;
  assess::ErrorSink& sink_;
  std::vector<double> times_, u_, v_;
};

}  // namespace

assess::RunScore score_history(const model::Trajectory& history, const std::vector<bool>& has_u,
                               double step, const model::Motion& reference,
                               const model::ImpactProblem<>& problem) {
  assess::ErrorSink sink(reference, problem, step, {.impacts_are_reported = false});
  Feeder feeder(history, has_u, reference, sink);
  feeder.run();
  auto score = sink.score({});
  score.u_error = std::max(score.u_error, feeder.u_relative());
  score.u_error_absolute = std::max(score.u_error_absolute, feeder.u_absolute());
  if (history.v.empty()) score.v_error = unknown;
  if (history.v.empty() || std::ranges::find(has_u, false) != has_u.end())
    score.energy_error = score.energy_ratio = unknown;
  score.work.steps = 0;
  return score;
}

}  // namespace clackers::study
