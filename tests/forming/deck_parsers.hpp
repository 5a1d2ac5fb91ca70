#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tabor/core/text.hpp"

// Readers of decks that take nothing but what the manuals describe: cards in their order, numbers
// in their columns, no line that is too long. A failure is reported by the test framework.
namespace tabor::test {

/// One number of a deck, in its units; NaN where the format has no such column.
struct DeckNumber {
  double pressure = 0;
  double density = std::nan("");
  double speed = std::nan("");
  double friction = 0;
};

/// Lines without comments; every line, comments too, within `width` columns and printable.
inline std::vector<std::string> cards_of(const std::string& deck, const std::string& mark,
                                         std::size_t width) {
  std::vector<std::string> cards;
  EXPECT_TRUE(deck.ends_with('\n'));
  for (const std::string& line : split(deck.substr(0, deck.size() - 1), '\n')) {
    EXPECT_LE(line.size(), width) << line;
    EXPECT_FALSE(trim(line).empty());
    for (const char c : line) EXPECT_GE(static_cast<unsigned char>(c), 32) << line;
    if (!line.starts_with(mark)) cards.push_back(line);
  }
  return cards;
}

/// A number that fills its field and nothing else; the field is `width` wide.
inline double field_at(const std::string& line, std::size_t begin, std::size_t width) {
  EXPECT_GE(line.size(), begin + width) << line;
  if (line.size() < begin + width) return std::nan("");
  const auto number = parse_number(trim(std::string_view(line).substr(begin, width)));
  EXPECT_TRUE(number) << line;
  return number.value_or(std::nan(""));
}

/// *SURFACE INTERACTION, *FRICTION, and rows "mu, slip rate, pressure[, temperature, field]": the
/// field varies slowest, then the pressure, then the slip rate, each rising.
inline std::vector<DeckNumber> parse_abaqus(const std::string& deck) {
  std::vector<DeckNumber> numbers;
  const std::vector<std::string> cards = cards_of(deck, "**", 256);
  EXPECT_GE(cards.size(), 4u);
  if (cards.size() < 4) return numbers;
  const std::string interaction = "*SURFACE INTERACTION, NAME=";
  EXPECT_TRUE(cards[0].starts_with(interaction)) << cards[0];
  const std::string name = cards[0].substr(interaction.size());
  EXPECT_FALSE(name.empty() || name.size() > 80) << name;
  EXPECT_EQ(name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_"), std::string::npos);
  const bool has_field = cards[1] == "*FRICTION, DEPENDENCIES=1";
  EXPECT_TRUE(has_field || cards[1] == "*FRICTION") << cards[1];
  const auto item = [](const std::string& text) {
    EXPECT_LE(trim(text).size(), 20u) << text;  // what Abaqus reads of an item
    return trim(text).empty() ? std::nan("") : parse_number(trim(text)).value();
  };
  std::vector<double> last;
  for (std::size_t i = 2; i < cards.size(); ++i) {
    const std::vector<std::string> items = split(cards[i], ',');
    EXPECT_EQ(items.size(), has_field ? 5u : 3u) << cards[i];
    DeckNumber number{item(items.at(2)), has_field ? item(items.at(4)) : std::nan(""),
                      item(items.at(1)), item(items.at(0))};
    EXPECT_TRUE(!has_field || trim(items[3]).empty()) << "no temperature: " << cards[i];
    const std::vector<double> place{has_field ? number.density : 0, number.pressure,
                                    std::isnan(number.speed) ? 0 : number.speed};
    EXPECT_LT(last, place) << cards[i];
    last = place;
    numbers.push_back(number);
  }
  return numbers;
}

/// One *DEFINE_TABLE with its curves.
struct LsdynaTable {
  int id = 0;
  std::vector<DeckNumber> numbers;
};

/// *KEYWORD, then for each table its number in 10 columns, its rising values in 20, and at once one
/// *DEFINE_CURVE for each value: number in 10 columns, two or more points of 20 columns each,
/// rising and the same for all curves of a table; *END. All numbers of tables and curves differ.
inline std::vector<LsdynaTable> parse_lsdyna(const std::string& deck) {
  std::vector<LsdynaTable> tables;
  const std::vector<std::string> cards = cards_of(deck, "$", 80);
  std::size_t i = 0;
  std::set<int> ids;
  const auto next = [&] { return i < cards.size() ? cards[i++] : std::string("*END"); };
  const auto id_of = [&](const std::string& line) {
    EXPECT_EQ(line.size(), 10u) << line;
    const int id = static_cast<int>(field_at(line, 0, 10));
    EXPECT_TRUE(ids.insert(id).second) << line;
    return id;
  };
  const auto is_data = [&] { return i < cards.size() && !cards[i].starts_with('*'); };
  EXPECT_EQ(next(), "*KEYWORD");
  std::string card = next();
  while (card == "*DEFINE_TABLE") {
    LsdynaTable table{id_of(next()), {}};
    std::vector<double> pressures;
    while (is_data()) {
      EXPECT_EQ(cards[i].size(), 20u) << cards[i];
      const double value = field_at(next(), 0, 20);
      EXPECT_TRUE(pressures.empty() || value > pressures.back());
      pressures.push_back(value);
    }
    EXPECT_GE(pressures.size(), 2u);
    std::vector<double> first_speeds;
    for (const double pressure : pressures) {
      EXPECT_EQ(next(), "*DEFINE_CURVE");
      id_of(next());
      std::vector<double> speeds;
      while (is_data()) {
        EXPECT_EQ(cards[i].size(), 40u) << cards[i];
        const std::string line = next();
        EXPECT_TRUE(speeds.empty() || field_at(line, 0, 20) > speeds.back()) << line;
        speeds.push_back(field_at(line, 0, 20));
        table.numbers.push_back({pressure, std::nan(""), speeds.back(), field_at(line, 20, 20)});
      }
      EXPECT_GE(speeds.size(), 2u);
      if (first_speeds.empty()) first_speeds = speeds;
      EXPECT_EQ(speeds, first_speeds);
    }
    tables.push_back(table);
    card = next();
  }
  EXPECT_EQ(card, "*END");
  EXPECT_EQ(i, cards.size());
  return tables;
}

/// Materials in the order of the deck, each with its numbers.
using AnsysMaterials = std::vector<std::pair<int, std::vector<DeckNumber>>>;

/// TB,FRIC,mat,,,ISO; TBFIELD,NPRES rising; below each TBFIELD,SLRV rising, or none; a TBDATA,1 for
/// each place.
inline AnsysMaterials parse_ansys(const std::string& deck) {
  AnsysMaterials materials;
  double pressure = std::nan("");
  double speed = std::nan("");
  bool is_filled = true;
  for (const std::string& line : cards_of(deck, "!", 128)) {
    const std::vector<std::string> words = split(line, ',');
    const auto value = [&] { return parse_number(words.back()).value_or(std::nan("")); };
    if (words[0] == "TB") {
      EXPECT_EQ(words.size(), 6u) << line;
      EXPECT_EQ(words[1] + words[3] + words[4] + words[5], "FRICISO") << line;
      materials.push_back({static_cast<int>(parse_number(words[2]).value()), {}});
      pressure = speed = std::nan("");
    } else if (words[0] == "TBFIELD" && words.size() == 3 && words[1] == "NPRES") {
      EXPECT_TRUE(is_filled && !(value() <= pressure)) << line;
      pressure = value();
      speed = std::nan("");
      is_filled = false;
    } else if (words[0] == "TBFIELD" && words.size() == 3 && words[1] == "SLRV") {
      EXPECT_FALSE(value() <= speed) << line;
      speed = value();
      is_filled = false;
    } else {
      EXPECT_TRUE(line.starts_with("TBDATA,1,") && words.size() == 3 && !is_filled) << line;
      EXPECT_FALSE(materials.empty());
      if (!materials.empty()) {
        materials.back().second.push_back({pressure, std::nan(""), speed, value()});
      }
      is_filled = true;
    }
  }
  EXPECT_TRUE(is_filled);
  return materials;
}

/// One /FRICTION card.
struct RadiossCard {
  int id = 0;
  double c1 = 0, c2 = 0, c3 = 0, c4 = 0, c5 = 0, c6 = 0, constant = 0;

  double friction(double pressure, double speed) const {
    return constant + c1 * std::exp(c2 * speed) * pressure * pressure +
           c3 * std::exp(c4 * speed) * pressure + c5 * std::exp(c6 * speed);
  }
};

/// /FRICTION/id, a title, Ifric = 2 in ten columns, C1 to C5 and C6, Fric, VIS_F in 20 columns
/// each.
inline std::vector<RadiossCard> parse_openradioss(const std::string& deck) {
  std::vector<RadiossCard> all;
  const std::vector<std::string> cards = cards_of(deck, "#", 100);
  EXPECT_EQ(cards.size() % 5, 0u);
  for (std::size_t i = 0; i + 4 < cards.size(); i += 5) {
    EXPECT_TRUE(cards[i].starts_with("/FRICTION/")) << cards[i];
    RadiossCard card;
    card.id = static_cast<int>(parse_number(cards[i].substr(10)).value());
    EXPECT_FALSE(cards[i + 1].starts_with('/'));
    EXPECT_EQ(cards[i + 2].size(), 50u);
    EXPECT_EQ(field_at(cards[i + 2], 0, 10), 2);
    for (const auto& [begin, width] : {std::pair{10, 10}, {20, 20}, {40, 10}}) {
      EXPECT_EQ(field_at(cards[i + 2], begin, width), 0);
    }
    EXPECT_EQ(cards[i + 3].size(), 100u);
    EXPECT_EQ(cards[i + 4].size(), 60u);
    std::size_t at = 0;
    for (double* value : {&card.c1, &card.c2, &card.c3, &card.c4, &card.c5}) {
      *value = field_at(cards[i + 3], at, 20);
      at += 20;
    }
    card.c6 = field_at(cards[i + 4], 0, 20);
    card.constant = field_at(cards[i + 4], 20, 20);
    EXPECT_EQ(field_at(cards[i + 4], 40, 20), 0);
    all.push_back(card);
  }
  return all;
}

}  // namespace tabor::test
