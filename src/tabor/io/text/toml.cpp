// The only file that knows toml++.
#include "tabor/io/text/toml.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <toml++/toml.h>
#include <sstream>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/likely_unit.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/value_range.hpp"
#include "tabor/io/files/atomic_file.hpp"

namespace tabor::io {

struct Config::Table {
  std::string name;
  std::string prefix;  ///< dotted path of this table in its file, "" at the top
  toml::table values;
};

namespace {

std::string kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "the text \"" + node.as_string()->get() + "\"";
    case toml::node_type::integer:
      return fmt::format("the number {}", node.as_integer()->get());
    case toml::node_type::floating_point:
      return fmt::format("the number {}", node.as_floating_point()->get());
    case toml::node_type::boolean:
      return node.as_boolean()->get() ? "true" : "false";
    default:
      return "a date or time";
  }
}

[[noreturn]] void wrong(const std::string& place, const toml::node& node,
                        const std::string& expected) {
  throw InputError(place, kind_of(node), expected, "");
}

double to_quantity(const toml::node& node, Dimension expected, const std::string& place,
                   std::string_view key) {
  if (const auto* text = node.as_string()) return parse_si(text->get(), expected, place);
  const auto number = node.value<double>();
  if (!number || node.is_boolean()) {
    wrong(place, node,
          "a number with a unit, such as \"" + example_value(place, expected).as_text() + "\"");
  }
  if (expected != dimension::none) {
    throw InputError(
        place, fmt::format("{} without a unit", *number), "a number with a unit",
        fmt::format("write {} = \"{}\"", split(key, '.').back(),
                    with_likely_unit(fmt::format("{}", *number), place, expected).as_text()));
  }
  return *number;
}

/// Collects "scan[].file" of every leaf with the node that holds it.
void collect_leaves(const toml::table& table, const std::string& prefix,
                    std::vector<std::pair<std::string, const toml::node*>>& leaves) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    if (const auto* inner = node.as_table()) {
      collect_leaves(*inner, path + ".", leaves);
    } else if (node.is_array_of_tables()) {
      for (const auto& element : *node.as_array()) {
        collect_leaves(*element.as_table(), path + "[].", leaves);
      }
    } else {
      leaves.emplace_back(path, &node);
    }
  }
}

/// toml++ descends once for each part of a dotted key, however many there are. Keys end with their
/// line, so that this keeps a forged one from exhausting the stack.
void check_lines(std::string_view text, const std::string& name) {
  constexpr std::size_t kMaxLength = 16384;
  for (int n = 1; !text.empty(); ++n) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    if (length > kMaxLength) {
      throw InputError(fmt::format("{}:{}", name, n), fmt::format("a line of {} bytes", length),
                       fmt::format("at most {}", kMaxLength), "break it");
    }
    text.remove_prefix(std::min(length + 1, text.size()));
  }
}

toml::table parse_table(std::string_view text, const std::string& name) {
  check_lines(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: {}", name, error.source().begin.line, error.description()));
  }
}

const toml::node& find(const toml::table& values, std::string_view key, const std::string& place) {
  const toml::node* node = values.at_path(key).node();
  if (node == nullptr) throw InputError(place + " is missing");
  return *node;
}

}  // namespace

Config::Config(std::shared_ptr<const Table> table) : table_(std::move(table)) {}

Config Config::read(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  if (text.find('\0') != std::string::npos) {
    throw InputError(
        file.string(), "a binary file", "text in TOML, KEY = VALUE on each line",
        "--template in place of the file prints an example; 'tabor report' draws a result");
  }
  return parse(text, file.string());
}

Config Config::parse(std::string_view text, const std::string& name) {
  return Config(std::make_shared<Table>(Table{name, "", parse_table(text, name)}));
}

const std::string& Config::name() const { return table_->name; }

bool Config::has(std::string_view key) const {
  return table_->values.at_path(key).node() != nullptr;
}

namespace {

/// "study.toml:7"; no line for what Config::with() added.
std::string place_of(const std::string& name, const toml::node* node) {
  const bool is_in_file = node != nullptr && node->source().begin.line > 0;
  return is_in_file ? fmt::format("{}:{}", name, node->source().begin.line) : name;
}

}  // namespace

std::string Config::place(std::string_view key) const {
  const toml::node* node = table_->values.at_path(key).node();
  return place_of(table_->name, node) + ": " + table_->prefix + std::string(key);
}

std::string Config::text(std::string_view key) const {
  const toml::node& node = find(table_->values, key, place(key));
  if (!node.is_string()) wrong(place(key), node, "text in quotes");
  return node.as_string()->get();
}

double Config::number(std::string_view key) const { return quantity(key, dimension::none); }

std::int64_t Config::integer(std::string_view key) const {
  const toml::node& node = find(table_->values, key, place(key));
  if (!node.is_integer()) {
    wrong(place(key), node, node.is_number() ? "a whole number in digits alone" : "a whole number");
  }
  return node.as_integer()->get();
}

bool Config::flag(std::string_view key) const {
  const toml::node& node = find(table_->values, key, place(key));
  if (!node.is_boolean()) wrong(place(key), node, "true or false");
  return node.as_boolean()->get();
}

std::vector<std::string> Config::texts(std::string_view key) const {
  const toml::node& node = find(table_->values, key, place(key));
  if (!node.is_array()) return {text(key)};
  std::vector<std::string> values;
  for (const auto& element : *node.as_array()) {
    if (!element.is_string()) wrong(place(key), element, "an array of texts in quotes");
    values.push_back(element.as_string()->get());
  }
  return values;
}

