/* The C interface of Grouser: how wheeled rovers move on loose soil. Made by cbindgen of
 * crates/grouser-c; do not edit it. The guide is docs/guide/c.md.
 *
 * Units. All numbers are in SI units and radians, each with its unit in its name; ratios have none.
 * Keys of documents have the units in their own names (slope_deg, cohesion_kpa).
 *
 * Errors. Each call returns a GrouserStatus. Where that is not GROUSER_STATUS_OK, nothing was
 * written through its pointers, and grouser_last_error() has a sentence, for each thread its own.
 * What a rover does (it gets stuck, it slides) is no error but a GrouserOutcome. A run that cannot
 * be computed beyond some time stays there.
 *
 * Handles. What a call whose name ends in _new, _copy, _save or _read gives is freed by the call that
 * ends in _free. A handle is a number, not an address: a zero handle, a freed one and one of another kind
 * are GROUSER_STATUS_BAD_HANDLE. Copying the struct does not copy what it stands for.
 *
 * Pointers. A null pointer is GROUSER_STATUS_NULL_POINTER unless the call says otherwise. Any other
 * must point to as much as the call's count says, which no library can check; arrays that are read
 * and arrays that are written must not overlap. A count of zero needs no array.
 *
 * Threads. Calls may be made from any thread at any time. Runs and missions are used by one call at
 * a time: a second one at the same time is GROUSER_STATUS_BUSY and changes nothing. All else is
 * never changed, and is used by any number of threads at once. A handle that is freed while another
 * thread is in a call with it is freed when that call ends.
 *
 * Results depend on the arguments alone, bit for bit, as those of the program and of Python. */


#ifndef GROUSER_H
#define GROUSER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Velocities of a wheel in its frame: of the hub along x, y and z, and of the rim over the shearing
// radius.
#define GROUSER_MOTIONS 4

// Forces on a wheel: along x, y and z, the torque's at the rim (against the rim's motion where it
// drives), and the moments about x and z.
#define GROUSER_FORCES 6

// Default of the sinkage damping [s/m].
#define GROUSER_SINKAGE_DAMPING_S_M 5.0

// Default of the rest speed [m/s].
#define GROUSER_REST_SPEED_M_S 1e-4

// What a call returns. Where it is not GROUSER_STATUS_OK, nothing was written through the call's
// pointers, and grouser_last_error has a sentence.
typedef enum GrouserStatus {
  // The call did what it says.
  GROUSER_STATUS_OK = 0,
  // A pointer is null that must not be.
  GROUSER_STATUS_NULL_POINTER = 1,
  // A handle was freed, is of another kind, or never was one.
  GROUSER_STATUS_BAD_HANDLE = 2,
  // Another thread is in a call with the same run or mission.
  GROUSER_STATUS_BUSY = 3,
  // An array is not as long as it must be, or a buffer is too short.
  GROUSER_STATUS_WRONG_SIZE = 4,
  // A number is NaN or infinite.
  GROUSER_STATUS_NOT_FINITE = 5,
  // A number is outside its range, or numbers do not go together.
  GROUSER_STATUS_OUT_OF_RANGE = 6,
  // A text is not UTF-8.
  GROUSER_STATUS_NOT_UTF8 = 7,
  // A document cannot be read; the text has line and column.
  GROUSER_STATUS_DOCUMENT = 8,
  // A motion cannot be computed.
  GROUSER_STATUS_COMPUTATION = 9,
  // A state or a mission is of another scenario than the run.
  GROUSER_STATUS_OTHER_SCENARIO = 10,
  // A bug in Grouser. The object of the call must be freed; others are as they were.
  GROUSER_STATUS_PANIC = 11,
} GrouserStatus;

// What became of a rover.
typedef enum GrouserOutcome {
  // It is under way.
  GROUSER_OUTCOME_UNDER_WAY = 0,
  // It did what was asked for.
  GROUSER_OUTCOME_COMPLETED = 1,
  // A limit stopped it, or would have on the way ahead; legs of missions only.
  GROUSER_OUTCOME_STOPPED = 2,
  // A turn or an arc did not reach its yaw; legs of missions only.
  GROUSER_OUTCOME_FELL_SHORT = 3,
  // It is stuck.
  GROUSER_OUTCOME_IMMOBILISED = 4,
  // It slides downhill faster than its wheels turn.
  GROUSER_OUTCOME_SLIDING = 5,
  // Its weight fell outside its wheels.
  GROUSER_OUTCOME_TIPPED_OVER = 6,
  // Its battery gave out.
  GROUSER_OUTCOME_BROWN_OUT = 7,
  // A wheel came to where the map has no heights.
  GROUSER_OUTCOME_OFF_THE_MAP = 8,
  // Its underside came to the ground.
  GROUSER_OUTCOME_HIGH_CENTRED = 9,
} GrouserOutcome;

