#include "estimator/numerics/number_text.hpp"

#include <array>
#include <charconv>
#include <locale>
#include <sstream>

namespace touchdown {

std::string text_of(double number) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  return {text.data(), end};
}

std::optional<double> number_of(const std::string& text) {
  std::istringstream stream(text);  // std::from_chars is not in every library
  stream.imbue(std::locale::classic());
  double number = 0.0;
  if (!(stream >> number) || stream.peek() != std::istringstream::traits_type::eof()) return {};
  return number;
}

}  // namespace touchdown
