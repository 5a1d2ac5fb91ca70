#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <iosfwd>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

// Represents JSON values, parses them and writes them.
namespace tabor::io {

/// JSON value: null, truth value, integer, number, text, list, or object whose keys keep the order
/// they were given in. It is made from plain values and from braces: a list whose elements all are
/// {text, value} is an object, any other an array.
///
/// An access that does not fit (a key of a text, the text of a number) throws Json::exception.
class Json {
 public:
  struct exception : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  using Array = std::vector<Json>;
  using value_type = Json;  // of an array's elements, as of any container
  using const_iterator = Array::const_iterator;
  using Member = std::pair<std::string, Json>;
  using Object = std::vector<Member>;

  Json() noexcept;
  Json(std::nullptr_t) noexcept : Json() {}
  template <std::same_as<bool> T>
  Json(T value) : value_(value) {}
  template <std::signed_integral T>
  Json(T value) : value_(std::int64_t{value}) {}
  template <std::unsigned_integral T>
  requires(!std::same_as<T, bool>) Json(T value) : value_(std::uint64_t{value}) {}
  template <std::floating_point T>
  Json(T value) : value_(static_cast<double>(value)) {}
  Json(const char* text);
  Json(std::string_view text);
  Json(std::string text);
  template <typename T>
  Json(const std::vector<T>& list) : value_(Array(list.begin(), list.end())) {}
  template <typename T>
  Json(const std::map<std::string, T>& members) : value_(Object(members.begin(), members.end())) {}
  Json(std::initializer_list<Json> elements);

  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(const Json& other);
  Json& operator=(Json&& other) noexcept;
  ~Json();

  static Json array(std::initializer_list<Json> elements = {});
  static Json object(std::initializer_list<Json> members = {});
  /// Parses a text. Throws exception with the place of the mistake.
  static Json parse(std::string_view text);

  bool is_null() const;
  bool is_boolean() const;
  bool is_number() const;          ///< an integer, too
  bool is_number_integer() const;  ///< written without point and exponent
  bool is_number_float() const;
  bool is_string() const;
  bool is_array() const;
  bool is_object() const;

  /// Returns the value as T: bool, a number, std::string, Json, or std::vector of these. Numbers
  /// are converted.
  template <typename T>
  T get() const;

  std::size_t size() const;  ///< of elements or members; 0 of null, 1 of a plain value
  bool empty() const { return size() == 0; }

  /// Returns the member of this key. An absent one is added as null; null becomes an object.
  Json& operator[](std::string_view key);
  const Json& operator[](std::string_view key) const { return at(key); }
  template <std::integral T>
  Json& operator[](T index) {
    return at(index);
  }
  template <std::integral T>
  const Json& operator[](T index) const {
    return at(index);
  }
  Json& at(std::string_view key);
  const Json& at(std::string_view key) const;
  template <std::integral T>
  Json& at(T index) {
    return element(static_cast<std::size_t>(index));
  }
  template <std::integral T>
  const Json& at(T index) const {
    return const_cast<Json*>(this)->element(static_cast<std::size_t>(index));
  }
  bool contains(std::string_view key) const { return find(key) != nullptr; }
  const Json* find(std::string_view key) const;  ///< null if absent, or if this is no object
  template <typename T>
  T value(std::string_view key, T otherwise) const {
    const Json* member = find(key);
    return member ? member->get<T>() : otherwise;
  }
  /// Returns the members in their order: for (const auto& [key, value] : object.items()).
  const Object& items() const;  ///< of null: none
  /// Takes over the members of an object; those that are there already keep their place.
  void update(const Json& object);
  void erase(std::string_view key);

  void push_back(Json element);  ///< null becomes an array
  Json& back();
  const Json& back() const { return const_cast<Json*>(this)->back(); }
  Array::iterator begin() { return elements().begin(); }  ///< of the elements of an array
  Array::iterator end() { return elements().end(); }
  Array::const_iterator begin() const { return const_cast<Json*>(this)->elements().begin(); }
  Array::const_iterator end() const { return const_cast<Json*>(this)->elements().end(); }

  /// Integers and other numbers are equal if their values are.
  friend bool operator==(const Json& a, const Json& b);
  /// Compares numbers; anything else throws exception.
  friend std::partial_ordering operator<=>(const Json& a, const Json& b) {
    return a.as_double() <=> b.as_double();
  }
  /// Writes the value on one line.
  friend std::ostream& operator<<(std::ostream& stream, const Json& json);

 private:
  Json& element(std::size_t index);
  Array& elements();
  bool as_bool() const;
  std::int64_t as_integer() const;  ///< of a number that is none: without what follows its point
  double as_double() const;
  const std::string& as_text() const;

  std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string, Array,
               Object>
      value_;
};

template <typename T>
T Json::get() const {
  if constexpr (std::same_as<T, Json>) {
    return *this;
  } else if constexpr (std::same_as<T, bool>) {
    return as_bool();
  } else if constexpr (std::integral<T>) {
    return static_cast<T>(as_integer());
  } else if constexpr (std::floating_point<T>) {
    return static_cast<T>(as_double());
  } else if constexpr (std::same_as<T, std::string>) {
    return as_text();
  } else {
    T list;
    for (const Json& element : *this) list.push_back(element.get<typename T::value_type>());
    return list;
  }
}

/// Returns a number as JSON; NaN and infinity, which JSON has not, become null.
Json number(double value);

/// Returns the value as text; bytes that are not UTF-8 (a file name may hold anything) are
/// replaced. indent < 0 gives one line.
std::string to_text(const Json& json, int indent = 2);

/// Parses a file. Throws InputError with the place of the mistake.
Json read_json(const std::filesystem::path& file);

}  // namespace tabor::io
