#include <algorithm>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "core/error.hpp"
#include "simulators/bullet.hpp"
#include "simulators/collision_model.hpp"
#include "simulators/tyres.hpp"

namespace touchdown::simulators {

namespace {

constexpr int robot_group = 1;
constexpr int terrain_group = 2;
/// Bullet rounds the edges of boxes and cylinders by a margin, and grows hulls by it. Rounded boxes
/// leave a groove where they meet.
constexpr double hull_margin = 1e-4;  // m

std::unique_ptr<btCollisionShape> convex_hull(const mjModel& model, int mesh) {
  auto hull = std::make_unique<btConvexHullShape>();
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  for (int i = 0; i < model.mesh_vertnum[mesh]; ++i) {
    hull->addPoint(btVector3(vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]), false);
  }
  hull->setMargin(hull_margin);
  hull->recalcLocalAabb();
  return hull;
}

/// The shape of a geom, in the geom's own frame. Planes become half-spaces, meshes their convex
/// hulls, as in MuJoCo.
std::unique_ptr<btCollisionShape> shape_of(const mjModel& model, int geom) {
  const mjtNum* size = &model.geom_size[3 * geom];
  switch (model.geom_type[geom]) {
    case mjGEOM_PLANE:
      return std::make_unique<btStaticPlaneShape>(btVector3(0.0, 0.0, 1.0), 0.0);
    case mjGEOM_SPHERE:
      return std::make_unique<btSphereShape>(size[0]);
    case mjGEOM_CAPSULE:
      return std::make_unique<btCapsuleShapeZ>(size[0], 2.0 * size[1]);
    case mjGEOM_CYLINDER:
      return std::make_unique<btCylinderShapeZ>(btVector3(size[0], size[0], size[1]));
    case mjGEOM_BOX:
      return std::make_unique<btBoxShape>(btVector3(size[0], size[1], size[2]));
    case mjGEOM_MESH:
      return convex_hull(model, model.geom_dataid[geom]);
    default: {
      const char* name = mj_id2name(&model, mjOBJ_GEOM, geom);
      throw InputError(fmt::format(
          "geom '{}': Bullet has no counterpart of this shape (expected a plane, sphere, capsule, "
          "cylinder, box or mesh)",
          name != nullptr ? name : fmt::format("#{}", geom).c_str()));
    }
  }
}

/// A body's principal inertia frame, in its body frame. Bullet uses it as the frame of the link.
struct InertiaFrame {
  Eigen::Vector3d position;
  Eigen::Quaterniond orientation;
  Eigen::Vector3d inertia;  ///< about its axes (kg·m²)
};

/// Includes the rotor of the body's joint (bullet_simulator.cpp), which changes the principal axes.
InertiaFrame inertia_frame(const mjModel& mj, int body) {
  InertiaFrame frame = {models::vector_at(mj.body_ipos, body),
                        models::quaternion_at(mj.body_iquat, body),
                        models::vector_at(mj.body_inertia, body)};
  const int joint = mj.body_jntadr[body];
  const double rotor = joint < 0 ? 0.0 : mj.dof_armature[mj.jnt_dofadr[joint]];
  if (rotor == 0.0) return frame;
  const Eigen::Vector3d axis = models::vector_at(mj.jnt_axis, joint);
  const Eigen::Matrix3d principal = frame.orientation.toRotationMatrix();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved(
      principal * frame.inertia.asDiagonal() * principal.transpose() +
      rotor * axis * axis.transpose());
  Eigen::Matrix3d axes = solved.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
  frame.orientation = Eigen::Quaterniond(axes);
  frame.inertia = solved.eigenvalues();
  return frame;
}

/// Pose of a geom in the inertia frame of its body.
btTransform geom_in_link(const mjModel& mj, int geom, const InertiaFrame& frame) {
  const Eigen::Quaterniond to_frame = frame.orientation.conjugate();
  return btTransform(to_bullet(to_frame * models::quaternion_at(mj.geom_quat, geom)),
                     to_bullet(to_frame * (models::vector_at(mj.geom_pos, geom) - frame.position)));
}

/// A constraint of a robot's links that is solved with the robot. Bullet asks the linked links'
/// colliders for their island, and never solves constraints of links that have none.
template <typename Constraint>
class InIsland : public Constraint {
 public:
  using Constraint::Constraint;
  int getIslandIdA() const override { return island(*this->m_bodyA); }
  int getIslandIdB() const override { return island(*this->m_bodyA); }

