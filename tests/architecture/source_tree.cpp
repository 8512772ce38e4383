#include "tests/architecture/source_tree.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
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
      tree.files.push_back({fs::relative(entry.path(), source).string()});
    }
  }
  const auto by_name = [](const SourceFile& a, const SourceFile& b) { return a.name < b.name; };
  std::sort(tree.files.begin(), tree.files.end(), by_name);
  static const std::regex pattern(R"re(^#include "([^"]+)".*)re");
  for (SourceFile& file : tree.files) {
    std::ifstream text(source / file.name);
    std::smatch match;
    for (std::string line; std::getline(text, line);) {
      ++file.lines;
      if (std::regex_match(line, match, pattern)) {
        tree.includes.push_back({file.name, static_cast<int>(file.lines), match[1]});
      }
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
  for (const SourceFile& file : tree.files) {
    if (rank(file.name) == unknown) lines.push_back(file.name + ": its folder has no row");
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

std::vector<std::string> long_files(const SourceTree& tree, std::size_t most) {
  std::vector<std::string> lines;
  for (const SourceFile& file : tree.files) {
    if (file.lines > most)
      lines.push_back(file.name + ": " + std::to_string(file.lines) + " lines");
  }
  return lines;
}

std::vector<std::string> headers_with_one_reader(const SourceTree& tree, std::size_t most,
                                                 const std::set<std::string>& exempt) {
  std::map<std::string, std::size_t> size;
  for (const SourceFile& file : tree.files) size[file.name] = file.lines;
  std::map<std::string, std::set<std::string>> readers;
  for (const Include& include : tree.includes) {
    if (module_of(include.from) != module_of(include.to)) {
      readers[include.to].insert(module_of(include.from));
    }
  }
  std::vector<std::string> lines;
  for (const SourceFile& file : tree.files) {
    if (!file.name.ends_with(".hpp") || exempt.contains(file.name)) continue;
    const std::set<std::string>& found = readers[file.name];
    if (found.size() > 1) continue;
    if (!found.empty() &&
        size[module_of(file.name) + ".cpp"] + size[*found.begin() + ".cpp"] > most) {
      continue;
    }
    lines.push_back(file.name + (found.empty() ? ": no module includes it"
                                               : ": only " + *found.begin() + " includes it"));
  }
  return lines;
}

}  // namespace touchdown::tests
