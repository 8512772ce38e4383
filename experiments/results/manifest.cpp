#include "experiments/results/manifest.hpp"

#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>
#include <unistd.h>

#include <Eigen/Core>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <tbb/version.h>

#include "core/files.hpp"
#include "core/fingerprint.hpp"

namespace touchdown::experiments {

namespace {

using Json = nlohmann::ordered_json;

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

Json versions() {
  return {{"touchdown", TOUCHDOWN_VERSION},
          {"commit", build_commit()},
          {"build", build_fingerprint()},
          {"build_type", TOUCHDOWN_BUILD_TYPE},
          {"compiler", __VERSION__},
          {"mujoco", mj_versionString()},
          {"eigen",
           fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"onetbb", TBB_runtime_version()}};
}

Json failed_runs(const std::vector<Rollout>& runs) {
  Json list = Json::array();
  for (const Rollout& run : runs) {
    if (!run.failed()) continue;
    list.push_back({{"recording", run.plan.file},
                    {"outcome", recordings::to_text(run.report.outcome)},
                    {"ending", run.report.ending}});
  }
  return list;
}

}  // namespace

void write_manifest(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  Json json;
  json["experiment"] = experiment.name;
  json["id"] = result.id;
  json["command"] = result.provenance.command;
  json["finished_at"] = fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::system_clock::now()));
  json["host"] = {{"name", host_name()},
                  {"cores", std::thread::hardware_concurrency()},
                  {"threads", result.provenance.threads}};
  json["versions"] = versions();
  json["seeds"] = {{"experiment", experiment.seed},
                   {"noise_seeds", experiment.noise.seeds},
                   {"bootstrap", experiment.intervals.bootstrap.seed}};
  json["timings_s"] = Json::object();
  for (const auto& [phase, seconds] : result.provenance.timings) json["timings_s"][phase] = seconds;
  json["failed_runs"] = failed_runs(result.runs);
  json["runs"] = result.runs.size();
  write_atomically(result.directory.path() / "manifest.json", json.dump(2) + "\n");
}

}  // namespace touchdown::experiments
