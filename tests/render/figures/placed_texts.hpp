#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/files.hpp"

namespace touchdown::render {

/// A text that is not rotated, with the place that letters of half their height take.
struct PlacedText {
  std::string text;
  double left, right, base, size;
};

inline std::vector<PlacedText> texts_in(const std::filesystem::path& drawing) {
  std::vector<PlacedText> texts;
  PlacedText next;
  std::istringstream lines(read_file(drawing));
  for (std::string line, anchor; std::getline(lines, line);) {
    const std::string head = "<g transform=\"translate(";
    if (const auto at = line.find(head); at != std::string::npos) {
      char comma = ',';
      std::istringstream(line.substr(at + head.size())) >> next.left >> comma >> next.base;
      next.size = std::strtod(line.c_str() + line.find("font-size=\"") + 11, nullptr);
      anchor = line.substr(line.find("text-anchor=\"") + 13, 1);
      if (line.find("rotate") != std::string::npos) next.size = 0.0;
    } else if (const auto from = line.find("<text>"); from != std::string::npos) {
      PlacedText placed = next;
      placed.text = line.substr(from + 6, line.find("</text>") - from - 6);
      const auto letters = std::ranges::count_if(
          placed.text, [](unsigned char byte) { return (byte & 0xC0U) != 0x80U; });
      const double width = 0.5 * placed.size * static_cast<double>(letters);
      placed.left -= anchor == "m" ? 0.5 * width : anchor == "e" ? width : 0.0;
      placed.right = placed.left + width;
      if (placed.size > 0.0 && letters > 0) texts.push_back(placed);
    }
  }
  return texts;
}

/// Expects that no text of an SVG leaves the drawing, and that none touches one beside it.
inline void expect_texts_inside_and_apart(const std::filesystem::path& drawing) {
  const std::string svg = read_file(drawing);
  std::istringstream box(svg.substr(svg.find("viewBox=\"0 0 ") + 13));
  double width = 0.0, height = 0.0;
  box >> width >> height;
  const std::vector<PlacedText> texts = texts_in(drawing);
  EXPECT_GT(texts.size(), 20U) << drawing;
  for (const PlacedText& one : texts) {
    EXPECT_GE(one.left, 0.0) << one.text;
    EXPECT_LE(one.right, width) << one.text;
    EXPECT_LE(one.base, height - 0.2 * one.size) << one.text;
    for (const PlacedText& other : texts) {
      if (&one == &other || std::abs(one.base - other.base) > 0.5 * one.size) continue;
      EXPECT_TRUE(one.right < other.left || other.right < one.left) << one.text << other.text;
    }
  }
}

}  // namespace touchdown::render
