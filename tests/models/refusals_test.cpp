#include <algorithm>

#include <fmt/format.h>

#include "models/mjcf/robot_file.hpp"
#include "models/robot_model.hpp"
#include "tests/complaint.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

/// A place in Upkie's MJCF with what is written there, and words of the complaint.
using RefusedEdit = std::pair<Edit, std::string>;
/// The same of keys in a YAML file about Upkie, or of elements that are added to the MJCF.
using RefusedText = std::pair<std::string, std::string>;

class RefusedRobot : public ::testing::Test {
 protected:
  /// The complaints about a robot, of which each is one line and begins with a place in a file.
  std::string complaint(const std::string& mjcf, const std::string& keys = {}) {
    std::filesystem::path file = folder_.write("robot.xml", mjcf);
    if (!keys.empty()) file = folder_.write("robot.yaml", "# a robot\nmjcf: robot.xml\n" + keys);
    const std::string found = complaint_of([&] { (void)compile_robot_model(file, Terrain{}); });
    if (found == "no complaint") return found;
    EXPECT_THAT(found, MatchesRegex("([^:\n]*[.](xml|yaml):[0-9]+:[0-9]+: [^\n]+\n?)+"));
    return found;
  }

  void expect(const std::vector<RefusedEdit>& table, const std::string& keys = {}) {
    for (const auto& [edit, words] : table) {
      EXPECT_THAT(complaint(edited_upkie({edit}), keys), HasSubstr(words)) << edit.second;
    }
  }
  void expect_added(const std::vector<RefusedText>& table) {
    for (const auto& [elements, words] : table) {
      EXPECT_THAT(complaint(edited_upkie({added(elements)})),
                  AllOf(MatchesRegex(".*robot.xml:[0-9]+:[0-9]+: .*"), HasSubstr(words)))
          << elements;
    }
  }

  ScratchFolder folder_;
};

/// The line of a text in which a mark is.
std::ptrdiff_t line_of(const std::string& text, const std::string& mark) {
  const std::size_t at = text.find(mark);
  EXPECT_NE(at, std::string::npos) << mark;
  return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
}

TEST_F(RefusedRobot, HasElementsThatOneEngineAloneWouldSimulate) {
  expect_added(
      {{"<equality><joint joint1=\"left_knee\" polycoef=\"1 0 0 0 0\"/></equality>",
        "coupled joints"},
       {"<equality><connect body1=\"left_wheel\" body2=\"torso\" anchor=\"0 0 0\"/></equality>",
        "of its joints free, but 2 have a motor"},
       {"<equality><weld body1=\"left_wheel\" body2=\"torso\"/></equality>", "a <connect> closes"},
       {"<tendon><fixed name=\"rope\"><joint joint=\"left_hip\" coef=\"1\"/></fixed></tendon>",
        "tendon fixed 'rope'"},
       {"<worldbody><body name=\"ball\"><joint/><geom size=\"1\"/></body></worldbody>",
        "body 'ball'"},
       {"<extension><plugin plugin=\"a.b\"/></extension>", "plugins"}});

  const std::string knee = "<joint name=\"left_knee\"";
  const std::string torso = "<geom name=\"torso\" class=\"collider\" type=\"box\"";
  expect({{{knee, knee + " stiffness=\"20\""}, "joint 'left_knee': expected no spring"},
          {{knee, knee + " springdamper=\"0.1 1\""}, "joint 'left_knee': expected no spring"},
          {{"<default>", "<default><joint stiffness=\"3\"/>"}, "expected no spring"},
          {{"<freejoint name=\"root\"/>", "<joint type=\"free\" damping=\"1\"/>"}, "free joint"},
          {{torso, "<geom name=\"torso\" class=\"collider\" type=\"ellipsoid\""}, "geom 'torso'"},
          {{"<site name=\"imu\"",
            "<composite type=\"rope\" count=\"3 1 1\" spacing=\"0.1\"><geom type=\"sphere\" "
            "size=\"0.01\"/></composite><site name=\"imu\""},
           "composite"},
          {{"<site name=\"imu\"", "<geom name=\"hills\" type=\"hfield\" hfield=\"h\"/>$&"},
           "'hills'"}});
}

