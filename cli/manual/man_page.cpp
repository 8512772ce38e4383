#include "cli/manual/man_page.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace touchdown::cli {

namespace {

/// Escapes text so that roff prints it unchanged. To roff, a backslash or a leading dot is a
/// command, and plain dashes and quotes become typographic ones.
std::string plain(const std::string& text) {
  static const std::map<char, std::string> escapes = {
      {'\\', "\\e"}, {'-', "\\-"}, {'`', "\\(ga"}, {'\'', "\\(aq"}, {'~', "\\(ti"}, {'^', "\\(ha"}};
  std::string result = text.starts_with('.') ? "\\&" : "";
  for (const char letter : text) {
    const auto escape = escapes.find(letter);
    result += escape == escapes.end() ? std::string(1, letter) : escape->second;
  }
  return result;
}

std::string bold(const std::string& text) { return fmt::format("\\fB{}\\fR", plain(text)); }
std::string italic(const std::string& text) { return fmt::format("\\fI{}\\fR", plain(text)); }

/// "Writes report.html" of "Writes report.html: a page. It opens without a network."
std::string brief(const std::string& text) {
  const std::string first = text.substr(0, std::min(text.find(". "), text.find(": ")));
  return first.ends_with('.') ? first.substr(0, first.size() - 1) : first;
}

std::string synopsis(const DescribedVerb& subject) {
  std::string line = bold(subject.name.empty() ? "touchdown" : "touchdown " + subject.name);
  line += fmt::format(" [{}]", italic("options"));
  if (subject.name.empty()) line += fmt::format(" {}", italic("command"));
  for (const DescribedOption& option : subject.options) {
    if (!option.positional) continue;
    const std::string name = italic(option.names.front()) + (option.more ? " ..." : "");
    line += option.required ? fmt::format(" {}", name) : fmt::format(" [{}]", name);
  }
  return line;
}

std::string entry(const DescribedOption& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) {
    names.push_back(option.positional ? italic(name) : bold(name));
  }
  std::string head = fmt::format("{}", fmt::join(names, ", "));
  if (!option.positional) {
    for (int i = 0; i < option.count; ++i) head += fmt::format(" {}", italic(option.value));
    if (option.more) head += " ...";
  }
  std::string text = plain(option.text);
  if (option.required && !option.positional) text += " (required)";
  if (!option.fallback.empty()) text += fmt::format(" (default: {})", plain(option.fallback));
  return fmt::format(".TP\n{}\n{}\n", head, text);
}

}  // namespace

std::string man_page(const DescribedVerb& subject, const std::vector<DescribedVerb>& verbs,
                     const std::string& version) {
  const std::string title = plain(subject.name.empty() ? "touchdown" : "touchdown-" + subject.name);
  std::string page = fmt::format(".TH {} 1 \"\" \"touchdown {}\"\n", title, version);
  page += fmt::format(".SH NAME\n{} \\- {}\n", title, plain(brief(subject.text)));
  page += fmt::format(".SH SYNOPSIS\n{}\n", synopsis(subject));
  page += fmt::format(".SH DESCRIPTION\n{}\n", plain(subject.text));
  if (!verbs.empty()) page += ".SH COMMANDS\n";
  for (const DescribedVerb& verb : verbs) {
    page += fmt::format(".TP\n{}(1)\n{}\n", bold("touchdown-" + verb.name), plain(verb.text));
  }
  if (!subject.options.empty()) page += ".SH OPTIONS\n";
  for (const DescribedOption& option : subject.options) page += entry(option);
  page += ".SH EXAMPLES\n.nf\n";
  for (const std::string& example : subject.examples) page += plain(example) + "\n";
  page += ".fi\n";
  if (verbs.empty()) page += ".SH SEE ALSO\n" + bold("touchdown") + "(1)\n";
  return page;
}

}  // namespace touchdown::cli
