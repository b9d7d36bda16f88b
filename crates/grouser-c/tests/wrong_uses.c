/* Wrong uses of the C interface: each ends in its code, and leaves what it had before. Run it under
 * valgrind, too. (NULL and freed handles are what a compiler cannot see.)
 */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "grouser.h"

static int failures = 0;
static int uses = 0;

static void expect(const char *what, GrouserStatus found, GrouserStatus expected, const char *text) {
  uses++;
  if (found != expected || strstr(grouser_last_error(), text) == NULL) {
    failures++;
    printf("%s: code %d, not %d: %s\n", what, (int)found, (int)expected, grouser_last_error());
  }
}

static GrouserWheelTest test;
static GrouserRun shared;
static volatile int is_seen = 0;

static void *step_until_busy(void *unused) {
  const double speeds[4] = {0.5, 0.5, 0.5, 0.5};
  (void)unused;
  while (!is_seen) {
    const GrouserStatus status = grouser_run_step(shared, 4, speeds, 1.0);
    if (status == GROUSER_STATUS_BUSY) {
      is_seen = 1;
    } else if (status != GROUSER_STATUS_OK) {
      is_seen = -1;
    }
  }
  return NULL;
}

static void wrong_documents(void) {
  GrouserRun run;
  GrouserWheelTest other;
  GrouserMission mission;
  expect("no document", grouser_run_new(NULL, NULL, &run), GROUSER_STATUS_NULL_POINTER, "scenario");
  expect("no place for a run", grouser_run_new("schema = \"scenario/1\"\nname = \"a\"\n", NULL, NULL),
         GROUSER_STATUS_NULL_POINTER, "out");
  expect("no such preset", grouser_wheel_test_new("toyura", "hakuto", NULL, NULL, &other),
         GROUSER_STATUS_DOCUMENT, "toyoura");
  expect("an unknown key", grouser_run_new("schema = \"scenario/1\"\nslope = 1.0\n", NULL, &run),
         GROUSER_STATUS_DOCUMENT, "slope");
  expect("another kind", grouser_run_new("schema = \"soil/1\"\n", NULL, &run),
         GROUSER_STATUS_DOCUMENT, "soil/1");
  expect("a change that is none",
         grouser_wheel_test_new("toyoura", "hakuto", NULL, "cohesion", &other),
         GROUSER_STATUS_DOCUMENT, "key=value");
  expect("a change of a document that is not read",
         grouser_wheel_test_new("toyoura", "hakuto", NULL, "rover.body.mass_kg=5", &other),
         GROUSER_STATUS_DOCUMENT, "reads no such document");
  expect("a change of a mission in a run",
         grouser_run_new("schema = \"scenario/1\"\nname = \"a\"\n", "mission.slope_deg=30", &run),
         GROUSER_STATUS_DOCUMENT, "reads no such document");
  expect("not UTF-8", grouser_wheel_test_new("\xff", "hakuto", NULL, NULL, &other),
         GROUSER_STATUS_NOT_UTF8, "soil");
  expect("no such alternative", grouser_mission_new("there-and-back", "by sea", NULL, &mission),
         GROUSER_STATUS_OUT_OF_RANGE, "by sea");
}

