/**
 * Makes a program of a time integrator, which Clackers runs and assesses:
 *
 *     clackers verify --exec './mine {case:text} {n} {out} events={events}'
 *
 * The program defines clackers_step(), which advances the motion by a step, in C, C++, Fortran or any
 * other language that can define C functions. This header defines main(): it reads the problem, calls
 * clackers_step() for each step, and writes the history. Include it in a single file; other files define
 * CLACKERS_NO_MAIN before they include it. For other languages compile it as C: cc -x c clackers_main.h.
 * C99 or C++; no library besides that of C.
 *
 * Arguments of the program: the file of {case:text}, then pairs of a number of steps and the file for the
 * history. Each pair is a run, so that a process may make a whole ladder. Before a pair may stand
 * events=FILE, for the impacts of its run, and tolerance=NUMBER, which holds for all runs behind it.
 *
 * The problem is M a + C v + K u = f(t, u) from a given state, with contacts
 * g = direction . u - gap >= 0. At an impact the gap rate changes to -restitution times itself, by an
 * impulse along the direction. SI units.
 */
#ifndef CLACKERS_MAIN_H
#define CLACKERS_MAIN_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A run: the motion to compute and its steps. Matrices are symmetric: entry (i, j) at [i * dof + j]. */
typedef struct clackers_run {
  int32_t dof;               /**< number of masses, at least 1 */
  int32_t contacts;          /**< number of contacts; 0: the motion is smooth */
  int32_t loads, springs;    /**< number of terms in clackers_forces() */
  const double* M;           /**< dof x dof, positive definite [kg] */
  const double* C;           /**< dof x dof [N s/m] */
  const double* K;           /**< dof x dof [N/m] */
  const double* direction;   /**< contacts x dof, dimensionless */
  const double* gap;         /**< of each contact [m] */
  const double* restitution; /**< of each contact, 0 to 1 */
  const double* load;        /**< loads x 4: mass from 1, amplitude [N], frequency [rad/s], phase */
  const double* spring;      /**< springs x (dof + 2): direction, gap [m], stiffness [N/m] */
  const double* u;           /**< dof displacements at the start [m] */
  const double* v;           /**< dof velocities at the start [m/s] */
  double start, end;         /**< times of the first and the last state [s] */
  double step;               /**< (end - start) / steps [s] */
  int64_t steps;             /**< number of steps, at least 1 */
  double tolerance;          /**< relative, of {tolerance}; 0: none is given */
  double t;                  /**< time of the state that clackers_step() is called with [s] */
  void* memory; /**< kept from step to step: null at the start, of malloc(), freed at the end */
} clackers_run;

/**
 * Defined by the author: advances the state (u, v) from run->t to t1, impacts included. Returns 0, or
 * another value where it fails, best that of clackers_fail(). With -D CLACKERS_WITHOUT_V the history
 * has no velocities, for methods that compute none.
 */
int clackers_step(clackers_run* run, double t1, double* u, double* v);

/** The force on the right-hand side: harmonic loads at t and one-sided springs at u. */
void clackers_forces(const clackers_run* run, double t, const double* u, double* f);

/**
 * Reports an impact, in the order of times. `impulse` [N s] is NAN where it is not known, and `v_before`
 * and `v_after` are null where they are not known, in every call of a run. Returns 0, or 1 where the
 * file of events cannot be written.
 */
int clackers_add_impact(clackers_run* run, double t, double impulse, const double* v_before,
                        const double* v_after);

/**
 * Adds a state between those of the steps, in the order of times; a time given twice has the states
 * before and after a jump. Returns 0, or 1 where the history cannot be written.
 */
int clackers_add_state(clackers_run* run, double t, const double* u, const double* v);

/** Prints the reason of a failure and returns 1: return clackers_fail(run, "M is not diagonal"); */
int clackers_fail(clackers_run* run, const char* reason);

#ifdef __cplusplus
}
#endif

#ifndef CLACKERS_NO_MAIN

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef CLACKERS_WITHOUT_V
enum { clackers_writes_v = 0 };
#else
enum { clackers_writes_v = 1 };
#endif

static FILE *clackers_history, *clackers_events;
static const char* clackers_events_name;

static void clackers_stop(const char* what, const char* name) {
  fprintf(stderr, "%s: %s\n", name, what);
  exit(2);
}

static double* clackers_numbers(int64_t count) {
  double* numbers = (double*)calloc((size_t)count + 1, sizeof(double));
  if (numbers == NULL) clackers_stop("no memory", "problem");
  return numbers;
}

