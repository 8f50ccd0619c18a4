#include "clackers/assess/convergence/ladder_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "clackers/assess/convergence/irregular.hpp"
#include "clackers/assess/convergence/rate_trend.hpp"
#include "clackers/assess/convergence/window.hpp"
#include "clackers/base/codes.hpp"

namespace clackers::assess {
namespace {

/// One pass over one ladder. `finest` is its last level, `clear` the last one well above the
/// rounding floor, `first` the start of the usable levels that lead there without a gap, `tracked`
/// the first of them whose largest error is smaller than the motion itself.
class Fitter {
 public:
  Fitter(std::span<const ErrorLevel> ladder, const FitContext& context)
      : context_(context), levels_(view(ladder)), finest_(int(levels_.size()) - 1) {
    smallest_step_ = std::numeric_limits<double>::infinity();
    for (const auto& level : ladder)
      for (const auto& point : level) smallest_step_ = std::min(smallest_step_, point.step);
    for (const auto& level : levels_) {
      fit_.steps.push_back(level.step);
      fit_.errors.push_back(level.error);
    }
  }

  LadderFit run() {
    decide();
    return fit_;
  }

 private:
  const LevelView& level(int i) const { return levels_[std::size_t(i)]; }

  void decide() {
    if (levels_.empty()) return undecided("too-few-levels");
    const bool compliant = context_.contact_time > 0.0;
    if (compliant && smallest_step_ * steps_per_contact > context_.contact_time)
      return undecided("contact-not-resolved");
    if (!level(finest_).usable) return finest_failed();
    find_range();
    if (clear_ < 0) return at_floor_throughout();
    if (proper(clear_) || floor_too_near()) return;
    if (straight() || plateau() || rough() || growth() || outliers() || swinging()) return;
    if (bent_by_rounding()) return;
    if (rising()) return undecided("no-fixed-order");
    undecided(last_rates_fit_claim() ? Code("too-few-levels") : Code("no-convergence-yet"));
  }

  void find_range() {
    first_ = finest_;
    while (first_ > 0 && level(first_ - 1).usable) --first_;
    tracked_ = first_;
    while (tracked_ < finest_ && level(tracked_).error >= context_.saturation) ++tracked_;
    above_ = finest_;
    while (above_ >= first_ && level(above_).at_floor) --above_;
    clear_ = above_;
    while (clear_ >= first_ && level(clear_).near_floor) --clear_;
    if (above_ < first_) clear_ = -1;
    for (int i = above_ + 1; i <= finest_; ++i) fit_.floor = std::max(fit_.floor, level(i).error);
  }

  void at_floor_throughout() {
    if (first_ > 0) return undecided("run-failed");
    behave(Behaviour::exact);
  }

  // The finest runs did not come to an end: growth if the errors before them grew as well.
  void finest_failed() {
    int last = finest_;
    while (last >= 0 && !level(last).usable) --last;
    const auto tail = last >= 2 ? window(levels_, last - 2, last) : std::nullopt;
    const auto grows = [](double rate) { return rate < -straight_rates; };
    if (tail && std::ranges::all_of(tail->rates, grows))
      return behave(Behaviour::divergent, "error-growth");
    undecided("run-failed");
  }

  // The claimed line, as far towards the rounding floor as it goes, but to level `least` at least.
  bool proper(int least) {
    if (!(context_.claimed_order > 0.0)) return false;
    const Straightness asked{.rates = 0.1 * context_.claimed_order,
                             .around_slope = false,
                             .centre = context_.claimed_order};
    for (int last = finest_; last >= std::max(least, first_); --last)
      if (const auto found = longest_straight(levels_, first_, last, asked)) {
        line(*found);
        behave(Behaviour::proper);
        return true;
      }
    return false;
  }

  // Where nothing else explains them, up to two levels in front of the floor may be bent by it: that
  // many lie between the two slacks when an error of order one meets a rounding that grows.
  bool bent_by_rounding() {
    int least = clear_;
    while (least > clear_ - 2 && least > first_ && level(least).may_bend) --least;
    return above_ < finest_ && least < clear_ && proper(least);
  }

  bool floor_too_near() {
    if (clear_ - first_ + 1 >= shortest_window) return false;
    undecided("too-few-levels");
    return true;
  }

  // Any other line that reaches the finest levels.
  bool straight() {
    const auto found = longest_straight(levels_, first_, clear_, {});
    if (!found) return false;
    const double slope = found->line.slope, claimed = context_.claimed_order;
    if (std::abs(slope) <= straight_rates) {
      stagnate(*found);
      return true;
    }
    if (slope > 0.0 && may_still_reach(claimed, *found)) {
      // Rates may also stray because the points scatter, still within what a line allows.
      if (rough() || bent_by_rounding()) return true;
      undecided(last_rates_fit_claim() ? Code("too-few-levels") : Code("no-convergence-yet"));
      return true;
    }
    line(*found);
    if (slope < 0.0)
      behave(Behaviour::divergent, "error-growth");
    else
      behave(claimed > 0.0 && slope < claimed ? Behaviour::reduced : Behaviour::proper);
    return true;
  }