static void wrong_numbers(void) {
  const double two[2] = {17.0, NAN};
  const double zeros[2] = {0.0, 0.0};
  const double infinite[2] = {INFINITY, 0.0};
  const double many[2] = {3.0, 0.0};
  const double negative[2] = {-1.0, 0.0};
  const double deep[2] = {1.0, 0.0};
  GrouserSettled settled[2];
  GrouserReaction forces[2];
  settled[0].capacity_n = 42.0;
  expect("a load that is NaN", grouser_settle(test, 2, two, zeros, zeros, settled),
         GROUSER_STATUS_NOT_FINITE, "load_n[1]");
  expect("an infinite slip ratio", grouser_settle(test, 2, zeros, infinite, zeros, settled),
         GROUSER_STATUS_NOT_FINITE, "slip_ratio[0]");
  expect("a slip ratio of 3", grouser_settle(test, 2, zeros, many, zeros, settled),
         GROUSER_STATUS_OUT_OF_RANGE, "slip_ratio[0]");
  expect("a slip angle of 3", grouser_settle(test, 2, zeros, zeros, many, settled),
         GROUSER_STATUS_OUT_OF_RANGE, "slip_angle_rad[0]");
  expect("a negative load", grouser_settle(test, 2, negative, zeros, zeros, settled),
         GROUSER_STATUS_OUT_OF_RANGE, "load_n[0]");
  expect("a sinkage below the axle", grouser_forces(test, 2, deep, zeros, zeros, forces),
         GROUSER_STATUS_OUT_OF_RANGE, "sinkage_m[0]");
  expect("no loads", grouser_settle(test, 2, NULL, zeros, zeros, settled),
         GROUSER_STATUS_NULL_POINTER, "load_n");
  expect("no room", grouser_settle(test, 2, zeros, zeros, zeros, NULL),
         GROUSER_STATUS_NULL_POINTER, "out");
  expect("an endless array", grouser_settle(test, (size_t)-1, zeros, zeros, zeros, settled),
         GROUSER_STATUS_WRONG_SIZE, "more than any memory");
  expect("an array that is not aligned",
         grouser_settle(test, 1, (const double *)((const char *)zeros + 1), zeros, zeros, settled),
         GROUSER_STATUS_WRONG_SIZE, "aligned");
  expect("nothing was written", settled[0].capacity_n == 42.0 ? GROUSER_STATUS_OK : 99,
         GROUSER_STATUS_OK, "");
  expect("no wheels at all", grouser_settle(test, 0, NULL, NULL, NULL, NULL), GROUSER_STATUS_OK, "");
}

static void wrong_runs(void) {
  const double speeds[4] = {0.5, 0.5, 0.5, 0.5};
  const double not_numbers[4] = {0.5, 0.5, 0.5, NAN};
  char name[4];
  GrouserOutcome outcome;
  GrouserWheel wheels[4];
  GrouserState state = {0}, read;
  uint8_t bytes[4] = {0};
  GrouserRun run, steep;
  GrouserPose pose;
  const char *document = "schema = \"scenario/1\"\nname = \"a\"\n";
  expect("a run", grouser_run_new(document, NULL, &run), GROUSER_STATUS_OK, "");
  expect("another", grouser_run_new(document, "scenario.slope_deg=12", &steep), GROUSER_STATUS_OK, "");
  expect("three speeds", grouser_run_step(run, 3, speeds, 0.1), GROUSER_STATUS_WRONG_SIZE, "4");
  expect("a speed that is NaN", grouser_run_step(run, 4, not_numbers, 0.1),
         GROUSER_STATUS_NOT_FINITE, "wheel_speed_rad_s[3]");
  expect("a step of no time", grouser_run_step(run, 4, speeds, 0.0), GROUSER_STATUS_OUT_OF_RANGE,
         "step");
  expect("a step back", grouser_run_play(run, -1.0), GROUSER_STATUS_OUT_OF_RANGE, "duration_s");
  expect("a step that is NaN", grouser_run_step(run, 4, speeds, NAN), GROUSER_STATUS_NOT_FINITE,
         "duration_s");
  expect("room for three wheels", grouser_run_wheels(run, 3, wheels), GROUSER_STATUS_WRONG_SIZE, "4");
  expect("a short buffer", grouser_run_wheel_name(run, 0, name, sizeof name),
         GROUSER_STATUS_WRONG_SIZE, "the text needs");
  expect("a fifth wheel", grouser_run_wheel_name(run, 4, name, sizeof name),
         GROUSER_STATUS_OUT_OF_RANGE, "4 wheels");
  expect("no place for the outcome", grouser_run_outcome(run, NULL, NULL, 0),
         GROUSER_STATUS_NULL_POINTER, "out");
  expect("a reason without a buffer", grouser_run_outcome(run, &outcome, NULL, 10),
         GROUSER_STATUS_NULL_POINTER, "reason");
  expect("a state that never was", grouser_run_restore(run, state), GROUSER_STATUS_BAD_HANDLE,
         "zero");
  expect("a state", grouser_run_save(run, &state), GROUSER_STATUS_OK, "");
  expect("a state of another scenario", grouser_run_restore(steep, state),
         GROUSER_STATUS_OTHER_SCENARIO, "another scenario");
  expect("its size, nowhere", grouser_state_size(state, NULL), GROUSER_STATUS_NULL_POINTER, "out");
  expect("no room for its bytes", grouser_state_write(state, sizeof bytes, bytes),
         GROUSER_STATUS_WRONG_SIZE, "out has 4 entries");
  expect("bytes of no state", grouser_state_read(run, sizeof bytes, bytes, &read),
         GROUSER_STATUS_OUT_OF_RANGE, "damaged");
  expect("no bytes", grouser_state_read(run, 4, NULL, &read), GROUSER_STATUS_NULL_POINTER, "bytes");
  expect("its end", grouser_state_free(state), GROUSER_STATUS_OK, "");
  expect("a freed state", grouser_run_restore(run, state), GROUSER_STATUS_BAD_HANDLE, "freed");
  expect("the run's end", grouser_run_free(run), GROUSER_STATUS_OK, "");
  expect("a freed run", grouser_run_step(run, 4, speeds, 0.1), GROUSER_STATUS_BAD_HANDLE, "freed");
  expect("freed twice", grouser_run_free(run), GROUSER_STATUS_BAD_HANDLE, "freed");
  run.id = steep.id + 12345;
  expect("a number that never was a handle", grouser_run_pose(run, &pose),
         GROUSER_STATUS_BAD_HANDLE, "never");
  run.id = test.id;
  expect("a wheel test as a run", grouser_run_pose(run, &pose), GROUSER_STATUS_BAD_HANDLE, "kind");
  expect("the other's end", grouser_run_free(steep), GROUSER_STATUS_OK, "");
}

