#pragma once

#include <filesystem>
#include <string>

#include "render/benchmark/scores.hpp"

namespace touchdown::render {

/// A card for each estimator: a summary, its best and worst mean, and the scenes in which it fails,
/// with its errors there. A card shows `videos/worst_<estimator>.mp4` if the run directory has it.
std::string cards_html(const BenchmarkScores& scores, const std::filesystem::path& run_directory);

}  // namespace touchdown::render
