#pragma once

#include "render/report/study_pictures.hpp"

namespace touchdown::render {

/// The film of one closed-loop run with several contact sources.
StudyPictures closed_loop_pictures();

}  // namespace touchdown::render
