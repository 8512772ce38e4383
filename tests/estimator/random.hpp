#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace touchdown::test {

/// Standard normal draws that are the same with every standard library.
class Normal {
 public:
  explicit Normal(std::uint32_t seed) : engine_(seed) {}
  double operator()() {
    const double u = (draw() + 1.0) / 4294967297.0;
    const double v = draw() / 4294967296.0;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
  }

 private:
  double draw() { return static_cast<double>(engine_()); }

  std::mt19937 engine_;
};

inline std::vector<double> normals(std::size_t count, double mean, double deviation,
                                   std::uint32_t seed) {
  Normal normal(seed);
  std::vector<double> values(count);
  for (double& value : values) {
    value = mean + deviation * normal();
  }
  return values;
}

}  // namespace touchdown::test
