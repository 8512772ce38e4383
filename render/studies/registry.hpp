#pragma once

#include <vector>

#include "render/report/study_pictures.hpp"

namespace touchdown::render {

/// The pictures of all studies that have some besides figures of their tables, in the order of
/// drawing.
const std::vector<StudyPictures>& study_pictures();

}  // namespace touchdown::render
