#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "experiments/results/result.hpp"

namespace touchdown::render {

/// So many steps in a row in which an estimator was wrong most often.
struct WorstSegment {
  std::size_t run = 0;     ///< index in those that were looked at
  std::size_t begin = 0;   ///< first step
  std::int64_t wrong = 0;  ///< wrong decisions about wheels in them
};

/// The first of the worst stretches of `length` steps, given for each run how many wheels were told
/// wrong at every step. A shorter run counts whole.
WorstSegment worst_segment(const std::vector<std::vector<int>>& wrong, std::size_t length);

/// Films, for every estimator, two seconds of the scene and engine in which it stands worst, there
/// where it was wrong most often, on the experiment's own robot without noise besides: slowed down,
/// as `videos/worst_<estimator>.mp4`.
void film_worst_segments(const experiments::ExperimentResult& result, const std::atomic<bool>* stop);

}  // namespace touchdown::render
