#pragma once

#include <cstdint>
#include <string_view>

namespace touchdown::scenarios {

/// The random draws of one generated scenario. Every quantity has a stream of its own, keyed by its
/// name, so that one more quantity changes no other.
class Draws {
 public:
  /// `number` counts the scenarios of a family, `attempt` those that were rejected before.
  Draws(std::uint64_t seed, std::string_view family, std::uint64_t number, std::uint64_t attempt);

  /// Uniform between `low` and `high`.
  double between(std::string_view quantity, double low, double high) const;
  /// Uniform in the logarithm; for durations and rates, which cover decades. `low` > 0.
  double log_between(std::string_view quantity, double low, double high) const;
  /// A whole number from `low` to `high`, both included.
  int whole(std::string_view quantity, int low, int high) const;
  /// True with this probability.
  bool happens(std::string_view quantity, double probability) const;
  /// The draws of item `index` of a list, such as one piece of the terrain.
  Draws of(std::string_view list, int index) const;

 private:
  Draws(std::uint64_t seed, std::uint64_t place) : seed_(seed), place_(place) {}
  double share(std::string_view quantity) const;

  std::uint64_t seed_;
  std::uint64_t place_;  ///< hash of family, number, attempt and lists
};

}  // namespace touchdown::scenarios
