#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/evaluation/scored.hpp"
#include "experiments/run_directory/directory.hpp"
#include "noise/sensor_noise.hpp"
#include "scoring/bootstrap.hpp"

namespace touchdown::experiments {

/// Writes `samples.csv`: the point-wise counts of every sample of an experiment's own test runs.
/// Unlike the parts in `state/`, other builds read it.
void write_samples(const std::vector<Scored<scoring::Classification>>& rows,
                   const RunDirectory& directory);

/// The identity of a statistical sample of one engine, in every run of an experiment.
struct SampleKey {
  std::string scenario;
  std::int64_t run = 0;
  std::int64_t segment = 0;  ///< of the run: a drop

  auto operator<=>(const SampleKey&) const = default;
};

/// The samples of one condition in one noise cell.
struct SampledCell {
  Condition condition;
  noise::NoiseCell noise;
  std::map<SampleKey, scoring::Classification> samples = {};
};

/// The samples of a run directory, and how its experiment computes intervals.
struct SampledRun {
  std::string directory;
  std::vector<SampledCell> cells = {};  ///< in the order of `samples.csv`
  scoring::BootstrapConfig bootstrap = {};
};

/// Reads the samples of any build's run directory. Errors: `InputError` when it is no run
/// directory, when its run wrote no samples, or when they are broken.
SampledRun read_samples(const std::filesystem::path& run_directory);

}  // namespace touchdown::experiments
