#include "logs/recording.hpp"

#include <array>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::logs {

namespace {
constexpr std::array<std::string_view, 5> outcome_texts = {"finished", "timed_out", "fell",
                                                           "diverged", "left_terrain"};
}

std::string_view to_text(Outcome outcome) {
  return outcome_texts.at(static_cast<std::size_t>(outcome));
}

Outcome outcome_from_text(std::string_view text) {
  for (std::size_t i = 0; i < outcome_texts.size(); ++i) {
    if (outcome_texts[i] == text) return static_cast<Outcome>(i);
  }
  throw InputError(fmt::format("unknown outcome '{}', expected one of {}", text,
                               fmt::join(outcome_texts, ", ")));
}

}  // namespace touchdown::logs