// Whether the soil carries a wheel.
typedef enum GrouserCarried {
  // It does.
  GROUSER_CARRIED_YES = 0,
  // Even sunk to the axle the soil carries less than the wheel's load.
  GROUSER_CARRIED_SUNK_TO_AXLE = 1,
} GrouserCarried;

// Wheels that another engine moves: never changed, so that any number of threads may use them at
// once.
typedef struct GrouserSteppingWheels {
  // The handle's number; 0 is no handle.
  uint64_t id;
} GrouserSteppingWheels;

// A field of heights over x and y of a frame of its own, bilinear between its points; beyond its
// edges it goes on as high as there.
typedef struct GrouserGroundField {
  // Points along x, two or more.
  size_t columns;
  // Points along y, two or more.
  size_t rows;
  // Heights in rows along x, one after the other along y: rows times columns.
  const float *heights;
  // What a height of 1 means.
  double unit_m;
  // Half of its size along x and y.
  double half_size_m[2];
  // Its middle in the world.
  double origin_m[3];
  // Its axes in the world, as columns of a matrix, row by row.
  double axes[9];
} GrouserGroundField;

// A rover on its way through a mission; it is for one thread at a time.
typedef struct GrouserMission {
  // The handle's number; 0 is no handle.
  uint64_t id;
} GrouserMission;

// A leg of a mission that was driven.
typedef struct GrouserLeg {
  // What became of it.
  enum GrouserOutcome outcome;
  // Way over the ground in its manoeuvre.
  double distance_m;
  // How long it took, with a turn before it.
  double duration_s;
  // Work of the motors in that time.
  double motor_energy_j;
  // Slip ratio over the manoeuvre; NaN of turns and waits.
  double slip_ratio;
  // Yaw by which it turned, positive to the left; NaN where no arc or turn was driven.
  double turned_rad;
} GrouserLeg;

// Where a rover is and how it moves. Position and yaw are in the slope frame (x along the contour,
// y uphill), velocities in the body frame (x forward, y to the left).
typedef struct GrouserPose {
  // Time since the start.
  double time_s;
  // Position of the body's centre of mass along the contour, from its start.
  double x_m;
  // The same uphill.
  double y_m;
  // Yaw; positive turns the nose uphill.
  double yaw_rad;
  // Velocity of the body's centre of mass forward.
  double velocity_x_m_s;
  // The same to the left.
  double velocity_y_m_s;
  // Yaw rate.
  double yaw_rate_rad_s;
  // Work of the motors since the start.
  double motor_energy_j;
  // Electrical energy since the start; 0 where no motor is known.
  double electrical_energy_j;
} GrouserPose;

// A rover on its way through a scenario; it is for one thread at a time.
typedef struct GrouserRun {
  // The handle's number; 0 is no handle.
  uint64_t id;
} GrouserRun;

// How a rover stands on ground with heights, or on a suspension; all NaN on a plane without one.
typedef struct GrouserAttitude {
  // Height of the body's centre of mass.
  double height_m;
  // Roll, positive with the right side down.
  double roll_rad;
  // Pitch, positive with the nose up.
  double pitch_rad;
} GrouserAttitude;

// The soil's reaction on a wheel about its hub, in the wheel frame: x forward, y to the left, z
// out of the ground. Angles on the rim are from straight down, positive where the wheel enters the
// soil.
typedef struct GrouserReaction {
  // Sinkage of the grouser tips.
  double sinkage_m;
  // Force along the wheel: thrust less motion resistance.
  double drawbar_pull_n;
  // Force across the wheel, positive to the left.
  double side_force_n;
  // Force out of the ground.
  double normal_force_n;
  // Torque of the drive, positive while it drives the wheel forward.
  double torque_nm;
  // Moment about the wheel's long axis.
  double overturning_moment_nm;
  // Moment about the wheel's upright axis.
  double aligning_moment_nm;
  // Part of the drawbar pull from shear.
  double thrust_n;
  // Part of the drawbar pull from normal stress and bulldozing; it counts negative.
  double motion_resistance_n;
  // Part of the side force from shear.
  double side_force_from_shear_n;
  // Full load of the soil that the side wall pushes aside, before the slip angle's share.
  double bulldozing_load_n;
  // Largest normal stress on the rim.
  double max_normal_stress_pa;
  // Entry angle.
  double entry_angle_rad;
  // Exit angle, not positive.
  double exit_angle_rad;
  // Angle of the largest normal stress.
  double max_stress_angle_rad;
} GrouserReaction;

