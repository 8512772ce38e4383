#include "apps/cli/verb.hpp"

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdlib>
#include <limits>
#include <type_traits>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/yaml.hpp"

namespace touchdown::cli {

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::value_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Option& Option::shows_default() {
  option_->capture_default_str();
  return *this;
}

Option& Option::one_of(const std::vector<std::string>& values) {
  // Its description is what shells offer.
  option_->check(CLI::Validator([values](std::string& text) { return not_one_of(text, values); },
                                fmt::format("{{{}}}", fmt::join(values, ",")), ""));
  return *this;
}

Option& Option::between(double lowest, double highest) {
  const auto complaint = [=](const std::string& text) {
    const double number = std::strtod(text.c_str(), nullptr);
    if (number >= lowest && number <= highest) return std::string();
    return fmt::format("{}: expected a number from {:.10g} to {:.10g}", text, lowest, highest);
  };
  option_->check(CLI::Validator([=](std::string& text) { return complaint(text); }, "", ""));
  return *this;
}

Option& Option::takes(int least, int most) {
  option_->expected(least, most);
  return *this;
}

Option& Option::one_at_a_time() {
  option_->allow_extra_args(false);
  return *this;
}

Verb::Verb(CLI::App& program, const std::string& name, const std::string& help)
    : app_(program.add_subcommand(name, help)) {}

namespace {

/// What is wrong with a number on the command line; empty if nothing is. CLI11 alone would wrap -1
/// to 2^64 - 1, cut 2^64 down, and read 010 as octal.
template <typename Number>
std::string complaint_about(const std::string& text) {
  if (has_leading_zero(text)) return fmt::format("{}: a number has no leading zero", text);
  Number number{};
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), number);
  const bool is_whole_text = error == std::errc{} && end == text.data() + text.size();
  if constexpr (std::floating_point<Number>) {
    return is_whole_text && std::isfinite(number)
               ? ""
               : fmt::format("{}: expected a finite number", text);
  } else {
    using Limits = std::numeric_limits<Number>;
    return is_whole_text ? ""
                         : fmt::format("{}: expected a whole number from {} to {}", text,
                                       Limits::min(), Limits::max());
  }
}

// The element of a list, or the variable itself; only their types are used.
template <typename T>
T element_of(const T* variable);
template <typename T>
T element_of(const std::vector<T>* variables);

}  // namespace

Option Verb::option(const std::string& names, OptionValue value, const std::string& help) {
  const auto add = [&]<typename T>(T* variable) {
    CLI::Option* const option = app_->add_option(names, *variable, help);
    using Number = decltype(element_of(variable));
    if constexpr (std::is_arithmetic_v<Number>) {
      option->check(
          CLI::Validator([](std::string& text) { return complaint_about<Number>(text); }, "", ""));
    } else {
      // In scripts, a variable that is not set: the default would be used without a word.
      const auto complaint = [](const std::string& text) {
        return std::string(text.empty() ? "expected a value, found an empty text" : "");
      };
      option->check(CLI::Validator([=](std::string& text) { return complaint(text); }, "", ""));
    }
    return option;
  };
  return Option(std::visit(add, value));
}

void Verb::flag(const std::string& names, bool* given, const std::string& help) {
  app_->add_flag(names, *given, help);
}

void Verb::action(std::function<void()> action) { app_->callback(std::move(action)); }

void Verb::action_on_words(std::function<void(const std::vector<std::string>& words)> action) {
  app_->set_help_flag();
  app_->prefix_command();
  app_->callback([app = app_, action = std::move(action)] { action(app->remaining()); });
}

}  // namespace touchdown::cli
