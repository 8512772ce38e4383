#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "core/resources.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/plan/rollouts.hpp"
#include "experiments/results/text_tables.hpp"
#include "experiments/run_experiment.hpp"
#include "render/studies/registry.hpp"

namespace touchdown::cli {

namespace {

struct ShownPictures {
  bool none = false;      ///< tables only
  bool no_video = false;  ///< figures and the report, without films
};

/// The last lines of output: a table of results, the paths of all outputs and the next commands.
std::string last_screen(const experiments::ExperimentResult& result, const CliSession& session) {
  const std::filesystem::path& directory = result.directory.path();
  std::string text =
      fmt::format("{}\nreport    {}\nfigures   {}\n", experiments::closing_text(result),
                  (directory / "report.html").string(), (directory / "figures").string());
  if (is_there(directory / "videos")) {
    text += fmt::format("videos    {}\n", (directory / "videos").string());
  }
  const char* next = result.experiment.name == "noise_study" ? "cross_simulator" : "noise_study";
  return text + fmt::format("\nnext      {0} run experiments/{1}.yaml\n          {0} list\n",
                            session.program, next);
}

/// Prints an experiment's result and its paths, and draws its figures and videos. Errors: `Error`
/// if a demanded verdict fails.
void show(experiments::ExperimentResult& result, const CliSession& session,
          const ShownPictures& pictures) {
  print(experiments::summary_text(result));
  print(fmt::format("\nresults   {}\ntables    {}\n", result.directory.path().string(),
                    (result.directory.path() / "tables").string()));
  flush_printed();
  if (!pictures.none) {
    render::draw_and_report(result, !pictures.no_video, session.stop);
    print(last_screen(result, session));
  }
  if (!result.failed_demands.empty()) {
    throw Error(fmt::format("demanded verdicts fail: {}", fmt::join(result.failed_demands, ", ")));
  }
}

struct RunFlags {
  std::string experiment;
  std::string out;
  std::vector<std::string> overrides;
  std::vector<std::string> shard;  ///< empty, or one text such as "1/3"
  bool overwrite = false;
  bool dry_run = false;
  ShownPictures pictures;
};

void run_one_shard(const experiments::Experiment& experiment, const experiments::Shard& shard,
                   const experiments::RunOptions& options) {
  const experiments::ShardReport report = experiments::run_shard(experiment, shard, options);
  print("{}", experiments::unused_runs_text(report.failed_runs));
  print("shard {}: {} parts, {} computed now\n", experiments::to_text(shard), report.tasks,
        report.computed);
  print("when all {} are done: touchdown run {}\n", shard.count, report.directory.path().string());
}

void outline(const experiments::Experiment& experiment, const experiments::RunOptions& options) {
  const experiments::RunOutline outline = experiments::outline_of(experiment, options);
  // scripts/slurm/submit.sh reads the first two lines.
  print("results   {}\nparts     {}\n", outline.directory.string(), outline.tasks);
  print("runs      {} fitted, {} tested, at most {:.0f} s of simulation\n", outline.fitted_runs,
        outline.test_runs, outline.simulated);
  for (const auto& [name, items] : outline.model_tasks) print("besides   {}, {}\n", name, items);
}

/// Errors: `InputError` for a flag that would make another experiment of a run directory.
void require_as_it_is(const RunFlags& flags) {
  for (const auto& [is_given, flag] :
       {std::pair{!flags.out.empty(), "--out"}, std::pair{!flags.overrides.empty(), "--set"},
        std::pair{!flags.shard.empty(), "--shard"}, std::pair{flags.overwrite, "--overwrite"},
        std::pair{flags.dry_run, "--dry-run"}}) {
    if (!is_given) continue;
    throw InputError(fmt::format(
        "{0}: is a run directory, of which the missing parts are computed and nothing is changed: "
        "for {1} give its experiment, {2}",
        flags.experiment, flag,
        (std::filesystem::path(flags.experiment) / "config.yaml").string()));
  }
}

void run(const RunFlags& flags, const CliSession& session) {
  if (is_folder(flags.experiment)) {
    require_as_it_is(flags);
    experiments::ExperimentResult result = experiments::finish_run(
        flags.experiment, {.out = {}, .command = session.command, .stop = session.stop});
    show(result, session, flags.pictures);
    return;
  }
  std::optional<experiments::Shard> shard;
  if (!flags.shard.empty()) shard = experiments::shard_from(flags.shard.front());
  const YamlDocument document =
      experiments::completed(YamlDocument::load(find_resource(flags.experiment)),
                             experiments::YamlKind::experiment, flags.overrides);
  const experiments::RunOptions options{.out = flags.out,
                                        .command = session.command,
                                        .stop = session.stop,
                                        .overwrite = flags.overwrite};
  const experiments::Experiment experiment = experiments::experiment_from_yaml(document);
  experiments::require_files(document);
  if (flags.dry_run) {
    outline(experiment, options);
    return;
  }
  if (shard) {
    run_one_shard(experiment, *shard, options);
    return;
  }
  experiments::ExperimentResult result = experiments::run_experiment(experiment, options);
  show(result, session, flags.pictures);
}

}  // namespace

void add_run(CLI::App& program, const CliSession& session) {
  Verb verb(
      program, "run",
      "touchdown run experiments/stairs.yaml\n\n"
      "Runs an experiment: simulates, fits and runs estimators on noisy signals, scores them and\n"
      "draws figures. Of a run directory it computes what is missing, such as the results after\n"
      "its last shard, and draws all figures and videos again.");
  const auto flags = std::make_shared<RunFlags>();
  verb.option("experiment", &flags->experiment, "Experiment file, or a run directory").required();
  verb.option("--out", &flags->out, "Run directory (default: runs/<experiment>/<id>)")
      .value_name("DIR");
  verb.option("--set", &flags->overrides,
              "Override a value of the experiment, for example noise.seeds=3")
      .value_name("KEY=VALUE")
      .one_at_a_time();
  verb.option("--shard", &flags->shard,
              "Compute shard K of N into the run directory; after all of them: touchdown run DIR")
      .value_name("K/N")
      .takes(1);
  verb.flag("--overwrite", &flags->overwrite,
            "Replace another experiment in the run directory; untracked files remain");
  verb.flag("--dry-run", &flags->dry_run,
            "Only check the experiment; print its run directory, the number of parts in which it\n"
            "can be computed, and its runs");
  verb.flag("--no-pictures", &flags->pictures.none,
            "Write tables only, without figures and videos");
  verb.flag("--no-video", &flags->pictures.no_video,
            "Write tables, figures and the report, but no videos");
  verb.action([flags, &session] { run(*flags, session); });
}

}  // namespace touchdown::cli
