#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/evaluation/query.hpp"
#include "experiments/studies/cross_simulator.hpp"
#include "scoring/bootstrap.hpp"

namespace touchdown::experiments {

namespace {

constexpr const char* engine_with_edges = "bullet";
constexpr const char* both_engines = "both";
constexpr double wide_edge_radius = 0.04;  // m: Bullet's own

/// The settings of one engine, as offsets in the list of settings.
enum Offset : std::size_t { own_laws, half_step, one_law, one_law_half_step, settings_per_engine };

constexpr std::size_t at(std::size_t engine, Offset offset) {
  return settings_per_engine * engine + offset;
}
constexpr std::size_t wide_edges = at(2, own_laws);

/// A difference between settings: the sum of the first minus the sum of the second.
struct Contrast {
  std::string cause;
  std::string simulator;
  std::vector<std::size_t> plus, minus;
  bool is_step = false;
};

std::vector<Contrast> contrasts(const Experiment& experiment) {
  const std::size_t edged = experiment.simulators[0] == engine_with_edges ? 0 : 1;
  std::vector<Contrast> all = {
      {"own laws", both_engines, {at(1, own_laws)}, {at(0, own_laws)}},
      {"tyre", both_engines, {at(1, own_laws), at(0, one_law)}, {at(0, own_laws), at(1, one_law)}},
      {"solver", both_engines, {at(1, one_law)}, {at(0, one_law)}},
      {"edge", engine_with_edges, {wide_edges}, {at(edged, own_laws)}}};
  for (const std::size_t engine : {0U, 1U}) {
    const std::string& name = experiment.simulators[engine];
    all.push_back({"tyre", name, {at(engine, one_law)}, {at(engine, own_laws)}});
    all.push_back({"step", name, {at(engine, half_step)}, {at(engine, own_laws)}, true});
    all.push_back(
        {"step, one law", name, {at(engine, one_law_half_step)}, {at(engine, one_law)}, true});
  }
  return all;
}

/// The quantities of one draw in every setting.
struct Draw {
  std::vector<std::array<Mean, quantity_count>> setting;

