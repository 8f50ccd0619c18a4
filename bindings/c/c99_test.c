/* Calls every function of clackers.h from C99; prints what is wrong and ends with 1 then. */
#include <clackers.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

static void expect(int condition, const char* what) {
  if (condition) return;
  ++failures;
  fprintf(stderr, "not so: %s (last error: %s)\n", what, clackers_last_error());
}
#define EXPECT(condition) expect((condition), #condition)

static void ask(const clackers_motion* motion) {
  const double times[] = {0.0, 1.0};
  double u[4], v[4], a[4], end = 0.0, period = 0.0;
  const clackers_buffers out = {sizeof out, 4, u, v, a};
  clackers_impact impact = {sizeof impact, 0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  clackers_constant constant = {sizeof constant, NULL, NULL, NULL, 0.0};
  int32_t dof = 0;
  int64_t impacts = 0;
  size_t constants = 0, contacts = 0, springs = 0, frictions = 0;

  EXPECT(clackers_motion_dof(motion, &dof) == CLACKERS_OK && dof == 2);
  EXPECT(clackers_motion_end(motion, &end) == CLACKERS_OK && end == 20.0);
  EXPECT(clackers_motion_sample(motion, times, 2, CLACKERS_RIGHT, &out) == CLACKERS_OK);
  EXPECT(u[0] == 1.0);
  EXPECT(clackers_motion_envelope(motion, 0.0, &out) == CLACKERS_OK && u[0] == 1.0);
  EXPECT(clackers_motion_error_bound(motion, 0.0, &out) == CLACKERS_OK && u[0] < 1e-15);
  EXPECT(clackers_motion_impact_count(motion, end, &impacts) == CLACKERS_OK && impacts == 6);
  EXPECT(clackers_motion_impact(motion, 1, &impact, &out, &out) == CLACKERS_OK && u[0] == 0.0);
  EXPECT(impact.index == 1 && impact.t_lo <= impact.t && impact.t <= impact.t_hi);
  EXPECT(clackers_motion_force_count(motion, &contacts, &springs, &frictions) == CLACKERS_OK);
  EXPECT(contacts == 1 && springs == 0 && frictions == 0);
  EXPECT(clackers_motion_forces(motion, 1.0, CLACKERS_LEFT, 1, u) == CLACKERS_OK && u[0] == 0.0);
  EXPECT(clackers_motion_constant_count(motion, &constants) == CLACKERS_OK && constants > 10);
  EXPECT(clackers_motion_constant_at(motion, 0, &constant) == CLACKERS_OK);
  EXPECT(constant.name != NULL && strcmp(constant.name, "m1") == 0 && constant.value == 1.0);
  EXPECT(clackers_motion_constant(motion, "T", &period) == CLACKERS_OK && period > 3.0);
}

int main(void) {
  clackers_pair pair;
  clackers_motion* motion = NULL;
  const clackers_setting settings[] = {{"N", 2.0}, {"xi1", 0.05}};
  double limit = 0.0, margin = 0.0;

  EXPECT(clackers_version()[0] == '0');
  EXPECT(clackers_case_name(0) != NULL);
  EXPECT(clackers_admissibility(9.0, 3.0, &limit, &margin) == CLACKERS_OK);
  EXPECT(limit > 3.0 && margin > 0.0);

  pair.struct_size = sizeof pair;
  EXPECT(clackers_pair_defaults(&pair) == CLACKERS_OK);
  EXPECT(clackers_pair_create(&pair, &motion) == CLACKERS_OK);
  if (motion != NULL) ask(motion);
  clackers_motion_destroy(motion);
  motion = NULL;

  EXPECT(clackers_case_create("three-parameter", settings, 2, &motion) == CLACKERS_OK);
  if (motion != NULL) ask(motion);
  clackers_motion_destroy(motion);

  pair.t_end = NAN;
  EXPECT(clackers_pair_create(&pair, &motion) == CLACKERS_REFUSED);
  EXPECT(strlen(clackers_last_error()) > 0 && strlen(clackers_last_error_code()) > 0);
  return failures == 0 ? 0 : 1;
}
