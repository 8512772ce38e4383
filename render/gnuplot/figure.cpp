#include "render/gnuplot/figure.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/gnuplot/pdf_date.hpp"
#include "render/gnuplot/process.hpp"
#include "render/gnuplot/style.hpp"

namespace touchdown::render {
namespace {

struct TextLine {
  const char* head;
  std::string FigureText::*text;
};
constexpr std::array<TextLine, 3> text_lines = {{{"# Title: ", &FigureText::title},
                                                 {"# Caption: ", &FigureText::caption},
                                                 {"# Alt: ", &FigureText::alt}}};

/// The text as comments, one line each: a line end in it would let it out of the comment.
std::string comments(const FigureText& text) {
  std::string lines;
  for (const TextLine& line : text_lines) {
    std::string content = text.*line.text;
    if (content.empty()) continue;
    std::replace_if(
        content.begin(), content.end(),
        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    // A backslash at the end of a line continues even a comment.
    while (content.ends_with('\\') || content.ends_with(' ')) content.pop_back();
    lines += line.head + content + '\n';
  }
  return lines;
}

void write(const std::filesystem::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

}  // namespace

FigureText figure_text(const std::string& script) {
  FigureText text;
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line) && line.starts_with('#');) {
    for (const TextLine& known : text_lines) {
      const std::string_view head = known.head;
      if (line.starts_with(head)) text.*known.text = line.substr(head.size());
    }
  }
  return text;
}

Figure draw_figure(const std::filesystem::path& stem, int width, int height,
                   const std::string& commands, const std::vector<PlotData>& data,
                   const FigureText& text) {
  require_writable(stem.string() + ".png");
  const PartFolder scratch(stem);
  const std::string name = stem.filename().string();
  const std::string script = fmt::format(
      "# Draws {0}.png, {0}.svg and {0}.pdf: gnuplot {0}.gp\n"
      "{1}"
      "load 'style.gp'\n"
      "do for [format in \"png svg pdf\"] {{\n"
      "eval terminal(format, {2}, {3})\n"
      "set output {4}.format\n"
      "{5}"
      "unset output\n"
      "}}\n",
      name, comments(text), width, height, gnuplot_text(name + "."), commands);
  write(scratch.path() / (name + ".gp"), script);
  write(scratch.path() / "style.gp", gnuplot_style());
  std::vector<std::string> files = {"style.gp", name + ".gp", name + ".png", name + ".svg",
                                    name + ".pdf"};
  for (const PlotData& table : data) {
    write(scratch.path() / table.name, table.content);
    files.push_back(table.name);
  }
  const std::string complaint = gnuplot_complaint(scratch.path(), name + ".gp");
  if (!complaint.empty()) {
    throw Error(fmt::format("{}: gnuplot: {}", stem.string(), complaint));
  }
  remove_pdf_date(scratch.path() / (name + ".pdf"));
  const std::filesystem::path folder = std::filesystem::absolute(stem).parent_path();
  try {
    for (const std::string& file : files) {
      std::filesystem::rename(scratch.path() / file, folder / file);
    }
  } catch (const std::filesystem::filesystem_error& error) {
    throw Error(fmt::format("{}: cannot be written: {}", stem.string(), error.code().message()));
  }
  return {stem.string() + ".png", stem.string() + ".svg", stem.string() + ".pdf"};
}

}  // namespace touchdown::render
