#include "render/studies/registry.hpp"

namespace touchdown::render {

const std::vector<StudyPictures>& study_pictures() {
  static const std::vector<StudyPictures> all = {cross_simulator_pictures(), benchmark_pictures(),
                                                 moments_pictures(), closed_loop_pictures()};
  return all;
}

}  // namespace touchdown::render
