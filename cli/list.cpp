#include <algorithm>

#include <fmt/format.h>

#include "cli/verbs.hpp"
#include "core/files.hpp"
#include "experiments/estimator_registry.hpp"
#include "experiments/resources.hpp"
#include "experiments/table.hpp"
#include "simulators/simulator.hpp"

namespace touchdown {

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

void print_names(const char* title, const std::vector<std::string>& names) {
  fmt::print("{}\n", title);
  for (const std::string& name : names) fmt::print("  {}\n", name);
  fmt::print("\n");
}

void list() {
  print_files("experiments", "experiments");
  print_files("scenarios", "scenarios");
  print_names("simulators", simulator_names());
  fmt::print("estimators\n");
  Table table{{}, {}};
  for (const EstimatorEntry& entry : estimator_entries()) {
    table.rows.push_back({entry.name, entry.title});
  }
  fmt::print("{}", to_text(table, 2));
}

}  // namespace

void add_list(CLI::App& program, Session& session) {
  CLI::App* verb = program.add_subcommand(
      "list",
      "touchdown list\n\nShows the experiments, scenarios, simulators and estimators at hand.");
  verb->callback([&session] { session.action = list; });
}

}  // namespace touchdown
