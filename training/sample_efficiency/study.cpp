#include "training/sample_efficiency/study.hpp"

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "core/progress.hpp"
#include "core/resources.hpp"
#include "estimator/neural/estimator.hpp"
#include "experiments/estimators/measurement_fitting.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/evaluation/sweep_run.hpp"
#include "experiments/figures/groups.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_directory/owner.hpp"
#include "experiments/signals/run_signals.hpp"
#include "recordings/models/neural_network.hpp"
#include "render/figures/facets.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/generation/named.hpp"
#include "simulators/registry.hpp"
#include "training/initial_weights.hpp"
#include "training/rollout.hpp"
#include "training/trainer.hpp"

namespace touchdown::training {

namespace {

/// Success rate and no-contact recall of both methods against seconds of labelled data.
experiments::FigureSpec figure_of(const Table& table) {
  experiments::FigureSpec spec;
  spec.name = "sample_efficiency";
  spec.table = "sample_efficiency.csv";
  spec.panels = experiments::groups_in(table, "simulator", simulators::simulator_title);
  spec.series = experiments::groups_in(table, "method", [](const auto& title) { return title; });
  spec.x = {.column = "labelled_data_s",
            .title = "labelled data",
            .unit = "s",
            .scale = experiments::AxisScale::log};
  spec.measures = {{.column = "success", .title = "success rate"},
                   {.column = "no_contact_recall", .title = "no-contact recall"}};
  spec.title = "Accuracy against the amount of labelled data";
  spec.caption =
      "Success rate and no-contact recall on the test runs, of estimators fitted or "
      "trained with increasing amounts of labelled data.";
  spec.alt = "Success rate." + experiments::values_text(spec, table);
  return spec;
}

/// Draws the figure. The results are complete without it, so a missing gnuplot is a message only.
void draw(const Table& table, const std::filesystem::path& run_directory) {
  try {
    const experiments::FigureSpec spec = figure_of(table);
    render::draw_facets(spec, table, run_directory / "figures" / spec.name);
  } catch (const Error& error) {
    print_message(fmt::format("no figure: {}\n", error.what()));
  }
}

/// Signals of one run of a scenario file, of at most `longest` seconds.
experiments::RunSignals simulated_signals(const std::string& file, const std::string& simulator,
                                          std::uint64_t seed, std::int64_t run, double longest) {
  scenarios::Scenario scenario = scenarios::find_scenario(file);
  scenario.end.duration = std::min(scenario.end.duration, longest);
  return experiments::signals_of(
      scenarios::play(scenarios::perturbed(scenario, seed, run), simulator, seed, run), {}, {},
      scoring::SampleUnit::run);
}

constexpr double no_limit = 1e9;

class SampleEfficiencyStudy {
 public:
  SampleEfficiencyStudy(const SampleEfficiencyConfig& config, const TrainingRequest& request)
      : config_(config), request_(request) {
    tests_.resize(config.simulators.size() * static_cast<std::size_t>(config.runs));
    Progress progress("test runs", "runs", static_cast<std::int64_t>(tests_.size()));
    tbb::parallel_for(std::size_t{0}, tests_.size(), [&](std::size_t i) {
      const auto run = static_cast<std::int64_t>(i / config.simulators.size());
      tests_[i] =
          simulated_signals(config.test_scenario, config.simulators[i % config.simulators.size()],
                            config.seed, run, no_limit);
      progress.advance();
    });
  }

  Table run() {
    for (const double seconds : config_.filter_seconds) fit_filter(seconds);
    for (const double seconds : config_.network_seconds) train_network(seconds);
    try_shipped_network();
    return table_;
  }

 private:
  void check_stop() const {
    if (request_.wants_stop()) throw Stopped();
  }

  /// Equal amounts from every scenario, with as many runs as needed.
  std::vector<experiments::RunSignals> labelled_runs(double seconds) const {
    std::vector<experiments::RunSignals> runs;
    const scoring::ScoringConfig scoring;
    for (const std::string& file : config_.fit_scenarios) {
      double missing = seconds / static_cast<double>(config_.fit_scenarios.size());
      for (std::int64_t run = experiments::first_fit_run; missing > 1e-9; ++run) {
        check_stop();
        // The skipped beginning is not used for fitting, so it does not count.
        runs.push_back(simulated_signals(file, config_.fit_simulator, config_.seed, run,
                                         missing + scoring.skip));
        const double used = static_cast<double>(runs.back().steps()) * 1e-6 *
                                static_cast<double>(runs.back().info.control_period_us) -
                            scoring.skip;
        missing -= std::max(used, 0.1);
      }
    }
    return runs;
  }