// A wheel of a rover.
typedef struct GrouserWheel {
  // Angular speed.
  double wheel_speed_rad_s;
  // Steering angle, positive to the left.
  double steering_angle_rad;
  // Slip ratio, positive while the rim outruns the hub.
  double slip_ratio;
  // Slip angle, positive where the hub moves to the left.
  double slip_angle_rad;
  // Load.
  double load_n;
  // Mechanical power of its motor.
  double power_w;
  // Current of its motor; NaN where no motor is known.
  double current_a;
  // Sinkage and the soil's reaction.
  struct GrouserReaction reaction;
} GrouserWheel;

// All that changes in a run, as it was when it was saved: never changed, so that any number of
// threads may use it at once.
typedef struct GrouserState {
  // The handle's number; 0 is no handle.
  uint64_t id;
} GrouserState;

// A wheel on a soil, with a wheel-soil model and a gravity: never changed, so that any number of
// threads may use it at once.
typedef struct GrouserWheelTest {
  // The handle's number; 0 is no handle.
  uint64_t id;
} GrouserWheelTest;

// A step of another engine.
typedef struct GrouserEngineStep {
  // Its length.
  double duration_s;
  // Gravity, which gives the soil its weight.
  double gravity_m_s2;
} GrouserEngineStep;

// A wheel at the end of a time step of another engine.
typedef struct GrouserStepped {
  // Slip ratio at the end of the step.
  double slip_ratio;
  // Slip angle there, positive where the hub moves to the left.
  double slip_angle_rad;
  // The reaction that acts over the step.
  struct GrouserReaction reaction;
} GrouserStepped;

// A force and a moment in the axes of the world.
typedef struct GrouserWrench {
  // Force along x, y and z.
  double force_n[3];
  // Moment about them.
  double moment_nm[3];
} GrouserWrench;

// A wheel that another engine moves, at the end of a preliminary step, in the axes of the world.
typedef struct GrouserMountedWheel {
  // Unit vector along the axle, to the left of a wheel that rolls forward.
  double axle[3];
  // From the centre of mass of the wheel's body to its hub.
  double arm_m[3];
  // Unit normal of the ground under the wheel.
  double normal[3];
  // Distance of the hub from the ground.
  double hub_height_m;
  // What acted on its body about the centre of mass in the preliminary step.
  struct GrouserWrench held;
} GrouserMountedWheel;

// A mechanism at the end of a preliminary step.
typedef struct GrouserMechanismState {
  // How many wheels there are, as many as the handle has.
  size_t wheel_count;
  // The wheels, wheel_count of them.
  const struct GrouserMountedWheel *wheels;
  // How many generalised velocities there are.
  size_t velocity_count;
  // The generalised velocities after the preliminary step.
  const double *velocities;
  // For each wheel how the velocity of its hub, three rows, and its angular velocity, three more,
  // follow from the generalised velocities, in the axes of the world: 6 wheel_count rows of
  // velocity_count.
  const double *jacobians;
  // The inertia that the engine steps with: velocity_count rows of velocity_count.
  const double *inertia;
  // Whether overturning and aligning moments act.
  bool with_moments;
} GrouserMechanismState;

// How large a wheel is.
typedef struct GrouserWheelSize {
  // Radius of the rim, without grousers.
  double rim_radius_m;
  // Radius of the grousers' tips, over which speeds of rims are taken.
  double shearing_radius_m;
  // Width.
  double width_m;
} GrouserWheelSize;

// A wheel that was asked for the sinkage at which the soil carries its load.
typedef struct GrouserSettled {
  // Whether it does.
  enum GrouserCarried carried;
  // The most that the soil carries; NaN of a wheel that it carries.
  double capacity_n;
  // The reaction; all NaN of a wheel that the soil does not carry.
  struct GrouserReaction reaction;
} GrouserSettled;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The plane under each wheel on a field of heights: the least-squares plane through nine points of
// its footprint, as long as its shearing radius and as wide as the wheel.
//
// count: of the wheels, as many as the handle has.
// hubs_m, axles: of each wheel, in the axes of the world, an axle as a unit vector to the left: 3
// count numbers each.
// normals: of the planes, 3 count numbers; hub_heights_m: of the hubs above them, count.
enum GrouserStatus grouser_planes_on_field(struct GrouserSteppingWheels wheels,
                                           const struct GrouserGroundField *field,
                                           size_t count,
                                           const double *hubs_m,
                                           const double *axles,
                                           double *normals,
                                           double *hub_heights_m);

