#include "models/mjcf/later_versions.hpp"

#include <array>
#include <regex>

#include <fmt/format.h>
#include <mujoco/mujoco.h>

namespace touchdown::models {

namespace {

struct Feature {
  std::string_view name;
  std::string_view version;
};

constexpr std::array features = {Feature{"actuatorfrcrange", "2.3"},
                                 Feature{"assetdir", "2.3"},
                                 Feature{"attach", "3"},
                                 Feature{"dampratio", "3"},
                                 Feature{"deformable", "3"},
                                 Feature{"extension", "2.3"},
                                 Feature{"flex", "3"},
                                 Feature{"flexcomp", "3"},
                                 Feature{"frame", "3"},
                                 Feature{"gravcomp", "2.3"},
                                 Feature{"plugin", "2.3"},
                                 Feature{"replicate", "3"},
                                 Feature{"timeconst", "3"}};

}  // namespace

std::string later_version_text(std::string_view message) {
  const std::string text(message);
  std::smatch match;
  if (!std::regex_search(text, match,
                         std::regex("unrecognized (?:attribute|element)[^']*'([^']+)'"))) {
    return {};
  }
  const std::string name = match[1].str();
  for (const Feature& feature : features) {
    if (feature.name != name) continue;
    return fmt::format(" (`{}` came with MuJoCo {}; this is MuJoCo {})", name, feature.version,
                       mj_versionString());
  }
  return fmt::format(" (this is MuJoCo {}: `{}` may be of a later version)", mj_versionString(),
                     name);
}

}  // namespace touchdown::models
