#include "models/robot_draft.hpp"

#include <regex>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <yaml-cpp/yaml.h>

#include "core/error.hpp"
#include "models/robot_model.hpp"
#include "models/stance.hpp"
#include "models/terrain.hpp"
#include "tests/complaint.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A node of YAML in one style.
std::string dumped(const YAML::Node& node) {
  YAML::Emitter text;
  text << YAML::Clone(node);
  return std::regex_replace(std::string(text.c_str()), std::regex("[{},\\s]+"), "");
}

class RobotDraft : public ::testing::Test {
 protected:
  std::string draft_of(const std::string& xml, const std::string& name = "theirs.xml") {
    const auto file = folder_.write(name, xml);
    const std::string text = text_of(drafted_robot(file), name);
    yaml_ = folder_.write("theirs.yaml", text);
    return text;
  }

  RobotModel drafted() const { return compile_robot_model(yaml_, Terrain{}); }

  ScratchFolder folder_;
  std::filesystem::path yaml_;
};

TEST_F(RobotDraft, HasThePartsOfTheShippedRobots) {
  const std::string models = TOUCHDOWN_SOURCE_DIR "/models/";
  for (const std::string name : {"hip_roll", "ros_style", "knee_and_wheel", "five_bar"}) {
    const YAML::Node shipped = YAML::LoadFile(models + name + ".yaml");
    const auto mjcf = shipped["mjcf"].as<std::string>();
    const YAML::Node drafted = YAML::Load(text_of(drafted_robot(models + mjcf), mjcf));
    for (const char* key : {"base", "held", "hip", "imu", "tyres", "joints"}) {
      if (!shipped[key]) continue;
      EXPECT_EQ(dumped(drafted[key]), dumped(shipped[key])) << name << ' ' << key;
    }
    EXPECT_EQ(drafted["held"].IsDefined(), shipped["held"].IsDefined()) << name;
  }
}

TEST_F(RobotDraft, OfUpkieWithOtherNamesIsUpkie) {
  const RobotModel upkie = compile_robot_model(upkie_mjcf, Terrain{});
  const std::vector<Edit> strange = {{"\"left_(hip|knee|wheel)\"", "\"$1 L, axis\""},
                                     {"\"right_(hip|knee|wheel)\"", "\"$1 R, axis\""},
                                     {"name=\"imu\"", "name=\"torso_IMU_link\""}};
  const std::string text = draft_of(edited_upkie(strange));
  EXPECT_THAT(text, AllOf(HasSubstr("left_hip: \"hip L, axis\""), HasSubstr("imu: torso_IMU_link"),
                          Not(HasSubstr("held")), Not(HasSubstr("guess"))));
  const RobotModel same = drafted();
  for (std::size_t i = 0; i < servo_count; ++i) {
    EXPECT_EQ(same.joint[i], upkie.joint[i]) << i;
    EXPECT_EQ(same.effort[i], upkie.effort[i]) << i;
    EXPECT_EQ(same.is_reversed[i], upkie.is_reversed[i]) << i;
  }
  EXPECT_EQ(same.tyre_geom, upkie.tyre_geom);
  EXPECT_EQ(same.imu_position, upkie.imu_position);
}

TEST_F(RobotDraft, HoldsWhatTurnsOtherwise) {
  const std::string text = draft_of(rolling_upkie());
  EXPECT_THAT(text, HasSubstr("held: [left_roll, right_roll]"));
  EXPECT_EQ(drafted().held.size(), 2U);
}

