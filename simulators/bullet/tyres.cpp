#include "simulators/bullet/tyres.hpp"

#include <algorithm>

#include "simulators/tyres.hpp"

namespace touchdown::simulators {

BulletTyres::BulletTyres(const models::RobotModel& robot, const SimulatorOptions& options)
    : springs_(robot.tyre.law == models::Tyre::Law::spring_damper),
      stiffness_(options.contact.bullet_stiffness),
      damping_(options.contact.bullet_damping) {
  if (!springs_) return;
  // Bullet's spring acts at the end of the step, F = k·(δ + h·δ̇) + c·δ̇, which adds damping. The
  // tyre's acts at its beginning, as in MuJoCo, so the added damping is subtracted from the damper.
  const double step = 1e-6 * static_cast<double>(options.steps.physics_us);
  const auto strips = static_cast<double>(robot.tyre.strips().size());
  stiffness_ = robot.tyre.stiffness / strips;
  damping_ = (robot.tyre.damping - step * robot.tyre.stiffness) / strips;
}

void BulletTyres::add(btCollisionObject& collider, int child, std::size_t wheel) {
  strips_.push_back({&collider, child, wheel});
  collider.setContactStiffnessAndDamping(stiffness_, damping_);
}

std::optional<std::size_t> BulletTyres::strip_of(const btCollisionObject& object, int child) const {
  const auto strip = std::find_if(strips_.begin(), strips_.end(), [&](const Strip& s) {
    return s.collider == &object && s.child == child;
  });
  if (strip == strips_.end()) return std::nullopt;
  return static_cast<std::size_t>(strip - strips_.begin());
}

std::optional<std::size_t> BulletTyres::wheel_of(const btCollisionObject& object, int child) const {
  const auto strip = strip_of(object, child);
  return strip ? std::optional(strips_[*strip].wheel) : std::nullopt;
}

void BulletTyres::select_contacts(btDispatcher& dispatcher) const {
  if (!springs_) return;
  std::vector<TyreContact> contacts;
  std::vector<std::pair<btPersistentManifold*, int>> points;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& point = manifold.getContactPoint(p);
      const auto first = strip_of(*manifold.getBody0(), point.m_index0);
      const auto second = strip_of(*manifold.getBody1(), point.m_index1);
      if (!first && !second) continue;
      const btVector3& normal = point.m_normalWorldOnB;
      contacts.push_back(
          {.strip = first ? *first : *second,
           .depth = -point.getDistance(),
           .normal = (first ? 1.0 : -1.0) * Eigen::Vector3d(normal.x(), normal.y(), normal.z())});
      points.emplace_back(&manifold, p);
    }
  }
  const std::vector<bool> counts = counted_contacts(contacts);
  // In reverse order: removing a point moves the manifold's last point into its place.
  for (std::size_t i = points.size(); i-- > 0;) {
    if (!counts[i]) points[i].first->removeContactPoint(points[i].second);
  }
}

void WorldWithTyres::performDiscreteCollisionDetection() {
  btMultiBodyDynamicsWorld::performDiscreteCollisionDetection();
  tyres_.select_contacts(*getDispatcher());
}

}  // namespace touchdown::simulators
