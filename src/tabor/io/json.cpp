#include "tabor/io/json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "tabor/core/error.hpp"
#include "tabor/io/atomic_file.hpp"

namespace tabor::io {

namespace {

using Library = nlohmann::ordered_json;

template <typename Wanted, typename Variant>
auto& as(Variant& value, const char* expected) {
  auto* held = std::get_if<Wanted>(&value);
  if (!held) throw Json::exception(std::string("JSON: expected ") + expected);
  return *held;
}

bool is_member(const Json& json) {
  return json.is_array() && json.size() == 2 && json[0].is_string();
}

Json::Member member_of(const Json& pair) { return {pair[0].get<std::string>(), pair[1]}; }

/// Builds a value while the library reads: of any depth, without recursion.
class Reader final : public nlohmann::json_sax<Library> {
 public:
  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(std::int64_t value) override { return put(value); }
  bool number_unsigned(std::uint64_t value) override { return put(value); }
  bool number_float(double value, const std::string&) override { return put(value); }
  bool string(std::string& value) override { return put(std::move(value)); }
  bool binary(Library::binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(std::string& name) override {
    key_ = std::move(name);
    return true;
  }
  bool parse_error(std::size_t byte, const std::string&,
                   const nlohmann::detail::exception& error) override {
    constexpr int kBeyondDoubles = 406;
    mistake_ = error.id == kBeyondDoubles ? "holds a number beyond the range of doubles"
                                          : "not JSON at byte " + std::to_string(byte);
    return false;
  }

  Json root() && { return std::move(root_); }
  const std::string& mistake() const { return mistake_; }

 private:
  Json& place(Json value) {
    if (open_.empty()) return root_ = std::move(value);
    Json& parent = *open_.back();
    if (parent.is_object()) return parent[key_] = std::move(value);
    parent.push_back(std::move(value));
    return parent.back();
  }
  bool put(Json value) {
    place(std::move(value));
    return true;
  }
  bool open(Json empty) {
    open_.push_back(&place(std::move(empty)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  Json root_;
  std::vector<Json*> open_;  // only the last one grows, so that the others stay where they are
  std::string key_;
  std::string mistake_;
};

Library to_library(const Json& json) {
  if (json.is_object()) {
    Library object = Library::object();
    for (const auto& [key, value] : json.items()) object[key] = to_library(value);
    return object;
  }
  if (json.is_array()) {
    Library array = Library::array();
    for (const Json& element : json) array.push_back(to_library(element));
    return array;
  }
  if (json.is_string()) return json.get<std::string>();
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_float()) return json.get<double>();
  if (!json.is_number()) return nullptr;
  // Two's complement keeps what is above the largest signed integer.
  const auto bits = json.get<std::int64_t>();
  return json == Json(bits) ? Library(bits) : Library(static_cast<std::uint64_t>(bits));
}

}  // namespace

Json::Json() noexcept = default;
Json::Json(const char* text) : value_(std::string(text)) {}
Json::Json(std::string_view text) : value_(std::string(text)) {}
Json::Json(std::string text) : value_(std::move(text)) {}
Json::Json(std::initializer_list<Json> elements)
    : Json(std::all_of(elements.begin(), elements.end(), is_member) ? object(elements)
                                                                    : array(elements)) {}
Json::Json(const Json& other) = default;
Json& Json::operator=(const Json& other) = default;

// What is moved from is null.
Json::Json(Json&& other) noexcept : value_(std::exchange(other.value_, nullptr)) {}

Json& Json::operator=(Json&& other) noexcept {
  std::swap(value_, other.value_);
  return *this;
}

Json::~Json() {
  // A value nested a million deep would need as many calls of destructors: its parts are ended one
  // by one.
  Array parts;
  const auto take = [&parts](Json& json) {
    if (auto* array = std::get_if<Array>(&json.value_)) {
      std::move(array->begin(), array->end(), std::back_inserter(parts));
      array->clear();
    } else if (auto* object = std::get_if<Object>(&json.value_)) {
      for (Member& member : *object) parts.push_back(std::move(member.second));
      object->clear();
    }
  };
  take(*this);
  while (!parts.empty()) {
    Json last = std::move(parts.back());
    parts.pop_back();
    take(last);
  }
}

Json Json::array(std::initializer_list<Json> elements) {
  Json json;
  json.value_ = Array(elements);
  return json;
}

Json Json::object(std::initializer_list<Json> members) {
  Json json;
  json.value_ = Object();
  for (const Json& member : members) {
    if (!is_member(member)) throw exception("JSON: expected pairs of a key and a value");
    auto [key, value] = member_of(member);
    json[key] = std::move(value);
  }
  return json;
}

Json Json::parse(std::string_view text) {
  Reader reader;
  if (!Library::sax_parse(text, &reader)) throw exception(reader.mistake());
  return std::move(reader).root();
}

bool Json::is_null() const { return std::holds_alternative<std::nullptr_t>(value_); }
bool Json::is_boolean() const { return std::holds_alternative<bool>(value_); }
bool Json::is_number() const { return is_number_integer() || is_number_float(); }
bool Json::is_number_integer() const {
  return std::holds_alternative<std::int64_t>(value_) ||
         std::holds_alternative<std::uint64_t>(value_);
}
bool Json::is_number_float() const { return std::holds_alternative<double>(value_); }
bool Json::is_string() const { return std::holds_alternative<std::string>(value_); }
bool Json::is_array() const { return std::holds_alternative<Array>(value_); }
bool Json::is_object() const { return std::holds_alternative<Object>(value_); }

std::size_t Json::size() const {
  if (const auto* array = std::get_if<Array>(&value_)) return array->size();
  if (const auto* object = std::get_if<Object>(&value_)) return object->size();
  return is_null() ? 0 : 1;
}

const Json* Json::find(std::string_view key) const {
  const auto* object = std::get_if<Object>(&value_);
  if (!object) return nullptr;
  const auto member = std::find_if(object->begin(), object->end(),
                                   [key](const Member& one) { return one.first == key; });
  return member == object->end() ? nullptr : &member->second;
}

Json& Json::operator[](std::string_view key) {
  if (is_null()) value_ = Object();
  if (const Json* member = find(key)) return const_cast<Json&>(*member);
  return as<Object>(value_, "an object").emplace_back(key, Json()).second;
}

const Json& Json::at(std::string_view key) const {
  const Json* member = find(key);
  if (!member) throw exception("JSON: no key '" + std::string(key) + "'");
  return *member;
}

Json& Json::at(std::string_view key) { return const_cast<Json&>(std::as_const(*this).at(key)); }

Json& Json::element(std::size_t index) {
  auto& array = as<Array>(value_, "an array");
  if (index >= array.size()) throw exception("JSON: no element " + std::to_string(index));
  return array[index];
}

const Json::Object& Json::items() const {
  static const Object none;
  return is_null() ? none : as<Object>(value_, "an object");
}

void Json::update(const Json& object) {
  if (is_null()) value_ = Object();
  for (const auto& [key, value] : object.items()) (*this)[key] = value;
}

void Json::erase(std::string_view key) {
  std::erase_if(as<Object>(value_, "an object"),
                [key](const Member& member) { return member.first == key; });
}

void Json::push_back(Json element) {
  if (is_null()) value_ = Array();
  as<Array>(value_, "an array").push_back(std::move(element));
}

Json& Json::back() { return element(size() - 1); }

Json::Array& Json::elements() {
  static Array none;
  return is_null() ? none : as<Array>(value_, "an array");
}

bool Json::as_bool() const { return as<bool>(value_, "true or false"); }

std::int64_t Json::as_integer() const {
  if (const auto* integer = std::get_if<std::int64_t>(&value_)) return *integer;
  if (const auto* integer = std::get_if<std::uint64_t>(&value_)) {
    return static_cast<std::int64_t>(*integer);
  }
  return static_cast<std::int64_t>(as_double());
}

double Json::as_double() const {
  if (const auto* integer = std::get_if<std::int64_t>(&value_)) {
    return static_cast<double>(*integer);
  }
  if (const auto* integer = std::get_if<std::uint64_t>(&value_)) {
    return static_cast<double>(*integer);
  }
  return as<double>(value_, "a number");
}

const std::string& Json::as_text() const { return as<std::string>(value_, "a text"); }

bool operator==(const Json& a, const Json& b) {
  if (a.value_.index() == b.value_.index()) return a.value_ == b.value_;
  if (!a.is_number() || !b.is_number()) return false;
  if (a.is_number_float() || b.is_number_float()) return a.as_double() == b.as_double();
  // Of two kinds of integers: equal bits, unless one is negative and the other too large for its
  // sign.
  return a.as_integer() == b.as_integer() && a.as_integer() >= 0;
}

std::ostream& operator<<(std::ostream& stream, const Json& json) {
  return stream << to_text(json, -1);
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string to_text(const Json& json, int indent) {
  return to_library(json).dump(indent, ' ', false, Library::error_handler_t::replace);
}

Json read_json(const std::filesystem::path& file) {
  try {
    return Json::parse(read_text(file));
  } catch (const Json::exception& error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

}  // namespace tabor::io
