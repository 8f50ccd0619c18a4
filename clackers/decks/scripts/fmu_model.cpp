#include "clackers/decks/scripts/c_text.hpp"

namespace clackers::decks {

const char* const fmu_model =
    R"c(@head@// Unit of FMI @fmi@.0: co-simulation gives @gives@, model exchange the equations of motion.
// Build: cc -shared -fPIC -O2 -o Model.so model.c -lm
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define FMI @fmi@
@data@
@mechanics@
enum { ok, failed = 3 };
@motion@
typedef struct {
  double t, y[2 * n];
} Unit;

// By value reference: t, the states, their derivatives, the gaps.
static double value_of(const Unit* unit, unsigned reference) {
  double dy[2 * n];
  if (reference == 0) return unit->t;
  if (reference <= 2 * n) return unit->y[reference - 1];
  if (reference <= 4 * n) {
    rates(unit->t, 0, unit->y, dy);
    return dy[reference - 2 * n - 1];
  }
  const double* contact = contacts + (n + 2) * (reference - 4 * n - 1);
  return dot(contact, unit->y) - contact[n];
}

enum { variables = 1 + 4 * n + contacts_rows };
#ifdef _WIN32
#define API __declspec(dllexport)
#else
#define API __attribute__((visibility("default")))
#endif
#define ABSENT(name) \
  API int name() { return failed; }
#if FMI == 2
#define NAME(name) fmi2##name
typedef int Boolean;
#else
#define NAME(name) fmi3##name
typedef bool Boolean;
#endif

static void* new_unit(const char* token) {
  if (strcmp(token, "@token@") != 0) return NULL;
  Unit* unit = calloc(1, sizeof *unit);
  if (unit != NULL) begin(unit->t = t0, unit->y);
  return unit;
}
static int values_of(const Unit* unit, const unsigned* references, size_t count, double* values) {
  for (size_t i = 0; i < count; ++i) {
    if (references[i] >= variables) return failed;
    values[i] = value_of(unit, references[i]);
  }
  return ok;
}
static int some(const Unit* unit, unsigned first, size_t wanted, double* values, size_t count) {
  for (unsigned i = 0; i < count && count == wanted; ++i) values[i] = value_of(unit, first + i);
  return count == wanted ? ok : failed;
}
static int start(Unit* unit, double t) { return begin(unit->t = t, unit->y); }
static int step(Unit* unit, double t, double h) {
  if (!(h >= 0.0) || go(unit->t, t + h, unit->y) != ok) return failed;
  unit->t = t + h;
  return ok;
}

API const char* NAME(GetVersion)(void) { return FMI == 2 ? "2.0" : "3.0"; }
API int NAME(SetDebugLogging)(Unit* unit, Boolean on, size_t count, const char* const* names) { return ok; }
API void NAME(FreeInstance)(Unit* unit) { free(unit); }
API int NAME(ExitInitializationMode)(Unit* unit) { return ok; }
API int NAME(Terminate)(Unit* unit) { return ok; }
API int NAME(Reset)(Unit* unit) { return start(unit, t0); }
API int NAME(EnterEventMode)(Unit* unit) { return ok; }
API int NAME(EnterContinuousTimeMode)(Unit* unit) { return ok; }
API int NAME(CompletedIntegratorStep)(Unit* unit, Boolean final, Boolean* event, Boolean* terminate) {
  *event = *terminate = false;
  return ok;
}
API int NAME(SetTime)(Unit* unit, double t) {
  unit->t = t;
  return ok;
}
API int NAME(SetContinuousStates)(Unit* unit, const double* y, size_t count) {
  if (count != 2 * n) return failed;
  memcpy(unit->y, y, sizeof unit->y);
  return ok;
}
API int NAME(GetContinuousStates)(Unit* unit, double* y, size_t count) { return some(unit, 1, 2 * n, y, count); }
API int NAME(GetEventIndicators)(Unit* unit, double* z, size_t count) {
  return some(unit, 4 * n + 1, contacts_rows, z, count);
}
API int NAME(GetNominalsOfContinuousStates)(Unit* unit, double* sizes, size_t count) {
  for (size_t i = 0; i < count; ++i) sizes[i] = 1.0;
  return ok;
}

#if FMI == 2
typedef struct {
  Boolean needed, terminate, nominals_changed, values_changed, has_next;
  double next;
} Event;
API const char* fmi2GetTypesPlatform(void) { return "default"; }
API void* fmi2Instantiate(const char* name, int type, const char* token, const char* resources, const void* functions,
                          Boolean visible, Boolean logging) {
  return new_unit(token);
}
API int fmi2SetupExperiment(Unit* unit, Boolean has_tolerance, double tolerance, double t, Boolean has_end, double end) {
  return start(unit, t);
}
API int fmi2EnterInitializationMode(Unit* unit) { return ok; }
API int fmi2NewDiscreteStates(Unit* unit, Event* event) {
  const int count = impacts(unit->y, unit->y + n, 1e-9);
  *event = (Event){.values_changed = count > 0};
  return count < 0 ? failed : ok;
}
API int fmi2GetReal(Unit* unit, const unsigned* references, size_t count, double* values) {
  return values_of(unit, references, count, values);
}
API int fmi2GetDerivatives(Unit* unit, double* dy, size_t count) { return some(unit, 2 * n + 1, 2 * n, dy, count); }
API int fmi2DoStep(Unit* unit, double t, double h, Boolean final) { return step(unit, t, h); }
API int fmi2GetStatus(Unit* unit, int kind, int* status) { return *status = ok; }
ABSENT(fmi2GetInteger) ABSENT(fmi2GetBoolean) ABSENT(fmi2GetString) ABSENT(fmi2SetReal) ABSENT(fmi2SetInteger)
ABSENT(fmi2SetBoolean) ABSENT(fmi2SetString) ABSENT(fmi2GetFMUstate) ABSENT(fmi2SetFMUstate) ABSENT(fmi2FreeFMUstate)
ABSENT(fmi2SerializedFMUstateSize) ABSENT(fmi2SerializeFMUstate) ABSENT(fmi2DeSerializeFMUstate)
ABSENT(fmi2GetDirectionalDerivative) ABSENT(fmi2SetRealInputDerivatives) ABSENT(fmi2GetRealOutputDerivatives)
ABSENT(fmi2CancelStep) ABSENT(fmi2GetRealStatus) ABSENT(fmi2GetIntegerStatus) ABSENT(fmi2GetBooleanStatus)
ABSENT(fmi2GetStringStatus)
#else
API void* fmi3InstantiateModelExchange(const char* name, const char* token, const char* resources, Boolean visible,
                                       Boolean logging, void* environment, void* log) {
  return new_unit(token);
}
API void* fmi3InstantiateCoSimulation(const char* name, const char* token, const char* resources, Boolean visible,
                                      Boolean logging, Boolean events, Boolean early, const unsigned* required,
                                      size_t count, void* environment, void* log, void* update) {
  return new_unit(token);
}
API void* fmi3InstantiateScheduledExecution() { return NULL; }
API int fmi3EnterInitializationMode(Unit* unit, Boolean has_tolerance, double tolerance, double t, Boolean has_end,
                                    double end) {
  return start(unit, t);
}
API int fmi3UpdateDiscreteStates(Unit* unit, Boolean* needed, Boolean* terminate, Boolean* nominals_changed,
                                 Boolean* values_changed, Boolean* has_next, double* next) {
  const int count = impacts(unit->y, unit->y + n, 1e-9);
  *needed = *terminate = *nominals_changed = *has_next = false;
  *values_changed = count > 0;
  return count < 0 ? failed : ok;
}
API int fmi3GetFloat64(Unit* unit, const unsigned* references, size_t count, double* values, size_t room) {
  return room < count ? failed : values_of(unit, references, count, values);
}
API int fmi3GetContinuousStateDerivatives(Unit* unit, double* dy, size_t count) {
  return some(unit, 2 * n + 1, 2 * n, dy, count);
}
API int fmi3GetNumberOfContinuousStates(Unit* unit, size_t* count) {
  *count = 2 * n;
  return ok;
}
API int fmi3GetNumberOfEventIndicators(Unit* unit, size_t* count) {
  *count = contacts_rows;
  return ok;
}
API int fmi3DoStep(Unit* unit, double t, double h, Boolean final, Boolean* event, Boolean* terminate, Boolean* early,
                   double* reached) {
  *event = *terminate = *early = false;
  const int status = step(unit, t, h);
  *reached = unit->t;
  return status;
}
API int fmi3EnterStepMode(Unit* unit) { return ok; }
API int fmi3EvaluateDiscreteStates(Unit* unit) { return ok; }
ABSENT(fmi3ActivateModelPartition) ABSENT(fmi3DeserializeFMUState) ABSENT(fmi3EnterConfigurationMode)
ABSENT(fmi3ExitConfigurationMode) ABSENT(fmi3FreeFMUState) ABSENT(fmi3GetAdjointDerivative) ABSENT(fmi3GetBinary)
ABSENT(fmi3GetBoolean) ABSENT(fmi3GetClock) ABSENT(fmi3GetDirectionalDerivative) ABSENT(fmi3GetFMUState)
ABSENT(fmi3GetFloat32) ABSENT(fmi3GetInt16) ABSENT(fmi3GetInt32) ABSENT(fmi3GetInt64) ABSENT(fmi3GetInt8)
ABSENT(fmi3GetIntervalDecimal) ABSENT(fmi3GetIntervalFraction) ABSENT(fmi3GetNumberOfVariableDependencies)
ABSENT(fmi3GetOutputDerivatives) ABSENT(fmi3GetShiftDecimal) ABSENT(fmi3GetShiftFraction) ABSENT(fmi3GetString)
ABSENT(fmi3GetUInt16) ABSENT(fmi3GetUInt32) ABSENT(fmi3GetUInt64) ABSENT(fmi3GetUInt8)
ABSENT(fmi3GetVariableDependencies) ABSENT(fmi3SerializeFMUState) ABSENT(fmi3SerializedFMUStateSize)
ABSENT(fmi3SetBinary) ABSENT(fmi3SetBoolean) ABSENT(fmi3SetClock) ABSENT(fmi3SetFMUState) ABSENT(fmi3SetFloat32)
ABSENT(fmi3SetFloat64) ABSENT(fmi3SetInt16) ABSENT(fmi3SetInt32) ABSENT(fmi3SetInt64) ABSENT(fmi3SetInt8)
ABSENT(fmi3SetIntervalDecimal) ABSENT(fmi3SetIntervalFraction) ABSENT(fmi3SetShiftDecimal)
ABSENT(fmi3SetShiftFraction) ABSENT(fmi3SetString) ABSENT(fmi3SetUInt16) ABSENT(fmi3SetUInt32) ABSENT(fmi3SetUInt64)
ABSENT(fmi3SetUInt8)
#endif
)c";

}  // namespace clackers::decks
