#include "models/contract/contract.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "models/mjcf/parts.hpp"

namespace touchdown::models {

int Contract::find(mjtObj type, std::string_view kind, std::string_view name) const {
  const int id = mj_name2id(&model_, type, std::string(name).c_str());
  if (id < 0) fail(fmt::format("expected a {} named '{}'", kind, name));
  return id;
}

void Contract::fail(const std::string& message) const {
  throw InputError(document_.file().string() + ": " + message);
}

void Contract::fail_at(const char* tag, std::string_view name, const std::string& message) const {
  const auto* const element = name.empty() ? nullptr : document_.find(tag, name);
  if (element == nullptr) fail(message);
  document_.fail(*element, message);
}

void Contract::fail_at_joint(std::size_t servo, const std::string& message) const {
  fail_at("joint", servo_names[servo],
          fmt::format("joint '{}': {}", own_name(parts_, servo), message));
}

void Contract::fail_at_motor(std::size_t servo, const std::string& message) const {
  const std::string text = fmt::format("motor '{}': {}", own_name(parts_, servo), message);
  for (const char* tag : {"motor", "general", "position", "velocity", "intvelocity", "damper",
                          "cylinder", "muscle", "adhesion"}) {
    if (document_.find(tag, servo_names[servo]) != nullptr) fail_at(tag, servo_names[servo], text);
  }
  fail(text);
}

std::string Contract::name_of(mjtObj type, int id) const {
  if (const char* const name = mj_id2name(&model_, type, id); name != nullptr && *name != '\0') {
    for (std::size_t i = 0; i < servo_count; ++i) {
      if (type == mjOBJ_JOINT && name == servo_names[i]) {
        return fmt::format("'{}'", own_name(parts_, i));
      }
    }
    return fmt::format("'{}'", name);
  }
  const int body = type == mjOBJ_GEOM ? model_.geom_bodyid[id] : model_.jnt_bodyid[id];
  const char* const name = mj_id2name(&model_, mjOBJ_BODY, body);
  return fmt::format("without a name on body '{}'", name == nullptr ? "" : name);
}

}  // namespace touchdown::models
