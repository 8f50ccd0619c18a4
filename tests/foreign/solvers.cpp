// Foreign solvers, right and wrong. Each line of standard input is one history:
//
//     FILE n=1000 method=newmark contact=exact eta=0.9 ...
//
// README.md lists the words. The file holds the rows as text.

#include <charconv>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>

#include "adaptive.hpp"
#include "time_stepping.hpp"

namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

/// Rows on a common grid, interpolated between the solver's own steps.
std::vector<State> resampled(const History& history, const Options& o) {
  const auto& nodes = o.text("nodes", "steps") == "events" ? history.nodes : history.rows;
  const bool cubic = o.text("resample-by", "linear") == "cubic";
  const double dt = o.number("resample", 0.001);
  std::vector<State> rows;
  std::size_t i = 0;
  const long last = std::lround(nodes.back().t / dt);
  for (long k = 0; k <= last; ++k) {
    const double t = static_cast<double>(k) * dt;
    while (i + 2 < nodes.size() && nodes[i + 1].t <= t) ++i;
    const State &x = nodes[i], &y = nodes[i + 1];
    const double h = y.t - x.t, tau = t - x.t;
    State row;
    row.t = t;
    if (cubic) {
      row.u = hermite(x.u, x.v, y.u, y.v, h, tau);
      row.v = hermite(x.v, x.a, y.v, y.a, h, tau);
    } else {
      row.u = x.u + tau / h * (y.u - x.u);
      row.v = x.v + tau / h * (y.v - x.v);
    }
    rows.push_back(row);
  }
  return rows;
}

/// A number in [-1, 1) from a counter; the same on every machine.
double noise(unsigned long long i) {
  i = (i + 0x9e3779b97f4a7c15ULL) * 0xbf58476d1ce4e5b9ULL;
  i = (i ^ (i >> 27)) * 0x94d049bb133111ebULL;
  i ^= i >> 31;
  return static_cast<double>(i >> 11) * 0x1p-52 - 1.0;
}

/// The faults of what is printed: times, units, signs, velocities, noise.
void spoil(std::vector<State>& rows, const System& s, const Options& o, double h) {
  if (o.has("half-velocities"))
    for (std::size_t i = o.has("start-right") ? 1 : 0; i < rows.size(); ++i)
      rows[i].v = rows[i].v + 0.5 * h * o.number("half-velocities", 1.0) * rows[i].a;
  if (o.has("nan-above") && h > o.number("nan-above", 0.0))
    for (std::size_t i = rows.size() / 2; i < rows.size(); ++i)
      rows[i].u = rows[i].v = {std::nan(""), std::nan("")};
  if (o.has("difference-velocities"))
    for (std::size_t i = rows.size() - 1; i > 0; --i)
      rows[i].v = (1.0 / (rows[i].t - rows[i - 1].t)) * (rows[i].u - rows[i - 1].u);
  const double all = o.number("unit", 1.0), u = all * o.number("u-unit", 1.0),
               v = all * o.number("v-unit", 1.0);
  const std::string flip = o.text("flip", "");
  const double first = flip == "all" || flip == "1" ? -1.0 : 1.0,
               second = flip == "all" || flip == "2" ? -1.0 : 1.0;
  const double amplitude = o.number("noise", 0.0);
  unsigned long long count = static_cast<unsigned long long>(rows.size()) << 32;
  float sum = 0.0F;
  const double late = o.number("late-seconds", 0.0) + h * o.number("late-steps", 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    State& x = rows[i];
    for (double* p : {&x.u.x, &x.u.y}) *p = *p * u + amplitude * noise(++count);
    for (double* p : {&x.v.x, &x.v.y}) *p = *p * v + amplitude * noise(++count);
    x.u.x *= first;
    x.v.x *= first;
    x.u.y *= second;
    x.v.y *= second;
    if (o.text("exchange", "") == "all" || (o.text("exchange", "") == "after-start" && i > 0)) {
      std::swap(x.u.x, x.u.y);
      std::swap(x.v.x, x.v.y);
    }
    if (o.has("float-time")) {
      x.t = sum;
      sum += static_cast<float>(h);
    }
    if (!(o.has("start-on-time") && i == 0)) x.t = (x.t + late) * o.number("time-unit", 1.0);
    if (o.has("single-output"))
      for (double* p : {&x.u.x, &x.u.y, &x.v.x, &x.v.y, &x.a.x, &x.a.y})
        *p = static_cast<float>(*p);
  }
  const double end = o.number("until", 1.0) * s.end * o.number("time-unit", 1.0) * (1.0 + 1e-12);
  while (rows.size() > 1 && rows.back().t > end) rows.pop_back();
}

