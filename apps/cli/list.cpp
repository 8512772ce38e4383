#include <algorithm>
#include <memory>
#include <sstream>

#include "apps/cli/reference.hpp"
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

/// Aligned texts, a row of them for each entry.
template <typename Entries, typename Row>
std::string table_of(const Entries& entries, const Row& row) {
  TextTable table{{}, {}};
  for (const auto& entry : entries) table.rows.push_back(row(entry));
  return to_text(table, table.rows.empty() ? 0 : table.rows.front().size());
}

void print_files(const char* title, const char* folder) {
  print("{}\n{}\n", title,
        table_of(resources_in(folder, ".yaml"), [](const std::filesystem::path& path) {
          return std::vector{path.string(), first_sentence(find_resource(path))};
        }));
}

std::vector<std::string> row_of(const scenarios::Family& family) {
  return {family.name, family.summary};
}

void list() {
  const ProgramFiles files = program_files();
  print("files of the program\n  {} ({})\n\n",
        files.folder.empty() ? "none" : files.folder.string(), files.why);
  print_files("experiments", "experiments");
  print_files("scenarios", "scenarios");
  print("families of drawn scenarios (touchdown generate)\n{}\n",
        table_of(scenarios::families(), row_of));
  print("scenes of no family, drawn where a file names them: tests of fits to families\n{}\n",
        table_of(std::vector{scenarios::random_scenes()}, row_of));
  print_files("robots (every MJCF file is a robot, too)", "models");
  print_files("sensors", "noise/profiles");
  print("simulators\n{}\n", table_of(simulators::simulator_entries(), [](const auto& entry) {
          return std::vector<std::string>{entry.name, entry.title, entry.summary};
        }));
  print("estimators, why one would take them, and what they are given\n{}",
        table_of(experiments::estimator_entries(), [](const experiments::EstimatorEntry& entry) {
          return std::vector<std::string>{entry.name, entry.title, entry.summary, entry.reason,
                                          experiments::given_text(entry)};
        }));
}

struct ListFlags {
  std::string what;
  bool markdown = false;
};

}  // namespace

void add_list(CLI::App& program, const CliSession& /*session*/) {
  Verb verb(
      program, "list",
      "touchdown list\n"
      "touchdown list scenario\n\n"
      "Lists the available experiments, scenarios, robots, sensors, simulators and estimators, or\n"
      "every key of a kind of YAML file, with type, unit, range, default and meaning. Kinds:\n"
      "experiment, scenario, robot, sensors, mapping, training.");
  const auto flags = std::make_shared<ListFlags>();
  verb.option("what", &flags->what, "Kind of file, 'keys' of all kinds, or 'commands'")
      .value_name("WHAT");
  verb.flag("--markdown", &flags->markdown, "Print as a document: docs/reference/keys.md, cli.md");
  verb.action([&program, flags] {
    if (flags->what.empty()) return list();
    print(flags->what == "commands" ? commands_reference(program)
                                    : keys_reference(flags->what, flags->markdown));
  });
}

}  // namespace touchdown::cli
