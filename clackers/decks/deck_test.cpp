#include "clackers/decks/deck.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/decks/models/network.hpp"
#include "clackers/decks/text.hpp"

namespace clackers::decks {
namespace {

Subject subject_of(const std::string& name, const Settings& settings = {}) {
  auto chosen = cases::make(name, settings);
  return {chosen.problem, {name}, "clackers export " + name, chosen.motion};
}

// Those that write a model.
std::vector<Format> written() {
  std::vector<Format> all(formats().begin(), formats().end());
  std::erase_if(all, [](const Format& format) { return format.write == nullptr; });
  return all;
}

// The names of formats that take a case.
std::vector<std::string> takers(const Subject& subject) {
  std::vector<std::string> names;
  for (const auto& format : formats()) try {
      if (!deck(format, subject).empty()) names.push_back(format.name);
    } catch (const InputError& error) {
      EXPECT_EQ(error.code(), Code("no-deck")) << format.name << error.what();
    }
  return names;
}

bool takes(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

TEST(Decks, ThePairGoesIntoEveryFormat) {
  EXPECT_EQ(takers(subject_of("three-parameter")).size(), written().size());
}

TEST(Decks, RunEndsWithTheCheckOfTheCase) {
  for (const auto& format : written()) {
    const auto files = deck(format, subject_of("stop"));
    const auto run = std::ranges::find(files, "run", &DeckFile::name);
    ASSERT_NE(run, files.end()) << format.name;
    EXPECT_TRUE(run->is_program);
    const auto last = run->text.substr(run->text.rfind('\n', run->text.size() - 2) + 1);
    EXPECT_TRUE(last.starts_with("\"${CLACKERS:-clackers}\" check stop ")) << last;
    EXPECT_NE(last.find("--expect "), last.npos) << last;
  }
}

TEST(Decks, FilesAreNamedAndFilled) {
  const auto names = file_names();
  for (const auto& format : written())
    for (const auto& file : deck(format, subject_of("three-parameter"))) {
      EXPECT_TRUE(std::ranges::find(names, file.name) != names.end()) << file.name;
      EXPECT_EQ(file.text.back(), '\n') << format.name << ' ' << file.name;
      for (const auto* mark : {"@head@", "@data@", "@name@", "@values@"})
        EXPECT_EQ(file.text.find(mark), std::string::npos) << format.name << ' ' << mark;
    }
}

TEST(Decks, SaysThatItWasNotRun) {
  for (const auto& format : written()) {
    const auto text = deck(format, subject_of("three-parameter")).front().text;
    EXPECT_NE(text.find("clackers export three-parameter"), text.npos) << format.name;
    EXPECT_EQ(text.find("Not run: ") != text.npos, format.needs.empty()) << format.name;
  }
}

TEST(Decks, NumbersReadBackToTheSameDouble) {
  const auto text = deck(format_of("scipy"), subject_of("three-parameter")).front().text;
  EXPECT_NE(text.find("0.3333333333333333]"), text.npos);
  EXPECT_NE(text.find("contacts = numpy.reshape([1, -1, 0, 1], (-1, 4))"), text.npos);
}

TEST(Decks, AProblemFileGoesWithTheDeck) {
  auto subject = subject_of("piecewise");
  subject.check.clear();
  const auto files = deck(format_of("scipy"), subject);
  EXPECT_EQ(files.back().name, "problem.json");
  EXPECT_NE(files[1].text.find("--problem problem.json"), std::string::npos);
}

TEST(Decks, WhatAFormatLacksIsRefused) {
  const auto scripts = takers(subject_of("assembly"));
  EXPECT_TRUE(takes(scripts, "scipy"));
  EXPECT_FALSE(takes(scripts, "mujoco"));
  const auto springs = takers(subject_of("penalized-pair"));
  EXPECT_TRUE(takes(springs, "calculix"));
  EXPECT_FALSE(takes(springs, "mujoco"));
  const auto loads = takers(subject_of("forced-pair"));  // eta = 0.8
  EXPECT_TRUE(takes(loads, "mujoco"));
  EXPECT_FALSE(takes(loads, "abaqus"));
  EXPECT_TRUE(takes(takers(subject_of("base-excited-pair")), "abaqus"));
  EXPECT_REFUSED(deck(format_of("mujoco"), subject_of("assembly")), "no-deck", "mass matrix",
                 "mujoco");
  EXPECT_REFUSED(format_of("scypi"), "unknown-name", "scipy");
}

TEST(Decks, AMethodGoesIntoUnitsOnly) {
  auto subject = subject_of("buildings");
  subject.method = "rk3+event-driven";
  const auto files = deck(format_of("fmu3"), subject);
  const auto& model = files.front().text;
  EXPECT_NE(model.find("enum { method_rows = 4 };"), model.npos);
  EXPECT_NE(model.find("-1, 2, 0,\n"), model.npos);
  EXPECT_REFUSED(deck(format_of("scipy"), subject), "no-deck", "--to fmu2", "scipy");
  subject.method = "newmark";
  EXPECT_REFUSED(deck(format_of("fmu2"), subject), "no-deck", "Runge-Kutta", "newmark");
  subject.method = "rk5";
  EXPECT_REFUSED(deck(format_of("fmu2"), subject), "unknown-name", "rk5");
}

TEST(Decks, AFormatWithoutInitialVelocitiesIsRefused) {
  EXPECT_REFUSED(deck(format_of("sdf"), subject_of("stop")), "no-deck", "velocities", "sdf");
}

TEST(Network, LinksAreTheMatrices) {
  const auto subject = subject_of("buildings");
  const auto network = network_of(subject, "test", {.restitution = true});
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(5, 5), c = k;
  for (const auto& link : network.links) {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(5);
    b[link.mass] = 1.0;
    if (link.other != ground) b[link.other] = -1.0;
    k += link.stiffness * b * b.transpose();
    c += link.damping * b * b.transpose();
  }
  EXPECT_LT((k - subject.problem.system.stiffness).norm(), 1e-14 * k.norm());
  EXPECT_LT((c - subject.problem.system.damping).norm(), 1e-14 * c.norm());
}

TEST(Network, AContactLastsItsTime) {
  const auto network = network_of(subject_of("stop"), "test", {});
  // A sixteenth of the period for each period of the run, a 64th at least; half a period of one mass is
  // pi sqrt(m / k), the stiffness in three digits.
  const double period = 2.0 * 3.14159265;
  const auto lasting = [](double end) {
    return network_of(subject_of("stop", {{"t_end", end}}), "test", {}).contact_time;
  };
  EXPECT_NEAR(lasting(7.0), period * period / 16.0 / 7.0, 1e-6);
  EXPECT_NEAR(network.contact_time, period * period / 16.0 / 20.0, 1e-6);
  EXPECT_NEAR(lasting(200.0), period / 64.0, 1e-6);
  EXPECT_NEAR(3.14159265 / std::sqrt(network.contacts[0].stiffness), network.contact_time,
              1e-2 * network.contact_time);
}

TEST(Ladder, HalvesTheStep) {
  const auto levels = steps(subject_of("stop").problem, 0.03, 3);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[0].name, "N667");
  EXPECT_EQ(levels[2].name, "N2668");
  EXPECT_DOUBLE_EQ(levels[2].value * 2668, 20.0);
}

}  // namespace
}  // namespace clackers::decks