std::vector<std::string> Config::words(std::string_view key) const {
  const auto word_of = [&](const toml::node& node) {
    if (node.is_string()) return node.as_string()->get();
    if (!node.is_number()) wrong(place(key), node, "text in quotes or a number");
    return node.is_integer() ? fmt::format("{}", node.as_integer()->get())
                             : fmt::format("{}", node.as_floating_point()->get());
  };
  const toml::node& node = find(table_->values, key, place(key));
  if (!node.is_array()) return {word_of(node)};
  std::vector<std::string> all;
  for (const auto& element : *node.as_array()) all.push_back(word_of(element));
  if (all.empty()) throw InputError(place(key), "an empty array", "at least one value", "");
  return all;
}

double Config::quantity(std::string_view key, Dimension expected) const {
  return to_quantity(find(table_->values, key, place(key)), expected, place(key), key);
}

std::vector<double> Config::quantities(std::string_view key, Dimension expected) const {
  const toml::node& node = find(table_->values, key, place(key));
  std::vector<double> values;
  const auto add = [&](const toml::node& element) {
    const auto* text = element.as_string();
    if (text != nullptr && is_value_range(text->get())) {
      const std::vector<double> range = parse_si_list(text->get(), expected, place(key));
      values.insert(values.end(), range.begin(), range.end());
    } else {
      values.push_back(to_quantity(element, expected, place(key), key));
    }
  };
  if (!node.is_array()) {
    add(node);
    return values;
  }
  for (const auto& element : *node.as_array()) add(element);
  if (values.empty()) throw InputError(place(key), "an empty array", "at least one value", "");
  return values;
}

std::vector<Config> Config::tables(std::string_view key) const {
  const toml::node* node = table_->values.at_path(key).node();
  std::vector<Config> result;
  if (node == nullptr) return result;
  if (!node->is_array_of_tables()) {
    wrong(place(key), *node, fmt::format("tables that begin with [[{}]]", key));
  }
  for (const auto& element : *node->as_array()) {
    result.push_back(Config(std::make_shared<Table>(
        Table{table_->name, table_->prefix + std::string(key) + ".", *element.as_table()})));
  }
  return result;
}

std::vector<std::string> Config::keys() const {
  std::vector<std::pair<std::string, const toml::node*>> leaves;
  collect_leaves(table_->values, "", leaves);
  std::stable_sort(leaves.begin(), leaves.end(), [](const auto& a, const auto& b) {
    return a.second->source().begin < b.second->source().begin;
  });
  std::vector<std::string> paths;
  paths.reserve(leaves.size());
  for (const auto& [path, node] : leaves) paths.push_back(path);
  return paths;
}

namespace {

std::string last_part(const std::string& path) { return split(path, '.').back(); }

/// A known key whose last part is that of `path`, or holds it or is held by it; in the same table
/// rather than in another; or the first key of a table of this name. Empty if there is none.
std::string namesake(const std::string& path, const std::vector<std::string>& known) {
  const std::string name = last_part(path);
  const std::string table = path.substr(0, path.size() - name.size());
  std::string best;
  int best_rank = 0;
  for (const std::string& key : known) {
    const std::string other = last_part(key);
    const bool holds =
        std::min(name.size(), other.size()) > 2 &&
        (other.find(name) != std::string::npos || name.find(other) != std::string::npos);
    const bool is_beside = !table.empty() && key.starts_with(table);
    const bool is_in_table = key.starts_with(name + ".");
    const int rank = other == name ? 3 : holds ? (is_beside ? 2 : 1) : is_in_table ? 1 : 0;
    if (rank > best_rank) {
      best = key;
      best_rank = rank;
    }
  }
  return best;
}

/// "; did you mean ...?", by letters or, where that finds nothing, by name.
std::string key_suggestion(const std::string& path, const std::vector<std::string>& known) {
  std::string near = suggestion(path, known);
  if (!near.empty()) return near;
  const std::string other = namesake(path, known);
  return other.empty() ? "" : "; did you mean '" + other + "'?";
}

}  // namespace

void Config::reject_unknown(const std::vector<std::string>& known) const {
  std::vector<std::pair<std::string, const toml::node*>> leaves;
  collect_leaves(table_->values, "", leaves);
  for (const auto& [path, node] : leaves) {
    if (std::find(known.begin(), known.end(), path) == known.end()) {
      throw InputError(fmt::format("{}: unknown key '{}{}'{}", place_of(table_->name, node),
                                   table_->prefix, path, key_suggestion(path, known)));
    }
  }
}

std::string Config::to_text() const {
  std::ostringstream stream;
  stream << table_->values;
  return stream.str();
}

Config Config::with(std::string_view key, std::string_view value) const {
  auto changed = std::make_shared<Table>(*table_);
  std::vector<std::string> steps = split(key, '.');
  toml::table* table = &changed->values;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    table->insert(steps[i], toml::table{});
    table = (*table)[steps[i]].as_table();
    if (table == nullptr) {
      const toml::node* node = changed->values.get(steps[i]);
      throw InputError(place(key) + ": '" + steps[i] +
                       (node != nullptr && node->is_array()
                            ? "' is a list of tables, which only the file can change"
                            : "' is a value, not a table"));
    }
  }
  try {
    toml::table parsed = toml::parse("value = " + std::string(value));
    table->insert_or_assign(steps.back(), *parsed["value"].node());
  } catch (const toml::parse_error&) {
    table->insert_or_assign(steps.back(), std::string(value));
  }
  return Config(std::move(changed));
}

}  // namespace tabor::io
