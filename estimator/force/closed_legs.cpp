#include "estimator/force/closed_legs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"

namespace touchdown {

ClosedLegs::ClosedLegs(std::array<MotorLeg, 2> legs) : legs_(std::move(legs)) { reset(); }

void ClosedLegs::reset() noexcept {
  for (std::size_t i = 0; i < legs_.size(); ++i) angles_[i] = legs_[i].linkage.start;
}

void ClosedLegs::convert(std::array<LegSignals, 2>& signals,
                         const Eigen::Vector3d& proper_acceleration) noexcept {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  // The base's x is forward and its z up.
  const Eigen::Vector2d force(-proper_acceleration.x(), -proper_acceleration.z());
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const MotorLeg& leg = legs_[i];
    const Linkage& linkage = leg.linkage;
    const auto count = static_cast<Eigen::Index>(linkage.motors.size());
    std::array<double, 2> angle = {};
    LinkageVector rate(count);
    LinkageVector torque(count);
    bool is_known = true;
    for (Eigen::Index k = 0; k < count; ++k) {
      const JointSignals& motor = k == 0 ? signals[i].hip : signals[i].knee;
      const auto place = static_cast<std::size_t>(k);
      angle.at(place) = leg.sign.at(place) * motor.position + leg.zero.at(place);
      rate[k] = leg.sign.at(place) * motor.velocity;
      torque[k] = leg.sign.at(place) * motor.torque;
      is_known = is_known && std::isfinite(angle.at(place));
    }
    signals[i].hip = signals[i].knee = {unknown, unknown, unknown};
    LinkageVector q = angles_[i];
    const std::span<const double> angles(angle.data(), linkage.motors.size());
    if (!is_known || !move_linkage(linkage, linkage.motors, angles, q)) continue;
    angles_[i] = q;
    const MotorMap map(linkage, q);
    const Eigen::Vector2d rates = map.leg * rate;
    const Eigen::Vector2d torques = map.leg_torques(torque, force);
    signals[i].hip = {q[0], rates[0], torques[0]};
    signals[i].knee = {q[1], rates[1], torques[1]};
  }
}

namespace {

using Eigen::Vector2d;

ModelArray array_of(const std::vector<std::vector<double>>& rows, std::size_t columns) {
  ModelArray array{{rows.size(), columns}, {}};
  for (const std::vector<double>& row : rows) {
    array.data.insert(array.data.end(), row.begin(), row.end());
  }
  return array;
}

void add(ModelArrays& arrays, const std::string& side, const MotorLeg& leg) {
  const Linkage& linkage = leg.linkage;
  const auto add_rows = [&](const char* name, const auto& items, std::size_t columns,
                            const auto& row_of) {
    std::vector<std::vector<double>> rows;
    for (const auto& item : items) rows.push_back(row_of(item));
    arrays[side + name] = array_of(rows, columns);
  };
  add_rows("hinges", linkage.hinges, 5, [](const Linkage::Hinge& h) {
    return std::vector<double>{static_cast<double>(h.above), h.place.x(), h.place.y(), h.sign,
                               h.reference};
  });
  add_rows("loops", linkage.loops, 6, [](const Linkage::Loop& l) {
    return std::vector<double>{
        static_cast<double>(l.first.hinge),  l.first.place.x(),  l.first.place.y(),
        static_cast<double>(l.second.hinge), l.second.place.x(), l.second.place.y()};
  });
  add_rows("masses", linkage.branch, 4, [](const Linkage::Mass& m) {
    return std::vector<double>{m.mass, static_cast<double>(m.centre.hinge), m.centre.place.x(),
                               m.centre.place.y()};
  });
  std::vector<std::vector<double>> motors;
  for (std::size_t i = 0; i < linkage.motors.size(); ++i) {
    motors.push_back({static_cast<double>(linkage.motors[i]), leg.sign.at(i), leg.zero.at(i)});
  }
  arrays[side + "motors"] = array_of(motors, 3);
  arrays[side + "axle"] = array_of(
      {{static_cast<double>(linkage.axle.hinge), linkage.axle.place.x(), linkage.axle.place.y()}},
      3);
  std::vector<std::vector<double>> start;
  for (const double angle : linkage.start) start.push_back({angle});
  arrays[side + "start"] = array_of(start, 1);
}

/// The rows of an array with the hinges that its columns name, all below `hinges`.
class Rows {
 public:
  Rows(const ModelArrays& arrays, const std::string& name, std::size_t columns, std::size_t most)
      : name_(name), array_(arrays.at(name)) {
    const bool is_finite = std::all_of(array_.data.begin(), array_.data.end(),
                                       [](double x) { return std::isfinite(x); });
    if (array_.columns() != columns || array_.rows() > most || !is_finite ||
        array_.data.size() != array_.rows() * columns) {
      throw InputError(name + ": expected at most " + std::to_string(most) + " rows of " +
                       std::to_string(columns) + " finite numbers");
    }
  }
  std::size_t count() const { return array_.rows(); }
  double at(std::size_t row, std::size_t column) const {
    return array_.data[row * array_.columns() + column];
  }
  Vector2d place(std::size_t row, std::size_t column) const {
    return {at(row, column), at(row, column + 1)};
  }
  /// A hinge, or the base (−1) where that is `least`.
  int hinge(std::size_t row, std::size_t column, int least, std::size_t hinges) const {
    const double number = at(row, column);
    if (!(number >= least && number < static_cast<double>(hinges)) ||
        number != std::floor(number)) {
      throw InputError(name_ + ": expected the number of a hinge");
    }
    return static_cast<int>(number);
  }
  Linkage::Point point(std::size_t row, std::size_t column, std::size_t hinges) const {
    return {hinge(row, column, -1, hinges), place(row, column + 1)};
  }