TEST_F(RefusedRobot, HasActuatorsThatAreNoMotors) {
  const std::string motor = "<motor name=\"left_hip\" joint=\"left_hip\" ctrlrange=\"-16 16\"/>";
  const std::string names = " name=\"left_hip\" joint=\"left_hip\" ";
  for (const auto& [by, words] : std::vector<RefusedText>{
           {"<position" + names + "kp=\"8\" ctrlrange=\"-1 1\"/>", "expected a motor"},
           {"<velocity" + names + "kv=\"1\" ctrlrange=\"-1 1\"/>", "expected a motor"},
           {"<intvelocity" + names + "kp=\"8\" actrange=\"-1 1\"/>", "expected a motor"},
           {"<damper" + names + "kv=\"1\" ctrlrange=\"0 1\"/>", "expected a motor"},
           {"<cylinder" + names + "timeconst=\"1\" ctrlrange=\"-1 1\"/>", "expected a motor"},
           {"<muscle" + names + "ctrlrange=\"0 1\"/>", "expected a motor"},
           {"<general" + names + "dyntype=\"filter\" ctrlrange=\"-1 1\"/>", "activation"},
           {"<motor" + names + "ctrlrange=\"0 16\"/>", "symmetric ctrlrange"},
           {"<motor" + names + "ctrlrange=\"-5 16\"/>", "found -5 to 16"},
           {"<motor" + names + "forcerange=\"-5 16\"/>", "symmetric forcerange"},
           {"<motor" + names + "ctrlrange=\"-1 1\" gear=\"0\"/>", "above 0 N·m"},
           {"<motor" + names + "ctrlrange=\"-16 16\" ctrllimited=\"false\"/>", "ctrlrange"},
           {motor + "<motor name=\"more\" joint=\"left_hip\" ctrlrange=\"-1 1\"/>",
            "motor 'more': expected one motor for joint 'left_hip'"}}) {
    expect({{{motor, by}, words}});
  }
}

TEST_F(RefusedRobot, HasNamesKindsAxesOrShapesThatAreNotOurs) {
  const std::string hip = "<joint name=\"left_hip\" axis=\"0 -1 0\"";
  const std::string tyre =
      "<geom name=\"left_tire\" class=\"collider\" type=\"sphere\" size=\"0.05\"";
  expect(
      {{{"site name=\"imu\"", "site name=\"sensor\""}, "site named 'imu'"},
       {{"name=\"left_hip\" joint=\"left_hip\"", "name=\"left_hip\" joint=\"right_hip\""},
        "motor 'right_hip': expected one motor for joint 'right_hip'"},
       {{"<joint name=\"left_knee\"", "<joint type=\"slide\" name=\"left_knee\""},
        "'left_knee': expected a hinge"},
       {{"joint=\"left_hip\" ctrlrange=\"-16 16\"", "joint=\"left_hip\""}, "ctrlrange"},
       {{hip, "<joint name=\"left_hip\" axis=\"1 0 0\""},
        "joint 'left_hip': its axis in the base is (1 0 0), expected (0 -1 0)"},
       {{hip, "<joint name=\"left_hip\" axis=\"0 0 1\""}, "its axis in the base is (0 0 1)"},
       {{hip, "<joint name=\"left_hip\" axis=\"1 1 0\""}, "its axis in the base is (0.707 0.707"},
       {{"pos=\"0 0.1142 -0.164\">", "pos=\"0 0.1142 -0.164\" euler=\"0 0 1.5708\">"},
        "its axis in the base is (1 0 0)"},
       {{tyre, "<geom name=\"left_tire\" class=\"collider\" type=\"cylinder\" size=\"0.05 0.01\""},
        "geom 'left_tire': its axis in the base is (0 0 1)"},
       {{tyre, "<geom name=\"left_tire\" class=\"collider\" type=\"capsule\" size=\"0.05 0.01\""},
        "geom 'left_tire': its axis in the base is (0 0 1)"},
       {{tyre, "<geom name=\"left_tire\" class=\"collider\" type=\"sphere\" size=\"0.06\""},
        "geom 'right_tire': expected the radius of the other tyre"},
       {{"size=\"0.05\" pos=\"0 -0.046 0\"", "size=\"0.05\" pos=\"0.01 -0.046 0\""},
        "10 mm beside"}});
}

