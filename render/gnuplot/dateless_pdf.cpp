#include "render/gnuplot/dateless_pdf.hpp"

#include <memory>
#include <qpdf/qpdf-c.h>
#include <type_traits>

#include "core/error.hpp"

namespace touchdown::render {

namespace {

struct Cleanup {
  void operator()(qpdf_data document) const { qpdf_cleanup(&document); }
};

}  // namespace

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

}  // namespace touchdown::render