  bool plateau() {
    const auto tail = window(levels_, clear_ - shortest_plateau + 1, clear_);
    const Straightness flat{.rates = straight_rates, .around_slope = false, .centre = 0.0};
    if (!tail || !is_straight(*tail, flat)) return false;
    stagnate(*tail);
    return true;
  }

  bool rough() {
    if (clear_ - tracked_ + 1 < shortest_window || !zigzags(levels_, tracked_, clear_))
      return false;
    envelope_decides();
    return true;
  }

  // A line but for a few raw points far above it: too wide for a line.
  bool outliers() {
    if (!longest_straight(levels_, first_, clear_, {.outliers_of = luck_share})) return false;
    envelope_decides();
    return true;
  }

  // Stairs, and errors that oscillate over whole levels, converge without a line.
  bool swinging() {
    if (clear_ - tracked_ + 1 < shortest_window || !swings(levels_, tracked_, clear_)) return false;
    envelope_decides();
    return true;
  }

  bool rising() const {
    const auto tail = window(levels_, clear_ - shortest_window + 1, clear_);
    return tail && rates_rise(context_.claimed_order, *tail);
  }

  void envelope_decides() {
    const auto upper = envelope(levels_, tracked_, clear_);
    if (!upper) return undecided("too-few-levels");
    const double slope = upper->line.slope, spread = upper->line.slope_spread;
    // Rough and flat at the end: all raw points of the last levels together know the trend best.
    const auto tail = window(levels_, clear_ - shortest_window + 1, clear_);
    if (tail && tail->line.slope + tail->line.slope_spread < highest_flat_slope &&
        tail->line.slope - tail->line.slope_spread > lowest_flat_slope)
      return stagnate(*tail);
    if (slope > straight_rates && slope > spread) {
      fit_.has_line = fit_.on_envelope = true;
      fit_.order = slope;
      fit_.spread = spread;
      fit_.scatter = upper->scatter;
      fit_.constant = std::exp(upper->line.intercept);
      fit_.first_level = upper->first;
      fit_.last_level = upper->last;
      return behave(Behaviour::irregular);
    }
    if (slope < -straight_rates && slope < -spread)
      return behave(Behaviour::divergent, "error-growth");
    undecided("no-convergence-yet");
  }

  // Growth that is no line. Errors that rise to a plateau settle; these do not.
  bool growth() {
    const auto tail = window(levels_, clear_ - shortest_window + 1, clear_);
    if (!tail) return false;
    const auto grows = [](double rate) { return rate < -straight_rates; };
    if (!std::ranges::all_of(tail->rates, grows)) return false;
    if (tail->rates.back() > settling_share * tail->rates.front()) return false;
    behave(Behaviour::divergent, "error-growth");
    return true;
  }

  bool last_rates_fit_claim() const {
    const double claimed = context_.claimed_order;
    const auto tail = window(levels_, clear_ - 1, clear_);
    return tail && claimed > 0.0 &&
           is_straight(*tail, {.rates = 0.1 * claimed, .around_slope = false, .centre = claimed});
  }

  void stagnate(const Window& flat) {
    const auto& errors = level(flat.last).y;
    const double at =
        std::exp(std::accumulate(errors.begin(), errors.end(), 0.0) / double(errors.size()));
    const bool compliant = context_.contact_time > 0.0;
    if (!compliant && at >= context_.saturation) return undecided("no-convergence-yet");
    fit_.floor = at;
    fit_.scatter = flat.scatter;
    fit_.first_level = flat.first;
    fit_.last_level = flat.last;
    behave(Behaviour::stagnating, compliant                   ? Code("contact-stiffness").name()
                                  : context_.states_tolerance ? Code("tolerance-floor").name()
                                                              : Code("unexplained-floor").name());
  }

  void line(const Window& found) {
    fit_.has_line = true;
    fit_.order = found.line.slope;
    fit_.spread = std::max(found.line.slope_spread, drift(found));
    fit_.scatter = found.scatter;
    fit_.constant = std::exp(found.line.intercept);
    fit_.first_level = found.first;
    fit_.last_level = found.last;
  }

  void undecided(Code reason) { behave(Behaviour::undecided, reason.name()); }
  void behave(Behaviour behaviour, std::string_view reason = {}) {
    fit_.behaviour = behaviour;
    fit_.reason = reason;
  }

  FitContext context_;
  std::vector<LevelView> levels_;
  int finest_ = -1, first_ = 0, tracked_ = 0, above_ = -1, clear_ = -1;
  double smallest_step_ = 0.0;
  LadderFit fit_;
};

}  // namespace

LadderFit fit_ladder(std::span<const ErrorLevel> ladder, const FitContext& context) {
  return Fitter(ladder, context).run();
}

}  // namespace clackers::assess
