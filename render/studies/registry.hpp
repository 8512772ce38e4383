#pragma once

#include <vector>

#include "render/report/study_pictures.hpp"

namespace touchdown::render {

/// The pictures of all studies that have some besides figures of their tables, in the order of
/// drawing.
const std::vector<StudyPictures>& study_pictures();

/// The rankings of estimators, a page about every scene, and films of the worst segments.
StudyPictures benchmark_pictures();

/// The film of one closed-loop run with several contact sources.
StudyPictures closed_loop_pictures();

/// One drop in both engines.
StudyPictures cross_simulator_pictures();

/// The torques beside the real robot's.
StudyPictures moments_pictures();

}  // namespace touchdown::render