/// A place in Upkie's MJCF, what is written there instead, and the name and version of what it has.
struct Later {
  std::string where, by, name, version;
};

/// The versions are those of the sections of MuJoCo's changelog that list it as added, and of the
/// notes of the releases 3.11.0 and 3.12.0.
TEST_F(RefusedRobot, HasPartsAtPlacesThatNoEngineCanTake) {
  const std::string site = "<site name=\"imu\" pos=\"0 0 -0.1\" quat=\"0 0 1 0\"";
  const std::string leg = "<body name=\"left_upper_leg\" pos=\"0 0.1142 -0.164\"";
  const std::string geom = "type=\"sphere\" size=\"0.05\" pos=\"0 0.06 -0.168\"";
  expect(
      {{{site, "<site name=\"imu\" pos=\"1e9 0 0\""}, ":41:7: site: expected a place within 100 m"},
       {{site, "<site name=\"imu\" pos=\"0 -inf 0\""}, "site: expected a place"},
       {{site, "<site name=\"imu\" quat=\"nan 0 1 0\""}, "site: expected an orientation"},
       {{leg, "<body name=\"left_upper_leg\" pos=\"0 -101 0\""}, ":55:7: body: expected a place"},
       {{leg, leg + " quat=\"0 0 0 0\""}, "body: expected an orientation"},
       {{geom, "type=\"sphere\" size=\"0.05\" pos=\"0 nan 0\""}, ":57:9: geom: expected a place"},
       {{geom, geom + " quat=\"0 nan 0 0\""}, "geom: expected an orientation"}});
}

TEST_F(RefusedRobot, HasWhatLaterVersionsOfMuJoCoAdded) {
  const std::string motor = "<motor name=\"left_hip\" joint=\"left_hip\" ctrlrange=\"-16 16\"";
  const std::string body = "<body name=\"torso\"";
  const std::string geom = "<geom name=\"torso\"";
  const std::string site = "<site name=\"imu\"";
  for (const auto& [where, by, name, version] : std::vector<Later>{
           {body, body + " gravcomp=\"1\"", "gravcomp", "2.3.1"},
           {site, "<flexcomp name=\"cloth\"/>" + site, "flexcomp", "3.0.0"},
           {"</mujoco>", "<deformable><flex/></deformable></mujoco>", "deformable", "3.0.0"},
           {site, "<frame pos=\"0 0 1\"/>" + site, "frame", "3.1.0"},
           {site, "<replicate count=\"2\"/>" + site, "replicate", "3.1.5"},
           {site, "<attach model=\"arm\"/>" + site, "attach", "3.2.0"},
           {geom, geom + " surfacevel=\"1 0 0\"", "surfacevel", "3.11.0"},
           {motor, "<pid name=\"left_hip\" joint=\"left_hip\"", "pid", "3.12.0"}}) {
    EXPECT_THAT(complaint(edited_upkie({{where, by}})),
                AllOf(MatchesRegex(".*robot.xml:[0-9]+:[0-9]+: .*"),
                      HasSubstr(fmt::format("`{}` came with MuJoCo {};", name, version))));
  }
  const std::string unknown = edited_upkie({{motor, motor + " colour=\"red\""}});
  EXPECT_THAT(complaint(unknown),
              AllOf(HasSubstr(fmt::format("robot.xml:{}:", line_of(unknown, "colour"))),
                    HasSubstr("colour"), Not(HasSubstr("came with"))));
}

