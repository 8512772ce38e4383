#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/plan/request.hpp"
#include "tests/complaint.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const char* const study = R"(name: study
estimators: [robust, paper]
sensors: noise/profiles/upkie.yaml
fit: {scenarios: [scenarios/stairs.yaml], runs: 3}
test:
  scenarios: {generate: {seed: 3, count: 2}}
  runs: 4
noise:
  torque: [0.0, 1.0]
  accelerometer: [0.0, 5.0]
)";

/// Experiment files that name each other.
struct ABase : ::testing::Test {
  std::string path(const std::string& name) const { return (folder / name).string(); }

  Experiment read(const std::string& name, const std::vector<std::string>& set = {}) const {
    return experiment_from_yaml(
        completed(YamlDocument::load(path(name)), YamlKind::experiment, set));
  }

  std::string complaint(const std::string& text, const std::vector<std::string>& set = {}) const {
    folder.write("own.yaml", text);
    return complaint_of([&] { (void)read("own.yaml", set); });
  }

  const ScratchFolder folder;
  const std::string base = "base: " + folder.write("study.yaml", study).string() + "\n";
};

TEST_F(ABase, KeepsTheKeysThatAreNotStated) {
  folder.write("own.yaml", base +
                               "name: own\nestimators: [load_filter]\nsensors: ~\n"
                               "fit: {runs: 2}\ntest: {scenarios: {generate: {count: 5}}}\n"
                               "noise: {torque: [2]}\n");
  const Experiment own = read("own.yaml", {"noise.seeds=7"});
  EXPECT_EQ(own.name, "own");
  EXPECT_THAT(own.estimators, ElementsAre("load_filter")) << "lists replace";
  EXPECT_EQ(own.sensors, "") << "~ removes";
  EXPECT_THAT(own.fit.scenarios, ElementsAre("scenarios/stairs.yaml"));
  EXPECT_EQ(own.fit.runs, 2);
  EXPECT_EQ(own.test.scenarios.size(), 5U);
  EXPECT_EQ(own.test.runs, 4);
  EXPECT_THAT(own.noise.torque, ElementsAre(2.0));
  EXPECT_THAT(own.noise.accelerometer, ElementsAre(0.0, 5.0));
  EXPECT_EQ(own.noise.seeds, 7) << "--set comes last";
  EXPECT_THAT(read("study.yaml").estimators, ElementsAre("robust", "paper"));
}

TEST_F(ABase, MakesTheRequestOfTheSameExperimentWrittenOut) {
  folder.write("nearer.yaml", base + "name: nearer\ntest: {runs: 5}\nnoise: {torque: [2]}\n");
  folder.write("own.yaml", "base: " + path("nearer.yaml") +
                               "\nname: own\nsensors: ~\nnoise: {seeds: 2, torque: [3]}\n");
  folder.write("whole.yaml", R"(name: own
estimators: [robust, paper]
fit: {scenarios: [scenarios/stairs.yaml], runs: 3}
test: {scenarios: {generate: {seed: 3, count: 2}}, runs: 5}
noise: {torque: [3.0], accelerometer: [0.0, 5.0], seeds: 2}
)");
  EXPECT_EQ(request_of(read("own.yaml")).id, request_of(read("whole.yaml")).id);
  EXPECT_THAT(to_yaml(read("own.yaml")), Not(HasSubstr("base:")));
}

TEST_F(ABase, KeepsTheOrderOfItsKeys) {
  folder.write("swept.yaml",
               base + "vary: {sensors.torque.scale: [0.1], sensors.torque.bias: [0.2]}\n");
  folder.write("own.yaml", "base: " + path("swept.yaml") +
                               "\nvary: {sensors.dropout: [0.01], sensors.torque.bias: [0.3]}\n");
  const std::string written = to_yaml(read("own.yaml"));
  EXPECT_LT(written.find("torque.scale"), written.find("torque.bias"));
  EXPECT_LT(written.find("torque.bias"), written.find("dropout"));
}

TEST_F(ABase, NamesAWrongValueWhereItStands) {
  folder.write("wrong.yaml", base + "noise:\n  seeds: none\nfit:\n  rusn: 3\n");
  const std::string on_wrong = "base: " + path("wrong.yaml") + "\n";
  EXPECT_THAT(complaint(base + "noise:\n  torqe: [0]\n"),
              AllOf(StartsWith(path("own.yaml") + ":3:3: noise.torqe: unknown key"),
                    HasSubstr("did you mean 'torque'?")));
  EXPECT_THAT(complaint(on_wrong + "noise: {torque: [0]}\nfit: {rusn: ~}\n"),
              StartsWith(path("wrong.yaml") + ":3:10: noise.seeds: expected a whole number"));
  EXPECT_THAT(
      complaint(on_wrong + "noise: {seeds: 3}\n"),
      StartsWith(path("wrong.yaml") + ":5:3: fit.rusn: unknown key (did you mean 'runs'?)"));
  EXPECT_THAT(complaint(base + "test:\n  scenarios: ~\n"),
              StartsWith(path("own.yaml") + ":3:3: test.scenarios: is missing"));
  EXPECT_THAT(complaint(base + "fit: 3\n"), StartsWith(path("own.yaml") + ":2:6: fit: expected"));
  EXPECT_THAT(complaint(base + "highligths: ~\n"),
              StartsWith(path("own.yaml") + ":2:1: highligths: unknown key"));
  EXPECT_THAT(complaint(base, {"noise.seeds=none"}), StartsWith("--set noise.seeds=none: "));
}

TEST_F(ABase, IsNamedWhereItIsMissingOrMisspelt) {
  EXPECT_THAT(complaint("name: own\nbase: experiments/stiars.yaml\n"),
              AllOf(StartsWith(path("own.yaml") + ":2:7: base: experiments/stiars.yaml: no such"),
                    EndsWith("(did you mean 'experiments/stairs.yaml'?)")));
  EXPECT_THAT(complaint("base: [a.yaml]\n"),
              StartsWith(path("own.yaml") + ":1:7: base: expected a file"));
  EXPECT_THAT(complaint("name: own\nbaes: experiments/stairs.yaml\n"),
              StartsWith(path("own.yaml") + ":2:1: baes: unknown key (did you mean 'base'?)"));
  EXPECT_THAT(complaint("base: experiments/nmn.yaml\n"), HasSubstr("is a training file"));
  EXPECT_THAT(complaint(study, {"base=experiments/stairs.yaml"}),
              StartsWith("--set base=experiments/stairs.yaml: base: expected in a file alone"));
}

TEST_F(ABase, OfItselfIsRefused) {
  const std::string itself = "' is based on itself";
  EXPECT_EQ(complaint("name: own\nbase: " + path("own.yaml") + "\n"),
            path("own.yaml") + ":2:7: base: '" + path("own.yaml") + itself);
  folder.write("other.yaml", "base: " + path("own.yaml") + "\n");
  EXPECT_EQ(complaint("base: " + path("other.yaml") + "\n"),
            path("own.yaml") + ":1:7: base: '" + path("other.yaml") + itself);
}

}  // namespace
}  // namespace touchdown::experiments
