#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "models/robot.hpp"

namespace touchdown::experiments {

/// Reads the profile that an experiment names under `sensors`. One that changes nothing is ideal:
/// the same request as none. Errors: `InputError` for a file that is missing or wrong.
void read_sensors(Experiment& experiment);

/// Reads it as it was when the request in this run directory was written.
void read_sensors(Experiment& experiment, const std::filesystem::path& run_directory);

/// Keeps it there, beside the scenarios.
void write_sensors(const Experiment& experiment, const std::filesystem::path& run_directory);

/// Turns what a run recorded into what the experiment's sensors report. The same run of another
/// engine gets the same draws.
void report_through_sensors(const Experiment& experiment, std::int64_t run, double period,
                            std::vector<models::Observation>& observations);

/// What captions say of them: "; sensors as in sensors/upkie.yaml", nothing where they are ideal.
std::string sensors_text(const Experiment& experiment);

}  // namespace touchdown::experiments
