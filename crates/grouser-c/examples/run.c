/* Where does a rover come to whose wheels on the right turn faster, and where if it had braked half
 * way? The second run goes on from a state of the first.
 *
 * cc run.c -I ../include -L ../../../target/release -lgrouser_c -o run
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

static void drive(GrouserRun run, double left_rad_s, double right_rad_s) {
  /* The wheels' order is that of the rover's document: front left, rear left, and so on. */
  const double wheel_speed_rad_s[4] = {left_rad_s, left_rad_s, right_rad_s, right_rad_s};
  GrouserOutcome outcome = GROUSER_OUTCOME_UNDER_WAY;
  for (int i = 0; i < 20 && outcome == GROUSER_OUTCOME_UNDER_WAY; i++) {
    check(grouser_run_step(run, 4, wheel_speed_rad_s, 0.1));
    check(grouser_run_outcome(run, &outcome, NULL, 0));
  }
}

static void show(GrouserRun run) {
  GrouserPose pose;
  GrouserWheel wheels[4];
  check(grouser_run_pose(run, &pose));
  check(grouser_run_wheels(run, 4, wheels));
  printf("time_s %.17g\nx_m %.17g\ny_m %.17g\n", pose.time_s, pose.x_m, pose.y_m);
  for (int i = 0; i < 4; i++) {
    printf("slip_ratio %.17g\nload_n %.17g\n", wheels[i].slip_ratio, wheels[i].load_n);
    printf("torque_nm %.17g\n", wheels[i].reaction.torque_nm);
  }
}

int main(void) {
  const char *scenario =
      "schema = \"scenario/1\"\n"
      "name = \"across a slope\"\n"
      "rover = \"hakuto\"\n"
      "soil = \"toyoura\"\n"
      "slope_deg = 10.0\n";
  GrouserRun run;
  GrouserState half_way;

  check(grouser_run_new(scenario, NULL, &run));
  drive(run, 0.5, 0.6);
  check(grouser_run_save(run, &half_way));
  drive(run, 0.5, 0.6);
  show(run);
  check(grouser_run_restore(run, half_way));
  drive(run, 0.1, 0.1);
  show(run);
  check(grouser_state_free(half_way));
  check(grouser_run_free(run));
  return 0;
}