TEST_F(RefusedRobot, HasAllItsComplaintsAtOnce) {
  const auto complaints = [&](const std::vector<Edit>& edits, const std::string& keys) {
    folder_.write("robot.xml", edited_upkie(edits));
    const auto file = folder_.write("robot.yaml", "mjcf: robot.xml\n" + keys);
    try {
      (void)compile_robot_model(file, Terrain{});
    } catch (const RobotRefusal& refusal) {
      const std::size_t count = refusal.complaints.size();
      EXPECT_EQ(
          refusal.what(),
          fmt::format("{} (the first of {} reasons; `touchdown check` of this robot prints all)",
                      refusal.complaints[0], count));
      return refusal.complaints;
    }
    return std::vector<std::string>{};
  };
  const std::string knee = "<joint name=\"left_knee\"";
  EXPECT_THAT(complaints({{"<body name=\"torso\"", "$& gravcomp=\"1\""},
                          {knee, knee + " actuatorfrcrange=\"0 5\""},
                          added("<tendon><fixed name=\"rope\"/></tendon>"),
                          added("<equality><weld body1=\"torso\"/></equality>")},
                         "imu: gyro\nheld: [arm]\nno_collision: [guard]\n"),
              UnorderedElementsAre(HasSubstr("gravcomp"), HasSubstr("symmetric"),
                                   HasSubstr("'rope'"), HasSubstr("equality weld"),
                                   HasSubstr("'gyro'"), HasSubstr("'arm'"), HasSubstr("'guard'")));
  EXPECT_THAT(complaints({}, "joints: {left_hip: a, right_knee: b}\ntyres: {left: c}\n"),
              UnorderedElementsAre(HasSubstr("'a'"), HasSubstr("'b'"), HasSubstr("'c'")));
}

/// MuJoCo 2.2 knows these already.
TEST_F(RefusedRobot, HasNothingThatThisVersionKnows) {
  const std::string geom = "<geom name=\"torso\"";
  const std::string compiler = "<compiler angle=\"radian\" autolimits=\"true\"";
  const std::string motor = "<motor name=\"left_hip\"";
  for (const auto& [where, by] : std::vector<Edit>{
           {geom, geom + " shellinertia=\"true\""},
           {geom, geom + " fitscale=\"1\""},
           {compiler, compiler + " discardvisual=\"true\" fitaabb=\"true\""},
           {compiler, compiler + " exactmeshinertia=\"true\" boundmass=\"0.001\""},
           {motor, motor + " ctrllimited=\"auto\" forcelimited=\"auto\""},
           {"<joint name=\"left_hip\"", "<joint limited=\"auto\" name=\"left_hip\""}}) {
    EXPECT_EQ(complaint(edited_upkie({{where, by}})), "no complaint") << by;
  }
}

TEST_F(RefusedRobot, HasItsErrorsInIncludedFiles) {
  folder_.write("more.xml", "<mujoco>\n  <tendon\n   class=\"a\"/>\n</mujoco>\n");
  EXPECT_THAT(complaint(edited_upkie({added("<include file=\"more.xml\"/>")})),
              HasSubstr("more.xml:2:3: tendon"));
  folder_.write("more.xml",
                "<mujoco><worldbody/>\n<asset>\n<mesh colour=\"red\"/></asset></mujoco>");
  EXPECT_THAT(complaint(edited_upkie({added("<include file=\"more.xml\"/>")})),
              AllOf(HasSubstr("more.xml:3:1:"), HasSubstr("colour")));
  EXPECT_THAT(complaint(edited_upkie({added("<include file=\"nothing.xml\"/>")})),
              HasSubstr("nothing.xml: no such file"));
  folder_.write("more.xml", "<mujoco><include file=\"robot.xml\"/></mujoco>");
  EXPECT_THAT(complaint(edited_upkie({added("<include file=\"more.xml\"/>")})),
              HasSubstr("included already"));
}

TEST_F(RefusedRobot, IsComplainedAboutAtTheColumnInQuestion) {
  for (const auto& [elements, words] :
       std::vector<RefusedText>{{"\n<tendon/>\n", ":1: tendon"},
                                {"\n  <!-- <tendon/> --> <tendon/>\n", ":8: tendon"},
                                {"\n<sensor/><custom/><tendon/>\n", ":19: tendon"},
                                {"\r\n\t<sensor\n/><tendon/>\r\n", ":3: tendon"}}) {
    EXPECT_THAT(complaint(edited_upkie({added(elements)})), HasSubstr(words)) << elements;
  }
  folder_.write("more.xml", "<mujoco><sensor/> <tendon/></mujoco>");
  EXPECT_THAT(complaint(edited_upkie({added("<include file=\"more.xml\"/>")})),
              HasSubstr("more.xml:1:19: tendon"));
}

