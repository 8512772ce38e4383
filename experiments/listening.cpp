#include "experiments/listening.hpp"

#include <cstring>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/saved_state.hpp"
#include "experiments/stopped.hpp"

namespace touchdown {

namespace {

// The build is part of a state file's key, so that its numbers may be kept as they lie in memory.
template <typename T>
void append(std::string& bytes, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::uint64_t count = values.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
}

template <typename T>
std::vector<T> take(std::string_view& bytes) {
  std::uint64_t count = 0;
  if (bytes.size() < sizeof count) throw Error("a state file is too short");
  std::memcpy(&count, bytes.data(), sizeof count);
  bytes.remove_prefix(sizeof count);
  if (bytes.size() / sizeof(T) < count) throw Error("a state file is too short");
  std::vector<T> values(count);
  if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
  return values;
}

std::vector<Condition> conditions_of(const Experiment& experiment, const std::string& simulator) {
  std::vector<Condition> conditions = own_engine_conditions(experiment);
  std::erase_if(conditions, [&](const Condition& c) { return c.test_simulator != simulator; });
  return conditions;
}

/// The noise seeds of a run are one sample: later ones are added to the first one's.
template <typename Sample>
void add_samples(std::vector<Sample>& all, std::span<const Sample> task, bool first_seed) {
  if (first_seed) {
    all.insert(all.end(), task.begin(), task.end());
    return;
  }
  const std::size_t offset = all.size() - task.size();
  for (std::size_t i = 0; i < task.size(); ++i) all[offset + i] += task[i];
}

}  // namespace

std::vector<ListeningTask> listening_tasks(const Experiment& experiment,
                                           const std::vector<PlannedRun>& plan) {
  std::vector<ListeningTask> tasks;
  for (std::size_t run = 0; run < plan.size(); ++run) {
    if (plan[run].role != RunRole::test) continue;
    for (int seed = 0; seed < experiment.noise.seeds; ++seed) tasks.push_back({run, seed});
  }
  return tasks;
}

SavedListening::SavedListening(std::filesystem::path folder, std::string key)
    : folder_(std::move(folder)), key_(std::move(key)) {}

std::string SavedListening::name(const PlannedRun& run, int seed) {
  return fmt::format("{}_seed_{:04}", std::filesystem::path(run.file).stem().string(), seed);
}

std::optional<Heard> SavedListening::read(const std::string& name) const {
  const std::optional<std::string> bytes = read_state(folder_ / name, key_);
  if (!bytes) return std::nullopt;
  std::string_view rest = *bytes;
  Heard heard;
  heard.cells = take<Classification>(rest);
  heard.highlights = take<RobotScore>(rest);
  return heard;
}

void SavedListening::write(const std::string& name, const Heard& heard) const {
  std::string bytes;
  append(bytes, heard.cells);
  append(bytes, heard.highlights);
  write_state(folder_ / name, key_, bytes);
}

Heard listen(const Experiment& experiment, const std::vector<NoiseCell>& cells, const HeardRun& run,
             int seed, const FittedModels& models, const GoingOn& going_on) {
  const std::vector<Condition> conditions = conditions_of(experiment, run.info.simulator);
  const UnitNoise noise = unit_noise(run, noise_key(experiment, seed, run.info.run));
  Heard heard;
  heard.cells = sweep_run(conditions, cells, run, noise, models, experiment.scoring, going_on);
  for (const NoiseCell& cell : experiment.highlights) {
    for (const Condition& condition : conditions) {
      if (!going_on()) throw Stopped();
      const auto estimator = make_estimator(condition, models, run.info.control_period_us);
      const std::vector<RobotScore> scores =
          score(run.contact, predict(*estimator, run, noise, cell.levels()), run.pieces,
                run.info.control_period_us, experiment.scoring);
      heard.highlights.insert(heard.highlights.end(), scores.begin(), scores.end());
    }
  }
  return heard;
}

CollectedListening collect(const Experiment& experiment, const std::vector<NoiseCell>& cells,
                           const std::vector<PlannedRun>& plan,
                           const std::vector<ListeningTask>& tasks, const SavedListening& saved) {
  const std::vector<Condition> conditions = own_engine_conditions(experiment);
  CollectedListening all;
  all.highlights.resize(experiment.highlights.size());
  for (const Condition& condition : conditions) {
    all.counts.push_back({condition, std::vector<std::vector<Classification>>(cells.size())});
    for (auto& scores : all.highlights) scores.push_back({condition, {}});
  }
  for (const ListeningTask& task : tasks) {
    const PlannedRun& run = plan[task.run];
    const std::string name = SavedListening::name(run, task.seed);
    const std::optional<Heard> heard = saved.read(name);
    if (!heard) throw Error(fmt::format("the results of {} are missing", name));
    if (heard->cells.empty()) continue;
    const std::size_t here = conditions_of(experiment, run.simulator).size();
    const std::size_t pieces = heard->cells.size() / (here * cells.size());
    std::span<const Classification> counts = heard->cells;
    std::span<const RobotScore> scores = heard->highlights;
    for (std::size_t c = 0; c < conditions.size(); ++c) {
      if (conditions[c].test_simulator != run.simulator) continue;
      for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        add_samples(all.counts[c].samples[cell], counts.first(pieces), task.seed == 0);
        counts = counts.subspan(pieces);
      }
    }
    for (auto& highlight : all.highlights) {
      for (std::size_t c = 0; c < conditions.size(); ++c) {
        if (conditions[c].test_simulator != run.simulator) continue;
        add_samples(highlight[c].samples, scores.first(pieces), task.seed == 0);
        scores = scores.subspan(pieces);
      }
    }
  }
  return all;
}

}  // namespace touchdown