// Makes a mission, at its start.
//
// mission: the name of a preset, the path of a file, or a TOML document.
// alternative: the name of one of its ways; NULL for the first.
// changes: values to change, one "document.key=value" a line; NULL for none.
enum GrouserStatus grouser_mission_new(const char *mission,
                                       const char *alternative,
                                       const char *changes,
                                       struct GrouserMission *out);

// Frees a mission.
enum GrouserStatus grouser_mission_free(struct GrouserMission mission);

// Makes another mission that goes on as this one would, bit for bit: its state saved.
enum GrouserStatus grouser_mission_copy(struct GrouserMission mission, struct GrouserMission *out);

// Drives the next leg, into out.
//
// driven: whether there was one; where there was none, the mission is over and out is left as it
// is.
enum GrouserStatus grouser_mission_next_leg(struct GrouserMission mission,
                                            struct GrouserLeg *out,
                                            bool *driven);

// Where the rover is and how it moves, into out.
enum GrouserStatus grouser_mission_pose(struct GrouserMission mission, struct GrouserPose *out);

// Makes the run of a scenario, at its start.
//
// scenario: the name of a preset, the path of a file, or a TOML document.
// changes: values to change, one "document.key=value" a line; NULL for none.
enum GrouserStatus grouser_run_new(const char *scenario,
                                   const char *changes,
                                   struct GrouserRun *out);

// Frees a run.
enum GrouserStatus grouser_run_free(struct GrouserRun run);

// Makes another run that goes on as this one would, bit for bit.
enum GrouserStatus grouser_run_copy(struct GrouserRun run, struct GrouserRun *out);

// How many wheels the rover has, into out.
enum GrouserStatus grouser_run_wheel_count(struct GrouserRun run, size_t *out);

// The name of a wheel, with its zero, into a buffer of some bytes.
enum GrouserStatus grouser_run_wheel_name(struct GrouserRun run,
                                          size_t wheel,
                                          char *buffer,
                                          size_t bytes);

// Turns the wheels at the given speeds for a while. A rover whose outcome is known stays where it
// is.
//
// wheel_count: as many as the rover has; wheel_speed_rad_s: a speed for each.
// duration_s: from 1e-6 to 86400.
enum GrouserStatus grouser_run_step(struct GrouserRun run,
                                    size_t wheel_count,
                                    const double *wheel_speed_rad_s,
                                    double duration_s);

// Turns the wheels as the scenario's drive says for a while, at most to the end of the scenario.
// The drive is asked at the start of the call and after each 0.1 s: durations that are multiples of
// it lead where one call to the end does.
//
// duration_s: from 1e-6 to 86400.
enum GrouserStatus grouser_run_play(struct GrouserRun run, double duration_s);

// Where the rover is and how it moves, into out.
enum GrouserStatus grouser_run_pose(struct GrouserRun run, struct GrouserPose *out);

// How the rover stands on ground with heights, or on a suspension, into out.
enum GrouserStatus grouser_run_attitude(struct GrouserRun run, struct GrouserAttitude *out);

// The wheels of the rover, into out, an array of wheel_count, as many as the rover has. All numbers
// are NaN where the rover has just tipped over or sunk.
enum GrouserStatus grouser_run_wheels(struct GrouserRun run,
                                      size_t wheel_count,
                                      struct GrouserWheel *out);

// What became of the rover, into out, and why with its zero, into a buffer of some bytes; NULL and
// 0 if that is not wanted. A rover under way, and one that did what was asked for, have no reason.
enum GrouserStatus grouser_run_outcome(struct GrouserRun run,
                                       enum GrouserOutcome *out,
                                       char *reason,
                                       size_t bytes);

// Saves all that changes in a run, into out.
enum GrouserStatus grouser_run_save(struct GrouserRun run, struct GrouserState *out);

// Sets a run to a saved state, from which it goes on as the saved one did, bit for bit. The state
// may be that of another run of the same scenario, and may be used again.
enum GrouserStatus grouser_run_restore(struct GrouserRun run, struct GrouserState state);

// How many bytes a saved state has, into out.
enum GrouserStatus grouser_state_size(struct GrouserState state, size_t *out);

// Writes a saved state as bytes, for files and other processes, into out, an array of size, as many
// as grouser_state_size says. The same version of Grouser reads them.
enum GrouserStatus grouser_state_write(struct GrouserState state, size_t size, uint8_t *out);

// Reads a state that grouser_state_write wrote, into out: one of the run's scenario, which is the
// caller's to see to; another number of wheels is an error, as damaged bytes are.
//
// size: of the array bytes.
enum GrouserStatus grouser_state_read(struct GrouserRun run,
                                      size_t size,
                                      const uint8_t *bytes,
                                      struct GrouserState *out);

