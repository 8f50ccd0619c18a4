#include "clackers/solvers/plugin/plugin_output.hpp"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <initializer_list>
#include <utility>
#include <vector>

#include "clackers/base/error.hpp"

namespace clackers::solvers {
namespace {

PluginOutput& ours(clackers_solver_host* host) { return *static_cast<PluginOutput*>(host); }

// "u1", "u2", ...
void add_names(std::vector<std::string>& names, const char* quantity, int dof,
               const char* suffix = "") {
  for (int i = 1; i <= dof; ++i) names.push_back(fmt::format("{}{}{}", quantity, i, suffix));
}

[[noreturn]] void misused(const char* who, std::string_view what) {
  throw InputError(fmt::format("host->{}: {}", who, what), "plugin-failed");
}

}  // namespace

PluginOutput::PluginOutput(int dof, const std::filesystem::path& history,
                           const std::filesystem::path& events, std::size_t most_bytes)
    : clackers_solver_host{},
      dof_(dof),
      most_bytes_(most_bytes),
      history_(history),
      events_(events) {
  version = CLACKERS_SOLVER_VERSION;
  state = [](clackers_solver_host* host, double t, const double* u, const double* v,
             const double* a) {
    return ours(host).guarded([&] { ours(host).take_state(t, u, v, a); });
  };
  collision = [](clackers_solver_host* host, double t, double impulse, const double* before,
                 const double* after) {
    return ours(host).guarded([&] { ours(host).take_collision(t, impulse, before, after); });
  };
  fail = [](clackers_solver_host* host, const char* reason) {
    return ours(host).guarded([&] {
      ours(host).set_failure("plugin-failed", reason == nullptr ? "no reason is given" : reason);
    });
  };
}

// Nothing is thrown into the library, which need not be C++.
template <class Take>
std::int32_t PluginOutput::guarded(const Take& take) {
  if (code_.empty()) try {
      take();
    } catch (const Error& error) {
      code_ = error.code().name();
      failure_ = error.what();
    } catch (const std::exception& error) {
      set_failure("plugin-failed", error.what());
    }
  return code_.empty() ? 0 : 1;
}

void PluginOutput::set_failure(Code code, std::string sentence) {
  if (!code_.empty()) return;
  code_ = code.name();
  failure_ = std::move(sentence);
}

void PluginOutput::require_time(const char* who, double t, double last) {
  if (!std::isfinite(t))
    throw InputError(fmt::format("host->{}: t = {}; allowed: finite times.", who, t), "not-finite");
  if (t < last)
    throw InputError(
        fmt::format("host->{}: t = {} after t = {}; allowed: times that do not descend.", who, t,
                    last),
        "not-sorted");
}

void PluginOutput::require_same(const char* who, const char* what, bool is_given, bool was_given) {
  if (is_given != was_given)
    misused(who, fmt::format("{} is {}given, and was {}at first; allowed: in all calls of a run or "
                             "in none.",
                             what, is_given ? "" : "not ", was_given ? "" : "not "));
}

void PluginOutput::add_values(NumberFile& file, const char* who, const char* name, double t,
                              const double* values) {
  for (int i = 0; i < dof_; ++i)
    if (!std::isfinite(values[i]))
      throw InputError(fmt::format("host->{}: {}[{}] = {} at t = {}; allowed: finite numbers.", who,
                                   name, i, values[i], t),
                       "not-finite");
  file.add(values, dof_);
}

void PluginOutput::end_row(NumberFile& file, const char* who) {
  file.end_row();
  if (file.size() > most_bytes_)
    throw InputError(fmt::format("host->{}: more than {} bytes", who, most_bytes_),
                     "program-output");
}

void PluginOutput::take_state(double t, const double* u, const double* v, const double* a) {
  if (!accepts_) misused("state", "called outside run; allowed: from run only.");
  if (u == nullptr) misused("state", "u = null; allowed: an array of dof numbers.");
  if (!states_) {
    states_ = {t, t, v != nullptr, a != nullptr};
    std::vector<std::string> names{"t"};
    add_names(names, "u", dof_);
    if (v != nullptr) add_names(names, "v", dof_);
    if (a != nullptr) add_names(names, "a", dof_);
    history_.set_names(std::move(names));
  }
  require_time("state", t, states_->last_t);
  require_same("state", "v", v != nullptr, states_->has_v);
  require_same("state", "a", a != nullptr, states_->has_a);
  at_last_t_ = t == states_->last_t ? at_last_t_ + 1 : 1;
  if (at_last_t_ > 2)
    throw InputError(
        fmt::format("host->state: a third state at t = {}; allowed: one, or those before and after "
                    "a jump.",
                    t),
        "three-limits");
  states_->last_t = t;
  history_.add(t);
  add_values(history_, "state", "u", t, u);
  if (v != nullptr) add_values(history_, "state", "v", t, v);
  if (a != nullptr) add_values(history_, "state", "a", t, a);
  end_row(history_, "state");
}

void PluginOutput::take_collision(double t, double impulse, const double* before,
                                  const double* after) {
  constexpr auto who = "collision";
  if (!accepts_) misused(who, "called outside run; allowed: from run only.");
  if ((before == nullptr) != (after == nullptr))
    misused(who, "one of v_before and v_after is null; allowed: both or none.");
  const bool has_impulse = !std::isnan(impulse);
  if (!collisions_) {
    collisions_ = {t, t, before != nullptr, false, has_impulse};
    std::vector<std::string> names{"t"};
    if (has_impulse) names.emplace_back("impulse");
    if (before != nullptr) add_names(names, "v", dof_, "-");
    if (before != nullptr) add_names(names, "v", dof_, "+");
    events_.set_names(std::move(names));
  }
  require_time(who, t, collisions_->last_t);
  require_same(who, "v_before", before != nullptr, collisions_->has_v);
  require_same(who, "impulse", has_impulse, collisions_->has_impulse);
  if (std::isinf(impulse))
    throw InputError(fmt::format("host->collision: impulse = {}; allowed: a finite number, or NAN "
                                 "where it is not known.",
                                 impulse),
                     "not-finite");
  collisions_->last_t = t;
  events_.add(t);
  if (has_impulse) events_.add(impulse);
  if (before != nullptr) add_values(events_, who, "v_before", t, before);
  if (after != nullptr) add_values(events_, who, "v_after", t, after);
  end_row(events_, who);
}

void PluginOutput::commit() {
  if (!states_)
    return set_failure("program-output",
                       "no state; allowed: states from start to end, by "
                       "host->state");
  if (!(states_->first_t < states_->last_t))
    return set_failure(
        "too-short",
        fmt::format("states at t = {} only; allowed: states from start to end", states_->last_t));
  if (collisions_) events_.commit();
  history_.commit();
}

}  // namespace clackers::solvers
