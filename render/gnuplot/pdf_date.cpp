#include "render/gnuplot/pdf_date.hpp"

#include <string_view>

#include "core/files.hpp"

namespace touchdown::render {

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

void remove_pdf_date(const std::filesystem::path& path) {
  write_atomically(path, without_date(read_file(path)));
}

}  // namespace touchdown::render
