#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace touchdown::recordings {

/// Ages of held values: how much older they are than the rows that they are added to.
class Ages {
 public:
  void add(double age) { ages_.push_back(static_cast<float>(age)); }

  std::size_t count() const { return ages_.size(); }
  /// s; 0 without values.
  double largest() const {
    return ages_.empty() ? 0.0 : static_cast<double>(*std::max_element(ages_.begin(), ages_.end()));
  }
  double median() const {
    if (ages_.empty()) return 0.0;
    std::vector<float> sorted = ages_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return static_cast<double>(*middle);
  }

 private:
  std::vector<float> ages_;
};

}  // namespace touchdown::recordings