 private:
  static int island(btMultiBody& robot) {
    const btMultiBodyLinkCollider* collider = robot.getBaseCollider();
    for (int link = 0; collider == nullptr && link < robot.getNumLinks(); ++link) {
      collider = robot.getLink(link).m_collider;
    }
    return collider == nullptr ? -1 : collider->getIslandTag();
  }
};

/// Keeps two points of a robot together in the plane of its legs. Hinges cannot close a loop
/// sideways: a third row would press the slightest skew into it.
class PlanarLoop : public InIsland<btMultiBodyPoint2Point> {
 public:
  /// `across`: the plane's two directions in the frame of the base's link.
  PlanarLoop(btMultiBody& robot, const std::array<int, 2>& link, const std::array<btVector3, 2>& at,
             const std::array<btVector3, 2>& across)
      : InIsland(&robot, link[0], &robot, link[1], at[0], at[1]), across_(across) {}

  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override {
    btContactSolverInfo stiff = info;
    stiff.m_erp = stiff.m_erp2 = 0.8;
    const btVector3 first = m_bodyA->localPosToWorld(m_linkA, m_pivotInA);
    const btVector3 second = m_bodyB->localPosToWorld(m_linkB, m_pivotInB);
    const btVector3 zero(0.0, 0.0, 0.0);
    for (std::size_t i = 0; i < across_.size(); ++i) {
      btMultiBodySolverConstraint& row = rows.expandNonInitializing();
      row.m_orgConstraint = this;
      row.m_orgDofIndex = static_cast<int>(i);
      row.m_relpos1CrossNormal = row.m_contactNormal1 = row.m_relpos2CrossNormal = zero;
      row.m_contactNormal2 = row.m_angularComponentA = row.m_angularComponentB = zero;
      row.m_solverBodyIdA = row.m_solverBodyIdB = data.m_fixedBodyId;
      const btVector3 to = -m_bodyA->localDirToWorld(-1, across_[i]);
      fillMultiBodyConstraint(row, data, nullptr, nullptr, zero, to, first, second,
                              (first - second).dot(to), stiff, -m_maxAppliedImpulse,
                              m_maxAppliedImpulse);
    }
  }

 private:
  std::array<btVector3, 2> across_;
};

}  // namespace

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

void BulletWorld::add_constraint(std::unique_ptr<btMultiBodyConstraint> constraint) {
  world_.addMultiBodyConstraint(constraint.get());
  constraints_.push_back(std::move(constraint));
}

template <typename Limit>
void BulletWorld::add_limit(const mjModel& mj, int joint) {
  if (mj.jnt_limited[joint] == 0) return;
  const mjtNum* const range = &mj.jnt_range[2 * joint];
  const double zero = mj.qpos0[mj.jnt_qposadr[joint]];
  add_constraint(
      std::make_unique<Limit>(robot_.get(), link_of(joint), range[0] - zero, range[1] - zero));
}

BulletWorld::BulletWorld(const models::RobotModel& model, const SimulatorOptions& options)
    : edge_radius_(options.contact.bullet_edge_radius),
      dispatcher_(&configuration_),
      tyres_(model, options),
      world_(tyres_, dispatcher_, broadphase_, solver_, configuration_) {
  const mjModel& mj = *model.mj;
  world_.setGravity(to_bullet(models::vector_at(mj.opt.gravity, 0)));
  build_links(model);
  world_.addMultiBody(robot_.get());
  using Limit = btMultiBodyJointLimitConstraint;
  for (const int joint : model.joint) {
    if (joint >= 0) add_limit<Limit>(mj, joint);
  }
  for (const models::HeldJoint& held : model.held) add_limit<Limit>(mj, held.joint);
  add_loops(model);
  add_colliders(model);
  add_terrain(model);
}

