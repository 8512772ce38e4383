#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/estimate/listeners.hpp"
#include "cli/estimate/outputs.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "experiments/logs/estimator.hpp"
#include "recordings/log/byte_source.hpp"
#include "render/curves/log_figure.hpp"

namespace touchdown::cli {

namespace {

struct EstimateFlags {
  std::vector<std::string> logs;
  std::string model;
  std::string estimator;
  std::vector<std::string> outputs;
  std::string figure;
  DrawnPart drawn;
};

/// Runs over the log and returns the summary.
std::string listen(recordings::LogReader& reader, const experiments::LogEstimator& chosen,
                   EstimateListeners& listeners) {
  experiments::LogListener log(reader);
  const std::unique_ptr<ContactEstimator> estimator = chosen.make(log.sample_rate());
  listeners.begin(log);
  try {
    while (const experiments::LogStep* step = log.next()) {
      listeners.listen(reader, *step, *estimator, estimator->update(step->signals));
    }
  } catch (const InputError&) {
    listeners.flush();  // what a live stream said before it broke
    throw;
  }
  const std::string summary = listeners.finish(reader);
  return fmt::format("{}: {} steps, {:.3f} s at {:.6g} Hz, {}\n", reader.name(), listeners.steps(),
                     static_cast<double>(listeners.steps()) * log.period(), log.sample_rate(),
                     chosen.entry.title) +
         summary;
}

void estimate_log(const std::string& path, const experiments::LogEstimator& estimator,
                  const EstimateFlags& flags, const EstimateOutputs& outputs,
                  const CliSession& session) {
  std::string summary;
  write_outputs(outputs, [&](std::ostream* csv, std::ostream* mpack) {
    EstimateListeners listeners(csv, mpack,
                                flags.figure.empty() ? std::nullopt : std::optional(flags.drawn));
    const bool live = path == "-";
    // Whoever watches a live stream sees every line before the program waits for the next one.
    const recordings::ByteSource source =
        [&, bytes = recordings::file_source(path, session.stop)](std::span<char> buffer) {
          if (outputs.prints_csv()) listeners.flush();
          return bytes(buffer);
        };
    recordings::LogReader reader(source, live ? "standard input" : path);
    summary = listen(reader, estimator, listeners);
    if (*session.stop && !live) throw Stopped("stopped; nothing was written");
    for (const std::string& warning : reader.warnings()) {
      fmt::print(stderr, "touchdown: {}\n", warning);
    }
    if (!outputs.figure.empty()) {
      if (listeners.trace().bins().empty()) {
        throw InputError("--figure: there is no step between --from and --to");
      }
      const render::Figure figure = render::draw_log(
          listeners.trace(), fmt::format("{}, {}", reader.name(), estimator.entry.title),
          outputs.figure);
      summary += fmt::format("{:<12} {}\n", "figure", figure.png.string());
    }
  });
  if (!outputs.csv.empty() && !outputs.prints_csv()) {
    summary += fmt::format("{:<12} {}\n", "beliefs", outputs.csv.string());
  }
  if (!outputs.mpack.empty()) {
    summary += fmt::format("{:<12} {}\n", "log", outputs.mpack.string());
  }
  fmt::print(outputs.prints_csv() ? stderr : stdout, "{}", summary);
}

void estimate(const EstimateFlags& flags, const CliSession& session) {
  const experiments::LogEstimator estimator =
      experiments::log_estimator(flags.estimator, flags.model);
  const std::vector<EstimateOutputs> outputs =
      estimate_outputs(flags.logs, flags.outputs, flags.figure);
  for (std::size_t i = 0; i < flags.logs.size(); ++i) {
    if (i > 0) fmt::print(outputs[i].prints_csv() ? stderr : stdout, "\n");
    estimate_log(flags.logs[i], estimator, flags, outputs[i], session);
  }
}

}  // namespace

void add_estimate(CLI::App& program, CliSession& session) {
  CLI::App* verb = program.add_subcommand(
      "estimate",
      "touchdown estimate robot.mpack --model model.npz -o beliefs.csv --figure beliefs.png\n"
      "… | touchdown estimate - --model model.npz\n\n"
      "Listens to Upkie's logs and says which wheels touched the ground. With - it listens to a\n"
      "live stream and prints as it goes.");
  const auto flags = std::make_shared<EstimateFlags>();
  verb->add_option("log", flags->logs, "Logs; - is standard input")->type_name("LOG")->required();
  verb->add_option("--model", flags->model, "What `touchdown fit` wrote")->type_name("FILE.npz");
  verb->add_option("--estimator", flags->estimator,
                   "Any that `touchdown list` shows (default: robust; phase for a phase model)");
  verb->add_option("-o,--output", flags->outputs,
                   "Beliefs as FILE.csv, or the log with beliefs in it as FILE.mpack, or both; - "
                   "prints the table. With several logs, the log's name is put before FILE")
      ->type_name("FILE")
      ->allow_extra_args(false);
  verb->add_option("--figure", flags->figure, "Signals and beliefs over time")
      ->type_name("FILE.png");
  verb->add_option("--from", flags->drawn.from, "The figure begins at this time of the log (s)");
  verb->add_option("--to", flags->drawn.to, "The figure ends at this time of the log (s)");
  verb->callback(
      [flags, &session] { session.action = [flags, &session] { estimate(*flags, session); }; });
}

}  // namespace touchdown::cli
