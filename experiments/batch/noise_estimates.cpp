#include "experiments/batch/noise_estimates.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/batch/wide_vectors.hpp"

namespace touchdown::experiments {
namespace {

/// The last two samples of one signal, by element.
struct Before {
  double* previous;
  double* before;
};

TOUCHDOWN_WIDE_VECTORS
void move_levels(const double* first, const double* second, const Before& of_first,
                 const Before& of_second, const double* median, std::int32_t stride,
                 std::int32_t top, std::int32_t* level, std::size_t count) noexcept {
  double* const previous_first = of_first.previous;
  double* const before_first = of_first.before;
  double* const previous_second = of_second.previous;
  double* const before_second = of_second.before;
  // The arrays do not overlap, which the compiler cannot know.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
  for (std::size_t i = 0; i < count; ++i) {
    const double a = std::abs(first[i] - 2.0 * previous_first[i] + before_first[i]);
    const double b = std::abs(second[i] - 2.0 * previous_second[i] + before_second[i]);
    before_first[i] = previous_first[i];
    before_second[i] = previous_second[i];
    previous_first[i] = first[i];
    previous_second[i] = second[i];
    const double now = median[level[i]];
    const std::int32_t direction = (a > now ? 1 : -1) + (b > now ? 1 : -1);
    level[i] = std::min(std::max(level[i] + direction * stride, 0), top);
  }
}

}  // namespace

NoiseEstimates::NoiseEstimates(const NoiseEstimate<2>& one, double warm_up, std::size_t count)
    : warm_up_(warm_up),
      top_(static_cast<std::int32_t>(one.levels().size()) - 1),
      level_(count, 0) {
  constexpr double median_of_second_difference = 0.6744897501960817 * 2.449489742783178;
  for (const double sigma : one.levels()) median_.push_back(median_of_second_difference * sigma);
  for (auto* samples : {&previous_, &before_}) samples->fill(std::vector<double>(count, 0.0));
}

void NoiseEstimates::update(const std::array<std::vector<double>, 2>& samples) noexcept {
  steps_ = std::min(steps_ + 1, 3);
  const bool is_usable = steps_ == 3;
  if (is_usable) updates_ += 1.0;
  const std::int32_t stride = !is_usable            ? 0
                              : updates_ < warm_up_ ? static_cast<std::int32_t>(warm_up_ / updates_)
                                                    : 1;
  move_levels(samples[0].data(), samples[1].data(), {previous_[0].data(), before_[0].data()},
              {previous_[1].data(), before_[1].data()}, median_.data(), stride, top_, level_.data(),
              level_.size());
}

}  // namespace touchdown::experiments
