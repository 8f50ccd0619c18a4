#include "clackers/decks/scripts/c_text.hpp"

namespace clackers::decks {

const char* const fmu_simulate =
    R"c(@head@// Drives the unit by the standard's sequence of calls: co-simulation (cs), or model exchange (me) with the classical
// method of Runge and Kutta and events found by bisection. Build: cc simulate.c -ldl -lm
// Usage: ./simulate Model.so cs|me STEP HISTORY.csv
#include <dlfcn.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FMI @fmi@
enum { n = @n@, states = 2 * n, gaps = @contacts@ };
static const double t0 = @t0@, last = @last@;
static const char* const token = "@token@";
static void *library, *unit;

static void* found(const char* name) {
  void* function = dlsym(library, name);
  if (function == NULL) fprintf(stderr, "no function %s\n", name), exit(2);
  return function;
}
static void require(int status, const char* name) {
  if (status != 0) fprintf(stderr, "%s returned %d\n", name, status), exit(1);
}
#if FMI == 2
#define FULL(name) "fmi2" #name
typedef int Boolean;
#else
#define FULL(name) "fmi3" #name
typedef bool Boolean;
#endif
#define FUNCTION(name, types) ((int(*) types)found(FULL(name)))
#define CALL(name, types, ...) require(FUNCTION(name, types)(__VA_ARGS__), FULL(name))
#define PLAIN(name) CALL(name, (void*), unit)

static void row(FILE* file, double t) {
  unsigned references[states];
  double values[states];
  for (int i = 0; i < states; ++i) references[i] = i + 1;
#if FMI == 2
  CALL(GetReal, (void*, const unsigned*, size_t, double*), unit, references, states, values);
#else
  CALL(GetFloat64, (void*, const unsigned*, size_t, double*, size_t), unit, references, states, values, states);
#endif
  fprintf(file, "\n%.17g", t);
  for (int i = 0; i < states; ++i) fprintf(file, ",%.17g", values[i]);
}

static void events(double* y) {
#if FMI == 2
  struct {
    Boolean needed, terminate, nominals, values, has_next;
    double next;
  } event;
  do CALL(NewDiscreteStates, (void*, void*), unit, &event);
  while (event.needed);
#else
  Boolean needed, terminate, nominals, values, has_next;
  double next;
  do
    CALL(UpdateDiscreteStates, (void*, Boolean*, Boolean*, Boolean*, Boolean*, Boolean*, double*), unit, &needed,
         &terminate, &nominals, &values, &has_next, &next);
  while (needed);
#endif
  PLAIN(EnterContinuousTimeMode);
  CALL(GetContinuousStates, (void*, double*, size_t), unit, y, states);
}

static void set(double t, const double* y) {
  CALL(SetTime, (void*, double), unit, t);
  CALL(SetContinuousStates, (void*, const double*, size_t), unit, y, states);
}

// The state h later in `next`; the smallest of the event indicators there.
static double advance(double t, double h, const double* y, double* next) {
  const double share[] = {0.0, 0.5, 0.5, 1.0}, weight[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  double rate[states] = {0}, stage[states], z[gaps + 1];
  memcpy(next, y, states * sizeof *y);
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < states; ++i) stage[i] = y[i] + share[k] * h * rate[i];
    set(t + share[k] * h, stage);
#if FMI == 2
    CALL(GetDerivatives, (void*, double*, size_t), unit, rate, states);
#else
    CALL(GetContinuousStateDerivatives, (void*, double*, size_t), unit, rate, states);
#endif
    for (int i = 0; i < states; ++i) next[i] += weight[k] * h * rate[i];
  }
  set(t + h, next);
  CALL(GetEventIndicators, (void*, double*, size_t), unit, z, gaps);
  double least = 1.0;
  for (int i = 0; i < gaps; ++i) least = z[i] < least ? z[i] : least;
  return least;
}

@located@
static void exchange(FILE* file, long steps) {
  double y[states], next[states];
  events(y);
  row(file, t0);
  for (long k = 0; k < steps; ++k) {
    const double end = t0 + (last - t0) * (k + 1) / steps;
    for (double t = t0 + (last - t0) * k / steps; t < end;) {
      const double rest = end - t, passed = located(t, rest, y, next);
      const bool event = passed != rest;
      Boolean enter, terminate;
      CALL(CompletedIntegratorStep, (void*, Boolean, Boolean*, Boolean*), unit, true, &enter, &terminate);
      memcpy(y, next, sizeof y);
      t = event ? t + passed : end;
      row(file, t);
      if (!event) continue;
      PLAIN(EnterEventMode);
      events(y);
      row(file, t);
    }
  }
}

static void co_simulate(FILE* file, long steps) {
#if FMI == 3
  Boolean event, terminate, early;
  double reached;
#endif
  row(file, t0);
  for (long k = 0; k < steps; ++k) {
    const double t = t0 + (last - t0) * k / steps, end = t0 + (last - t0) * (k + 1) / steps;
#if FMI == 2
    CALL(DoStep, (void*, double, double, Boolean), unit, t, end - t, true);
#else
    CALL(DoStep, (void*, double, double, Boolean, Boolean*, Boolean*, Boolean*, double*), unit, t, end - t, true, &event,
         &terminate, &early, &reached);
#endif
    row(file, end);
  }
}

int main(int count, char** words) {
  if (count < 5) return 2;
  const bool co = strcmp(words[2], "cs") == 0;
  library = dlopen(words[1], RTLD_NOW);
  FILE* file = fopen(words[4], "w");
  if (library == NULL || file == NULL) return 2;
  fputc('t', file);
  for (int i = 0; i < states; ++i) fprintf(file, ",%c%d", "uv"[i / n], i % n + 1);
#if FMI == 2
  unit = ((void* (*)(const char*, int, const char*, const char*, const void*, int, int))found("fmi2Instantiate"))(
      "unit", co, token, "", NULL, 0, 0);
  if (unit == NULL) return 1;
  CALL(SetupExperiment, (void*, Boolean, double, double, Boolean, double), unit, 0, 0.0, t0, 1, last);
  PLAIN(EnterInitializationMode);
#else
  unit = co ? ((void* (*)(const char*, const char*, const char*, bool, bool, bool, bool, const unsigned*, size_t, void*,
                          void*, void*))found("fmi3InstantiateCoSimulation"))("unit", token, "", 0, 0, 0, 0, NULL, 0,
                                                                               NULL, NULL, NULL)
            : ((void* (*)(const char*, const char*, const char*, bool, bool, void*, void*))found(
                  "fmi3InstantiateModelExchange"))("unit", token, "", 0, 0, NULL, NULL);
  if (unit == NULL) return 1;
  CALL(EnterInitializationMode, (void*, Boolean, double, double, Boolean, double), unit, 0, 0.0, t0, 1, last);
#endif
  PLAIN(ExitInitializationMode);
  const long steps = lround((last - t0) / atof(words[3]));
  (co ? co_simulate : exchange)(file, steps);
  PLAIN(Terminate);
  ((void (*)(void*))found(FULL(FreeInstance)))(unit);
  fputc('\n', file);
  return fclose(file) == 0 ? 0 : 1;
}
)c";

}  // namespace clackers::decks