static void wrong_steps(void) {
  const GrouserEngineStep step = {2e-3, 9.81}, no_time = {0.0, 9.81}, no_number = {2e-3, NAN};
  const double sinkage[1] = {0.01}, zeros[36] = {0.0};
  GrouserSteppingWheels wheels;
  GrouserStepped stepped[1];
  GrouserWrench wrench[1];
  const GrouserMountedWheel mounted = {{0.0, 1.0, 0.0}, {0.0}, {0.0, 0.0, 1.0}, 0.1, {{0.0}, {0.0}}};
  GrouserMechanismState state = {1, &mounted, 6, zeros, zeros, zeros, false};
  expect("no rest speed", grouser_stepping_wheels_new(1, &test, 5.0, 0.0, &wheels),
         GROUSER_STATUS_OUT_OF_RANGE, "rest_speed_m_s");
  expect("a damping that is NaN", grouser_stepping_wheels_new(1, &test, NAN, 1e-4, &wheels),
         GROUSER_STATUS_NOT_FINITE, "sinkage_damping_s_m");
  expect("wheels", grouser_stepping_wheels_new(1, &test, 5.0, 1e-4, &wheels), GROUSER_STATUS_OK, "");
  expect("two wheels of one", grouser_time_step(wheels, step, 2, sinkage, zeros, zeros, stepped, NULL),
         GROUSER_STATUS_WRONG_SIZE, "1");
  expect("no time", grouser_time_step(wheels, no_time, 1, sinkage, zeros, zeros, stepped, NULL),
         GROUSER_STATUS_OUT_OF_RANGE, "duration_s");
  expect("no gravity", grouser_time_step(wheels, no_number, 1, sinkage, zeros, zeros, stepped, NULL),
         GROUSER_STATUS_NOT_FINITE, "gravity_m_s2");
  expect("no inertia", grouser_mechanism_step(wheels, step, &state, wrench, stepped, NULL),
         GROUSER_STATUS_COMPUTATION, "singular");
  state.velocity_count = (size_t)-1;
  expect("endless velocities", grouser_mechanism_step(wheels, step, &state, wrench, stepped, NULL),
         GROUSER_STATUS_WRONG_SIZE, "velocities");
  expect("no mechanism", grouser_mechanism_step(wheels, step, NULL, wrench, stepped, NULL),
         GROUSER_STATUS_NULL_POINTER, "state");
  expect("their end", grouser_stepping_wheels_free(wheels), GROUSER_STATUS_OK, "");
}

