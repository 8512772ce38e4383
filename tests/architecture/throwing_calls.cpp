#include "tests/architecture/throwing_calls.hpp"

#include <algorithm>
#include <map>
#include <regex>

namespace touchdown::tests {

namespace {

/// Arguments of each function in the form that throws nothing. Those of an iterator depend on
/// nothing else: its steps throw, too.
const std::map<std::string, std::size_t> quiet_arguments = {{"absolute", 2},
                                                            {"canonical", 2},
                                                            {"copy", 3},
                                                            {"copy_file", 3},
                                                            {"create_directories", 2},
                                                            {"create_directory", 2},
                                                            {"create_directory_symlink", 3},
                                                            {"create_hard_link", 3},
                                                            {"create_symlink", 3},
                                                            {"current_path", 1},
                                                            {"equivalent", 3},
                                                            {"exists", 2},
                                                            {"file_size", 2},
                                                            {"is_directory", 2},
                                                            {"is_empty", 2},
                                                            {"is_regular_file", 2},
                                                            {"is_symlink", 2},
                                                            {"last_write_time", 2},
                                                            {"permissions", 3},
                                                            {"read_symlink", 2},
                                                            {"relative", 3},
                                                            {"proximate", 3},
                                                            {"remove", 2},
                                                            {"remove_all", 2},
                                                            {"rename", 3},
                                                            {"resize_file", 3},
                                                            {"space", 2},
                                                            {"status", 2},
                                                            {"symlink_status", 2},
                                                            {"temp_directory_path", 1},
                                                            {"weakly_canonical", 2}};

/// The arguments between the parenthesis before `at` and its partner.
std::vector<std::string> arguments_at(const std::string& text, std::size_t at) {
  std::vector<std::string> arguments(1);
  for (int depth = 1; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '(' || c == '{' || c == '[') ++depth;
    if ((c == ')' || c == '}' || c == ']') && --depth == 0) break;
    if (c == ',' && depth == 1) {
      arguments.emplace_back();
    } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      arguments.back() += c;
    }
  }
  if (arguments.back().empty()) arguments.pop_back();
  return arguments;
}

/// Error codes are variables with plain names, and no paths.
bool may_be_error_code(const std::string& argument) {
  return std::regex_match(argument, std::regex("[a-z_]+"));
}

/// `exists(status)` and `is_regular_file(status)` look at a status that is known.
bool is_about_a_status(const std::vector<std::string>& arguments) {
  return arguments.size() == 1 && (arguments[0].find("status(") != std::string::npos ||
                                   arguments[0].find("type()") != std::string::npos);
}

}  // namespace

std::vector<std::string> throwing_calls(const std::string& file, const std::string& text) {
  static const std::regex call(R"((?:fs|filesystem)::([a-z_]+)(?: [a-z_]+)?\()");
  static const std::regex loop(R"(for \([^;()]*:\s*[a-z:]*(?:recursive_)?directory_iterator\()");
  std::vector<std::string> lines;
  const auto add = [&](std::ptrdiff_t at, const std::string& name) {
    const auto line = 1 + std::count(text.begin(), text.begin() + at, '\n');
    lines.push_back(file + ":" + std::to_string(line) + ": " + name);
  };
  for (std::sregex_iterator one(text.begin(), text.end(), call), end; one != end; ++one) {
    const auto known = quiet_arguments.find((*one)[1]);
    if (known == quiet_arguments.end()) continue;
    const auto arguments =
        arguments_at(text, static_cast<std::size_t>(one->position() + one->length()));
    const bool is_quiet = arguments.size() >= known->second && may_be_error_code(arguments.back());
    if (!is_quiet && !is_about_a_status(arguments)) add(one->position(), known->first);
  }
  for (std::sregex_iterator one(text.begin(), text.end(), loop), end; one != end; ++one) {
    add(one->position(), "directory_iterator");
  }
  return lines;
}

}  // namespace touchdown::tests
