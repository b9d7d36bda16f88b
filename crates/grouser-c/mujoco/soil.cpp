/* A plugin of MuJoCo's engine: loose soil under the wheels of a model, wherever the engine steps it.
 * docs/guide/mujoco.md says how to build it, what a model needs, and what it has as state.
 *
 * It is a passive force by name. In each step it makes a preliminary step in a copy of the data, has
 * the library compute the forces at the end of the step, and writes them into the wheels' rows of
 * xfrc_applied, which the engine reads after its passive forces.
 */
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "grouser.h"

namespace {

constexpr char kName[] = "grouser.soil";

/* What an instance is given. */
constexpr const char* kAttributes[] = {
    "soil",    "wheel",         "wheels",               "ground",
    "model",   "changes",       "wheel_moments",        "sinkage_damping_s_m",
    "rest_speed_m_s",           "check_sizes",
};
constexpr int kAttributeCount = sizeof kAttributes / sizeof *kAttributes;

/* What the plugin's state has of each wheel: the wrench on its body over the last step, and how the
 * wheel was at its end. */
enum { kWrench = 0, kSinkage = 6, kSlipRatio, kSlipAngle, kPull, kSideForce, kNormalForce, kTorque,
       kPerWheel };

/* The state of the engine on which a step depends. */
constexpr int kStepState = mjSTATE_INTEGRATION;

[[noreturn]] void refuse(const char* format, ...) {
  char text[1000];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  throw std::runtime_error(text);
}

void check(GrouserStatus status) {
  if (status != GROUSER_STATUS_OK) {
    throw std::runtime_error(grouser_last_error());
  }
}

std::string attribute(const mjModel* m, int instance, const char* name, const char* usual = "") {
  const char* given = mj_getPluginConfig(m, instance, name);
  return given && *given ? given : usual;
}

double number(const mjModel* m, int instance, const char* name, double usual) {
  const std::string text = attribute(m, instance, name);
  char* end = nullptr;
  const double value = text.empty() ? usual : std::strtod(text.c_str(), &end);
  if (!text.empty() && *end != '\0') {
    refuse("%s is \"%s\", it must be a number", name, text.c_str());
  }
  return value;
}

bool choice(const mjModel* m, int instance, const char* name, const char* yes, const char* no) {
  const std::string text = attribute(m, instance, name, yes);
  if (text != yes && text != no) {
    refuse("%s is \"%s\", it must be \"%s\" or \"%s\"", name, text.c_str(), yes, no);
  }
  return text == yes;
}

std::vector<std::string> words(const mjModel* m, int instance, const char* name) {
  std::istringstream text(attribute(m, instance, name));
  return {std::istream_iterator<std::string>(text), {}};
}

/* The words of an attribute that has one for all wheels, or one for each. */
std::vector<std::string> one_each(const mjModel* m, int instance, const char* name, size_t count) {
  auto found = words(m, instance, name);
  if (found.size() == 1) {
    found.resize(count, found.front());
  }
  if (found.size() != count) {
    refuse("%s names %zu for %zu wheels", name, found.size(), count);
  }
  return found;
}

/* The hinge on which the body of a wheel turns. */
int hinge_of(const mjModel* m, const std::string& name) {
  const int body = mj_name2id(m, mjOBJ_BODY, name.c_str());
  if (body < 0) {
    refuse("the model has no body \"%s\" for a wheel", name.c_str());
  }
  const int joint = m->body_jntadr[body];
  if (m->body_jntnum[body] != 1 || m->jnt_type[joint] != mjJNT_HINGE) {
    refuse("the wheel \"%s\" must turn on one hinge and no other", name.c_str());
  }
  return joint;
}

/* The geom of the world that is a plane or a height field. */
int ground_of(const mjModel* m, const std::string& name) {
  const int geom = mj_name2id(m, mjOBJ_GEOM, name.c_str());
  if (geom < 0) {
    refuse("the model has no geom \"%s\" for a ground", name.c_str());
  }
  if (m->geom_type[geom] != mjGEOM_PLANE && m->geom_type[geom] != mjGEOM_HFIELD) {
    refuse("the ground \"%s\" is neither a plane nor a height field", name.c_str());
  }
  if (m->body_weldid[m->geom_bodyid[geom]] != 0) {
    refuse("the ground \"%s\" moves: it must be part of the world", name.c_str());
  }
  return geom;
}

bool is_pair(const mjModel* m, int one, int other) {
  for (int pair = 0; pair < m->npair; pair++) {
    const int first = m->pair_geom1[pair], second = m->pair_geom2[pair];
    if ((first == one && second == other) || (first == other && second == one)) {
      return true;
    }
  }
  return false;
}

bool is_excluded(const mjModel* m, int one, int other) {
  const int signature = (std::min(one, other) << 16) + std::max(one, other);
  for (int exclude = 0; exclude < m->nexclude; exclude++) {
    if (m->exclude_signature[exclude] == signature) {
      return true;
    }
  }
  return false;
}

/* Checks that MuJoCo's own contact between a wheel and the ground is off. */
void check_contact_is_off(const mjModel* m, int body, const std::string& wheel, int ground) {
  for (int k = 0; k < m->body_geomnum[body]; k++) {
    const int geom = m->body_geomadr[body] + k;
    const bool touches = (m->geom_contype[geom] & m->geom_conaffinity[ground]) != 0 ||
                         (m->geom_contype[ground] & m->geom_conaffinity[geom]) != 0;
    const bool is_off = !touches || is_excluded(m, body, m->geom_bodyid[ground]);
    if (!is_off || is_pair(m, geom, ground)) {
      refuse("MuJoCo's own contact between the wheel \"%s\" and the ground is on: give the geoms of "
             "the wheel contype=\"0\" conaffinity=\"0\", or exclude the pair", wheel.c_str());
    }
  }
}

/* How far a geom reaches from its middle along a direction in its own axes. */
double support(const mjModel* m, int geom, const double u[3]) {
  const double* size = m->geom_size + 3 * geom;
  switch (m->geom_type[geom]) {
    case mjGEOM_SPHERE:
      return size[0];
    case mjGEOM_CAPSULE:
      return size[0] + size[1] * std::abs(u[2]);
    case mjGEOM_ELLIPSOID:
      return std::hypot(size[0] * u[0], size[1] * u[1], size[2] * u[2]);
    case mjGEOM_CYLINDER:
      return size[0] * std::hypot(u[0], u[1]) + size[1] * std::abs(u[2]);
    case mjGEOM_BOX:
      return size[0] * std::abs(u[0]) + size[1] * std::abs(u[1]) + size[2] * std::abs(u[2]);
    default:
      break;
  }
  double most = 0.0;
  if (m->geom_type[geom] == mjGEOM_MESH) {
    const int mesh = m->geom_dataid[geom];
    for (int k = 0; k < m->mesh_vertnum[mesh]; k++) {
      const float* point = m->mesh_vert + 3 * (m->mesh_vertadr[mesh] + k);
      most = std::max(most, point[0] * u[0] + point[1] * u[1] + point[2] * u[2]);
    }
  }
  return most;
}

/* The same from a hinge, in the axes of the body. */
double reach(const mjModel* m, int geom, int hinge, const double u[3]) {
  double own[3], inverse[4], from[3];
  mju_negQuat(inverse, m->geom_quat + 4 * geom);
  mju_rotVecQuat(own, u, inverse);
  mju_sub3(from, m->geom_pos + 3 * geom, m->jnt_pos + 3 * hinge);
  return mju_dot3(from, u) + support(m, geom, own);
}

/* How far a geom reaches from a wheel's axle, in all directions across it. */
double radius_about(const mjModel* m, int geom, int hinge) {
  constexpr int kDirections = 64;
  const double* axle = m->jnt_axis + 3 * hinge;
  const double any[3] = {std::abs(axle[0]) < 0.9 ? 1.0 : 0.0, std::abs(axle[0]) < 0.9 ? 0.0 : 1.0, 0.0};
  double across[3], aside[3], most = 0.0;
  mju_cross(across, axle, any);
  mju_normalize3(across);
  mju_cross(aside, axle, across);
  for (int k = 0; k < kDirections; k++) {
    const double angle = 2.0 * mjPI * k / kDirections;
    double u[3];
    for (int axis = 0; axis < 3; axis++) {
      u[axis] = std::cos(angle) * across[axis] + std::sin(angle) * aside[axis];
    }
    most = std::max(most, reach(m, geom, hinge, u));
  }
  return most;
}

/* Checks the geom of a wheel's body that reaches furthest from the axle, as far as it has edges. */
void check_size(const mjModel* m, int hinge, const std::string& name, const GrouserWheelSize& size) {
  /* For polygons and rounded numbers. */
  constexpr double kTolerance = 0.02;
  const int body = m->jnt_bodyid[hinge];
  int widest = -1;
  double radius = 0.0;
  for (int k = 0; k < m->body_geomnum[body]; k++) {
    const int geom = m->body_geomadr[body] + k;
    const double found = radius_about(m, geom, hinge);
    if (found > radius) {
      widest = geom;
      radius = found;
    }
  }
  if (widest < 0) {
    return;
  }
  const char* way_out = "give the model's wheel, or check_sizes \"off\" if the geoms are not to scale";
  if (radius < size.rim_radius_m * (1.0 - kTolerance) ||
      radius > size.shearing_radius_m * (1.0 + kTolerance)) {
    refuse("the geoms of \"%s\" have a radius of %.4g m, the wheel one of %.4g m (%.4g m with its "
           "grousers): %s", name.c_str(), radius, size.rim_radius_m, size.shearing_radius_m, way_out);
  }
  const int type = m->geom_type[widest];
  const double* axle = m->jnt_axis + 3 * hinge;
  const double back[3] = {-axle[0], -axle[1], -axle[2]};
  const double width = reach(m, widest, hinge, axle) + reach(m, widest, hinge, back);
  const bool is_round = type == mjGEOM_SPHERE || type == mjGEOM_CAPSULE || type == mjGEOM_ELLIPSOID;
  if (!is_round && std::abs(width - size.width_m) > kTolerance * size.width_m) {
    refuse("the geoms of \"%s\" have a width of %.4g m, the wheel one of %.4g m: %s", name.c_str(),
           width, size.width_m, way_out);
  }
}

/* What is freed with its owner. */
template <typename Handle, GrouserStatus (*free)(Handle)>
struct Owned {
  Handle handle = {0};

