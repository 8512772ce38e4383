#include "estimator/numerics/sliding_dft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"

namespace touchdown {

SlidingDft::SlidingDft(int window)
    : bins_(window / 2 + 1), nyquist_turn_(window % 2 == 0 ? -1.0 : 0.0) {
  if (window < 2) {
    throw InputError("a sliding window needs two or more samples, got " + std::to_string(window));
  }
  const int paired = (window + 1) / 2;
  rows_ = (paired + lanes - 1) / lanes;
  samples_.resize(static_cast<std::size_t>(window));
  for (auto* part : {&real_, &imaginary_, &cosine_, &sine_}) {
    part->resize(static_cast<std::size_t>(rows_ * lanes));
  }
  for (int k = 0; k < paired; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / window;
    cosine_[place(k)] = std::cos(angle);
    sine_[place(k)] = std::sin(angle);
  }
}

void SlidingDft::reset() noexcept {
  for (auto* values : {&samples_, &real_, &imaginary_}) {
    std::fill(values->begin(), values->end(), 0.0);
  }
  nyquist_ = 0.0;
  oldest_ = 0;
}

void SlidingDft::push(double sample) noexcept {
  const double change = sample - samples_[oldest_];
  samples_[oldest_] = sample;
  oldest_ = oldest_ + 1 == samples_.size() ? 0 : oldest_ + 1;
  nyquist_ = nyquist_turn_ * (nyquist_ + change);
  double* const x = real_.data();
  double* const y = imaginary_.data();
  const double* const cosine = cosine_.data();
  const double* const sine = sine_.data();
  const std::size_t count = real_.size();
  // The arrays do not overlap. The compiler cannot know this.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
  for (std::size_t i = 0; i < count; ++i) {
    const double real = x[i] + change;
    const double imaginary = y[i];
    x[i] = real * cosine[i] - imaginary * sine[i];
    y[i] = real * sine[i] + imaginary * cosine[i];
  }
}

double SlidingDft::real(int bin) const noexcept {
  return 2 * bin == window() ? nyquist_ : real_[place(bin)];
}

double SlidingDft::imaginary(int bin) const noexcept {
  return 2 * bin == window() ? 0.0 : imaginary_[place(bin)];
}

double SlidingDft::squared_magnitude(int bin) const noexcept {
  return real(bin) * real(bin) + imaginary(bin) * imaginary(bin);
}

}  // namespace touchdown
