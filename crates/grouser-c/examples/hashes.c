/* Digests of ten thousand wheels, of a traverse and of a mission, as examples/hashes.rs makes them by
 * the Rust library: FNV-1a with 64 bits over the bytes of the results, the least significant first.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "grouser.h"

static uint64_t digest;

static void check(GrouserStatus status) {
  if (status != GROUSER_STATUS_OK) {
    fprintf(stderr, "%s\n", grouser_last_error());
    exit(1);
  }
}

static void begin(void) { digest = UINT64_C(0xcbf29ce484222325); }

static void add(double number) {
  uint64_t bits;
  memcpy(&bits, &number, sizeof bits);
  for (int i = 0; i < 8; i++) {
    digest = (digest ^ (bits >> 8 * i & 0xff)) * UINT64_C(0x100000001b3);
  }
}

static void end(const char *name) { printf("%s %016" PRIx64 "\n", name, digest); }

static void add_reaction(const GrouserReaction *reaction) {
  add(reaction->sinkage_m);
  add(reaction->drawbar_pull_n);
  add(reaction->side_force_n);
  add(reaction->normal_force_n);
  add(reaction->torque_nm);
  add(reaction->overturning_moment_nm);
  add(reaction->aligning_moment_nm);
  add(reaction->thrust_n);
  add(reaction->motion_resistance_n);
  add(reaction->side_force_from_shear_n);
  add(reaction->bulldozing_load_n);
  add(reaction->max_normal_stress_pa);
  add(reaction->entry_angle_rad);
  add(reaction->exit_angle_rad);
  add(reaction->max_stress_angle_rad);
}

static void add_pose(const GrouserPose *pose) {
  add(pose->time_s);
  add(pose->x_m);
  add(pose->y_m);
  add(pose->yaw_rad);
  add(pose->velocity_x_m_s);
  add(pose->velocity_y_m_s);
  add(pose->yaw_rate_rad_s);
}

static void wheels(void) {
  enum { COUNT = 10000 };
  static double load_n[COUNT], slip_ratio[COUNT], slip_angle_rad[COUNT];
  static GrouserSettled settled[COUNT];
  GrouserWheelTest test;
  for (int i = 0; i < COUNT; i++) {
    load_n[i] = 2.0 + 0.25 * (i % 100);
    slip_ratio[i] = 0.015625 * (i / 100 % 100 - 50);
    slip_angle_rad[i] = 0.03125 * (i % 37 - 18);
  }
  check(grouser_wheel_test_new("toyoura", "hakuto", NULL, NULL, &test));
  check(grouser_settle(test, COUNT, load_n, slip_ratio, slip_angle_rad, settled));
  check(grouser_wheel_test_free(test));
  begin();
  for (int i = 0; i < COUNT; i++) {
    if (settled[i].carried == GROUSER_CARRIED_YES) {
      add_reaction(&settled[i].reaction);
    } else {
      add(settled[i].capacity_n);
    }
  }
  end("wheels");
}

static void traverse(void) {
  GrouserRun run;
  GrouserPose pose;
  GrouserWheel each[4];
  GrouserOutcome outcome = GROUSER_OUTCOME_UNDER_WAY;
  check(grouser_run_new("schema = \"scenario/1\"\nname = \"traverse\"\n", NULL, &run));
  begin();
  while (outcome == GROUSER_OUTCOME_UNDER_WAY) {
    check(grouser_run_play(run, 0.1));
    check(grouser_run_pose(run, &pose));
    check(grouser_run_wheels(run, 4, each));
    check(grouser_run_outcome(run, &outcome, NULL, 0));
    add_pose(&pose);
    for (int i = 0; i < 4; i++) {
      add(each[i].slip_ratio);
      add(each[i].slip_angle_rad);
      add(each[i].load_n);
      add_reaction(&each[i].reaction);
    }
  }
  check(grouser_run_free(run));
  end("traverse");
}

static void mission(void) {
  GrouserMission mission;
  GrouserLeg leg;
  GrouserPose pose;
  bool driven = true;
  check(grouser_mission_new("there-and-back", NULL, NULL, &mission));
  begin();
  for (;;) {
    check(grouser_mission_next_leg(mission, &leg, &driven));
    if (!driven) {
      break;
    }
    add(leg.distance_m);
    add(leg.duration_s);
    add(leg.motor_energy_j);
  }
  check(grouser_mission_pose(mission, &pose));
  add_pose(&pose);
  check(grouser_mission_free(mission));
  end("mission");
}

int main(void) {
  wheels();
  traverse();
  mission();
  return 0;
}
