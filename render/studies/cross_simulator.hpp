#pragma once

#include "render/report/study_pictures.hpp"

namespace touchdown::render {

/// One drop in both engines.
StudyPictures cross_simulator_pictures();

}  // namespace touchdown::render
