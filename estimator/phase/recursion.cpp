#include "estimator/phase/recursion.hpp"

#include <cmath>
#include <string>

#include <Eigen/Core>

#include "core/error.hpp"

namespace touchdown {

int phase_stride(double model_rate, double filter_rate) {
  const double ratio = model_rate / filter_rate;
  const double stride = std::round(ratio);
  if (!(stride >= 1.0 && std::abs(ratio - stride) < 1e-6 * stride)) {
    throw InputError("phase filter: a sample rate of " + std::to_string(filter_rate) +
                     " Hz is not the model's " + std::to_string(model_rate) +
                     " Hz divided by a whole number");
  }
  return static_cast<int>(stride);
}

double phase_exponent(double exponent, int stride) {
  return std::max(exponent, std::min(1.0, exponent * stride));
}

PhaseRecursion::PhaseRecursion(const PhaseModel& model, int stride) {
  using Matrix = Eigen::Matrix<double, phase_count, phase_count>;
  Matrix one;
  for (std::size_t i = 0; i < phase_count; ++i) {
    for (std::size_t j = 0; j < phase_count; ++j) {
      one(static_cast<int>(i), static_cast<int>(j)) = model.transition[i][j];
    }
  }
  Matrix all = one;
  for (int k = stride; k > 1; --k) all = all * one;
  for (std::size_t i = 0; i < phase_count; ++i) {
    for (std::size_t j = 0; j < phase_count; ++j) {
      transition_[i][j] = all(static_cast<int>(i), static_cast<int>(j));
    }
  }
}

}  // namespace touchdown