TEST_F(RefusedRobot, HasMistakesThatTheComplaintNames) {
  const std::string knee = "<joint name=\"left_knee\" axis";
  const std::string shank = "<inertial pos=\"0 0.000191[^>]*>";
  expect(
      {{{knee, "<joint name=\"left_knee\" axes"},
        "`axes` may be of a later version (did you mean 'axis'?)"},
       {{"ctrlrange=\"-16 16\"", "ctrl_range=\"-16 16\""}, "did you mean 'ctrlrange'?"},
       {{"<site name=\"imu\"", "<sites name=\"imu\""}, "did you mean 'site'?"},
       {{knee, "<joint name=\"left_hip\" axis"}, "'left_hip': expected each name once"},
       {{"geom name=\"torso\"", "geom name=\"left_tire\""}, "'left_tire': expected each name once"},
       {{shank, ""}, "'left_lower_leg': expected a mass and an inertia above 0"},
       {{"mass=\"0.3954\"", "mass=\"nan\""}, "'left_lower_leg': expected a mass"},
       {{"mass=\"0.3954\"", "mass=\"0.0000003954\""}, "body 'left_lower_leg': its inertia, 0.00"},
       {{"2.321611e-02 1.317387e-02 1.609475e-02 0 6.005797e-04",
         "2.3e+01 1.3e+01 1.6e+01 0 6e-01"},
        "body 'torso': its inertia, "}});
  for (const auto& [keys, words] : std::vector<RefusedText>{
           {"held: [left_knee]\n",
            "robot.yaml:3:8: held: 'left_knee' is the joint of joints.left_knee"},
           {"joints: {left_knee: left_hip}\n",
            "joints.left_knee: 'left_hip' is the joint of joints.left_hip"},
           {"joints: {right_wheel: left_wheel, left_wheel: left_wheel}\n",
            "joints.right_wheel: 'left_wheel' is the joint of joints.left_wheel"}}) {
    EXPECT_THAT(complaint(edited_upkie({}), keys), HasSubstr(words));
  }
  const std::string models = TOUCHDOWN_SOURCE_DIR "/models/";
  for (const auto& [joint, line] :
       {std::pair("left_knee_joint", "6:14"), {"right_wheel_joint", "10:16"}}) {
    folder_.write(
        "robot.urdf",
        edited(read_file(models + "legs/ros_style.urdf"),
               {{fmt::format("(<joint name=\"{}\" type)=\"\\w+\"", joint), "$1=\"fixed\""}}));
    const auto yaml = folder_.write(
        "robot.yaml", edited(read_file(models + "ros_style.yaml"), {{"legs/ros_style", "robot"}}));
    EXPECT_THAT(complaint_of([&] { (void)compile_robot_model(yaml, {}); }),
                AllOf(HasSubstr(fmt::format("robot.yaml:{}: joints.", line)),
                      HasSubstr(fmt::format("joint '{}' is fixed, expected a hinge", joint))));
  }
  EXPECT_THAT(complaint("<sdf version=\"1.9\"><model name=\"m\"/></sdf>"),
              HasSubstr("SDF is not read"));
}

TEST_F(RefusedRobot, HasNoRobotInItsFile) {
  for (const char* text : {"<!-- nothing -->", "<?xml version=\"1.0\"?>\n", "<!DOCTYPE mujoco>", "",
                           " \n", "</mujoco>", "<!-- </mujoco> -->"}) {
    EXPECT_THAT(complaint(text), HasSubstr(":1: expected ")) << text;
  }
  EXPECT_THAT(complaint("<mujoco>\n<worldbody>\n"), HasSubstr("XML"));
  EXPECT_THAT(complaint("<robot name=\"upkie\"></robot>"), HasSubstr("links and joints"));
  EXPECT_THAT(complaint("<mujoco/>"), HasSubstr("<mujoco>"));
  EXPECT_THROW((void)compile_robot_model(folder_ / "nothing.xml", Terrain{}), InputError);
}

