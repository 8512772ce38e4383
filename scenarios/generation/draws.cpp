#include "scenarios/generation/draws.hpp"

#include <cmath>
#include <string>

#include "core/fingerprint.hpp"
#include "core/random.hpp"

namespace touchdown::scenarios {

Draws::Draws(std::uint64_t seed, std::string_view family, std::uint64_t number,
             std::uint64_t attempt)
    : seed_(seed),
      place_(Fingerprint()
                 .add(family)
                 .add(std::to_string(number))
                 .add(std::to_string(attempt))
                 .value()) {}

double Draws::share(std::string_view quantity) const {
  return uniform01(seed_, place_, Fingerprint().add(quantity).value());
}

double Draws::between(std::string_view quantity, double low, double high) const {
  return low + (high - low) * share(quantity);
}

double Draws::log_between(std::string_view quantity, double low, double high) const {
  return low * std::pow(high / low, share(quantity));
}

int Draws::whole(std::string_view quantity, int low, int high) const {
  return low + static_cast<int>(std::floor((high - low + 1) * share(quantity)));
}

bool Draws::happens(std::string_view quantity, double probability) const {
  return share(quantity) < probability;
}

Draws Draws::of(std::string_view list, int index) const {
  return {seed_,
          Fingerprint().add(std::to_string(place_)).add(list).add(std::to_string(index)).value()};
}

}  // namespace touchdown::scenarios
