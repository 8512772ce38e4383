#pragma once

#include <string>

#include "tests/scratch_folder.hpp"

namespace touchdown::render {

/// Writes the tables of an experiment's scores: these rows of point-wise metrics ("mujoco,robust,1,
/// 5,0.86,0.85,0.875": engine, estimator, noise, success with its interval; always contact has
/// .87), and these of scores of both wheels (engine, estimator, noise, F1 with its interval, mean
/// latency of takeoffs with its interval, its deviation).
inline void write_score_files(const ScratchFolder& folder, const std::string& cells = "",
                              const std::string& scores = "") {
  const std::string setting = "simulator,estimator,torque_noise_nm,accelerometer_noise_mps2,";
  std::string with_always;
  for (std::size_t begin = 0; begin < cells.size();) {
    const std::size_t end = cells.find('\n', begin);
    const std::string row = cells.substr(begin, end - begin);
    std::size_t at = row.find(',', row.find(',') + 1) + 1;  // the torque noise
    const std::string torque = row.substr(at, row.find(',', at) - at);
    with_always += row + ",0.87," + torque + "," + torque + "\n";
    begin = end + 1;
  }
  for (const char* name : {"success", "classification"}) {
    folder.write(std::string("tables/") + name + ".csv",
                 setting +
                     "success,success_low,success_high,always_contact_success,knee_noise_nm,"
                     "wheel_noise_nm\n" +
                     with_always);
  }
  std::string with_view;
  for (std::size_t begin = 0; begin < scores.size();) {
    const std::size_t end = scores.find('\n', begin);
    with_view += "wheels," + scores.substr(begin, end + 1 - begin);
    begin = end + 1;
  }
  for (const char* name : {"ranking", "views", "transitions", "latency", "calibration"}) {
    folder.write(std::string("tables/") + name + ".csv",
                 "view," + setting +
                     "event_f1,event_f1_low,event_f1_high,takeoff_latency_ms,"
                     "takeoff_latency_low_ms,takeoff_latency_high_ms,"
                     "takeoff_latency_deviation_ms\n" +
                     with_view);
  }
  folder.write("tables/reliability.csv", setting + "view,bin\n");
  folder.write("tables/latencies.csv", setting + "view,latency_ms\n");
  folder.write("tables/differences.csv", "simulator,first,second,metric,difference\n");
  folder.write("tables/runs.csv", "simulator,scenario,role,run,outcome\n");
}

}  // namespace touchdown::render
