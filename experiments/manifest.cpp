#include "experiments/manifest.hpp"

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
#include "experiments/fingerprint.hpp"

namespace touchdown {

namespace {

using Json = nlohmann::ordered_json;

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

Json versions() {
  return {{"touchdown", TOUCHDOWN_VERSION},
          {"build", build_fingerprint()},
          {"build_type", TOUCHDOWN_BUILD_TYPE},
          {"compiler", __VERSION__},
          {"mujoco", mj_versionString()},
          {"eigen",
           fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"onetbb", TBB_runtime_version()}};
}

Json runs_that(bool failed, const std::vector<PlayedRun>& runs) {
  Json list = Json::array();
  for (const PlayedRun& run : runs) {
    if (is_failure(run.report.outcome) != failed) continue;
    list.push_back({{"recording", run.plan.file}, {"outcome", to_text(run.report.outcome)}});
  }
  return list;
}

}  // namespace

std::string manifest(const Experiment& experiment, const std::string& id,
                     const std::vector<PlayedRun>& runs, const Provenance& provenance) {
  Json json;
  json["experiment"] = experiment.name;
  json["id"] = id;
  json["command"] = provenance.command;
  json["finished_at"] = fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::system_clock::now()));
  json["host"] = {{"name", host_name()},
                  {"cores", std::thread::hardware_concurrency()},
                  {"threads", provenance.threads}};
  json["versions"] = versions();
  json["seeds"] = {{"experiment", experiment.seed},
                   {"noise_seeds", experiment.noise.seeds},
                   {"bootstrap", experiment.intervals.bootstrap.seed}};
  json["timings_s"] = Json::object();
  for (const auto& [phase, seconds] : provenance.timings) json["timings_s"][phase] = seconds;
  json["failed_runs"] = runs_that(true, runs);
  json["runs"] = runs.size();
  return json.dump(2) + "\n";
}

std::string build_fingerprint() {
  static const std::string name = Fingerprint().add(read_file("/proc/self/exe")).text();
  return name;
}

}  // namespace touchdown
