#include "simulators/options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/fields.hpp"

namespace touchdown::simulators {
namespace {

using ::testing::HasSubstr;

SimulatorOptions read(const std::string& text) {
  return from_yaml<SimulatorOptions>(YamlDocument::parse(text, "options.yaml"));
}

std::string complaint_about(const std::string& text) {
  try {
    (void)read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(SimulatorOptions, ReadsGivenValuesAndKeepsDefaults) {
  const SimulatorOptions options =
      read("physics_step_us: 500\ncontrol_step_us: 5000\ncontact: {bullet_stiffness: 1000}\n");
  EXPECT_EQ(options.steps.physics_us, 500);
  EXPECT_EQ(options.steps.control_us, 5000);
  EXPECT_EQ(options.contact.bullet_stiffness, 1000.0);
  EXPECT_EQ(options.contact.solref_time_constant, ContactModel{}.solref_time_constant);
}

TEST(SimulatorOptions, SurvivesTheRoundTrip) {
  SimulatorOptions options;
  options.steps = {250, 2000};
  options.contact = {0.02, 0.9, 2e4, 500.0, 0.001};
  YAML::Emitter out;
  out.SetDoublePrecision(17);
  out << to_node(options);
  const SimulatorOptions again = read(out.c_str());
  EXPECT_EQ(again.steps.physics_us, 250);
  EXPECT_EQ(again.steps.control_us, 2000);
  EXPECT_EQ(again.contact.solref_time_constant, 0.02);
  EXPECT_EQ(again.contact.solref_damping_ratio, 0.9);
  EXPECT_EQ(again.contact.bullet_stiffness, 2e4);
  EXPECT_EQ(again.contact.bullet_damping, 500.0);
  EXPECT_EQ(again.contact.rolling_resistance, 0.001);
}

TEST(SimulatorOptions, ComplainsOnTheLine) {
  EXPECT_THAT(complaint_about("physics_step_us: 300\ncontrol_step_us: 1000\n"),
              HasSubstr("options.yaml:2:18: control_step_us: expected a multiple"));
  EXPECT_THAT(complaint_about("physics_step_us: 0.001\n"), HasSubstr("a whole number"));
  EXPECT_THAT(complaint_about("physics_step_us: 0\n"), HasSubstr("options.yaml:1:"));
  EXPECT_THAT(complaint_about("contact: {bullet_stifness: 1}\n"),
              HasSubstr("did you mean 'bullet_stiffness'"));
  EXPECT_THAT(complaint_about("contact: {rolling_resistance: -1}\n"),
              HasSubstr("rolling_resistance"));
  EXPECT_THAT(complaint_about("contact: {rolling_resistance: .nan}\n"),
              HasSubstr("rolling_resistance"));
}

}  // namespace
}  // namespace touchdown::simulators