  Draw& operator+=(const Draw& other) {
    setting.resize(other.setting.size());
    for (std::size_t s = 0; s < setting.size(); ++s) {
      for (std::size_t q = 0; q < quantity_count; ++q) setting[s][q] += other.setting[s][q];
    }
    return *this;
  }
};

}  // namespace

std::vector<CauseSetting> cause_settings(const Experiment& experiment) {
  const auto& causes = experiment.studies.at<CrossSimulatorConfig>().causes;
  if (!causes) return {};
  std::vector<CauseSetting> all;
  for (const std::string& engine : experiment.simulators) {
    all.push_back({.runs = {"", engine, causes->runs}});
    all.push_back({.runs = {"half_step", engine, causes->runs}, .has_half_step = true});
    all.push_back({.runs = {"one_law", engine, causes->runs}, .has_one_law = true});
    all.push_back({.runs = {"one_law_half_step", engine, causes->runs},
                   .has_one_law = true,
                   .has_half_step = true});
  }
  all.push_back({.runs = {"wide_edges", engine_with_edges, causes->runs}, .has_wide_edges = true});
  return all;
}

void plan_causes(const RunRequest& request, Plan& plan) {
  const Experiment& experiment = request.experiment;
  for (const CauseSetting& setting : cause_settings(experiment)) {
    if (setting.runs.change.empty()) continue;
    scenarios::Scenario scenario = scenario_of(request, experiment.test.scenarios.front()).scenario;
    if (setting.has_one_law) {
      scenario.tyre = experiment.studies.at<CrossSimulatorConfig>().causes->tyre;
    }
    if (setting.has_wide_edges) scenario.simulation.contact.bullet_edge_radius = wide_edge_radius;
    const bool is_of_solver = setting.has_one_law && !setting.has_half_step;
    plan_changed_runs(request, setting.runs, scenario,
                      tested_on(is_of_solver ? transfer_conditions(experiment)
                                             : own_engine_conditions(experiment),
                                setting.runs.simulator),
                      setting.has_half_step, plan);
    add_measure(facts_measure(), plan.groups.back());
  }
}

std::string CauseEffect::convergence() const {
  if (!tolerance) return "";
  return std::abs(change.estimate) <= *tolerance ? "converged" : "not converged";
}

std::vector<CauseEffect> cause_effects(const std::vector<std::vector<RunFacts>>& facts,
                                       const Experiment& experiment) {
  std::vector<Draw> draws(facts.front().size());
  for (std::size_t i = 0; i < draws.size(); ++i) {
    for (const std::vector<RunFacts>& runs : facts) draws[i].setting.push_back(runs[i].quantity);
  }
  std::vector<CauseEffect> effects;
  std::vector<std::function<double(const Draw&)>> statistics;
  for (std::size_t q = 0; q < quantity_count; ++q) {
    for (const Contrast& contrast : contrasts(experiment)) {
      effects.push_back({contrast.cause, contrast.simulator, q, {}});
      if (contrast.is_step) {
        effects.back().tolerance =
            experiment.studies.at<CrossSimulatorConfig>().causes->tolerances[q];
      }
      statistics.emplace_back([q, contrast](const Draw& all) {
        double value = 0.0;
        for (const std::size_t s : contrast.plus) value += all.setting[s][q].value();
        for (const std::size_t s : contrast.minus) value -= all.setting[s][q].value();
        return value;
      });
    }
  }
  const std::vector<Interval> intervals =
      scoring::bootstrap<Draw>(draws, statistics, experiment.intervals.bootstrap);
  for (std::size_t e = 0; e < effects.size(); ++e) effects[e].change = intervals[e];
  return effects;
}

Causes causes_of(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  const std::vector<CauseSetting> settings = cause_settings(experiment);
  if (settings.empty()) return {};
  std::vector<std::vector<std::size_t>> planned;
  for (const CauseSetting& setting : settings) {
    planned.push_back(runs_of(setting.runs, evaluation.plan));
  }
  std::vector<std::vector<std::size_t>> runs(settings.size());
  std::vector<std::vector<RunFacts>> facts(settings.size());
  for (std::size_t i = 0; i < planned.front().size(); ++i) {
    std::vector<std::size_t> draw;
    for (const std::vector<std::size_t>& of_setting : planned) draw.push_back(of_setting[i]);
    if (std::ranges::any_of(draw,
                            [&](std::size_t run) { return evaluation.runs.at(run).failed(); })) {
      continue;
    }
    for (std::size_t s = 0; s < settings.size(); ++s) {
      runs[s].push_back(draw[s]);
      facts[s].push_back(saved_facts(draw[s], evaluation));
    }
  }
  if (runs.front().empty()) {
    throw Error(
        "cross_simulator.causes: there is no run that the robot completes in every setting");
  }
  Causes causes{runs.front().size(), cause_effects(facts, experiment), {}};

  std::vector<ScoreRows> rows;
  for (const std::vector<std::size_t>& of_setting : runs) {
    rows.push_back(score_rows(of_setting, evaluation.plan, evaluation.saved));
  }
  const auto samples = [&](std::size_t s, const Condition& condition) {
    std::vector<const Scored<scoring::Classification>*> alike;
    for (const auto& row : rows[s].counted) {
      const bool is_theirs =
          *row.condition == condition && *row.noise == experiment.highlights.front();
      if (is_theirs) alike.push_back(&row);
    }
    return samples_of(alike);
  };
  const auto add_costs = [&](const std::string& cause, std::size_t reference, std::size_t changed) {
    const std::string& fit = settings[reference].runs.simulator;
    for (const std::string& estimator : experiment.estimators) {
      const auto cost = scoring::bootstrap_differences<scoring::Classification>(
          samples(reference, {fit, fit, estimator}),
          samples(changed, {fit, settings[changed].runs.simulator, estimator}),
          {&scoring::Classification::success}, experiment.intervals.bootstrap);
      causes.costs.push_back({cause, fit, estimator, cost.front()});
    }
  };
  for (const Contrast& contrast : contrasts(experiment)) {
    if (contrast.plus.size() > 1) continue;
    add_costs(contrast.cause, contrast.minus.front(), contrast.plus.front());
    if (contrast.simulator == both_engines) {
      add_costs(contrast.cause, contrast.plus.front(), contrast.minus.front());
    }
  }
  return causes;
}

}  // namespace touchdown::experiments
