#include "logs/mapping/mapping_reader.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace touchdown::logs {

namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;
constexpr double turn = 360.0 * degree;
constexpr double standard_gravity = 9.80665;
constexpr double largest_zero = 1e6;  // rad, of an encoder that counts turns

/// Reads a single value or a list.
template <typename T>
KeyNotes one_or_more(Fields& fields, const std::string& key, std::vector<T>& values) {
  const YAML::Node given = fields.node()[key];
  if (given && given.IsSequence()) return fields(key, values);
  values.assign(1, T{});
  return fields(key, values.front());
}

double unit_of(Fields& fields, const std::vector<Unit>& units) {
  if (units.empty()) return 1.0;
  std::vector<std::string> names;
  for (const Unit& unit : units) names.push_back(unit.name);
  std::size_t index = 0;
  fields.choose("unit", names, index).doc("Unit of the log's numbers.");
  return units[index].size;
}

/// Lists the first few names of a log, for messages; those of a list's items once: "position[i]".
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 12;
  std::vector<std::string> shown;
  for (std::string name : names) {
    for (std::size_t at = 0; (at = name.find('[', at)) != std::string::npos; ++at) {
      const std::size_t end = std::min(name.find(']', at), name.size());
      if (end > at + 1 && std::all_of(name.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                                      name.begin() + static_cast<std::ptrdiff_t>(end),
                                      [](char c) { return c >= '0' && c <= '9'; })) {
        name.replace(at + 1, end - at - 1, "i");
      }
    }
    if (std::ranges::find(shown, name) == shown.end()) shown.push_back(std::move(name));
  }
  const bool has_more = shown.size() > most;
  if (has_more) shown.resize(most);
  return fmt::format(" (it has {}{})", fmt::join(shown, ", "), has_more ? ", …" : "");
}

/// Which columns of an array, or items of a list, a signal has: the first ones without `index`.
std::vector<int> index_of(Fields& fields, const SignalKind& kind, bool is_of_one) {
  std::vector<int> index;
  if (fields.present("index", false)) {
    one_or_more(fields, "index", index)
        .type("whole number or list of whole numbers")
        .range("≥ 0")
        .fallback("all of them")
        .doc(
            "Columns of an array with two axes in `.npz` files, or items of a message's list, "
            "from 0.");
    if (fields.documenting()) return {};
    fields.check(index.size() == kind.count, "index",
                 fmt::format("expected {} of the array's columns: {}", kind.count, kind.what));
    fields.check(std::all_of(index.begin(), index.end(), [](int i) { return i >= 0; }), "index",
                 "columns count from 0");
  } else if (is_of_one && kind.count > 1) {
    index.resize(kind.count);
    std::iota(index.begin(), index.end(), 0);
  }
  return index;
}

/// The column of an item of a list: "position[2]"; of "motor_state[].q", "motor_state[2].q".
std::string item_of(std::string list, int i) {
  const std::size_t at = list.find("[]");
  const std::string place = fmt::format("[{}]", i);
  return at == std::string::npos ? list + place : list.replace(at, 2, place);
}

}  // namespace

std::vector<Unit> angles() { return {{"rad", 1.0}, {"deg", degree}, {"rev", turn}}; }

std::vector<Unit> speeds() {
  return {{"rad/s", 1.0}, {"deg/s", degree}, {"rev/s", turn}, {"rpm", turn / 60.0}};
}

std::vector<Unit> turn_rates() { return {{"rad/s", 1.0}, {"deg/s", degree}}; }

std::vector<Unit> torques() { return {{"Nm", 1.0}, {"mNm", 1e-3}}; }

std::vector<Unit> accelerations() { return {{"m/s^2", 1.0}, {"g", standard_gravity}}; }

KeyNotes number_for_each(Fields& fields, const std::string& key, std::size_t count,
                         std::vector<double>& values) {
  if (!fields.given(key, false)) return {};
  const KeyNotes notes = one_or_more(fields, key, values);
  if (values.size() == 1) values.resize(count, values.front());
  fields.check(values.size() == count, key, fmt::format("expected a number, or {}", count));
  return notes.type(count == 1 ? "number" : fmt::format("number or list of {}", count));
}