static void wrong_ground(void) {
  const float flat[4] = {0.0f};
  const double hub[3] = {0.0, 0.0, 0.1}, axle[3] = {0.0, 1.0, 0.0}, no_number[3] = {NAN, 0.0, 0.0};
  double normal[3], height[1];
  GrouserGroundField field = {2, 2, flat, 1.0, {1.0, 1.0}, {0.0}, {1.0, 0, 0, 0, 1.0, 0, 0, 0, 1.0}};
  GrouserSteppingWheels wheels;
  GrouserWheelSize size;
  expect("no place for a size", grouser_wheel_test_size(test, NULL), GROUSER_STATUS_NULL_POINTER,
         "out");
  expect("a size", grouser_wheel_test_size(test, &size), GROUSER_STATUS_OK, "");
  expect("wheels", grouser_stepping_wheels_new(1, &test, 5.0, 1e-4, &wheels), GROUSER_STATUS_OK, "");
  expect("a plane", grouser_planes_on_field(wheels, &field, 1, hub, axle, normal, height),
         GROUSER_STATUS_OK, "");
  expect("its height", height[0] == 0.1 && normal[2] == 1.0 ? GROUSER_STATUS_OK : 99,
         GROUSER_STATUS_OK, "");
  expect("no field", grouser_planes_on_field(wheels, NULL, 1, hub, axle, normal, height),
         GROUSER_STATUS_NULL_POINTER, "field");
  expect("planes of two wheels", grouser_planes_on_field(wheels, &field, 2, hub, axle, normal, height),
         GROUSER_STATUS_WRONG_SIZE, "1");
  expect("a hub nowhere", grouser_planes_on_field(wheels, &field, 1, no_number, axle, normal, height),
         GROUSER_STATUS_NOT_FINITE, "hubs_m");
  field.rows = 1;
  expect("a row alone", grouser_planes_on_field(wheels, &field, 1, hub, axle, normal, height),
         GROUSER_STATUS_OUT_OF_RANGE, "two rows");
  field.rows = (size_t)-1;
  expect("endless rows", grouser_planes_on_field(wheels, &field, 1, hub, axle, normal, height),
         GROUSER_STATUS_WRONG_SIZE, "field");
  field.rows = 2;
  field.half_size_m[1] = 0.0;
  expect("a field of no size", grouser_planes_on_field(wheels, &field, 1, hub, axle, normal, height),
         GROUSER_STATUS_OUT_OF_RANGE, "no size");
  field.unit_m = NAN;
  expect("a unit that is NaN", grouser_planes_on_field(wheels, &field, 1, hub, axle, normal, height),
         GROUSER_STATUS_NOT_FINITE, "field");
  expect("their end", grouser_stepping_wheels_free(wheels), GROUSER_STATUS_OK, "");
}

static void two_threads(void) {
  pthread_t threads[2];
  expect("a shared run", grouser_run_new("schema = \"scenario/1\"\nname = \"a\"\n", NULL, &shared),
         GROUSER_STATUS_OK, "");
  for (int i = 0; i < 2; i++) {
    pthread_create(&threads[i], NULL, step_until_busy, NULL);
  }
  for (int i = 0; i < 2; i++) {
    pthread_join(threads[i], NULL);
  }
  expect("two threads on one run", is_seen == 1 ? GROUSER_STATUS_OK : 99, GROUSER_STATUS_OK, "");
  expect("its end", grouser_run_free(shared), GROUSER_STATUS_OK, "");
}

int main(void) {
  expect("a wheel test", grouser_wheel_test_new("toyoura", "hakuto", NULL, NULL, &test),
         GROUSER_STATUS_OK, "");
  wrong_documents();
  wrong_numbers();
  wrong_runs();
  wrong_steps();
  wrong_ground();
  two_threads();
  expect("its end", grouser_wheel_test_free(test), GROUSER_STATUS_OK, "");
  printf("%d uses, %d failures\n", uses, failures);
  return failures != 0;
}