/// A biped of boxes: legs of links from the base down, with hinges about `axis`.
std::string biped(const std::vector<double>& links, const std::string& axis,
                  const std::array<std::string, 2>& sides, const std::string& wheel,
                  const std::string& motor = "ctrlrange=\"-30 30\"") {
  const bool is_along_y = axis.find("0 1") == 0;
  std::string bodies;
  std::string motors;
  for (std::size_t side = 0; side < 2; ++side) {
    const double off = side == 0 ? 0.15 : -0.15;
    std::string open;
    std::string close;
    double length = 0.0;
    for (std::size_t i = 0; i <= links.size(); ++i) {
      const std::string name = fmt::format("{}{}", sides.at(side), i);
      const double across = i == 0 ? off : 0.0;
      const double bend = i % 2 == 0 ? 0.05 : -0.05;
      open +=
          fmt::format("<body name=\"b{0}\" pos=\"{1} {2} {3}\"><joint name=\"{0}\" axis=\"{4}\"/>",
                      name, is_along_y ? (i == 0 ? 0.0 : bend) : across,
                      is_along_y ? across : (i == 0 ? 0.0 : bend), -length, axis);
      motors += fmt::format("<motor joint=\"{}\" {}/>", name, motor);
      close += "</body>";
      if (i == links.size()) break;
      length = links[i];
      open += fmt::format("<geom type=\"box\" size=\".02 .02 .02\" mass=\".5\" pos=\"0 0 {}\"/>",
                          -0.5 * length);
    }
    bodies += open + wheel + close;
  }
  return "<mujoco><worldbody><body name=\"trunk\" pos=\"0 0 1\"><freejoint/><geom type=\"box\" "
         "size=\".1 .1 .1\" mass=\"6\"/>" +
         bodies + "</body></worldbody><actuator>" + motors + "</actuator></mujoco>";
}

std::string tyre_about(const std::string& axis) {
  return fmt::format("<geom type=\"cylinder\" size=\".08 .02\" zaxis=\"{}\" mass=\".6\"/>", axis);
}

TEST_F(RobotDraft, StatesWhatItGuesses) {
  const std::string text =
      draft_of(biped({0.2, 0.2}, "0 1 0", {"A", "B"}, tyre_about("0 1 0"), ""));
  EXPECT_THAT(text, AllOf(HasSubstr("# Names do not distinguish left from right"),
                          HasSubstr("imu: trunk  # a guess"),
                          HasSubstr("actuators:  # torques guessed from the weight"),
                          HasSubstr("left_hip: A0\n"), HasSubstr("right_wheel: B2\n")));
  EXPECT_GT(drafted().effort[1], 5.0);
}

TEST_F(RobotDraft, TakesTheLongLinksOfLegsWithThreeHinges) {
  const std::string text =
      draft_of(biped({0.22, 0.2, 0.03}, "0 1 0", {"l", "r"}, tyre_about("0 1 0")));
  EXPECT_THAT(text, AllOf(HasSubstr("left_hip: l0"), HasSubstr("left_knee: l1"),
                          HasSubstr("left_wheel: l3"), HasSubstr("held: [l2, r2]")));
  EXPECT_EQ(drafted().held.size(), 2U);
}

TEST_F(RobotDraft, HasKneesAloneForLegsWithOneHinge) {
  const std::string text = draft_of(biped({0.25}, "0 1 0", {"Left", "Right"}, tyre_about("0 1 0")));
  EXPECT_THAT(text, AllOf(HasSubstr("hip: none"), HasSubstr("left_knee: Left0\n"),
                          Not(HasSubstr("_hip:"))));
  EXPECT_FALSE(drafted().has(0));
}

TEST_F(RobotDraft, LetsTheLeftLegBeOnTheLeftWhereverTheBaseFaces) {
  for (const auto& [axis, sides] : std::vector<std::pair<std::string, std::array<std::string, 2>>>{
           {"0 1 0", {"leg_l", "leg_r"}},
           {"0 1 0", {"leg_r", "leg_l"}},
           {"1 0 0", {"leg_l", "leg_r"}},
           {"1 0 0", {"leg_r", "leg_l"}}}) {
    const std::string text = draft_of(biped({0.2, 0.2}, axis, sides, tyre_about(axis)));
    EXPECT_THAT(text, HasSubstr("left_wheel: leg_l2")) << axis;
    const RobotModel robot = drafted();
    EXPECT_EQ(robot.joint_name[2], "leg_l2") << axis << sides[0];
    const MjDataPtr data = at_reference(robot);
    EXPECT_GT(vector_at(data->geom_xpos, robot.tyre_geom[0]).y(), 0.1) << axis << sides[0];
  }
}

