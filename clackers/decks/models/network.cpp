#include "clackers/decks/models/network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "clackers/base/number.hpp"
#include "clackers/model/problem_file.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::decks {
namespace {

using Eigen::Index;

std::optional<Stop> stop_of(const model::Contact<>& contact) {
  Stop stop{ground, ground, contact.gap, contact.restitution, 0.0};
  for (int i = 0; i < int(contact.direction.size()); ++i) {
    const double b = contact.direction[i];
    if (b == 0.0) continue;
    auto& end = b > 0.0 ? stop.upper : stop.lower;
    if (std::abs(b) != 1.0 || end != ground) return {};
    end = i;
  }
  return stop;
}

class Builder {
 public:
  Builder(const Subject& subject, std::string_view format, Abilities abilities)
      : problem_(subject.problem), format_(format), abilities_(abilities) {}

  Network build() {
    model::problem_json(problem_);  // refuses what is no numbers
    take_masses();
    take_links();
    // Delays add up: the longer the run, the shorter the contacts.
    const double period = shortest_period(problem_);
    const double periods = (problem_.end - problem_.start.t) / period;
    network_.contact_time = period / std::min(16.0 * periods, 64.0);
    for (const auto& contact : problem_.contacts) take(contact, network_.contacts);
    if (const auto* found = model::one_sided_springs(problem_)) {
      if (!abilities_.springs)
        refuse_deck(format_, "it has no spring that acts in compression only");
      for (std::size_t i = 0; i < found->contacts().size(); ++i) {
        take(found->contacts()[i], network_.springs);
        network_.springs.back().stiffness = found->stiffnesses()[i];
      }
    }
    if (const auto* found = problem_.system.add_load.target<model::HarmonicLoad>())
      network_.loads = found->forces();
    if (!network_.loads.empty() && !abilities_.loads)
      refuse_deck(format_, "it has no load that is a cosine of time");
    return network_;
  }

 private:
  void take_masses() {
    const auto& m = problem_.system.mass;
    if (!m.isDiagonal(0.0))
      refuse_deck(
          format_,
          "its masses are not coupled, but the mass matrix of this problem is not diagonal");
    network_.masses.assign(m.diagonal().begin(), m.diagonal().end());
  }
  void add_link(int i, int j, double stiffness, double damping) {
    if (stiffness != 0.0 || damping != 0.0) network_.links.push_back({i, j, stiffness, damping});
  }
  void take_links() {
    const auto &k = problem_.system.stiffness, &c = problem_.system.damping;
    const auto n = int(problem_.dof());
    // Springs to the ground are what the row sums leave; below the rounding of a sum there is none.
    const auto sum_of = [](const Eigen::MatrixXd& matrix, int i) {
      const double sum = matrix.row(i).sum(), size = matrix.row(i).cwiseAbs().sum();
      return std::abs(sum) < 1e-14 * size ? 0.0 : sum;
    };
    for (int i = 0; i < n; ++i) {
      add_link(i, ground, sum_of(k, i), sum_of(c, i));
      for (int j = i + 1; j < n; ++j) add_link(i, j, -k(i, j), -c(i, j));
    }
    for (const auto& link : network_.links)
      if (link.stiffness < 0.0 || link.damping < 0.0)
        refuse_deck(
            format_,
            fmt::format("between mass {} and {} this problem has a negative spring or damper",
                        link.mass + 1,
                        link.other == ground ? std::string("the ground")
                                             : fmt::format("mass {}", link.other + 1)));
  }
  void take(const model::Contact<>& contact, std::vector<Stop>& stops) {
    auto stop = stop_of(contact);
    if (!stop)
      refuse_deck(format_,
                  fmt::format("contact {} is not between two masses, or a mass and the ground",
                              stops.size() + 1));
    if (&stops == &network_.contacts && contact.restitution != 1.0 && !abilities_.restitution)
      refuse_deck(format_,
                  fmt::format("contact {} has restitution {}, but its contact returns all energy",
                              stops.size() + 1, contact.restitution));
    const double softness =
        contact.direction.dot(numerics::solved(problem_.system.mass, contact.direction).col(0));
    stop->stiffness = rounded(std::pow(std::numbers::pi / network_.contact_time, 2) / softness, 3);
    stops.push_back(*stop);
  }

  const model::ImpactProblem<>& problem_;
  std::string_view format_;
  Abilities abilities_;
  Network network_;
};

}  // namespace

std::vector<Stop> Network::one_sided() const {
  auto all = contacts;
  all.insert(all.end(), springs.begin(), springs.end());
  return all;
}

Network network_of(const Subject& subject, std::string_view format, Abilities abilities) {
  return Builder(subject, format, abilities).build();
}

std::vector<Level> compliant_steps(const Network& network, const model::ImpactProblem<>& problem) {
  if (network.contacts.empty()) return steps(problem, shortest_period(problem) / 16.0, 5);
  return steps(problem, network.contact_time / 8.0, 4);
}

std::string_view compliant_claim(const Network& network, std::string_view smooth) {
  return network.contacts.empty() ? smooth : "--expect stagnating:contact-stiffness";
}

std::string stiffness_note(const Network& network) {
  if (network.contacts.empty()) return "There is no rigid contact.";
  return fmt::format(
      "A rigid contact is a spring whose contacts last {} s: the motions converge to that of the spring.",
      short_number(network.contact_time));
}

}  // namespace clackers::decks
