// Foreign solvers, right and wrong. Each line of standard input is one history:
//
//     FILE n=1000 method=newmark contact=exact eta=0.9 ...
//
// README.md lists the words. The file holds the rows as text.

#include <charconv>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "assemblies/run.hpp"

namespace {

using namespace foreign;

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
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

/// The table of a solver of any number of masses.
void write_assembly(const std::string& path, const Options& o) {
  const auto table = assemblies::printed(o);
  const std::size_t width = o.has("no-velocities") ? 1 : 2;
  std::string text = "t";
  for (std::size_t i = 1; i < table[0].size(); ++i)
    text += (i % width == 0 && width == 2 ? ",v" : ",u") + std::to_string((i + width - 1) / width);
  text += '\n';
  for (const auto& row : table)
    for (std::size_t i = 0; i < row.size(); ++i) {
      append(text, row[i], o, i == 0);
      text += i + 1 < row.size() ? ',' : '\n';
    }
  std::ofstream(path, std::ios::binary) << text;
}

/// Impacts as the solver reports them.
void write_events(const std::string& path, const History& history) {
  std::ofstream out(path);
  out.precision(17);
  out << "t\n";
  for (const auto& x : history.impacts) out << x.t << '\n';
}

void solve_line(const std::string& line) {
  const auto blank = line.find(' ');
  const std::string path = line.substr(0, blank);
  const Options o(blank == std::string::npos ? "" : line.substr(blank));
  if (o.has("problem")) return write_assembly(path, o);
  const System s = make_system(o);
  const long n = std::lround(o.number("n", 1000.0));
  History history;
  const auto rows = printed_rows(s, o, s.end / static_cast<double>(n), n, history);
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