TEST_F(RobotDraft, MeasuresWheelsWithoutRoundColliders) {
  const std::string disc = "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\".0018 .0032 .0018\"/>";
  EXPECT_THAT(draft_of(biped({0.2, 0.2}, "0 1 0", {"l", "r"}, disc)),
              HasSubstr("tyres: {radius: 0.08}  # m, a guess from the wheel's inertia"));
  EXPECT_NEAR(drafted().wheel_radius, 0.08, 1e-9);
  const std::string across = "<geom type=\"cylinder\" size=\".07 .02\" mass=\"1\"/>";
  EXPECT_THAT(draft_of(biped({0.2, 0.2}, "0 1 0", {"l", "r"}, across)),
              HasSubstr("tyres: {radius: 0.07}  # m, a guess: the wheel's shape is not round"));
  const std::string any = "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\".01 .01 .01\"/>";
  EXPECT_THAT(draft_of(biped({0.2, 0.2}, "0 1 0", {"l", "r"}, any)),
              HasSubstr("# tyres: {radius: …}"));
}

TEST_F(RobotDraft, FindsWheelsWithoutMeshes) {
  const std::string ros = read_file(TOUCHDOWN_SOURCE_DIR "/models/legs/ros_style.urdf");
  for (const std::string side : {"left", "right"}) {
    const Edit missing = {
        fmt::format("(<link name=\"{}_wheel\">[\\s\\S]*?)<sphere radius=\"0.075\"/>", side),
        "$1<mesh filename=\"package://theirs/wheel.stl\"/>"};
    EXPECT_THAT(draft_of(edited(ros, {missing}), "theirs.urdf"),
                HasSubstr("tyres: {radius: 0.075}  # m, of a wheel's round geom"));
    EXPECT_NEAR(drafted().wheel_radius, 0.075, 1e-9) << side;
  }
  // Neither names, shapes, ranges nor places near the origin make them wheels.
  const std::string disc = "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\".0018 .0032 .0018\"/>";
  for (const char* height : {"1", "3", "20"}) {
    EXPECT_THAT(draft_of(edited(biped({0.2, 0.2}, "0 1 0", {"l", "r"}, disc),
                                {{"(<joint name=\"\\w+\")", "$1 range=\"-170 170\""},
                                 {"pos=\"0 0 1\"", fmt::format("pos=\"0 0 {}\"", height)}})),
                HasSubstr("left_wheel: l2"))
        << height;
  }
}

TEST_F(RobotDraft, GuessesTheTorqueOfHeldJointsWithoutALimit) {
  const Edit no_motors = {"<actuator>[\\s\\S]*</actuator>", ""};
  for (const std::string& robot : {rolling_upkie("", ""), edited(rolling_upkie(), {no_motors}),
                                   rolling_upkie("", "<motor joint=\"{0}_roll\"/>")}) {
    EXPECT_THAT(draft_of(robot), HasSubstr("held_servo: {maximum_torque: "));
    EXPECT_GT(drafted().held[0].effort, 5.0);
  }
  EXPECT_THAT(draft_of(rolling_upkie()), Not(HasSubstr("held_servo")));
}

TEST_F(RobotDraft, StandsWithinTheRangesOfBothClosedLegs) {
  const std::string five = read_file(TOUCHDOWN_SOURCE_DIR "/models/legs/five_bar.xml");
  for (const auto& [joint, range] :
       std::vector<std::pair<std::string, std::string>>{{"right_knee", "-1.4277 -.0777"},
                                                        {"right_knee", ".02 1.4"},
                                                        {"left_knee", "-1.4 -.3"},
                                                        {"right_front_motor", ".1 1"},
                                                        {"left_front_motor", "-1 -.2"},
                                                        {"left_knee", "-.5 .5"}}) {
    const std::string name = fmt::format("<joint name=\"{}\"", joint);
    draft_of(edited(five, {{"<mujoco model=\"five_bar\">", "$&<compiler angle=\"radian\"/>"},
                           {name, fmt::format("$& limited=\"true\" range=\"{}\"", range)}}));
    const RobotModel robot = drafted();
    EXPECT_FALSE(stance_error(robot, usual_stance(robot))) << joint << ' ' << range;
  }
}

