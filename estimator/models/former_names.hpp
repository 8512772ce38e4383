#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace touchdown {

/// The present name of an estimator that had this name before; empty for other names.
[[nodiscard]] constexpr std::string_view present_name(std::string_view former) noexcept {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> names = {
      {{"touchdown", "evidence_curves"},
       {"evidence_pairs", "evidence_curves"},
       {"touchdown_shipped", "shipped"},
       {"load_logistic", "force_kinematics"},
       {"gradient_boosting", "boosted_signals"}}};
  for (const auto& [before, now] : names) {
    if (before == former) return now;
  }
  return {};
}

}  // namespace touchdown
