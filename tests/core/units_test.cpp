#include "tabor/core/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "support/rejection.hpp"
#include "tabor/core/error.hpp"

namespace tabor {
namespace {

using test::rejection;
using testing::HasSubstr;

TEST(ParseQuantity, TurnsUnitsIntoSi) {
  EXPECT_DOUBLE_EQ(parse_si("7 MPa", dimension::pressure, "--pressure"), 7e6);
  EXPECT_DOUBLE_EQ(parse_si("7MPa", dimension::pressure, "--pressure"), 7e6);
  EXPECT_DOUBLE_EQ(parse_si("0.45 g/m^2", dimension::areal_density, "--density"), 0.45e-3);
  EXPECT_DOUBLE_EQ(parse_si("0.45g/m2", dimension::areal_density, "--density"), 0.45e-3);
  EXPECT_DOUBLE_EQ(parse_si("900 kg/m³", dimension::density, "--oil-density"), 900);
  EXPECT_DOUBLE_EQ(parse_si("0.1 Pa s", dimension::viscosity, "viscosity"), 0.1);
  EXPECT_DOUBLE_EQ(parse_si("0.1Pa*s", dimension::viscosity, "viscosity"), 0.1);
  EXPECT_DOUBLE_EQ(parse_si("1.522e-8 1/Pa", dimension::per_pressure, "alpha"), 1.522e-8);
  EXPECT_DOUBLE_EQ(parse_si("1 N/mm^2", dimension::pressure, "--pressure"), 1e6);
  EXPECT_DOUBLE_EQ(parse_si("0.33", dimension::none, "--poisson-ratio"), 0.33);
}

TEST(ParseQuantity, KnowsTheMicroSignInAllItsEncodings) {
  for (const char* text : {"3um", "3µm", "3\u03bcm", "3\xb5m"}) {
    EXPECT_DOUBLE_EQ(parse_si(text, dimension::length, "--pixel"), 3e-6) << text;
  }
}

TEST(ParseQuantity, TakesProductsAndPowersAsOtherProgramsWriteThem) {
  for (const char* text : {"225 mPa s", "225 mPa*s", "225 mPa·s", "225 mPa\u22c5s", "225mPa.s",
                           "225 millipascal * second", "0.225 N.s/m²", "0.225 kg m⁻¹ s⁻¹",
                           "0.225 kg.m-1.s-1", "0.225 kilogram / meter / second"}) {
    EXPECT_DOUBLE_EQ(parse_si(text, dimension::viscosity, "viscosity"), 0.225) << text;
  }
  for (const char* text : {"0.45 g/m**2", "0.45 g / m ** 2", "0.45 gram / meter ** 2", "0.45g.m-2",
                           "0.45 g·m⁻²", "0.45 g/m²"}) {
    EXPECT_DOUBLE_EQ(parse_si(text, dimension::areal_density, "--density"), 0.45e-3) << text;
  }
  EXPECT_DOUBLE_EQ(parse_si("1.5e-08 / pascal", dimension::per_pressure, "alpha"), 1.5e-8);
  EXPECT_DOUBLE_EQ(parse_si("0.33 dimensionless", dimension::none, "ratio"), 0.33);
}

TEST(ParseQuantity, TakesUnitsInWords) {
  for (const char* text : {"3 micrometer", "3 micrometers", "3 Micrometres", "3 micron",
                           "3 microns", "3e3 nanometre", "3e-6 meters", "3e4 angstrom"}) {
    EXPECT_DOUBLE_EQ(parse_si(text, dimension::length, "--pixel"), 3e-6) << text;
  }
  EXPECT_DOUBLE_EQ(parse_si("7 megapascals", dimension::pressure, "--pressure"), 7e6);
  EXPECT_DOUBLE_EQ(parse_si("2 pound_force_per_square_inch", dimension::pressure, "--pressure"),
                   parse_si("2 psi", dimension::pressure, "--pressure"));
  for (const char* text : {"3 micro", "3 meterss", "3 mmeter", "3 micrometer s.", "3 m..m", "3 .m",
                           "3 m***2", "3 m^0.5"}) {
    EXPECT_THROW(parse_si(text, dimension::length, "--pixel"), InputError) << text;
  }
}

TEST(ParseQuantity, NamesTheCorrectedFormWhenTheUnitIsMissing) {
  EXPECT_THAT(rejection([] { parse_si("7", dimension::pressure, "--pressure"); }),
              HasSubstr("--pressure 7MPa"));
}

TEST(ParseQuantity, RejectsUnitsOfAnotherDimension) {
  EXPECT_THAT(rejection([] { parse_si("7 um", dimension::pressure, "--pressure"); }),
              HasSubstr("MPa"));
}

TEST(ParseQuantity, NamesTheUnknownUnit) {
  EXPECT_THAT(rejection([] { parse_si("7 Mpa", dimension::pressure, "--pressure"); }),
              HasSubstr("'Mpa'"));
}

TEST(ParseQuantity, ProposesTheUnitThatIsNearlyWritten) {
  const auto proposal = [](const std::string& text, Dimension expected, const std::string& name) {
    return rejection([&] { parse_si(text, expected, name); });
  };
  for (const auto& [text, unit] :
       std::vector<std::pair<std::string, std::string>>{{"7Mpa", "'MPa'"},
                                                        {"7 mpa", "'MPa'"},
                                                        {"7 MPA", "'MPa'"},
                                                        {"70 gpa", "'GPa'"},
                                                        {"7 Bar", "'bar'"}}) {
    EXPECT_THAT(proposal(text, dimension::pressure, "--pressure"),
                HasSubstr("did you mean " + unit + "?"))
        << text;
  }
  for (const auto& [text, unit] :
       std::vector<std::pair<std::string, std::string>>{{"2 UM", "'um'"}, {"2 Nm^1", "'nm^1'"}}) {
    EXPECT_THAT(proposal(text, dimension::length, "--pixel"),
                HasSubstr("did you mean " + unit + "?"))
        << text;
  }
  EXPECT_THAT(proposal("1 KG/m^3", dimension::density, "--oil-density"),
              HasSubstr("did you mean 'kg'?"));
  EXPECT_THAT(proposal("1 furlong", dimension::length, "--pixel"),
              testing::Not(HasSubstr("did you mean")));
}

TEST(ParseQuantity, SaysHowToWriteADecimalComma) {
  for (const char* text : {"0,5um", "0,5 um", "-0,5um", "0,5e0um"}) {
    std::string pointed = text;
    pointed[pointed.find(',')] = '.';
    EXPECT_THAT(rejection([&] { parse_si(text, dimension::length, "--tip-radius"); }),
                HasSubstr("write " + pointed))
        << text;
  }
  EXPECT_THAT(rejection([] { parse_si("0,33", dimension::none, "--poisson-ratio"); }),
              HasSubstr("write 0.33"));
  EXPECT_THAT(rejection([] { parse_si_list("0,5um", dimension::length, "--pixel"); }),
              HasSubstr("'0,5um'; expected a decimal point"));
  EXPECT_THAT(rejection([] { parse_si_list("2MPa,7,5MPa", dimension::pressure, "--pressure"); }),
              HasSubstr("write 7.5MPa"));
}

TEST(ParseQuantity, RejectsPowersThatMeanNothing) {
  EXPECT_DOUBLE_EQ(parse_si("1 m^9/m8", dimension::length, "--pixel"), 1);
  EXPECT_THAT(rejection([] { parse_si("1 m^10/m^9", dimension::length, "--pixel"); }),
              HasSubstr("'m^10'"));
  EXPECT_FALSE(unit_factor("l1350808505", dimension::length).has_value());
  EXPECT_FALSE(unit_factor("l-2147483648", dimension::length).has_value());
}

TEST(ParseQuantity, RejectsWhatIsNoFiniteNumber) {
  for (const char* text : {"", "MPa", "nan MPa", "inf MPa", "1e999 MPa", "--7 MPa"}) {
    EXPECT_THROW(parse_si(text, dimension::pressure, "--pressure"), InputError) << text;
  }
}

struct Meaning {
  const char* text;
  double value;
  Dimension dimension;  // metre, kilogram, second, kelvin
};

void expect_meanings(const std::vector<Meaning>& meanings) {
  for (const Meaning& meaning : meanings) {
    const Quantity found = parse_quantity(meaning.text);
    EXPECT_DOUBLE_EQ(found.value, meaning.value) << meaning.text;
    EXPECT_EQ(found.dimension, meaning.dimension) << meaning.text;
  }
}

TEST(ParseQuantity, RaisesEveryBaseUnitOfADerivedOneToItsPower) {
  expect_meanings({{"3 W^2", 3, {4, 2, -6, 0}},
                   {"2 kJ^2", 2e6, {4, 2, -4, 0}},
                   {"1 W^2/K^3", 1, {4, 2, -6, -3}},
                   {"1 mPa^2 s", 1e-6, {-2, 2, -3, 0}},
                   {"1 mm^-3", 1e9, {-3, 0, 0, 0}},
                   {"1 kPa^-2", 1e-6, {2, -2, 4, 0}},
                   {"1 1/kPa^2", 1e-6, {2, -2, 4, 0}},
                   {"1 cm³", 1e-6, {3, 0, 0, 0}},
                   {"1 km²", 1e6, {2, 0, 0, 0}},
                   {"1 m^-9", 1, {-9, 0, 0, 0}}});
}

TEST(ParseQuantity, DividesByTheFactorAfterASlashOnly) {
  expect_meanings({{"5 W/m K", 5, {1, 1, -3, 1}},
                   {"5 W/m/K", 5, {1, 1, -3, -1}},
                   {"6 m/s/s", 6, {1, 0, -2, 0}},
                   {"8 kg m^-3", 8, {-3, 1, 0, 0}},
                   {"4 km/ms", 4e6, {1, 0, -1, 0}}});
}

TEST(ParseQuantity, KnowsItsUnitsAndNoPrefixOfThoseWithout) {
  expect_meanings({{"1 g", 1e-3, {0, 1, 0, 0}},
                   {"1 N", 1, {1, 1, -2, 0}},
                   {"1 Hz", 1, {0, 0, -1, 0}},
                   {"1 l", 1e-3, {3, 0, 0, 0}},
                   {"1 L", 1e-3, {3, 0, 0, 0}},
                   {"1 bar", 1e5, {-1, 1, -2, 0}},
                   {"1 P", 0.1, {-1, 1, -1, 0}},
                   {"1 cSt", 1e-6, {2, 0, -1, 0}},
                   {"1 Ang", 1e-10, {1, 0, 0, 0}},
                   {"1 micron", 1e-6, {1, 0, 0, 0}},
                   {"1 in", 0.0254, {1, 0, 0, 0}},
                   {"1 inch", 0.0254, {1, 0, 0, 0}},
                   {"1 min", 60, {0, 0, 1, 0}},
                   {"1 h", 3600, {0, 0, 1, 0}},
                   {"1 rad", 1, {}},
                   {"180 deg", 3.14159265358979323846, {}},
                   {"50 %", 0.5, {}},
                   {"+7e2", 700, {}}});
  for (const char* text : {"1 min^2x", "1 kin", "1 kmin", "1 mh", "1 mrad", "1 kdeg", "1 m%",
                           "1 m^", "1 ^2", "1 2m", "1 m^-10", "1 k", "1 mk"}) {
    EXPECT_THROW(parse_quantity(text), InputError) << text;
  }
}

TEST(ParseQuantity, TakesEveryPrefix) {
  const std::vector<std::pair<std::string, int>> prefixes{
      {"f", -15}, {"p", -12}, {"n", -9}, {"u", -6}, {"m", -3}, {"c", -2},
      {"d", -1},  {"k", 3},   {"M", 6},  {"G", 9},  {"T", 12}};
  for (const auto& [prefix, exponent] : prefixes) {
    EXPECT_DOUBLE_EQ(parse_quantity("1 " + prefix + "Pa").value, std::pow(10.0, exponent));
    EXPECT_DOUBLE_EQ(parse_quantity("1 1/" + prefix + "m^2").value, std::pow(10.0, -2 * exponent));
  }
}

TEST(ParseQuantity, TakesPrefixesOfAllUnitsOfTheSiAndSomeOthers) {
  for (const std::string unit :
       {"m", "g", "s", "K", "Pa", "N", "J", "W", "Hz", "l", "L", "bar", "P", "St"}) {
    const Quantity plain = parse_quantity("1 " + unit);
    const Quantity milli = parse_quantity("1 m" + unit);
    EXPECT_DOUBLE_EQ(1e3 * milli.value, plain.value) << unit;
    EXPECT_EQ(milli.dimension, plain.dimension) << unit;
  }
}

TEST(ParseQuantityList, ReadsEachValueWithItsOwnUnit) {
  EXPECT_EQ(parse_si_list("2MPa,500kPa", dimension::pressure, "--pressure"),
            (std::vector<double>{2e6, 5e5}));
  EXPECT_THROW(parse_si_list("2MPa,,7MPa", dimension::pressure, "--pressure"), InputError);
  EXPECT_THROW(parse_si_list("2MPa,7", dimension::pressure, "--pressure"), InputError);
}

TEST(ParseQuantityList, TakesRangesBesideValues) {
  EXPECT_EQ(parse_si_list("2MPa..15MPa:3", dimension::pressure, "--pressure"),
            (std::vector<double>{2e6, 8.5e6, 15e6}));
  EXPECT_EQ(parse_si_list("1kPa..100kPa:log:3,1MPa", dimension::pressure, "--pressure"),
            (std::vector<double>{1e3, 1e4, 1e5, 1e6}));
  EXPECT_EQ(parse_si_list("500kPa..1MPa:2", dimension::pressure, "--pressure"),
            (std::vector<double>{5e5, 1e6}));
}

TEST(ParseQuantityList, TakesRangesInUnitsWithFullStops) {
  EXPECT_EQ(parse_si_list("2mPa.s..6mPa.s:3", dimension::viscosity, "viscosity"),
            (std::vector<double>{2e-3, 4e-3, 6e-3}));
}

TEST(ParseQuantityList, RejectsRangesThatCannotBe) {
  for (const char* text : {"2MPa..15mm:3", "0MPa..1MPa:log:3", "2MPa..15MPa:1", "2MPa..15MPa:x",
                           "2MPa...15MPa", "2..15:3", "2MPa..15:3"}) {
    EXPECT_THROW(parse_si_list(text, dimension::pressure, "--pressure"), InputError) << text;
  }
}

TEST(ParseQuantity, KnowsPoundsPerSquareInch) {
  // NIST SP 811 (2008), appendix B.8: 1 psi = 6.894 757 E+03 Pa.
  EXPECT_NEAR(parse_quantity("1 psi").value, 6.894757e3, 5e-4);
  EXPECT_EQ(parse_quantity("1 psi").dimension, dimension::pressure);
  EXPECT_DOUBLE_EQ(parse_quantity("2 ksi").value, 2000 * parse_quantity("1 psi").value);
}

TEST(UnitFactor, KnowsLengthsOfInstrumentFilesOnly) {
  EXPECT_DOUBLE_EQ(unit_factor("nm", dimension::length).value(), 1e-9);
  EXPECT_DOUBLE_EQ(unit_factor("Å", dimension::length).value(), 1e-10);
  EXPECT_FALSE(unit_factor("V", dimension::length).has_value());
  EXPECT_FALSE(unit_factor("Pa", dimension::length).has_value());
}

TEST(FormatSi, ChoosesTheEngineeringPrefix) {
  EXPECT_EQ(format_si(6.7e-7, "m"), "670 nm");
  EXPECT_EQ(format_si(7e6, "Pa"), "7 MPa");
  EXPECT_EQ(format_si(0, "m"), "0 m");
  EXPECT_EQ(format_si(-2.5e-6, "m"), "-2.5 µm");
  EXPECT_EQ(format_si(1e-3, "m"), "1 mm");
  EXPECT_EQ(format_si(999, "m"), "999 m");
  EXPECT_EQ(format_si(1000, "m"), "1 km");
  EXPECT_EQ(format_si(1234567, "Pa"), "1.235 MPa");
  EXPECT_EQ(format_si(1234567, "Pa", 6), "1.23457 MPa");
}

TEST(FormatSi, KnowsThePrefixesFromFemtoToGigaAndStaysAtTheLast) {
  const std::vector<std::string> prefixes{"f", "p", "n", "µ", "m", "", "k", "M", "G"};
  for (std::size_t i = 0; i < prefixes.size(); ++i) {
    const double value = 2 * std::pow(1000.0, static_cast<double>(i) - 5);
    EXPECT_EQ(format_si(value, "m"), "2 " + prefixes[i] + "m");
    EXPECT_EQ(format_si(-499 * value, "m"), "-998 " + prefixes[i] + "m");
  }
  EXPECT_EQ(format_si(2e-18, "m"), "0.002 fm");
  EXPECT_EQ(format_si(2e12, "Pa"), "2000 GPa");
  EXPECT_EQ(format_si(-2e13, "Pa", 5), "-20000 GPa");
  EXPECT_EQ(format_si(INFINITY, "Pa"), "inf Pa");
}

TEST(FormatSi, HasNoNegativeZero) { EXPECT_EQ(format_si(-0.0, "m"), "0 m"); }

TEST(Percent, HasNoExponents) {
  EXPECT_EQ(percent(0.02134), "2.13 %");
  EXPECT_EQ(percent(0.997, 2), "100 %");
  EXPECT_EQ(percent(1, 2), "100 %");
  EXPECT_EQ(percent(18.08), "1808 %");
  EXPECT_EQ(percent(0), "0 %");
}

}  // namespace
}  // namespace tabor
