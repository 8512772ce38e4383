#include "core/fields.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace touchdown {

void Fields::require(std::string_view key) { check(present(key, true), key, "is missing"); }

void Fields::choose(std::string_view key, const std::vector<std::string>& names,
                    std::string& value) {
  if (!reading()) return (*this)(key, value);
  const auto otherwise = std::find(names.begin(), names.end(), value) - names.begin();
  value = names.at(map_->choose(key, names, static_cast<std::size_t>(otherwise)));
}

void Fields::choose(std::string_view key, const std::vector<std::string>& names,
                    std::size_t& index) {
  std::string name = names.at(index);
  choose(key, names, name);
  index = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

void Fields::names(std::string_view key, const std::vector<std::string>& known,
                   std::vector<std::string>& values) {
  (*this)(key, values);
  check(!values.empty(), key, "expected at least one name");
  for (auto name = values.begin(); name != values.end(); ++name) {
    check(std::find(known.begin(), known.end(), *name) != known.end(), key,
          fmt::format("'{}' is not one of {}{}", *name, fmt::join(known, ", "),
                      did_you_mean(*name, known)));
    check(std::find(values.begin(), name, *name) == name, key,
          fmt::format("'{}' stands there twice", *name));
  }
}

void Fields::in_line(std::string_view key, std::vector<double>& numbers) {
  (*this)(key, numbers);
  if (!reading()) written_[std::string(key)].SetStyle(YAML::EmitterStyle::Flow);
}

void Fields::within(std::string_view key, const std::function<void(Fields&)>& describe_section) {
  if (reading()) {
    YamlMap map = map_->child(key);
    Fields inner(map);
    describe_section(inner);
    map.finish();
  } else {
    Fields inner;
    describe_section(inner);
    written_[std::string(key)] = inner.node();
  }
}

void Fields::items(std::string_view key, std::size_t count,
                   const std::function<void(Fields&, std::size_t)>& describe_item) {
  if (reading()) {
    std::vector<YamlMap> maps = map_->children(key);
    for (std::size_t i = 0; i < maps.size(); ++i) {
      Fields item(maps[i]);
      describe_item(item, i);
      maps[i].finish();
    }
  } else {
    YAML::Node list(YAML::NodeType::Sequence);
    for (std::size_t i = 0; i < count; ++i) {
      Fields item;
      describe_item(item, i);
      list.push_back(item.node());
    }
    written_[std::string(key)] = list;
  }
}

bool Fields::present(std::string_view key, bool has_value) const {
  return reading() ? map_->has(key) : has_value;
}

void Fields::know(std::string_view key) {
  if (reading()) (void)map_->take(key);
}

std::size_t Fields::size() const {
  const YAML::Node& node = reading() ? map_->node() : written_;
  return node.IsMap() ? node.size() : 0;
}

void Fields::finish() const {
  if (reading()) map_->finish();
}

void Fields::check(bool holds, std::string_view key, const std::string& message) const {
  if (reading() && !holds) map_->fail(key, message);
}

void Fields::check(std::string_view key, const std::function<void()>& action) const {
  if (!reading()) return;
  try {
    action();
  } catch (const InputError& error) {
    map_->fail(key, error.what());
  }
}

}  // namespace touchdown
