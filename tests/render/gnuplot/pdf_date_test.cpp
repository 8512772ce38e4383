#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "render/gnuplot/figure.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

TEST(PdfDate, IsReplacedWithoutMovingWhatFollows) {
  EXPECT_EQ(without_date("a /CreationDate (D:20261121075601Z) b"),
            "a /CreationDate (D:19700101000000Z) b");
  EXPECT_EQ(without_date("a /CreationDate (D:20261121075601+01'00) b"),
            "a /CreationDate (D:19700101000000Z)      b");
}

TEST(PdfDate, WhatHasNoneStaysAsItIs) {
  for (const char* text : {"", "no date", "/CreationDate (", "/CreationDate (D:2026)"}) {
    EXPECT_EQ(without_date(text), text);
  }
}

TEST(PdfDate, IsNotThatOfTheDrawing) {
  const ScratchFolder folder;
  const Figure figure = draw_figure(folder / "line", 200, 100, "plot x\n", {});
  EXPECT_THAT(read_file(figure.pdf), ::testing::HasSubstr("/CreationDate (D:19700101000000Z)"));
}

}  // namespace
}  // namespace touchdown::render
