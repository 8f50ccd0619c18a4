/**
 * Clackers for authors of solvers: a time integrator in a shared library of its own, which
 *
 *     clackers verify --plugin ./mine.so
 *
 * assesses like a method of the catalogue. The library defines one function, clackers_plugin(), and
 * links nothing of Clackers. C99, and every language that can define C functions.
 *
 * The problem is M a + C v + K u = 0 from a given state, with contacts g = direction . u - gap >= 0.
 * At an impact the gap rate changes to -restitution times itself, by an impulse along the direction.
 * Units are SI, times in seconds.
 *
 * Calls: prepare once for a problem, run for each step or tolerance, free at the end. Calls that
 * share a state never overlap; several states may exist at once, in several threads. Today's command
 * makes one of each call in a process of its own, in a folder of its own, where a crash, a time limit
 * or the end of the process are a failed run. What the library prints is shown where a run fails, and
 * is no part of its result.
 *
 * Memory: what a function is handed belongs to the caller and is constant. The problem is valid until
 * free has returned, everything else until the function returns. Callbacks copy what they are given.
 *
 * Versions: the structures here are never allocated by the other side, and later versions only append
 * members, so a library keeps working with every later Clackers. One of a later version than
 * Clackers knows is refused.
 */
#ifndef CLACKERS_SOLVER_H
#define CLACKERS_SOLVER_H

#include <stdint.h>

#if defined(__GNUC__)
#define CLACKERS_PLUGIN __attribute__((visibility("default")))
#else
#define CLACKERS_PLUGIN
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** The version of this header. */
#define CLACKERS_SOLVER_VERSION 1

/** The motion to compute. Matrices are symmetric and stored by rows: entry (i, j) at [i * dof + j]. */
typedef struct clackers_solver_problem {
  int32_t dof;               /**< number of masses, at least 1 */
  int32_t contacts;          /**< number of contacts; 0: the motion is smooth */
  const double* M;           /**< dof x dof, positive definite [kg] */
  const double* C;           /**< dof x dof [N s/m] */
  const double* K;           /**< dof x dof [N/m] */
  const double* direction;   /**< contacts x dof, dimensionless; null without contacts */
  const double* gap;         /**< one a contact [m]; null without contacts */
  const double* restitution; /**< one a contact, 0 to 1; null without contacts */
  double start;              /**< time of the first state [s] */
  double end;                /**< time of the last state, above start [s] */
  const double* u;           /**< dof displacements at the start [m] */
  const double* v;           /**< dof velocities at the start [m/s] */
} clackers_solver_problem;

/** One run. */
typedef struct clackers_solver_run {
  double step;      /**< (end - start) / steps [s] */
  int64_t steps;    /**< number of steps from start to end, at least 1 */
  double tolerance; /**< relative, in (0, 1], of a solver that refines by it; otherwise 0 */
} clackers_solver_run;

/**
 * What the functions of a solver call back, from the thread that they are called in. `state` and
 * `collision` return 0; after any other value nothing more is taken, and run should free what it
 * allocated and return that value.
 */
typedef struct clackers_solver_host clackers_solver_host;
struct clackers_solver_host {
  int32_t version; /**< of the header that Clackers was built with */

  /**
   * Delivers a state; only from run. Times do not descend, from start to end; a time given twice
   * has the states before and after a jump. `u` has dof values; `v` and `a` too, or are null in
   * every call of a run. All numbers are finite.
   */
  int32_t (*state)(clackers_solver_host* host, double t, const double* u, const double* v,
                   const double* a);

  /**
   * Reports a collision; only from run, in the order of times, before or after the states around it.
   * `impulse` [N s] is NAN where it is not known, `v_before` and `v_after` are null where they are
   * not known, in every call of a run. A solver that never calls this reports nothing of collisions.
   */
  int32_t (*collision)(clackers_solver_host* host, double t, double impulse, const double* v_before,
                       const double* v_after);

  /**
   * Makes the run a failed one for this reason, a phrase for a person in UTF-8. Returns a value other
   * than 0, for `return host->fail(host, "M is not diagonal");`.
   */
  int32_t (*fail)(clackers_solver_host* host, const char* reason);
};

/** What a solver refines from run to run. */
enum {
  CLACKERS_SOLVER_STEP = 0,     /**< clackers_solver_run.step */
  CLACKERS_SOLVER_TOLERANCE = 1 /**< clackers_solver_run.tolerance; the step is then the coarsest */
};

/** A solver. Functions return 0, or another value for a failure, best that of host->fail(). */
typedef struct clackers_solver {
  int32_t version;  /**< CLACKERS_SOLVER_VERSION */
  int32_t refines;  /**< CLACKERS_SOLVER_STEP or CLACKERS_SOLVER_TOLERANCE */
  const char* name; /**< in every output, in UTF-8; null: the name of the file */

  /**
   * Prepares for a problem: allocates and sets *state, which is null before, and which run and free
   * are handed. Fails for a problem that the solver does not take. Null: nothing to prepare.
   */
  int32_t (*prepare)(const clackers_solver_problem* problem, clackers_solver_host* host,
                     void** state);

  /** Computes the motion and delivers it through host->state(). */
  int32_t (*run)(void* state, const clackers_solver_problem* problem,
                 const clackers_solver_run* run, clackers_solver_host* host);

  /** Frees a state; called after every prepare, also after one that failed. Null: nothing to free. */
  void (*free)(void* state);
} clackers_solver;

/** Defined by the library: its solver, which lives as long as the library is loaded. */
CLACKERS_PLUGIN const clackers_solver* clackers_plugin(void);

#ifdef __cplusplus
}
#endif

#endif
