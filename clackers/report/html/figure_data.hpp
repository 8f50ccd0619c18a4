#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "clackers/record/record.hpp"

namespace clackers::report {

/// What the figures of a case draw, by the name that their specifications use. The errors of runs are
/// whole, curves are rounded to six digits. "runs" is {"columns", "rows"}, all others are rows as
/// Vega-Lite reads them:
///
///     response, history_rows   displacements, exact and of the finest history
///     impacts               exact times
///     impact_table             restitution and lateness of the impacts of histories
///     runs                     every run
///     levels                   the upper envelope of each subject, without levels that the fit
///                              calls unusable
///     slopes                   triangles of orders 1, 2 and 4
///     history                  error against time, a curve a subject and mass
///     work                     the envelopes of error against work, by every counter
///     front                    the Pareto front over all runs of methods, by every counter
///     profile                  the performance profiles of the case
nlohmann::ordered_json figure_data(const record::CaseRecord& problem);

/// Numbers with six digits, as curves have them.
nlohmann::ordered_json rounded_list(const std::vector<double>& values);

/// Whether the motion of a case can be played: its structure has a drawing.
bool has_player(const record::CaseRecord& problem);
/// What player.js draws: the displacements "u" of all masses at the times "t"; "blocks", "springs",
/// "contacts", "leftward", "lengths", "plane" and "string" as record::Schematic has them; "impacts"; and of each subject one
/// of its "runs", with its own times.
nlohmann::ordered_json player_data(const record::CaseRecord& problem);

/// Curves of the performance profiles, without methods that accept none of the cases.
nlohmann::ordered_json profile_data(const std::vector<record::Profile>& profiles,
                                    std::span<const record::CaseRecord> cases);

/// Whether a convergence figure has anything to join: two runs with an error above zero.
bool has_convergence(const record::CaseRecord& problem);
/// Whether an error against time has anything to draw: one above zero.
bool has_error_history(const record::CaseRecord& problem);
/// The mass, from 1, of the largest error in those curves.
std::size_t worst_mass(const record::CaseRecord& problem);
/// The subject whose shown run is a history with displacements of all masses; nullptr without one.
const record::Subject* drawn_subject(const record::CaseRecord& problem);

}  // namespace clackers::report
