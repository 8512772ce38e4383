#pragma once

#include <Eigen/Core>

namespace touchdown::policies {

/// Continuous, ẋ = A x + B u, or discrete, x′ = A x + B u.
struct LinearSystem {
  Eigen::MatrixXd a, b;
};

/// Discretises a continuous system with sampling `period` (s) and zero-order hold of u.
LinearSystem sampled(const LinearSystem& continuous, double period);

/// The gains K of u = −K x that minimise Σ xᵀQx + uᵀRu over a sampled system, from the discrete
/// algebraic Riccati equation. Errors: `Error` if the system cannot be stabilised.
Eigen::MatrixXd lqr(const LinearSystem& system, const Eigen::MatrixXd& q, const Eigen::MatrixXd& r);

/// Weights by Bryson's rule: the inverse squares of the largest acceptable values.
Eigen::MatrixXd bryson(const Eigen::VectorXd& largest);

}  // namespace touchdown::policies
