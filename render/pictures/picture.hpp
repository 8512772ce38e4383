#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Something for people to look at.
struct Picture {
  std::string kind;  ///< "heatmap", "figure", "video"
  std::vector<std::filesystem::path> files;
};

inline Picture picture(const std::string& kind, const Figure& figure) {
  return {kind, {figure.png, figure.svg}};
}

}  // namespace touchdown::render
