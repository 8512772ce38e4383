#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/cross_simulator.hpp"
#include "cli/show_result.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "experiments/file_kind.hpp"
#include "experiments/resources.hpp"
#include "experiments/run_experiment.hpp"

namespace touchdown {

namespace {

struct RunFlags {
  std::string experiment;
  std::string out;
  std::vector<std::string> overrides;
  std::string shard;
  bool dry_run = false;
  bool no_pictures = false;
};

void run_one_shard(const Experiment& experiment, const Shard& shard, const RunOptions& options) {
  const ShardReport report = run_shard(experiment, shard, options);
  for (const PlayedRun& run : report.failed_runs) {
    fmt::print("Not used: {} ({})\n", run.plan.file,
               run.report.error.empty() ? to_text(run.report.outcome) : run.report.error);
  }
  fmt::print("shard {}: {} parts, {} computed now\n", to_text(shard), report.tasks,
             report.computed);
  fmt::print("when all {} are done: touchdown merge {}\n", shard.count,
             report.directory.path().string());
}

void outline(const Experiment& experiment, const RunOptions& options) {
  const RunOutline outline = outline_of(experiment, options);
  fmt::print("results   {}\nparts     {}\n", outline.directory.string(), outline.tasks);
}

void run(const RunFlags& flags, const Session& session) {
  std::optional<Shard> shard;
  if (!flags.shard.empty()) shard = shard_from(flags.shard);
  YamlDocument document = YamlDocument::load(find_resource(flags.experiment));
  for (const std::string& assignment : flags.overrides) document.override_value(assignment);
  require_kind(document, FileKind::experiment);
  const RunOptions options{.out = flags.out, .command = session.command, .stop = session.stop};
  if (is_cross_simulator(document)) {
    if (shard) throw InputError("--shard: a cross_simulator experiment is not cut into shards");
    if (flags.dry_run) throw InputError("--dry-run: not for a cross_simulator experiment");
    check_across_simulators(cross_simulator_from_yaml(document), options, flags.no_pictures);
    return;
  }
  const Experiment experiment = experiment_from_yaml(document);
  if (flags.dry_run) {
    outline(experiment, options);
    return;
  }
  if (shard) {
    run_one_shard(experiment, *shard, options);
    return;
  }
  ExperimentResult result = run_experiment(experiment, options);
  show(result, session, flags.no_pictures);
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
  verb->add_option("--shard", flags->shard,
                   "Compute one part of n into the run directory, for `touchdown merge`")
      ->type_name("K/N");
  verb->add_flag("--dry-run", flags->dry_run,
                 "Only check the experiment, and say where its results go and in how many parts\n"
                 "it can be computed");
  verb->add_flag("--no-pictures", flags->no_pictures, "Tables only: no figures, no videos");
  verb->callback(
      [flags, &session] { session.action = [flags, &session] { run(*flags, session); }; });
}

}  // namespace touchdown
