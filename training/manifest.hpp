#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "training/config.hpp"
#include "training/request.hpp"

namespace touchdown::training {

/// Where the time of a training went, as far as this process took part in it.
struct TrainingTimes {
  double rollout = 0.0;   ///< s
  double training = 0.0;  ///< s, validation included
  std::int64_t rollout_steps = 0;
  std::int64_t training_steps = 0;  ///< times epochs
};

/// What should be known about a file of weights, as JSON: how it was made, on what data, how well
/// it did, and the fingerprint of its bytes.
std::string training_manifest(const TrainingConfig& config, const TrainingRequest& request,
                              const TrainingResult& result, const TrainingTimes& times,
                              std::string_view network_bytes);

}  // namespace touchdown::training
