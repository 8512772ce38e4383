#pragma once

#include "render/report/study_pictures.hpp"

namespace touchdown::render {

/// The torques beside the real robot's.
StudyPictures moments_pictures();

}  // namespace touchdown::render
