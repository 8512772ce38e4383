#include "experiments/studies/moments.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "experiments/plan/request.hpp"
#include "experiments/studies/registry.hpp"
#include "scoring/histogram.hpp"

namespace touchdown::experiments {

namespace {

/// The key of the study, and its measure.
constexpr const char* moments_name = "moments";

long cell_of(double torque) { return std::lround(torque / torque_cell); }

/// The share of all steps in each cell of the (knee, wheel) plane.
using SharesByCell = std::map<std::array<long, 2>, double>;

SharesByCell shares_by_cell(const std::vector<TorqueSegment>& segments) {
  SharesByCell shares;
  double steps = 0.0;
  for (const TorqueSegment& segment : segments) {
    for (std::size_t k = 0; k < segment.knee.size(); ++k, ++steps) {
      ++shares[{cell_of(segment.knee[k]), cell_of(segment.wheel[k])}];
    }
  }
  for (auto& [where, share] : shares) share /= steps;
  return shares;
}

/// Covariance of steps that are `lag` (s) apart within one segment; NaN without such steps.
double autocovariance(const std::vector<TorqueSegment>& segments, Joint joint, double mean,
                      double lag) {
  double sum = 0.0;
  double pairs = 0.0;
  for (const TorqueSegment& segment : segments) {
    const std::vector<double>& torque = (segment.*joint);
    const auto apart = static_cast<std::size_t>(std::llround(lag / segment.period));
    for (std::size_t k = apart; k < torque.size(); ++k, ++pairs) {
      sum += (torque[k - apart] - mean) * (torque[k] - mean);
    }
  }
  return sum / pairs;
}

double autocorrelation_time(const std::vector<TorqueSegment>& segments, Joint joint, double mean,
                            double variance) {
  constexpr double shortest = 0.001;
  constexpr double longest = 10.0;
  for (double lag = shortest; lag <= longest; lag = std::max(lag + shortest, 1.05 * lag)) {
    if (autocovariance(segments, joint, mean, lag) < variance / std::numbers::e) return lag;
  }
  return NAN;
}

}  // namespace

TorqueSegments& TorqueSegments::operator+=(const TorqueSegments& more) {
  for (std::size_t state = 0; state < size(); ++state) {
    std::ranges::copy(more[state], std::back_inserter((*this)[state]));
  }
  return *this;
}

void add_torques(const RunSignals& run, double skip, TorqueSegments& all) {
  const double period = run.period();
  for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
    constexpr int gap = 2;
    int last = gap;
    for (auto k = static_cast<std::size_t>(std::llround(skip / period)); k < run.steps(); ++k) {
      const Signals& signals = run.signals[k];
      const int state = has_record(signals) ? run.contact[leg][k] : gap;
      if (state != gap) {
        std::vector<TorqueSegment>& segments = all[static_cast<std::size_t>(state)];
        if (state != last) segments.push_back({period});
        segments.back().knee.push_back(std::abs(signals.leg[leg].knee.torque));
        segments.back().wheel.push_back(std::abs(signals.leg[leg].wheel.torque));
      }
      last = state;
    }
  }
}

TorqueDistribution distribution_of(const std::vector<TorqueSegment>& segments, Joint joint) {
  std::vector<double> all;
  for (const TorqueSegment& segment : segments) {
    all.insert(all.end(), (segment.*joint).begin(), (segment.*joint).end());
  }
  if (all.empty()) return {};
  std::sort(all.begin(), all.end());
  const auto count = static_cast<double>(all.size());
  TorqueDistribution distribution{.samples = static_cast<std::int64_t>(all.size()), .mean = 0.0};
  for (const double torque : all) distribution.mean += torque / count;
  double variance = 0.0;
  for (const double torque : all) variance += std::pow(torque - distribution.mean, 2) / count;
  distribution.deviation = std::sqrt(variance);
  for (std::size_t q = 0; q < quantiles.size(); ++q) {
    distribution.quantile[q] = all[static_cast<std::size_t>(std::ceil(quantiles[q] * count)) - 1];
  }
  distribution.largest = all.back();
  distribution.autocorrelation_time =
      autocorrelation_time(segments, joint, distribution.mean, variance);
  return distribution;
}

std::vector<double> density_of(const std::vector<TorqueSegment>& segments, Joint joint) {
  std::vector<double> density;
  double steps = 0.0;
  for (const TorqueSegment& segment : segments) {
    for (const double torque : segment.*joint) {
      const auto cell = static_cast<std::size_t>(cell_of(torque));
      if (cell >= density.size()) density.resize(cell + 1, 0.0);
      ++density[cell];
      ++steps;
    }
  }
  for (double& value : density) value /= steps * torque_cell;
  if (!density.empty()) density.front() *= 2.0;
  return density;
}

