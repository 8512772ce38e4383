#include <fmt/format.h>

#include "cli/verbs.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"
#include "core/table.hpp"
#include "experiments/estimators/registry.hpp"
#include "simulators/registry.hpp"

namespace touchdown::cli {

namespace {

/// A YAML file's first comment line, which says what it is for.
std::string first_comment(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  if (text.rfind("# ", 0) != 0) return "";
  return text.substr(2, text.find('\n') - 2);
}

void print_files(const char* title, const char* folder) {
  fmt::print("{}\n", title);
  Table table{{}, {}};
  for (const std::filesystem::path& path : resources_in(folder, ".yaml")) {
    table.rows.push_back({path.string(), first_comment(find_resource(path))});
  }
  fmt::print("{}\n", to_text(table, 2));
}

/// What a registry says about each of its entries.
template <typename Entries>
std::string entries_text(const Entries& entries) {
  Table table{{}, {}};
  for (const auto& entry : entries) {
    table.rows.push_back({entry.name, entry.title, entry.summary});
  }
  return to_text(table, 3);
}

void list() {
  print_files("experiments", "experiments");
  print_files("scenarios", "scenarios");
  print_files("robots, beside every MJCF", "models");
  print_files("sensors", "sensors");
  fmt::print("simulators\n{}\n", entries_text(simulators::simulator_entries()));
  fmt::print("estimators\n{}", entries_text(experiments::estimator_entries()));
}

}  // namespace

void add_list(CLI::App& program, const CliSession& /*session*/) {
  Verb verb(program, "list",
            "touchdown list\n\nShows the experiments, scenarios, robots, sensors, simulators and "
            "estimators at hand.");
  verb.action(list);
}

}  // namespace touchdown::cli