TEST_F(RobotDraft, IsRefusedAtThePartThatAYamlFileCannotName) {
  const std::string motor = "<motor name=\"left_knee\"[^>]*>";
  for (const auto& one : std::vector<std::pair<std::vector<Edit>, std::string>>{
           {{{"<joint name=\"left_knee\"", "<joint"}, {motor, ""}},
            "theirs.xml:68:11: joint without a name on body 'left_lower_leg': expected a name"},
           {{{"<joint name=\"left_wheel\"[^>]*>", ""}, {"<motor name=\"left_wheel\"[^>]*>", ""}},
            "theirs.xml:38:5: expected as many hinges parallel to the axles"},
           {{{"\"left_knee\"", "\"left&#10;knee\""}},
            "theirs.xml:68:11: joint: name: expected one without control characters, found "
            "'left\\nknee'"},
           {{{"\"imu\"", "\"im&#127;u\""}}, "theirs.xml:41:7: site: name: expected"},
           {{{"\"left_tire\"", "\"left&#9;tire\""}}, "found 'left\\ttire'"}}) {
    EXPECT_THAT(complaint_of([&] { draft_of(edited_upkie(one.first)); }), HasSubstr(one.second));
  }
  for (const char* strange : {"a: b", "'a'", "a # b", "{a}, [b]", "ü", "~", "2", " "}) {
    draft_of(edited_upkie(
        {{"\"(left|right)_(hip|knee|wheel|tire)\"", fmt::format("\"$01{}$2\"", strange)},
         {"name=\"imu\"", fmt::format("name=\"{}\"", strange)}}));
    EXPECT_EQ(drafted().joint_name[1], fmt::format("left{}knee", strange));
  }
}

/// The five-bar robot without its loops.
std::string cut_five_bar() {
  return edited(read_file(TOUCHDOWN_SOURCE_DIR "/models/legs/five_bar.xml"),
                {{"<connect[^>]*/>", ""}});
}

/// A link with a hinge on the base, half of `length` long down to its centre of mass.
std::string link_at(const std::string& name, const std::string& place, double length,
                    const std::string& inside = "") {
  return fmt::format(
      "<body name=\"{0}\" pos=\"{1}\"><joint name=\"{0}\" axis=\"0 1 0\"/><inertial "
      "pos=\"0 0 {2}\" mass=\".1\" diaginertia=\"1e-4 1e-4 1e-4\"/>{3}</body>",
      name, place, -0.5 * length, inside);
}