double overlap(const std::vector<TorqueSegment>& a, const std::vector<TorqueSegment>& b) {
  const SharesByCell in_a = shares_by_cell(a);
  const SharesByCell in_b = shares_by_cell(b);
  if (in_a.empty() || in_b.empty()) return NAN;
  std::vector<double> p, q;  // in the cells of `a`, outside of which it is zero
  for (const auto& [cell, share] : in_a) {
    const auto other = in_b.find(cell);
    p.push_back(share);
    q.push_back(other == in_b.end() ? 0.0 : other->second);
  }
  return scoring::overlap(p, q);
}

namespace {

struct EngineTorques {
  std::string simulator;
  /// Knee and wheel in contact, knee and wheel in the air.
  std::array<TorqueDistribution, 4> distribution = {};
  std::array<std::vector<double>, 4> density = {};  ///< by cell
  double overlap = 0.0;                             ///< of the densities in contact and in the air
  int runs = 0;                                     ///< simulated
  int failed = 0;                                   ///< of these; not used
};

/// The real robot's |torque| (N·m) of a joint in one contact state: mean and standard deviation.
/// They follow from the densities that the robot's authors publish as their measurement model,
/// learned from roaming and from hanging on a tether. The grid of the densities ends at the largest
/// torque.
struct RobotTorque {
  Joint joint;
  std::size_t contact;
  double robot_mean;
  double robot_deviation;
};
constexpr std::array robot_torques = {RobotTorque{&TorqueSegment::knee, 1, 0.358, 0.229},
                                      RobotTorque{&TorqueSegment::wheel, 1, 0.109, 0.062},
                                      RobotTorque{&TorqueSegment::knee, 0, 0.083, 0.067},
                                      RobotTorque{&TorqueSegment::wheel, 0, 0.012, 0.010}};
constexpr double robot_largest_knee = 1.495;
constexpr double robot_largest_wheel = 0.366;
constexpr double robot_overlap = 0.055;

const char* joint_name(Joint joint) { return joint == &TorqueSegment::knee ? "knee" : "wheel"; }

std::string with_deviation(double mean, double deviation) {
  return fmt::format("{:.3f} ± {:.3f}", mean, deviation);
}

/// One joint in one contact state, in one engine.
struct JointTorques {
  std::string simulator;
  const RobotTorque* reference;
  const TorqueDistribution* distribution;
};

struct DensityPoint {
  JointTorques joint;
  double torque;   ///< N·m
  double density;  ///< 1/(N·m)
};

Columns<JointTorques> joint_columns() {
  using Row = JointTorques;
  return Columns<Row>()
      .text("simulator", &Row::simulator)
      .text("joint", [](const Row& row) { return joint_name(row.reference->joint); })
      .number("contact", [](const Row& row) { return row.reference->contact; });
}

Columns<JointTorques> moment_columns() {
  using Row = JointTorques;
  return joint_columns()
      .metric("mean_nm", [](const Row& row) { return row.distribution->mean; })
      .metric("sd_nm", [](const Row& row) { return row.distribution->deviation; })
      .metric("robot_mean_nm", [](const Row& row) { return row.reference->robot_mean; })
      .metric("robot_sd_nm", [](const Row& row) { return row.reference->robot_deviation; });
}

Columns<JointTorques> distribution_columns() {
  using Row = JointTorques;
  Columns<Row> columns = joint_columns();
  columns.count("samples", [](const Row& row) { return row.distribution->samples; });
  for (std::size_t q = 0; q < quantiles.size(); ++q) {
    columns.metric(fmt::format("q{:.0f}_nm", 100.0 * quantiles[q]),
                   [q](const Row& row) { return row.distribution->quantile[q]; });
  }
  return columns.metric("max_nm", [](const Row& row) { return row.distribution->largest; })
      .metric("autocorrelation_ms",
              [](const Row& row) { return 1e3 * row.distribution->autocorrelation_time; });
}

Columns<DensityPoint> density_columns() {
  return Columns<DensityPoint>()
      .part(&DensityPoint::joint, joint_columns())
      .metric("torque_nm", &DensityPoint::torque)
      .is(ColumnRole::key)
      .metric("density_per_nm", &DensityPoint::density);
}

Columns<EngineTorques> joint_overlap_columns() {
  return Columns<EngineTorques>()
      .text("simulator", &EngineTorques::simulator)
      .metric("overlap", &EngineTorques::overlap)
      .metric("robot_overlap", [](const EngineTorques&) { return robot_overlap; })
      .runs("runs", &EngineTorques::runs)
      .count("failed", &EngineTorques::failed);
}

/// The torques of the experiment's own test runs, an entry per engine.
std::vector<EngineTorques> torques_by_engine(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  std::vector<EngineTorques> engines;
  for (const std::string& simulator : experiment.simulators) {
    EngineTorques& engine = engines.emplace_back(EngineTorques{simulator});
    const std::vector<std::size_t> runs = evaluation.plan.runs_in(0, simulator);
    const auto scored =
        rows_of<TorqueSegments>(moments_name, runs, evaluation.plan, evaluation.saved);
    engine.runs = static_cast<int>(runs.size());
    engine.failed = static_cast<int>(runs.size() - scored.size());
    TorqueSegments segments;
    for (const auto& row : scored) segments += row.score;
    for (std::size_t i = 0; i < robot_torques.size(); ++i) {
      engine.distribution[i] =
          distribution_of(segments[robot_torques[i].contact], robot_torques[i].joint);
      engine.density[i] = density_of(segments[robot_torques[i].contact], robot_torques[i].joint);
    }
    engine.overlap = overlap(segments[0], segments[1]);
  }
  return engines;
}

/// Writes `moments.csv`, `torque_distributions.csv`, `torque_densities.csv` and `overlap.csv`, with
/// the real robot's numbers.
void write_moments(const std::vector<EngineTorques>& engines, const RunDirectory& directory) {
  std::vector<JointTorques> joints;
  std::vector<DensityPoint> points;
  for (const EngineTorques& engine : engines) {
    for (std::size_t i = 0; i < robot_torques.size(); ++i) {
      joints.push_back({engine.simulator, &robot_torques[i], &engine.distribution[i]});
      for (std::size_t cell = 0; cell < engine.density[i].size(); ++cell) {
        points.push_back(
            {joints.back(), static_cast<double>(cell) * torque_cell, engine.density[i][cell]});
      }
    }
  }
  directory.write_table("moments.csv", moment_columns(), joints);
  directory.write_table("torque_distributions.csv", distribution_columns(), joints);
  directory.write_table("torque_densities.csv", density_columns(), points);
  directory.write_table("overlap.csv", joint_overlap_columns(), engines);
}

std::string moments_text(const std::vector<EngineTorques>& engines, const Experiment& experiment) {
  TextTable table{{"|torque|", "real robot"}, {}};
  for (const RobotTorque& reference : robot_torques) {
    table.rows.push_back({fmt::format("{}, {}", joint_name(reference.joint),
                                      reference.contact == 1 ? "contact" : "air"),
                          with_deviation(reference.robot_mean, reference.robot_deviation)});
  }
  table.rows.push_back({"knee, largest", fmt::format("{:.3f}", robot_largest_knee)});
  table.rows.push_back({"wheel, largest", fmt::format("{:.3f}", robot_largest_wheel)});
  table.rows.push_back({"overlap of contact and air", fmt::format("{:.3f}", robot_overlap)});
  table.rows.push_back({"runs that failed", "-"});
  for (const EngineTorques& engine : engines) {
    table.header.push_back(engine.simulator);
    auto row = table.rows.begin();
    double knee = 0.0;
    double wheel = 0.0;
    for (std::size_t i = 0; i < robot_torques.size(); ++i) {
      const RobotTorque& reference = robot_torques[i];
      const TorqueDistribution& distribution = engine.distribution[i];
      row++->push_back(with_deviation(distribution.mean, distribution.deviation));
      double& largest = reference.joint == &TorqueSegment::knee ? knee : wheel;
      largest = std::fmax(largest, distribution.largest);
    }
    for (const double value : {knee, wheel}) row++->push_back(fmt::format("{:.3f}", value));
    row++->push_back(fmt::format("{:.3f}", engine.overlap));
    row->push_back(fmt::format("{}/{}", engine.failed, engine.runs));
  }
  return fmt::format(
      "Torques in simulation and of the real robot: mean ± standard deviation in N·m{}\n\n{}",
      setup_caption(experiment), to_text(table));
}

class MomentsStudy final : public SectionStudy<MomentsConfig> {
 public:
  /// `false` is the same as no key.
  std::optional<StudySection> section() const override {
    const auto describe = [](Fields& fields, Experiment& experiment) {
      bool is_requested = experiment.studies.has<MomentsConfig>();
      if (!fields.present(moments_name, is_requested)) return;
      fields(moments_name, is_requested).doc("Whether torques are compared with the real robot's.");
      if (is_requested) experiment.studies.emplace<MomentsConfig>();
    };
    return StudySection{.key = moments_name, .describe = describe};
  }

  /// Adds the torques of each test run, without noise.
  void plan(const RunRequest& /*request*/, Plan& plan) const override {
    const auto measure = [](const MeasuredRun& run) {
      if (run.seed > 0) return std::string();
      std::vector<TorqueSegments> segments(1);
      add_torques(run.signals, run.scoring.skip, segments.front());
      return pack(segments);
    };
    add_measure({.name = moments_name, .of_run = measure}, plan.groups.front());
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const std::vector<EngineTorques> torques = torques_by_engine(evaluation);
    write_moments(torques, directory);
    return {{moments_text(torques, evaluation.request.experiment)}};
  }
};

}  // namespace

std::unique_ptr<const Study> moments_study() { return std::make_unique<const MomentsStudy>(); }

}  // namespace touchdown::experiments
