#include <algorithm>
#include <sstream>

#include "apps/cli/verb.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "core/resources.hpp"
#include "core/table.hpp"
#include "experiments/estimators/registry.hpp"
#include "scenarios/generation/families.hpp"
#include "simulators/registry.hpp"

namespace touchdown::cli {

namespace {

/// The first sentence of the comment at a YAML file's beginning, which describes the file.
std::string first_sentence(const std::filesystem::path& path) {
  std::string comment;
  std::istringstream lines(read_file(path));
  for (std::string line; std::getline(lines, line) && line.starts_with("# ");) {
    comment += (comment.empty() ? "" : " ") + line.substr(2);
  }
  const std::size_t end = std::min(comment.find(". "), comment.find("? "));
  return end == std::string::npos ? comment : comment.substr(0, end + 1);
}

void print_files(const char* title, const char* folder) {
  print("{}\n", title);
  TextTable table{{}, {}};
  for (const std::filesystem::path& path : resources_in(folder, ".yaml")) {
    table.rows.push_back({path.string(), first_sentence(find_resource(path))});
  }
  print("{}\n", to_text(table, 2));
}

/// Name, title and summary of each entry of a registry.
template <typename Entries>
std::string entries_text(const Entries& entries) {
  TextTable table{{}, {}};
  for (const auto& entry : entries) {
    table.rows.push_back({entry.name, entry.title, entry.summary});
  }
  return to_text(table, 3);
}

std::string estimators_text() {
  TextTable table{{}, {}};
  for (const experiments::EstimatorEntry& entry : experiments::estimator_entries()) {
    table.rows.push_back({entry.name, entry.title, entry.summary, entry.reason,
                          experiments::given_text(entry, true)});
  }
  return to_text(table, 5);
}

std::string families_text(const std::vector<scenarios::Family>& families) {
  TextTable table{{}, {}};
  for (const scenarios::Family& family : families) {
    table.rows.push_back({family.name, family.summary});
  }
  return to_text(table, 2);
}

void list() {
  const ProgramFiles files = program_files();
  print("files of the program\n  {} ({})\n\n",
        files.folder.empty() ? "none" : files.folder.string(), files.why);
  print_files("experiments", "experiments");
  print_files("scenarios", "scenarios");
  print("families of drawn scenarios (touchdown generate)\n{}\n",
        families_text(scenarios::families()));
  print("scenes of no family, drawn where a file names them: tests of fits to families\n{}\n",
        families_text({scenarios::random_scenes()}));
  print_files("robots (every MJCF file is a robot, too)", "models");
  print_files("sensors", "noise/profiles");
  print("simulators\n{}\n", entries_text(simulators::simulator_entries()));
  print("estimators, why one would take them, and what they are given\n{}", estimators_text());
}

}  // namespace

void add_list(CLI::App& program, const CliSession& /*session*/) {
  Verb verb(
      program, "list",
      "touchdown list\n\n"
      "Lists the available experiments, scenarios, robots, sensors, simulators and estimators.");
  verb.action(list);
}

}  // namespace touchdown::cli
