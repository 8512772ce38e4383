#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace touchdown::experiments {

/// At most 256 bins of every feature, so that a row needs a byte for each. Trees split between
/// bins: bin b holds the values of at least `cut(b − 1)` and below `cut(b)`.
class FeatureBins {
 public:
  static constexpr std::size_t most = 256;

  FeatureBins() = default;
  /// Bins of about equally many of these rows, which follow each other with `width` finite values
  /// each. Features with at most `most` different values get a bin for each.
  FeatureBins(std::span<const float> rows, std::size_t width);

  [[nodiscard]] std::size_t width() const noexcept { return count_.size(); }
  /// Appends the bins of one row of `width` values.
  void append(std::span<const float> row, std::vector<std::uint8_t>& bins) const;
  /// The threshold between values in bins below `bin` and the others; `bin` is at least 1. Beyond
  /// the last bin no value is larger.
  [[nodiscard]] float threshold(std::size_t feature, std::size_t bin) const noexcept;

 private:
  [[nodiscard]] std::uint8_t bin(std::size_t feature, float value) const noexcept;

  std::vector<std::array<float, most - 1>> cuts_;  ///< by feature, ascending
  std::vector<std::size_t> count_;                 ///< of its cuts
};

}  // namespace touchdown::experiments
