#include "experiments/studies/moments/tables.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/table.hpp"
#include "experiments/plan/request.hpp"

namespace touchdown::experiments {

namespace {

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
constexpr std::array robot = {RobotTorque{&TorqueSegment::knee, 1, 0.358, 0.229},
                              RobotTorque{&TorqueSegment::wheel, 1, 0.109, 0.062},
                              RobotTorque{&TorqueSegment::knee, 0, 0.083, 0.067},
                              RobotTorque{&TorqueSegment::wheel, 0, 0.012, 0.010}};
constexpr double robot_largest_knee = 1.495;
constexpr double robot_largest_wheel = 0.366;
constexpr double robot_overlap = 0.055;

const char* name(Joint joint) { return joint == &TorqueSegment::knee ? "knee" : "wheel"; }

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
  JointTorques of;
  double torque;   ///< N·m
  double density;  ///< 1/(N·m)
};

Columns<JointTorques> joint_columns() {
  using Row = JointTorques;
  return Columns<Row>()
      .text("simulator", &Row::simulator)
      .text("joint", [](const Row& row) { return name(row.reference->joint); })
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
      .part(&DensityPoint::of, joint_columns())
      .metric("torque_nm", &DensityPoint::torque)
      .is(ColumnRole::key)
      .metric("density_per_nm", &DensityPoint::density);
}

Columns<EngineTorques> overlap_columns() {
  return Columns<EngineTorques>()
      .text("simulator", &EngineTorques::simulator)
      .metric("overlap", &EngineTorques::overlap)
      .metric("robot_overlap", [](const EngineTorques&) { return robot_overlap; })
      .runs("runs", &EngineTorques::runs)
      .count("failed", &EngineTorques::failed);
}

}  // namespace

std::vector<EngineTorques> torques_by_engine(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  std::vector<EngineTorques> engines;
  for (const std::string& simulator : experiment.simulators) {
    EngineTorques& engine = engines.emplace_back(EngineTorques{simulator});
    TorqueSegments segments;
    for (const std::size_t index : evaluation.plan.runs_in(0)) {
      const Rollout& run = evaluation.runs.at(index);
      if (run.plan.simulator != simulator) continue;
      ++engine.runs;
      if (run.failed()) {
        ++engine.failed;
      } else {
        add_torques(run.signals, experiment.scoring.skip, segments);
      }
    }
    for (std::size_t i = 0; i < robot.size(); ++i) {
      engine.distribution[i] = distribution_of(segments[robot[i].contact], robot[i].joint);
      engine.density[i] = density_of(segments[robot[i].contact], robot[i].joint);
    }
    engine.overlap = overlap(segments[0], segments[1]);
  }
  return engines;
}

void write_tables(const std::vector<EngineTorques>& engines, const RunDirectory& directory) {
  std::vector<JointTorques> joints;
  std::vector<DensityPoint> points;
  for (const EngineTorques& engine : engines) {
    for (std::size_t i = 0; i < robot.size(); ++i) {
      joints.push_back({engine.simulator, &robot[i], &engine.distribution[i]});
      for (std::size_t cell = 0; cell < engine.density[i].size(); ++cell) {
        points.push_back(
            {joints.back(), static_cast<double>(cell) * torque_cell, engine.density[i][cell]});
      }
    }
  }
  directory.write_table("moments.csv", moment_columns(), joints);
  directory.write_table("torque_distributions.csv", distribution_columns(), joints);
  directory.write_table("torque_densities.csv", density_columns(), points);
  directory.write_table("overlap.csv", overlap_columns(), engines);
}

std::string moments_text(const std::vector<EngineTorques>& engines, const Experiment& experiment) {
  Table table{{"|torque|", "real robot"}, {}};
  for (const RobotTorque& reference : robot) {
    table.rows.push_back(
        {fmt::format("{}, {}", name(reference.joint), reference.contact == 1 ? "contact" : "air"),
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
    for (std::size_t i = 0; i < robot.size(); ++i) {
      const RobotTorque& reference = robot[i];
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

}  // namespace touchdown::experiments
