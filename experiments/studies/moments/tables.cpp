#include "experiments/studies/moments/tables.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/tables/table.hpp"
#include "experiments/plan/sensors.hpp"

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
  Table moments{
      {"simulator", "joint", "contact", "mean_nm", "sd_nm", "robot_mean_nm", "robot_sd_nm"}, {}};
  Table distributions{{"simulator", "joint", "contact", "samples", "q50_nm", "q90_nm", "q99_nm",
                       "max_nm", "autocorrelation_ms"},
                      {}};
  Table densities{{"simulator", "joint", "contact", "torque_nm", "density_per_nm"}, {}};
  Table overlaps{{"simulator", "overlap", "robot_overlap", "runs", "failed"}, {}};
  for (const EngineTorques& engine : engines) {
    for (std::size_t i = 0; i < robot.size(); ++i) {
      const RobotTorque& reference = robot[i];
      const TorqueDistribution& distribution = engine.distribution[i];
      const std::vector<std::string> what = {engine.simulator, name(reference.joint),
                                             std::to_string(reference.contact)};
      moments.rows.push_back(what);
      for (const double value : {distribution.mean, distribution.deviation, reference.robot_mean,
                                 reference.robot_deviation}) {
        moments.rows.back().push_back(metric(value));
      }
      distributions.rows.push_back(what);
      distributions.rows.back().push_back(std::to_string(distribution.samples));
      for (const double value : distribution.quantile)
        distributions.rows.back().push_back(metric(value));
      distributions.rows.back().push_back(metric(distribution.largest));
      distributions.rows.back().push_back(metric(1e3 * distribution.autocorrelation_time));
      for (std::size_t c = 0; c < engine.density[i].size(); ++c) {
        densities.rows.push_back(what);
        densities.rows.back().push_back(metric(static_cast<double>(c) * torque_cell));
        densities.rows.back().push_back(metric(engine.density[i][c]));
      }
    }
    overlaps.rows.push_back({engine.simulator, metric(engine.overlap), metric(robot_overlap),
                             std::to_string(engine.runs), std::to_string(engine.failed)});
  }
  directory.write_table("moments.csv", moments);
  directory.write_table("torque_distributions.csv", distributions);
  directory.write_table("torque_densities.csv", densities);
  directory.write_table("overlap.csv", overlaps);
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
