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
  blocks_.resize(static_cast<std::size_t>((bins_ + block_size - 1) / block_size));
  squared_.resize(blocks_.size() * block_size);
  for (int k = 0; k < bins_; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / window;
    Block& block = blocks_[static_cast<std::size_t>(k / block_size)];
    block.cosine[k % block_size] = std::cos(angle);
    block.sine[k % block_size] = std::sin(angle);
  }
}

void SlidingDft::reset() noexcept {
  std::fill(samples_.begin(), samples_.end(), 0.0);
  std::fill(squared_.begin(), squared_.end(), 0.0);
  for (Block& block : blocks_) {
    std::fill_n(block.real, block_size, 0.0);
    std::fill_n(block.imaginary, block_size, 0.0);
  }
  oldest_ = 0;
}

void SlidingDft::push(double sample) noexcept {
  const double change = sample - samples_[oldest_];
  samples_[oldest_] = sample;
  oldest_ = oldest_ + 1 == samples_.size() ? 0 : oldest_ + 1;
  double* squared = squared_.data();
  for (Block& block : blocks_) {
    for (int i = 0; i < block_size; ++i) {
      const double real = block.real[i] + change;
      const double imaginary = block.imaginary[i];
      const double turned_real = real * block.cosine[i] - imaginary * block.sine[i];
      const double turned_imaginary = real * block.sine[i] + imaginary * block.cosine[i];
      block.real[i] = turned_real;
      block.imaginary[i] = turned_imaginary;
      squared[i] = turned_real * turned_real + turned_imaginary * turned_imaginary;
    }
    squared += block_size;
  }
}

double SlidingDft::real(int bin) const noexcept {
  return blocks_[static_cast<std::size_t>(bin / block_size)].real[bin % block_size];
}

double SlidingDft::imaginary(int bin) const noexcept {
  return blocks_[static_cast<std::size_t>(bin / block_size)].imaginary[bin % block_size];
}

}  // namespace touchdown
