#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "experiments/results/result.hpp"

namespace touchdown::render {

/// The segment with the most wrong decisions of an estimator.
struct WorstSegment {
  std::size_t run = 0;     ///< index of the run
  std::size_t begin = 0;   ///< first step
  std::int64_t wrong = 0;  ///< wrong decisions about wheels in the segment
};

/// The first of the worst segments of `length` steps. `wrong` contains, for each run and step, the
/// number of wheels with a wrong decision. A shorter run counts as one segment.
WorstSegment worst_segment(const std::vector<std::vector<int>>& wrong, std::size_t length);

/// Films, for every estimator, the two seconds with the most wrong decisions in the scene and
/// engine of its lowest score, on the experiment's own robot at the first highlighted noise
/// setting. The film `videos/worst_<estimator>.mp4` runs at half speed.
void film_worst_segments(const experiments::ExperimentResult& result,
                         const std::atomic<bool>* stop);

}  // namespace touchdown::render