BulletWorld::~BulletWorld() {
  for (auto& constraint : constraints_) world_.removeMultiBodyConstraint(constraint.get());
  for (auto& collider : colliders_) world_.removeCollisionObject(collider.get());
  for (auto& body : terrain_) world_.removeRigidBody(body.get());
  world_.removeMultiBody(robot_.get());
}

void BulletWorld::build_links(const models::RobotModel& model) {
  const mjModel& mj = *model.mj;
  // Bodies are sorted parents first; the robot's are those below the base.
  body_of_joint_ = mj.jnt_bodyid;
  link_of_body_.assign(static_cast<std::size_t>(mj.nbody), -2);
  std::vector<int> links;
  for (int body = 1; body < mj.nbody; ++body) {
    if (mj.body_rootid[body] == model.base_body && body != model.base_body) {
      link_of_body_[static_cast<std::size_t>(body)] = static_cast<int>(links.size());
      links.push_back(body);
    }
  }
  link_of_body_[static_cast<std::size_t>(model.base_body)] = -1;

  robot_ = std::make_unique<btMultiBody>(
      static_cast<int>(links.size()), mj.body_mass[model.base_body],
      to_bullet(models::vector_at(mj.body_inertia, model.base_body)), false, false);
  for (const int body : links) {
    const int parent = mj.body_parentid[body];
    const InertiaFrame own = inertia_frame(mj, body);
    const InertiaFrame above = inertia_frame(mj, parent);
    const Eigen::Quaterniond body_in_parent = models::quaternion_at(mj.body_quat, body);
    const Eigen::Quaterniond link_in_parent =
        above.orientation.conjugate() * body_in_parent * own.orientation;
    const int joint = mj.body_jntadr[body];
    const int link = link_of_body_[static_cast<std::size_t>(body)];
    const int link_above = link_of_body_[static_cast<std::size_t>(parent)];
    if (joint < 0) {
      robot_->setupFixed(link, mj.body_mass[body], to_bullet(own.inertia), link_above,
                         to_bullet(link_in_parent.conjugate()),
                         to_bullet(above.orientation.conjugate() *
                                   (models::vector_at(mj.body_pos, body) +
                                    body_in_parent * own.position - above.position)),
                         btVector3(0.0, 0.0, 0.0), true);
      continue;
    }
    const Eigen::Vector3d pivot = models::vector_at(mj.jnt_pos, joint);
    const Eigen::Vector3d axis =
        own.orientation.conjugate() * models::vector_at(mj.jnt_axis, joint);
    const Eigen::Vector3d parent_to_pivot =
        above.orientation.conjugate() *
        (models::vector_at(mj.body_pos, body) + body_in_parent * pivot - above.position);
    const Eigen::Vector3d pivot_to_link = own.orientation.conjugate() * (own.position - pivot);
    robot_->setupRevolute(link, mj.body_mass[body], to_bullet(own.inertia), link_above,
                          to_bullet(link_in_parent.conjugate()), to_bullet(axis),
                          to_bullet(parent_to_pivot), to_bullet(pivot_to_link), true);
  }
  robot_->finalizeMultiDof();
  robot_->setLinearDamping(0.0);
  robot_->setAngularDamping(0.0);
  robot_->setUseGyroTerm(true);
  robot_->setHasSelfCollision(false);
  robot_->setMaxCoordinateVelocity(1e4);
}

