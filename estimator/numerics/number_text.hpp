#pragma once

#include <optional>
#include <string>

namespace touchdown {

/// "1000", "0.1": the shortest text that reads back to the same bits.
std::string text_of(double number);
/// The inverse; nothing unless the whole text is one number.
std::optional<double> number_of(const std::string& text);

}  // namespace touchdown
