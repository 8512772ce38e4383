#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "models/robot_draft.hpp"
#include "models/robot_source.hpp"

namespace touchdown::models {

namespace {

using Eigen::Vector3d;

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// 1 if a name is a left one's and the other the right one's, −1 for the opposite, else 0.
int side_by_names(const std::string& first, const std::string& second) {
  const std::string a = lower_case(first);
  const std::string b = lower_case(second);
  const auto [at, other] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (at == a.end() || other == b.end()) return 0;
  if (*at == 'l' && *other == 'r') return 1;
  return *at == 'r' && *other == 'l' ? -1 : 0;
}

class LegSearch {
 public:
  LegSearch(const mjModel& model, const mjData& data, int base)
      : model_(model), data_(data), base_(base) {}

  FoundLegs legs() {
    find_axles();
    set_sides();
    for (std::size_t side = 0; side < wheel_count; ++side) find_pitch(side);
    if (legs_.pitch[0].size() != legs_.pitch[1].size()) {
      throw InputError("expected as many hinges parallel to the axles in both legs");
    }
    if (legs_.pitch[0].empty()) {
      throw InputError(
          fmt::format("expected a knee: a hinge parallel to the axle between the base and '{}'",
                      joint_name(legs_.axle[0].joint)));
    }
    select_hip_and_knee();
    return legs_;
  }

 private:
  std::string joint_name(int joint) const { return name_of(model_, mjOBJ_JOINT, joint); }
  Vector3d axis(int joint) const { return vector_at(data_.xaxis, joint); }
  Vector3d anchor(int joint) const { return vector_at(data_.xanchor, joint); }

  /// Whether this joint moves what another one moves.
  bool moves(int joint, int other) const {
    return is_below(model_, model_.jnt_bodyid[other], model_.jnt_bodyid[joint]);
  }

  bool is_leaf(int joint) const {
    for (int other = 0; other < model_.njnt; ++other) {
      if (other != joint && moves(joint, other)) return false;
    }
    return true;
  }

  /// The radius of a geom that is round about a joint's axis; 0 for any other.
  double round_radius(int geom, int joint) const {
    const Vector3d along = axis(joint);
    const Vector3d place = vector_at(data_.geom_xpos, geom);
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> turn(
        &data_.geom_xmat[9 * geom]);
    const auto off_axis = [&](const Vector3d& point) {
      return along.cross(point - anchor(joint)).norm();
    };
    double radius = model_.geom_size[3 * geom];
    const int type = model_.geom_type[geom];
    if (type == mjGEOM_MESH) {
      const int mesh = model_.geom_dataid[geom];
      // Round: as far from the axis in each of twelve sectors.
      constexpr std::size_t sectors = 12;
      std::array<double, sectors> farthest = {};
      const Vector3d across = along.unitOrthogonal();
      for (int i = 0; i < model_.mesh_vertnum[mesh]; ++i) {
        const float* const vertex = &model_.mesh_vert[3 * (model_.mesh_vertadr[mesh] + i)];
        const Vector3d from =
            place + turn * Vector3d(vertex[0], vertex[1], vertex[2]) - anchor(joint);
        const double angle =
            std::atan2(along.cross(across).dot(from), across.dot(from)) / (2.0 * M_PI) + 0.5;
        double& far = farthest.at(
            std::min<std::size_t>(sectors - 1, static_cast<std::size_t>(sectors * angle)));
        far = std::max(far, along.cross(from).norm());
      }
      const auto [least, most] = std::minmax_element(farthest.begin(), farthest.end());
      return *least > 0.9 * *most ? *most : 0.0;
    }
    const bool is_round =
        type == mjGEOM_SPHERE || ((type == mjGEOM_CYLINDER || type == mjGEOM_CAPSULE) &&
                                  std::abs(turn.col(2).dot(along)) > parallel);
    return is_round && off_axis(place) < 0.1 * radius ? radius : 0.0;
  }

