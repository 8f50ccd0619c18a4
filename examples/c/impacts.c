/*
 * Prints the impacts of a pair of masses, exact to the last digit.
 *
 *     cc impacts.c $(pkg-config --cflags --libs clackers) -o impacts && ./impacts
 */
#include <clackers.h>
#include <stdio.h>

static int complain(void) {
  fprintf(stderr, "%s [%s]\n", clackers_last_error(), clackers_last_error_code());
  return 1;
}

int main(void) {
  clackers_pair pair;
  clackers_motion* motion = NULL;
  int64_t count = 0;
  int64_t k;

  pair.struct_size = sizeof pair;
  if (clackers_pair_defaults(&pair) != CLACKERS_OK) return complain();
  pair.X = 5.0;    /* mass 2 is five times as fast */
  pair.eta = 0.75; /* and loses a quarter of its closing speed at each impact */
  if (clackers_pair_create(&pair, &motion) != CLACKERS_OK) return complain();
  if (clackers_motion_impact_count(motion, pair.t_end, &count) != CLACKERS_OK) return complain();

  printf("Clackers %s\n", clackers_version());
  for (k = 1; k <= count; ++k) {
    clackers_impact impact;
    double u[2], v_before[2], v_after[2];
    const clackers_buffers before = {sizeof before, 2, u, v_before, NULL};
    const clackers_buffers after = {sizeof after, 2, u, v_after, NULL};
    impact.struct_size = sizeof impact;
    if (clackers_motion_impact(motion, k, &impact, &before, &after) != CLACKERS_OK)
      return complain();
    printf("%d  t = %.17g s  v1 = %+.6f -> %+.6f m/s  v2 = %+.6f -> %+.6f m/s\n", (int)k, impact.t,
           v_before[0], v_after[0], v_before[1], v_after[1]);
  }
  clackers_motion_destroy(motion);
  return 0;
}
