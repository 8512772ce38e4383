#include "experiments/config/yaml_kind.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace touchdown::experiments {

namespace {

struct Kind {
  YamlKind kind;
  std::vector<std::string> telling_keys;  // that no other kind has
  const char* description;
  const char* command;
};

std::vector<Kind> kinds() {
  return {
      {YamlKind::experiment,
       {"fit", "test", "cross_simulator"},
       "an experiment",
       "touchdown run {}"},
      {YamlKind::training,
       {"rollout", "optimiser", "network_seconds"},
       "a training file",
       "touchdown train {}"},
      {YamlKind::scenario,
       {"terrain", "end", "perturbation"},
       "a scenario",
       "touchdown simulate {} -o run.mpack"},
  };
}

bool is_of(const Kind& kind, const YAML::Node& root) {
  return std::any_of(kind.telling_keys.begin(), kind.telling_keys.end(),
                     [&](const std::string& key) { return root[key].IsDefined(); });
}

}  // namespace

void require_yaml_kind(const YamlDocument& document, YamlKind wanted) {
  if (!document.root().IsMap()) return;
  std::optional<Kind> found;
  for (const Kind& kind : kinds()) {
    if (!is_of(kind, document.root())) continue;
    if (kind.kind == wanted) return;
    if (!found) found = kind;
  }
  if (!found) return;
  throw InputError(fmt::format("{}: is {}; try: {}", document.name(), found->description,
                               fmt::format(fmt::runtime(found->command), document.name())));
}

}  // namespace touchdown::experiments
