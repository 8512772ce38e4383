#pragma once

#include <string>

namespace touchdown::render {

/// The one style of all figures, written beside them as `style.gp`: lines and maps in the colours
/// of render/palette.hpp.
std::string gnuplot_style();

}  // namespace touchdown::render