TEST_F(RefusedRobot, HasTooManyGeoms) {
  std::string many;
  for (int i = 0; i < 50'000; ++i) many += "<geom class=\"visual\" size=\"0.01\"/>\n";
  EXPECT_THAT(complaint(edited_upkie({{"<site name=\"imu\"", many + "<site name=\"imu\""}})),
              HasSubstr("expected at most 5000 geoms"));
}

TEST_F(RefusedRobot, HasOtherJointsAndNamesTheRemedy) {
  EXPECT_THAT(complaint(rolling_upkie()),
              AllOf(HasSubstr("joint 'left_roll', 'right_roll'"), HasSubstr("`held`")));
  EXPECT_THAT(complaint(edited_upkie({{"left_hip", "hip_l"}})),
              AllOf(HasSubstr("expected a hinge joint named 'left_hip'"), HasSubstr("hip_l"),
                    HasSubstr("YAML")));
}

TEST_F(RefusedRobot, IsComplainedAboutAtTheLineInQuestion) {
  const std::string motor = "<motor name=\"left_hip\" joint=\"left_hip\" ctrlrange=\"-16 16\"/>";
  const std::string torso = "<geom name=\"torso\" class=\"collider\" type=\"box\"";
  const std::string wheel = "<joint name=\"left_wheel\"";
  // What is written, and a mark in the line that the complaint must name.
  for (const auto& [edit, mark] : std::vector<RefusedEdit>{
           {{motor, motor + "\n<motor name=\"more\" joint=\"left_hip\" ctrlrange=\"-1 1\"/>"},
            "\"more\""},
           {{motor, motor + "\n<motor joint=\"left_knee\" gear=\"3\" ctrlrange=\"-1 1\"/>"},
            "<motor name=\"left_knee\""},
           {{motor, motor + "\n<motor site=\"imu\" ctrlrange=\"-1 1\"/>"}, "<motor site"},
           {{"<freejoint name=\"root\"/>", "<joint type=\"free\" armature=\"1\"/>"}, "\"free\""},
           {{"<freejoint name=\"root\"/>", "<freejoint/>"}, ""},
           {{torso, "<geom class=\"collider\" type=\"ellipsoid\""}, "ellipsoid"},
           {{wheel, "<joint name=\"left_extra\" axis=\"0 1 0\"/>\n" + wheel}, "left_extra"},
           {{wheel, "<joint axis=\"0 1 0\"/>\n" + wheel}, "<joint axis"},
           {{wheel, wheel + " type=\"slide\""}, "\"slide\""},
           {{"<inertial pos=\"0 -0.035535[^>]*>",
             "<inertial pos=\"0 0 0\" mass=\"0\" "
             "diaginertia=\"0 0 0\"/>"},
            "name=\"left_wheel\" pos"},
           {{"<site name=\"imu\"", "<site name=\"sensor\""}, "name=\"torso\" pos"},
           {{"<body name=\"torso\"",
             "<body name=\"other\"><freejoint/><inertial pos=\"0 0 0\" mass=\"1\" "
             "diaginertia=\"1 1 1\"/></body>\n<body name=\"torso\""},
            "<freejoint name=\"root\""},
           {{"<site name=\"imu\" pos", "<site name=\"ignored\" pos"}, "name=\"torso\" pos"},
           {{"pos=\"0 0.1142 -0.164\">", "pos=\"0 -0.19 -0.164\">"}, "\"right_tire\""}}) {
    const std::string text = edited_upkie({edit});
    const std::string found = complaint(text);
    if (mark.empty()) {
      EXPECT_EQ(found, "no complaint");
      continue;
    }
    EXPECT_THAT(found, HasSubstr(fmt::format("robot.xml:{}:", line_of(text, mark)))) << mark;
  }
}

TEST_F(RefusedRobot, HasKeysThatAreComplainedAboutAtTheirPlace) {
  const std::string upkie = edited_upkie({});
  for (const auto& [keys, words] : std::vector<RefusedText>{
           {"joints: {left_hip: left_hipp}\n",
            "robot.yaml:3:20: joints.left_hip: expected a joint named 'left_hipp' in robot.xml "
            "(did you mean 'left_hip'?)"},
           {"joints:\n  right_wheel: wheel_of_the_right\n",
            "robot.yaml:4:16: joints.right_wheel: "},
           {"joints: {hip_left: left_hip}\n", "left_hip"},
           {"hip: none\nheld: [left_hip, other]\n",
            "robot.yaml:4:18: held: expected a joint named 'other'"},
           {"held: [left_hip, left_hip]\n", "robot.yaml:3:18: held: 'left_hip' is listed twice"},
           {"held: [a, b, c, d, e, f, g, h, i]\n", "robot.yaml:3:7: held: expected at most 8"},
           {"tyres: {right: right_tyre}\n",
            "robot.yaml:3:16: tyres.right: expected a geom or a body named 'right_tyre'"},
           {"imu: gyro\n", "robot.yaml:3:6: imu: expected a site or a body named 'gyro'"},
           {"hip: no\n", "hip"},
           {"hip: none\n", "joint 'left_hip'"},  // neither a servo nor held
           {"held_servo: {kp: -1}\n", "robot.yaml:3:18: held_servo.kp: expected"},
           {"held_servo: {stiffness: 1}\n", "robot.yaml:3:14: held_servo.stiffness"},
           {"mas: 1.5\n", "robot.yaml:3:1: mas: unknown key (did you mean 'mass'?)"},
           {"mass: heavy\n", "robot.yaml:3:7: mass: expected"},
           {"mass: .nan\n", "mass: expected"},
           {"wheel_radius: 0\n", "wheel_radius: expected"},
           {"legs: {left: {lenght: 1}}\n",
            "robot.yaml:3:15: legs.left.lenght: unknown key (did you mean 'length'?)"},
           {"legs: {middle: {length: 1}}\n", "middle"},
           {"legs: {right: {length: -1}}\n", "legs.right.length"},
           {"stance: {knee: 3}\n", "robot.yaml:3:16: stance.knee: expected -2.51 to 2.51"},
           {"stance: {hip: 3}\n", "stance.hip: expected"},
           {"actuators:\n  knee: {friction: -1}\n", "robot.yaml:4:20: actuators.knee.friction"},
           {"actuators:\n  knee: {command_delay: -0.1}\n", "command_delay"},
           {"actuators:\n  knee: {fricton: 1}\n", "did you mean 'friction'?"},
           {"actuators: {elbow: {}}\n", "elbow"},
           {"tyre: {law: spring_damper, stiffness: 5}\n",
            "tyre.stiffness: expected a number from 100"},
           {"tyre: {law: spring_damper, damping: 0}\n", "tyre.damping"},
           {"tyre: {law: spring_damper, width: -1}\n", "tyre.width"},
           {"tyre: {law: spring_damper, stifness: 1e4}\n", "did you mean 'stiffness'?"},
           {"tyre: {law: springdamper}\n", "robot.yaml:3:13: tyre.law: "},
           {"tyre: {law: springdamper}\n", "engine, spring_damper (did you mean 'spring_damper'?)"},
           {"tyre: {stiffness: 1e4}\n", "tyre.stiffness"},
           {"tyre: {stiffness: 1e4}\n", "law: spring_damper"},
           {"tyre: {law: engine, width: 0.04}\n", "law: spring_damper"}}) {
    EXPECT_THAT(complaint(upkie, keys), HasSubstr(words)) << keys;
  }
}

TEST_F(RefusedRobot, HasAnMjcfThatIsNotThere) {
  folder_.write("upkie.xml", edited_upkie({}));
  const auto load = [&](const std::string& text) {
    return compile_robot_model(folder_.write("robot.yaml", text), Terrain{});
  };
  expect_refused(
      {{"actuators: {}\n", {"mjcf"}},
       {"mjcf: nothing.xml\n", {"robot.yaml:1:7: mjcf: ", "nothing.xml: no such file"}},
       {"mass: 2\nmjcf: upky.xml\n", {"robot.yaml:2:7: mjcf: ", "did you mean 'upkie.xml'?"}},
       {"mjcf: " TOUCHDOWN_SOURCE_DIR "/models/upky.xml\n", {"did you mean 'upkie.xml'?"}}},
      load);
}

TEST_F(RefusedRobot, HasPartsThatItsKeysCannotChange) {
  const std::string lower = "<body name=\"left_lower_leg\"";
  const std::string right = "<body name=\"right_upper_leg\"";
  EXPECT_THAT(
      complaint(edited_upkie({{lower, "<body name=\"shim\">" + lower}, {right, "</body>" + right}}),
                "legs: {length: 1.1}\n"),
      AllOf(HasSubstr("robot.yaml:3:7: legs: expected"), HasSubstr("'left_knee'")))
      << "a leg of three links";
  expect({{{"type=\"sphere\" size=\"0.05\" pos=\"0 -0.046 0\"",
            "type=\"cylinder\" size=\"0.05 0.02\" pos=\"0 -0.046 0\""},
           "robot.xml:80:13: geom 'left_tire': expected a sphere"}},
         "tyre: {law: spring_damper, width: 0.04}\n");
}

TEST_F(RefusedRobot, HasHeldJointsThatNoServoCanHold) {
  const std::string keys = "held: [left_roll, right_roll]\n";
  const std::string motor = "<motor joint=\"{0}_roll\" ctrlrange=\"-9 9\"/>\n";
  for (const auto& [mjcf, words] : std::vector<RefusedText>{
           {rolling_upkie("", ""), "motor of joint 'left_roll': expected a ctrlrange"},
           {rolling_upkie("", "<position joint=\"{0}_roll\" kp=\"9\"/>\n"), "forcerange"},
           {rolling_upkie("", "<motor joint=\"{0}_roll\" ctrlrange=\"0 9\"/>\n"), "symmetric"},
           {rolling_upkie("", motor + motor), "several"},
           {rolling_upkie("stiffness=\"5\"", motor), "joint 'left_roll': expected no spring"},
           {rolling_upkie("type=\"slide\"", motor), "joint 'left_roll': expected a hinge"},
           {rolling_upkie("/><joint axis=\"0 0 1\"", motor), "expected"}}) {
    EXPECT_THAT(complaint(mjcf, keys), HasSubstr(words)) << words;
  }
}

TEST_F(RefusedRobot, HasNoMeshesThatCount) {
  const Edit asset = {"<asset>", "<asset>\n<mesh name=\"shell\" file=\"shell.stl\"/>\n"};
  const auto with = [&](const std::string& geom) {
    return edited_upkie({asset, {"<site name=\"imu\"", geom + "<site name=\"imu\""}});
  };
  EXPECT_EQ(complaint(with("<geom type=\"mesh\" mesh=\"shell\" mass=\"0\"/>")), "no complaint");
  EXPECT_THAT(
      complaint(with("<body name=\"hat\"><geom class=\"visual\" type=\"mesh\" mesh=\"shell\" "
                     "mass=\"1\"/></body>")),
      AllOf(HasSubstr("body 'hat' has its mass from it"), HasSubstr("<inertial>")));
  EXPECT_EQ(complaint(with("<geom class=\"visual\" type=\"mesh\" mesh=\"shell\"/>")),
            "no complaint");
}

TEST_F(RefusedRobot, HasNoObjThatCountsMoreThanItHas) {
  const Edit asset = {"<asset>", "<asset>\n<mesh name=\"shell\" file=\"shell.OBJ\"/>\n"};
  const std::string robot =
      edited_upkie({asset,
                    {"<site name=\"imu\"",
                     "<geom class=\"visual\" type=\"mesh\" mesh=\"shell\"/><site name=\"imu\""}});
  const std::string four = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nvt 0 0\n";
  const std::string rest = "f 1 2 4\nf 1 3 4\nf 2 3 4\n";
  for (const char* face :
       {"1 2 2147483647", "1 2 5", "1 2 0", "-5 1 2", "1 2 -2147483648", "1/2 2 3", "1//2 2 3",
        "1/1/9 2 3", "1 2 99999999999999999999", "1 2 x"}) {
    folder_.write("shell.OBJ", four + "f " + face + "\n" + rest);
    EXPECT_THAT(complaint(robot), HasSubstr("shell.OBJ:7: a face with a corner '")) << face;
  }
  for (const char* face : {"1 2 3", "-4 -3 -2", "1/1 2/1 3/1", "1//1 2//1 3//1",
                           "1/1/1 2/1/1 3/1/1", "1/-1/-1 2/1/1 3/1/1"}) {
    folder_.write("shell.OBJ", four + "f " + face + "\n" + rest);
    EXPECT_EQ(complaint(robot), "no complaint") << face;
  }
}

}  // namespace
}  // namespace touchdown::models
