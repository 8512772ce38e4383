#include "cli/verb.hpp"

#include <utility>

#include <CLI/CLI.hpp>

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
  option_->check(CLI::IsMember(values));
  return *this;
}

Option& Option::not_negative() {
  option_->check(CLI::NonNegativeNumber);
  return *this;
}

Option& Option::between(int lowest, int highest) {
  option_->check(CLI::Range(lowest, highest));
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

Option Verb::option(const std::string& names, OptionValue value, const std::string& help) {
  const auto add = [&](auto* variable) { return app_->add_option(names, *variable, help); };
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
