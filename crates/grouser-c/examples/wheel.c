/* How deep does a wheel sink under its load, how hard does it pull, and what does it pull at a given
 * sinkage?
 *
 * cc wheel.c -I ../include -L ../../../target/release -lgrouser_c -o wheel
 */
#include <stdio.h>
#include <stdlib.h>

#include "grouser.h"

static void check(GrouserStatus status) {
  if (status != GROUSER_STATUS_OK) {
    fprintf(stderr, "%s\n", grouser_last_error());
    exit(1);
  }
}

int main(void) {
  enum { COUNT = 4 };
  const double load_n[COUNT] = {17.0, 17.0, 17.0, 17.0};
  const double slip_ratio[COUNT] = {0.0, 0.1, 0.2, 0.4};
  const double slip_angle_rad[COUNT] = {0.0, 0.0, 0.1, 0.1};
  const double sinkage_m[COUNT] = {0.01, 0.01, 0.01, 0.01};
  GrouserSettled settled[COUNT];
  GrouserReaction forces[COUNT];
  GrouserWheelTest test;

  check(grouser_wheel_test_new("toyoura", "hakuto", NULL, "soil.cohesion_kpa=0.1", &test));
  check(grouser_settle(test, COUNT, load_n, slip_ratio, slip_angle_rad, settled));
  check(grouser_forces(test, COUNT, sinkage_m, slip_ratio, slip_angle_rad, forces));
  for (size_t i = 0; i < COUNT; i++) {
    if (settled[i].carried != GROUSER_CARRIED_YES) {
      printf("the soil carries %.17g N only\n", settled[i].capacity_n);
      continue;
    }
    printf("sinkage_m %.17g\n", settled[i].reaction.sinkage_m);
    printf("drawbar_pull_n %.17g\n", settled[i].reaction.drawbar_pull_n);
    printf("side_force_n %.17g\n", settled[i].reaction.side_force_n);
    printf("drawbar_pull_n %.17g\n", forces[i].drawbar_pull_n);
  }
  check(grouser_wheel_test_free(test));
  return 0;
}
