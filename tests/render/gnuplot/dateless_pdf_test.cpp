#include "render/gnuplot/figure.hpp"

#include <qpdf/qpdf-c.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/gnuplot/figure.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

/// A page with its producer and creation time, as text or in a packed stream, as cairo writes it
/// from 1.18 on.
std::string drawn_at(const std::string& date, qpdf_object_stream_e streams) {
  qpdf_data document = qpdf_init();
  qpdf_empty_pdf(document);
  qpdf_set_info_key(document, "/Producer", "a plotter");
  qpdf_set_info_key(document, "/CreationDate", date.c_str());
  qpdf_init_write_memory(document);
  qpdf_set_object_stream_mode(document, streams);
  qpdf_set_static_ID(document, QPDF_TRUE);
  qpdf_write(document);
  const unsigned char* bytes = qpdf_get_buffer(document);
  std::string pdf(bytes, bytes + qpdf_get_buffer_length(document));
  qpdf_cleanup(&document);
  return pdf;
}

class DatelessPdf : public ::testing::TestWithParam<qpdf_object_stream_e> {};

TEST_P(DatelessPdf, IsTheSameWheneverItWasDrawn) {
  const std::string one = drawn_at("D:20261121075601Z", GetParam());
  const std::string other = drawn_at("D:20270307101112+01'00", GetParam());
  ASSERT_NE(one, other);
  EXPECT_EQ(dateless_pdf(one, "a.pdf"), dateless_pdf(other, "a.pdf"));
}

INSTANTIATE_TEST_SUITE_P(Info, DatelessPdf, ::testing::Values(qpdf_o_disable, qpdf_o_generate));

TEST(DatelessPdf, KeepsOtherMetadata) {
  EXPECT_THAT(dateless_pdf(drawn_at("D:2026", qpdf_o_disable), "a.pdf"),
              AllOf(HasSubstr("a plotter"), Not(HasSubstr("D:2026"))));
}

TEST(DatelessPdf, AnInvalidPdfIsAnErrorWithItsName) {
  for (const char* text : {"", "no PDF", "%PDF-1.5\n1 0 obj"}) {
    EXPECT_THAT([&] { dateless_pdf(text, "curve.pdf"); },
                ThrowsMessage<Error>(StartsWith("curve.pdf")))
        << text;
  }
}

TEST(DatelessPdf, FiguresAreDateless) {
  const ScratchFolder folder;
  const Figure figure = draw_figure(folder / "line", 200, 100, "plot x\n", {});
  const std::string pdf = read_file(figure.pdf);
  EXPECT_EQ(dateless_pdf(pdf, "line.pdf"), pdf);
}

}  // namespace
}  // namespace touchdown::render
