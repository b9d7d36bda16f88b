// What does each leg of a mission come to? In C++ a handle is freed by its destructor, and a code is
// an exception.
//
// c++ -std=c++17 mission.cpp -I ../include -L ../../../target/release -lgrouser_c -o mission
#include <cstdio>
#include <stdexcept>

#include "grouser.h"

namespace {

void check(GrouserStatus status) {
  if (status != GROUSER_STATUS_OK) {
    throw std::runtime_error(grouser_last_error());
  }
}

class Mission {
 public:
  explicit Mission(const char *document) {
    check(grouser_mission_new(document, nullptr, nullptr, &handle_));
  }
  Mission(const Mission &) = delete;
  Mission &operator=(const Mission &) = delete;
  ~Mission() { grouser_mission_free(handle_); }

  bool next_leg(GrouserLeg &leg) {
    bool driven = false;
    check(grouser_mission_next_leg(handle_, &leg, &driven));
    return driven;
  }

  GrouserPose pose() const {
    GrouserPose pose;
    check(grouser_mission_pose(handle_, &pose));
    return pose;
  }

 private:
  GrouserMission handle_{};
};

}  // namespace

int main() {
  try {
    Mission mission("there-and-back");
    GrouserLeg leg;
    while (mission.next_leg(leg)) {
      std::printf("distance_m %.17g\nmotor_energy_j %.17g\n", leg.distance_m, leg.motor_energy_j);
    }
    const GrouserPose pose = mission.pose();
    std::printf("time_s %.17g\nx_m %.17g\ny_m %.17g\n", pose.time_s, pose.x_m, pose.y_m);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
