#include "policies/lqr.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "core/error.hpp"

namespace touchdown::policies {
namespace {

using Eigen::MatrixXd;

MatrixXd matrix(int rows, int columns, std::initializer_list<double> values) {
  MatrixXd m(rows, columns);
  auto value = values.begin();
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) m(i, j) = *value++;
  }
  return m;
}

LinearSystem double_integrator() { return {matrix(2, 2, {0, 1, 0, 0}), matrix(2, 1, {0, 1})}; }

/// s, θ, ṡ, θ̇ of something like Upkie.
LinearSystem pendulum() {
  return {matrix(4, 4, {0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 21.8, 0, 0}),
          matrix(4, 1, {0, 0, 1, -2.7})};
}

/// Riccati's recursion, one sample after the other.
MatrixXd by_value_iteration(const LinearSystem& system, const MatrixXd& q, const MatrixXd& r,
                            int samples) {
  MatrixXd p = q;
  MatrixXd k;
  for (int i = 0; i < samples; ++i) {
    k = (r + system.b.transpose() * p * system.b).inverse() * system.b.transpose() * p * system.a;
    p = (q + system.a.transpose() * p * (system.a - system.b * k)).eval();
  }
  return k;
}

TEST(Sampled, ADoubleIntegratorMovesAsInSchool) {
  const LinearSystem sampled_system = sampled(double_integrator(), 0.1);
  EXPECT_TRUE(sampled_system.a.isApprox(matrix(2, 2, {1, 0.1, 0, 1}), 1e-14));
  EXPECT_TRUE(sampled_system.b.isApprox(matrix(2, 1, {0.005, 0.1}), 1e-14));
}

TEST(Sampled, APendulumTopplesHyperbolically) {
  const double w = std::sqrt(21.8);
  const LinearSystem step = sampled(pendulum(), 0.2);
  EXPECT_NEAR(step.a(1, 1), std::cosh(0.2 * w), 1e-12);
  EXPECT_NEAR(step.a(3, 1), w * std::sinh(0.2 * w), 1e-12);
  EXPECT_NEAR(step.b(1, 0), -2.7 * (std::cosh(0.2 * w) - 1.0) / 21.8, 1e-12);
}

TEST(Lqr, OfOneStateIsTheRootOfAQuadratic) {
  const double a = 1.1, b = 0.5, q = 2.0, r = 3.0;
  // b²p² + (r − a²r − b²q)p − qr = 0
  const double half = 0.5 * (r - a * a * r - b * b * q);
  const double p = (-half + std::sqrt(half * half + b * b * q * r)) / (b * b);
  const MatrixXd k =
      lqr({matrix(1, 1, {a}), matrix(1, 1, {b})}, matrix(1, 1, {q}), matrix(1, 1, {r}));
  EXPECT_NEAR(k(0, 0), a * b * p / (r + b * b * p), 1e-13);
}

TEST(Lqr, OfAFastSampledDoubleIntegratorIsTheContinuousOne) {
  // k₁ = u/s, k₂ = √(2u/s + u²/v²)
  const double s = 0.5, v = 2.0, u = 3.0;
  const MatrixXd k = lqr(sampled(double_integrator(), 1e-5), bryson(Eigen::Vector2d(s, v)),
                         bryson(Eigen::VectorXd::Constant(1, u)));
  EXPECT_NEAR(k(0, 0), u / s, 1e-3);
  EXPECT_NEAR(k(0, 1), std::sqrt(2.0 * u / s + u * u / (v * v)), 1e-3);
}

TEST(Lqr, IsWhereRiccatisRecursionEnds) {
  const MatrixXd q = bryson(Eigen::Vector4d(1.0, 0.1, 1.0, 1.0));
  const MatrixXd r = bryson(Eigen::VectorXd::Constant(1, 1.5));
  for (const double period : {1e-3, 5e-3}) {
    const LinearSystem system = sampled(pendulum(), period);
    const MatrixXd k = lqr(system, q, r);
    EXPECT_TRUE(k.isApprox(by_value_iteration(system, q, r, 40'000), 1e-6)) << k;
    const Eigen::VectorXcd modes = MatrixXd(system.a - system.b * k).eigenvalues();
    EXPECT_LT(modes.cwiseAbs().maxCoeff(), 1.0);
  }
}

TEST(Lqr, RefusesASystemThatCannotBeStabilised) {
  // The unstable state is out of reach.
  EXPECT_THROW((void)lqr({matrix(2, 2, {1.1, 0, 0, 0.5}), matrix(2, 1, {0, 1})},
                         MatrixXd::Identity(2, 2), MatrixXd::Identity(1, 1)),
               Error);
}

}  // namespace
}  // namespace touchdown::policies