KeyNotes sign_for_each(Fields& fields, std::size_t count, std::vector<double>& signs) {
  const KeyNotes notes =
      number_for_each(fields, "sign", count, signs).range("1 or -1").fallback("1");
  for (const double sign : signs) {
    fields.check(std::abs(sign) == 1.0, "sign", "expected 1 or -1");
  }
  return notes;
}

void MappingReader::enter(std::string_view section) {
  const bool has_own = std::any_of(sources_.begin(), sources_.end(),
                                   [&](const auto& source) { return source.section == section; });
  section_ = has_own || section.empty() ? section : "joints";
}

const SourceNames& MappingReader::names() const {
  std::size_t first = 0;
  while (!is_entered(first)) ++first;
  return sources_[first];
}

KeyNotes MappingReader::require(Fields& fields, std::string_view key, const SignalKind& kind,
                                MappedSignal& signal) {
  if (!kind.names.empty() && !fields.present(key, false)) {
    take_default(fields, key, kind, signal);
    return {};
  }
  if (kind.names.empty()) fields.require(key);
  return fields.within(key, [&](Fields& inner) { describe_signal(inner, kind, signal); });
}

KeyNotes MappingReader::optional(Fields& fields, std::string_view key, const SignalKind& kind,
                                 std::optional<MappedSignal>& signal) {
  if (!fields.present(key, false)) return {};
  MappedSignal& value = signal.emplace();
  return fields.within(key, [&](Fields& inner) { describe_signal(inner, kind, value); })
      .fallback("none");
}

void MappingReader::take_default(const Fields& fields, std::string_view key, const SignalKind& kind,
                                 MappedSignal& signal) {
  for (std::size_t i = 0; i < kind.names.size(); ++i) {
    const SourceColumn column{kind.names[i], {}, source_of(fields, key, kind.names[i])};
    signal.numbers.push_back(
        {take(fields, key, column), kind.signs.empty() ? 1.0 : kind.signs[i], 0.0});
  }
}

void MappingReader::describe_signal(Fields& fields, const SignalKind& kind, MappedSignal& signal) {
  const bool has_from = kind.names.empty() || fields.present("from", false);
  if (kind.names.empty()) fields.require("from");
  std::vector<SourceColumn> columns;
  if (has_from) {
    columns = columns_of(fields, kind);
  } else {
    for (const std::string& name : kind.names) {
      columns.push_back({name, {}, source_of(fields, "", name)});
    }
  }
  std::vector<double> sign;
  sign_for_each(fields, kind.count, sign).doc("Sign of all numbers, or of each.");
  if (sign.empty()) sign = kind.signs;
  std::vector<double> scale;
  number_for_each(fields, "scale", kind.count, scale)
      .range("above 0")
      .fallback("1")
      .doc("Factor of all numbers, or of each: a gear ratio, or a torque constant (N·m/A).");
  for (const double one : scale) {
    fields.check(std::isfinite(one) && one > 0.0, "scale",
                 "expected a number above 0; a reversed direction is a 'sign' of -1");
  }
  std::vector<double> zero;
  if (kind.has_zero) {
    number_for_each(fields, "zero", kind.count, zero)
        .doc("rad", "The log's position where touchdown's is zero.");
  }
  for (const double one : zero) {
    fields.check(std::abs(one) <= largest_zero, "zero",
                 fmt::format("expected an angle from -{0} to {0} rad", largest_zero));
  }
  signal.unit = unit_of(fields, kind.units);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    signal.numbers.push_back({take(fields, "from", columns[i]), sign.empty() ? 1.0 : sign[i],
                              zero.empty() ? 0.0 : zero[i]});
    if (!scale.empty()) signal.numbers.back().scale = scale[i];
  }
}

