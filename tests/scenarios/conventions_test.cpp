#include <fstream>

#include "core/resources.hpp"
#include "scenarios/generation/generate.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scenario_file.hpp"
#include "tests/complaint.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scenarios/runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::scenarios {
namespace {

/// Another way to write Upkie.
struct Variant {
  std::string name;
  std::vector<Edit> edits;
};

std::vector<Edit> axes(const std::vector<std::string>& joints, const std::string& axis) {
  std::vector<Edit> edits;
  for (const std::string& joint : joints) {
    edits.push_back(
        {"(<joint name=\"" + joint + "\"[^>]*) axis=\"[^\"]*\"", "$1 axis=\"" + axis + "\""});
  }
  return edits;
}

std::vector<Edit> swapped_names() {
  return {{"left_(hip|knee|wheel|tire)", "other_$1"},
          {"right_(hip|knee|wheel|tire)", "left_$1"},
          {"other_(hip|knee|wheel|tire)", "right_$1"}};
}

std::vector<Edit> together(std::vector<Edit> one, const std::vector<Edit>& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

/// All of them describe the same robot.
std::vector<Variant> variants() {
  const std::vector<Edit> ros = axes(
      {"left_hip", "left_knee", "left_wheel", "right_hip", "right_knee", "right_wheel"}, "0 1 0");
  const std::string motor = "(<motor[^>]*) ctrlrange=\"-([0-9.]+) [0-9.]+\"";
  return {
      {"RosAxes", ros},
      {"WheelsTheSame", axes({"right_wheel"}, "0 1 0")},
      {"AllAxesBack",
       axes({"left_hip", "left_knee", "left_wheel", "right_hip", "right_knee", "right_wheel"},
            "0 -1 0")},
      {"KneesMirrored", together(axes({"left_knee"}, "0 1 0"), axes({"right_knee"}, "0 -1 0"))},
      {"SidesSwapped", swapped_names()},
      {"SidesSwappedWithRosAxes", together(ros, swapped_names())},
      {"KneeZero", {{"<joint name=\"(left|right)_knee\"", "$& ref=\"0.5\""}}},
      {"HipZero", {{"<joint name=\"(left|right)_hip\"", "$& ref=\"-0.3\""}}},
      {"OneWheelZero", {{"<joint name=\"left_wheel\"", "$& ref=\"2\""}}},
      {"Gear", {{"-16 16\"", "-1.6 1.6\" gear=\"10\""}, {"-1.7 1.7\"", "-0.85 0.85\" gear=\"2\""}}},
      {"GearBackward", {{"-16 16\"", "-1 1\" gear=\"-16\""}}},
      {"ForceRange", {{motor, "$1 forcerange=\"-$2 $2\""}}},
      {"ForceRangeAndWiderControls", {{motor, "$1 ctrlrange=\"-99 99\" forcerange=\"-$2 $2\""}}},
      {"GeneralWithGain",
       {{"<motor([^>]*) ctrlrange=\"-16 16\"", "<general$1 gainprm=\"4\" ctrlrange=\"-4 4\""}}},
      {"PositionServos",
       {{"<motor([^>]*) ctrlrange=\"-16 16\"",
         "<position$1 kp=\"8\" ctrlrange=\"-1 1\" forcerange=\"-16 16\""}}},
      {"VelocityServos",
       {{"<motor([^>]*) ctrlrange=\"-1.7 1.7\"",
         "<velocity$1 kv=\"0.1\" ctrlrange=\"-50 50\" forcerange=\"-1.7 1.7\""}}},
      {"ContactBitsOfMjx",
       {{"contype=\"1\" conaffinity=\"2\"", "contype=\"0\" conaffinity=\"1\""}}},
      {"ContactBitsByDefault", {{"contype=\"1\" conaffinity=\"2\"", ""}}},
      {"ContactBitsOfNone",
       {{"<geom name=\"(left|right)_tire\"", "$& contype=\"0\" conaffinity=\"0\""}}},
      {"ContactParameters",
       {{"condim=\"3\"",
         "condim=\"6\" margin=\"0.01\" gap=\"0.005\" priority=\"20\" friction=\"0.1 0.1 0.1\" "
         "solref=\"0.05 0.5\" solimp=\"0.5 0.6 0.01\""}}},
      {"SolverOptions",
       {added("<option timestep=\"0.005\" integrator=\"implicitfast\" cone=\"pyramidal\" "
              "impratio=\"100\" solver=\"CG\" iterations=\"3\" tolerance=\"0.1\" "
              "gravity=\"0 0 -9.8\" collision=\"predefined\"><flag warmstart=\"disable\" "
              "override=\"enable\"/></option>")}},
      {"SoftLimits",
       {{"<joint name=\"(left|right)_(hip|knee)\"",
         "$& margin=\"1\" solreflimit=\"0.2 1\" solimplimit=\"0.1 0.2 0.1\""}}},
      {"Leftovers",
       {added(
           "<worldbody><geom name=\"floor\" type=\"plane\" size=\"1 1 1\"/><light pos=\"0 0 3\"/>"
           "<camera name=\"side\" pos=\"0 -2 1\"/><body name=\"target\"/></worldbody>"
           "<keyframe><key qpos=\"0 0 1 1 0 0 0 0 0 0 0 0 0\"/></keyframe>"
           "<sensor><gyro site=\"imu\"/></sensor><size njmax=\"1\" nconmax=\"1\"/>"
           "<contact><pair geom1=\"torso\" geom2=\"left_tire\"/>"
           "<exclude body1=\"torso\" body2=\"left_wheel\"/></contact>"
           "<visual><map znear=\"0.5\"/></visual><statistic extent=\"9\"/>"
           "<equality><joint active=\"false\" joint1=\"left_knee\" joint2=\"right_knee\"/>"
           "</equality>")}},
      {"CommentAfterTheRoot", {{"</mujoco>", "</mujoco>\n<!-- <mujoco model=\"a\"></mujoco> -->"}}},
      {"CommentBeforeTheEnd", {{"</mujoco>", "<!-- </mujoco> -->\n</mujoco >"}}},
      {"WithoutAutolimits", {{" autolimits=\"true\"", ""}}},
      {"ImuMountedLevel", {{"quat=\"0 0 1 0\"", "quat=\"1 0 0 0\""}}},
      {"ImuOnAFrame",
       {{"<site name=\"imu\"([^>]*)/>", "<body name=\"frame\"><site name=\"imu\"$1/></body>"}}},
  };
}

class SameRobot : public ::testing::TestWithParam<std::tuple<std::size_t, std::string>> {
 protected:
  static logs::Recording run(const std::filesystem::path& robot, const std::string& engine) {
    Scenario scenario = find_scenario("scenarios/one_step.yaml", robot.string());
    scenario.start.x = 2.3;
    scenario.velocity.front().time = 0.1;
    scenario.end.settle = 0.3;
    return play(scenario, engine);
  }
};

/// Recordings are in touchdown's conventions, whatever those of the robot's file.
TEST_P(SameRobot, HasTheSameRecording) {
  const auto& [number, engine] = GetParam();
  const Variant variant = variants()[number];
  const ScratchFolder folder;
  const logs::Recording expected = run(upkie_mjcf, engine);
  const logs::Recording found = run(folder.write("robot.xml", edited_upkie(variant.edits)), engine);
  EXPECT_EQ(found.info.outcome, logs::Outcome::finished);
  ASSERT_EQ(found.steps(), expected.steps());
  for (std::size_t k = 0; k < found.steps(); k += 50) {
    for (std::size_t i = 0; i < models::servo_count; ++i) {
      ASSERT_NEAR(found.observation[k].servo[i].position, expected.observation[k].servo[i].position,
                  1e-9)
          << variant.name << " at " << k;
      ASSERT_NEAR(found.observation[k].servo[i].torque, expected.observation[k].servo[i].torque,
                  1e-9);
    }
    ASSERT_EQ(found.truth[k].base_position, expected.truth[k].base_position);
    ASSERT_LT((found.observation[k].imu.linear_acceleration -
               expected.observation[k].imu.linear_acceleration)
                  .norm(),
              1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, SameRobot,
                         ::testing::Combine(::testing::Range(std::size_t{0}, variants().size()),
                                            ::testing::ValuesIn(simulators::simulator_names())),
                         [](const auto& which) {
                           return variants()[std::get<0>(which.param)].name + "_" +
                                  std::get<1>(which.param);
                         });

class AnotherRobot : public InEveryEngine {
 protected:
  Scenario standing_robot(const std::string& yaml) {
    return complete_scenario(YamlDocument::parse(
        "name: stand\nrobot: " + folder_.write("robot.yaml", "# a robot\n" + yaml).string() +
            "\nend: {duration: 3}\n",
        "stand"));
  }
  ScratchFolder folder_;
};

/// A joint zero at the folded leg, with hips and knees of opposite signs.
TEST_P(AnotherRobot, WithFoldedZerosStandsInItsOwnStance) {
  std::string leg;
  for (const auto& [side, y, axis] :
       {std::tuple{"left", 1, "0 -1 0"}, std::tuple{"right", -1, "0 1 0"}}) {
    const std::string other = axis == std::string("0 -1 0") ? "0 1 0" : "0 -1 0";
    const auto at = [y = y](double distance) { return std::to_string(y * distance); };
    leg += "<body pos=\"0 " + at(0.14) +
           " 0\"><inertial pos=\"0 0 0.125\" mass=\"1.5\" "
           "diaginertia=\"0.02 0.02 0.005\"/><joint name=\"" +
           side + "_hip\" axis=\"" + axis + "\" range=\"-4.71 -1.57\"/><body pos=\"0 " + at(0.07) +
           " 0.25\"><inertial "
           "pos=\"0 0 -0.125\" mass=\"1\" diaginertia=\"0.01 0.01 0.002\"/><joint name=\"" +
           side + "_knee\" axis=\"" + other + "\" range=\"-4.71 -1.57\"/><body pos=\"0 " +
           at(0.07) +
           " -0.25\"><inertial pos=\"0 0 0\" mass=\"1.2\" diaginertia=\"0.01 0.02 0.01\"/><joint "
           "name=\"" +
           side + "_wheel\" axis=\"0 1 0\"/><geom name=\"" + side +
           "_tire\" type=\"cylinder\" size=\"0.12 0.02\" euler=\"1.5707963 0 0\"/></body></body>"
           "</body>";
  }
  std::string motors;
  for (const std::string_view servo : models::servo_names) {
    motors += "<general name=\"" + std::string(servo) + "\" joint=\"" + std::string(servo) +
              "\" ctrlrange=\"-40 40\"/>";
  }
  folder_.write("folded.xml",
                "<mujoco model=\"folded\"><compiler angle=\"radian\"/><worldbody><body><freejoint/>"
                "<geom type=\"box\" size=\"0.19 0.14 0.13\" mass=\"6\"/><site name=\"imu\"/>" +
                    leg + "</body></worldbody><actuator>" + motors + "</actuator></mujoco>");
  const Scenario scenario =
      standing_robot("mjcf: folded.xml\nstance: {hip: -2.6, knee: -2.6}\nbalancer: {gains: lqr}\n");
  EXPECT_NEAR(scenario.start.hip, std::numbers::pi - 2.6, 1e-9);
  EXPECT_NEAR(scenario.start.knee, std::numbers::pi - 2.6, 1e-9);
  const logs::Recording recording = play(scenario, GetParam());
  EXPECT_EQ(recording.info.outcome, logs::Outcome::finished)
      << ending_text(recording, scenario.end);
  expect_refused({{"mjcf: folded.xml\nstance: {hip: 0, knee: -2.6}\n",
                   {"expected -4.71 to -1.57", "'left_hip'"}}},
                 [&](const std::string& yaml) { return standing_robot(yaml); });
}

INSTANTIATE_TEST_SUITE_P(Engine, AnotherRobot, ::testing::ValuesIn(simulators::simulator_names()),
                         engine_name);

TEST(MotorLimits, AreInNewtonMetresWhateverTheirUnits) {
  const ScratchFolder folder;
  const std::vector<std::vector<Edit>> weak = {
      {{"-16 16\"", "-1 1\""}},
      {{"-16 16\"", "-16 16\" forcerange=\"-1 1\""}},
      {{"-16 16\"", "-16 16\" gear=\"0.0625\""}},
      {{"<motor([^>]*)-16 16\"", "<position$1-16 16\" forcerange=\"-1 1\""}},
      {{"<motor([^>]*)-16 16\"", "<general gainprm=\"0.25\"$1-2 2\" gear=\"2\""}}};
  for (const std::vector<Edit>& edits : weak) {
    const models::RobotModel model =
        models::compile_robot_model(folder.write("weak.xml", edited_upkie(edits)), {});
    EXPECT_EQ(model.effort[0], 1.0);
    EXPECT_EQ(model.effort[4], 1.0);
    EXPECT_EQ(model.effort[2], 1.7);
  }
}

TEST(YamlRobots, MayBeYml) {
  const ScratchFolder folder;
  folder.write("base.xml", edited_upkie({}));
  const auto file = folder.write("mine.yml", "# mine\nmjcf: base.xml\nmass: 1.1\n");
  const Scenario scenario = find_scenario("scenarios/flat.yaml", file.string());
  EXPECT_NEAR(mj_getTotalmass(models::compile_robot_model(scenario.robot, {}).mj.get()),
              1.1 * 5.33922, 1e-3);
}

}  // namespace
}  // namespace touchdown::scenarios
