#include <algorithm>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/table.hpp"
#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr int wrong_request = 2;

/// The one-line message about a wrong request.
std::string complaint_about(const std::string& arguments, const ScratchFolder& folder) {
  const Ended ended = touchdown_program(arguments, folder.path());
  EXPECT_EQ(ended.exit_code, wrong_request) << ended.errors;
  EXPECT_EQ(ended.output, "");
  EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
  EXPECT_THAT(ended.errors, StartsWith("touchdown: "));
  return ended.errors;
}

std::string minimal(const std::string& more) {
  return "name: tiny\nfit: {scenarios: [step.yaml]}\ntest: {scenarios: [step.yaml]}\n" + more;
}

TEST(WrongRequest, AnUnknownVerbSuggestsTheNearestOne) {
  EXPECT_THAT(complaint_about("rnu x.yaml", {}),
              AllOf(HasSubstr("unknown command 'rnu'"), HasSubstr("did you mean 'run'?")));
}

TEST(WrongRequest, AnUnknownFlagSuggestsTheNearestOne) {
  EXPECT_THAT(complaint_about("run x.yaml --otu dir", {}),
              AllOf(HasSubstr("'--otu'"), HasSubstr("did you mean '--out'?")));
}

TEST(WrongRequest, AMissingArgumentIsNamed) {
  EXPECT_THAT(complaint_about("run", {}), HasSubstr("experiment"));
}

TEST(WrongRequest, AMissingFileSuggestsTheNearestOne) {
  EXPECT_THAT(complaint_about("run experiments/stiars.yaml", {}),
              AllOf(HasSubstr("experiments/stiars.yaml: no such file"),
                    HasSubstr("did you mean 'experiments/stairs.yaml'?")));
}

TEST(WrongRequest, AFileThatAnExperimentNamesAndThatIsMissingIsShownWithItsPlace) {
  const ScratchFolder folder;
  folder.write("step.yaml", "name: step\n");
  folder.write("x.yaml", minimal("sensors: sensors/upkei.yaml\n"));
  for (const char* run : {"run x.yaml", "run x.yaml --dry-run"}) {
    EXPECT_THAT(complaint_about(run, folder),
                AllOf(HasSubstr("x.yaml:4:10: sensors: sensors/upkei.yaml: no such file"),
                      HasSubstr("did you mean 'sensors/upkie.yaml'?")));
  }
}

TEST(WrongRequest, AnUnknownKeyIsShownWithItsPlaceAndTheNearestKey) {
  const ScratchFolder folder;
  folder.write("x.yaml", minimal("noise:\n  sedes: 3\n"));
  EXPECT_THAT(complaint_about("run x.yaml", folder),
              AllOf(HasSubstr("x.yaml:5:3: noise.sedes"), HasSubstr("did you mean 'seeds'?")));
}

TEST(WrongRequest, AWrongTypeIsShownWithItsPlaceAndWhatWasExpected) {
  const ScratchFolder folder;
  folder.write("x.yaml", minimal("seed: many\n"));
  EXPECT_THAT(complaint_about("run x.yaml", folder),
              AllOf(HasSubstr("x.yaml:4:7: seed"), HasSubstr("expected a whole number")));
}

TEST(WrongRequest, AValueOutOfRangeIsShownWithTheRange) {
  const ScratchFolder folder;
  folder.write("x.yaml", minimal("noise: {seeds: 0}\n"));
  EXPECT_THAT(complaint_about("run x.yaml", folder),
              AllOf(HasSubstr("noise.seeds"), HasSubstr("from 1 to")));
}

TEST(WrongRequest, AnUnknownSimulatorSuggestsTheNearestOne) {
  const ScratchFolder folder;
  folder.write("x.yaml", minimal("simulators: [mujco]\n"));
  EXPECT_THAT(complaint_about("run x.yaml", folder),
              AllOf(HasSubstr("x.yaml:4:14: simulators"), HasSubstr("did you mean 'mujoco'?")));
  write_tiny_experiment(folder);
  EXPECT_THAT(complaint_about("simulate step.yaml --simulator bulet -o x.mpack", folder),
              HasSubstr("bullet"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "x.mpack"));
}