  /// A hinge with its largest round body. Colliders count before what is only drawn.
  Axle axle_of(int joint) const {
    Axle axle;
    axle.joint = joint;
    std::vector<int> largest;
    for (const bool is_mesh : {false, true}) {
      for (int geom = 0; geom < model_.ngeom; ++geom) {
        const int body = model_.geom_bodyid[geom];
        if ((model_.geom_type[geom] == mjGEOM_MESH) != is_mesh) continue;
        if (!is_below(model_, body, model_.jnt_bodyid[joint])) continue;
        if (!is_mesh && model_.geom_contype[geom] == 0 && model_.geom_conaffinity[geom] == 0) {
          continue;
        }
        const double radius = round_radius(geom, joint);
        if (radius <= 0.0 || radius < axle.radius) continue;
        if (radius > axle.radius) largest.clear();
        axle.radius = radius;
        largest.push_back(geom);
      }
      axle.is_mesh = is_mesh && axle.radius > 0.0;
      if (axle.radius > 0.0) break;
    }
    if (axle.is_mesh || largest.empty()) return axle;
    axle.tyre = name_of(model_, mjOBJ_GEOM, largest[0]);
    if (axle.tyre.empty() && largest.size() == 1) {
      axle.tyre = name_of(model_, mjOBJ_BODY, model_.geom_bodyid[largest[0]]);
    }
    return axle;
  }

  /// How much two hinges are like wheels; −∞ if they cannot be. A wheel may lack its mesh.
  double likeness(const Axle& a, const Axle& b) const {
    const Vector3d between = anchor(b.joint) - anchor(a.joint);
    const double distance = between.norm();
    const bool are_side_by_side = std::abs(axis(a.joint).dot(axis(b.joint))) > parallel &&
                                  std::abs(axis(a.joint).z()) < 0.25 && distance > 0.02 &&
                                  std::abs(between.dot(axis(a.joint))) > 0.9 * distance;
    const bool are_measured = a.radius > 0.0 && b.radius > 0.0;
    if (!are_side_by_side || (are_measured && std::abs(a.radius - b.radius) > 0.05 * a.radius)) {
      return -HUGE_VAL;
    }
    double likeness = 0.0;
    for (const Axle& axle : {a, b}) {
      const int body = model_.jnt_bodyid[axle.joint];
      const std::string names = joint_name(axle.joint) + " " + name_of(model_, mjOBJ_BODY, body);
      if (has_part(names, "wheel") || has_part(names, "tire") || has_part(names, "tyre")) {
        likeness += 2.0;
      }
      if (axle.radius > 0.0) likeness += axle.is_mesh ? 1.0 : 2.0;
      if (model_.jnt_limited[axle.joint] == 0) likeness += 1.0;
      likeness -= anchor(axle.joint).z();  // m
    }
    return likeness;
  }

  void find_axles() {
    std::vector<Axle> axles;
    for (int joint = 0; joint < model_.njnt; ++joint) {
      if (model_.jnt_type[joint] != mjJNT_HINGE || !is_leaf(joint)) continue;
      if (model_.body_rootid[model_.jnt_bodyid[joint]] == base_) axles.push_back(axle_of(joint));
    }
    double most = -HUGE_VAL;
    for (std::size_t i = 0; i < axles.size(); ++i) {
      for (std::size_t k = i + 1; k < axles.size(); ++k) {
        const double likeness_of_both = likeness(axles[i], axles[k]);
        if (likeness_of_both <= most) continue;
        most = likeness_of_both;
        legs_.axle = {axles[i], axles[k]};
      }
    }
    if (most == -HUGE_VAL) {
      throw InputError(
          "expected two wheels: hinges side by side with one axis, which move no other joint");
    }
  }

  void set_sides() {
    const Vector3d first = anchor(legs_.axle[0].joint);
    const Vector3d second = anchor(legs_.axle[1].joint);
    const int by_names =
        side_by_names(joint_name(legs_.axle[0].joint), joint_name(legs_.axle[1].joint));
    legs_.has_sides = by_names != 0;
    const Vector3d between = second - first;
    // A base with wheels side by side along x is taken to face y.
    const bool is_along_y = std::abs(between.y()) > std::abs(between.x());
    const bool swap =
        legs_.has_sides ? by_names < 0 : (is_along_y ? between.y() > 0.0 : between.x() < 0.0);
    if (swap) std::swap(legs_.axle[0], legs_.axle[1]);
  }

