/**
 * Clackers for C: the exact motion of colliding masses.
 *
 * Every function that can fail returns a clackers_status and never ends the program. After a status
 * other than CLACKERS_OK nothing was created and no output but buffers of numbers was touched (those
 * may be partly written); clackers_last_error() says in words what was wrong and what is allowed,
 * for the last such call on the same thread.
 *
 * A structure begins with struct_size, which the caller sets to sizeof the structure before the
 * call. That is its version: later headers only append members. A structure from an older header is
 * served as far as it reaches. Of one from a newer header, what this library does not know must be
 * zero where it is read, and is set to zero where it is written.
 *
 * A clackers_motion is constant: threads may share one. Units are SI, times in seconds.
 */
#ifndef CLACKERS_H
#define CLACKERS_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define CLACKERS_API __attribute__((visibility("default")))
#else
#define CLACKERS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* -- Versions and errors ---------------------------------------------------------------------- */

/** One of CLACKERS_OK, ...; of fixed size, unlike an enumeration. Later versions may add values. */
typedef int32_t clackers_status;
enum {
  CLACKERS_OK = 0,
  CLACKERS_REFUSED = 1,       /**< an argument is not allowed, or a file cannot be read */
  CLACKERS_OUT_OF_MEMORY = 2, /**< ask for less */
  CLACKERS_INTERNAL_ERROR = 3 /**< a mistake of the library; please report it */
};

/** "0.1.0". Lives as long as the program. */
CLACKERS_API const char* clackers_version(void);

/**
 * What went wrong in the last call on this thread that returned a status, as a sentence; empty if it
 * was CLACKERS_OK. Valid until the thread's next call that returns a status.
 */
CLACKERS_API const char* clackers_last_error(void);

/** The stable kebab-case name of the same error, which `clackers explain` explains; or empty. */
CLACKERS_API const char* clackers_last_error_code(void);

/* -- Making a motion -------------------------------------------------------------------------- */

/** A case with its exact motion. */
typedef struct clackers_motion clackers_motion;

/** The free parameters of a synchronized pair. Fill with clackers_pair_defaults() first. */
typedef struct clackers_pair {
  size_t struct_size;
  double m1;    /**< mass 1, above [kg], 1e-60 to 1e60 */
  double k1;    /**< its stiffness [N/m], 1e-60 to 1e60 */
  double xi1;   /**< its damping ratio, 0 <= xi1 < 1 */
  double A;     /**< size of its initial displacement [m], 1e-60 to 1e60 */
  double X;     /**< frequency ratio omega_D2/omega_D1, odd or 1 over odd, up to 1e9 */
  double r;     /**< mass ratio m1/m2, 0 < r < r*(X); see clackers_admissibility() */
  double eta;   /**< restitution, 0 to 1; 1 is elastic */
  double t_end; /**< end of the motion [s] */
} clackers_pair;

/** One parameter of a named case, "xi1" = 0.05. This structure never changes. */
typedef struct clackers_setting {
  const char* name;
  double value;
} clackers_setting;

/** Sets every member after struct_size to its default. */
CLACKERS_API clackers_status clackers_pair_defaults(clackers_pair* pair);

/** Creates the motion of a pair in *motion; end it with clackers_motion_destroy(). */
CLACKERS_API clackers_status clackers_pair_create(const clackers_pair* pair,
                                                  clackers_motion** motion);

/**
 * Creates the motion of a named case ("three-parameter") in *motion. Parameters that `settings` does
 * not name keep their default; `settings` may be null when `count` is 0.
 */
CLACKERS_API clackers_status clackers_case_create(const char* name,
                                                  const clackers_setting* settings, size_t count,
                                                  clackers_motion** motion);

/** One parameter of a named case that is a word, "coupling" = "dense". This structure never changes. */
typedef struct clackers_word {
  const char* name;
  const char* text; /**< also the name of a file: "problem" = "frame.toml" of the case piecewise */
} clackers_word;
/** The same with parameters that are words; `words` may be null when `word_count` is 0. */
CLACKERS_API clackers_status clackers_case_create_with_words(
    const char* name, const clackers_setting* settings, size_t count, const clackers_word* words,
    size_t word_count, clackers_motion** motion);
/** Ends a motion; every pointer obtained from it becomes invalid. Null is allowed. */
CLACKERS_API void clackers_motion_destroy(clackers_motion* motion);

/** The name of case `index` = 0, 1, ..., or null beyond the last. Lives as long as the program. */
CLACKERS_API const char* clackers_case_name(size_t index);

/* -- Asking a motion -------------------------------------------------------------------------- */

/** Where a time is the double nearest to an impact, which flight is meant: before or after it. */
typedef int32_t clackers_side;
enum { CLACKERS_LEFT = 0, CLACKERS_RIGHT = 1 };

