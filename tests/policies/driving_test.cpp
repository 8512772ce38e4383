#include "policies/driving.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/fields.hpp"

namespace touchdown::policies {
namespace {

using ::testing::HasSubstr;

VelocityScript read(const std::string& text) {
  Fields fields(YamlDocument::parse(text, "script.yaml"));
  VelocityScript script;
  fields.list("velocity", script, script);
  fields.finish();
  return script;
}

std::string complaint(const std::string& text) {
  try {
    (void)read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(VelocityScript, StandsBeforeTheFirstCommandAndKeepsTheLast) {
  const VelocityScript script = {{1.0, 0.5, 0.1}, {2.0, -0.5, 0.0}, {4.0, 0.0, 0.2}};
  EXPECT_EQ(command_at(script, 0.0).velocity, 0.0);
  EXPECT_EQ(command_at(script, 0.999).velocity, 0.0);
  EXPECT_EQ(command_at(script, 1.0).velocity, 0.5);
  EXPECT_EQ(command_at(script, 1.999).yaw_rate, 0.1);
  EXPECT_EQ(command_at(script, 2.0).velocity, -0.5);
  EXPECT_EQ(command_at(script, 1e9).yaw_rate, 0.2);
}

TEST(VelocityScript, AnEmptyOneStands) {
  EXPECT_EQ(command_at({}, 3.0).velocity, 0.0);
  EXPECT_EQ(command_at({}, 3.0).yaw_rate, 0.0);
  EXPECT_TRUE(read("{}").empty());
}

TEST(VelocityScript, SurvivesTheRoundTrip) {
  VelocityScript script = read(
      "velocity:\n  - {time: 0.1, velocity: 0.30000000000000004}\n  - {time: 2, yaw_rate: -0.7}\n");
  ASSERT_EQ(script.size(), 2U);
  Fields written;
  written.list("velocity", script, script);
  YAML::Emitter out;
  out.SetDoublePrecision(17);
  out << written.node();
  const VelocityScript again = read(out.c_str());
  ASSERT_EQ(again.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again[i].time, script[i].time);
    EXPECT_EQ(again[i].velocity, script[i].velocity);
    EXPECT_EQ(again[i].yaw_rate, script[i].yaw_rate);
  }
}

TEST(VelocityScript, ComplainsOnTheLine) {
  EXPECT_THAT(complaint("velocity:\n  - {time: 2}\n  - {time: 2}\n"),
              AllOf(HasSubstr("script.yaml:3:"), HasSubstr("later time")));
  EXPECT_THAT(complaint("velocity:\n  - {time: 2, velocty: 1}\n"),
              HasSubstr("did you mean 'velocity'"));
  EXPECT_THAT(complaint("velocity:\n  - {velocity: fast}\n"), HasSubstr("expected a number"));
  EXPECT_THAT(complaint("velocity:\n  - {velocity: 99}\n"), HasSubstr("velocity: expected"));
  EXPECT_THAT(complaint("velocity:\n  - {velocity: .nan}\n"), HasSubstr("velocity: expected"));
}

}  // namespace
}  // namespace touchdown::policies
