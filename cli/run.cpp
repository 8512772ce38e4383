#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "cli/pictures.hpp"
#include "cli/verbs.hpp"
#include "experiments/resources.hpp"
#include "experiments/run_experiment.hpp"

namespace touchdown {

namespace {

struct RunFlags {
  std::string experiment;
  std::string out;
  std::vector<std::string> overrides;
  bool no_pictures = false;
};

void run(const RunFlags& flags, const Session& session) {
  YamlDocument document = YamlDocument::load(find_resource(flags.experiment));
  for (const std::string& assignment : flags.overrides) document.override_value(assignment);
  const Experiment experiment = experiment_from_yaml(document);
  ExperimentResult result = run_experiment(
      experiment, {.out = flags.out, .command = session.command, .stop = session.stop});
  fmt::print("{}", summary_text(result));
  fmt::print("\nresults   {}\ntables    {}\n", result.directory.path().string(),
             (result.directory.path() / "tables").string());
  std::fflush(stdout);
  if (flags.no_pictures) return;
  for (const auto& picture : draw_pictures(result, session)) {
    fmt::print("{:<9} {}\n", picture.kind, picture.path.string());
  }
  write_manifest(result);
}

}  // namespace

void add_run(CLI::App& program, Session& session) {
  CLI::App* verb = program.add_subcommand(
      "run",
      "touchdown run experiments/stairs.yaml\n\n"
      "Runs an experiment: simulates, fits, listens through noise, scores, draws.");
  const auto flags = std::make_shared<RunFlags>();
  verb->add_option("experiment", flags->experiment, "Experiment file")->required();
  verb->add_option("--out", flags->out, "Run directory (default: runs/<experiment>/<id>)")
      ->type_name("DIR");
  verb->add_option("--set", flags->overrides,
                   "Change a value of the experiment, for example noise.seeds=3")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb->add_flag("--no-pictures", flags->no_pictures, "Tables only: no figures, no videos");
  verb->callback(
      [flags, &session] { session.action = [flags, &session] { run(*flags, session); }; });
}

}  // namespace touchdown