  void fit_filter(double seconds) {
    const std::vector<experiments::RunSignals> runs = labelled_runs(seconds);
    std::vector<const experiments::RunSignals*> pointers;
    for (const experiments::RunSignals& run : runs) pointers.push_back(&run);
    const experiments::EstimatorEntry& entry = experiments::estimator_entry(config_.estimator);
    try {
      experiments::FittedModel model;
      model.measurement = experiments::fit(pointers, entry.config->measurement, {});
      add(entry.title, seconds, [&] { return entry.make(entry, {test_rate(), &model}); });
    } catch (const InputError& error) {
      print_message(fmt::format("{}, {} s: {}\n", entry.title, seconds, error.what()));
    }
  }

  void train_network(double seconds) {
    YamlDocument document = YamlDocument::load(find_resource(config_.training));
    const TrainingConfig training = training_from_yaml(document);
    const double episode = training.rollout.period() * training.rollout.steps;
    const int episodes = std::max(1, static_cast<int>(std::lround(seconds / episode)));
    const EpisodeBatch data =
        roll_out(training.rollout, training_scenes(training.rollout), training.seed, 0, episodes,
                 [this] { return !request_.wants_stop(); });
    Trainer trainer(
        initial_network(training.network, training.seed, data, training.rollout.period()),
        training.optimiser);
    {
      Progress progress(fmt::format("{:.0f} s of data", episodes * episode), "epochs",
                        config_.epochs);
      for (int epoch = 0; epoch < config_.epochs; ++epoch) {
        check_stop();
        trainer.train_epoch(data);
        progress.advance();
      }
    }
    add_network(episodes * episode, std::make_shared<const NeuralNetwork>(trainer.network()));
  }

  /// The last point: the shipped network, with the amount of data it was trained on.
  void try_shipped_network() {
    const auto network =
        std::make_shared<const NeuralNetwork>(recordings::shipped_neural_network("nmn"));
    const auto manifest = nlohmann::json::parse(read_file(find_resource("models/nmn.json")));
    add_network(manifest.at("labelled_data_s").get<double>(), network);
  }

  void add_network(double seconds, const std::shared_ptr<const NeuralNetwork>& network) {
    add("NMN", seconds, [&] {
      NeuralEstimatorConfig config;
      config.sample_rate = test_rate();
      return std::make_unique<NeuralEstimator>(network, config);
    });
  }

  double test_rate() const {
    return 1e6 / static_cast<double>(tests_.front().info.control_period_us);
  }

  /// Evaluates an estimator on all test runs and adds a row per engine.
  template <typename Make>
  void add(const std::string& method, double seconds, const Make& make) {
    const noise::SensorNoise level = config_.noise.levels();
    std::vector<scoring::Classification> counts(tests_.size());
    tbb::parallel_for(std::size_t{0}, tests_.size(), [&](std::size_t i) {
      const experiments::RunSignals& run = tests_[i];
      const experiments::NoiseRun noise = experiments::noise_run(
          run, {.seed = config_.seed, .run = static_cast<std::uint64_t>(run.info.run)});
      counts[i] = experiments::sweep_levels(*make(), {&level, 1}, run, noise, {}, [] {
                    return true;
                  }).front();
    });
    for (std::size_t s = 0; s < config_.simulators.size(); ++s) {
      scoring::Classification sum;
      for (std::size_t i = s; i < counts.size(); i += config_.simulators.size()) sum += counts[i];
      table_.rows.push_back({config_.simulators[s], method, exact(seconds), metric(sum.success()),
                             metric(sum.no_contact_precision()), metric(sum.no_contact_recall())});
    }
  }

  const SampleEfficiencyConfig& config_;
  const TrainingRequest& request_;
  std::vector<experiments::RunSignals> tests_;
  Table table_ = {{"simulator", "method", "labelled_data_s", "success", "no_contact_precision",
                   "no_contact_recall"},
                  {}};
};

}  // namespace

std::filesystem::path sample_efficiency(const SampleEfficiencyConfig& config,
                                        const TrainingRequest& request) {
  experiments::RunDirectory directory(config.name, Fingerprint().add(to_yaml(config)).text(),
                                      request.out);
  experiments::require_place_beside(directory.path(), to_yaml(config),
                                    "tables/sample_efficiency.csv");
  directory.keep({directory.path(), experiments::Access::alone, request.command});
  experiments::remove_partial_files(directory.path());
  write_atomically(directory.path() / "config.yaml", to_yaml(config));
  set_training_threads(request.thread_count());
  const Table table = SampleEfficiencyStudy(config, request).run();
  directory.write_table("sample_efficiency.csv", table);
  fmt::print("{}", to_text(table, 2));
  draw(table, directory.path());
  return directory.path();
}

}  // namespace touchdown::training
