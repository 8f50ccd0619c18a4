// What the C++ programs share: reads the problem's lines name=values, lays its masses out as balls of
// radius 0.5 m on lines along x, writes the history.
//     PROGRAM PROBLEM.txt H HISTORY.csv [NAME=VALUE ...]
#pragma once

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using Row = std::vector<double>;

struct Ball {
  double mass, x, y, v;
};

struct Door {
  std::map<std::string, Row> problem;
  std::map<std::string, std::string> settings;
  std::string out;
  std::size_t masses, contacts;
  double start, end, given, restitution;  // given: the step or the tolerance of the command
  Row place, line;
  std::vector<Ball> balls, walls;

  Door(int count, char** words) {
    if (count < 4) throw std::runtime_error("usage: PROBLEM.txt H HISTORY.csv [NAME=VALUE ...]");
    std::ifstream in(words[1]);
    for (std::string text; std::getline(in, text);) {
      const auto at = text.find('=');
      std::istringstream values(text.substr(at + 1));
      for (double x; values >> x;) problem[text.substr(0, at)].push_back(x);
    }
    given = std::atof(words[2]);
    out = words[3];
    for (int i = 4; i < count; ++i) {
      const std::string word = words[i];
      settings[word.substr(0, word.find('='))] = word.substr(word.find('=') + 1);
    }
    masses = std::size_t(problem["dof"][0]), contacts = std::size_t(problem["contacts"][0]);
    start = problem["t"][0], end = problem["end"][0];
    restitution = row("restitution", 1)[0];
    lay_out();
  }
  bool has(const std::string& name) const { return settings.count(name) > 0; }
  double number(const std::string& name, double otherwise) const {
    return has(name) ? std::atof(settings.at(name).c_str()) : otherwise;
  }
  const Row& row(const std::string& name, std::size_t i) {
    return problem[name + std::to_string(i)];
  }
  /// Of the spring and the damper between mass i and the ground; springs between masses are refused.
  double stiffness(std::size_t i) { return of_ground("K", i); }
  double damping(std::size_t i) { return of_ground("C", i); }
  /// -K u - C v of mass i.
  double force(std::size_t i, const Row& u, const Row& v) {
    double sum = 0.0;
    for (std::size_t j = 0; j < masses; ++j)
      sum -= row("K", i + 1)[j] * u[j] + row("C", i + 1)[j] * v[j];
    return sum;
  }
  double gap(std::size_t k, const double* u) {
    double sum = -row("gap", k)[0];
    for (std::size_t i = 0; i < masses; ++i) sum += row("direction", k)[i] * u[i];
    return sum;
  }

  /// position(i), velocity(i), step(forces) of a world that takes constant steps.
  template <class World>
  int run(World&& world, double h, long n) {
    std::ofstream file(out);
    file.precision(17);
    file << 't';
    for (const char* name : {"u", "v"})
      for (std::size_t i = 1; i <= masses; ++i) file << ',' << name << i;
    const auto before = std::clock();
    Row u(masses), v(masses), forces(masses);
    for (long k = 0;; ++k) {
      file << '\n' << (k == n ? end : start + double(k) * h);
      for (std::size_t i = 0; i < masses; ++i) file << ',' << (u[i] = world.position(i) - place[i]);
      for (std::size_t i = 0; i < masses; ++i) file << ',' << (v[i] = world.velocity(i));
      if (k == n) break;
      for (std::size_t i = 0; i < masses; ++i)
        forces[i] = settings["springs"] == "own" ? 0.0 : force(i, u, v);
      world.step(forces);
    }
    file << "\n# seconds " << double(std::clock() - before) / CLOCKS_PER_SEC << " steps " << n
         << '\n';
    return file.flush() ? 0 : 1;
  }
  long steps() const { return std::lround((end - start) / given); }
  double step() const { return (end - start) / double(steps()); }

 private:
  double of_ground(const char* name, std::size_t i) {
    const auto& values = row(name, i + 1);
    for (std::size_t j = 0; j < masses; ++j)
      if (j != i && values[j] != 0.0)
        throw std::runtime_error("this setting takes springs between a mass and the ground only");
    return values[i];
  }
  void follow(std::size_t i, std::vector<bool>& laid) {
    for (std::size_t k = 1; k <= contacts; ++k)
      for (std::size_t j = 0; j < masses; ++j) {
        const auto& direction = row("direction", k);
        if (laid[j] || direction[i] == 0.0 || direction[j] == 0.0) continue;
        laid[j] = true;
        place[j] = place[i] + direction[j] * (1.0 - row("gap", k)[0]);
        line[j] = line[i];
        follow(j, laid);
      }
  }
  void lay_out() {
    place.resize(masses), line.resize(masses);
    std::vector<bool> laid(masses);
    for (std::size_t i = 0; i < masses; ++i) {
      if (!laid[i]) laid[i] = true, line[i] = 10.0 * double(i), follow(i, laid);
      balls.push_back({row("M", i + 1)[i], place[i] + problem["u"][i], line[i], problem["v"][i]});
    }
    for (std::size_t k = 1; k <= contacts; ++k) {
      std::vector<std::size_t> joined;
      for (std::size_t i = 0; i < masses; ++i)
        if (row("direction", k)[i] != 0.0) joined.push_back(i);
      const auto i = joined[0];
      if (joined.size() > 2 || std::abs(row("direction", k)[i]) != 1.0)
        throw std::runtime_error(
            "this program takes contacts between two masses or a mass and a wall");
      if (joined.size() == 1)
        walls.push_back(
            {0.0, place[i] + row("direction", k)[i] * (row("gap", k)[0] - 1.0), line[i], 0.0});
    }
  }
};
