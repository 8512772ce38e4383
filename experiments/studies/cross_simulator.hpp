#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/interval.hpp"
#include "experiments/studies/study.hpp"
#include "models/tyre.hpp"
#include "scoring/bootstrap.hpp"
#include "scoring/histogram.hpp"

namespace touchdown::experiments {

/// The conditions for an estimator's verdict.
struct VerdictConfig {
  /// Fitted in the other engine, it must lose less accuracy than this (upper end of the paired
  /// interval).
  double largest_loss = 0.01;
  /// Fitted in the other engine, it must exceed always contact by more than this (lower end).
  double smallest_gain = 0.0;
  std::vector<std::string> demanded;  ///< estimators that must pass, or the run fails
};

/// The drop that is plotted in both engines.
struct OverlayConfig {
  int run = 0;   ///< index of the test run
  int drop = 3;  ///< of that run, from 0
};

/// Quantities of the runs that are compared between engines, independent of estimators.
/// docs/reference/metrics.md defines each.
enum class Quantity : int {
  flight_duration,    ///< ms
  peak_acceleration,  ///< of a landing (m/s²)
  edge_contacts,      ///< per drop
  bounces,            ///< per drop
  contact_ratio,
  descent,  ///< time to the bottom (s)
};
inline constexpr std::size_t quantity_count = 6;

/// The names of a quantity in files and in tables, and its unit, which may be empty.
struct QuantityName {
  const char* key;
  const char* title;
  const char* unit;
};
const QuantityName& name_of(std::size_t quantity);

/// The section `causes`: how much of the engines' difference has which cause.
struct CausesConfig {
  int runs = 8;  ///< test runs per engine and setting, at most
  /// The contact model that both engines get.
  models::Tyre tyre{
      .law = models::Tyre::Law::spring_damper, .stiffness = 3e4, .damping = 300.0, .width = 0.04};
  /// The greatest change at half of the physics step of a quantity that has converged.
  std::array<double, quantity_count> tolerances = {2.0, 5.0, 0.05, 0.05, 0.002, 0.05};
};

/// The section `cross_simulator`: how much the results depend on the engine.
struct CrossSimulatorConfig {
  VerdictConfig verdict;
  OverlayConfig overlay;
  std::optional<CausesConfig> causes;
};

/// The first test runs of one engine, with a change of the scene.
struct ChangedRuns {
  std::string change;  ///< unique name; empty: none
  std::string simulator;
  int runs = 0;
};

/// These runs in the plan.
std::vector<std::size_t> runs_of(const ChangedRuns& changed, const Plan& plan);

/// Adds a group with these runs in a changed scene, evaluated at the first highlighted noise
/// setting. They have the perturbations of the experiment's test runs.
void plan_changed_runs(const RunRequest& request, const ChangedRuns& changed,
                       const scenarios::Scenario& scenario, std::vector<Condition> conditions,
                       bool has_half_step, Plan& plan);

/// A mean as a sum and a count, so that parts can be added.
struct Mean {
  double sum = 0.0;
  double count = 0.0;

  void add(double value) {
    sum += value;
    count += 1.0;
  }
  Mean& operator+=(const Mean& other) {
    sum += other.sum;
    count += other.count;
    return *this;
  }
  double value() const { return sum / count; }
};

/// Torque distributions: joint by joint, in contact and in flight.
enum class TorqueSet : int { knee_contact, knee_flight, wheel_contact, wheel_flight };
inline constexpr std::size_t torque_set_count = 4;

/// The compared quantities of one run; those of several runs can be added.
struct RunFacts {
  std::array<Mean, quantity_count> quantity;
  std::array<scoring::Histogram, torque_set_count> torque;

  RunFacts& operator+=(const RunFacts& other);

