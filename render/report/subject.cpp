#include "render/report/subject.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/results/json.hpp"
#include "experiments/results/result_files.hpp"

namespace touchdown::render {

ReportSubject read_subject(const std::filesystem::path& run_directory) {
  std::error_code ignored;
  const auto has = [&](const char* file) {
    return std::filesystem::is_regular_file(run_directory / file, ignored);
  };
  if (!has("config.yaml")) {
    throw InputError(fmt::format("{}: no run directory of an experiment: it has no config.yaml",
                                 run_directory.string()));
  }
  if (!has("manifest.json")) {
    throw InputError(fmt::format("{0}: is not finished: `touchdown run {0}` continues it",
                                 run_directory.string()));
  }
  ReportSubject subject;
  subject.directory = run_directory;
  try {
    subject.manifest = nlohmann::ordered_json::parse(read_file(run_directory / "manifest.json"));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: {}", (run_directory / "manifest.json").string(),
                                 experiments::reason_of(error)));
  }
  if (!subject.manifest.is_object()) {
    throw InputError((run_directory / "manifest.json").string() + ": expected an object");
  }
  subject.experiment =
      experiments::experiment_from_yaml(YamlDocument::load(run_directory / "config.yaml"),
                                        experiments::written_estimators(run_directory));
  subject.config_text = read_file(run_directory / "config.yaml");
  subject.tables = experiments::read_score_tables(run_directory);
  subject.edited_tables = experiments::edited_tables(run_directory);
  return subject;
}

}  // namespace touchdown::render
