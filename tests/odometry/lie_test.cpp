#include "tests/odometry/lie.hpp"

#include <cmath>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "estimator/odometry/lie.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::odometry {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix5 = Eigen::Matrix<double, 5, 5>;
using test::adjoint;
using test::inverse;
using test::log_se23;
using test::log_so3;

/// The 5 × 5 matrix of a group element.
Matrix5 matrix_of(const ExtendedPose& x) {
  Matrix5 matrix = Matrix5::Identity();
  matrix.topLeftCorner<3, 3>() = x.rotation;
  matrix.block<3, 1>(0, 3) = x.velocity;
  matrix.block<3, 1>(0, 4) = x.position;
  return matrix;
}

/// The 5 × 5 matrix of an element of the algebra.
Matrix5 matrix_of(const Vector9& xi) {
  Matrix5 matrix = Matrix5::Zero();
  matrix.topLeftCorner<3, 3>() = hat(xi.head<3>());
  matrix.block<3, 1>(0, 3) = xi.segment<3>(3);
  matrix.block<3, 1>(0, 4) = xi.tail<3>();
  return matrix;
}

Vector9 some(std::uint32_t seed, double angle) {
  touchdown::test::Normal normal(seed);
  Vector9 xi;
  for (int i = 0; i < 9; ++i) xi[i] = normal();
  xi.head<3>() *= angle / xi.head<3>().norm();
  return xi;
}

class Lie : public ::testing::TestWithParam<double> {};  // by the angle (rad)

TEST_P(Lie, ExponentialIsThatOfTheMatrix) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const Vector9 xi = some(seed, GetParam());
    const Matrix5 expected = Eigen::MatrixXd(matrix_of(xi)).exp();
    EXPECT_LT((matrix_of(exp_se23(xi)) - expected).norm(), 1e-13 * expected.norm());
  }
}

TEST_P(Lie, LogarithmUndoesTheExponential) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const Vector9 xi = some(seed, GetParam());
    EXPECT_LT((log_se23(exp_se23(xi)) - xi).norm(), 1e-8 * xi.norm());
  }
}

TEST_P(Lie, LeftJacobianIsTheDerivativeOfTheExponential) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const Vector3d angle = some(seed, GetParam()).head<3>();
    constexpr double step = 1e-6;
    for (int i = 0; i < 3; ++i) {
      const Vector3d more = step * Vector3d::Unit(i);
      const Matrix3d change = exp_so3(angle + more) * exp_so3(angle - more).transpose();
      const Vector3d difference = log_so3(change) / (2.0 * step);
      EXPECT_LT((difference - left_jacobian(angle).col(i)).norm(), 1e-8);
    }
  }
}

TEST_P(Lie, AdjointCarriesTheAlgebraAcross) {
  const ExtendedPose x = exp_se23(some(7, GetParam()));
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const Vector9 xi = some(10 + seed, 1e-3);
    const Vector9 across = adjoint(x) * xi;
    EXPECT_LT((matrix_of(x * exp_se23(xi)) - matrix_of(exp_se23(across) * x)).norm(), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, Lie,
                         ::testing::Values(1e-12, 1e-5, 1e-3, 0.0499, 0.0501, 0.4, 2.0, 3.1415));

TEST(LieGroup, ProductAndInverseAreThoseOfTheMatrices) {
  const ExtendedPose a = exp_se23(some(1, 1.0));
  const ExtendedPose b = exp_se23(some(2, 2.0));
  EXPECT_LT((matrix_of(a * b) - matrix_of(a) * matrix_of(b)).norm(), 1e-14);
  EXPECT_LT((matrix_of(inverse(a)) - Eigen::MatrixXd(matrix_of(a)).inverse()).norm(), 1e-14);
}

TEST(LieGroup, NothingTurnedIsTheIdentityAndItsLogarithmZero) {
  EXPECT_EQ(exp_so3(Vector3d::Zero()), Matrix3d::Identity());
  EXPECT_EQ(log_so3(Matrix3d::Identity()), Vector3d::Zero());
  EXPECT_EQ(left_jacobian(Vector3d::Zero()), Matrix3d::Identity());
}

TEST(LieGroup, HalfATurnHasALogarithm) {
  const Vector3d half = std::numbers::pi * Vector3d(1.0, 2.0, -2.0) / 3.0;
  EXPECT_LT((exp_so3(log_so3(exp_so3(half))) - exp_so3(half)).norm(), 1e-12);
  EXPECT_NEAR(log_so3(exp_so3(half)).norm(), std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace touchdown::odometry
