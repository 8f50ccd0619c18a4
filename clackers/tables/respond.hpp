#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/record/record.hpp"
#include "clackers/record/sheet.hpp"
#include "clackers/tables/times/time_grid.hpp"

namespace clackers::tables {

/// The exact response, columns t,side,u1,v1,a1[,u2,v2,a2,...]. Where a time is the double nearest to an
/// impact two rows appear, side "-" then "+". The case must outlive the rows. Throws InputError
/// for a time outside [0, end], before any row.
std::unique_ptr<record::RowSource> respond(const cases::Case& test_case, const TimeGrid& grid);

/// All impacts up to the case's end:
/// k,t[,contact],u1,v1-,v1+[,u2,v2-,v2+,...],impulse,energy_before,energy_after. Of a pair with one
/// contact u2 is left out, since the masses touch. Contacts that close together have a row each,
/// with the velocities before and after all of them. The case must outlive the rows.
std::unique_ptr<record::RowSource> impacts(const cases::Case& test_case);

/// Behind a title of impacts with a column contact, whose numbers are those of events files and records; a
/// person reads numbers from 1 elsewhere.
inline constexpr std::string_view impact_contacts_note = " (contacts numbered from 0)";

/// Whether infinitely many impacts come before a contact rests.
bool accumulates(const model::Motion& motion);

/// Where the energy is: t,side,kinetic,potential,dissipated,lost[,work],total,momentum at the times of
/// respond(), with its two rows at impacts; work where loads vary or belts move. The case must outlive
/// the rows. Throws InputError as respond() does.
std::unique_ptr<record::RowSource> energies(const cases::Case& test_case, const TimeGrid& grid);

/// The forces of contacts that stay closed, then of one-sided springs, 0 for open ones [N]; their impulses from t = 0 on,
/// impacts among them [N s]; the forces of dry friction [N]: t,side[,force1,...,impulse1,...][,friction1,...] at the times
/// of respond(). An impulse is integrated to the rounding of the largest momentum. The case must outlive the rows. Throws
/// InputError as respond() does, for a case without any of them (no-closed-form) and for more than 1e6 impacts.
std::unique_ptr<record::RowSource> forces(const cases::Case& test_case, const TimeGrid& grid);

/// The motion of a case's bars at places x [m], from -L1 (the far end of the left one of two) or 0 (the
/// contact end) on: t,side,u1,v1,stress1[,u2,...],force,impulse,kinetic,elastic,potential, numbered by
/// place. Two rows at times at which something jumps, sides "-" and "+". The case must outlive the
/// rows. Throws InputError as respond() does, for a case without bars (no-closed-form), for places
/// outside of them, and for more than 1e6 times.
std::unique_ptr<record::RowSource> points(const cases::Case& test_case, const TimeGrid& grid,
                                          const std::vector<double>& places);

/// The times at which the contact of these bars or this string closes and opens, for points(). Throws InputError
/// as points() does.
TimeGrid contact_grid(const cases::Case& test_case);

/// The columns of respond() differentiated: t,side,du1,dv1,da1[,du2,dv2,da2]. `name` is a raw
/// parameter (m1 m2 k1 k2 c1 c2 eta gap u10 u20 v10 v20, all else fixed) or one of the case, what
/// follows from it following; class:m1 is that of the case where both have the name. Throws
/// InputError as energies() does, for unknown names (with did-you-mean), and where there is no
/// derivative (no-derivative: whole numbers, the end of the run, eta = 0).
std::unique_ptr<record::RowSource> sensitivity(const cases::Case& test_case, const TimeGrid& grid,
                                               std::string_view name);

/// The Fourier transform of the displacements over the run, omega,re1,im1[,re2,im2], at `n` equally
/// spaced frequencies from 0 to `highest` [rad/s]. The case must outlive the rows. Throws InputError
/// unless 2 <= n <= 1e9 and 0 < highest, its phase over the run being certain.
std::unique_ptr<record::RowSource> spectrum(const cases::Case& test_case, long long n,
                                            double highest);

/// Times of the response in a report.
inline constexpr int response_points = 1501;

/// A case without subjects: its summary and response, for a page.
record::CaseRecord response_record(const cases::Case& test_case);

/// Exact displacements at `n` equally spaced times, for a picture. Throws InputError for n < 2.
record::Curve response_curve(const cases::Case& test_case, int n);

/// respond() with each value correctly rounded to `digits` significant digits, as text; times to at
/// least 17, so that they read back as the doubles they are. The case must outlive the rows. Throws
/// InputError unless 1 <= digits <= 1000, and when built without Arb.
std::unique_ptr<record::RowSource> respond(const cases::Case& test_case, const TimeGrid& grid,
                                           long long digits);

/// impacts() in the same way; t is the true instant, not the nearest double.
std::unique_ptr<record::RowSource> impacts(const cases::Case& test_case, long long digits);

}  // namespace clackers::tables
