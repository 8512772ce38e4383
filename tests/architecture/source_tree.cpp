#include "tests/architecture/source_tree.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace touchdown::tests {

namespace fs = std::filesystem;

namespace {

std::string top_of(const std::string& file) { return file.substr(0, file.find('/')); }

std::string module_of(const std::string& file) { return file.substr(0, file.rfind('.')); }

std::string place(const Include& include) {
  return include.from + ":" + std::to_string(include.line) + ": includes \"" + include.to + "\"";
}

}  // namespace

SourceTree source_tree_in(const fs::path& source, const std::vector<std::string>& top_folders) {
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

std::vector<std::string> folder_order_in(const std::string& markdown) {
  std::vector<std::string> order;
  std::istringstream text(markdown);
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line == "<!-- folders -->" || line == "<!-- /folders -->") inside = line[5] != '/';
    static const std::regex row(R"(^\| `([a-z]+)` \|.*)");
    std::smatch cells;
    if (inside && std::regex_match(line, cells, row)) order.push_back(cells[1]);
  }
  return order;
}

std::vector<std::string> includes_against(const std::vector<std::string>& order,
                                          const SourceTree& tree) {
  const auto rank = [&](const std::string& file) {
    return std::find(order.begin(), order.end(), top_of(file)) - order.begin();
  };
  const auto unknown = static_cast<std::ptrdiff_t>(order.size());
  std::vector<std::string> lines;
  for (const std::string& file : tree.files) {
    if (rank(file) == unknown) lines.push_back(file + ": its folder has no row");
  }
  for (const Include& include : tree.includes) {
    if (rank(include.to) <= rank(include.from) || rank(include.to) == unknown) continue;
    lines.push_back(place(include) + ", and " + top_of(include.to) + " stands below " +
                    top_of(include.from));
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

}  // namespace touchdown::tests