 private:
  std::string name_;
  const ModelArray& array_;
};

MotorLeg leg_of(const ModelArrays& arrays, const std::string& side) {
  MotorLeg leg;
  Linkage& linkage = leg.linkage;
  const Rows hinges(arrays, side + "hinges", 5, most_hinges);
  const std::size_t count = hinges.count();
  for (std::size_t i = 0; i < count; ++i) {
    linkage.hinges.push_back(
        {hinges.hinge(i, 0, -1, i), hinges.place(i, 1), hinges.at(i, 3), hinges.at(i, 4)});
  }
  const Rows loops(arrays, side + "loops", 6, most_loops);
  for (std::size_t i = 0; i < loops.count(); ++i) {
    linkage.loops.push_back({loops.point(i, 0, count), loops.point(i, 3, count)});
  }
  constexpr std::size_t most_masses = 100;
  const Rows masses(arrays, side + "masses", 4, most_masses);
  for (std::size_t i = 0; i < masses.count(); ++i) {
    linkage.branch.push_back({masses.at(i, 0), masses.point(i, 1, count)});
  }
  const Rows motors(arrays, side + "motors", 3, 2);
  for (std::size_t i = 0; i < motors.count(); ++i) {
    linkage.motors.push_back(motors.hinge(i, 0, 0, count));
    leg.sign.at(i) = motors.at(i, 1);
    leg.zero.at(i) = motors.at(i, 2);
  }
  linkage.axle = Rows(arrays, side + "axle", 3, 1).point(0, 0, count);
  const Rows start(arrays, side + "start", 1, most_hinges);
  linkage.start.resize(static_cast<Eigen::Index>(start.count()));
  for (std::size_t i = 0; i < start.count(); ++i) {
    linkage.start[static_cast<Eigen::Index>(i)] = start.at(i, 0);
  }
  if (count < 3 || loops.count() == 0 || start.count() != count || linkage.motors.empty() ||
      mobility(linkage, linkage.start) != static_cast<int>(linkage.motors.size())) {
    throw InputError(side + "hinges: expected a leg with loops that its motors move");
  }
  return leg;
}

}  // namespace

ModelArrays arrays_of(const ClosedLegs& legs) {
  ModelArrays arrays;
  add(arrays, "left_", legs.legs()[0]);
  add(arrays, "right_", legs.legs()[1]);
  return arrays;
}

ClosedLegs closed_legs_of(const ModelArrays& arrays) {
  std::vector<std::string> names;
  for (const char* side : {"left_", "right_"}) {
    for (const char* name : {"hinges", "loops", "masses", "motors", "axle", "start"}) {
      names.push_back(std::string(side) + name);
    }
  }
  require_arrays(arrays, "closed legs", names);
  return ClosedLegs({leg_of(arrays, "left_"), leg_of(arrays, "right_")});
}

}  // namespace touchdown
