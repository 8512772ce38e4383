#pragma once

#include <Eigen/Core>

namespace touchdown::policies {

/// ẋ = A x + B u, or x′ = A x + B u.
struct LinearSystem {
  Eigen::MatrixXd a, b;
};

/// A continuous system from one sample to the next, `period` (s) later, with u held between.
LinearSystem sampled(const LinearSystem& continuous, double period);

/// The gains K of u = −K x that minimise Σ xᵀQx + uᵀRu over a sampled system, from the discrete
/// algebraic Riccati equation. Errors: `Error` if nothing stabilises the system.
Eigen::MatrixXd lqr(const LinearSystem& system, const Eigen::MatrixXd& q, const Eigen::MatrixXd& r);

/// Weights by Bryson's rule: one over the square of the largest value that is acceptable.
Eigen::MatrixXd bryson(const Eigen::VectorXd& largest);

}  // namespace touchdown::policies
