#include "models/contract/contract.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/yaml.hpp"
#include "models/mjcf/parts.hpp"

namespace touchdown::models {

int Contract::find(mjtObj type, const char* tag, std::string_view name) const {
  const int id = mj_name2id(&model_, type, std::string(name).c_str());
  if (id >= 0) return id;
  std::vector<std::string> names;
  document_.visit([&](const tinyxml2::XMLElement& element) {
    const std::string_view found = attribute(element, "name");
    const bool is_motor =
        std::string_view("actuator") ==
        (element.Parent()->ToElement() == nullptr ? "" : element.Parent()->ToElement()->Name());
    if (found.empty() ||
        (type == mjOBJ_ACTUATOR ? !is_motor : tag != std::string_view(element.Name())))
      return;
    names.emplace_back(found);
  });
  const std::string near = did_you_mean(name, names);
  fail(fmt::format(
      "expected a {} named '{}'{}", tag, name,
      near.empty() ? fmt::format(", found {}",
                                 names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")))
                   : near));
}

const tinyxml2::XMLElement* Contract::body_element(int body) const {
  // MuJoCo numbers bodies in the order of the file, a parent before its children.
  const tinyxml2::XMLElement* found = nullptr;
  int count = 0;
  document_.visit([&](const tinyxml2::XMLElement& element) {
    if (std::string_view(element.Name()) == "body" && ++count == body) found = &element;
  });
  const char* const name = mj_id2name(&model_, mjOBJ_BODY, body);
  const bool is_same =
      found != nullptr && attribute(*found, "name") == (name == nullptr ? "" : name);
  return is_same ? found : nullptr;
}

const tinyxml2::XMLElement* Contract::child(int body, int number,
                                            std::initializer_list<std::string_view> tags) const {
  const tinyxml2::XMLElement* const parent = body_element(body);
  if (parent == nullptr) return nullptr;
  for (const auto* e = parent->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    const bool is_one = std::find(tags.begin(), tags.end(), e->Name()) != tags.end();
    if (is_one && number-- == 0) return e;
  }
  return parent;
}

void Contract::fail_at(const tinyxml2::XMLElement* element, const std::string& message) const {
  document_.fail(element == nullptr ? document_.root() : *element, message);
}

void Contract::fail(const std::string& message) const {
  const tinyxml2::XMLElement* base = nullptr;
  for (int joint = 0; joint < model_.njnt && base == nullptr; ++joint) {
    if (model_.jnt_type[joint] == mjJNT_FREE) base = body_element(model_.jnt_bodyid[joint]);
  }
  fail_at(base, message);
}

void Contract::fail_at_body(int body, const std::string& message) const {
  fail_at(body_element(body), message);
}

void Contract::fail_at_joint(int joint, const std::string& message) const {
  const int body = model_.jnt_bodyid[joint];
  fail_at(child(body, joint - model_.body_jntadr[body], {"joint", "freejoint"}), message);
}

void Contract::fail_at_geom(int geom, const std::string& message) const {
  const int body = model_.geom_bodyid[geom];
  fail_at(child(body, geom - model_.body_geomadr[body], {"geom"}), message);
}

void Contract::fail_at_site(int site, const std::string& message) const {
  const char* const name = mj_id2name(&model_, mjOBJ_SITE, site);
  fail_at(document_.find("site", name == nullptr ? "" : name), message);
}

const tinyxml2::XMLElement* Contract::actuator_element(int actuator) const {
  const tinyxml2::XMLElement* found = nullptr;
  int count = 0;
  document_.visit([&](const tinyxml2::XMLElement& element) {
    const auto* const section = element.Parent()->ToElement();
    if (section == nullptr || section->Parent() != &document_.root()) return;
    if (std::string_view(section->Name()) == "actuator" && count++ == actuator) found = &element;
  });
  return found;
}

std::string Contract::place_of_actuator(int actuator) const {
  const tinyxml2::XMLElement* const found = actuator_element(actuator);
  return document_.place_of(found == nullptr ? document_.root() : *found);
}

void Contract::fail_at_actuator(int actuator, const std::string& message) const {
  fail_at(actuator_element(actuator), message);
}

void Contract::fail_at_servo(std::size_t servo, const std::string& message) const {
  fail_at_joint(find(mjOBJ_JOINT, "joint", servo_names[servo]),
                fmt::format("joint '{}': {}", own_name(parts_, servo), message));
}

void Contract::fail_at_motor(std::size_t servo, const std::string& message) const {
  fail_at_actuator(find(mjOBJ_ACTUATOR, "motor", servo_names[servo]),
                   fmt::format("motor '{}': {}", own_name(parts_, servo), message));
}

std::string Contract::name_of(mjtObj type, int id) const {
  if (const char* const name = mj_id2name(&model_, type, id); name != nullptr && *name != '\0') {
    for (std::size_t i = 0; i < servo_count; ++i) {
      if (type == mjOBJ_JOINT && name == servo_names[i]) {
        return fmt::format("'{}'", own_name(parts_, i));
      }
    }
    for (std::size_t i = 0; i < parts_.held.size(); ++i) {
      if (type == mjOBJ_JOINT && name == held_name(i)) return fmt::format("'{}'", parts_.held[i]);
    }
    return fmt::format("'{}'", name);
  }
  const int body = type == mjOBJ_GEOM ? model_.geom_bodyid[id] : model_.jnt_bodyid[id];
  const char* const name = mj_id2name(&model_, mjOBJ_BODY, body);
  return fmt::format("without a name on body '{}'", name == nullptr ? "" : name);
}

}  // namespace touchdown::models
