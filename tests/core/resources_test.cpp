#include "core/resources.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/complaint.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

std::string missing_in(YamlDocument document, const std::string& assignment = "") {
  if (!assignment.empty()) document.override_value(assignment);
  return complaint_of([&] {
    require_resources(document, {"robot", "fit.scenarios", "closed_loop.scenes.scenario"},
                      [](const std::string& name) { (void)find_resource(name); });
  });
}

std::string missing_in(const std::string& text, const std::string& assignment = "") {
  return missing_in(YamlDocument::parse(text, "x.yaml"), assignment);
}

TEST(RequiredResources, ThatAreThereOrNotAskedForAreNoComplaint) {
  EXPECT_EQ(missing_in("fit: {scenarios: [scenarios/stairs.yaml, scenarios/roam.yaml]}\n"
                       "robot: models/upkie_actuated.yaml\n"),
            "no complaint");
  EXPECT_EQ(missing_in("fits: {scenarios: [nowhere.yaml]}\nclosed_loop: {scenes: []}\n"),
            "no complaint");
}

TEST(RequiredResources, OfAFolderThatIsGoneAreSuggestedByTheirName) {
  EXPECT_THAT(missing_in("robot: sensors/upkie.yaml\n"),
              EndsWith("sensors/upkie.yaml: no such file (did you mean "
                       "'noise/profiles/upkie.yaml'?)"));
  EXPECT_THAT(missing_in("robot: terrains/roam.yaml\n"),
              EndsWith("(did you mean 'scenarios/roam.yaml'?)"));
  EXPECT_THAT(missing_in("robot: terrains/mine.yaml\n"), EndsWith("mine.yaml: no such file"));
}

TEST(RequiredResources, ThatAreMissingAreNamedWhereTheyStand) {
  EXPECT_THAT(missing_in("fit:\n  scenarios: [scenarios/roam.yaml, scenarios/stiars.yaml]\n"),
              AllOf(StartsWith("x.yaml:2:36: fit.scenarios.1: scenarios/stiars.yaml: no such file"),
                    EndsWith("(did you mean 'scenarios/stairs.yaml'?)")));
  EXPECT_THAT(
      missing_in(
          "closed_loop:\n  scenes:\n    - {runs: 1}\n    - {scenario: scenarios/hnag.yaml}\n"),
      StartsWith("x.yaml:4:18: closed_loop.scenes.1.scenario: scenarios/hnag.yaml: no such file"));
}

TEST(RequiredFile, ThatIsNotThereBringsTheNearestOfItsKindToMind) {
  const ScratchFolder folder;
  for (const char* name : {"labels.csv", "label.npz", "other.csv"}) folder.write(name, "");
  const auto complains = [](const std::string& end) {
    return ThrowsMessage<InputError>(EndsWith(end));
  };
  EXPECT_THAT([&] { require_file(folder / "lables.csv"); },
              complains("lables.csv: no such file (did you mean 'labels.csv'?)"));
  EXPECT_THAT([&] { require_file(folder / "unlike.csv"); }, complains("unlike.csv: no such file"));
  EXPECT_THAT([&] { require_file(folder / "nowhere/labels.csv"); },
              complains("nowhere/labels.csv: no such file"));
  EXPECT_THAT([&] { require_file(folder.path()); }, complains(": is a folder, expected a file"));
  EXPECT_NO_THROW(require_file(folder / "labels.csv"));
  EXPECT_THAT([] { require_file("/dev/null"); }, complains("/dev/null: is not a regular file"));
}

TEST(Resources, OfTheProgramAreNotReplacedByTheWorkingDirectory) {
  namespace fs = std::filesystem;
  const ScratchFolder folder;
  const fs::path before = fs::current_path();
  const fs::path own = fs::path(TOUCHDOWN_SOURCE_DIR) / "models/upkie.xml";
  folder.write("models/upkie.xml", "mine");
  folder.write("models/mine.npz", "mine");
  fs::current_path(folder.path());
  const fs::path named_by_user = find_resource("models/upkie.xml");
  const fs::path named_by_program = find_program_file("models/upkie.xml");
  const fs::path only_here = find_program_file("models/mine.npz");
  fs::current_path(TOUCHDOWN_SOURCE_DIR);
  const fs::path in_its_folder = find_program_file("models/upkie.xml");
  fs::current_path(before);
  EXPECT_EQ(named_by_user, "models/upkie.xml");
  EXPECT_EQ(named_by_program, own);
  EXPECT_EQ(only_here, "models/mine.npz");
  EXPECT_EQ(in_its_folder, "models/upkie.xml");
  EXPECT_THROW(find_program_file("models/nowhere.npz"), InputError);
}

TEST(RequiredResources, ThatAreOverriddenAreReportedAtTheOverride) {
  EXPECT_THAT(missing_in("robot: models/upkie_actuated.yaml\n", "robot=models/upkei.xml"),
              StartsWith("--set robot=models/upkei.xml: robot: models/upkei.xml: no such file"));
}

}  // namespace
}  // namespace touchdown
