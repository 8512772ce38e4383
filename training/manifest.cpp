#include "training/manifest.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <torch/version.h>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "core/fingerprint.hpp"
#include "training/blas.hpp"

namespace touchdown::training {

namespace {

using Json = nlohmann::ordered_json;

Json losses(const Loss& loss) {
  return {{"total", loss.total},
          {"contact_nat", loss.contact},
          {"velocity_m2_per_s2", loss.velocity},
          {"accuracy", loss.accuracy}};
}

double per_second(std::int64_t steps, double seconds) {
  return seconds > 0.0 ? static_cast<double>(steps) / seconds : 0.0;
}

}  // namespace

std::string training_manifest(const TrainingConfig& config, const TrainingRequest& request,
                              const TrainingResult& result, const TrainingTimes& times,
                              std::string_view network_bytes) {
  const IterationRecord& chosen = result.history.at(result.chosen);
  Json json;
  json["network"] = config.name;
  json["fingerprint"] = Fingerprint().add(network_bytes).text();
  json["command"] = request.command;
  json["finished_at"] = fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::system_clock::now()));
  json["config_yaml"] = to_yaml(config);
  json["seed"] = config.seed;
  json["chosen_iteration"] = chosen.iteration;
  json["iterations"] = result.history.size();
  json["labelled_data_s"] = chosen.data_seconds;
  json["training_loss"] = losses(chosen.training);
  json["validation_loss"] = losses(chosen.validation);
  json["threads"] = request.thread_count();
  json["timings_s"] = {{"rollout", times.rollout}, {"training", times.training}};
  json["steps_per_s"] = {{"rollout", per_second(times.rollout_steps, times.rollout)},
                         {"training", per_second(times.training_steps, times.training)}};
  json["versions"] = {{"touchdown", TOUCHDOWN_VERSION},
                      {"compiler", __VERSION__},
                      {"libtorch", TORCH_VERSION},
                      {"blas", blas_in_use().library}};
  return json.dump(2) + "\n";
}

}  // namespace touchdown::training
