#include "experiments/config/yaml_kind.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/resources.hpp"

namespace touchdown::experiments {

namespace {

struct Kind {
  YamlKind kind;
  std::vector<std::string> distinctive_keys;  // keys that no other kind has
  const char* description;
  const char* command;
};

std::vector<Kind> kinds() {
  return {
      {YamlKind::experiment,
       {"fit", "test", "cross_simulator"},
       "an experiment",
       "touchdown run {}"},
      {YamlKind::training, {"rollout", "optimiser"}, "a training file", "touchdown train {}"},
      {YamlKind::scenario,
       {"terrain", "end", "perturbation"},
       "a scenario",
       "touchdown simulate {} -o run.mpack"},
      {YamlKind::robot, {"mjcf"}, "a robot's file", "touchdown check {}"},
      {YamlKind::mapping,
       {"sources", "period", "time"},
       "a mapping file",
       "touchdown check LOG --mapping {}"},
  };
}

bool is_of(const Kind& kind, const YAML::Node& root) {
  return std::any_of(kind.distinctive_keys.begin(), kind.distinctive_keys.end(),
                     [&](const std::string& key) { return root[key].IsDefined(); });
}

}  // namespace

void require_yaml_kind(const YamlDocument& document, YamlKind wanted) {
  if (!document.root().IsMap()) return;
  std::vector<Kind> found = kinds();
  std::erase_if(found, [&](const Kind& kind) { return !is_of(kind, document.root()); });
  const bool is_wanted = std::any_of(found.begin(), found.end(),
                                     [&](const Kind& kind) { return kind.kind == wanted; });
  if (found.empty() || is_wanted) return;
  throw InputError(fmt::format("{}: is {}; try: {}", document.name(), found.front().description,
                               fmt::format(fmt::runtime(found.front().command), document.name())));
}

YamlDocument completed(YamlDocument document, YamlKind wanted,
                       const std::vector<std::string>& assignments) {
  YamlDocument whole = with_base(std::move(document));
  for (const std::string& assignment : assignments) whole.override_value(assignment);
  require_yaml_kind(whole, wanted);
  return whole;
}

void describe_base(Fields& fields) {
  std::string base;
  if (!fields.given("base", false)) return;
  fields.check(false, "base", "expected in a file alone, which it completes before --set");
  fields("base", base)
      .fallback("none")
      .doc("File that this one changes: it states only what differs, and `~` removes a key.");
}

}  // namespace touchdown::experiments
