#include "tests/faults/outcome.hpp"

#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/files.hpp"

namespace touchdown::faults {

namespace fs = std::filesystem;

namespace {

/// The part of a file that must be reproduced.
std::string comparable_content(const std::string& name, std::string content) {
  if (name == "manifest.json" || name == "models/nmn.json")
    return nlohmann::json::accept(content) ? "whole" : content;
  // libtorch names the moments in a checkpoint by the memory addresses of their weights.
  if (name.ends_with(".pt")) return "whole";
  if (name == "report.html") return content.ends_with("</html>\n") ? "whole" : content;
  return content;
}

bool is_part(const fs::path& path) {
  return std::any_of(path.begin(), path.end(), [](const fs::path& name) {
    return is_part_file_name(name) || is_part_folder_name(name);
  });
}

std::vector<std::string> missing_or_other(const Files& left, const Files& expected) {
  std::vector<std::string> wrong;
  for (const auto& [name, content] : expected) {
    const auto found = left.find(name);
    if (found == left.end()) wrong.push_back(name + " is missing");
  }
  for (const auto& [name, content] : left) {
    const auto should = expected.find(name);
    if (should == expected.end() || should->second != content) {
      wrong.push_back(name + (should == expected.end() ? " is unexpected" : " differs"));
    }
  }
  return wrong;
}

}  // namespace

Files files_of(const fs::path& directory) {
  Files files;
  if (!fs::exists(directory)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    const fs::path name = entry.path().lexically_relative(directory);
    const bool is_of_shards = name.parent_path() == "state/processors";
    if (!entry.is_regular_file() || name == "state/lock" || name == "state/files" || is_of_shards ||
        is_part(name)) {
      continue;
    }
    files[name.string()] = comparable_content(name.string(), read_file(entry.path()));
  }
  return files;
}

std::vector<std::string> parts_in(const fs::path& directory) {
  std::vector<std::string> parts;
  if (!fs::exists(directory)) return parts;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    const fs::path name = entry.path().lexically_relative(directory);
    if (is_part(name)) parts.push_back(name.string());
  }
  return parts;
}

std::vector<std::string> wrong_in(const cli::Ended& ended, const Injection& injection,
                                  const Files& left, const Files& expected) {
  std::vector<std::string> wrong = missing_or_other(left, expected);
  const std::vector<std::string> messages = cli::messages_in(ended.errors);
  if (ended.exit_code == 0) {
    if (injection.has_refused(Kind::flush)) wrong.push_back("succeeded, and did not flush");
    if (!messages.empty()) wrong.push_back("succeeded, with messages: " + ended.errors);
    return wrong;
  }
  std::erase_if(wrong, [](const std::string& one) { return one.ends_with(" is missing"); });
  if (ended.exit_code != 1) wrong.push_back(fmt::format("ended with {}", ended.exit_code));
  const std::vector<std::string> subjects = injection.subjects();
  const bool is_named =
      messages.size() == 1 && messages.front().starts_with("touchdown: ") &&
      std::any_of(subjects.begin(), subjects.end(), [&](const std::string& subject) {
        return messages.front().find(subject) != std::string::npos;
      });
  if (!is_named) {
    wrong.push_back(fmt::format("expected one line about '{}', found: {}",
                                fmt::join(subjects, ", "), ended.errors));
  }
  return wrong;
}

std::vector<std::string> half_written(const Files& left, const Files& expected) {
  std::vector<std::string> wrong = missing_or_other(left, expected);
  std::erase_if(wrong, [](const std::string& one) { return one.ends_with(" is missing"); });
  return wrong;
}

std::vector<std::string> wrong_after(const cli::Ended& again, const fs::path& directory,
                                     const Files& expected) {
  std::vector<std::string> wrong = missing_or_other(files_of(directory), expected);
  for (const std::string& part : parts_in(directory)) wrong.push_back(part + " was left");
  if (again.exit_code != 0) {
    wrong.push_back(fmt::format("ended with {}: {}", again.exit_code, again.errors));
  }
  for (std::string& one : wrong) one.insert(0, "again: ");
  return wrong;
}

}  // namespace touchdown::faults
