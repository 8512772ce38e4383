#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace touchdown {

// No leg has more hinges or loop equations: nothing below is allocated per step.
using LinkageVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1>;
using LinkageMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;
/// One column per hinge or motor.
using LinkageRows = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor, 2, 8>;

/// A leg with closed loops, such as a five-bar, seen from the side: x forward, z up, in the base
/// frame (m). All hinges turn about the base's y axis. Places are those of the pose in which the
/// hinges are at their references.
///
/// The first two hinges are hip and knee of the chain that carries the wheel. This virtual leg has
/// all that a serial leg has, but its joints need no motors: one or two hinges of the leg have.
struct Linkage {
  struct Hinge {
    int above = -1;  ///< the hinge that moves it; −1: fixed to the base
    Eigen::Vector2d place;
    double sign = 1.0;       ///< 1: turns about +y; −1: about −y
    double reference = 0.0;  ///< rad
  };
  /// A point that moves with a hinge, or with the base (−1).
  struct Point {
    int hinge = -1;
    Eigen::Vector2d place;
  };
  /// Two points that are one.
  struct Loop {
    Point first, second;
  };
  /// The centre of mass of a body.
  struct Mass {
    double mass = 0.0;  ///< kg
    Point centre;
  };

  std::vector<Hinge> hinges;  ///< each after the one above it
  std::vector<Loop> loops;
  std::vector<int> motors;   ///< hinges with a motor: one or two
  std::vector<Mass> branch;  ///< bodies off the virtual leg
  Point axle;
  LinkageVector start;  ///< angles with closed loops, near the references (rad)

  auto size() const { return static_cast<Eigen::Index>(hinges.size()); }
};

inline constexpr std::size_t most_hinges = 8;
inline constexpr std::size_t most_loops = 4;

/// Where a linkage is at the hinges' angles q (rad).
class LinkagePose {
 public:
  LinkagePose(const Linkage& linkage, const LinkageVector& q);

  Eigen::Vector2d place(const Linkage::Point& point) const;
  /// Velocity of a point per angular velocity of each hinge (m/rad).
  LinkageRows jacobian(const Linkage::Point& point) const;
  /// x and z between the two points of each loop (m), and their derivatives by q.
  LinkageVector gaps() const;
  LinkageMatrix gaps_by_hinge() const;

 private:
  struct Frame {
    double angle = 0.0;
    Eigen::Vector2d place;
  };
  const Linkage& linkage_;
  std::array<Frame, most_hinges> frames_;
};

/// Moves a linkage with closed loops until the kept hinges have these angles (rad), by Newton's
/// method in small steps: the linkage stays on its branch. Returns whether its loops closed there;
/// `q` is unchanged if not.
bool move_linkage(const Linkage& linkage, std::span<const int> kept, std::span<const double> angle,
                  LinkageVector& q);

/// The same for hip and knee. A leg with one motor has the hip's angle alone: the knee follows.
bool move_virtual_leg(const Linkage& linkage, double hip, double knee, LinkageVector& q);

/// What motors are to the virtual leg, in one pose: for every hinge rate q̇ = all·ȧ, as the motors'
/// columns of the kernel of the loops' equations.
struct MotorMap {
  LinkageRows leg;     ///< V: rates of hip and knee per motor rate
  LinkageMatrix all;   ///< G: rates of all hinges per motor rate
  LinkageRows branch;  ///< mass × velocity of its centre, summed over the branch (kg·m)
  Eigen::Vector2d lift = Eigen::Vector2d::Zero();  ///< height of the axle per hip and knee (m/rad)

  MotorMap(const Linkage& linkage, const LinkageVector& q);

  /// Motor rates that give these rates of hip and knee; the nearest for one motor.
  LinkageVector motor_rates(const Eigen::Vector2d& leg_rates) const;
  /// Motor torques (N·m) that do the virtual work of these torques at hip and knee.
  LinkageVector motor_torques(const Eigen::Vector2d& leg_torques) const;
  /// Torques (N·m) at hip and knee of a serial leg that would press the wheel as the motors do:
  ///
  ///     τ_v = V⁻ᵀ(τ_a − w),   w = Σ m·f·∂p/∂a over the branch
  ///
  /// `specific_force`: of the base, x and z in its frame (m/s²); g upwards at rest, 0 in free fall.
  /// One motor leaves the force along the ground unknown; it is taken as zero.
  Eigen::Vector2d leg_torques(const LinkageVector& motor_torques,
                              const Eigen::Vector2d& specific_force) const;
};

/// Degrees of freedom in a pose: hinges without those that the loops' equations take.
int mobility(const Linkage& linkage, const LinkageVector& q);

/// Whether motors determine the wheel in a pose, and hip and knee the motors: neither rods in line
/// nor crank and rod in line.
bool is_regular(const Linkage& linkage, const LinkageVector& q);

}  // namespace touchdown
