#include <fmt/format.h>

#include "core/error.hpp"
#include "core/yaml.hpp"
#include "scenarios/generation/family.hpp"
#include "scenarios/generation/force_families.hpp"
#include "scenarios/generation/motion_families.hpp"
#include "scenarios/generation/terrain_families.hpp"

namespace touchdown::scenarios {

const std::vector<Family>& families() {
  static const std::vector<Family> all = {
      {"stairs", "Down a flight of stairs.", draw_stairs},
      {"kerbs", "Up a ramp and off its end with one wheel.", draw_kerbs},
      {"ridges", "Along a washboard, with both wheels or one.", draw_ridges},
      {"ramps", "Up a ramp, along its top, and down a step or another ramp.", draw_ramps},
      {"ramp_jumps", "Up a ramp and off its end at speed.", draw_ramp_jumps},
      {"courses", "Stairs, ramps and ridges in a row.", draw_courses},
      {"lifts", "Lifted by forces that appear and vanish at once.", draw_lifts},
      {"slow_lifts", "Lifted by forces that grow and fade over 0.2 to 10 s.", draw_slow_lifts},
      {"put_downs", "Lifted and put down while the wheels spin.", draw_put_downs},
      {"hangs", "On a rope, never in contact.", draw_hangs},
      {"pushes", "Pushed from all sides while it stands.", draw_pushes},
      {"push_offs", "Pushed over the edge of a platform, straight or at an angle.", draw_push_offs},
      {"drives", "Random drive commands on level ground, always in contact.", draw_drives},
      {"squats", "Legs that bend quickly: the torso falls.", draw_squats},
      {"hops", "Legs that extend quickly: small hops.", draw_hops},
  };
  return all;
}

const Family& family_called(const std::string& name) {
  std::vector<std::string> names;
  for (const Family& family : families()) {
    if (family.name == name) return family;
    names.push_back(family.name);
  }
  throw InputError(
      fmt::format("there is no family of scenarios '{}'{}", name, did_you_mean(name, names)));
}

}  // namespace touchdown::scenarios
