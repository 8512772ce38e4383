#include "render/gnuplot/figure.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/gnuplot/process.hpp"
#include "render/palette.hpp"

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

constexpr const char* style_text =
    R"(# The style of all figures. Change it here and draw them again.
# Text is never markup, so that names may contain _ and ^.
terminal(format, width, height) = \
    format eq 'png' ? sprintf("set terminal pngcairo noenhanced font 'DejaVu Sans,10' size %d,%d background rgb 'white'", width, height) : \
    format eq 'svg' ? sprintf("set terminal svg noenhanced font 'DejaVu Sans,10' fontscale 1.333 size %d,%d dynamic background rgb 'white'", width, height) : \
    sprintf("set terminal pdfcairo noenhanced font 'DejaVu Sans,10' size %.2fin,%.2fin", width / 96.0, height / 96.0)
set encoding utf8
{lines}set linetype 7 lc rgb '#22262b' lw 1.4 pt 1 ps 0.8 dt (1,2)
set linetype 8 lc rgb '#8c6d31' lw 1.8 pt 2 ps 0.8 dt (16,3,2,3)
set linetype cycle 8
set palette defined ({scale})
set border 3 lc rgb '#40464e' lw 0.8
set tics nomirror out scale 0.5 textcolor rgb '#22262b'
set grid back lc rgb '#dfe3e6' lw 0.6 dt 1
set key noautotitle samplen 2.5 spacing 1.1 textcolor rgb '#22262b'
set style fill solid 1.0 noborder
set datafile separator tab
set datafile missing 'NaN'
set minussign
)";

/// Markers and dashes of the curves, which differ in more than their colours.
constexpr std::array<const char*, okabe_ito.size()> looks = {"pt 7 ps 0.7",
                                                             "pt 5 ps 0.7 dt (8,3)",
                                                             "pt 9 ps 0.8 dt (3,2)",
                                                             "pt 13 ps 0.8 dt (8,3,2,3)",
                                                             "pt 11 ps 0.8 dt (12,4)",
                                                             "pt 3 ps 0.8 dt (2,3)"};

/// The one style of all figures, written beside them as `style.gp`: lines and maps in the colours
/// of render/palette.hpp.
std::string gnuplot_style() {
  std::string lines, scale;
  for (std::size_t i = 0; i < okabe_ito.size(); ++i) {
    lines +=
        fmt::format("set linetype {} lc rgb '#{:06x}' lw 1.8 {}\n", i + 1, okabe_ito[i], looks[i]);
  }
  for (std::size_t i = 0; i < cividis.size(); ++i) {
    scale += fmt::format("{}{} '#{:06x}'", i == 0 ? "" : ", ", i, cividis[i]);
  }
  return fmt::format(style_text, fmt::arg("lines", lines), fmt::arg("scale", scale));
}

void write(const std::filesystem::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

}  // namespace

std::string without_date(std::string pdf) {
  constexpr std::string_view key = "/CreationDate (";
  constexpr std::string_view date = "D:19700101000000Z)";
  const std::size_t begin = pdf.find(key);
  if (begin == std::string::npos) return pdf;
  const std::size_t end = pdf.find(')', begin);
  const std::size_t start = begin + key.size();
  if (end == std::string::npos || end + 1 - start < date.size()) return pdf;
  std::string stands_there(date);
  stands_there.resize(end + 1 - start, ' ');
  return pdf.replace(start, stands_there.size(), stands_there);
}

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
  const std::filesystem::path pdf = scratch.path() / (name + ".pdf");
  write(pdf, without_date(read_file(pdf)));
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