/** Arrays of the caller for displacement [m], velocity [m/s] and acceleration [m/s^2]. */
typedef struct clackers_buffers {
  size_t struct_size;
  size_t capacity; /**< number of doubles that each array holds */
  double* u;
  double* v;
  double* a; /**< null when not wanted */
} clackers_buffers;

/** The number of masses. */
CLACKERS_API clackers_status clackers_motion_dof(const clackers_motion* motion, int32_t* dof);

/** The end of the motion [s]. */
CLACKERS_API clackers_status clackers_motion_end(const clackers_motion* motion, double* end);

/**
 * The states at times[0], ..., times[count - 1], in any order, each from 0 to the end. State i of
 * mass j is written to [i * dof + j]; capacity must be at least count * dof. Allocates nothing. A pair
 * at 320 equidistant times or more takes a quarter of the time; one value in ten thousand then has another
 * last bit.
 */
CLACKERS_API clackers_status clackers_motion_sample(const clackers_motion* motion,
                                                    const double* times, size_t count,
                                                    clackers_side side,
                                                    const clackers_buffers* out);

/** The amplitude that each component has around t; capacity must be at least dof. */
CLACKERS_API clackers_status clackers_motion_envelope(const clackers_motion* motion, double t,
                                                      const clackers_buffers* out);

/** Proved bound on |computed - true| of each component at t; capacity must be at least dof. */
CLACKERS_API clackers_status clackers_motion_error_bound(const clackers_motion* motion, double t,
                                                         const clackers_buffers* out);

/** The number of forces: of contacts, then of one-sided springs, then of dry friction. */
CLACKERS_API clackers_status clackers_motion_force_count(const clackers_motion* motion,
                                                         size_t* contacts, size_t* springs,
                                                         size_t* frictions);

/**
 * The forces at t [N], along their directions: of contacts that stay closed and of one-sided springs in
 * compression, 0 for open ones, then of dry friction. `capacity` doubles must hold them all.
 */
CLACKERS_API clackers_status clackers_motion_forces(const clackers_motion* motion, double t,
                                                    clackers_side side, size_t capacity,
                                                    double* forces);

/* -- Impacts ---------------------------------------------------------------------------------- */

typedef struct clackers_impact {
  size_t struct_size;
  int64_t index;        /**< 1 for the first */
  int64_t contact;      /**< which contact closes, 0 for the first */
  double t;             /**< the double nearest to the true instant [s] */
  double t_lo, t_hi;    /**< interval that certainly holds the true instant [s] */
  double impulse;       /**< [N s] */
  double energy_before; /**< kinetic and elastic, of all masses and springs [J] */
  double energy_after;
} clackers_impact;

/** Number of impacts from 0 to t. */
CLACKERS_API clackers_status clackers_motion_impact_count(const clackers_motion* motion, double t,
                                                          int64_t* count);

/**
 * Impact `index` = 1, 2, ... with the states on both sides of it. `before` and `after` may be null
 * when not wanted; otherwise capacity must be at least dof.
 */
CLACKERS_API clackers_status clackers_motion_impact(const clackers_motion* motion, int64_t index,
                                                    clackers_impact* impact,
                                                    const clackers_buffers* before,
                                                    const clackers_buffers* after);

/* -- Constants -------------------------------------------------------------------------------- */

/** A derived constant or indicator; the texts live as long as the motion. */
typedef struct clackers_constant {
  size_t struct_size;
  const char* name;    /**< "omega_D2" */
  const char* unit;    /**< "rad/s"; empty when dimensionless */
  const char* meaning; /**< a phrase for a person */
  double value;
} clackers_constant;

/** Number of derived constants (m2, omega_D2, r*, margin, T, ...) and indicators (I_ms, ...). */
CLACKERS_API clackers_status clackers_motion_constant_count(const clackers_motion* motion,
                                                            size_t* count);

/** Quantity `index` = 0, 1, ..., count - 1. */
CLACKERS_API clackers_status clackers_motion_constant_at(const clackers_motion* motion,
                                                         size_t index, clackers_constant* constant);

/** The value of the constant with this name. */
CLACKERS_API clackers_status clackers_motion_constant(const clackers_motion* motion,
                                                      const char* name, double* value);

/**
 * Whether two masses with frequency ratio X and mass ratio r = m1/m2 touch only at equilibrium: the
 * limit r*(X) of slow over fast mass (infinity for X = 1), and the smallest gap between impacts
 * relative to the slow displacement. They do where the margin is positive; 0 grazes.
 */
CLACKERS_API clackers_status clackers_admissibility(double X, double r, double* r_star,
                                                    double* margin);

#ifdef __cplusplus
}
#endif

#endif
