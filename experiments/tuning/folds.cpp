#include "experiments/tuning/folds.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace touchdown::experiments {

std::vector<Fold> folds_of(std::span<const RunSignals* const> whole,
                           std::span<const RunSignals* const> segments, std::size_t folds,
                           bool drawn) {
  std::map<std::pair<std::string, std::int64_t>, std::size_t> fold_of_draw;
  const auto fold_of = [&](const RunSignals& run, bool is_drawn) {
    const std::pair draw(run.info.scenario, is_drawn ? run.info.run : -1);
    return fold_of_draw.try_emplace(draw, fold_of_draw.size() % folds).first->second;
  };
  std::vector<Fold> all(folds);
  for (const RunSignals* run : whole) {
    const std::size_t own = fold_of(*run, drawn);
    for (std::size_t fold = 0; fold < folds; ++fold) {
      (fold == own ? all[fold].held_out : all[fold].fitted).push_back(run);
    }
  }
  for (const RunSignals* segment : segments) {
    const std::size_t own = fold_of(*segment, true);
    for (std::size_t fold = 0; fold < folds; ++fold) {
      if (fold != own) all[fold].segments.push_back(segment);
    }
  }
  return all;
}

}  // namespace touchdown::experiments