double value(const State& x, const std::string& column) {
  if (column == "t") return x.t;
  if (column == "u1") return x.u.x;
  if (column == "v1") return x.v.x;
  if (column == "a1") return x.a.x;
  if (column == "u2") return x.u.y;
  if (column == "v2") return x.v.y;
  if (column == "a2") return x.a.y;
  if (column == "g") return x.u.x - x.u.y;
  throw std::runtime_error("no column " + column);
}

void append(std::string& text, double number, const Options& o, bool time) {
  char buffer[64];
  const int digits =
      static_cast<int>(o.number(time ? "t-digits" : "digits", o.number("digits", 0.0)));
  if (digits > 0) {
    const int size = o.has("fixed") ? std::snprintf(buffer, sizeof buffer, "%.*f", digits, number)
                                    : std::snprintf(buffer, sizeof buffer, "%.*g", digits, number);
    text.append(buffer, static_cast<std::size_t>(size));
    return;
  }
  const bool single = time ? o.has("single-time") || o.has("float-time") : o.has("single-output");
  const auto done = single
                        ? std::to_chars(buffer, buffer + sizeof buffer, static_cast<float>(number))
                        : std::to_chars(buffer, buffer + sizeof buffer, number);
  text.append(buffer, done.ptr);
}

void write(const std::string& path, const std::vector<State>& rows, const System& s,
           const Options& o) {
  const auto names = split(o.text("columns", s.masses == 1 ? "t,u1,v1" : "t,u1,v1,u2,v2"));
  const auto data =
      split(o.text("data", o.text("columns", s.masses == 1 ? "t,u1,v1" : "t,u1,v1,u2,v2")));
  const std::map<std::string, std::string> signs{
      {"comma", ","}, {"semicolon", ";"}, {"tab", "\t"}, {"blank", "  "}};
  const std::string between = signs.at(o.text("separator", "comma"));
  const long every = std::lround(o.number("every", 1.0));
  std::string text;
  const std::string header = o.text("header", "names");
  if (header != "none") {
    if (header == "comment") text += "# solver output\n# ";
    for (std::size_t i = 0; i < names.size(); ++i) text += (i ? between : "") + names[i];
    text += '\n';
  }
  for (std::size_t i = 0; i < rows.size(); i += static_cast<std::size_t>(every)) {
    for (std::size_t j = 0; j < data.size(); ++j) {
      if (j) text += between;
      append(text, value(rows[i], data[j]), o, data[j] == "t");
    }
    text += '\n';
  }
  std::ofstream(path, std::ios::binary) << text;
}

/// Collisions as the solver reports them.
void write_events(const std::string& path, const History& history) {
  std::ofstream out(path);
  out.precision(17);
  out << "t\n";
  for (const auto& x : history.impacts) out << x.t << '\n';
}

void solve_line(const std::string& line) {
  std::istringstream words(line);
  std::string path, word;
  words >> path;
  Options o;
  while (words >> word) {
    const auto cut = word.find('=');
    o.values[word.substr(0, cut)] = cut == std::string::npos ? "1" : word.substr(cut + 1);
  }
  const System s = make_system(o);
  const long n = std::lround(o.number("n", 1000.0));
  const double h = s.end / static_cast<double>(n);
  const std::string contact = o.text("contact", "exact");
  const History history = o.has("tolerance")      ? run_adaptive(s, o, o.number("tolerance", 1e-6),
                                                                 o.number("spacing", 0.01))
                          : contact == "moreau"   ? run_moreau(s, o, h, n)
                          : o.has("restart-grid") ? run_restarted(s, o, h)
                          : contact == "paoli"    ? run_paoli(s, o, h, n)
                                                  : run_steps(s, o, h, n);
  std::vector<State> rows = o.has("resample") ? resampled(history, o)
                            : o.has("jumps")  ? history.nodes
                                              : history.rows;
  spoil(rows, s, o, h);
  write(path, rows, s, o);
  if (o.has("events")) write_events(o.text("events", ""), history);
}

}  // namespace

int main() {
  try {
    for (std::string line; std::getline(std::cin, line);) solve_line(line);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "solvers: %s\n", error.what());
    return 1;
  }
  return 0;
}
