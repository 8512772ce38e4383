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

/// From MuJoCo's changelog (doc/changelog.rst of google-deepmind/mujoco), and from the notes of its
/// releases 3.11.0 and 3.12.0. `kv` and `timeconst` were no attributes of position servos before,
/// and `inertia` none of meshes.
constexpr std::array features = {Feature{"actdim", "2.3.1"},
                                 Feature{"actearly", "3.0.0"},
                                 Feature{"actuatorforcelimited", "2.3.7"},
                                 Feature{"actuatorforcerange", "2.3.7"},
                                 Feature{"actuatorfrclimited", "3.0.0"},
                                 Feature{"actuatorfrcrange", "3.0.0"},
                                 Feature{"actuatorgravcomp", "3.1.4"},
                                 Feature{"align", "3.2.3"},
                                 Feature{"alignfree", "3.2.3"},
                                 Feature{"assetdir", "2.3.0"},
                                 Feature{"attach", "3.2.0"},
                                 Feature{"bulbradius", "3.1.5"},
                                 Feature{"content_type", "2.3.7"},
                                 Feature{"dampratio", "3.1.6"},
                                 Feature{"deformable", "3.0.0"},
                                 Feature{"extension", "2.3.0"},
                                 Feature{"flex", "3.0.0"},
                                 Feature{"flexcomp", "3.0.0"},
                                 Feature{"focal", "3.0.0"},
                                 Feature{"focalpixel", "3.0.0"},
                                 Feature{"frame", "3.1.0"},
                                 Feature{"gravcomp", "2.3.1"},
                                 Feature{"inertia", "3.2.5"},
                                 Feature{"inheritrange", "3.1.3"},
                                 Feature{"kv", "3.1.0"},
                                 Feature{"layer", "3.2.5"},
                                 Feature{"maxhullvert", "3.2.0"},
                                 Feature{"metallic", "3.1.5"},
                                 Feature{"orthographic", "3.2.0"},
                                 Feature{"pid", "3.12.0"},
                                 Feature{"plugin", "2.3.0"},
                                 Feature{"principal", "3.0.0"},
                                 Feature{"principalpixel", "3.0.0"},
                                 Feature{"replicate", "3.1.5"},
                                 Feature{"resolution", "3.0.0"},
                                 Feature{"roughness", "3.1.5"},
                                 Feature{"saveinertial", "3.3.1"},
                                 Feature{"sensorsize", "3.0.0"},
                                 Feature{"surfacevel", "3.11.0"},
                                 Feature{"tausmooth", "2.3.6"},
                                 Feature{"timeconst", "3.1.6"}};

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