  void find_pitch(std::size_t side) {
    const int wheel = legs_.axle[side].joint;
    for (int body = model_.body_parentid[model_.jnt_bodyid[wheel]]; body != base_ && body > 0;
         body = model_.body_parentid[body]) {
      for (int i = model_.body_jntnum[body] - 1; i >= 0; --i) {
        const int joint = model_.body_jntadr[body] + i;
        if (model_.jnt_type[joint] == mjJNT_HINGE &&
            std::abs(axis(joint).dot(axis(wheel))) > parallel) {
          legs_.pitch[side].insert(legs_.pitch[side].begin(), joint);
        }
      }
    }
  }

  /// Keeps the two hinges of each leg with the longest shorter link.
  void select_hip_and_knee() {
    const std::vector<int> all = legs_.pitch[0];
    if (all.size() <= 2) return;
    const auto length = [&](int from, int to) { return (anchor(to) - anchor(from)).norm(); };
    std::array<std::size_t, 2> best = {0, 1};
    double longest = -1.0;
    for (std::size_t hip = 0; hip < all.size(); ++hip) {
      for (std::size_t knee = hip + 1; knee < all.size(); ++knee) {
        const double shorter =
            std::min(length(all[hip], all[knee]), length(all[knee], legs_.axle[0].joint));
        if (shorter <= longest) continue;
        longest = shorter;
        best = {hip, knee};
      }
    }
    for (std::vector<int>& pitch : legs_.pitch) pitch = {pitch[best[0]], pitch[best[1]]};
  }

  const mjModel& model_;
  const mjData& data_;
  int base_;
  FoundLegs legs_;
};

/// Whether a point is near a link of a leg, seen from the side, and abreast of one of its joints.
bool is_beside(const mjData& data, const std::vector<int>& leg, const Vector3d& point) {
  const Vector3d along = vector_at(data.xaxis, leg.back());
  double length = 0.0;
  double nearest = HUGE_VAL;
  double abreast = std::abs(along.dot(point - vector_at(data.xanchor, leg.back())));
  for (std::size_t i = 0; i + 1 < leg.size(); ++i) {
    const Vector3d from = vector_at(data.xanchor, leg[i]);
    const Vector3d link = along.cross(vector_at(data.xanchor, leg[i + 1]) - from);
    const Vector3d off = along.cross(point - from);
    const double share = std::clamp(off.dot(link) / link.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (off - share * link).norm());
    abreast = std::min(abreast, std::abs(along.dot(point - from)));
    length += link.norm();
  }
  constexpr double near = 0.2;  // of the leg's length
  return std::max(nearest, abreast) < near * length;
}

}  // namespace

bool is_rod(const mjModel& model, const mjData& data, const JointsOfLegs& legs, int joint) {
  const auto moves = [&](int one, int other) {
    return is_below(model, model.jnt_bodyid[other], model.jnt_bodyid[one]);
  };
  const auto moves_wheel = [&](int one) {
    return moves(one, legs[0].back()) || moves(one, legs[1].back());
  };
  if (moves_wheel(joint)) return false;
  for (const std::vector<int>& leg : legs) {
    const Vector3d along = vector_at(data.xaxis, leg.back());
    if (std::abs(along.dot(vector_at(data.xaxis, joint))) <= parallel) continue;
    if (moves(leg.front(), joint)) return true;
    for (int other = 0; other < model.njnt; ++other) {
      const bool is_in_chain = moves(joint, other) || moves(other, joint);
      if (!is_in_chain || moves_wheel(other)) continue;
      // A link ends as far beyond its centre of mass as its hinge is before it.
      const Vector3d end =
          2.0 * vector_at(data.xipos, model.jnt_bodyid[other]) - vector_at(data.xanchor, other);
      if (is_beside(data, leg, end)) return true;
    }
  }
  return false;
}

bool has_part(std::string_view text, std::string_view part) {
  return lower_case(std::string(text)).find(part) != std::string::npos;
}

FoundLegs find_legs(const mjModel& model, const mjData& data, int base) {
  return LegSearch(model, data, base).legs();
}

}  // namespace touchdown::models
