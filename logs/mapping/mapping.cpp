#include "logs/mapping/mapping.hpp"

#include <algorithm>
#include <cctype>

#include "core/resources.hpp"

namespace touchdown::logs {

namespace {

/// A text, or a list of them.
void describe_names(Fields& fields, const char* key, std::vector<std::string>& names,
                    const char* meaning) {
  const YAML::Node given = fields.node()[key];
  if (fields.documenting() || (given && given.IsSequence())) {
    fields(key, names).type("text or list of texts").fallback("none").doc(meaning);
  } else if (given) {
    fields(key, names.emplace_back());
  }
  for (const std::string& name : names) fields.check(!name.empty(), key, "expected a name");
}

bool is_file_name(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".csv" || extension == ".npz" || extension == ".tsv" || extension == ".txt";
}

}  // namespace

bool LogSources::are_files() const {
  return std::any_of(joints.begin(), joints.end(), is_file_name) ||
         std::any_of(imu.begin(), imu.end(), is_file_name);
}

void describe(Fields& fields, LogSources& sources) {
  for (const char* key : {"joints", "imu", "contact", "stale_after"}) fields.know(key);
  fields.finish();
  fields.require("joints");
  fields.require("imu");
  describe_names(
      fields, "joints", sources.joints,
      "Files of one folder, or topics of a bag, with the joints. Their clock is the log's.");
  describe_names(fields, "imu", sources.imu, "File or topic with the IMU.");
  describe_names(fields, "contact", sources.contact,
                 "File with the contact labels, if they are not among the joints.");
  fields("stale_after", sources.stale_after, 1e-3, 10.0)
      .doc("s", "A value is held until the next one, but is missing when it is older than this.");
}

LogSources read_log_sources(const std::filesystem::path& mapping) {
  require_file(mapping);
  const YamlDocument document = YamlDocument::load(mapping);
  LogSources sources;
  Fields fields(document);
  if (fields.present("sources", false)) fields.section("sources", sources);
  return sources;
}

std::size_t LogMapping::joint_source() const {
  for (const MappedSignal::Number& number : position.numbers) {
    if (number.column < columns.size()) return columns[number.column].source;
  }
  return 0;
}

}  // namespace touchdown::logs