// Frees a saved state.
enum GrouserStatus grouser_state_free(struct GrouserState state);

// A sentence about the last call of this thread that failed; empty before one did. It is valid
// until the next call of this thread that fails, and is not to be freed.
const char *grouser_last_error(void);

// The version of the library, such as "0.1.0"; not to be freed.
const char *grouser_version(void);

// Makes wheels that another engine moves, one for each wheel test, whose gravity does not count
// here. The wheel tests may be freed.
//
// sinkage_damping_s_m: zero or more, usually GROUSER_SINKAGE_DAMPING_S_M.
// rest_speed_m_s: below it stresses fade; above zero, usually GROUSER_REST_SPEED_M_S.
enum GrouserStatus grouser_stepping_wheels_new(size_t count,
                                               const struct GrouserWheelTest *tests,
                                               double sinkage_damping_s_m,
                                               double rest_speed_m_s,
                                               struct GrouserSteppingWheels *out);

// Frees wheels that another engine moves.
enum GrouserStatus grouser_stepping_wheels_free(struct GrouserSteppingWheels wheels);

// The reaction over a step on wheels that a mechanism couples, from the mechanism's response.
//
// count: of the wheels, as many as the handle has.
// sinkage_m: of each wheel at the start of the step; negative above the ground.
// inverse_mass: how forces change velocities, in 1/kg (of moments in 1/(kg m)): row by row, a row
// for each of the 4 count velocities (GROUSER_MOTIONS), a column for each of the 6 count forces
// (GROUSER_FORCES).
// free_m_s: the 4 count velocities at the end of the step without the soil.
// out: the wheels, count of them.
// residual_m_s: how far velocities and forces are from each other; NULL if not wanted.
enum GrouserStatus grouser_time_step(struct GrouserSteppingWheels wheels,
                                     struct GrouserEngineStep step,
                                     size_t count,
                                     const double *sinkage_m,
                                     const double *inverse_mass,
                                     const double *free_m_s,
                                     struct GrouserStepped *out,
                                     double *residual_m_s);

// The reaction over a step on the wheels of a mechanism, from its Jacobians and inertia; as
// wrenches on the wheels' bodies about their centres of mass, in the axes of the world.
//
// wrenches, out: of each wheel; residual_m_s as in grouser_time_step.
enum GrouserStatus grouser_mechanism_step(struct GrouserSteppingWheels wheels,
                                          struct GrouserEngineStep step,
                                          const struct GrouserMechanismState *state,
                                          struct GrouserWrench *wrenches,
                                          struct GrouserStepped *out,
                                          double *residual_m_s);

// Makes a wheel test.
//
// soil, wheel: each the name of a preset, the path of a file, or a TOML document.
// setting: a scenario that gives gravity, and a wheel-soil model where it names one; NULL for the
// Earth and the soil's own model.
// changes: values to change, one "document.key=value" a line; NULL for none.
enum GrouserStatus grouser_wheel_test_new(const char *soil,
                                          const char *wheel,
                                          const char *setting,
                                          const char *changes,
                                          struct GrouserWheelTest *out);

// Frees a wheel test.
enum GrouserStatus grouser_wheel_test_free(struct GrouserWheelTest test);

// How large the wheel is, into out.
enum GrouserStatus grouser_wheel_test_size(struct GrouserWheelTest test,
                                           struct GrouserWheelSize *out);

// The sinkages at which wheels carry their loads, and the forces there.
//
// load_n (0 to 1e5), slip_ratio (-2 to 2), slip_angle_rad (-pi/2 to pi/2), out: arrays of count.
// A wheel that the soil does not carry is no error: its entry says so. Up to 63 wheels settle
// without allocating memory.
enum GrouserStatus grouser_settle(struct GrouserWheelTest test,
                                  size_t count,
                                  const double *load_n,
                                  const double *slip_ratio,
                                  const double *slip_angle_rad,
                                  struct GrouserSettled *out);

// The soil's reaction on wheels at given sinkages.
//
// sinkage_m (0 to the shearing radius), slip_ratio, slip_angle_rad as in grouser_settle, out:
// arrays of count. Up to 63 wheels are computed without allocating memory.
enum GrouserStatus grouser_forces(struct GrouserWheelTest test,
                                  size_t count,
                                  const double *sinkage_m,
                                  const double *slip_ratio,
                                  const double *slip_angle_rad,
                                  struct GrouserReaction *out);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* GROUSER_H */
