#include "render/studies/registry.hpp"

#include "render/studies/benchmark.hpp"
#include "render/studies/closed_loop.hpp"
#include "render/studies/cross_simulator.hpp"
#include "render/studies/moments.hpp"

namespace touchdown::render {

const std::vector<StudyPictures>& study_pictures() {
  static const std::vector<StudyPictures> all = {cross_simulator_pictures(), benchmark_pictures(),
                                                 moments_pictures(), closed_loop_pictures()};
  return all;
}

}  // namespace touchdown::render
