#pragma once

#include <filesystem>
#include <string>

#include "render/benchmark/scores.hpp"

namespace touchdown::render {

/// A card for each estimator: what it is, where it stands at best and at worst, and the scenes in
/// which it fails, by what it does wrong there. `videos/worst_<estimator>.mp4` is shown if it is in
/// the run directory.
std::string cards_html(const BenchmarkScores& scores, const std::filesystem::path& run_directory);

}  // namespace touchdown::render
