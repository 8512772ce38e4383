#include "estimator/sliding_dft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"

namespace touchdown {

SlidingDft::SlidingDft(int window) : bins_(window / 2 + 1) {
  if (window < 2) {
    throw InputError("a sliding window needs two or more samples, got " + std::to_string(window));
  }
  samples_.resize(static_cast<std::size_t>(window));
  rows_.resize(static_cast<std::size_t>((bins_ + lanes - 1) / lanes));
  for (int k = 0; k < bins_; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / window;
    Row& row = rows_[static_cast<std::size_t>(k % rows())];
    row.cosine[k / rows()] = std::cos(angle);
    row.sine[k / rows()] = std::sin(angle);
  }
}

void SlidingDft::reset() noexcept {
  std::fill(samples_.begin(), samples_.end(), 0.0);
  for (Row& row : rows_) {
    std::fill_n(row.real, lanes, 0.0);
    std::fill_n(row.imaginary, lanes, 0.0);
    std::fill_n(row.squared, lanes, 0.0);
  }
  oldest_ = 0;
}

void SlidingDft::push(double sample) noexcept {
  const double change = sample - samples_[oldest_];
  samples_[oldest_] = sample;
  oldest_ = oldest_ + 1 == samples_.size() ? 0 : oldest_ + 1;
  for (Row& row : rows_) {
    for (int i = 0; i < lanes; ++i) {
      const double real = row.real[i] + change;
      const double imaginary = row.imaginary[i];
      const double turned_real = real * row.cosine[i] - imaginary * row.sine[i];
      const double turned_imaginary = real * row.sine[i] + imaginary * row.cosine[i];
      row.real[i] = turned_real;
      row.imaginary[i] = turned_imaginary;
      row.squared[i] = turned_real * turned_real + turned_imaginary * turned_imaginary;
    }
  }
}

double SlidingDft::real(int bin) const noexcept { return row(bin % rows()).real[bin / rows()]; }

double SlidingDft::imaginary(int bin) const noexcept {
  return row(bin % rows()).imaginary[bin / rows()];
}

double SlidingDft::squared_magnitude(int bin) const noexcept {
  return row(bin % rows()).squared[bin / rows()];
}

}  // namespace touchdown
