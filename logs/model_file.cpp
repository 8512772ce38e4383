#include "logs/model_file.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/terminal_text.hpp"
#include "estimator/npz/npz.hpp"

namespace touchdown::logs {

namespace {

using Text = std::back_insert_iterator<std::string>;

bool are_floats(const ModelArray& array) {
  return std::all_of(array.data.begin(), array.data.end(), [](double value) {
    return static_cast<double>(static_cast<float>(value)) == value;
  });
}

template <typename Number>
void put_numbers(std::string& text, const std::vector<double>& data, const char* suffix) {
  std::size_t line = text.size();
  for (const double value : data) {
    if (text.size() > line + 90) {
      text += '\n';
      line = text.size();
    }
    // "#" writes every number with a decimal point.
    fmt::format_to(Text(text), "{:#}{},", static_cast<Number>(value), suffix);
  }
}

/// Errors: `InputError` for a name that is more than a name in C++.
void require_identifier(const std::string& key) {
  const auto is_allowed = [](char c) {
    return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0;
  };
  if (std::all_of(key.begin(), key.end(), is_allowed)) return;
  throw InputError(fmt::format("array '{}': expected letters, digits and '_' in its name", key));
}

/// Writes any bytes as a C++ string literal.
void put_text(std::string& text, const std::string& value) {
  text += '"';
  for (const char c : value) {
    if (c == '\n') {
      text += "\\n\"\n\"";
    } else if (c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20) {
      fmt::format_to(Text(text), "\\{:03o}", static_cast<unsigned char>(c));
    } else {
      text += c;
    }
  }
  text += '"';
}

}  // namespace

void save_model(const Model& model, const std::filesystem::path& path) {
  write_npz(arrays_of(model), path);
}

void write_npz(ModelArrays arrays, const std::filesystem::path& path) {
  write_atomically(path, to_npz(std::move(arrays), path.string(), Deflated::large));
}

Model load_model_for(const std::filesystem::path& path, const ModelUse& use) {
  Model model = load_model(path);
  try {
    return model_for(std::move(model), use);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

std::string header_of_model(const Model& model, const std::string& source,
                            const std::string& name) {
  const ModelArrays arrays = arrays_of(model);
  const ModelMetadata metadata = *metadata_of(arrays);
  std::string text = fmt::format(
      "#pragma once\n\n"
      "// {}, written by `touchdown convert`: for '{}' at {:.6g} Hz on the robot '{}',\n"
      "// fingerprint {}. touchdown::make_estimator(touchdown::compiled::{}) makes the "
      "estimator.\n\n"
      "// clang-format off\n"
      "#include <touchdown/estimator.hpp>\n\nnamespace touchdown::compiled {{\n\n",
      terminal_text(source), terminal_text(metadata.estimator), metadata.sample_rate,
      metadata.robot.empty() ? "unknown" : terminal_text(metadata.robot), metadata.fingerprint,
      name);  // a line break in one of them would end the comment
  std::string table = fmt::format("inline constexpr CompiledArray {}[] = {{\n", name);
  for (const auto& [key, array] : arrays) {
    if (key == derived_array) continue;
    require_identifier(key);
    const std::string own = fmt::format("{}_{}", name, key);
    const char* pointers = nullptr;
    if (is_text_array(key)) {
      text += fmt::format("inline constexpr char {}[] =\n", own);
      put_text(text, text_of_array(array, key));
      text += ";\n";
      pointers = "nullptr, nullptr, {}";
    } else if (are_floats(array)) {
      text += fmt::format("inline constexpr float {}[] = {{\n", own);
      put_numbers<float>(text, array.data, "F");
      text += "};\n";
      pointers = "nullptr, {}, nullptr";
    } else {
      text += fmt::format("inline constexpr double {}[] = {{\n", own);
      put_numbers<double>(text, array.data, "");
      text += "};\n";
      pointers = "{}, nullptr, nullptr";
    }
    fmt::format_to(Text(table), "    {{\"{}\", {}, {}, {}}},\n", key, array.rows(),
                   array.shape.size() < 2 ? 0 : array.columns(),
                   fmt::format(fmt::runtime(pointers), own));
  }
  return text + "\n" + table + "};\n\n}  // namespace touchdown::compiled\n";
}

}  // namespace touchdown::logs