TEST(WrongRequest, AFileOfAnotherKindSuggestsItsVerb) {
  EXPECT_THAT(complaint_about("run experiments/nmn.yaml", {}),
              HasSubstr("experiments/nmn.yaml: is a training file; try: touchdown train "));
  EXPECT_THAT(complaint_about("run scenarios/stairs.yaml", {}),
              HasSubstr("scenarios/stairs.yaml: is a scenario; try: touchdown simulate "));
  EXPECT_THAT(complaint_about("simulate experiments/stairs.yaml -o x.mpack", {}),
              HasSubstr("experiments/stairs.yaml: is an experiment; try: touchdown run "));
}

TEST(WrongRequest, AnUnknownEstimatorSuggestsTheNearestOne) {
  const ScratchFolder folder;
  folder.write("x.yaml", minimal("estimators: [robst]\n"));
  EXPECT_THAT(complaint_about("run x.yaml", folder), HasSubstr("did you mean 'robust'?"));
}

TEST(WrongRequest, AHighlightOutsideTheGridIsRefused) {
  const ScratchFolder folder;
  folder.write("x.yaml", minimal("highlights: [{torque: 0.5, accelerometer: 0.0}]\n"));
  EXPECT_THAT(complaint_about("run x.yaml", folder), HasSubstr("highlights.0.torque"));
}

TEST(WrongRequest, AnOverrideOfAnUnknownKeyIsRefused) {
  const ScratchFolder folder;
  const std::string experiment = write_tiny_experiment(folder);
  EXPECT_THAT(complaint_about("run " + experiment + " --set noise.sedes=3", folder),
              HasSubstr("did you mean 'seeds'?"));
  EXPECT_THAT(complaint_about("run " + experiment + " --set noise", folder),
              HasSubstr("key=value"));
}

TEST(WrongRequest, InvalidYamlIsShownWithItsPlace) {
  const ScratchFolder folder;
  folder.write("x.yaml", "name: [tiny\n");
  EXPECT_THAT(complaint_about("run x.yaml", folder), HasSubstr("not valid YAML"));
}

TEST(WrongRequest, AnInvalidLogIsRefused) {
  const ScratchFolder folder;
  folder.write("x.mpack", "no log");
  complaint_about("render x.mpack -o x.mp4", folder);
  EXPECT_THAT(complaint_about("render scenarios/stairs.yaml -o x.mp4", folder),
              HasSubstr("no such file"));
  folder.write("scene.yaml", "name: scene\n");
  EXPECT_THAT(complaint_about("render scene.yaml -o x.mp4", folder),
              HasSubstr("`touchdown simulate` makes such a log of a scenario"));
  complaint_about("render missing.mpack -o x.mp4", folder);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "x.mp4"));
}

TEST(Help, BeginsWithAnExample) {
  for (const std::string verb : {"", "run", "simulate", "render"}) {
    const Ended ended = touchdown_program(verb + " --help", ScratchFolder().path());
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_THAT(ended.output, StartsWith("touchdown " + (verb.empty() ? "run" : verb) + " "));
  }
}

TEST(List, NamesExperimentsScenariosEnginesAndEstimators) {
  const Ended ended = touchdown_program("list", ScratchFolder().path());
  EXPECT_EQ(ended.exit_code, 0);
  for (const char* name : {"experiments/stairs.yaml", "scenarios/stairs.yaml", "mujoco", "bullet",
                           "robust", "always_contact"}) {
    EXPECT_THAT(ended.output, HasSubstr(name));
  }
}

TEST(List, DescribesEachFileInOneShortSentence) {
  constexpr std::size_t longest = 95;
  const Ended ended = touchdown_program("list", ScratchFolder().path());
  const std::regex file_line("\n  \\S+\\.yaml +([^\n]*)");
  int files = 0;
  for (std::sregex_iterator found(ended.output.begin(), ended.output.end(), file_line), end;
       found != end; ++found, ++files) {
    const std::string sentence = found->str(1);
    EXPECT_THAT(sentence, ::testing::EndsWith("."));
    EXPECT_LE(width(sentence), longest) << sentence;
  }
  EXPECT_GE(files, 50);
}

}  // namespace
}  // namespace touchdown::cli