void BulletWorld::add_loops(const models::RobotModel& model) {
  const mjModel& mj = *model.mj;
  if (mj.neq == 0) return;
  world_.getSolverInfo().m_numIterations = 50;  // loops close within .1 mm; with 10, within 1 mm
  const Eigen::Matrix3d base = models::quaternion_at(mj.body_iquat, model.base_body).matrix();
  const std::array<btVector3, 2> across = {to_bullet(base.row(0)), to_bullet(base.row(2))};
  for (int loop = 0; loop < mj.neq; ++loop) {
    std::array<int, 2> link = {mj.eq_obj1id[loop], mj.eq_obj2id[loop]};
    std::array<btVector3, 2> at;
    for (std::size_t i = 0; i < 2; ++i) {
      const InertiaFrame frame = inertia_frame(mj, link.at(i));
      const mjtNum* const anchor = &mj.eq_data[mjNEQDATA * loop + 3 * static_cast<int>(i)];
      link.at(i) = link_of_body_[static_cast<std::size_t>(link.at(i))];
      at.at(i) = to_bullet(frame.orientation.conjugate() *
                           (models::vector_at(anchor, 0) - frame.position));
    }
    add_constraint(std::make_unique<PlanarLoop>(*robot_, link, at, across));
  }
  for (const int joint : model.linked) {
    add_limit<InIsland<btMultiBodyJointLimitConstraint>>(mj, joint);
  }
}

void BulletWorld::add_colliders(const models::RobotModel& model) {
  const mjModel& mj = *model.mj;
  for (int body = model.base_body; body < mj.nbody; ++body) {
    const int link = link_of_body_[static_cast<std::size_t>(body)];
    if (link < -1) continue;
    const InertiaFrame frame = inertia_frame(mj, body);
    auto compound = std::make_unique<btCompoundShape>();
    auto collider = std::make_unique<btMultiBodyLinkCollider>(robot_.get(), link);
    std::vector<std::pair<int, std::size_t>> tyre;  // child shapes and their wheel
    for (int geom = mj.body_geomadr[body]; geom < mj.body_geomadr[body] + mj.body_geomnum[body];
         ++geom) {
      if (!collides(mj, geom)) continue;
      if (const auto wheel = wheel_of_tyre(model, geom)) {
        tyre.emplace_back(compound->getNumChildShapes(), *wheel);
      }
      compound->addChildShape(geom_in_link(mj, geom, frame), make_shape(mj, geom));
    }
    if (compound->getNumChildShapes() == 0) continue;
    collider->setCollisionShape(compound.get());
    shapes_.push_back(std::move(compound));
    collider->setFriction(1.0);
    for (const auto& [child, wheel] : tyre) tyres_.add(*collider, child, wheel);
    world_.addCollisionObject(collider.get(), robot_group, terrain_group);
    if (link < 0) {
      robot_->setBaseCollider(collider.get());
    } else {
      robot_->getLink(link).m_collider = collider.get();
    }
    colliders_.push_back(std::move(collider));
  }
}

void BulletWorld::add_terrain(const models::RobotModel& model) {
  const mjModel& mj = *model.mj;
  for (int geom = 0; geom < mj.ngeom; ++geom) {
    if (mj.geom_bodyid[geom] != 0 || !collides(mj, geom)) continue;
    const btRigidBody::btRigidBodyConstructionInfo info(0.0, nullptr, make_shape(mj, geom));
    auto& body = terrain_.emplace_back(std::make_unique<btRigidBody>(info));
    body->setWorldTransform(btTransform(to_bullet(models::quaternion_at(mj.geom_quat, geom)),
                                        to_bullet(models::vector_at(mj.geom_pos, geom))));
    body->setFriction(mj.geom_friction[3 * geom]);
    world_.addRigidBody(body.get(), terrain_group, robot_group);
  }
}

btCollisionShape* BulletWorld::make_shape(const mjModel& mj, int geom) {
  btCollisionShape* shape = shapes_.emplace_back(shape_of(mj, geom)).get();
  const bool has_edges = mj.geom_type[geom] == mjGEOM_BOX || mj.geom_type[geom] == mjGEOM_CYLINDER;
  if (has_edges && edge_radius_ < shape->getMargin()) shape->setMargin(edge_radius_);
  return shape;
}

}  // namespace touchdown::simulators