std::vector<SourceColumn> MappingReader::columns_of(Fields& fields, const SignalKind& kind) const {
  std::vector<std::string> from;
  one_or_more(fields, "from", from)
      .type(kind.count == 1 ? "text" : "text or list of texts")
      .doc(fmt::format("Columns or arrays: {}.", kind.what));
  const auto require_index = [&](std::size_t width) {
    fields.check(kind.count == 1 || width <= kind.count || fields.present("index", false), "from",
                 fmt::format("'{}' has {} numbers: expected `index` with {} of them, from 0: {}",
                             from.front(), width, kind.count, kind.what));
  };
  const auto is_item = [](const std::string& name) { return name.find('[') != std::string::npos; };
  const bool has_index = !names().are_arrays && fields.present("index", false) &&
                         std::ranges::any_of(names().names, is_item);
  fields.check(!has_index || from.size() == 1, "index", "expected one list in 'from'");
  if (!names().are_arrays && from.size() == 1 &&
      (has_index || (kind.count > 1 && is_there(item_of(from[0], 0))))) {
    const std::string list = from.front();
    std::size_t width = 0;
    while (is_there(item_of(list, static_cast<int>(width)))) ++width;
    require_index(width);
    from.clear();
    for (const int i : index_of(fields, kind, true)) from.push_back(item_of(list, i));
  }
  // The numbers of a signal can be columns of one array.
  const bool are_arrays = names().are_arrays;
  const bool is_of_one = are_arrays && from.size() == 1;
  if (is_of_one && names().shape) {
    const auto [rows, columns] = names().shape(from.front());
    const bool is_transposed = rows == kind.count && columns > kind.count;
    fields.check(kind.count == 1 || !is_transposed || fields.present("index", false), "from",
                 fmt::format("'{}' is {} × {}: expected N × {}, a row for each time: array.T "
                             "transposes it",
                             from.front(), rows, columns, kind.count));
    require_index(columns);
  }
  fields.check(
      is_of_one || from.size() == kind.count, "from",
      fmt::format(fmt::runtime(are_arrays ? "expected an array with two axes, or {} with one: {}"
                                          : "expected {} of the names of columns: {}"),
                  kind.count, kind.what));
  std::vector<int> index;
  if (are_arrays) index = index_of(fields, kind, is_of_one);
  std::vector<SourceColumn> columns;
  for (std::size_t i = 0; i < kind.count && !fields.documenting(); ++i) {
    const std::string& name = from[is_of_one ? 0 : i];
    columns.push_back({name, {}, source_of(fields, "from", name)});
    if (!index.empty()) columns.back().index = static_cast<std::size_t>(index[i]);
  }
  return columns;
}

bool MappingReader::is_there(const std::string& name) const {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (is_entered(i) && std::ranges::find(sources_[i].names, name) != sources_[i].names.end()) {
      return true;
    }
  }
  return false;
}

bool MappingReader::is_entered(std::size_t source) const {
  if (only_) return source == *only_;
  return section_.empty() || sources_[source].section.empty() ||
         sources_[source].section == section_;
}

std::size_t MappingReader::source_of(const Fields& fields, std::string_view key,
                                     const std::string& name) const {
  const char* what = names().are_arrays ? "array" : "column";
  std::optional<std::size_t> found;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (!is_entered(i)) continue;
    const SourceNames& source = sources_[i];
    const auto count = std::count(source.names.begin(), source.names.end(), name);
    fields.check(count < 2, key, fmt::format("{} has {} columns '{}'", source.file, count, name));
    fields.check(count == 0 || !found, key,
                 fmt::format("{} and {} have a column '{}'", sources_[found.value_or(0)].file,
                             source.file, name));
    if (count == 1) found = i;
    known.insert(known.end(), source.names.begin(), source.names.end());
  }
  if (found) return *found;  // a hint compares the name with every column
  std::string hint = did_you_mean(name, known);
  if (hint.empty()) hint = some_of(known);
  fields.check(false, key, fmt::format("{} has no {} '{}'{}", names().file, what, name, hint));
  return 0;
}

std::size_t MappingReader::take(const Fields& fields, std::string_view key,
                                const SourceColumn& column) {
  std::vector<SourceColumn>& columns = mapping_.columns;
  const bool is_new = std::find(columns.begin(), columns.end(), column) == columns.end();
  fields.check(is_new, key,
               fmt::format("'{}'{} is mapped already", column.name,
                           column.index ? fmt::format(" index {}", *column.index) : ""));
  columns.push_back(column);
  return columns.size() - 1;
}

}  // namespace touchdown::logs