static void clackers_read(FILE* file, const char* name, int32_t count, double* values) {
  int32_t i;
  for (i = 0; i < count; ++i)
    if (fscanf(file, "%lf", values + i) != 1)
      clackers_stop("not the numbers that a file of {case:text} has here", name);
}

/* The line name=values, or name1=values for a number from 1. */
static void clackers_read_line(FILE* file, const char* name, int32_t number, int32_t count,
                               double* values) {
  char expected[32], found[32] = "";
  sprintf(expected, number > 0 ? "%s%d" : "%s", name, (int)number);
  if (fscanf(file, " %31[^=]=", found) != 1 || strcmp(found, expected) != 0)
    clackers_stop("not in the problem; give the file of {case:text}", expected);
  clackers_read(file, expected, count, values);
}

static int32_t clackers_read_size(FILE* file, const char* name) {
  double value = 0;
  clackers_read_line(file, name, 0, 1, &value);
  if (!(value >= 0 && value < 1e6)) clackers_stop("out of range", name);
  return (int32_t)value;
}

static const double* clackers_read_matrix(FILE* file, const char* name, int32_t dof) {
  double* values = clackers_numbers((int64_t)dof * dof);
  int32_t i;
  for (i = 0; i < dof; ++i) clackers_read_line(file, name, i + 1, dof, values + i * dof);
  return values;
}

/* Room for a further row behind `count` of them. */
static double* clackers_add_row(const double** rows, int32_t count, int32_t size) {
  double* values = clackers_numbers((int64_t)(count + 1) * size);
  if (count > 0) memcpy(values, *rows, (size_t)(count * size) * sizeof(double));
  free((void*)*rows);
  *rows = values;
  return values + count * size;
}

static void clackers_read_problem(const char* path, clackers_run* run) {
  FILE* file = fopen(path, "r");
  double *u, *v, *direction, *gap, *restitution;
  char name[32];
  int32_t i;
  if (file == NULL) clackers_stop("cannot be read", path);
  run->dof = clackers_read_size(file, "dof");
  run->contacts = clackers_read_size(file, "contacts");
  clackers_read_line(file, "t", 0, 1, &run->start);
  clackers_read_line(file, "end", 0, 1, &run->end);
  run->u = u = clackers_numbers(run->dof);
  run->v = v = clackers_numbers(run->dof);
  clackers_read_line(file, "u", 0, run->dof, u);
  clackers_read_line(file, "v", 0, run->dof, v);
  run->M = clackers_read_matrix(file, "M", run->dof);
  run->C = clackers_read_matrix(file, "C", run->dof);
  run->K = clackers_read_matrix(file, "K", run->dof);
  run->direction = direction = clackers_numbers((int64_t)run->contacts * run->dof);
  run->gap = gap = clackers_numbers(run->contacts);
  run->restitution = restitution = clackers_numbers(run->contacts);
  for (i = 0; i < run->contacts; ++i) {
    clackers_read_line(file, "direction", i + 1, run->dof, direction + i * run->dof);
    clackers_read_line(file, "gap", i + 1, 1, gap + i);
    clackers_read_line(file, "restitution", i + 1, 1, restitution + i);
  }
  while (fscanf(file, " %31[^=]=", name) == 1)
    if (strncmp(name, "load", 4) == 0)
      clackers_read(file, name, 4, clackers_add_row(&run->load, run->loads++, 4));
    else if (strncmp(name, "spring", 6) == 0)
      clackers_read(file, name, run->dof + 2,
                    clackers_add_row(&run->spring, run->springs++, run->dof + 2));
    else
      clackers_stop("not known; use the header of this version of Clackers", name);
  fclose(file);
}

static void clackers_write_names(FILE* file, const char* name, int32_t dof, const char* suffix) {
  int32_t i;
  for (i = 1; i <= dof; ++i) fprintf(file, ",%s%d%s", name, (int)i, suffix);
}

static void clackers_write(FILE* file, int32_t count, const double* values) {
  int32_t i;
  for (i = 0; i < count; ++i) fprintf(file, ",%.17g", values[i]);
}

int clackers_add_state(clackers_run* run, double t, const double* u, const double* v) {
  fprintf(clackers_history, "%.17g", t);
  clackers_write(clackers_history, run->dof, u);
  if (clackers_writes_v) clackers_write(clackers_history, run->dof, v);
  fputc('\n', clackers_history);
  return ferror(clackers_history) != 0;
}

