#include "tests/architecture/source_tree.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>

namespace touchdown::tests {

namespace fs = std::filesystem;

namespace {

bool is_allowed(const DependencyTable& table, const std::string& from, const std::string& to_file) {
  const std::string to = folder_of(to_file);
  const auto row = table.find(from);
  if (from == to) return true;
  if (row == table.end()) return false;
  return std::any_of(row->second.begin(), row->second.end(), [&](const std::string& name) {
    if (name == to || name == to_file) return true;
    if (!name.ends_with("/*")) return false;
    const std::string root = name.substr(0, name.size() - 2);
    return to == root || to.starts_with(root + "/");
  });
}

std::string place(const Include& include) {
  return include.from + ":" + std::to_string(include.line) + ": includes \"" + include.to + "\"";
}

}  // namespace

SourceTree source_tree_in(const fs::path& source, const std::set<std::string>& top_folders) {
  SourceTree tree;
  for (const std::string& folder : top_folders) {
    for (const auto& entry : fs::recursive_directory_iterator(source / folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".cpp" && ending != ".hpp") continue;
      tree.files.push_back(fs::relative(entry.path(), source).string());
    }
  }
  std::sort(tree.files.begin(), tree.files.end());
  static const std::regex pattern(R"re(^#include "([^"]+)".*)re");
  for (const std::string& file : tree.files) {
    std::ifstream text(source / file);
    std::smatch match;
    int number = 0;
    for (std::string line; std::getline(text, line);) {
      ++number;
      if (std::regex_match(line, match, pattern)) tree.includes.push_back({file, number, match[1]});
    }
  }
  return tree;
}

DependencyTable dependency_table_in(const std::string& markdown) {
  DependencyTable table;
  std::istringstream text(markdown);
  static const std::regex name("`([a-z_/*.]+)`");
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line == "<!-- dependencies -->" || line == "<!-- /dependencies -->") {
      inside = line[5] != '/';
    }
    static const std::regex row(R"(^\| `([^`]+)` \|.*\|([^|]*)\|$)");
    std::smatch cells;
    if (!inside || !std::regex_match(line, cells, row)) continue;
    const std::string last = cells[2];
    std::set<std::string>& allowed = table[cells[1]];
    for (std::sregex_iterator match(last.begin(), last.end(), name), end; match != end; ++match) {
      allowed.insert((*match)[1]);
    }
  }
  return table;
}

std::string folder_of(const std::string& file) {
  const std::size_t slash = file.rfind('/');
  return slash == std::string::npos ? "" : file.substr(0, slash);
}

std::string module_of(const std::string& file) { return file.substr(0, file.rfind('.')); }

std::vector<std::string> forbidden_includes(const DependencyTable& table, const SourceTree& tree) {
  std::vector<std::string> lines;
  std::set<std::string> folders;
  for (const std::string& file : tree.files) folders.insert(folder_of(file));
  for (const std::string& folder : folders) {
    if (!table.contains(folder))
      lines.push_back(folder + ": has no row in docs/reference/architecture.md");
  }
  for (const Include& include : tree.includes) {
    if (is_allowed(table, folder_of(include.from), include.to)) continue;
    lines.push_back(place(include) + ", and " + folder_of(include.from) + " may not include " +
                    folder_of(include.to));
  }
  return lines;
}

std::vector<std::string> cyclic_includes(const SourceTree& tree) {
  std::map<std::string, std::set<std::string>> next;
  for (const Include& include : tree.includes) {
    if (module_of(include.from) != module_of(include.to)) {
      next[module_of(include.from)].insert(module_of(include.to));
    }
  }
  const auto reaches = [&](const std::string& from, const std::string& wanted) {
    std::set<std::string> seen;
    std::function<bool(const std::string&)> search = [&](const std::string& at) {
      if (at == wanted) return true;
      if (!seen.insert(at).second) return false;
      const auto found = next.find(at);
      return found != next.end() && std::any_of(found->second.begin(), found->second.end(), search);
    };
    return search(from);
  };
  std::vector<std::string> lines;
  for (const Include& include : tree.includes) {
    if (module_of(include.from) == module_of(include.to)) continue;
    if (reaches(module_of(include.to), module_of(include.from))) {
      lines.push_back(place(include) + ", which includes it in turn");
    }
  }
  return lines;
}

std::vector<std::string> crowded_folders(const SourceTree& tree, std::size_t most) {
  std::map<std::string, std::set<std::string>> modules;
  for (const std::string& file : tree.files) modules[folder_of(file)].insert(module_of(file));
  std::vector<std::string> lines;
  for (const auto& [folder, inside] : modules) {
    if (inside.size() <= most) continue;
    lines.push_back(folder + ": holds " + std::to_string(inside.size()) + " modules, more than " +
                    std::to_string(most));
  }
  return lines;
}

}  // namespace touchdown::tests
