#pragma once

#include <cmath>
#include <string>

#include "clackers/report/sample_record.hpp"
#include "clackers/study/check_record.hpp"

namespace clackers::report {

inline study::CheckedFile sample_check_file(const std::string& name, double step) {
  study::CheckedFile made;
  made.file = name;
  made.rows = 2001;
  made.spacing = step;
  made.last = 20.0;
  made.columns = {{"t", 17, false, 0.0}, {"u1", 6, false, 5e-6}};
  made.printed_floor = 5e-6;
  made.printed_by = "u1";
  made.has_u = {true, true};
  made.collisions = study::CollisionSource::history;
  made.score.step = step;
  made.score.finished = true;
  made.score.u_error = 0.1 * step;
  made.score.v_error = std::nan("");
  made.score.impacts = assess::ImpactScore{6, 5, 4, 2, 1, 0.125, 0.0};
  made.metrics = {{"u-max", "m", 0.25, {0.25, 0.125}, "", true},
                  {"v-max", "m/s", 2.0, {}, "", false},
                  {"a-max", "m/s2", std::nan(""), {}, "There are no accelerations.", true},
                  {"impacts-missed", "1", 2.0, {}, "", true}};
  made.history.y.resize(2);
  made.error_history.y.resize(2);
  made.notes = {"No events file: they were found in the history itself."};
  for (int i = 0; i <= 200; ++i) {
    const double t = 0.1 * i;
    made.history.t.push_back(t);
    made.error_history.t.push_back(t);
    made.history.y[0].push_back(std::sin(t));
    made.history.y[1].push_back(0.4 * std::sin(9.0 * t));
    made.error_history.y[0].push_back(0.01 * t);
    made.error_history.y[1].push_back(0.02 * t);
  }
  return made;
}

/// Two histories of one method, the finer one with metrics; made-up numbers in the shape of a real
/// record.
inline study::CheckRecord sample_check() {
  study::CheckRecord made;
  made.problem = sample_case();
  made.response = sample_response(801);
  made.problem.end = 20.0;
  made.problem.fast_period = 0.7;
  made.problem.impact_count = 6;
  made.files = {sample_check_file("/a/long/way/to/coarse.csv", 0.02),
                sample_check_file("fine.csv", 0.01)};
  made.files.front().notes.push_back("The first row is at 0.02 s, not at the start.");
  auto& fit = made.assessment.displacement;
  fit.behaviour = Behaviour::undecided;
  fit.reason = "too-few-levels";
  made.verdict = Verdict::disagrees;
  made.sentence = "It finds 4 of 6 collisions.";
  made.reason = "too-few-levels";
  made.next = "clackers explain too-few-levels";
  return made;
}

}  // namespace clackers::report
