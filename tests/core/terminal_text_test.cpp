#include "core/terminal_text.hpp"

#include <gtest/gtest.h>

#include "core/table.hpp"

namespace touchdown {
namespace {

TEST(TerminalText, LeavesNothingThatATerminalObeys) {
  EXPECT_EQ(terminal_text("a\x1b[31mred\x1b]0;title\x07"), "a\\x1b[31mred\\x1b]0;title\\x07");
  EXPECT_EQ(terminal_text("two\nlines\r\tand\x7f\b"), "two\\nlines\\r\\tand\\x7f\\x08");
  EXPECT_EQ(terminal_text(std::string("\0", 1)), "\\x00");
  EXPECT_EQ(terminal_text("\xc2\x9b"
                          "2J"),
            "\\u009b2J");  // a control sequence of one character
  EXPECT_EQ(terminal_text("\xe2\x80\xaegnp.exe"), "\\u202egnp.exe");  // read from right to left
  EXPECT_EQ(terminal_text("\xe2\x81\xa6"), "\\u2066");
  EXPECT_EQ(terminal_text("\xe2\x80\xa8"), "\\u2028");
}

TEST(TerminalText, WritesBytesThatAreNoTextAsNumbers) {
  EXPECT_EQ(terminal_text("\xff\xfe.csv"), "\\xff\\xfe.csv");
  EXPECT_EQ(terminal_text("m\xc3"), "m\\xc3");                  // cut off
  EXPECT_EQ(terminal_text("\x9b"), "\\x9b");                    // a control byte of Latin-1
  EXPECT_EQ(terminal_text("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // half of a pair
}

TEST(TerminalText, KeepsOtherText) {
  const std::string text = "0.987 ± 0.2 N·m, −5 °, 車輪, 🙂 — 'x' \"y\" \\n";
  EXPECT_EQ(terminal_text(text), text);
  EXPECT_EQ(terminal_text("a\nb\tc\x1b", "\n\t"), "a\nb\tc\\x1b");
}

TEST(TerminalText, IsInEveryCellOfATable) {
  const std::string text = to_text(TextTable{{"na\nme", "n"}, {{"\x1b[2J", "1"}, {"b\r", "2"}}});
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
  EXPECT_NE(text.find("na\\nme"), std::string::npos);
}

}  // namespace
}  // namespace touchdown