int clackers_add_impact(clackers_run* run, double t, double impulse, const double* v_before,
                        const double* v_after) {
  const int has_impulse = impulse == impulse, has_v = v_before != NULL && v_after != NULL;
  if (clackers_events_name == NULL) return 0;
  if (clackers_events == NULL) {
    clackers_events = fopen(clackers_events_name, "w");
    if (clackers_events == NULL) return clackers_fail(run, "the file of events cannot be written");
    fprintf(clackers_events, has_impulse ? "t,impulse" : "t");
    clackers_write_names(clackers_events, "v", has_v ? run->dof : 0, "-");
    clackers_write_names(clackers_events, "v", has_v ? run->dof : 0, "+");
    fputc('\n', clackers_events);
  }
  fprintf(clackers_events, "%.17g", t);
  clackers_write(clackers_events, has_impulse, &impulse);
  clackers_write(clackers_events, has_v ? run->dof : 0, v_before);
  clackers_write(clackers_events, has_v ? run->dof : 0, v_after);
  fputc('\n', clackers_events);
  return ferror(clackers_events) != 0;
}

int clackers_fail(clackers_run* run, const char* reason) {
  fprintf(stderr, "%s, at t = %.17g\n", reason, run->t);
  return 1;
}

void clackers_forces(const clackers_run* run, double t, const double* u, double* f) {
  int32_t i, k;
  for (i = 0; i < run->dof; ++i) f[i] = 0;
  for (k = 0; k < run->loads; ++k) {
    const double* load = run->load + 4 * k;
    f[(int32_t)load[0] - 1] += load[1] * cos(load[2] * t + load[3]);
  }
  for (k = 0; k < run->springs; ++k) {
    const double* direction = run->spring + k * (run->dof + 2);
    double gap = -direction[run->dof];
    for (i = 0; i < run->dof; ++i) gap += direction[i] * u[i];
    for (i = 0; gap < 0 && i < run->dof; ++i) f[i] -= direction[run->dof + 1] * gap * direction[i];
  }
}

/* The file gets its name when the run has ended well, so that no part of a history is taken for it. */
static int clackers_make_run(clackers_run* run, const char* out) {
  double *u = clackers_numbers(run->dof), *v = clackers_numbers(run->dof), t1;
  char* part = (char*)malloc(strlen(out) + 6);
  int64_t i;
  int failed;
  if (part == NULL) clackers_stop("no memory", out);
  strcat(strcpy(part, out), ".part");
  clackers_history = fopen(part, "w");
  if (clackers_history == NULL) clackers_stop("cannot be written", part);
  fputc('t', clackers_history);
  clackers_write_names(clackers_history, "u", run->dof, "");
  clackers_write_names(clackers_history, "v", clackers_writes_v ? run->dof : 0, "");
  fputc('\n', clackers_history);
  memcpy(u, run->u, (size_t)run->dof * sizeof(double));
  memcpy(v, run->v, (size_t)run->dof * sizeof(double));
  run->step = (run->end - run->start) / (double)run->steps;
  run->t = run->start;
  run->memory = NULL;
  failed = clackers_add_state(run, run->t, u, v);
  for (i = 1; i <= run->steps && !failed; ++i) {
    t1 = run->start + (run->end - run->start) * (double)i / (double)run->steps;
    failed = clackers_step(run, t1, u, v) || clackers_add_state(run, t1, u, v);
    run->t = t1;
  }
  free(run->memory);
  free(u);
  free(v);
  if (clackers_events != NULL && fclose(clackers_events) != 0) failed = 1;
  if (fclose(clackers_history) != 0) failed = 1;
  if (failed || rename(part, out) != 0) failed = 1, remove(part);
  clackers_events = NULL;
  clackers_events_name = NULL;
  free(part);
  return failed;
}

int main(int count, char** arguments) {
  clackers_run run;
  char* rest;
  int i, runs = 0;
  memset(&run, 0, sizeof run);
  if (count < 4) clackers_stop("PROBLEM [tolerance=X] [events=FILE] STEPS OUT ...", arguments[0]);
  clackers_read_problem(arguments[1], &run);
  for (i = 2; i < count; ++i) {
    if (strncmp(arguments[i], "events=", 7) == 0) {
      clackers_events_name = arguments[i] + 7;
    } else if (strncmp(arguments[i], "tolerance=", 10) == 0) {
      run.tolerance = strtod(arguments[i] + 10, &rest);
      if (*rest != 0 || !(run.tolerance > 0)) clackers_stop("not a tolerance", arguments[i]);
    } else {
      run.steps = strtoll(arguments[i], &rest, 10);
      if (*rest != 0 || run.steps < 1) clackers_stop("not a number of steps", arguments[i]);
      if (++i == count) clackers_stop("no file for the history behind it", arguments[i - 1]);
      if (clackers_make_run(&run, arguments[i]) != 0) return 1;
      ++runs;
    }
  }
  return runs > 0 ? 0 : 2;
}

#endif
#endif
