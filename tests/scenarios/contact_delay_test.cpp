#include "scenarios/contact_delay.hpp"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace touchdown::scenarios {
namespace {

/// The history is the oracle: step k − d, or contact before the first step.
TEST(ContactDelay, ReturnsTheContactOfEarlierSteps) {
  std::mt19937 random(3);
  for (const std::size_t longest : {0U, 1U, 7U, 200U}) {
    ContactDelay delay(longest);
    std::vector<ContactDelay::WheelContacts> history;
    for (std::size_t k = 0; k < 500; ++k) {
      history.push_back({random() % 2 == 0, random() % 3 == 0});
      const std::size_t asked = random() % (longest + 3);  // it may change, and be too long
      const std::size_t steps = std::min(asked, longest);
      const auto expected =
          steps > k ? ContactDelay::WheelContacts{true, true} : history[k - steps];
      EXPECT_EQ(delay.add(history.back(), asked), expected) << k << ", delayed by " << asked;
    }
  }
}

}  // namespace
}  // namespace touchdown::scenarios