  static auto members(auto& facts) { return std::tie(facts.quantity, facts.torque); }
};

/// What a run's signals show: all quantities but the time to the bottom.
RunFacts facts_of(const RunSignals& run, const scoring::ScoringConfig& scoring);

/// Adds the time to the bottom of a run that finished.
void add_descent(const FinishedRun& run, RunFacts& facts);

/// Measures the facts of each run, with the first noise realisation.
Measure facts_measure();

/// Those of a run of the plan, with its time to the bottom. Errors: `Error` for one that is not
/// saved.
RunFacts saved_facts(std::size_t run, const Evaluation& evaluation);

/// One quantity in both engines, and the second's minus the first's on the same runs.
struct QuantityAgreement {
  std::string name;
  std::string unit;
  Interval first, second, difference;
};

/// The distance between the engines' torque distributions.
struct TorqueAgreement {
  std::string name;
  Interval distance;  ///< Wasserstein (N·m)
  Interval overlap;
  /// Distance between the even and the odd runs of one engine, the greater of both engines (N·m):
  /// the value to expect for equal distributions.
  double within_engine = 0.0;
};

struct Agreement {
  std::size_t runs = 0;  ///< completed in both engines
  std::vector<QuantityAgreement> quantities;
  std::vector<TorqueAgreement> torques;
};

/// Entry i of both has the same draw of the perturbations.
Agreement agreement(const std::vector<RunFacts>& first, const std::vector<RunFacts>& second,
                    const scoring::BootstrapConfig& config);

/// Every estimator, fit engine and test engine of the experiment, "always contact" last.
std::vector<Condition> transfer_conditions(const Experiment& experiment);

struct Verdict {
  std::string estimator;
  bool holds = false;
  bool is_demanded = false;
  double loss = 0.0;  ///< greatest upper end over test engines and noise settings
  double gain = 0.0;  ///< least lower end, fitted in the other engine
  std::string words;  ///< the criterion and the numbers
};

/// One verdict per estimator, except always contact. An estimator passes if, fitted in the other
/// engine, its loss is below the limit and its gain over always contact is above the limit. This
/// must hold for the ends of the intervals in every engine and noise setting. Undefined numbers
/// fail.
std::vector<Verdict> verdicts(const Table& transfers, const Experiment& experiment);

std::vector<std::string> failed_demands(const std::vector<Verdict>& verdicts);

/// One setting of the runs that separate causes.
struct CauseSetting {
  ChangedRuns runs;
  bool has_one_law = false;     ///< the tyre of the section `causes`, in both engines
  bool has_half_step = false;   ///< half of the physics step that the engine makes
  bool has_wide_edges = false;  ///< Bullet's own radius of edges
};

/// Four settings of the first engine, four of the second, then wide edges in Bullet. The four: own
/// laws, half the step, one law, one law at half the step. None without the section `causes`.
std::vector<CauseSetting> cause_settings(const Experiment& experiment);

/// Adds a group of runs for every setting.
void plan_causes(const RunRequest& request, Plan& plan);

/// The share of a cause in the difference of one quantity between the engines, or between two
/// settings of one engine, paired by run.
struct CauseEffect {
  std::string cause;
  std::string simulator;  ///< "both": the second engine minus the first
  std::size_t quantity = 0;
  Interval change;
  std::optional<double> tolerance = {};  ///< of a change by half the step

  /// "converged", "not converged"; empty without a tolerance. Undefined changes have not converged.
  std::string convergence() const;
};

/// The accuracy that a cause costs an estimator that was fitted on the nominal scene of an engine:
/// accuracy in one setting minus that in the other, paired by run.
struct CauseCost {
  std::string cause;
  std::string simulator;  ///< of the fit
  std::string estimator;
  Interval cost;
};

struct Causes {
  std::size_t runs = 0;  ///< completed in every setting
  std::vector<CauseEffect> effects;
  std::vector<CauseCost> costs;
};

/// The effects from the facts of each run, by setting: `facts[s][i]` has draw i in every setting s.
std::vector<CauseEffect> cause_effects(const std::vector<std::vector<RunFacts>>& facts,
                                       const Experiment& experiment);

/// Errors: `Error` when the robot completes no run in every setting.
Causes causes_of(const Evaluation& evaluation);

struct CrossSimulatorResult {
  Experiment experiment;
  Agreement agreement;
  Table transfers;
  std::vector<Verdict> verdicts;
  Causes causes;
};

/// Compares the runs of the two engines and the loss of estimators that were fitted in the other
/// engine, separates causes, and gives verdicts. A failed verdict is a result, not an error.
/// Errors: `Error` when the robot completes no test run in both engines.
CrossSimulatorResult check_across_simulators(const Evaluation& evaluation);

/// Writes `tables/{agreement,torques,transfer,verdicts}.csv`, those of causes, and
/// `tables/cross_simulator.md`, and returns texts and figures.
StudyResult summarize_check(const CrossSimulatorResult& result, const RunDirectory& directory);

}  // namespace touchdown::experiments
