#include "experiments/evaluation/tune.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/fingerprint.hpp"
#include "core/progress.hpp"
#include "core/random.hpp"
#include "experiments/plan/plan.hpp"
#include "experiments/signals/estimator_runner.hpp"

namespace touchdown::experiments {

namespace {

double drawn(const Hyperparameter& one, double uniform) {
  const double span = one.highest - one.lowest;
  switch (one.scale) {
    case Hyperparameter::Scale::whole:
      return one.lowest + std::floor(uniform * (span + 1.0));
    case Hyperparameter::Scale::by_ratio:
      return one.lowest * std::pow(one.highest / one.lowest, uniform);
    case Hyperparameter::Scale::even:
      break;
  }
  return one.lowest + uniform * span;
}

double with_three_digits(double number) { return std::stod(fmt::format("{:.3g}", number)); }

/// All trials of one estimator in one fold. Trials with the same fit share it.
struct FoldJob {
  std::string simulator;
  const EstimatorEntry* entry;
  std::size_t fold;                         ///< index in the engine's folds
  std::size_t first;                        ///< index of the first trial
  std::vector<scoring::EventScore> scores;  ///< by trial
};

scoring::EventScore score_of(EstimatorRunner& runner, const RunSignals& run, const NoiseRun& noise,
                             const noise::SensorNoise& levels,
                             const scoring::ScoringConfig& scoring) {
  std::array<scoring::ContactSequence, models::wheel_count> decided;
  decided.fill(scoring::ContactSequence(run.steps(), 1));
  runner.run_estimator(
      run, [&](std::size_t k) { return noisy(run, noise, levels, k); },
      [&](std::size_t k, const Belief& belief) {
        for (std::size_t w = 0; w < decided.size(); ++w) {
          decided[w][k] = belief.wheel[w].contact ? 1 : 0;
        }
      });
  scoring::EventScore sum;
  for (std::size_t w = 0; w < decided.size(); ++w) {
    sum +=
        scoring::event_scores(run.contact[w], decided[w], {0}, run.info.control_period_us, scoring)
            .front();
  }
  return sum;
}

/// The values that the fitted model depends on.
HyperparameterValues fit_hyperparameters(const EstimatorEntry& entry,
                                         const HyperparameterValues& hyperparameters) {
  HyperparameterValues of_fit;
  for (const Hyperparameter& one : entry.hyperparameters) {
    if (one.is_fitted_with) of_fit[one.name] = hyperparameters.at(one.name);
  }
  return of_fit;
}

/// The held-out runs of a fold, and noise for each.
struct HeldOut {
  std::span<const RunSignals* const> runs;
  std::vector<NoiseRun> noise;
};

/// The events that an estimator decides in held-out runs, over all noise settings.
scoring::EventScore score_on(const HeldOut& held_out, const EstimatorEntry& entry,
                             const Model& model, const Experiment& experiment,
                             const std::function<void()>& stop_if_asked) {
  scoring::EventScore sum;
  for (std::size_t i = 0; i < held_out.runs.size(); ++i) {
    const RunSignals& run = *held_out.runs[i];
    EstimatorRunner runner = entry.runner({1.0 / run.period(), &model, run.legs, &run.contact});
    for (const noise::NoiseCell& cell : experiment.tuning->noise) {
      stop_if_asked();
      sum += score_of(runner, run, held_out.noise[i], cell.levels(), experiment.scoring);
    }
  }
  return sum;
}

std::vector<scoring::EventScore> run_fold(const FoldJob& job, const Fold& fold,
                                          std::span<const Trial> trials,
                                          const Experiment& experiment,
                                          const std::function<void()>& stop_if_asked) {
  const double skip = experiment.scoring.skip;
  HeldOut held_out{fold.held_out, {}};
  constexpr std::uint64_t tuning_stream = 0x74756e696e67;  // "tuning": no other run has its noise
  for (const RunSignals* run : fold.held_out) {
    const auto draws = draws_of(seed_of_fit(experiment), tuning_stream, 0, run->info.run);
    held_out.noise.push_back(noise_run(*run, draws));
  }
  // Trials with one fit follow each other, so that one model at a time is in memory.
  std::map<HyperparameterValues, std::vector<std::size_t>> trials_of;
  for (std::size_t number = 0; number < trials.size(); ++number) {
    trials_of[fit_hyperparameters(*job.entry, trials[number].hyperparameters)].push_back(number);
  }
  std::vector<scoring::EventScore> scores(trials.size());
  for (const auto& [fit, numbers] : trials_of) {
    Model model;
    for (const std::size_t number : numbers) {
      const HyperparameterValues& hyperparameters = trials[number].hyperparameters;
      const EstimatorEntry entry = with_hyperparameters(*job.entry, hyperparameters);
      if (entry.fits()) {
        if (number == numbers.front()) model = entry.fit(fold.fitted, skip);
        describe_fit(entry.name, fitted_to(fold.fitted, skip), hyperparameters, model);
      }
      scores[number] = score_on(held_out, entry, model, experiment, stop_if_asked);
    }
  }
  return scores;
}

}  // namespace

std::vector<HyperparameterValues> trial_hyperparameters(const EstimatorEntry& entry,
                                                        std::uint64_t seed, int trials) {
  if (entry.hyperparameters.empty()) return {};
  const std::uint64_t stream = Fingerprint().add("tuning").add(entry.name).value();
  std::vector<HyperparameterValues> all(static_cast<std::size_t>(trials));
  for (std::size_t trial = 0; trial < all.size(); ++trial) {
    for (std::size_t i = 0; i < entry.hyperparameters.size(); ++i) {
      const Hyperparameter& one = entry.hyperparameters[i];
      const double uniform = uniform01(seed, stream + i, trial);
      all[trial][one.name] = trial == 0 ? one.value : with_three_digits(drawn(one, uniform));
    }
  }
  return all;
}

std::vector<Fold> folds_of(std::span<const RunSignals* const> runs, std::size_t folds, bool drawn) {
  std::map<std::pair<std::string, std::int64_t>, std::size_t> fold_of_draw;
  std::vector<Fold> all(folds);
  for (const RunSignals* run : runs) {
    const std::pair draw(run->info.scenario, drawn ? run->info.run : -1);
    const std::size_t own =
        fold_of_draw.try_emplace(draw, fold_of_draw.size() % folds).first->second;
    for (std::size_t fold = 0; fold < folds; ++fold) {
      (fold == own ? all[fold].held_out : all[fold].fitted).push_back(run);
    }
  }
  return all;
}

std::vector<Trial> tune(const Experiment& experiment, const std::string& fit,
                        const RunPointers& fit_runs, const std::function<bool()>& should_continue,
                        const Store& store) {
  const auto stop_if_asked = [&] {
    if (should_continue && !should_continue()) throw Stopped();
  };
  std::map<std::string, std::vector<Fold>> folds;
  std::vector<Trial> trials;
  std::vector<FoldJob> jobs;
  for (const std::string& simulator : experiment.simulators) {
    folds[simulator] =
        folds_of(of_engine(fit_runs, simulator), static_cast<std::size_t>(experiment.tuning->folds),
                 experiment.fit.perturbed);
    for (const std::string& name : experiment.estimators) {
      const EstimatorEntry& entry = estimator_entry(experiment, name);
      const std::vector<std::string>& fixed = experiment.tuning->fixed;
      if (std::find(fixed.begin(), fixed.end(), name) != fixed.end()) continue;
      const std::vector<HyperparameterValues> tried =
          trial_hyperparameters(entry, seed_of_fit(experiment), experiment.tuning->trials);
      for (std::size_t fold = 0; fold < folds[simulator].size() && !tried.empty(); ++fold) {
        // Runs that fell are missing. A fold without held-out runs has no score.
        if (folds[simulator][fold].held_out.empty()) continue;
        jobs.push_back({simulator, &entry, fold, trials.size(), {}});
      }
      for (const HyperparameterValues& hyperparameters : tried) {
        const auto number = static_cast<int>(&hyperparameters - tried.data());
        trials.push_back({simulator, fit, name, number, hyperparameters, 0.0, false});
      }
    }
  }
  const auto number = static_cast<std::size_t>(experiment.tuning->trials);
  Progress progress("tuning", "folds", static_cast<std::int64_t>(jobs.size()));
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
    stop_if_asked();
    FoldJob& job = jobs[i];
    const std::string name =
        fmt::format("{}{}_{}_fold_{}", job.simulator, fit, job.entry->name, job.fold + 1);
    bool is_saved = true;
    job.scores = store.get<std::vector<scoring::EventScore>>("tuning", name, [&] {
      is_saved = false;
      try {
        return run_fold(job, folds.at(job.simulator)[job.fold],
                        std::span(trials).subspan(job.first, number), experiment, stop_if_asked);
      } catch (const InputError& error) {
        throw InputError(fmt::format("fit.tuning: {} on {}, without fold {} of {}: {}",
                                     job.entry->name, job.simulator, job.fold + 1,
                                     experiment.tuning->folds, error.what()));
      }
    });
    is_saved ? progress.skip() : progress.advance();
  });
  std::vector<scoring::EventScore> scores(trials.size());
  for (const FoldJob& job : jobs) {
    for (std::size_t trial = 0; trial < number; ++trial) {
      scores[job.first + trial] += job.scores[trial];
    }
  }
  for (std::size_t first = 0; first < trials.size(); first += number) {
    std::size_t best = first;
    for (std::size_t trial = first; trial < first + number; ++trial) {
      const double f1 = scores[trial].f1();
      trials[trial].score = std::isnan(f1) ? 0.0 : f1;
      if (trials[trial].score > trials[best].score) best = trial;
    }
    trials[best].is_chosen = true;
  }
  return trials;
}

TunedHyperparameters chosen_in(const std::vector<Trial>& trials) {
  TunedHyperparameters chosen;
  for (const Trial& trial : trials) {
    if (trial.is_chosen) chosen[trial.simulator][trial.estimator] = trial.hyperparameters;
  }
  return chosen;
}

}  // namespace touchdown::experiments