TEST_F(RobotDraft, AsksForTheLoopsOfRodsWhateverHasAMotor) {
  const std::string four = read_file(TOUCHDOWN_SOURCE_DIR "/models/legs/four_bar.urdf");
  const Edit efforts = {"(<axis xyz=\"0 1 0\"/>)\\s*</joint>",
                        "$1<limit effort=\"30\" velocity=\"20\"/></joint>"};
  const std::string imu = "<site name=\"imu\"";
  const auto upkie_with = [&](const std::string& links) {
    return edited_upkie({{imu, links + imu}});
  };
  const std::string wheel = "<body name=\"left_wheel\"";
  for (const auto& [robot, file, rod] : std::vector<std::array<std::string, 3>>{
           {four, "theirs.urdf", "left_rocker_pivot"},
           {edited(four, {efforts}), "theirs.urdf", "left_rocker_pivot"},
           {cut_five_bar(), "theirs.xml", "left_rear_motor"},
           {edited_upkie({{wheel, link_at("lever", "0 0 0", 0.1) + wheel}}), "theirs.xml", "lever"},
           // Along the thigh, from beside the hip to beside the knee.
           {upkie_with(link_at("coupler", "-.04 .12 -.164", 0.16)), "theirs.xml", "coupler"},
           {upkie_with(link_at("crank", ".02 .1 -.15", 0.03, link_at("push", "0 0 -.03", 0.15))),
            "theirs.xml", "crank, push"}}) {
    EXPECT_THAT(
        draft_of(robot, file),
        AllOf(HasSubstr("# " + rod), HasSubstr("# loops: [{bodies: ["), Not(HasSubstr("held:"))));
    EXPECT_THAT(
        complaint_of([&] { drafted(); }),
        AllOf(HasSubstr("rod of a closed chain"), HasSubstr("`loops`"), Not(HasSubstr("`held`"))))
        << rod;
  }
  // Held all the same, they are simulated with a warning.
  folder_.write("theirs.xml",
                edited_upkie({{wheel, link_at("lever", "0 0 0", 0.1) + wheel},
                              {"</actuator>", "<motor joint=\"lever\" ctrlrange=\"-1 1\"/>$&"}}));
  yaml_ = folder_.write("theirs.yaml", "mjcf: theirs.xml\nheld: [lever]\n");
  EXPECT_THAT(drafted().warnings, ElementsAre(HasSubstr("joint 'lever': a rod of a closed chain")));
}

TEST_F(RobotDraft, HoldsArmsAndHeads) {
  const Edit motor = {
      "</actuator>",
      "<motor joint=\"arm\" ctrlrange=\"-9 9\"/><motor joint=\"hand\" ctrlrange=\"-9 9\"/>$&"};
  for (const char* place : {"0 0 .1", ".1 0 0", "0 0 -.1", ".2 .1 .2"}) {
    const std::string arm = link_at("arm", place, -0.2, link_at("hand", "0 0 .2", -0.2));
    EXPECT_THAT(draft_of(edited_upkie({{"<site name=\"imu\"", arm + "$&"}, motor})),
                HasSubstr("held: [arm, hand]"));
    EXPECT_EQ(drafted().held.size(), 2U);
    EXPECT_THAT(drafted().warnings, IsEmpty()) << place;
  }
}

TEST_F(RobotDraft, NamesLinksWithComputedMasses) {
  const std::string urdf = read_file(TOUCHDOWN_SOURCE_DIR "/models/legs/ros_style.urdf");
  const std::string inertial = "\\s*<inertial>[\\s\\S]*?</inertial>";
  for (const auto& [where, words] : std::vector<std::pair<std::string, std::string>>{
           {"(<link name=\"left_shank\">)",
            "mass of 1 link computed from colliders, as if of water: 'left_shank'"},
           {"(<link name=\"\\w+_thigh\">)",
            "mass of 2 links computed from colliders, as if of water: 'left_thigh', 'right_thigh'"},
           {"()", "mass of 7 links computed"}}) {
    EXPECT_THAT(draft_of(edited(urdf, {{where + inertial, "$1"}}), "theirs.urdf"),
                AllOf(::testing::StartsWith("mjcf: theirs.urdf\n# "), HasSubstr(words)));
    EXPECT_THAT(drafted().warnings, ElementsAre(HasSubstr(words)));
  }
  const auto warnings = [&](const std::string& geom) {
    draft_of(biped({0.2, 0.2}, "0 1 0", {"l", "r"}, tyre_about("0 1 0") + geom));
    return drafted().warnings;
  };
  EXPECT_THAT(warnings(""), IsEmpty());
  EXPECT_THAT(warnings("<geom size=\".01\" density=\"700\"/>"), IsEmpty());
  EXPECT_THAT(warnings("<geom size=\".01\"/>"), ElementsAre(HasSubstr("mass of 2 links")));
}

}  // namespace
}  // namespace touchdown::models
