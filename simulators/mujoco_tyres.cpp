#include "simulators/mujoco_tyres.hpp"

#include <cmath>

#include "simulators/tyres.hpp"

namespace touchdown::simulators {

MujocoTyres::MujocoTyres(const models::RobotModel& robot, const mjModel& engine_model)
    : tyre_(robot.tyre),
      share_(1.0 / static_cast<double>(tyre_.strips().size())),
      wheel_of_geom_(static_cast<std::size_t>(engine_model.ngeom)) {
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    for (const int strip : robot.tyre_strips[wheel]) {
      const char* name = mj_id2name(robot.mj.get(), mjOBJ_GEOM, strip);
      const int geom = mj_name2id(&engine_model, mjOBJ_GEOM, name);
      wheel_of_geom_.at(static_cast<std::size_t>(geom)) = wheel;
    }
  }
}

void MujocoTyres::press(mjData& data) const {
  std::vector<TyreContact> contacts;
  std::vector<int> numbers;
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& contact = data.contact[i];
    const bool first = wheel_of(contact.geom1).has_value();
    if (contact.efc_address < 0 || (!first && !wheel_of(contact.geom2))) continue;
    contacts.push_back({.strip = static_cast<std::size_t>(first ? contact.geom1 : contact.geom2),
                        .depth = contact.includemargin - contact.dist,
                        .normal = (first ? -1.0 : 1.0) * models::vector_at(contact.frame, 0)});
    numbers.push_back(i);
  }

  constexpr double softness = 1e3;  // R relative to the inverse mass
  constexpr double none = -1e6;     // N: a pull, which gives no contact force
  const std::vector<bool> counts = counted_contacts(contacts);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    mjContact& contact = data.contact[numbers[i]];
    const int row = contact.efc_address;
    const double pressing_in = -data.efc_vel[row];  // m/s
    const double force =
        share_ * (tyre_.stiffness * contacts[i].depth + tyre_.damping * pressing_in);
    data.efc_R[row] = softness * data.efc_diagApprox[row];
    data.efc_D[row] = 1.0 / data.efc_R[row];
    data.efc_aref[row] = data.efc_R[row] * (counts[i] ? force : none);
    // The friction cone of MuJoCo's solver, scaled by both rows' R.
    contact.mu = contact.friction[0] * std::sqrt(data.efc_R[row + 1] / data.efc_R[row]);
  }
}

}  // namespace touchdown::simulators
