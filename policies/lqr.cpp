#include "policies/lqr.hpp"

#include <unsupported/Eigen/MatrixFunctions>

#include <Eigen/LU>

#include "core/error.hpp"

namespace touchdown::policies {

using Eigen::MatrixXd;

LinearSystem sampled(const LinearSystem& continuous, double period) {
  const auto states = continuous.a.rows();
  const auto inputs = continuous.b.cols();
  MatrixXd both = MatrixXd::Zero(states + inputs, states + inputs);
  both.topLeftCorner(states, states) = period * continuous.a;
  both.topRightCorner(states, inputs) = period * continuous.b;
  const MatrixXd step = both.exp();
  return {step.topLeftCorner(states, states), step.topRightCorner(states, inputs)};
}

MatrixXd lqr(const LinearSystem& system, const MatrixXd& q, const MatrixXd& r) {
  // Structure-preserving doubling algorithm: step k covers 2^k samples.
  const MatrixXd identity = MatrixXd::Identity(q.rows(), q.cols());
  MatrixXd a = system.a;
  MatrixXd g = system.b * r.inverse() * system.b.transpose();
  MatrixXd h = q;  // converges to the cost-to-go P
  constexpr int most_doublings = 60;
  for (int doubling = 0; doubling < most_doublings; ++doubling) {
    const MatrixXd inverse = (identity + g * h).inverse();
    const MatrixXd more = a.transpose() * h * inverse * a;
    g += a * inverse * g * a.transpose();
    a = (a * inverse * a).eval();
    h += more;
    if (!h.allFinite()) break;
    if (more.lpNorm<Eigen::Infinity>() <= 1e-14 * h.lpNorm<Eigen::Infinity>()) {
      const MatrixXd bp = system.b.transpose() * h;
      return (r + bp * system.b).ldlt().solve(bp * system.a);
    }
  }
  throw Error("no gains stabilise the linear system");
}

MatrixXd bryson(const Eigen::VectorXd& largest) {
  return largest.cwiseAbs2().cwiseInverse().asDiagonal();
}

}  // namespace touchdown::policies
