#pragma once

#include "render/report/study_pictures.hpp"

namespace touchdown::render {

/// The rankings of estimators, a page about every scene, and films of the worst segments.
StudyPictures benchmark_pictures();

}  // namespace touchdown::render
