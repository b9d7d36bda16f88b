/* Which forces does the soil put on a wheel of 1.7 kg that another engine drags along, step by step?
 * Here the engine is a few lines: a locked wheel, whose hub moves along x, y and z.
 *
 * cc time_step.c -I ../include -L ../../../target/release -lgrouser_c -o time_step
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
  const double mass_kg = 1.7;
  const GrouserEngineStep step = {.duration_s = 2e-3, .gravity_m_s2 = 9.81};
  double inverse_mass[GROUSER_MOTIONS * GROUSER_FORCES] = {0.0};
  double velocity_m_s[3] = {0.05, 0.0, 0.0};
  double sinkage_m = 0.01;
  GrouserWheelTest test;
  GrouserSteppingWheels wheels;
  GrouserStepped stepped;

  for (int i = 0; i < 3; i++) {
    inverse_mass[i * GROUSER_FORCES + i] = 1.0 / mass_kg;
  }
  check(grouser_wheel_test_new("toyoura", "hakuto", NULL, NULL, &test));
  check(grouser_stepping_wheels_new(1, &test, GROUSER_SINKAGE_DAMPING_S_M, GROUSER_REST_SPEED_M_S,
                                    &wheels));
  check(grouser_wheel_test_free(test));
  for (int i = 0; i < 50; i++) {
    const double free_m_s[GROUSER_MOTIONS] = {
        0.05, velocity_m_s[1], velocity_m_s[2] - step.gravity_m_s2 * step.duration_s, 0.0};
    check(grouser_time_step(wheels, step, 1, &sinkage_m, inverse_mass, free_m_s, &stepped, NULL));
    const double force_n[3] = {stepped.reaction.drawbar_pull_n, stepped.reaction.side_force_n,
                               stepped.reaction.normal_force_n};
    for (int k = 0; k < 3; k++) {
      velocity_m_s[k] = free_m_s[k] + step.duration_s * force_n[k] / mass_kg;
    }
    sinkage_m = stepped.reaction.sinkage_m;
  }
  printf("sinkage_m %.17g\n", sinkage_m);
  printf("drawbar_pull_n %.17g\n", stepped.reaction.drawbar_pull_n);
  printf("normal_force_n %.17g\n", stepped.reaction.normal_force_n);
  check(grouser_stepping_wheels_free(wheels));
  return 0;
}
