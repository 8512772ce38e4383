#include "experiments/boosting/bins.hpp"

#include <algorithm>
#include <limits>

namespace touchdown::experiments {

FeatureBins::FeatureBins(std::span<const float> rows, std::size_t width)
    : cuts_(width), count_(width, 0) {
  const std::size_t rows_count = width == 0 ? 0 : rows.size() / width;
  std::vector<float> values(rows_count);
  for (std::size_t feature = 0; feature < width; ++feature) {
    for (std::size_t row = 0; row < rows_count; ++row) values[row] = rows[row * width + feature];
    std::sort(values.begin(), values.end());
    std::vector<float> different = values;
    different.erase(std::unique(different.begin(), different.end()), different.end());
    const bool is_exact = different.size() <= most;
    const std::vector<float>& from = is_exact ? different : values;
    const std::size_t bins = std::min(most, from.size());
    for (std::size_t b = 1; b < bins; ++b) {
      const float cut = from[b * from.size() / bins];
      const bool is_new =
          count_[feature] == 0 ? cut > from.front() : cut > cuts_[feature][count_[feature] - 1];
      if (is_new) cuts_[feature][count_[feature]++] = cut;
    }
  }
}

std::uint8_t FeatureBins::bin(std::size_t feature, float value) const noexcept {
  const auto first = cuts_[feature].begin();
  const auto last = first + static_cast<std::ptrdiff_t>(count_[feature]);
  return static_cast<std::uint8_t>(std::upper_bound(first, last, value) - first);
}

void FeatureBins::append(std::span<const float> row, std::vector<std::uint8_t>& bins) const {
  for (std::size_t feature = 0; feature < row.size(); ++feature) {
    bins.push_back(bin(feature, row[feature]));
  }
}

float FeatureBins::threshold(std::size_t feature, std::size_t bin) const noexcept {
  return bin <= count_[feature] ? cuts_[feature][bin - 1] : std::numeric_limits<float>::max();
}

}  // namespace touchdown::experiments
