#include <memory>

#include <fmt/format.h>

#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/program/outputs.hpp"
#include "core/program/streams.hpp"
#include "core/progress.hpp"
#include "core/resources.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "recordings/log/recording_file.hpp"
#include "scenarios/ending.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/generation/named.hpp"
#include "scenarios/scenario_file.hpp"
#include "scoring/labels.hpp"

namespace touchdown::cli {

namespace {

struct SimulateFlags {
  std::string scenario;
  std::string simulator = "mujoco";
  std::string output;
  std::vector<std::string> overrides;
  std::uint64_t seed = 1;
  std::int64_t run = -1;
};

void simulate(const SimulateFlags& flags, const CliSession& session) {
  YamlDocument document = scenarios::scenario_document(flags.scenario);
  for (const std::string& assignment : flags.overrides) document.override_value(assignment);
  experiments::require_yaml_kind(document, experiments::YamlKind::scenario);
  scenarios::Scenario scenario = scenarios::complete_scenario(document);
  check_outputs({{document.name(), "scenario"}, {scenario.robot, "robot"}}, {flags.output});
  require_extension(flags.output, {".mpack"}, "a recording");
  if (flags.run >= 0) scenario = scenarios::perturbed(scenario, flags.seed, flags.run);

  recordings::Recording recording;
  {
    constexpr double ticks_per_second = 1000.0;
    Progress progress("simulating", "ms",
                      static_cast<std::int64_t>(ticks_per_second * scenario.end.duration));
    std::int64_t shown = 0;
    recording = scenarios::play(scenario, flags.simulator, flags.seed,
                                std::max(flags.run, std::int64_t{0}), [&](double time) {
                                  const auto ticks =
                                      static_cast<std::int64_t>(ticks_per_second * time);
                                  progress.advance(ticks - shown);
                                  shown = ticks;
                                  return !*session.stop;
                                });
  }
  if (*session.stop) throw Stopped();
  recordings::write_recording(recording, flags.output);
  const auto all = scoring::flights(scoring::any_wheel(scoring::contact_labels(recording, {})));
  print("{}: {} {}, {} flights\n", flags.output, recording.info.scenario,
        scenarios::ending_text(recording, scenario.end), all.size());
}

}  // namespace

void add_simulate(CLI::App& program, const CliSession& session) {
  Verb verb(program, "simulate",
            "touchdown simulate scenarios/stairs.yaml --simulator bullet -o stairs.mpack\n\n"
            "Simulates one run of a scenario and records it as an Upkie log.");
  const auto flags = std::make_shared<SimulateFlags>();
  verb.option("scenario", &flags->scenario,
              "Scenario file, or a drawn scenario such as drawn:kerbs_7_000")
      .required();
  verb.option("--simulator", &flags->simulator, "Physics engine").shows_default();
  verb.option("-o,--output", &flags->output, "Recording to write")
      .value_name("FILE.mpack")
      .required();
  verb.option("--run", &flags->run,
              "Index of the run: draws its perturbations from the seed (default: no perturbations)")
      .not_negative();
  verb.option("--seed", &flags->seed, "Random seed").shows_default();
  verb.option("--set", &flags->overrides,
              "Override a value of the scenario, for example end.duration=5")
      .value_name("KEY=VALUE")
      .one_at_a_time();
  verb.action([flags, &session] { simulate(*flags, session); });
}

}  // namespace touchdown::cli
