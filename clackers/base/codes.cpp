#include "clackers/base/codes.hpp"

namespace clackers {
namespace {

// One row a code, under its name in code_names.
// clang-format off
constexpr auto rows = std::to_array<CodeEntry>({
    // What was measured: the seven behaviours and their reasons.
    {"exact", "behaviour",
     "The error is at the rounding floor at every level: the method reproduces the motion itself."},
    {"proper", "behaviour",
     "Error against step is a straight line in logarithmic axes with the claimed order as slope, over at least four consecutive levels above the rounding floor."},
    {"reduced", "behaviour",
     "The line is straight but its slope is lower than the order the method claims."},
    {"irregular", "behaviour",
     "The error shrinks with the step, but scatters so much within each level that no line can be fitted; "
     "the order of the upper envelope is given instead. "
     "Usual for methods that detect an impact only at the end of a step."},
    {"stagnating", "behaviour",
     "The error stops shrinking above the rounding floor. The message gives the reason."},
    {"divergent", "behaviour",
     "The error grows when the step is refined, or the energy of the run leaves [1/2, 2] of the true one, or simultaneous impacts end in another motion."},
    {"undecided", "behaviour",
     "These runs are not enough for a verdict. The message says what to change."},
    {"contact-stiffness", "reason",
     "The floor is the model error of a compliant law. "
     "Of contacts, which last a contact time instead of an instant, a larger contact stiffness lowers it; "
     "of dry friction, which creeps instead of sticking, a smaller width (penalty:width=VALUE) does. "
     "Both need smaller steps."},
    {"tolerance-floor", "reason",
     "The floor is an iteration tolerance of the method; tighten it."},
    {"unexplained-floor", "reason",
     "The error stops shrinking and nothing the method states of itself explains it. "
     "Look for a tolerance, an interpolation or single precision inside it."},
    {"too-few-levels", "reason",
     "Fewer than four levels lie between the coarse range, where nothing converges yet, and the rounding floor. "
     "Use more --levels or another --coarsest."},
    {"contact-not-resolved", "reason",
     "Even the smallest step is longer than 1/25 of the contact time, or of that of regular friction, so the law was never integrated. "
     "Use more levels, smaller steps, a softer contact or a larger width of regular friction."},
    {"no-convergence-yet", "reason",
     "The error has not started to shrink in a regular way. Use smaller steps; of verify: "
     "more --levels or a smaller --coarsest."},
    {"larger-than-motion", "reason",
     "The error is as large as the motion itself, so that nothing follows it yet. Use smaller steps, well below the fastest period."},
    {"simultaneous-impacts", "reason",
     "Several contacts act at one instant, and the method finds them one after the other. Impacts one by one end in another motion than the impacts of one instant, whatever the step. Use a treatment that solves all contacts of a step together, such as moreau-jean. Between bodies that touch rounding decides: with a small gap the reference, too, takes them one by one."},
    {"one-sample-a-level", "reason",
     "There is one step a level, and the errors go up and down: scatter cannot be distinguished from order. "
     "Add three steps between each two, in the ratio 2^(1/4) (h, h/1.19, h/1.41, h/1.68, h/2)."},
    {"more-samples", "reason",
     "The errors scatter so much that the order is uncertain. "
     "Use more samples per level: eight in the ratio 2^(1/8) halve the uncertainty of two."},
    {"errors-cancel", "reason",
     "The signed error passes zero near a step, where two of its terms cancel; the order is that of the term that is left below it. "
     "Errors of steps around it are not representative; use smaller steps."},
    {"error-grows-again", "reason",
     "The error falls and then grows again with smaller steps: something grows with their number, as summed times, single precision or a tolerance of each step do. "
     "Smaller steps make it worse."},
    {"no-fixed-order", "reason",
     "The error falls faster with every refinement, beyond the claimed order, and no power of the step describes it: "
     "exponential convergence, or a bend before a line of higher order."},
    {"wrong-limit", "reason",
     "The runs converge to a limit that is not the true motion. "
     "Differences between runs do not show that; only a true motion or a second model can."},
    {"improper-convergence", "reason",
     "The differences between runs at successive steps do not fall as the claimed order asks, so nothing bounds the error of an extrapolated value."},
    {"differences-turn", "reason",
     "The differences between runs at successive steps change sign or direction, so they are not the terms of one expansion and nothing bounds the error of an extrapolated value."},
    {"run-failed", "reason",
     "Runs ended before their end time; the first failure is quoted."},
    {"no-impact-law", "reason",
     "The method has no law of impact: what a mass leaves a contact with depends on where in its step the impact falls, and so on the step, however small. Of meshes, whose contact nodes lose their mass as they are refined, it converges: judge it with verify --path."},
    {"energy-growth", "reason",
     "The run's energy left [1/2, 2] of the true one."},
    {"error-growth", "reason",
     "The error grew when the step was refined."},
    {"diverged", "failure",
     "A run left the range of finite numbers, usually beyond a stability limit."},
    {"newton-failed", "failure",
     "Newton's iteration did not reach its tolerance within its limit of iterations in some step."},
    {"complementarity-failed", "failure",
     "The impulses of contacts that are closed together were not found; rounding of their complementarity problem hides them."},
    {"step-too-small", "failure",
     "An adaptive method asked for steps that rounding of the time hides; the tolerance cannot be met there."},
    {"too-many-impacts", "failure",
     "More impacts happened inside one step than the treatment allows; impacts accumulate."},
    // Verdicts: what was found against what is claimed.
    {"agrees", "verdict",
     "What was measured is what the method claims."},
    {"disagrees", "verdict",
     "What was measured contradicts what the method claims."},
    {"not-claimed", "verdict",
     "The method claims nothing here, so nothing was compared."},
    // Refused input.
    {"not-a-number", "refusal",
     "A number was asked for and NaN, or text that is no number, was given."},
    {"not-finite", "refusal",
     "An infinite value was given where only finite numbers make sense."},
    {"out-of-range", "refusal",
     "A value lies outside the range that the message states."},
    {"wrong-size", "refusal",
     "Matrices, vectors or lists do not fit together in size."},
    {"null-pointer", "refusal",
     "A caller from C gave a null pointer where a value is needed. The message says which."},
    {"wrong-struct-size", "refusal",
     "The struct_size of a structure is unset, too small, or of a newer header whose additions this library does not know."},
    {"not-positive-definite", "refusal",
     "The mass matrix is not symmetric positive definite."},
    {"not-symmetric", "refusal",
     "The damping or stiffness matrix is not symmetric."},
    {"starts-in-contact", "refusal",
     "The initial state violates a contact: its gap is negative, or closed and closing."},
    {"not-odd", "refusal",
     "The frequency ratio X must be an odd whole number, or 1 over one; "
     "only then do both masses pass equilibrium together at every impact."},
    {"not-admissible", "refusal",
     "With these values the motion is not of the kind that is computed, or not certain. A closed form may not hold: "
     "masses would also touch elsewhere, such as a pair whose mass ratio r reaches r*(X), or stop on the way. "
     "Or an event that decides the motion is too close to the error: a graze, two impacts at almost one time, a contact that comes to rest, "
     "opens or touches without a force. The message says where and when, and what to change."},
    {"not-exact-data", "refusal",
     "With these values some model input is not exactly a binary64 number, so a solver would not get the true system. "
     "Use short binary fractions."},
    {"unknown-name", "refusal",
     "No case, method, parameter, code or option has this name."},
    {"bad-syntax", "refusal",
     "The text does not follow the grammar of the command line."},
    {"step-not-positive", "refusal",
     "A step must be positive, finite and not longer than the run."},
    {"too-many-steps", "refusal",
     "The run would need more than 1e9 steps and could not end."},
    {"too-many-rows", "refusal",
     "A response of more than 1e9 rows was asked for; use a larger step or fewer samples. Or the page of a campaign with more than 20000 methods times systems; use fewer values."},
    {"not-a-record", "refusal",
     "The text is no json of a verify run: "
     "broken, of another schema, or with a missing or unknown field. The message says where."},
    {"other-study", "refusal",
     "The record given as --baseline is of another case, other parameters or another ladder of steps. "
     "The message says which, with the options of both."},
    {"not-whole", "refusal",
     "A whole number was asked for and one with a fraction was given."},
    {"penalty-needs-elastic", "refusal",
     "An elastic contact law dissipates no energy, so it models only restitution 1; "
     "penalty:law=kelvin-voigt and others have a restitution."},
    {"law-needs-restitution", "refusal",
     "The contact law has no coefficients for this restitution; choose another law or another restitution."},
    {"needs-inelastic", "refusal",
     "The contact treatment has no law of restitution: masses stay together after the contact, as with restitution 0."},
    {"no-default-stiffness", "refusal",
     "A contact touches a degree of freedom without stiffness of its own, or, for a nonlinear law, the problem starts without "
     "energy, so there is no default for the penalty contact; give penalty:stiffness=VALUE."},
    {"linear-only", "refusal",
     "The problem has a nonlinear force, dry friction, a load or a free motion that the method, which solves linear equations in closed form or once a step, does not take. "
     "event-driven, penalty and moreau-jean take dry friction."},
    {"not-stated", "refusal",
     "The motion obeys a law that a problem has no rows for, such as friction at impacts. The case is for engines with laws of their own: check their histories."},
    {"redundant-contacts", "refusal",
     "The directions of contacts that are closed together depend linearly on each other, so their impulses are not unique; remove one of them."},
    {"integrator-not-taken", "refusal",
     "The contact treatment cannot drive this integrator; the message says which it takes."},
    {"wrong-resolution", "refusal",
     "An adaptive method takes a tolerance, every other method a step."},
    {"tolerance-too-small", "refusal",
     "The tolerance is below what rounding allows."},
    {"beyond-last-impact", "refusal",
     "The motion has no impact with the requested number."},
    {"no-closed-form", "refusal",
     "Sensitivities and spectra are known for motions in closed form only, points for bars and strings, and forces "
     "for problems with contacts, springs in their place or dry friction."},
    {"no-derivative", "refusal",
     "The motion does not depend smoothly on this parameter here: "
     "a whole number, the end of the run, or restitution 0. The message says why and what to do."},
    {"needs-arb", "refusal",
     "Digits beyond double precision were asked of a program that was built without Arb (Debian: "
     "libflint-arb-dev). Install it, configure and build again."},
    {"no-enclosure", "refusal",
     "More digits than a double has were asked of a motion that is known to double precision only, "
     "or of values that contacts which stay closed, or impacts whose order is not certain, precede."},
    {"time-outside", "refusal",
     "A time lies outside the interval in which the motion is known."},
    {"three-limits", "refusal",
     "Three or more rows of a history share one time. A jump has two limits: "
     "keep the last row before it and the first row after it."},
    // Files of other programs.
    {"not-text", "refusal",
     "A history must be rows of numbers as text in ASCII or UTF-8, or a NumPy file (.npy); "
     "the file is binary, UTF-16, or has a line of more than 65536 bytes."},
    {"not-an-array", "refusal",
     "A file of arrays (.npy, .mat, NetCDF, HDF5) that is cut, damaged, longer than its array, of Python "
     "objects, or of another shape than rows of numbers. Save t, u and v anew, or write csv."},
    {"no-column", "refusal",
     "A column that is needed is missing or appears twice, or the columns have no names. "
     "Name them in a header line or with --columns t,u1,v1,...; an underscore leaves one out."},
    {"ragged-row", "refusal",
     "A row has more or fewer fields than the header or the first row."},
    {"decimal-comma", "refusal",
     "Numbers take a decimal point. "
     "A file with decimal commas must be written again, for example with tr where commas separate nothing."},
    {"not-sorted", "refusal",
     "Times must not descend, and at most two rows may have the same time: "
     "the left and the right limit of a jump. Sort the rows, or print times with more digits."},
    {"too-short", "refusal",
     "A history needs at least two different times."},
    {"not-this-case", "refusal",
     "The history starts from another state than the case. "
     "The message says which value differs and, where one parameter explains it, its value for --set."},
    {"printed-digits", "reason",
     "The floor is the rounding of the printed numbers; 17 significant digits keep a double whole."},
    {"sparse-rows", "reason",
     "The rows of the history lie too far apart to find impacts in them. "
     "Print more rows, or give the impacts with --events."},
    // Causes of what histories show.
    {"restitution-differs", "diagnosis",
     "The history is that of another restitution: relative velocities after impacts are another multiple of those before."},
    {"mass-ratio-differs", "diagnosis",
     "The history is that of another mass ratio: momentum at impacts and the motion between them show it."},
    {"frequency-differs", "diagnosis",
     "The history is that of a mass with another natural frequency."},
    {"damping-differs", "diagnosis",
     "The history decays at another rate."},
    {"stiffness-differs", "diagnosis",
     "Between impacts the rows follow the equation of motion with another stiffness of the spring that the message names."},
    {"mass-differs", "diagnosis",
     "Between impacts the rows follow the equation of motion with another mass."},
    {"load-differs", "diagnosis",
     "Between impacts the rows follow the equation of motion with another amplitude or phase of a load, or without it."},
    {"constant-force", "diagnosis",
     "Between impacts the rows follow the equation of motion with a constant force on one mass, such as its weight."},
    {"restitution-varies", "diagnosis",
     "Restitution changes with the closing speed, in a case where it is a constant."},
    {"momentum-not-kept", "diagnosis",
     "The change of momentum at an impact is not that of an impulse along the contact."},
    {"restitution-threshold", "diagnosis",
     "Slow impacts do not bounce: below a closing speed the masses stay together, above it they have a coefficient of restitution. Many engines have this as a setting, whose default hides at fast impacts."},
    {"energy-gained-at-impacts", "diagnosis",
     "The later in its step an impact is applied, the larger its restitution: the penetration is pushed out by a speed that stays. No step size removes this."},
    {"restitution-scatters", "diagnosis",
     "Impacts of the same history have different coefficients of restitution, and other histories others: the impact law depends on where in the step the contact is found, or on what is done to the contact before. The motion has no limit for small steps."},
    {"force-step", "diagnosis",
     "Forces act for another part of the step on positions than on velocities, so that energy grows at every step size. Explicit Euler does so, and engines whose forces are given once a step from outside while the step is divided inside."},
    {"event-interpolated", "diagnosis",
     "The solver has an order, and the state at an event is that of a line between two of its steps, so that the error falls with a small power of the tolerance."},
    {"fixed-internal-step", "diagnosis",
     "The solver takes steps of one size for every step asked, and its output repeats or interpolates states between them."},
    {"damping-changes-at-impact", "diagnosis",
     "The history decays at another rate after the first impact than before."},
    {"gap-differs", "diagnosis",
     "Contacts close at another gap than that of the case, by the same length at each impact."},
    {"parameter-differs", "diagnosis",
     "The history is the motion of the case with another value of the parameter that the message names, within what noise or the method itself leaves."},
    {"time-shifted", "diagnosis",
     "The history is the right motion at other times, by a constant number of steps or seconds."},
    {"time-unit", "diagnosis",
     "The times are in another unit than seconds."},
    {"time-drifts", "diagnosis",
     "The printed times drift away from a grid of equal steps, as sums of rounded steps do."},
    {"unit-scaled", "diagnosis",
     "Displacements or velocities are those of the case times one factor."},
    {"columns-exchanged", "diagnosis",
     "Columns are in another order than their names."},
    {"masses-exchanged", "diagnosis",
     "The columns of the two masses are exchanged."},
    {"sign-reversed", "diagnosis",
     "Displacements are measured in the opposite direction."},
    {"velocity-at-half-steps", "diagnosis",
     "The velocities belong to times half a step away, as a leapfrog scheme has them."},
    {"velocity-order-lower", "diagnosis",
     "The velocities converge at a lower order than the displacements."},
    {"starts-at-rest", "diagnosis",
     "The velocities start at zero, where those of the case do not."},
    {"impact-missed", "diagnosis",
     "One impact of the motion is missing: the masses pass through each other there."},
    {"impact-doubled", "diagnosis",
     "One impact was applied twice."},
    {"impact-impulse-wrong", "diagnosis",
     "The impulse of the impacts is a constant multiple of the right one."},
    {"impact-at-step-end", "diagnosis",
     "Impacts are applied at the end or at the start of the step in which they happen, which limits the order to one and makes the errors scatter."},
    {"impact-interpolated", "diagnosis",
     "States at impacts are interpolated at a lower order than the integrator has, which limits the order of all that follows."},
    {"impact-tolerance", "diagnosis",
     "Impacts come late or early by an amount that does not depend on the step, and the error stops there: the tolerance of the search for impacts."},
    {"acceleration-not-renewed", "diagnosis",
     "The step after an impact, or the first of all, still uses an acceleration that is not that of its start."},
    {"contact-compliant", "diagnosis",
     "Contacts last a time and penetrate: the contact is a spring, not rigid."},
    {"contact-in-tension", "diagnosis",
     "The contact pulls: masses stay together where a contact can only push."},
    {"output-offset", "diagnosis",
     "A displacement is off by the same amount in all rows, while the motion is right."},
    {"output-drifts", "diagnosis",
     "A displacement leaves the true one at a constant rate, while the motion is right."},
    {"step-without-effect", "diagnosis",
     "All histories agree to rounding at their common times: the step, or the tolerance, has no effect on them, and no order can be read."},
    {"steps-contradict-rows", "diagnosis",
     "The smaller the step of a history, the farther its rows are apart: the steps seem to be given in the reverse order of the files."},
    {"odd-file", "diagnosis",
     "One history has another error than the line through all others: it does not belong to them."},
    {"single-precision", "diagnosis",
     "Numbers have the 24 bits of single precision."},
    {"noise-floor", "diagnosis",
     "The error ends in a rough floor without a trend: noise of the solver's arithmetic, iteration or output."},
    {"commensurate-steps", "diagnosis",
     "Some steps divide the time between impacts, so that impacts fall on ends of steps, and the error of their times vanishes."},
    {"numerical-damping", "diagnosis",
     "The history loses energy that the motion keeps, less with smaller steps: the dissipation of the method."},
    {"period-error", "diagnosis",
     "The history runs too fast or too slow by an amount that falls with the step: the dispersion of the method."},
    {"unstable-coarse-steps", "diagnosis",
     "Runs of the largest steps failed or grew without bound: they lie above the method's stability limit."},
    {"ends-early", "diagnosis",
     "The history ends before the case does, so that what comes later was not assessed."},
    {"output-resampled", "diagnosis",
     "Rows are interpolated between the solver's own steps."},
    // Files and the outside world.
    {"cannot-write", "failure",
     "A file could not be written; nothing half-written was left behind."},
    {"cannot-read", "failure",
     "A file could not be read."},
    {"no-renderer", "failure",
     "The program node, rsvg-convert or ffmpeg, which draw the figures of `clackers paper` and films, is not installed. "
     "Numbers (csv) and specifications (vl.json) of figures were written all the same."},
    {"render-failed", "failure",
     "The program node, rsvg-convert or ffmpeg was found and failed to draw a figure or a film. "
     "Numbers (csv) and specifications (vl.json) of figures were written all the same."},
    {"program-failed", "failure",
     "A program of `verify --exec` could not be started, ended with a status other than 0, or was "
     "ended by a signal. Its run is a failed one of its step; the message has its last output."},
    {"program-timeout", "failure",
     "A program of `verify --exec` was still running after the time of `--timeout`, and was ended "
     "with all that it had started."},
    {"program-output", "failure",
     "A program of `verify --exec` ended well without a history: the file is missing or empty, or there was "
     "more than can be read."},
    {"callable-failed", "failure",
     "A callable under test (clackers.verify of Python) raised an exception. Its run is a failed one "
     "of its step; the message has the end of the traceback."},
    {"callable-output", "failure",
     "A callable under test (clackers.verify of Python) returned something that is no history: return "
     "(t, u), (t, u, v) or (t, u, v, a), u of shape (time, dof), or a result of SciPy's solve_ivp."},
    {"foreign-folder", "refusal",
     "The folder of --out holds files that the command did not write. "
     "It is replaced as a whole, so give another name, or move them away."},
    {"no-deck", "refusal",
     "The format of `clackers export` has nothing for a part of the problem: a full mass matrix, a restitution below 1, a load. The message says which; "
     "the formats scipy, octave, r, cvode, modelica and julia take every problem."},
    {"too-many-runs", "refusal",
     "The campaign has more runs than are started without --yes. Use fewer values, points, methods or levels, or give --yes."},
    {"not-a-campaign", "refusal",
     "The file is no database of a campaign and no results for an atlas, or a damaged or half written one, or nothing in it is finished. Give another name, or move it away."},
    {"other-campaign", "refusal",
     "The database holds runs of another specification. Give another --database, or the specification that it was made with."},
    {"other-version", "refusal",
     "The database was written in another version of its schema. Read it with the version of clackers that the message names."},
    {"database-busy", "refusal",
     "Another process writes into the database or the shard. Wait for its end, or give another shard."},
    {"shard-missing", "refusal",
     "Not all shards of a campaign are there, so the merged database would lack tasks. Name the missing ones, or run them."},
    {"no-mpi", "refusal",
     "Several ranks were started, but this build has no MPI. Build with MPI installed, or use --shard i/n."},
    {"scheduler-failed", "failure",
     "The scheduler did not take the job. The message has what it printed."},
    {"out-of-memory", "failure",
     "There was not enough memory for the request; ask for less."},
    {"system-failed", "failure",
     "The operating system refused a thread, a folder or a file descriptor. The message has its reason; try again, or raise the limit."},
    {"internal-error", "failure",
     "A mistake in the program itself. Please report it with the command that led to it."},
    {"interrupted", "failure",
     "The run was interrupted (Ctrl-C). Finished rows were kept and the output is marked."},
});
// clang-format on

constexpr bool has_a_row_for_every_name() {
  return std::ranges::equal(rows, code_names, {}, &CodeEntry::name);
}
static_assert(has_a_row_for_every_name());

}  // namespace

std::span<const CodeEntry> code_table() { return rows; }

const CodeEntry* find_code(std::string_view name) {
  const auto row = std::ranges::find(rows, name, &CodeEntry::name);
  return row == rows.end() ? nullptr : &*row;
}

}  // namespace clackers
