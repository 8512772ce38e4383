#include "render/gnuplot/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <qpdf/qpdf-c.h>
#include <regex>
#include <sstream>
#include <type_traits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/table.hpp"
#include "render/gnuplot/process.hpp"
#include "render/palette.hpp"

namespace touchdown::render {

namespace {

struct Cleanup {
  void operator()(qpdf_data document) const { qpdf_cleanup(&document); }
};

struct TextLine {
  const char* head;
  std::string FigureText::*text;
};
constexpr std::array<TextLine, 3> text_lines = {{{"# Title: ", &FigureText::title},
                                                 {"# Caption: ", &FigureText::caption},
                                                 {"# Alt: ", &FigureText::alt}}};

/// The text as comments, one line each. A line end in the text would end its comment.
std::string comments(const FigureText& text) {
  std::string lines;
  for (const TextLine& line : text_lines) {
    std::string content = text.*line.text;
    if (content.empty()) continue;
    std::ranges::replace_if(
        content, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    // A backslash at the end of a line continues even a comment.
    while (content.ends_with('\\') || content.ends_with(' ')) content.pop_back();
    lines += line.head + content + '\n';
  }
  return lines;
}

/// Text is never markup, so that names may contain _ and ^.
constexpr const char* terminals =
    R"(typeface(kind) = sprintf("set terminal %s noenhanced font 'DejaVu Sans,%g' fontscale %g", kind, letters, kind eq 'svg' ? 1.333 : kind eq 'pngcairo' ? dots : scale)
strokes(by) = sprintf(" linewidth %g pointscale %g", by, by)
terminal(format, width, height) = \
    format eq 'png' ? typeface('pngcairo').strokes(dots).sprintf(" size %d,%d background rgb 'white'", width * dots, height * dots) : \
    format eq 'svg' ? typeface('svg').sprintf(" size %d,%d dynamic background rgb 'white'", width, height) : \
    typeface('pdfcairo').strokes(scale).sprintf(" size %.3fin,%.3fin", width * scale / 96.0, height * scale / 96.0)
)";

constexpr double smallest_print = 6.02;  ///< text (pt); it may be rounded to 6
constexpr double usual_letters = 10.0;   ///< text of a figure on a screen (pt)

/// The commands with no text of less than `least` points.
std::string with_least_text(const std::string& commands, double least) {
  static const std::regex font("font '([^',]*),([0-9.]+)'");
  std::string result;
  auto rest = commands.cbegin();
  for (std::sregex_iterator found(commands.begin(), commands.end(), font), end; found != end;
       ++found) {
    result.append(rest, (*found)[0].first);
    result += fmt::format("font '{},{:.6g}'", (*found)[1].str(),
                          std::max(least, std::stod((*found)[2].str())));
    rest = (*found)[0].second;
  }
  return result.append(rest, commands.cend());
}

constexpr const char* style_text =
    R"(set encoding utf8
{lines}set linetype cycle 8
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

/// Widths, markers and dashes of the line types, which differ in more than their colours.
constexpr std::array<const char*, line_colours.size()> line_styles = {
    "lw 1.8 pt 7 ps 0.7",
    "lw 1.8 pt 5 ps 0.7 dt (8,3)",
    "lw 1.8 pt 9 ps 0.8 dt (3,2)",
    "lw 1.8 pt 13 ps 0.8 dt (8,3,2,3)",
    "lw 1.8 pt 11 ps 0.8 dt (12,4)",
    "lw 1.8 pt 3 ps 0.8 dt (2,3)",
    "lw 1.4 pt 1 ps 0.8 dt (1,2)",
    "lw 1.8 pt 2 ps 0.8 dt (16,3,2,3)"};

/// The style of all figures, with which each figure's script begins. Lines and maps have the
/// colours of render/palette.hpp.
std::string gnuplot_style() {
  std::string lines, scale;
  for (std::size_t i = 0; i < line_colours.size(); ++i) {
    lines += fmt::format("set linetype {} lc rgb '#{:06x}' {}\n", i + 1, line_colours[i],
                         line_styles[i]);
  }
  for (std::size_t i = 0; i < cividis.size(); ++i) {
    scale += fmt::format("{}{} '#{:06x}'", i == 0 ? "" : ", ", i, cividis[i]);
  }
  return fmt::format(style_text, fmt::arg("lines", lines), fmt::arg("scale", scale));
}

/// The first line of a figure's script. It marks the figure's files as written by this program.
std::string first_line(const std::string& name) {
  return fmt::format("# Draws {0}.png, {0}.svg and {0}.pdf: gnuplot {1}.gp\n", name,
                     file_argument(name));
}

/// The user chooses a figure's name, so a file of that name which this program did not draw is the
/// user's own. The PNG may be replaced: the user asked for it.
void require_own_files(const std::filesystem::path& folder, const std::string& name,
                       const std::vector<std::string>& files) {
  const std::filesystem::path script = folder / (name + ".gp");
  if (is_there(script) && read_file(script).starts_with(first_line(name))) {
    return;
  }
  for (const std::string& file : files) {
    if (file == name + ".png" || !is_there(folder / file)) continue;
    throw InputError(
        fmt::format("{}: is not part of a figure and would be replaced by one: move it away, or "
                    "give the figure another name",
                    (folder / file).string()));
  }
}

/// The PDF without its creation time, so that the same figure always gives the same file. Errors:
/// `Error` for text that is not a PDF; the message begins with the file's `name`.
std::string dateless_pdf(const std::string& pdf, const std::string& name) {
  const std::unique_ptr<std::remove_pointer_t<qpdf_data>, Cleanup> document(qpdf_init());
  const auto require = [&](QPDF_ERROR_CODE code) {
    if ((code & QPDF_ERRORS) == 0) return;
    throw Error(qpdf_get_error_full_text(document.get(), qpdf_get_error(document.get())));
  };
  qpdf_silence_errors(document.get());
  qpdf_set_suppress_warnings(document.get(), QPDF_TRUE);
  qpdf_set_attempt_recovery(document.get(), QPDF_FALSE);
  require(qpdf_read_memory(document.get(), name.c_str(), pdf.data(), pdf.size(), nullptr));
  qpdf_set_info_key(document.get(), "/CreationDate", nullptr);
  require(qpdf_init_write_memory(document.get()));
  qpdf_set_deterministic_ID(document.get(), QPDF_TRUE);
  require(qpdf_write(document.get()));
  const unsigned char* bytes = qpdf_get_buffer(document.get());
  return {bytes, bytes + qpdf_get_buffer_length(document.get())};
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

double FigureFile::room() const {
  if (!print.width_mm) return std::numeric_limits<double>::infinity();
  return *print.width_mm / 25.4 * 96.0 * usual_letters / smallest_print;
}

PanelColumns columns_in(double room, double margins, const PanelColumns& wanted,
                        double least_width) {
  const double free = room - margins + wanted.gap, least = std::min(least_width, wanted.width);
  const double count =
      std::clamp(std::floor(free / (least + wanted.gap)), 1.0, static_cast<double>(wanted.count));
  // Panels without room make the figure wider than that, and its text larger.
  const double width = std::max(free / count - wanted.gap, 100.0);
  return {static_cast<std::size_t>(count), std::min(wanted.width, width), wanted.gap};
}

Figure draw_figure(const FigureFile& file, int width, int height, const std::string& commands,
                   const std::vector<PlotData>& data, const FigureText& text) {
  const std::filesystem::path& stem = file.stem;
  const std::string name = file.name();
  if (!file.print.only.empty() && file.print.only != name) return {};
  require_writable(stem.string() + ".png");
  const double scale = file.print.width_mm.value_or(0.0) / 25.4 * 96.0 / width;
  const double least = scale > 0.0 ? smallest_print / scale : 0.0;
  const std::filesystem::path folder = stem.parent_path();
  std::vector<std::string> files = {name + ".gp", name + ".png", name + ".svg", name + ".pdf"};
  for (const PlotData& table : data) files.push_back(table.name);
  require_own_files(folder, name, files);
  if (file.before_writing) std::ranges::for_each(files, file.before_writing);
  const PartFolder scratch(stem);
  const std::string script = fmt::format(
      "{0}{1}"
      "# The style of all figures is in the lines to `eval`: text, lines, colours.\n"
      "letters = {8:.6g}; scale = {9:.6g}; dots = {10:.6g}\n"
      "{2}"
      "do for [format in \"png svg pdf\"] {{\n"
      "reset\n"
      "{3}"
      "eval terminal(format, {4}, {5})\n"
      "set output {6}.format\n"
      "{7}"
      "unset output\n"
      "}}\n",
      first_line(name), comments(text), terminals, gnuplot_style(), width, height,
      gnuplot_file(name + "."), with_least_text(commands, least), std::max(usual_letters, least),
      scale > 0.0 ? scale : 1.0, scale > 0.0 ? 300.0 / 96.0 * scale : 1.0);
  write_whole(scratch.path() / (name + ".gp"), script, folder / (name + ".gp"));
  for (const PlotData& table : data) {
    write_whole(scratch.path() / table.name, table.content, folder / table.name);
  }
  const std::string complaint = gnuplot_complaint(scratch.path(), name + ".gp");
  if (!complaint.empty()) {
    throw Error(fmt::format("{}: gnuplot: {}", stem.string(), complaint));
  }
  for (const char* kind : {".png", ".svg", ".pdf"}) {
    require_whole(scratch.path() / (name + kind), folder / (name + kind));
  }
  const std::filesystem::path pdf = scratch.path() / (name + ".pdf");
  write_whole(pdf, dateless_pdf(read_file(pdf), pdf.filename().string()), folder / (name + ".pdf"));
  if (scale > 0.0) {
    const std::filesystem::path svg = scratch.path() / (name + ".svg");
    std::string drawing = read_file(svg);
    drawing.insert(drawing.find("viewBox"), fmt::format("width=\"{}mm\" ", *file.print.width_mm));
    write_whole(svg, drawing, folder / (name + ".svg"));
  }
  for (const std::string& one : files) {
    std::error_code error;
    std::filesystem::rename(scratch.path() / one, folder / one, error);
    if (!error) continue;
    throw Error(fmt::format("{}: cannot be written: {}", (folder / one).string(), error.message()));
  }
  return {stem.string() + ".png", stem.string() + ".svg", stem.string() + ".pdf"};
}

std::string gnuplot_text(std::string_view text) {
  std::string result = "'";
  for (const char letter : text) {
    if (letter == '\n') {
      result += "'.\"\\n\".'";
    } else if (letter == '\'') {
      result += "'.\"'\".'";  // gnuplot's own '' fails at the beginning of a text
    } else if (letter == '@') {
      result += "'.\"\\100\".'";  // a macro's sign, even within quotes
    } else if (static_cast<unsigned char>(letter) >= 0x20) {
      result += letter;
    }
  }
  return result + "'";
}

std::string gnuplot_file(const std::string& name) { return gnuplot_text(file_argument(name)); }

double text_width(const std::vector<std::string>& texts) {
  std::size_t letters = 0;
  for (const std::string& text : texts) letters = std::max(letters, width(text));
  return 7.4 * static_cast<double>(letters);
}

std::string curve_width(std::size_t place, std::size_t count) {
  const auto later =
      static_cast<double>(place) / static_cast<double>(std::max<std::size_t>(count, 2) - 1);
  return fmt::format("lw {:.2g}", 2.4 - 1.2 * later);
}

std::string row_tics(const std::vector<std::string>& names) {
  std::string tics;
  for (std::size_t i = 0; i < names.size(); ++i) {
    tics += fmt::format("{}{} {}", i > 0 ? ", " : "", gnuplot_text(names[i]), names.size() - 1 - i);
  }
  return tics;
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "NaN"; }

}  // namespace touchdown::render
