#include "experiments/fitting/refits.hpp"

#include <map>
#include <string>
#include <utility>

#include "core/random.hpp"

namespace touchdown::experiments {

namespace {

using EngineAndScene = std::pair<std::string, std::string>;

/// The runs of every scene. If every scene of an engine has one run, the engine has a pool of all,
/// with an empty name of a scene.
std::map<EngineAndScene, RunPointers> pools_of(const RunPointers& runs) {
  std::map<EngineAndScene, RunPointers> pools;
  std::map<std::string, RunPointers> of_engine;
  std::map<std::string, bool> has_repeated_scene;
  for (const RunSignals* run : runs) {
    RunPointers& pool = pools[{run->info.simulator, run->info.scenario}];
    pool.push_back(run);
    of_engine[run->info.simulator].push_back(run);
    has_repeated_scene[run->info.simulator] |= pool.size() > 1;
  }
  for (const auto& [simulator, is_repeated] : has_repeated_scene) {
    if (!is_repeated) pools[{simulator, ""}] = of_engine[simulator];
  }
  return pools;
}

/// The runs that this one is drawn from.
const RunPointers& pool_of(const RunSignals& run,
                           const std::map<EngineAndScene, RunPointers>& pools) {
  const auto scenes = pools.find({run.info.simulator, ""});
  return scenes != pools.end() ? scenes->second : pools.at({run.info.simulator, run.info.scenario});
}

}  // namespace

RunPointers drawn_anew(const RunPointers& runs, std::uint64_t seed, int number) {
  constexpr std::uint64_t stream = 0x7265666974;  // "refit"
  const std::map<EngineAndScene, RunPointers> pools = pools_of(runs);
  RunPointers drawn;
  for (std::size_t place = 0; place < runs.size(); ++place) {
    const RunPointers& pool = pool_of(*runs[place], pools);
    const double u = uniform01(seed, stream + static_cast<std::uint64_t>(number), place);
    drawn.push_back(pool[static_cast<std::size_t>(u * static_cast<double>(pool.size()))]);
  }
  return drawn;
}

}  // namespace touchdown::experiments