  Owned() = default;
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() { free(handle); }
};

using OwnedTest = Owned<GrouserWheelTest, grouser_wheel_test_free>;
using OwnedWheels = Owned<GrouserSteppingWheels, grouser_stepping_wheels_free>;

struct DeleteData {
  void operator()(mjData* d) const { mj_deleteData(d); }
};

/* The soil under the wheels of some data. */
class Soil {
 public:
  Soil(const mjModel* m, int instance);

  void apply(const mjModel* m, mjData* d, const double* state);
  void advance(double* state) const;

 private:
  void read_wheels(const mjModel* m, int instance);
  void step_ahead(const mjModel* m, const mjData* d, const double* state);
  void look_at_ground(const mjModel* m);
  void take_inertia(const mjModel* m);

  OwnedWheels wheels_;
  int ground_;
  bool with_moments_;
  std::vector<int> hinges_, bodies_;
  std::unique_ptr<mjData, DeleteData> ahead_;
  std::vector<double> state_, hubs_, axles_, normals_, heights_, jacobians_, inertia_;
  std::vector<GrouserMountedWheel> mounted_;
  std::vector<GrouserWrench> wrenches_;
  std::vector<GrouserStepped> stepped_;
};

/* The copies in which preliminary steps are made have no soil of their own. */
thread_local bool makes_copy = false;

Soil::Soil(const mjModel* m, int instance) {
  for (int other = 0; other < instance; other++) {
    if (m->plugin[other] == m->plugin[instance]) {
      refuse("there are two instances of %s: one may have all wheels of a model", kName);
    }
  }
  if (m->opt.integrator == mjINT_RK4) {
    refuse("the model's integrator is RK4, it must be Euler, implicit or implicitfast");
  }
  ground_ = ground_of(m, attribute(m, instance, "ground"));
  with_moments_ = choice(m, instance, "wheel_moments", "included", "neglected");
  read_wheels(m, instance);
  const size_t count = hinges_.size(), nv = m->nv;
  hubs_.resize(3 * count);
  axles_.resize(3 * count);
  normals_.resize(3 * count);
  heights_.resize(count);
  jacobians_.resize(6 * count * nv);
  inertia_.resize(nv * nv);
  mounted_.resize(count);
  wrenches_.resize(count);
  stepped_.resize(count);
}

void Soil::read_wheels(const mjModel* m, int instance) {
  const bool checks_sizes = choice(m, instance, "check_sizes", "on", "off");
  const auto names = words(m, instance, "wheels");
  const size_t count = names.size();
  if (count == 0) {
    refuse("there are no wheels");
  }
  const auto soils = one_each(m, instance, "soil", count);
  const auto kinds = one_each(m, instance, "wheel", count);
  const std::string model = attribute(m, instance, "model");
  const std::string setting = "schema = \"scenario/1\"\nname = \"plugin\"\nmodel = \"" + model + "\"\n";
  std::string changes = attribute(m, instance, "changes");
  for (char& character : changes) {
    character = character == ';' ? '\n' : character;
  }
  std::vector<OwnedTest> owned(count);
  std::vector<GrouserWheelTest> tests;
  for (size_t k = 0; k < count; k++) {
    const int hinge = hinge_of(m, names[k]);
    hinges_.push_back(hinge);
    bodies_.push_back(m->jnt_bodyid[hinge]);
    check_contact_is_off(m, bodies_[k], names[k], ground_);
    GrouserWheelTest& test = owned[k].handle;
    GrouserWheelSize size;
    check(grouser_wheel_test_new(soils[k].c_str(), kinds[k].c_str(),
                                 model.empty() ? nullptr : setting.c_str(),
                                 changes.empty() ? nullptr : changes.c_str(), &test));
    tests.push_back(test);
    check(grouser_wheel_test_size(test, &size));
    if (checks_sizes) {
      check_size(m, hinge, names[k], size);
    }
  }
  check(grouser_stepping_wheels_new(
      count, tests.data(),
      number(m, instance, "sinkage_damping_s_m", GROUSER_SINKAGE_DAMPING_S_M),
      number(m, instance, "rest_speed_m_s", GROUSER_REST_SPEED_M_S), &wheels_.handle));
}

/* Writes the forces over the coming step. */
void Soil::apply(const mjModel* m, mjData* d, const double* state) {
  step_ahead(m, d, state);
  look_at_ground(m);
  const size_t count = hinges_.size(), nv = m->nv;
  for (size_t k = 0; k < count; k++) {
    double* rows = jacobians_.data() + 6 * k * nv;
    mj_jac(m, ahead_.get(), rows, rows + 3 * nv, hubs_.data() + 3 * k, bodies_[k]);
    GrouserMountedWheel& wheel = mounted_[k];
    const double* held = ahead_->xfrc_applied + 6 * bodies_[k];
    mju_copy3(wheel.axle, axles_.data() + 3 * k);
    mju_sub3(wheel.arm_m, hubs_.data() + 3 * k, ahead_->xipos + 3 * bodies_[k]);
    mju_copy3(wheel.normal, normals_.data() + 3 * k);
    wheel.hub_height_m = heights_[k];
    mju_copy3(wheel.held.force_n, held);
    mju_copy3(wheel.held.moment_nm, held + 3);
  }
  take_inertia(m);
  const GrouserMechanismState mechanism = {
      count, mounted_.data(), nv, ahead_->qvel, jacobians_.data(), inertia_.data(), with_moments_};
  const GrouserEngineStep step = {m->opt.timestep, mju_norm3(m->opt.gravity)};
  check(grouser_mechanism_step(wheels_.handle, step, &mechanism, wrenches_.data(), stepped_.data(), nullptr));
  for (size_t k = 0; k < count; k++) {
    mju_copy3(d->xfrc_applied + 6 * bodies_[k], wrenches_[k].force_n);
    mju_copy3(d->xfrc_applied + 6 * bodies_[k] + 3, wrenches_[k].moment_nm);
  }
}

/* Makes the preliminary step, with the forces of the step before. */
void Soil::step_ahead(const mjModel* m, const mjData* d, const double* state) {
  if (!ahead_) {
    makes_copy = true;
    ahead_.reset(mj_makeData(m));
    makes_copy = false;
    state_.resize(mj_stateSize(m, kStepState));
  }
  mj_getState(m, d, state_.data(), kStepState);
  mj_setState(m, ahead_.get(), state_.data(), kStepState);
  for (size_t k = 0; k < bodies_.size(); k++) {
    mju_copy(ahead_->xfrc_applied + 6 * bodies_[k], state + kPerWheel * k + kWrench, 6);
  }
  mj_step(m, ahead_.get());
  for (size_t k = 0; k < hinges_.size(); k++) {
    mju_copy3(hubs_.data() + 3 * k, ahead_->xanchor + 3 * hinges_[k]);
    mju_copy3(axles_.data() + 3 * k, ahead_->xaxis + 3 * hinges_[k]);
  }
}

/* The plane under each wheel. */
void Soil::look_at_ground(const mjModel* m) {
  const double* at = ahead_->geom_xpos + 3 * ground_;
  const double* axes = ahead_->geom_xmat + 9 * ground_;
  if (m->geom_type[ground_] == mjGEOM_PLANE) {
    const double normal[3] = {axes[2], axes[5], axes[8]};
    for (size_t k = 0; k < heights_.size(); k++) {
      double from[3];
      mju_sub3(from, hubs_.data() + 3 * k, at);
      heights_[k] = from[0] * normal[0] + from[1] * normal[1] + from[2] * normal[2];
      mju_copy3(normals_.data() + 3 * k, normal);
    }
    return;
  }
  const int field = m->geom_dataid[ground_];
  const double* size = m->hfield_size + 4 * field;
  GrouserGroundField read = {};
  read.columns = m->hfield_ncol[field];
  read.rows = m->hfield_nrow[field];
  read.heights = m->hfield_data + m->hfield_adr[field];
  read.unit_m = size[2];
  read.half_size_m[0] = size[0];
  read.half_size_m[1] = size[1];
  mju_copy3(read.origin_m, at);
  mju_copy(read.axes, axes, 9);
  check(grouser_planes_on_field(wheels_.handle, &read, heights_.size(), hubs_.data(), axles_.data(),
                                normals_.data(), heights_.data()));
}

/* The inertia that the integrator steps with: less the derivatives, times the step, of the forces
 * that it takes at the step's end. */
void Soil::take_inertia(const mjModel* m) {
  const int nv = m->nv;
  const double duration = m->opt.timestep;
#if mjVERSION_HEADER >= 4000000
  mj_fullM(m, ahead_.get(), inertia_.data());
#else
  mj_fullM(m, inertia_.data(), ahead_->qM);
#endif
  if (m->opt.integrator != mjINT_EULER) {
    for (int row = 0; row < nv; row++) {
      for (int k = m->D_rowadr[row]; k < m->D_rowadr[row] + m->D_rownnz[row]; k++) {
        inertia_[static_cast<size_t>(row) * nv + m->D_colind[k]] -= duration * ahead_->qDeriv[k];
      }
    }
  } else if (!(m->opt.disableflags & mjDSBL_EULERDAMP)) {
    for (int row = 0; row < nv; row++) {
      inertia_[static_cast<size_t>(row) * (nv + 1)] += duration * m->dof_damping[row];
    }
  }
}

/* Keeps what acted over the step that is done. */
void Soil::advance(double* state) const {
  for (size_t k = 0; k < stepped_.size(); k++) {
    double* own = state + kPerWheel * k;
    const GrouserStepped& wheel = stepped_[k];
    mju_copy3(own + kWrench, wrenches_[k].force_n);
    mju_copy3(own + kWrench + 3, wrenches_[k].moment_nm);
    own[kSinkage] = wheel.reaction.sinkage_m;
    own[kSlipRatio] = wheel.slip_ratio;
    own[kSlipAngle] = wheel.slip_angle_rad;
    own[kPull] = wheel.reaction.drawbar_pull_n;
    own[kSideForce] = wheel.reaction.side_force_n;
    own[kNormalForce] = wheel.reaction.normal_force_n;
    own[kTorque] = wheel.reaction.torque_nm;
  }
}

Soil* soil_of(const mjData* d, int instance) {
  return reinterpret_cast<Soil*>(d->plugin_data[instance]);
}

int state_size(const mjModel* m, int instance) {
  return kPerWheel * static_cast<int>(words(m, instance, "wheels").size());
}

int init(const mjModel* m, mjData* d, int instance) {
  d->plugin_data[instance] = 0;
  if (makes_copy) {
    return 0;
  }
  try {
    d->plugin_data[instance] = reinterpret_cast<uintptr_t>(new Soil(m, instance));
    return 0;
  } catch (const std::exception& error) {
    mju_warning("%s: %s", kName, error.what());
    return -1;
  }
}

void destroy(mjData* d, int instance) {
  delete soil_of(d, instance);
  d->plugin_data[instance] = 0;
}

void reset(const mjModel* m, mjtNum* state, void*, int instance) {
  mju_zero(state, state_size(m, instance));
}

void compute(const mjModel* m, mjData* d, int instance, int) {
  char text[1000] = "";
  if (Soil* soil = soil_of(d, instance)) {
    try {
      soil->apply(m, d, d->plugin_state + m->plugin_stateadr[instance]);
      return;
    } catch (const std::exception& error) {
      std::snprintf(text, sizeof text, "%s", error.what());
    }
    /* It does not return, so that nothing of ours may be left to be destroyed. */
    mju_error("%s: %s", kName, text);
  }
}

void advance(const mjModel* m, mjData* d, int instance) {
  if (const Soil* soil = soil_of(d, instance)) {
    soil->advance(d->plugin_state + m->plugin_stateadr[instance]);
  }
}

}  // namespace

mjPLUGIN_LIB_INIT(grouser_soil) {
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = kName;
  plugin.nattribute = kAttributeCount;
  plugin.attributes = kAttributes;
  plugin.capabilityflags = mjPLUGIN_PASSIVE;
  plugin.nstate = state_size;
  plugin.init = init;
  plugin.destroy = destroy;
  plugin.reset = reset;
  plugin.compute = compute;
  plugin.advance = advance;
  mjp_registerPlugin(&plugin);
}
